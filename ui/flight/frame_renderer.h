#pragma once

#include "sim/aircraft_state.h"
#include "ui/settings/settings.h"
#include "visuals/planning/id_plan.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/planner.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/renderer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::flight {

/// A time of a run: where the aircraft are then, and from where they are seen.
struct FrameState {
    double time_s = 0.0;
    std::vector<sim::AircraftState> states;
    /// Parts that do not turn by themselves.
    std::vector<visuals::planning::ArticulatedPart> articulated_parts;
    /// One for each view, at least one.
    std::vector<visuals::scene::Camera> cameras = std::vector<visuals::scene::Camera>(1);
    /// Triangles of ground that the first view aims at.
    int triangle_target = 0;
    /// Simulation::state_hash then.
    std::uint64_t state_hash = 0;
};

/// What the pictures of a session show.
enum class PictureContent {
    World,
    /// Which polygon or triangle of the ground each pixel belongs to (visuals::planning::IdPlan).
    PolygonIds
};

/// Where the inset lies in a picture of that size: in its lower right corner.
visuals::scene::PixelRect inset_rectangle(const glm::ivec2& picture_px);

/// Draws the pictures of a run: plans a frame for each view, has the renderer draw all views, and reads the picture or
/// hands it to whoever shows it. The first view fills the picture. The second, if the settings ask for an inset, has
/// ground meshed for it alone, with a quarter of the first view's triangles; nothing of the scene is loaded twice.
class FrameRenderer {
public:
    /// All three must outlive it. update_views() comes before the first picture.
    FrameRenderer(visuals::scene::Renderer& renderer, const visuals::planning::Scene& scene,
        const settings::RunSettings& settings)
        : renderer_(renderer), scene_(scene), settings_(settings) {}

    /// Gives the renderer the models of the scene.
    void load_models(PictureContent content);

    /// To be called when the settings or the scene's ground have become others: makes the views that the settings ask
    /// for. The detail of a view's ground goes on where both the ground and its control are the same. Else it begins
    /// anew: in the first view at once, for the camera `now`; in another view for the camera of its next picture.
    void update_views(const visuals::scene::Camera& now);

    /// The same where only the sun of the settings and the colours of the scene's ground are others.
    void set_sun(const visuals::scene::Camera& now);

    /// The same where nothing has to be planned anew.
    void apply_look();

    /// Removes all views, which look at the scene; update_views() makes them again.
    void remove_views() { views_.clear(); }

    std::size_t view_count() const { return views_.size(); }

    /// The settings of the run with the camera, the size and the triangles of that view.
    const settings::RunSettings& view_settings(std::size_t view) const { return views_[view]->settings; }

    /// Lines that the next pictures show in their upper left corner.
    void set_overlay_lines(std::vector<std::string> overlay_lines) { overlay_lines_ = std::move(overlay_lines); }

    /// Shows a finished picture; called with the renderer that holds it, in place of reading its pixels.
    using Presenter = std::function<void(visuals::scene::Renderer&)>;

    void set_presenter(Presenter presenter) { presenter_ = std::move(presenter); }

    /// The next pictures may be drawn straight into a window of that size.
    void set_window_target(const glm::ivec2& window_px) { renderer_.set_window_target(window_px); }

    /// Whether pictures are read before they are shown, for a recording of each of them. A driver must not draw them
    /// straight into the window then.
    void set_reads_before_presenting(bool wanted) { reads_before_presenting_ = wanted; }

    /// A planned frame.
    struct PlannedPicture {
        /// Of the first view.
        visuals::planning::PlanCounts counts;
        /// Time of placing and refining the aircraft of the first view.
        double refine_ms = 0.0;
        /// Waiting for the first view's ground, which another thread began to mesh during the last picture.
        double mesh_wait_ms = 0.0;
    };

    /// Plans all views of a frame, after the frames before it. `smooth`: polygons lit smoothly; nothing: as the
    /// settings' share says.
    PlannedPicture plan(const FrameState& now, std::optional<int> smooth);

    /// Goes on as if a frame had been planned, for a picture that nobody sees (Planner::advance_without_drawing).
    void advance_without_drawing(const FrameState& now, std::optional<int> smooth);

    /// Begins to mesh the ground for the next frame while this one is drawn.
    void mesh_async(const FrameState& next);

    /// Returns when no ground is being meshed. Throws what that work threw.
    void wait();

    /// Draws what was planned, and waits for it.
    void draw();

    /// Reads what was drawn, or hands it to the presenter.
    void show();

    /// Reads the last picture, which was of that frame, where a presenter showed it; draws it once more if it went
    /// straight into a window.
    void read(const FrameState& now, std::optional<int> smooth);

    /// The last picture that was read, top row first.
    const visuals::scene::Picture& picture() const { return picture_; }

    /// Makes the renderer ready for pictures of that size over ground of that texture; null: of the one that it has, if
    /// any. Throws Error and leaves it as it was.
    void prepare_renderer(const visuals::scene::ViewSettings& view, const visuals::scene::GroundTexture* texture);

private:
    /// The planner refers to the settings: a view stays in its place.
    struct PictureView {
        settings::RunSettings settings;
        /// In the picture.
        visuals::scene::PixelRect rectangle;
        std::optional<visuals::planning::Planner> planner;
        /// Of the last picture; null before the next one where the view has become another.
        const visuals::scene::FramePlan* plan = nullptr;
    };

    void update_settings(std::size_t view);
    visuals::planning::PlanRequest request(
        const FrameState& now, std::size_t view, const visuals::planning::SmoothTarget& smooth);
    void draw_plans();
    void restore_window_size();

    visuals::scene::Renderer& renderer_;
    const visuals::planning::Scene& scene_;
    const settings::RunSettings& settings_;
    std::vector<std::unique_ptr<PictureView>> views_;
    /// What the first view shows in place of its plan.
    std::optional<visuals::planning::IdPlan> ids_;
    std::vector<std::string> overlay_lines_;
    Presenter presenter_;
    bool reads_before_presenting_ = false;
    visuals::scene::Picture picture_;
    bool picture_is_read_ = false;
};

} // namespace octant::ui::flight
