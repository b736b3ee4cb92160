#pragma once

#include "ui/flight/inset_view.h"
#include "ui/flight/frame_state.h"
#include "ui/settings/settings.h"
#include "visuals/planning/id_plan.h"
#include "visuals/planning/planner.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/ground_texture.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/renderer.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::flight {

/// What the pictures of a session show.
enum class PictureContent {
    World,
    /// Which polygon or triangle of the ground each pixel belongs to (visuals::planning::IdPlan).
    PolygonIds
};

/// Makes the pictures of a run: plans a moment for the view and for the inset, has the renderer
/// draw both, and reads the picture or hands it to whoever shows it. Knows nothing of how the
/// moments come about.
class FrameRenderer {
public:
    /// All three must outlive it; begin() before the first picture. Scene and settings may become
    /// others: the function below that fits must be called then.
    FrameRenderer(
        visuals::scene::Renderer& renderer,
        const visuals::planning::Scene& scene,
        const settings::RunSettings& settings)
        : renderer_(renderer)
        , scene_(scene)
        , settings_(settings) {}

    /// Gives the renderer the models of the scene.
    void load_models(PictureContent content);

    /// Makes planners, the view's ground detailed for the camera of the first picture. Loading
    /// work.
    void begin(const visuals::scene::Camera& first);

    /// Lets go of all that looks at the scene; begin() again after that.
    void end();

    /// Lines that the next pictures show in their upper left corner.
    void set_overlay_lines(std::vector<std::string> overlay_lines) { overlay_lines_ = std::move(overlay_lines); }

    /// Shows a finished picture; called with the renderer that holds it, in place of reading its
    /// pixels.
    using Presenter = std::function<void(visuals::scene::Renderer&)>;

    void set_presenter(Presenter presenter) { presenter_ = std::move(presenter); }

    /// The next pictures may be drawn straight into a window of that size.
    void set_window_target(const glm::ivec2& window_px) { renderer_.set_window_target(window_px); }

    /// Whether pictures are read before they are shown, as whoever records each of them wants. A
    /// driver must not draw them straight into the window then.
    void set_reads_before_presenting(bool wanted) { reads_before_presenting_ = wanted; }

    /// The settings of the second view, which has a camera and a size of its own; null = there is
    /// none.
    const settings::RunSettings* inset_settings() const {
        return inset_ ? &inset_->settings() : nullptr;
    }

    /// Plans a moment, after the pictures before it. `smooth`: polygons that are smooth, nothing =
    /// as the settings' share says. `on_refined`: PlanRequest::on_refined.
    visuals::planning::PlanCounts
    plan(const FrameState& now, std::optional<int> smooth, std::function<void()> on_refined);

    /// Goes on as if a moment had been planned, for a picture that nobody sees
    /// (Planner::advance_without_drawing).
    void advance_without_drawing(const FrameState& now, std::optional<int> smooth);

    /// Begins to mesh the ground for the next moment, beside the drawing of this one.
    void mesh_async(const FrameState& next);

    /// Draws what was planned, and waits for it.
    void draw();

    /// Reads what was drawn, or hands it to the presenter.
    void show();

    /// Reads the last picture, which was of that moment, where a presenter showed it; draws it once
    /// more if it went straight into a window.
    void read(const FrameState& now, std::optional<int> smooth);

    /// The last picture that was read, top row first.
    const visuals::scene::Picture& picture() const { return picture_; }

    /// Returns when nothing is being meshed. Throws what that work threw.
    void wait();

    /// Returns when the ground of the first view is not being meshed; that of the inset may be.
    /// Throws what that work threw.
    void wait_for_first_view();

    /// Makes the renderer ready for pictures of that size over ground of that texture; null: of the
    /// one that it has, if any. Throws Error and leaves it as it was.
    void prepare_renderer(
        const visuals::scene::ViewSettings& view, const visuals::scene::GroundTexture* texture);

    /// The settings and the scene's ground are others. The detail of the ground goes on where both
    /// it and its control are the same; else it begins anew for this camera.
    void apply_settings(bool other_control, const visuals::scene::Camera& now);

    /// Only the sun of the settings, and the colours of the scene's ground, are others.
    void set_sun(const visuals::scene::Camera& now);

    /// Only what needs no planning anew is another.
    void apply_look();

private:
    visuals::planning::PlanRequest request(const FrameState& now, std::optional<int> smooth) const;
    void draw_plans();
    void restore_window_size();
    void update_ground(bool other_control, const visuals::scene::Camera& now);
    void update_inset();

    visuals::scene::Renderer& renderer_;
    const visuals::planning::Scene& scene_;
    const settings::RunSettings& settings_;
    std::optional<visuals::planning::Planner> planner_;
    std::unique_ptr<InsetView> inset_;
    std::optional<visuals::planning::IdPlan> ids_;
    /// The plans of the last picture; null once their planners are gone.
    const visuals::scene::FramePlan* plan_ = nullptr;
    const visuals::scene::FramePlan* inset_plan_ = nullptr;
    std::vector<std::string> overlay_lines_;
    Presenter presenter_;
    bool reads_before_presenting_ = false;
    visuals::scene::Picture picture_;
    bool picture_is_read_ = false;
};

} // namespace octant::ui::flight
