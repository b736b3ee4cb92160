#include "models/measure/mesh_distance.h"
#include "models/measure/triangle_bvh.h"
#include "tests/models/measure/made_meshes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

using namespace octant;
using models::TriangleMesh;
using models::measure::distance;
using models::measure::DistanceOptions;
using models::measure::flipped_area_share;
using models::measure::MeshDistance;
using models::measure::OneWayDistance;
using models::measure::TriangleBvh;

namespace {

DistanceOptions few_samples(int threads = 1) {
    DistanceOptions options;
    options.samples = 20'000;
    options.threads = threads;
    return options;
}

/// The largest distance of many points of `mesh`, among them the corners, to `target`.
double by_points(const TriangleMesh& mesh, const TriangleMesh& target) {
    constexpr int steps = 24;
    const TriangleBvh bvh(target);
    double most2 = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3& start = mesh.vertices_m[a];
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                const glm::dvec3 point = start + (mesh.vertices_m[b] - start) * (i / double{steps}) +
                                         (mesh.vertices_m[c] - start) * (j / double{steps});
                most2 = std::max(most2, bvh.nearest(point).distance2);
            }
        }
    }
    return std::sqrt(most2);
}

void check_bounds(const TriangleMesh& mesh, const TriangleMesh& target, const OneWayDistance& way) {
    const double tried_m = by_points(mesh, target);
    CHECK(way.min_hausdorff_m <= way.max_hausdorff_m);
    CHECK(way.max_hausdorff_m <= 1.01 * way.min_hausdorff_m + 1e-8);
    CHECK(tried_m <= way.max_hausdorff_m);
    CHECK(way.min_hausdorff_m <= tried_m + 0.2); // the points are not farther apart
    CHECK(way.mean_m <= way.rms_m);
    CHECK(way.rms_m <= way.max_hausdorff_m);
}

/// A roof over the unit square: its ridge lies at the height 1 over y = 1/2.
TriangleMesh roof() {
    TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0.5, 1}, {1, 0.5, 1}};
    mesh.triangles = {{0, 1, 5}, {0, 5, 4}, {2, 3, 4}, {2, 4, 5}};
    return mesh;
}

bool same_bits(double one, double other) {
    return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
}

bool same_bits(const OneWayDistance& one, const OneWayDistance& other) {
    return same_bits(one.min_hausdorff_m, other.min_hausdorff_m) &&
           same_bits(one.max_hausdorff_m, other.max_hausdorff_m) && same_bits(one.rms_m, other.rms_m) &&
           same_bits(one.mean_m, other.mean_m) && same_bits(one.colour_rms, other.colour_rms);
}

} // namespace

TEST_CASE("two plates lie as far apart as they were put") {
    const MeshDistance found = distance(tests::plate(3), tests::plate(7, 1.0, 0.25), few_samples());
    for (const OneWayDistance& way : {found.there, found.back}) {
        CHECK(way.min_hausdorff_m == Approx(0.25).epsilon(1e-12));
        CHECK(way.max_hausdorff_m >= 0.25);
        CHECK(way.max_hausdorff_m <= 0.25 * 1.01);
        CHECK(way.rms_m == Approx(0.25).epsilon(1e-12));
        CHECK(way.mean_m == Approx(0.25).epsilon(1e-12));
    }
}

TEST_CASE("plates a hair apart, cut differently, are still bounded tightly") {
    const MeshDistance found = distance(tests::plate(3), tests::plate(7, 1.0, 1e-6), few_samples());
    CHECK(found.min_hausdorff_m() <= 1e-6);
    CHECK(found.max_hausdorff_m() >= 1e-6);
    CHECK(found.max_hausdorff_m() <= 1.01 * found.min_hausdorff_m());
}

TEST_CASE("a square cut along the other diagonal is still the same square") {
    TriangleMesh square = tests::plate(1);
    TriangleMesh other = square;
    other.triangles = {{0, 1, 2}, {1, 3, 2}};
    const models::measure::HausdorffBounds bounds =
        models::measure::one_way_hausdorff(square, models::measure::TargetSurface(other), {.negligible_m = 1e-12});
    CHECK(bounds.min_hausdorff_m == 0.0);
    CHECK(bounds.max_hausdorff_m < 1e-12);
    CHECK(bounds.cuts <= 2); // each half at the one edge that it crosses
}

TEST_CASE("flats cut unlike each other take cuts by their triangles, not by their distance") {
    // In one plane, none of the axes': vertices inside are shifted along it.
    const auto sheet = [](int n, std::uint64_t seed, double lifted_m) {
        TriangleMesh mesh = tests::plate(n);
        tests::Dice dice(seed);
        for (glm::dvec3& at : mesh.vertices_m) {
            const double share = 4.0 * at.x * (1.0 - at.x) * at.y * (1.0 - at.y);
            at.x += dice.between(-0.3, 0.3) / n * share;
            at.y += dice.between(-0.3, 0.3) / n * share;
            at = {at.x, 0.6 * at.y - 0.8 * lifted_m, 0.8 * at.y + 0.6 * lifted_m};
        }
        return mesh;
    };
    const TriangleMesh coarse = sheet(4, 1, 0.0);
    for (const double apart_m : {0.0, 1e-7, 1e-3}) {
        const TriangleMesh fine = sheet(20, 2, apart_m);
        for (const auto& [from, to] : {std::pair{&coarse, &fine}, std::pair{&fine, &coarse}}) {
            const models::measure::HausdorffBounds bounds =
                models::measure::one_way_hausdorff(*from, models::measure::TargetSurface(*to), {.negligible_m = 1e-9});
            INFO(apart_m << " apart, " << bounds.cuts << " cuts");
            CHECK(bounds.min_hausdorff_m <= apart_m);
            CHECK(bounds.max_hausdorff_m >= apart_m);
            CHECK(bounds.max_hausdorff_m <= std::max(1.011 * apart_m, 1.001e-9));
            CHECK(bounds.cuts < 20U * 800U);
        }
    }
}

TEST_CASE("a large piece over many small triangles takes few cuts") {
    const TriangleMesh fine = tests::shaken(tests::plate(60), 3, 0.002);
    const models::measure::HausdorffBounds bounds = models::measure::one_way_hausdorff(
        tests::plate(1), models::measure::TargetSurface(fine), {.negligible_m = 0.02});
    // A third of a piece of edge 0.1 is about 0.03 long: some 100 of them cover the plate.
    CHECK(bounds.max_hausdorff_m <= 0.02);
    CHECK(bounds.max_hausdorff_m >= bounds.min_hausdorff_m);
    CHECK(bounds.cuts < 1'500);
}

TEST_CASE("where the larger way alone counts, the two-sided distance is as tight") {
    const TriangleMesh fine = tests::shaken(tests::ball(24), 4, 0.01);
    const TriangleMesh coarse = tests::ball(9);
    models::measure::DistanceOptions options = few_samples();
    const MeshDistance both = distance(fine, coarse, options);
    options.maximum_only = true;
    const MeshDistance larger = distance(fine, coarse, options);
    CHECK(larger.min_hausdorff_m() <= both.max_hausdorff_m());
    CHECK(larger.max_hausdorff_m() >= both.min_hausdorff_m());
    CHECK(larger.max_hausdorff_m() <= 1.0101 * larger.min_hausdorff_m());
}

TEST_CASE("a thin piece is cut on, however its edges lie") {
    TriangleMesh needle; // its middle corner lies on the edge between the others
    needle.vertices_m = {{0.05, 0.07, 0.01}, {0.45, 0.42, 0.03}, {0.85, 0.77, 0.05}};
    needle.triangles = {{0, 1, 2}};
    const models::measure::HausdorffBounds bounds = models::measure::one_way_hausdorff(
        needle, models::measure::TargetSurface(tests::shaken(tests::plate(9), 5, 0.01)), {});
    CHECK(bounds.max_hausdorff_m <= 1.0101 * bounds.min_hausdorff_m);
    CHECK(bounds.cuts < 2'000);
}

TEST_CASE("a part is no distance from the whole, the whole is from its part") {
    const MeshDistance found = distance(tests::plate(2, 1.0), tests::plate(6, 3.0), few_samples());
    CHECK(found.there.min_hausdorff_m == 0.0);
    CHECK(found.there.max_hausdorff_m < 1e-8);
    CHECK(found.there.rms_m < 1e-15);
    CHECK(found.back.min_hausdorff_m <= std::sqrt(8.0));
    CHECK(found.back.max_hausdorff_m >= std::sqrt(8.0));
    CHECK(found.min_hausdorff_m() == found.back.min_hausdorff_m);
}

TEST_CASE("the farthest point is found in the middle of a face, where no vertex lies") {
    // Under the ridge the floor is 1/sqrt(5) from both slopes, its vertices touch them.
    const MeshDistance found = distance(tests::plate(1), roof(), few_samples());
    const double exact_m = 1.0 / std::sqrt(5.0);
    CHECK(found.there.min_hausdorff_m <= exact_m);
    CHECK(found.there.max_hausdorff_m >= exact_m);
    CHECK(found.there.max_hausdorff_m <= 1.01 * found.there.min_hausdorff_m);
    CHECK(found.back.min_hausdorff_m == Approx(1.0));
    // The distance grows evenly from both eaves.
    CHECK(found.there.mean_m == Approx(exact_m / 2.0).epsilon(1e-3));
    CHECK(found.there.rms_m == Approx(exact_m / std::sqrt(3.0)).epsilon(1e-3));
}

TEST_CASE("equal meshes are at no distance") {
    for (const TriangleMesh& mesh :
        {tests::ball(16), tests::shaken(tests::plate(9), 1, 0.03), tests::scattered(2, 80)}) {
        const MeshDistance found = distance(mesh, mesh, few_samples());
        CHECK(found.min_hausdorff_m() == 0.0);
        CHECK(found.max_hausdorff_m() < 1e-8);
        CHECK(found.rms_m() < 1e-15);
    }
}

TEST_CASE("no point of a mesh is farther away than certified, and one is nearly so") {
    const std::vector<std::pair<TriangleMesh, TriangleMesh>> pairs = {{tests::ball(5), tests::ball(30)},
        {tests::shaken(tests::plate(5), 3, 0.1), tests::shaken(tests::plate(17), 4, 0.02)},
        {tests::scattered(5, 40), tests::scattered(6, 40)}, {tests::scattered(7, 100), tests::ball(9, 0.7)},
        {tests::shaken(tests::ball(12), 8, 0.05), tests::ball(12)}};
    for (const auto& [a, b] : pairs) {
        INFO(a.name << " and " << b.name);
        const MeshDistance found = distance(a, b, few_samples());
        check_bounds(a, b, found.there);
        check_bounds(b, a, found.back);
    }
}

TEST_CASE("a tighter bound lies within the looser one") {
    const TriangleMesh a = tests::shaken(tests::ball(10), 8, 0.05);
    const TriangleMesh b = tests::ball(14);
    DistanceOptions options = few_samples();
    options.tightness = 1.2;
    const MeshDistance loose = distance(a, b, options);
    options.tightness = 1.0001;
    const MeshDistance tight = distance(a, b, options);
    CHECK(tight.max_hausdorff_m() <= 1.0001 * tight.min_hausdorff_m() + 1e-12);
    CHECK(tight.min_hausdorff_m() <= loose.max_hausdorff_m());
    CHECK(tight.max_hausdorff_m() >= loose.min_hausdorff_m());
}

TEST_CASE("a distance grows with the meshes and moves with them") {
    const TriangleMesh a = tests::shaken(tests::ball(8), 8, 0.05);
    const TriangleMesh b = tests::ball(14);
    const MeshDistance here = distance(a, b, few_samples());
    TriangleMesh far_a = a;
    TriangleMesh far_b = b;
    for (TriangleMesh* mesh : {&far_a, &far_b}) {
        for (glm::dvec3& vertex_m : mesh->vertices_m) { vertex_m = 1000.0 * vertex_m + glm::dvec3(4e6, -3e6, 500.0); }
    }
    const MeshDistance there = distance(far_a, far_b, few_samples());
    CHECK(there.rms_m() == Approx(1000.0 * here.rms_m()).epsilon(1e-6));
    CHECK(there.min_hausdorff_m() <= 1000.0 * here.max_hausdorff_m());
    CHECK(there.max_hausdorff_m() >= 1000.0 * here.min_hausdorff_m());
}

TEST_CASE("any number of threads gives the same bits") {
    TriangleMesh a = tests::shaken(tests::ball(14), 8, 0.05);
    TriangleMesh b = tests::ball(25);
    a.colours.assign(a.vertices_m.size(), glm::vec3(0.1F, 0.5F, 0.9F));
    b.colours.assign(b.vertices_m.size(), glm::vec3(0.2F, 0.3F, 0.4F));
    const MeshDistance alone = distance(a, b, few_samples(1));
    for (const int threads : {2, 4}) {
        const MeshDistance together = distance(a, b, few_samples(threads));
        CHECK(same_bits(alone.there, together.there));
        CHECK(same_bits(alone.back, together.back));
    }
}

TEST_CASE("colours are compared where the nearest points lie") {
    TriangleMesh a = tests::plate(2);
    TriangleMesh b = tests::plate(5, 1.0, 0.5);
    const auto ramp = [](TriangleMesh& mesh) { // linear: any triangulation has the same colours
        for (const glm::dvec3& vertex_m : mesh.vertices_m) { mesh.colours.emplace_back(vertex_m.x, vertex_m.y, 0.5); }
    };
    ramp(a);
    CHECK(distance(a, b, few_samples()).colour_rms() == 0.0); // b has none
    ramp(b);
    CHECK(distance(a, b, few_samples()).colour_rms() < 1e-6);
    for (glm::vec3& colour : b.colours) { colour.z = 0.75F; }
    CHECK(distance(a, b, few_samples()).colour_rms() == Approx(0.25));
}

TEST_CASE("vertices that no triangle uses are no part of a surface") {
    TriangleMesh a = tests::plate(2);
    a.vertices_m.emplace_back(0.5, 0.5, 100.0);
    CHECK(distance(a, tests::plate(3), few_samples()).max_hausdorff_m() < 1e-8);
}

TEST_CASE("triangles without area are measured too") {
    TriangleMesh line; // from the origin straight up
    line.vertices_m = {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}};
    line.triangles = {{0, 1, 2}, {0, 0, 0}};
    const MeshDistance found = distance(line, tests::plate(2), few_samples());
    CHECK(found.there.min_hausdorff_m == Approx(2.0));
    CHECK(found.back.min_hausdorff_m <= std::sqrt(2.0));
    CHECK(found.back.max_hausdorff_m >= std::sqrt(2.0));
    CHECK(found.there.rms_m > 0.0);
}

namespace {

void turn(models::Triangle& triangle) { std::swap(triangle[0], triangle[1]); }

/// Two plates `thickness_m` apart that face away from each other.
TriangleMesh sheet(int n, double thickness_m) {
    TriangleMesh mesh = tests::plate(n, 1.0, thickness_m);
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    const TriangleMesh below = tests::plate(n);
    mesh.vertices_m.insert(mesh.vertices_m.end(), below.vertices_m.begin(), below.vertices_m.end());
    for (const auto& [a, b, c] : below.triangles) { mesh.triangles.push_back({first + b, first + a, first + c}); }
    return mesh;
}

} // namespace

TEST_CASE("nothing of a mesh is flipped against itself, all of it against its back") {
    TriangleMesh mesh = tests::ball(12);
    CHECK(flipped_area_share(mesh, mesh) == 0.0);
    TriangleMesh back = mesh;
    for (models::Triangle& triangle : back.triangles) { turn(triangle); }
    CHECK(flipped_area_share(back, mesh) == 1.0);
}

TEST_CASE("the share of flipped triangles is that of their area") {
    const TriangleMesh original = tests::plate(4);
    TriangleMesh mesh = tests::plate(4, 1.0, 0.01);
    for (std::size_t i = 0; i < 8; ++i) { // of 32
        turn(mesh.triangles[i * 4]);
    }
    CHECK(flipped_area_share(mesh, original) == Approx(0.25).margin(1e-3));
}

TEST_CASE("a thin sheet that lies nearer to the other side is not flipped") {
    const TriangleMesh original = sheet(4, 0.01);
    TriangleMesh mesh = sheet(2, 0.002); // its upper side is nearer to the lower side
    CHECK(flipped_area_share(mesh, original) > 0.4);
    CHECK(flipped_area_share(mesh, original, 0.009) == 0.0);
    const TriangleMesh halfway = sheet(2, 0.0045); // twice the distance reaches the right side
    CHECK(flipped_area_share(halfway, original) == 0.0);
}

TEST_CASE("any number of threads finds the same share") {
    const TriangleMesh original = tests::ball(12);
    const TriangleMesh mesh = tests::shaken(tests::ball(20), 4, 0.1);
    const double share = flipped_area_share(mesh, original);
    CHECK(share > 0.0);
    CHECK(share < 0.5);
    CHECK(flipped_area_share(mesh, original, 0.0, {.threads = 4}) == share);
}
