#include "tests/visuals/raster/flat_plan.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <memory>

namespace octant::visuals::raster {

namespace {

constexpr glm::ivec2 phong_size_px{65, 65};
constexpr glm::ivec2 middle_px{32, 32};

/// One square polygon that fills the picture, whose normals at the corners lean outwards by 60 degrees, before an eye
/// with the sun behind it.
struct LeaningNormals {
    scene::ModelBuffers model;
    scene::FramePlan plan;

    LeaningNormals() {
        add_square(model, 10.0F, -10.0F, 0xff404040U);
        for (scene::ModelVertex& vertex : model.vertices) {
            vertex.normal = glm::vec3(std::sqrt(3.0F) / 2.0F * glm::normalize(glm::vec2(vertex.position_m)), 0.5F);
        }
        plan = FlatPlan(phong_size_px).plan();
        plan.to_sun = glm::vec3(0.0F, 0.0F, 1.0F);
        plan.ambient = glm::vec3(0.25F);
        plan.sunlight = glm::vec3(0.5F);
        plan.parts = {glm::mat4(1.0F)};
        plan.smooth = {1U};
        plan.aircraft.push_back({.model = 0, .first_index = 0, .index_count = 6});
        plan.steps.push_back({scene::PaintStep::Content::Aircraft, 0, 1});
    }

    scene::Picture picture(int samples, int threads = 1) const {
        return drawn(plan, phong_size_px, samples, threads, nullptr, std::span(&model, 1));
    }
};

constexpr float own_level = 64.0F;

} // namespace

TEST_CASE("light in each pixel follows the normal between the corners and shines towards the eye") {
    LeaningNormals square;
    // Gouraud: every corner has the cosine 1/2, and so has everything between.
    const int dim = static_cast<int>(std::lround(own_level * (0.25F + 0.5F * 0.5F)));
    CHECK(pixel(square.picture(1), middle_px.x, middle_px.y).x == Approx(dim).margin(1));
    square.plan.lights_pixels = true;
    // Between opposite corners the normal points at the eye and the sun.
    const int bright =
        static_cast<int>(std::lround(own_level * (0.25F + 0.5F) + 255.0F * 0.5F * scene::Highlight::share));
    for (const int samples : {1, 4, 16}) {
        const scene::Picture picture = square.picture(samples);
        CHECK(pixel(picture, middle_px.x, middle_px.y).x == Approx(bright).margin(1));
        // Away from there the highlight is gone and the light as at the corner.
        CHECK(pixel(picture, 2, 2).x == Approx(dim).margin(3));
    }
}

TEST_CASE("flat polygons stay flat where pixels are lit, and what faces away from the sun is dark") {
    LeaningNormals square;
    square.plan.lights_pixels = true;
    square.plan.smooth = {0U};
    const int flat = static_cast<int>(std::lround(own_level * 0.75F));
    CHECK(pixel(square.picture(16), middle_px.x, middle_px.y).x == flat);
    CHECK(pixel(square.picture(16), 5, 20).x == flat);
    square.plan.smooth = {1U};
    square.plan.to_sun = glm::vec3(0.0F, 0.0F, -1.0F);
    CHECK(pixel(square.picture(16), middle_px.x, middle_px.y).x == 16);
}

TEST_CASE("light in each pixel is the same by depth and on any number of threads") {
    LeaningNormals square;
    square.plan.lights_pixels = true;
    const scene::Picture one = square.picture(16);
    CHECK(square.picture(16, 3).rgba == one.rgba);
    square.plan.depth_boxes = {{glm::ivec2(0), phong_size_px}};
    square.plan.steps = {{scene::PaintStep::Content::ClearDepth, 0, 1},
        {scene::PaintStep::Content::Aircraft, 0, 1, scene::PaintStep::no_clip, scene::DepthUse::Nearest}};
    CHECK(square.picture(16).rgba == one.rgba);
    CHECK(square.picture(1).rgba.size() == one.rgba.size());
}

} // namespace octant::visuals::raster
