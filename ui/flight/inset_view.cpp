#include "ui/flight/inset_view.h"

#include "ui/world/scene_ground.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace octant::ui::flight {

namespace scene = visuals::scene;

namespace {

constexpr int share_of_side = 3;
constexpr int margin_share = 40; ///< of the picture's height
constexpr int share_of_triangles = 4;
constexpr int fewest_triangles = 1000;

settings::Settings inset_settings(const settings::Settings& settings, const glm::ivec2& size_px) {
    settings::Settings own = settings;
    own.view.kind = *settings.view.inset;
    own.view.inset.reset();
    own.view.size_px = size_px;
    own.view.azimuth_deg = 0.0;
    own.view.elevation_deg = 0.0;
    own.view.zoom = 1.0;
    own.ground.triangles =
        std::max(fewest_triangles, scene::triangle_target(settings) / share_of_triangles);
    return own;
}

std::unique_ptr<scene::Ground>
load_ground_of(const settings::Settings& settings, world::DrawnBy drawn_by) {
    settings::Settings bare = settings; // the texture is the world's
    bare.air.drape.reset();
    bare.air.ground_shading = scene::GroundShading::Vertex;
    world::World world;
    world::load_scene_ground(bare, drawn_by, world);
    return std::move(world.scene.ground);
}

} // namespace

InsetView::InsetView(
    const settings::Settings& settings, const world::World& world, world::DrawnBy drawn_by)
    : drawn_by_(drawn_by) {
    place(settings);
    scene_.ground = load_ground_of(settings_, drawn_by);
    scene_.ground_texture = world.scene.ground_texture;
    scene_.models = world.scene.models;
    scene_.aircraft = world.scene.aircraft;
    scene_.cockpit = world.scene.cockpit;
    planner_.emplace(scene_, settings_);
}

void InsetView::place(const settings::Settings& settings) {
    assert(settings.view.inset);
    const glm::ivec2 size_px = glm::max(settings.view.size_px / share_of_side, glm::ivec2(1));
    const int margin_px = std::min(settings.view.size_px.x, settings.view.size_px.y) / margin_share;
    rectangle_ = {
        settings.view.size_px.x - size_px.x - margin_px,
        settings.view.size_px.y - size_px.y - margin_px,
        size_px.x,
        size_px.y};
    settings_ = inset_settings(settings, size_px);
}

void InsetView::follow(const settings::Settings& settings) {
    planner_.reset();
    place(settings);
    if (scene_.ground->can_follow(world::ground_settings(settings_))) {
        scene_.ground->follow(world::ground_settings(settings_));
    } else {
        scene_.ground = load_ground_of(settings_, drawn_by_);
        settles_ = true;
    }
    planner_.emplace(scene_, settings_);
}

const scene::FramePlan& InsetView::plan(
    const scene::Camera& camera,
    std::span<const sim::AircraftState> states,
    std::optional<double> smooth_share) {
    if (std::exchange(settles_, false)) {
        planner_->settle(camera);
    }
    planner_->set_smooth_share(smooth_share);
    scene::PlanCounts counts;
    return planner_->plan(camera, states, counts);
}

} // namespace octant::ui::flight
