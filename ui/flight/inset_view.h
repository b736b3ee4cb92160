#pragma once

#include "ui/settings/settings.h"
#include "visuals/planning/planner.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"

#include <optional>
#include <span>

namespace octant::ui::flight {

/// Where the second view lies in a picture of that size.
visuals::scene::PixelRect inset_rectangle(const glm::ivec2& picture_px);

/// A second view of a scene, in the lower right corner of the picture: ground meshed for it alone, with a quarter of
/// the picture's triangles on a ninth of its area. Loads nothing and copies nothing of the scene.
class InsetView {
public:
    /// For ViewSettings::inset (asserted). The scene must outlive it. Stays in its place.
    InsetView(const settings::RunSettings& settings, const visuals::planning::Scene& scene);
    ~InsetView() = default;
    InsetView(const InsetView&) = delete;
    InsetView& operator=(const InsetView&) = delete;
    InsetView(InsetView&&) = delete;
    InsetView& operator=(InsetView&&) = delete;

    /// Takes other settings over, and the ground that the scene has now. The ground's detail goes on where both it and
    /// its control are the same.
    void apply_settings(const settings::RunSettings& settings);

    /// Takes other settings over where only a look has changed.
    void apply_look(const settings::RunSettings& settings);

    /// The same where the sun has moved, too, with the ground that the scene has now.
    void set_sun(const settings::RunSettings& settings);

    /// Settings of the view alone: its camera and its size.
    const settings::RunSettings& settings() const { return settings_; }

    visuals::scene::PixelRect rectangle() const { return rectangle_; }

    /// Begins the work on the ground of the next picture, as Planner::prepare.
    void begin_next_mesh(const visuals::scene::Camera& camera, const IdleThreadRunner& on_idle_thread) {
        planner_->begin_next_mesh(camera, std::nullopt, on_idle_thread);
    }

    /// Returns when nothing is being prepared, as Planner::wait.
    void wait() { planner_->wait(); }

    /// `smooth_share`: SmoothTarget::share.
    const visuals::scene::FramePlan& plan(const visuals::scene::Camera& camera,
        std::span<const sim::AircraftState> states,
        std::span<const visuals::planning::ArticulatedPart> articulated_parts, std::optional<double> smooth_share);

    /// Planner::advance_without_drawing, of what plan() would have been given.
    void advance_without_drawing(const visuals::scene::Camera& camera, std::span<const sim::AircraftState> states,
        std::span<const visuals::planning::ArticulatedPart> articulated_parts);

private:
    void reset_detail(const visuals::scene::Camera& camera);
    void update_rectangle(const settings::RunSettings& settings);

    const visuals::planning::Scene& scene_;
    settings::RunSettings settings_;
    visuals::scene::PixelRect rectangle_;
    std::optional<visuals::planning::Planner> planner_;
    /// Whether the ground's detail is still to be set for a first picture.
    bool must_reset_detail_ = true;
};

} // namespace octant::ui::flight
