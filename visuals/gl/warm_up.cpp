#include "visuals/gl/platform_tuning.h"
#include "visuals/gl/renderer.h"

#include <array>
#include <cstdint>
#include <initializer_list>

// A first drawing in every state that a plan can ask for.

namespace octant::visuals::gl {
namespace {

using models::ColourVertex;
using scene::DepthUse;
using scene::FramePlan;
using scene::PaintStep;
using Content = scene::PaintStep::Content;

constexpr std::uint32_t whole = PaintStep::no_clip;

/// A triangle 2 m ahead and its corners, of every kind.
struct Corners {
    std::array<ColourVertex, 3> plain{ColourVertex{{-1.0F, -1.0F, -2.0F}, 0U}, ColourVertex{{1.0F, -1.0F, -2.0F}, 0U},
        ColourVertex{{0.0F, 1.0F, -2.0F}, 0U}};
    std::array<scene::ModelVertex, 3> mesh{scene::ModelVertex{.position_m = plain[0].position_m},
        scene::ModelVertex{.position_m = plain[1].position_m}, scene::ModelVertex{.position_m = plain[2].position_m}};
    std::array<scene::OverlayVertex, 3> overlay{{{{0.0F, 0.0F}, 0U}, {{4.0F, 0.0F}, 0U}, {{0.0F, 4.0F}, 0U}}};
    std::array<std::uint32_t, 3> triangle{0, 1, 2};
};

/// A plan with one of everything and no step. Points into `corners`.
FramePlan plan_of(const Corners& corners) {
    FramePlan plan;
    plan.view_to_clip = glm::mat4(0.0F);
    plan.view_to_clip[0][0] = 1.0F;
    plan.view_to_clip[1][1] = 1.0F;
    plan.view_to_clip[2][3] = -1.0F;
    plan.view_to_clip[3][2] = 0.5F;
    plan.sky = {corners.plain, corners.triangle};
    plan.ground = {corners.plain, corners.triangle};
    plan.repaint_indices = {0, 1, 2};
    plan.clips.push_back({{glm::vec4(1.0F, 0.0F, 0.0F, 0.0F)}, 1});
    plan.overlay = {corners.overlay, corners.triangle};
    return plan;
}

void paint_in_order(FramePlan& plan) {
    const auto aircraft = static_cast<std::uint32_t>(plan.aircraft.size());
    plan.steps = {{Content::Sky, 0, 3}, {Content::Ground, 0, 3}, {Content::GroundRepaint, 0, 3},
        {Content::GroundRepaint, 0, 3, 0}, {Content::Aircraft, 0, aircraft}, {Content::Aircraft, 0, aircraft, 0},
        {Content::Overlay, 0, 3}};
}

void paint_meshes(FramePlan& plan, const Corners& corners) {
    const auto aircraft = static_cast<std::uint32_t>(plan.aircraft.size());
    plan.depth_boxes.push_back({{0, 0}, {1, 1}});
    plan.refined.push_back({corners.mesh, corners.triangle, 0, 0, {}});
    for (const PaintStep& step : std::initializer_list<PaintStep>{{Content::ClearDepth, 0, 1},
             {Content::GroundRepaint, 0, 3, whole, DepthUse::DepthOnly},
             {Content::Aircraft, 0, aircraft, whole, DepthUse::Nearest},
             {Content::Refined, 0, 1, whole, DepthUse::Nearest}}) {
        plan.steps.push_back(step);
    }
}

void paint_by_depth(FramePlan& plan, const glm::ivec2& size_px) {
    const auto aircraft = static_cast<std::uint32_t>(plan.aircraft.size());
    plan.depth_boxes = {{glm::ivec2(0), size_px}};
    plan.steps = {{Content::ClearDepth, 0, 1}, {Content::Aircraft, 0, aircraft, whole, DepthUse::Nearest},
        {Content::Refined, 0, static_cast<std::uint32_t>(plan.refined.size()), whole, DepthUse::Nearest},
        {Content::Ground, 0, 3, whole, DepthUse::Nearest}, {Content::Ground, 0, 3, whole, DepthUse::EdgeOn},
        {Content::GroundRepaint, 0, 3, whole, DepthUse::OnGround}, {Content::Sky, 0, 3, whole, DepthUse::InfinitelyFar},
        {Content::Overlay, 0, 3}};
}

} // namespace

void Renderer::warm_up() {
    const Corners corners;
    FramePlan plan = plan_of(corners);
    if (triangles_.has_texture()) { plan.ground_texture.emplace(); }
    aircraft_.add_one_of_each(plan);
    const auto draw_twice = [&] {
        scene::Picture picture;
        draw(plan);
        draw_inset(plan, {0, 0, framebuffer_.width(), framebuffer_.height()});
        finish_and_read(picture);
    };
    paint_in_order(plan);
    if (aircraft_.has_depth_drawn_meshes()) { paint_meshes(plan, corners); }
    draw_twice();
    paint_by_depth(plan, {framebuffer_.width(), framebuffer_.height()});
    draw_twice();
    spread_raster_threads();
}

} // namespace octant::visuals::gl
