#include "tests/visuals/gl/small_scene.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace octant;
using namespace octant::tests;

namespace {

constexpr int wide_px = 256;

/// Two triangles of a slope that reaches from below the eye to far away.
std::vector<models::ColourVertex> slope(float tilt) {
    const std::array<glm::vec2, 4> corners{glm::vec2(-900.0F, -3.0F), glm::vec2(1100.0F, -3.0F),
        glm::vec2(1300.0F, -4000.0F), glm::vec2(-700.0F, -4000.0F)};
    std::vector<models::ColourVertex> vertices;
    for (const glm::vec2& corner : corners) {
        const float up = -5.0F + tilt * corner.x + 0.02F * corner.y;
        vertices.push_back({glm::vec3(corner.x, up, corner.y), models::packed_colour(green)});
    }
    return vertices;
}

/// A point of the slope's first or second triangle.
glm::vec3 on_slope(const std::vector<models::ColourVertex>& corners, std::size_t second, float b, float c) {
    const glm::vec3& origin = corners[0].position_m;
    return origin + b * (corners[1 + second].position_m - origin) + c * (corners[2 + second].position_m - origin);
}

} // namespace

// The pieces of a shadow have other corners than the ground they lie on: drawn by depth alone they would flicker
// through it. Triangles of all sizes, near and far, in the plane of a slope.
TEST_CASE("with depth a shadow lies on the ground without a hole") {
    Studio studio(gl::make_osmesa_context(), 1, wide_px, wide_px);
    for (const float tilt : {0.0F, 0.01F, -0.3F}) {
        const std::vector<models::ColourVertex> ground = slope(tilt);
        const std::array<std::uint32_t, 6> indices{0, 1, 2, 0, 2, 3};
        scene::FramePlan plan = empty_plan();
        plan.ground = {ground, indices};
        for (int i = 0; i < 400; ++i) {
            const std::size_t second = i % 2 == 0 ? 0 : 1;
            const float c = 0.9F * std::fmod(0.618F * static_cast<float>(i), 1.0F) * 0.5F;
            const float b = 0.9F * std::fmod(0.414F * static_cast<float>(i), 1.0F) * (1.0F - c);
            const float size = 0.002F + 0.0002F * static_cast<float>(i);
            for (const glm::vec2 aside :
                {glm::vec2(0.0F), glm::vec2(size, 0.1F * size), glm::vec2(0.3F * size, size)}) {
                plan.repaint_indices.push_back(static_cast<std::uint32_t>(4 + plan.shadow_vertices.size()));
                plan.shadow_vertices.push_back(
                    {on_slope(ground, second, b + aside.x, c + aside.y), models::packed_colour(red)});
            }
        }
        const auto shadows = static_cast<std::uint32_t>(plan.repaint_indices.size());
        const scene::Picture by_depth = studio.picture(plan, HiddenSurfaceMode::ByDepth, static_cast<int>(shadows));
        // The same painted: ground, then shadows.
        plan.steps = {{scene::PaintStep::Content::GroundRepaint, 0, shadows}};
        const scene::Picture over = studio.picture(plan);
        CHECK(count_of(over, red_px) > 1000);
        CHECK(count_of(over, green_px) > 1000);
        CHECK((by_depth.rgba == over.rgba));
    }
}

TEST_CASE("a shadow is hidden by ground and aircraft in front of it") {
    Studio studio;
    load_squares(studio);
    Triangles ground;
    ground.add({-1.0F, -1.0F, 0.0F, 1.0F}, 10.0F, green).add({}, 10.1F, blue);
    Triangles shadow;
    shadow.add({-0.5F, -0.5F, 0.5F, 0.5F}, 10.1F, grey);
    scene::FramePlan plan = plan_of(ground);
    plan.shadow_vertices = shadow.vertices;
    for (const std::uint32_t corner : shadow.indices) { plan.repaint_indices.push_back(corner + 8); }
    CHECK(count_of(studio.picture(plan, HiddenSurfaceMode::ByDepth, 6), grey_px) == 16 * 32);
    add_square(plan, 0, ahead(10.09F));
    CHECK(middle(studio.picture(plan, HiddenSurfaceMode::ByDepth, 6)) == red_px);
}
