#include "models/measure/mesh_distance.h"
#include "models/simplify/colour_seams.h"
#include "models/simplify/simplify.h"
#include "tests/models/simplify/simplify_meshes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <set>

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
            for (const std::uint32_t vertex : triangle) {
                height_m += mesh.vertices_m[vertex].z;
            }
            const glm::vec3 colour = height_m > 0.0 ? light : dark;
            corner_colours.push_back({colour, colour, colour});
            for (const std::uint32_t vertex : triangle) {
                mesh.colours[vertex] += colour;
                counts[vertex] += 1.0F;
            }
        }
        for (std::size_t v = 0; v < counts.size(); ++v) {
            mesh.colours[v] /= counts[v];
        }
    }
};

/// The places of all corners, triangle after triangle.
std::vector<glm::dvec3> corner_places_m(const TriangleMesh& mesh) {
    std::vector<glm::dvec3> places_m;
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            places_m.push_back(mesh.vertices_m[vertex]);
        }
    }
    return places_m;
}

} // namespace

TEST_CASE("a mesh whose colours do not break passes as it is") {
    const TriangleMesh fine = cube(3);
    const ColourSeams seams(fine, {});
    CHECK(same_bytes(seams.marked(), fine));
    CHECK(same_bytes(seams.broken(fine), fine));
}

TEST_CASE("unsimplified, each corner gets the colour that the file gave it") {
    TwoHalves halves;
    halves.mesh.materials = {{"a", glm::vec3(0.1F)}, {"b", glm::vec3(0.2F)}};
    for (std::size_t t = 0; t < halves.mesh.triangles.size(); ++t) {
        halves.mesh.triangle_materials.push_back(static_cast<std::uint32_t>(t % 2));
    }
    const ColourSeams seams(halves.mesh, halves.corner_colours);
    const TriangleMesh made = seams.broken(seams.marked());
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
    const ColourSeams seams(halves.mesh, halves.corner_colours);
    for (const int effort : {surface_effort, fast_effort}) {
        SimplifyOptions options;
        options.effort = effort;
        options.goal.faces = 120;
        const TriangleMesh welded = simplified(seams.marked(), options).mesh;
        REQUIRE(boundary_edges(welded) == 0);
        const TriangleMesh made = seams.broken(welded);
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
                return std::ranges::all_of(colours, [&](const glm::vec3& other) {
                    return glm::dot(colour - other, colour - other) < 1e-3F;
                });
            };
            CHECK((is(dark) || is(light)));
            wrong_m2 += is(height_m > 0.0 ? light : dark)
                            ? 0.0
                            : 0.5 * glm::length(area_vector(made, triangle));
        }
        CHECK(wrong_m2 < 0.02 * area_m2(made));
    }
}
