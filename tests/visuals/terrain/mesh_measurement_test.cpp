#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/mesh_measurement.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace octant::visuals::terrain;
using namespace octant::visuals::terrain::test;
using octant::models::ColourVertex;
using octant::models::heights::HeightField;

namespace {

PerspectiveView looking_north(const glm::dvec3& eye_m) {
    PerspectiveView view;
    view.eye_m = eye_m;
    view.near_m = 0.5;
    return view;
}

} // namespace

TEST_CASE("the first frame has no jump and the same mesh again jumps by nothing") {
    Ground ground(rough_field(65, 65, 4));
    MeshView view;
    view.eye_m = {0.0, -40.0, 12.0};
    PoppingMeter meter;
    const GroundMesh mesh = ground.mesher.mesh(view, {8.0, 2.0, FanKind::Partial});
    CHECK_FALSE(meter.next(mesh, looking_north(view.eye_m)));
    const auto jump = meter.next(mesh, looking_north(view.eye_m));
    REQUIRE(jump);
    CHECK(jump->popping_px < 1e-3);
}

TEST_CASE("a vertex that comes in jumps by its height above the edge it halves") {
    Ground ground(bump_field(5, 2, 3, 2.0F)); // 2 m high, 1 m north of the middle
    MeshView view;
    view.eye_m = {0.0, -9.0, 1.0};
    const PerspectiveView picture = looking_north(view.eye_m);
    const GroundMesh fine = ground.mesher.mesh(view, {1000.0, 20.0, FanKind::Partial});
    const std::vector<octant::models::ColourVertex> all(fine.vertices.begin(), fine.vertices.end());
    const std::vector<std::uint32_t> triangles(fine.indices.begin(), fine.indices.end());
    GroundMesh kept;
    kept.vertices = all;
    kept.indices = triangles;
    std::vector<octant::models::ColourVertex> level = all;
    for (auto& vertex : level) { vertex.position_m.z = -1.0F; }
    GroundMesh flat = kept;
    flat.vertices = level;
    for (const bool coming : {true, false}) {
        PoppingMeter meter;
        meter.next(coming ? flat : kept, picture);
        const auto jump = meter.next(coming ? kept : flat, picture);
        REQUIRE(jump);
        CHECK(jump->popping_px == Approx(869.1 * 2.0 / 10.0));
        CHECK(jump->place_m.y == Approx(1.0));
    }
}

TEST_CASE("what one of the two frames does not show is no jump") {
    Ground ground(bump_field(5, 2, 3, 2.0F));
    MeshView view;
    view.eye_m = {0.0, -9.0, 1.0};
    PerspectiveView away = looking_north(view.eye_m);
    away.ahead = {0.0, -1.0, 0.0};
    away.right = {-1.0, 0.0, 0.0};
    PoppingMeter meter;
    meter.next(ground.mesher.mesh(view, {1000.0, 20.0, FanKind::Partial}), away);
    const auto jump = meter.next(ground.mesher.mesh(view, {2.0, 0.0, FanKind::Partial}), looking_north(view.eye_m));
    REQUIRE(jump);
    CHECK(jump->popping_px == 0.0);
}

namespace {

/// Looks straight down from the middle of the field.
PerspectiveView from_above(double height_m) {
    PerspectiveView view;
    view.eye_m = {0.0, 0.0, height_m};
    view.right = {1.0, 0.0, 0.0};
    view.up = {0.0, 1.0, 0.0};
    view.ahead = {0.0, 0.0, -1.0};
    view.focal_px = 1000.0;
    view.half_width_px = 1e6;
    view.half_height_px = 1e6;
    view.near_m = 0.1;
    return view;
}

/// The field's four corners as two triangles, relative to an eye.
struct FlatMesh {
    FlatMesh(const HeightField& field, const glm::dvec3& eye_m) {
        const int east = field.columns() - 1;
        const int north = field.rows() - 1;
        std::size_t k = 0;
        for (const auto& [column, row] :
            {std::pair{0, 0}, std::pair{east, 0}, std::pair{0, north}, std::pair{east, north}}) {
            vertices[k++].position_m = glm::vec3(field.sample_m(column, row) - eye_m);
        }
        mesh.vertices = vertices;
        mesh.indices = indices;
    }

    std::array<ColourVertex, 4> vertices;
    std::array<std::uint32_t, 6> indices = {0, 1, 3, 0, 3, 2};
    GroundMesh mesh;
};

} // namespace

TEST_CASE("one sample above a flat mesh errs by its height as seen, all others by nothing") {
    const HeightField field = bump_field(9, 6, 4, 1.0F); // 2 m east of the middle
    const PerspectiveView view = from_above(101.0);
    const FlatMesh flat(field, view.eye_m);
    const ProjectedError error = ProjectedErrorMeter(GroundSamples(field)).measure(flat.mesh, view);
    const double expected_px = 1000.0 * 2.0 / 100.0 - 1000.0 * 2.0 / 101.0;
    CHECK(error.samples == 81);
    CHECK(error.uncovered == 0);
    CHECK(error.maximum_px == Approx(expected_px));
    CHECK(error.p999_px == Approx(expected_px));
    CHECK(error.p99_px == Approx(expected_px)); // nearest rank of 81: the largest
    CHECK(error.mean_px == Approx(expected_px / 81.0));
    CHECK(error.rms_px == Approx(expected_px / 9.0));
    CHECK(error.triangles_in_view == 2);
}

TEST_CASE("samples outside the frustum do not count, nor triangles wholly outside") {
    const HeightField field = level_field(9, 9);
    PerspectiveView view = from_above(100.0);
    const FlatMesh flat(field, view.eye_m);
    view.half_width_px = 25.0; // 2.5 m to each side
    CHECK(ProjectedErrorMeter(GroundSamples(field)).measure(flat.mesh, view).samples == 5 * 9);
    view.near_m = 200.0;
    const ProjectedError none = ProjectedErrorMeter(GroundSamples(field)).measure(flat.mesh, view);
    CHECK(none.samples == 0);
    CHECK(none.triangles_in_view == 0);
}

TEST_CASE("a hole in the mesh is counted") {
    const HeightField field = level_field(9, 9);
    const PerspectiveView view = from_above(100.0);
    const FlatMesh flat(field, view.eye_m);
    GroundMesh half = flat.mesh;
    half.indices = half.indices.first(3);
    const ProjectedError error = ProjectedErrorMeter(GroundSamples(field)).measure(half, view);
    CHECK(error.samples == 45);
    CHECK(error.uncovered == 36);
}

TEST_CASE("a mesh of every sample has no error, every sample counts once, in any number of threads") {
    Ground ground(rough_field(70, 131, 3));
    MeshView everywhere;
    everywhere.eye_m = {3.0, -7.0, 90.0};
    const GroundMesh fine = ground.mesher.mesh(everywhere, {1000.0, 20.0, FanKind::Partial});
    PerspectiveView view = from_above(90.0);
    view.eye_m = everywhere.eye_m;
    const ProjectedError error = ProjectedErrorMeter(GroundSamples(ground.field)).measure(fine, view);
    CHECK(error.samples == 70 * 131);
    CHECK(error.maximum_px < 1e-3);
    const GroundMesh coarse = ground.mesher.mesh(everywhere, {3.0, 1.0, FanKind::Partial});
    const ProjectedError one = ProjectedErrorMeter(GroundSamples(ground.field), 1).measure(coarse, view);
    const ProjectedError three = ProjectedErrorMeter(GroundSamples(ground.field), 3).measure(coarse, view);
    CHECK(one.samples == 70 * 131);
    CHECK(one.rms_px > 0.01);
    CHECK(one.rms_px == three.rms_px);
    CHECK(one.p999_px == three.p999_px);
}

TEST_CASE("on a curved earth samples sink as far as the mesh does") {
    const HeightField field = level_field(9, 9);
    const PerspectiveView view = from_above(100.0);
    constexpr double radius_m = 50.0;
    FlatMesh flat(field, view.eye_m);
    for (ColourVertex& vertex : flat.vertices) {
        vertex.position_m.z -= 32.0F / (2.0F * 50.0F); // 4 m east and north
    }
    const ProjectedError error = ProjectedErrorMeter(GroundSamples(field)).measure(flat.mesh, view, radius_m);
    double max_px = 0.0;
    for (int column = -4; column <= 4; ++column) {
        for (int row = -4; row <= 4; ++row) {
            const double off_m = std::hypot(column, row);
            const double depth_m = 100.0 + off_m * off_m / (2.0 * radius_m);
            max_px = std::max(max_px, 1000.0 * off_m * std::abs(1.0 / depth_m - 1.0 / 100.32));
        }
    }
    CHECK(error.maximum_px == Approx(max_px).margin(1e-3));
}

namespace {

struct Changed {
    explicit Changed(const GroundMesh& mesh)
        : vertices(mesh.vertices.begin(), mesh.vertices.end()), indices(mesh.indices.begin(), mesh.indices.end()) {}

    GroundMesh mesh() const {
        GroundMesh mesh;
        mesh.vertices = vertices;
        mesh.indices = indices;
        return mesh;
    }

    std::vector<octant::models::ColourVertex> vertices;
    std::vector<std::uint32_t> indices;
};

} // namespace

TEST_CASE("edge matching finds nothing wrong with meshes of the quadtree") {
    Ground ground(rough_field(65, 40, 5));
    Numbers numbers(11);
    for (int k = 0; k < 300; ++k) {
        const MeshView view = random_view(numbers, ground.field);
        const GroundMesh mesh =
            ground.mesher.mesh(view, {numbers.between(2.0, 20.0), numbers.between(0.0, 5.0), FanKind::Partial});
        const Conformity found = check_conformity(GroundSamples(ground.field), mesh, view);
        INFO(k << ": " << found.text());
        REQUIRE(found.is_conforming());
    }
}

TEST_CASE("edge matching sees each fault by its name") {
    Ground ground(rough_field(33, 33, 5));
    MeshView view;
    view.eye_m = {1.0, 2.0, 30.0};
    const GroundMesh whole = ground.mesher.mesh(view, {4.0, 2.0, FanKind::Partial});
    REQUIRE(whole.counters.triangles > 50);

    SECTION("a missing triangle leaves its inner edges open") {
        Changed changed(whole);
        changed.indices.erase(changed.indices.begin() + 30, changed.indices.begin() + 33);
        const Conformity found = check_conformity(GroundSamples(ground.field), changed.mesh(), view);
        CHECK(found.open_edges >= 1);
        CHECK(found.open_edges <= 3);
    }
    SECTION("a triangle twice crowds its edges") {
        Changed changed(whole);
        changed.indices.insert(changed.indices.end(), changed.indices.begin() + 30, changed.indices.begin() + 33);
        CHECK(check_conformity(GroundSamples(ground.field), changed.mesh(), view).overlapping_edges == 3);
    }
    SECTION("a turned triangle") {
        Changed changed(whole);
        std::swap(changed.indices[30], changed.indices[31]);
        CHECK(check_conformity(GroundSamples(ground.field), changed.mesh(), view).inverted_triangles == 1);
    }
    SECTION("a vertex twice in one place opens the edges there") {
        Changed changed(whole);
        changed.vertices.push_back(changed.vertices[changed.indices[30]]);
        changed.indices[30] = static_cast<std::uint32_t>(changed.vertices.size() - 1);
        const Conformity found = check_conformity(GroundSamples(ground.field), changed.mesh(), view);
        CHECK(found.duplicate_vertices == 1);
        CHECK(found.open_edges > 0);
    }
}

TEST_CASE("the printed propagation is caught with corners on edges") {
    int caught = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        QuadtreeOptions options;
        options.propagation = RoughnessPropagation::Printed;
        Ground ground(rough_field(65, 65, seed), options);
        MeshView view;
        view.eye_m = {5.0, 3.0, 2.0};
        const GroundMesh mesh = ground.mesher.mesh(view, {4.0, 5.0, FanKind::Partial});
        const Conformity found = check_conformity(GroundSamples(ground.field), mesh, view);
        const GroundCheck other = checked_ground(sample_triangles(mesh, ground.field, view.eye_m), ground.field);
        CHECK(other.counter_clockwise);
        CHECK(found.is_conforming() == (other.unmatched_edges == 0));
        CHECK((found.t_junctions > 0) == (found.open_edges > 0));
        caught += found.t_junctions > 0 ? 1 : 0;
    }
    CHECK(caught > 3);
}
