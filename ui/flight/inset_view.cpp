#include "ui/flight/inset_view.h"

#include "visuals/landscape/ground.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>

namespace octant::ui::flight {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

constexpr int share_of_side = 3;
/// The picture's height by the margin.
constexpr int margin_share = 40;
constexpr int share_of_triangles = 4;
constexpr int fewest_triangles = 1000;

settings::RunSettings inset_settings(const settings::RunSettings& settings, const glm::ivec2& size_px) {
    settings::RunSettings own = settings;
    own.view.kind = *settings.view.inset;
    own.view.inset.reset();
    own.view.size_px = size_px;
    own.view.azimuth_deg = 0.0;
    own.view.elevation_deg = 0.0;
    own.view.zoom = 1.0;
    own.ground.triangles = std::max(fewest_triangles, scene::triangle_target(settings) / share_of_triangles);
    return own;
}

} // namespace

scene::PixelRect inset_rectangle(const glm::ivec2& picture_px) {
    const glm::ivec2 size_px = glm::max(picture_px / share_of_side, glm::ivec2(1));
    const int margin_px = std::min(picture_px.x, picture_px.y) / margin_share;
    const glm::ivec2 at_px = picture_px - size_px - margin_px;
    return {at_px.x, at_px.y, size_px.x, size_px.y};
}

InsetView::InsetView(const settings::RunSettings& settings, const planning::Scene& scene) : scene_(scene) {
    update_rectangle(settings);
    planner_.emplace(scene_, settings_);
}

void InsetView::update_rectangle(const settings::RunSettings& settings) {
    assert(settings.view.inset);
    rectangle_ = inset_rectangle(settings.view.size_px);
    apply_look(settings);
}

void InsetView::apply_settings(const settings::RunSettings& settings) {
    std::unique_ptr<landscape::GroundMesher> mesher = planner_->take_mesher();
    const landscape::GroundMesher* const before = mesher.get();
    const bool same_control = scene::same_detail_control(settings.ground, settings_.ground);
    planner_.reset();
    update_rectangle(settings);
    mesher = landscape::reuse_or_make_mesher(
        std::move(mesher), *scene_.ground, landscape::mesh_settings(settings_, scene_.ground_texture != nullptr));
    must_reset_detail_ = must_reset_detail_ || !same_control || mesher.get() != before;
    planner_.emplace(scene_, settings_, std::move(mesher));
}

void InsetView::apply_look(const settings::RunSettings& settings) {
    settings_ = inset_settings(settings, {rectangle_.width, rectangle_.height});
}

void InsetView::set_sun(const settings::RunSettings& settings) {
    apply_look(settings);
    must_reset_detail_ = !planner_->set_sun() || must_reset_detail_;
}

const scene::FramePlan& InsetView::plan(const scene::Camera& camera, std::span<const sim::AircraftState> states,
    std::span<const planning::ArticulatedPart> articulated_parts, std::optional<double> smooth_share) {
    reset_detail(camera);
    planning::PlanRequest request{camera, states};
    request.smooth.share = smooth_share;
    request.articulated_parts = articulated_parts;
    return planner_->plan(request).plan;
}

void InsetView::advance_without_drawing(const scene::Camera& camera, std::span<const sim::AircraftState> states,
    std::span<const planning::ArticulatedPart> articulated_parts) {
    reset_detail(camera);
    planning::PlanRequest request{camera, states};
    request.articulated_parts = articulated_parts;
    planner_->advance_without_drawing(request);
}

/// Before the first picture.
void InsetView::reset_detail(const scene::Camera& camera) {
    if (std::exchange(must_reset_detail_, false)) { planner_->reset_detail(camera); }
}

} // namespace octant::ui::flight
