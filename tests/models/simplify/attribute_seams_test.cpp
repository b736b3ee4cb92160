#include "models/measure/mesh_distance.h"
#include "models/simplify/attribute_seams.h"
#include "models/simplify/simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

using namespace octant::models;
using namespace octant::models::simplify;
using namespace octant::tests;

namespace {

const glm::vec3 dark(0.3F, 0.2F, 0.2F);
const glm::vec3 light(0.6F, 0.7F, 0.8F);

/// A ball whose lower half is dark and whose upper half is light, with a hard seam between.
struct TwoHalves {
    TriangleMesh mesh = ball(16);
    std::vector<CornerColours> corner_colours;

    TwoHalves() {
        mesh.colours.assign(mesh.vertices_m.size(), glm::vec3(0.0F));
        std::vector<float> counts(mesh.vertices_m.size(), 0.0F);
        for (const Triangle& triangle : mesh.triangles) {
            double height_m = 0.0;
            for (const std::uint32_t vertex : triangle) { height_m += mesh.vertices_m[vertex].z; }
            const glm::vec3 colour = height_m > 0.0 ? light : dark;
            corner_colours.push_back({colour, colour, colour});
            for (const std::uint32_t vertex : triangle) {
                mesh.colours[vertex] += colour;
                counts[vertex] += 1.0F;
            }
        }
        for (std::size_t v = 0; v < counts.size(); ++v) { mesh.colours[v] /= counts[v]; }
    }
};

/// The places of all corners, triangle after triangle.
std::vector<glm::dvec3> corner_places_m(const TriangleMesh& mesh) {
    std::vector<glm::dvec3> places_m;
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) { places_m.push_back(mesh.vertices_m[vertex]); }
    }
    return places_m;
}

} // namespace

TEST_CASE("a mesh whose colours do not break passes as it is") {
    const TriangleMesh fine = cube(3);
    const AttributeSeams seams(fine, {});
    CHECK(same_bytes(seams.marked(), fine));
    CHECK(same_bytes(seams.with_attributes(fine), fine));
}

TEST_CASE("unsimplified, each corner gets the colour that the file gave it") {
    TwoHalves halves;
    halves.mesh.materials = {{"a", glm::vec3(0.1F)}, {"b", glm::vec3(0.2F)}};
    for (std::size_t t = 0; t < halves.mesh.triangles.size(); ++t) {
        halves.mesh.triangle_materials.push_back(static_cast<std::uint32_t>(t % 2));
    }
    const AttributeSeams seams(halves.mesh, halves.corner_colours);
    const TriangleMesh made = seams.with_attributes(seams.marked());
    CHECK(corner_places_m(made) == corner_places_m(halves.mesh));
    CHECK(made.triangle_materials == halves.mesh.triangle_materials);
    CHECK(made.materials.size() == 2);
    CHECK(made.vertices_m.size() > halves.mesh.vertices_m.size());
    for (std::size_t t = 0; t < made.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 off = made.colours[made.triangles[t][k]] - halves.corner_colours[t][k];
            CHECK(glm::dot(off, off) < 1e-10F);
        }
    }
}

TEST_CASE("simplified, no triangle mixes the colours of a seam's sides, and no crack opens") {
    const TwoHalves halves;
    const AttributeSeams seams(halves.mesh, halves.corner_colours);
    for (const int effort : {surface_effort, fast_effort}) {
        SimplifyOptions options;
        options.effort = effort;
        options.goal.faces = 120;
        const TriangleMesh welded = simplified(seams.marked(), options).mesh;
        REQUIRE(boundary_edges(welded) == 0);
        const TriangleMesh made = seams.with_attributes(welded);
        CHECK(corner_places_m(made) == corner_places_m(welded));
        CHECK(made.materials.empty());
        CHECK(made.triangle_materials.empty());
        double wrong_m2 = 0.0;
        for (const Triangle& triangle : made.triangles) {
            std::array<glm::vec3, 3> colours{};
            double height_m = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                colours.at(k) = made.colours[triangle.at(k)];
                height_m += made.vertices_m[triangle.at(k)].z / 3.0;
            }
            const auto is = [&](const glm::vec3& colour) {
                return std::ranges::all_of(
                    colours, [&](const glm::vec3& other) { return glm::dot(colour - other, colour - other) < 1e-3F; });
            };
            CHECK((is(dark) || is(light)));
            wrong_m2 += is(height_m > 0.0 ? light : dark) ? 0.0 : 0.5 * glm::length(area_vector(made, triangle));
        }
        CHECK(wrong_m2 < 0.02 * area_m2(made));
    }
}

namespace {

constexpr double full_turn = 6.283185307179586;

/// The mantle of a cylinder around z, of radius and height 1, whose texture coordinates go once around it: u breaks
/// where the turn begins, v is the height.
TriangleMesh mantle(std::uint32_t columns, std::uint32_t rows) {
    TriangleMesh mesh;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const double turn = static_cast<double>(column) / columns;
            const double height = static_cast<double>(row) / rows;
            mesh.texture_coordinates.emplace_back(turn, height);
            if (column < columns) {
                mesh.vertices_m.emplace_back(std::cos(full_turn * turn), std::sin(full_turn * turn), height);
            }
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const auto vertex = [&](std::uint32_t right, std::uint32_t up) {
                return (row + up) * columns + (column + right) % columns;
            };
            const auto place = [&](std::uint32_t right, std::uint32_t up) {
                return (row + up) * (columns + 1) + column + right;
            };
            mesh.triangles.push_back({vertex(0, 0), vertex(1, 0), vertex(1, 1)});
            mesh.triangles.push_back({vertex(0, 0), vertex(1, 1), vertex(0, 1)});
            mesh.corner_texture_coordinates.push_back({place(0, 0), place(1, 0), place(1, 1)});
            mesh.corner_texture_coordinates.push_back({place(0, 0), place(1, 1), place(0, 1)});
        }
    }
    return mesh;
}

/// A square of side 1 in x and y with the texture coordinates (x * x, y).
TriangleMesh bent_picture(std::uint32_t side) {
    TriangleMesh mesh;
    for (std::uint32_t y = 0; y <= side; ++y) {
        for (std::uint32_t x = 0; x <= side; ++x) {
            const glm::dvec2 at(static_cast<double>(x) / side, static_cast<double>(y) / side);
            mesh.vertices_m.emplace_back(at.x, at.y, 0.0);
            mesh.texture_coordinates.emplace_back(at.x * at.x, at.y);
        }
    }
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t at = y * (side + 1) + x;
            mesh.triangles.push_back({at, at + 1, at + side + 2});
            mesh.triangles.push_back({at, at + side + 2, at + side + 1});
        }
    }
    mesh.corner_texture_coordinates = mesh.triangles;
    return mesh;
}

} // namespace

TEST_CASE("texture coordinates of a seam that meets itself stay right on both of its sides") {
    const AttributeSeams seams(mantle(48, 12), {});
    CHECK(seams.marked().texture_coordinates.empty());
    CHECK(seams.marked().materials.size() == 2); // The mantle is cut once more, across the seam.
    SimplifyOptions options;
    options.effort = fast_effort;
    options.goal.faces = 60;
    const TriangleMesh welded = simplified(seams.marked(), options).mesh;
    const TriangleMesh made = seams.with_attributes(welded);
    REQUIRE(made.triangles.size() == welded.triangles.size());
    CHECK(made.materials.empty());
    CHECK(made.vertices_m == welded.vertices_m); // No vertex is doubled for texture coordinates.
    REQUIRE(made.corner_texture_coordinates.size() == made.triangles.size());
    bool has_begin = false;
    bool has_end = false;
    for (std::size_t t = 0; t < made.triangles.size(); ++t) {
        float min_u = 2.0F;
        float max_u = -1.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& at_m = made.vertices_m[made.triangles[t][k]];
            const glm::vec2& place = made.texture_coordinates[made.corner_texture_coordinates[t][k]];
            const double turn = std::atan2(at_m.y, at_m.x) / full_turn;
            const double off = static_cast<double>(place.x) - turn;
            CHECK(std::abs(off - std::round(off)) < 0.02);
            CHECK(std::abs(static_cast<double>(place.y) - at_m.z) < 0.02);
            min_u = std::min(min_u, place.x);
            max_u = std::max(max_u, place.x);
        }
        CHECK(max_u - min_u < 0.5F); // No triangle shows the whole picture back to front.
        has_begin = has_begin || min_u < 0.01F;
        has_end = has_end || max_u > 0.99F;
    }
    CHECK(has_begin);
    CHECK(has_end);
    CHECK(seams.errors(welded).texture.max < 0.05);
}

TEST_CASE("unsimplified, each corner has the texture coordinates of the file, darts too") {
    TriangleMesh mesh = bent_picture(6);
    // A dart: the picture breaks along the edges from (0.5, 0) up to the middle, where it ends.
    mesh.texture_coordinates.insert(mesh.texture_coordinates.end(), {{0.9F, 0.0F}, {0.8F, 0.2F}});
    const std::uint32_t low = 3;
    const std::uint32_t high = 10;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        double middle_x = 0.0;
        for (const std::uint32_t vertex : mesh.triangles[t]) { middle_x += mesh.vertices_m[vertex].x / 3.0; }
        for (std::uint32_t& corner : mesh.corner_texture_coordinates[t]) {
            const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
            corner = middle_x > 0.5 && corner == low ? first : middle_x > 0.5 && corner == high ? first + 1 : corner;
        }
    }
    const AttributeSeams seams(mesh, {});
    const TriangleMesh made = seams.with_attributes(seams.marked());
    for (std::size_t t = 0; t < made.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec2 off = made.texture_coordinates[made.corner_texture_coordinates[t][k]] -
                                  mesh.texture_coordinates[mesh.corner_texture_coordinates[t][k]];
            CHECK(glm::length(off) < 1e-6F);
        }
    }
    CHECK(seams.errors(seams.marked()).texture.max < 1e-6);
}

TEST_CASE("triangles are divided in their plane until texture coordinates keep their bound") {
    const AttributeSeams seams(bent_picture(32), {});
    SimplifyOptions options;
    options.effort = fast_effort;
    options.goal.faces = 2;
    const TriangleMesh welded = simplified(seams.marked(), options).mesh;
    REQUIRE(welded.triangles.size() == 2);
    // Straight from 0 to 1 instead of x * x: off by 1/4 at the middle.
    CHECK(seams.errors(welded).texture.max == Approx(0.25).margin(0.01));
    constexpr double bound = 0.02;
    const TriangleMesh divided = seams.divided(welded, {.texture = bound}, 4'000);
    CHECK(divided.triangles.size() > 8);
    CHECK(divided.triangles.size() < 200);
    CHECK(area_m2(divided) == Approx(area_m2(welded)));
    CHECK(boundary_edges(divided) < divided.triangles.size());
    const TriangleMesh made = seams.with_attributes(divided);
    for (std::size_t t = 0; t < made.triangles.size(); ++t) {
        glm::dvec3 middle_m(0.0);
        double u = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle_m += made.vertices_m[made.triangles[t][k]] / 3.0;
            u += static_cast<double>(made.texture_coordinates[made.corner_texture_coordinates[t][k]].x) / 3.0;
        }
        CHECK(std::abs(u - middle_m.x * middle_m.x) < bound + 1e-3);
    }
    CHECK(seams.divided(welded, {.texture = bound}, 6).triangles.size() <= 7);
}

TEST_CASE("triangles are divided until normals and colours keep their bounds") {
    TriangleMesh mesh = bent_picture(32);
    mesh.corner_normals = mesh.triangles;
    for (const glm::vec2& place : mesh.texture_coordinates) { // Its u is x * x.
        mesh.normals.emplace_back(std::sin(place.x), 0.0F, std::cos(place.x));
        mesh.colours.emplace_back(place.x, 0.5F, 0.5F);
    }
    mesh.texture_coordinates.clear();
    mesh.corner_texture_coordinates.clear();
    const AttributeSeams seams(mesh, {});
    SimplifyOptions options;
    options.effort = fast_effort;
    options.goal.faces = 2;
    options.colour_weight = 0.0;
    const TriangleMesh welded = simplified(seams.marked(), options).mesh;
    REQUIRE(welded.triangles.size() == 2);
    // At the middle 0.5 rad instead of 0.25 rad.
    CHECK(seams.errors(welded).normal_deg.max == Approx(14.3).margin(0.6));
    const TriangleMesh by_normals = seams.divided(welded, {.normal_deg = 2.0}, 4'000);
    CHECK(seams.errors(by_normals).normal_deg.max <= 2.0);
    CHECK(by_normals.triangles.size() < 100);
    CHECK(seams.with_attributes(by_normals).corner_normals.size() == by_normals.triangles.size());
    const TriangleMesh by_colours = seams.divided(welded, {.colour = 0.02}, 4'000);
    CHECK(seams.errors(by_colours).colour.max <= 0.02);
    CHECK(by_colours.triangles.size() > 8);
    const TriangleMesh made = seams.with_attributes(by_colours);
    for (std::size_t v = 0; v < made.vertices_m.size(); ++v) {
        const double x = made.vertices_m[v].x;
        CHECK(std::abs(static_cast<double>(made.colours[v].x) - x * x) < 1e-3);
    }
}

TEST_CASE("a locked border keeps all its vertices to the bit") {
    TriangleMesh mesh = bent_picture(16);
    mesh.texture_coordinates.clear();
    mesh.corner_texture_coordinates.clear();
    for (glm::dvec3& at_m : mesh.vertices_m) {
        at_m = {523'417.3 + 71.7 * at_m.x, 91.3 * at_m.y, 3.1 * std::sin(7.0 * at_m.x + at_m.y)};
    }
    const auto border_of = [](const TriangleMesh& of) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
        for (const Triangle& triangle : of.triangles) {
            for (std::size_t k = 0; k < 3; ++k) { sides.emplace(triangle[k], triangle[(k + 1) % 3]); }
        }
        std::set<std::array<double, 3>> places;
        for (const auto& [from, to] : sides) {
            if (!sides.contains({to, from})) {
                const glm::dvec3& at_m = of.vertices_m[from];
                places.insert({at_m.x, at_m.y, at_m.z});
            }
        }
        return places;
    };
    REQUIRE(border_of(mesh).size() == 64);
    for (const int effort : {surface_effort, fast_effort}) {
        SimplifyOptions options;
        options.effort = effort;
        options.goal.faces = 100;
        options.lock_border = true;
        options.keep_shells = true;
        const TriangleMesh made = simplified(mesh, options).mesh;
        CHECK(made.triangles.size() <= 100);
        CHECK(border_of(made) == border_of(mesh));
    }
}
