#pragma once

#include "ui/settings/settings.h"
#include "ui/world/world.h"
#include "visuals/gl/renderer.h"
#include "visuals/scene/planner.h"

#include <optional>
#include <span>

namespace octant::ui::flight {

/// A second view of a world, in the lower right corner of the picture, with ground of its own: a
/// quarter of the picture's triangles on a ninth of its area.
class InsetView {
public:
    /// For Settings::inset (asserted). Throws Error. Stays in its place.
    InsetView(
        const settings::Settings& settings, const world::World& world, world::DrawnBy drawn_by);
    ~InsetView() = default;
    InsetView(const InsetView&) = delete;
    InsetView& operator=(const InsetView&) = delete;
    InsetView(InsetView&&) = delete;
    InsetView& operator=(InsetView&&) = delete;

    /// Takes other settings of the same world over. Throws Error.
    void follow(const settings::Settings& settings);

    /// Settings of the view alone: its camera and its size.
    const settings::Settings& settings() const { return settings_; }

    visuals::gl::PixelRect rectangle() const { return rectangle_; }

    /// As Planner's.
    void prepare(const visuals::scene::Camera& camera) { planner_->prepare(camera); }

    /// `smooth_share`: Planner::set_smooth_share.
    const visuals::scene::FramePlan& plan(
        const visuals::scene::Camera& camera,
        std::span<const sim::AircraftState> states,
        std::optional<double> smooth_share);

private:
    void place(const settings::Settings& settings);

    settings::Settings settings_;
    world::DrawnBy drawn_by_;
    visuals::gl::PixelRect rectangle_;
    visuals::scene::Scene scene_;
    std::optional<visuals::scene::Planner> planner_;
    bool settles_ = true; ///< the ground's detail has not been set for a first picture
};

} // namespace octant::ui::flight
