#include "models/measure/mesh_defects.h"
#include "models/measure/mesh_distance.h"
#include "models/simplify/attribute_seams.h"
#include "models/simplify/simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;
using namespace octant;

namespace {

/// Coarse figures are enough here, and quicker.
measure::MeshDistance apart(const TriangleMesh& a, const TriangleMesh& b) {
    return measure::distance(a, b, {.tightness = 1.05, .negligible_m = 1e-4, .samples = 20'000});
}

SimplifyOptions to_faces(std::size_t faces, int effort = surface_effort) {
    SimplifyOptions options;
    options.effort = effort;
    options.goal.faces = faces;
    return options;
}

const int both[] = {surface_effort, fast_effort};

TriangleMesh two_coloured(TriangleMesh mesh) {
    for (const glm::dvec3& v : mesh.vertices_m) {
        mesh.colours.push_back(v.x < 0.5001 ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 0.0F, 1.0F));
    }
    return mesh;
}

} // namespace

TEST_CASE("a cube of many triangles becomes the cube of 12 without an error") {
    const TriangleMesh fine = cube(6);
    for (const int effort : both) {
        const Simplified result = simplified(fine, to_faces(12, effort));
        CHECK(result.mesh.triangles.size() == 12);
        CHECK(result.mesh.vertices_m.size() == 8);
        CHECK(is_manifold(result.mesh));
        CHECK(volume_m3(result.mesh) == Approx(1.0).epsilon(1e-6));
        CHECK(apart(fine, result.mesh).max_hausdorff_m() < 2e-4);
    }
}

TEST_CASE("with a share of their length counted, edges of flat sides stay alike") {
    const auto longest_m = [](const TriangleMesh& mesh) {
        double max_m = 0.0;
        for (const auto& [a, b, c] : mesh.triangles) {
            max_m = std::max({max_m, glm::distance(mesh.vertices_m[a], mesh.vertices_m[b]),
                glm::distance(mesh.vertices_m[b], mesh.vertices_m[c]),
                glm::distance(mesh.vertices_m[c], mesh.vertices_m[a])});
        }
        return max_m;
    };
    const auto coarse = [](const TriangleMesh& fine, double length_share) {
        SimplifyOptions options = to_faces(400, fast_effort);
        options.length_share = length_share;
        const CollapseSequence sequence = fast_sequence(fine, options);
        return mesh_after(sequence, sequence.collapses.size());
    };
    const TriangleMesh flat_cube = cube(12);
    CHECK(longest_m(coarse(flat_cube, 0.03)) < 0.45);
    CHECK(apart(flat_cube, coarse(flat_cube, 0.03)).max_hausdorff_m() < 2e-4);
    INFO("on sides that are a little rough, as on flat ones short edges go first anyway");
    TriangleMesh rough = flat_cube;
    std::mt19937 random(7);
    for (glm::dvec3& vertex_m : rough.vertices_m) {
        for (int axis = 2; axis >= 0; --axis) { vertex_m[axis] += 2e-4 * static_cast<double>(random() % 2); }
    }
    const TriangleMesh plain = coarse(rough, 0.0);
    const TriangleMesh even = coarse(rough, 0.03);
    CHECK(even.triangles.size() == plain.triangles.size());
    CHECK(longest_m(even) < 0.7 * longest_m(plain));
}

TEST_CASE("a flat strip becomes two triangles, its boundary where it was") {
    const TriangleMesh fine = strip(5, 15);
    for (const int effort : both) {
        const Simplified result = simplified(fine, to_faces(2, effort));
        CHECK(result.mesh.triangles.size() == 2);
        CHECK(area_m2(result.mesh) == Approx(3.0).epsilon(1e-5));
        CHECK(apart(fine, result.mesh).max_hausdorff_m() < 2e-4);
    }
}

TEST_CASE("without a goal a ball is collapsed as far as it goes: to a tetrahedron") {
    for (const int effort : both) {
        SimplifyOptions options;
        options.effort = effort;
        const Simplified result = simplified(ball(8), options);
        CHECK(result.mesh.triangles.size() == 4);
        CHECK(is_manifold(result.mesh));
    }
}

TEST_CASE("a ring keeps its hole") {
    const auto keeps_it = [](const TriangleMesh& fine, std::size_t faces, int effort) {
        SimplifyOptions options = to_faces(faces, effort);
        options.keep_topology = faces == 1;
        const TriangleMesh made = simplified(fine, options).mesh;
        CHECK(made.triangles.size() < fine.triangles.size());
        CHECK(is_manifold(made));
        CHECK(boundary_edges(made) == 0);
        CHECK(euler_number(made) == 0);
    };
    for (const std::size_t faces : {400U, 60U, 1U}) { keeps_it(ring(24, 16), faces, fast_effort); }
    INFO("also where collapses run out");
    keeps_it(ring(12, 8), 1, surface_effort);
}

TEST_CASE("goals of vertices and of faces are kept") {
    for (const int effort : both) {
        SimplifyOptions options;
        options.effort = effort;
        options.goal.vertices = 30;
        CHECK(simplified(ball(8), options).mesh.vertices_m.size() == 30);
    }
    CHECK(simplified(ball(24), to_faces(300, fast_effort)).mesh.triangles.size() == 300);
    const TriangleMesh fine = ball(10);
    CHECK(same_bytes(simplified(fine, to_faces(100'000)).mesh, fine));
}

TEST_CASE("where a surface has a border, odd and even goals of faces are met exactly") {
    TriangleMesh open = strip(12, 12);
    for (glm::dvec3& place_m : open.vertices_m) {
        place_m.z = 0.1 * std::sin(5.0 * place_m.x) * std::cos(4.0 * place_m.y);
    }
    for (std::size_t faces = 60; faces < 64; ++faces) {
        const SimplifyOptions options = to_faces(faces, fast_effort);
        CHECK(simplified(open, options).mesh.triangles.size() == faces);
    }
    CHECK(simplified(open, to_faces(61, surface_effort)).mesh.triangles.size() == 61);
}

TEST_CASE("an error goal is kept by the certified distance, and not by staying fine") {
    const TriangleMesh fine = ball(40);
    for (const int effort : both) {
        SimplifyOptions options;
        options.effort = effort;
        options.goal.error_m = 0.02;
        const Simplified result = simplified(fine, options);
        const measure::MeshDistance distance = measure::distance(fine, result.mesh, {.samples = 20'000});
        CHECK(distance.max_hausdorff_m() <= 0.02);
        CHECK(result.mesh.triangles.size() < fine.triangles.size() / 4);
        options.goal.error_m = 0.0;
        CHECK(apart(fine, simplified(fine, options).mesh).max_hausdorff_m() < 2e-4);
    }
}

TEST_CASE("sharp edges of a machined part stay sharp") {
    const TriangleMesh fine = machined_part(12);
    REQUIRE(is_manifold(fine));
    REQUIRE(boundary_edges(fine) == 0);
    const Simplified result = simplified(fine, to_faces(120));
    const measure::MeshDistance distance = apart(fine, result.mesh);
    CHECK(distance.max_hausdorff_m() < 0.02 * diagonal_m(fine));
    CHECK(volume_m3(result.mesh) == Approx(volume_m3(fine)).epsilon(0.005));
}

TEST_CASE("a border of colours stays where it was") {
    const TriangleMesh fine = two_coloured(cube(12));
    for (const int effort : both) {
        const Simplified result = simplified(fine, to_faces(160, effort));
        CHECK(apart(fine, result.mesh).colour_rms() < 0.02);
    }
}

TEST_CASE("a border of materials stays where it was") {
    TriangleMesh fine = strip(8, 16);
    fine.materials = {{"grass", glm::vec3(0.2F)}, {"sand", glm::vec3(0.8F)}};
    for (const Triangle& t : fine.triangles) {
        const double x = (fine.vertices_m[t[0]].x + fine.vertices_m[t[1]].x + fine.vertices_m[t[2]].x) / 3;
        fine.triangle_materials.push_back(x < 1.0 ? 0 : 1);
    }
    for (const int effort : both) {
        const Simplified result = simplified(fine, to_faces(4, effort));
        REQUIRE(result.mesh.triangle_materials.size() == result.mesh.triangles.size());
        TriangleMesh grass = result.mesh;
        grass.triangles.clear();
        for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
            if (result.mesh.triangle_materials[t] == 0) { grass.triangles.push_back(result.mesh.triangles[t]); }
        }
        CHECK(area_m2(grass) == Approx(1.0).epsilon(1e-4));
    }
}

TEST_CASE("corner normals come from the original, on both sides of a sharp edge") {
    TriangleMesh fine = cube(4);
    for (const Triangle& t : fine.triangles) {
        const auto& v = fine.vertices_m;
        const glm::dvec3 n = glm::normalize(glm::cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]));
        const auto number = static_cast<std::uint32_t>(fine.normals.size());
        fine.normals.emplace_back(n);
        fine.corner_normals.push_back({number, number, number});
    }
    const AttributeSeams seams(fine, {});
    const TriangleMesh mesh = seams.with_attributes(simplified(seams.marked(), to_faces(12)).mesh);
    REQUIRE(mesh.corner_normals.size() == 12);
    CHECK(mesh.normals.size() == 6);
    for (std::size_t t = 0; t < 12; ++t) {
        const Triangle& c = mesh.triangles[t];
        const auto& v = mesh.vertices_m;
        const glm::vec3 facing(glm::normalize(glm::cross(v[c[1]] - v[c[0]], v[c[2]] - v[c[0]])));
        for (const std::uint32_t normal : mesh.corner_normals[t]) {
            CHECK(glm::dot(mesh.normals[normal], facing) > 0.999F);
        }
    }
}

TEST_CASE("the same input gives the same bytes, on one thread and on three") {
    const auto check = [](const TriangleMesh& fine, int effort) {
        SimplifyOptions options = to_faces(fine.triangles.size() / 2, effort);
        const Simplified one = simplified(fine, options);
        options.threads = 3;
        const Simplified three = simplified(fine, options);
        CHECK(same_bytes(one.mesh, three.mesh));
        CHECK(one.sequence.collapses.size() == three.sequence.collapses.size());
    };
    check(two_coloured(ring(40, 24)), fast_effort);
    check(two_coloured(ring(8, 6)), surface_effort);
    check(ball(8), surface_effort);
}

TEST_CASE("an optimization lessens the distance and turns nothing over") {
    const TriangleMesh fine = ball(40);
    const CollapseSequence sequence = fast_sequence(fine, to_faces(200, fast_effort));
    const TriangleMesh coarse = mesh_after(sequence, sequence.collapses.size());
    const TriangleMesh fitted = optimized(coarse, fine, {});
    CHECK(fitted.triangles.size() == coarse.triangles.size());
    CHECK(is_manifold(fitted));
    CHECK(apart(fine, fitted).rms_m() < 0.9 * apart(fine, coarse).rms_m());
    for (const Triangle& t : fitted.triangles) {
        const auto& v = fitted.vertices_m;
        const glm::dvec3 normal = glm::cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]);
        CHECK(glm::dot(normal, v[t[0]]) > 0.0);
    }
}

TEST_CASE("a cylinder's side goes down to strips without leaving the surface") {
    TriangleMesh tube; // 48 strips of 40 fields, as long as it is round
    constexpr std::uint32_t around = 48;
    constexpr std::uint32_t along = 40;
    for (std::uint32_t ring = 0; ring <= along; ++ring) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const double angle = 6.283185307179586 * i / around;
            tube.vertices_m.emplace_back(std::cos(angle), std::sin(angle), 6.0 * ring / along);
        }
    }
    for (std::uint32_t ring = 0; ring < along; ++ring) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t a = ring * around + i;
            const std::uint32_t b = ring * around + (i + 1) % around;
            tube.triangles.push_back({a, b, b + around});
            tube.triangles.push_back({a, b + around, a + around});
        }
    }
    SimplifyOptions options;
    options.goal.faces = 4 * around;
    const Simplified result = simplified(tube, options);
    CHECK(result.mesh.triangles.size() <= 4 * around);
    CHECK(apart(tube, result.mesh).max_hausdorff_m() < 1e-3);
}

TEST_CASE("closed shapes stay closed, of their genus, and no farther off than by plain passes") {
    const auto made_to = [](const TriangleMesh& fine, std::size_t faces, int effort) {
        const TriangleMesh made = simplified(fine, to_faces(faces, effort)).mesh;
        CHECK(made.triangles.size() <= faces);
        const measure::MeshDefects before = measure::defects(fine);
        REQUIRE(before.genus.has_value());
        measure::MeshDefects expected;
        expected.shells = 1;
        expected.genus = before.genus;
        expected.euler_characteristic = before.euler_characteristic;
        CHECK(measure::defects(made) == expected);
        CHECK(measure::flipped_area_share(made, fine, 0.0, {.samples = 20'000}) < 0.0005);
        const measure::MeshDistance far = apart(fine, made);
        return far.max_hausdorff_m() * far.rms_m();
    };
    const auto check = [&](const TriangleMesh& fine, std::size_t part) {
        const std::size_t faces = fine.triangles.size() / part;
        INFO(fine.triangles.size() << " to " << faces);
        CHECK(made_to(fine, faces, surface_effort) <= 1.05 * made_to(fine, faces, fast_effort));
    };
    check(ring(16, 8), 3);
    check(machined_part(12), 10);
}

TEST_CASE("where no edge can collapse any more the result is not folded") {
    // A square plate with four square holes.
    constexpr int cells = 10;
    const auto is_there = [](int i, int j) {
        return i >= 0 && j >= 0 && i < cells && j < cells && (i / 2 % 2 == 0 || j / 2 % 2 == 0);
    };
    TriangleMesh plate;
    std::map<std::array<int, 3>, std::uint32_t> numbers;
    const auto vertex = [&](const std::array<int, 3>& at) {
        const auto next = static_cast<std::uint32_t>(plate.vertices_m.size());
        const auto [place, is_new] = numbers.try_emplace(at, next);
        if (is_new) { plate.vertices_m.emplace_back(at[0], at[1], at[2]); }
        return place->second;
    };
    const auto add = [&](const std::array<std::array<int, 3>, 4>& corners) {
        const auto [a, b, c, d] = corners;
        plate.triangles.push_back({vertex(a), vertex(b), vertex(c)});
        plate.triangles.push_back({vertex(a), vertex(c), vertex(d)});
    };
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            if (!is_there(i, j)) { continue; }
            add({{{i, j, 1}, {i + 1, j, 1}, {i + 1, j + 1, 1}, {i, j + 1, 1}}});
            add({{{i, j, 0}, {i, j + 1, 0}, {i + 1, j + 1, 0}, {i + 1, j, 0}}});
            if (!is_there(i - 1, j)) { add({{{i, j, 0}, {i, j, 1}, {i, j + 1, 1}, {i, j + 1, 0}}}); }
            if (!is_there(i + 1, j)) { add({{{i + 1, j, 0}, {i + 1, j + 1, 0}, {i + 1, j + 1, 1}, {i + 1, j, 1}}}); }
            if (!is_there(i, j - 1)) { add({{{i, j, 0}, {i + 1, j, 0}, {i + 1, j, 1}, {i, j, 1}}}); }
            if (!is_there(i, j + 1)) { add({{{i, j + 1, 0}, {i, j + 1, 1}, {i + 1, j + 1, 1}, {i + 1, j + 1, 0}}}); }
        }
    }
    SimplifyOptions options = to_faces(1);
    options.keep_topology = true;
    const TriangleMesh made = simplified(plate, options).mesh;
    CHECK(is_manifold(made));
    CHECK(euler_number(made) == -6);
    CHECK(made.triangles.size() <= 120); // 100 are needed for the plate itself.
    CHECK(measure::flipped_area_share(made, plate, 0.0, {.samples = 20'000}) < 0.003);
}

TEST_CASE("next to nothing of a thin sheet's surface is turned over") {
    TriangleMesh fine = ring(24, 8);
    for (glm::dvec3& v : fine.vertices_m) { v.z = 0.2 * v.z + 0.3 * std::sin(2.0 * std::atan2(v.y, v.x)); }
    const TriangleMesh made = simplified(fine, to_faces(100)).mesh;
    CHECK(is_manifold(made));
    CHECK(boundary_edges(made) == 0);
    CHECK(euler_number(made) == 0);
    // By quadrics alone it is 0.013.
    CHECK(measure::flipped_area_share(made, fine, 0.0, {.samples = 20'000}) < 0.0115);
}

TEST_CASE("a mesh that is sorted in space is the same surface with the same attributes") {
    TriangleMesh mesh = ball(12);
    for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
        mesh.colours.emplace_back(static_cast<float>(i) / 1000.0F, 0.5F, 0.25F);
    }
    mesh.materials.resize(mesh.triangles.size());
    for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
        mesh.texture_coordinates.emplace_back(static_cast<float>(face), 0.0F);
        mesh.corner_texture_coordinates.push_back({face, face, face});
        mesh.triangle_materials.push_back(face);
    }
    using Corner = std::array<double, 4>;
    using Face = std::tuple<std::array<Corner, 3>, float, std::uint32_t>;
    const auto faces = [](const TriangleMesh& of) {
        std::vector<Face> all;
        for (std::size_t i = 0; i < of.triangles.size(); ++i) {
            Face face;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = of.triangles[i][k];
                const glm::dvec3& at = of.vertices_m[vertex];
                std::get<0>(face)[k] = {at.x, at.y, at.z, of.colours[vertex].x};
            }
            std::get<1>(face) = of.texture_coordinates[of.corner_texture_coordinates[i][0]].x;
            std::get<2>(face) = of.triangle_materials[i];
            all.push_back(face);
        }
        std::ranges::sort(all);
        return all;
    };
    TriangleMesh sorted = mesh;
    sort_spatially(sorted);
    CHECK(sorted.triangles != mesh.triangles);
    CHECK(faces(sorted) == faces(mesh));
}

namespace {

void add_part(TriangleMesh& mesh, const TriangleMesh& part, double x_m) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const glm::dvec3& vertex_m : part.vertices_m) {
        mesh.vertices_m.push_back(vertex_m + glm::dvec3(x_m, 0.0, 0.0));
    }
    for (const auto& [a, b, c] : part.triangles) { mesh.triangles.push_back({a + first, b + first, c + first}); }
}

void add_ball(TriangleMesh& mesh, double scale, double x_m) {
    TriangleMesh one = ball(8);
    for (glm::dvec3& vertex_m : one.vertices_m) { vertex_m *= scale; }
    add_part(mesh, one, x_m);
}

/// Balls side by side, each half as large as the one before.
TriangleMesh balls(int count) {
    TriangleMesh mesh;
    double scale = 1.0;
    for (int i = 0; i < count; ++i, scale *= 0.5) { add_ball(mesh, scale, 4.0 * i); }
    return mesh;
}

/// Takes a triangle away that shares no vertex with one taken before.
Triangle take_triangle(TriangleMesh& mesh, std::mt19937& random, std::set<std::uint32_t>& used) {
    while (true) {
        const auto place = static_cast<std::ptrdiff_t>(random() % mesh.triangles.size());
        const Triangle taken = mesh.triangles[static_cast<std::size_t>(place)];
        if (std::ranges::none_of(taken, [&](std::uint32_t v) { return used.contains(v); })) {
            used.insert(taken.begin(), taken.end());
            mesh.triangles.erase(mesh.triangles.begin() + place);
            return taken;
        }
    }
}

/// Parts with tubes between triangles, which are handles where they join a part with itself, and so many holes of three
/// edges.
TriangleMesh riddled(std::mt19937& random, std::size_t parts, std::size_t tubes, std::size_t holes) {
    TriangleMesh mesh;
    for (std::size_t part = 0; part < parts; ++part) {
        add_part(mesh, random() % 2 == 0 ? ball(12) : ring(14, 10), 1.5 * static_cast<double>(part));
    }
    std::set<std::uint32_t> used;
    for (std::size_t i = 0; i < tubes; ++i) {
        const auto [a, b, c] = take_triangle(mesh, random, used);
        const auto [d, e, f] = take_triangle(mesh, random, used);
        for (const Triangle side : {Triangle{a, b, f}, {a, f, d}, {b, c, e}, {b, e, f}, {c, a, d}, {c, d, e}}) {
            mesh.triangles.push_back(side);
        }
    }
    for (std::size_t i = 0; i < holes; ++i) { take_triangle(mesh, random, used); }
    return mesh;
}

} // namespace

TEST_CASE("a goal that all shells cannot reach drops the smallest ones, unless they are kept") {
    SimplifyOptions options;
    options.goal.faces = 12;
    const Simplified fewer = simplified(balls(4), options);
    CHECK(fewer.mesh.triangles.size() <= 12);
    CHECK(fewer.shells_removed == 1);
    CHECK(euler_number(fewer.mesh) == 6); // three closed shells are left
    INFO("the two largest ones alone, at the same number of triangles, are farther off");
    const TriangleMesh two = simplified(balls(2), options).mesh;
    REQUIRE(two.triangles.size() <= 12);
    const auto off = [](const TriangleMesh& mesh) {
        return measure::distance(balls(4), mesh, {.tightness = 1.1, .samples = 20'000});
    };
    CHECK(off(fewer.mesh).max_hausdorff_m() < off(two).min_hausdorff_m());
    CHECK(off(fewer.mesh).rms_m() < 0.5 * off(two).rms_m());
    options.keep_shells = true;
    const Simplified all = simplified(balls(4), options);
    CHECK(all.shells_removed == 0);
    CHECK(all.mesh.triangles.size() == 16);
    options.keep_shells = false;
    options.goal.faces = 200;
    CHECK(simplified(balls(4), options).shells_removed == 0);
}

TEST_CASE("of shells that must go those go that lie by others, small ones far off stay") {
    TriangleMesh mesh;
    add_ball(mesh, 1.0, 0.0);
    add_ball(mesh, 0.97, 0.0); // within the first
    add_ball(mesh, 0.3, 9.0);
    SimplifyOptions options;
    options.goal.faces = 10;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.shells_removed == 1);
    CHECK(std::ranges::any_of(fewer.mesh.vertices_m, [](const glm::dvec3& vertex_m) { return vertex_m.x > 8.0; }));
}

TEST_CASE("parts above a dense mesh do not vanish where another step costs less") {
    const TriangleMesh fine = hills_with_boxes(20, 0.03);
    SimplifyOptions options;
    options.goal.faces = 140;
    for (const int effort : {0, 4}) {
        options.effort = effort;
        const Simplified fewer = simplified(fine, options);
        CHECK(fewer.mesh.triangles.size() <= 140);
        CHECK(fewer.shells_removed == 0);
        CHECK(measure::distance(fine, fewer.mesh, {.samples = 0}).max_hausdorff_m() < 0.1);
    }
}

TEST_CASE("a part that is far from all others does not vanish, whatever the goal") {
    TriangleMesh mesh;
    add_part(mesh, cube(1), 0.0);
    add_part(mesh, cube(1), 100.0);
    SimplifyOptions options;
    options.goal.faces = 4;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.shells_removed == 0);
    CHECK(fewer.mesh.triangles.size() == 8);
}

TEST_CASE("of very many shells that cannot collapse the goal's number stays, spread over all") {
    TriangleMesh mesh; // of 200 tetrahedra in a row, each a little smaller than the one before
    for (std::uint32_t i = 0; i < 200; ++i) {
        const double size_m = 1.0 - 0.002 * i;
        const glm::dvec3 at_m(4.0 * i, 0.0, 0.0);
        const std::uint32_t first = 4 * i;
        for (const glm::dvec3 corner : {glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}) {
            mesh.vertices_m.push_back(at_m + size_m * corner);
        }
        for (const auto& [a, b, c] : {Triangle{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
            mesh.triangles.push_back({first + a, first + b, first + c});
        }
    }
    SimplifyOptions options;
    options.goal.faces = 80;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.mesh.triangles.size() <= 80);
    CHECK(fewer.shells_removed >= 180);
    // The largest ones all stand on one side.
    CHECK(std::ranges::any_of(fewer.mesh.vertices_m, [](const glm::dvec3& vertex_m) { return vertex_m.x > 700.0; }));
}

TEST_CASE("pinholes close, and thin handles go, where a goal needs it; neither where they are kept") {
    std::mt19937 random(7);
    const TriangleMesh fine = riddled(random, 1, 2, 12);
    REQUIRE(measure::defects(fine).boundary_loops == 12);
    SimplifyOptions options;
    options.goal.faces = 24;
    const Simplified fewer = simplified(fine, options);
    CHECK(fewer.mesh.triangles.size() <= 24);
    CHECK(fewer.holes_closed + measure::defects(fewer.mesh).boundary_loops == 12);
    CHECK(fewer.holes_closed >= 10);
    CHECK(fewer.handles_cut >= 1);
    CHECK(fewer.sequence.collapses.empty());
    options.keep_topology = true;
    const Simplified same = simplified(fine, options);
    CHECK(same.holes_closed == 0);
    CHECK(same.handles_cut == 0);
    CHECK(measure::defects(same.mesh).boundary_loops == 12);
    CHECK(euler_number(same.mesh) == euler_number(fine));
}

TEST_CASE("an error keeps its bound where holes close, and closed holes stay in the record") {
    std::mt19937 random(3);
    const TriangleMesh fine = riddled(random, 1, 0, 20);
    SimplifyOptions options;
    options.goal.error_m = 0.15;
    const Simplified result = simplified(fine, options);
    CHECK(result.holes_closed > 0);
    CHECK(result.holes_closed + measure::defects(result.mesh).boundary_loops == 20);
    CHECK(measure::distance(fine, result.mesh, {}).max_hausdorff_m() <= 0.15);
}

TEST_CASE("meshes with random holes, handles and parts stay manifolds, and closed ones closed") {
    std::mt19937 random(11);
    for (int i = 0; i < 8; ++i) {
        const std::size_t holes = i % 2 == 0 ? 0 : 2 + random() % 8;
        const std::size_t tubes = random() % 5;
        const TriangleMesh fine = riddled(random, 1 + random() % 3, tubes, holes);
        SimplifyOptions options;
        options.goal.faces = 12 + random() % 200;
        options.effort = static_cast<int>(random() % 3);
        options.keep_shells = random() % 2 == 0;
        INFO("mesh " << i << " to " << *options.goal.faces << " faces, effort " << options.effort);
        const TriangleMesh made = simplified(fine, options).mesh;
        const measure::MeshDefects found = measure::defects(made);
        CHECK(found.non_manifold_edges == 0);
        CHECK(found.non_manifold_vertices == 0);
        CHECK(found.turned_edges == 0);
        CHECK(found.duplicate_faces == 0);
        CHECK(found.boundary_loops <= holes);
        std::set<std::array<double, 3>> places;
        for (const glm::dvec3& vertex_m : made.vertices_m) { places.insert({vertex_m.x, vertex_m.y, vertex_m.z}); }
        CHECK(places.size() == made.vertices_m.size()); // no sides touch where a handle was cut
        options.threads = 3;
        CHECK(same_bytes(simplified(fine, options).mesh, made));
    }
}

TEST_CASE("for a wanted error shells go that lie nearer to others than that, unless they are kept") {
    TriangleMesh mesh;
    add_ball(mesh, 1.0, 0.0);
    add_ball(mesh, 0.97, 0.0); // within the first, 0.03 from it
    add_ball(mesh, 0.3, 9.0);
    SimplifyOptions options;
    options.goal.error_m = 0.12;
    const Simplified fewer = simplified(mesh, options);
    CHECK(fewer.shells_removed == 1);
    CHECK(euler_number(fewer.mesh) == 4);
    CHECK(fewer.steps > 0);
    options.goal.error_m = 0.02;
    CHECK(simplified(mesh, options).shells_removed == 0);
    options.goal.error_m = 0.12;
    options.keep_shells = true;
    CHECK(euler_number(simplified(mesh, options).mesh) == 6);
}
