#include "models/colour_vertex.h"
#include "models/texture.h"
#include "models/triangle_mesh.h"
#include "tests/scratch.h"
#include "ui/world/mesh_loader.h"
#include "ui/world/mesh_textures.h"
#include "visuals/planning/refined_aircraft.h"

#include <catch2/catch.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <set>
#include <span>

using namespace octant;
using namespace octant::ui::world;
namespace planning = octant::visuals::planning;
namespace refine = octant::visuals::refine;
namespace scene = octant::visuals::scene;

namespace {

constexpr std::uint32_t cells = 24;
constexpr float seam = 5.0F; ///< x, metres: one picture ends there, another one begins

/// Where a place lies on its picture, as the mesh of this test has it: v upwards.
glm::vec2 on_left(double x, double y) { return {x / 10.0, y / 10.0}; }
glm::vec2 on_right(double x, double y) { return {3.0 - y / 7.0, x / 5.0}; }

/// A waved sheet of 10 x 10 m in the plane z = 0, seen from -z, with a picture on each half.
models::TriangleMesh sheet() {
    models::TriangleMesh mesh;
    mesh.name = "sheet";
    for (const char* name : {"left", "right"}) {
        models::Material material{.name = name, .colour = glm::vec3(1.0F)};
        material.texture.picture =
            std::make_shared<const models::TexturePicture>(models::texture_picture(name, {1, 1, {200, 100, 50, 255}}));
        mesh.materials.push_back(material);
    }
    for (std::uint32_t j = 0; j <= cells; ++j) {
        for (std::uint32_t i = 0; i <= cells; ++i) {
            const double x = 10.0 * i / cells;
            const double y = 10.0 * j / cells;
            mesh.vertices_m.emplace_back(x, y, 0.15 * std::sin(x) * std::cos(1.3 * y));
            mesh.texture_coordinates.push_back(on_left(x, y));
            mesh.texture_coordinates.push_back(on_right(x, y));
        }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t side) {
        mesh.triangles.push_back({a, b, c});
        mesh.corner_texture_coordinates.push_back({2 * a + side, 2 * b + side, 2 * c + side});
        mesh.triangle_materials.push_back(side);
    };
    constexpr std::uint32_t row = cells + 1;
    for (std::uint32_t j = 0; j < cells; ++j) {
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t at = j * row + i;
            const std::uint32_t side = i < cells / 2 ? 0 : 1;
            add(at, at + row, at + 1, side);
            add(at + 1, at + row, at + row + 1, side);
        }
    }
    return mesh;
}

glm::dmat4 below(double away_m) {
    glm::dmat4 body = glm::translate(glm::dmat4(1.0), {0.0, 0.0, -away_m});
    body[1] = -body[1];
    body[2] = -body[2];
    return body;
}

/// How many corners lie elsewhere on their picture than the mesh has them; all corners of a triangle must be on one.
std::size_t misplaced(const scene::RefinedDraw& draw) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < draw.indices.size(); ++i) {
        const scene::ModelVertex& corner = draw.vertices[draw.indices[i]];
        const glm::dvec2 at_m(corner.position_m);
        REQUIRE((corner.texture == 1 || corner.texture == 2));
        REQUIRE(corner.texture == draw.vertices[draw.indices[i - i % 3]].texture);
        const glm::vec2 up = corner.texture == 1 ? on_left(at_m.x, at_m.y) : on_right(at_m.x, at_m.y);
        wrong += glm::distance(corner.on_texture, glm::vec2(up.x, 1.0F - up.y)) > 0.03F ? 1U : 0U;
    }
    return wrong;
}

/// How many corners are on the other side of the seam, by more than 5 cm.
std::size_t beyond_seam(const scene::RefinedDraw& draw) {
    std::size_t beyond = 0;
    for (const std::uint32_t index : draw.indices) {
        const scene::ModelVertex& corner = draw.vertices[index];
        const float by_m = corner.texture == 1 ? corner.position_m.x - seam : seam - corner.position_m.x;
        beyond += by_m > 0.05F ? 1U : 0U;
    }
    return beyond;
}

planning::FrameView looking_down() {
    planning::FrameView view;
    view.frustum.fill(glm::dvec3(0.0, 0.0, -1.0));
    return view;
}

refine::ViewRefinerOptions refining() {
    refine::ViewRefinerOptions options;
    options.error_px = 1.0;
    return options;
}

} // namespace

TEST_CASE("simplified meshes have their pictures where they were, and seams between pictures are not crossed") {
    const RefineMesh made = make_refine_mesh({.file = "sheet", .quiet = true}, sheet());
    REQUIRE(made.textures != nullptr);
    CHECK(made.textures->textures.size() == 2);
    REQUIRE(made.mesh->face_count() == std::size_t{2} * cells * cells);
    std::set<std::size_t> counts;
    for (const double away_m : {150.0, 40.0, 8.0}) {
        planning::RefinedAircraft aircraft(made.mesh, refining(), {}, made.textures);
        aircraft.update(below(away_m), looking_down(), true);
        const scene::RefinedDraw draw = aircraft.draw();
        CHECK(misplaced(draw) == 0);
        CHECK(beyond_seam(draw) == 0);
        counts.insert(draw.indices.size());
    }
    CHECK(counts.size() == 3);
    CHECK(*counts.begin() < made.mesh->face_count()); // less than a third of the triangles
}

TEST_CASE("colours of materials end at their edges however far a mesh is simplified") {
    models::TriangleMesh mesh = sheet();
    mesh.texture_coordinates.clear();
    mesh.corner_texture_coordinates.clear();
    const std::array colours{glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, 0.0F, 1.0F)};
    for (std::size_t side = 0; side < 2; ++side) {
        mesh.materials[side].texture = {};
        mesh.materials[side].colour = colours.at(side);
    }
    models::TriangleMesh other = mesh;
    other.colours.assign(other.vertices_m.size(), colours[0]); // its own, which the file gives
    CHECK(make_refine_mesh({.file = "sheet", .quiet = true}, other).textures == nullptr);
    const RefineMesh made = make_refine_mesh({.file = "sheet", .quiet = true}, mesh);
    REQUIRE(made.textures != nullptr);
    CHECK(made.textures->textures.empty());
    for (const double away_m : {150.0, 8.0}) {
        planning::RefinedAircraft aircraft(made.mesh, refining(), {}, made.textures);
        aircraft.update(below(away_m), looking_down(), true);
        const scene::RefinedDraw draw = aircraft.draw();
        REQUIRE(!draw.indices.empty());
        for (std::size_t i = 0; i < draw.indices.size(); i += 3) {
            const std::span<const std::uint32_t> corners = draw.indices.subspan(i, 3);
            float middle_m = 0.0F;
            for (const std::uint32_t corner : corners) { middle_m += draw.vertices[corner].position_m.x / 3.0F; }
            const std::uint32_t colour = models::packed_colour(colours.at(middle_m < seam ? 0 : 1));
            for (const std::uint32_t corner : corners) { CHECK(draw.vertices[corner].colour == colour); }
        }
    }
}

TEST_CASE("pictures stay where they are on a refined mesh while it changes and its vertices travel") {
    const RefineMesh made = make_refine_mesh({.file = "sheet", .quiet = true}, sheet());
    planning::RefinedAircraft aircraft(made.mesh, refining(), {}, made.textures);
    bool is_first = true;
    std::size_t moving = 0;
    for (const double away_m : {150.0, 40.0, 8.0, 12.0, 100.0}) {
        for (int frame = 0; frame < 12; ++frame) {
            moving += aircraft.update(below(away_m), looking_down(), is_first).moving;
            is_first = false;
            CHECK(misplaced(aircraft.draw()) == 0);
        }
    }
    CHECK(moving > 1000);
}

TEST_CASE("a textured hierarchy comes from the cache as it was made") {
    const std::filesystem::path folder = tests::empty_folder("textured-cache");
    const RefineMeshOptions input{.file = "sheet", .quiet = true};
    const RefineMesh made = cached_refine_mesh(folder, input, sheet());
    const RefineMesh kept = cached_refine_mesh(folder, input, sheet());
    REQUIRE(made.textures != nullptr);
    REQUIRE(kept.textures != nullptr);
    CHECK(kept.textures->first == made.textures->first);
    REQUIRE(kept.textures->places.size() == made.textures->places.size());
    for (std::size_t i = 0; i < kept.textures->places.size(); ++i) {
        CHECK(kept.textures->places[i].chart == made.textures->places[i].chart);
        CHECK(kept.textures->places[i].place == made.textures->places[i].place);
    }
    models::TriangleMesh plain = sheet();
    for (models::Material& material : plain.materials) { material.texture = {}; }
    CHECK(refine_mesh_cache_file(folder, plain) != refine_mesh_cache_file(folder, sheet()));
    CHECK(cached_refine_mesh(folder, input, plain).textures == nullptr);
}
