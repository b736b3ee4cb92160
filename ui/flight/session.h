#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/ground_height.h"
#include "sim/base/thread_pool.h"
#include "ui/base/stopwatch.h"
#include "ui/flight/inset_view.h"
#include "ui/flight/quality_targets.h"
#include "ui/flight/simulation.h"
#include "ui/flight/state_source.h"
#include "ui/report/frame_record.h"
#include "ui/report/kernel_counters.h"
#include "ui/settings/frame_part.h"
#include "ui/settings/settings.h"
#include "ui/world/scene_ground.h"
#include "ui/world/world.h"
#include "visuals/planning/id_plan.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/planner.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/ground_texture.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/renderer.h"
#include "visuals/scene/settings.h"
#include "visuals/shading/shading_controller.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::flight {

/// Every number by which the ground's triangle budget follows the frame time. "Stress", the word of image generators,
/// is the share of its time that a frame uses: frame_ms / target_frame_ms.
struct StressSettings {
    /// A frame's time, above zero.
    double target_frame_ms = 1000.0 / 60.0;
    /// The fewest triangles; at least 1.
    int min_triangles = 1000;
    /// The most triangles; at least `min_triangles`.
    int max_triangles = 100000;
    /// The budget is left alone while the stress is between these.
    double min_stress = 0.75;
    double max_stress = 0.90;
    /// A longer frame counts as no more than this, so that one slow frame cannot push the filtered stress from the
    /// middle of the band over its edge; above `max_stress`.
    double max_counted_stress = 2.0;
    /// The time constant of the filter, in simulated time.
    double filter_s = 0.5;
    /// The filter spans no fewer frames than these; at least 1.
    double filter_frames = 20;
    /// A course ends this near to the middle of the band; below half the band's width.
    double settled_stress = 0.02;
    /// The share of the target that it may lose from frame to frame.
    double max_fall = 0.02;
    double max_rise = 0.005;
    /// The target rises only while at least this share of it is drawn: a budget that nobody uses says nothing of what
    /// it would cost.
    double used_share = 0.9;
};

/// What is carried from one frame to the next: a value, so that a run can be replayed.
struct StressState {
    enum class Trend { Held, Falling, Rising };

    /// The triangles of the next frame, within the settings' limits.
    double target = 0.0;
    Trend trend = Trend::Held;
    /// Filtered, with the last frame measured; nothing before the first.
    std::optional<double> stress;
    /// What the control goes by: filtered too, but with long frames counted less and carried over to each new target.
    /// At rest the same as `stress`.
    double expected_stress = 0.0;

    /// The target as a whole number.
    int triangles() const;
};

/// What a frame made with StressState::triangles() took.
struct FrameCost {
    /// At least 0.
    double frame_ms = 0.0;
    /// The triangles of ground that were drawn.
    int triangles = 0;
};

/// The settings of a run: from an eighth of its triangle budget to four times as many.
StressSettings stress_settings(const visuals::scene::Settings& settings, double rate_hz);

/// State before the first frame, at rest in the middle of the band.
StressState initial_state(double triangles, const StressSettings& settings);

/// The state where somebody else chose the next frame's target, at least 1.
StressState with_target(const StressState& state, int triangles);

/// State after a frame. Settings are as their comments demand (asserted).
StressState next_state(const StressState& state, const StressSettings& settings, const FrameCost& cost);

/// What a frame took and drew, as far as the next ones' decisions go by it.
struct FrameMeasurement {
    double frame_ms = 0.0;
    int terrain_triangles = 0;
    /// Polygons of aircraft, at least 0.
    int smoothable_polygons = 0;
    /// How many of these were lit smoothly.
    int smooth_polygons = 0;
    /// Whether it is a warm-up frame, from which nothing is learned.
    bool warm_up = false;
};

/// Decides for each frame how many triangles of ground it aims at and how many polygons are smooth: as the settings
/// say, by what earlier frames took where the settings let that follow the clock, or as a recording has it. Reads no
/// clock itself, so that same outcomes give same decisions.
class QualityController {
public:
    /// Forgets all outcomes and decides by these settings from now on; what is replayed stays. `rate_hz`: frames a
    /// second that there is time for.
    void begin(const visuals::scene::Settings& settings, double rate_hz);

    /// From now on each frame is decided as it stands here, by its number, whatever the clock says.
    void replay(std::vector<QualityTargets> quality_targets) { replayed_targets_ = std::move(quality_targets); }

    /// Triangles of ground that a frame aims at; below the number of replayed ones, if any (asserted).
    int triangle_target(int frame);

    /// Smooth polygons of a frame; nothing: as the settings' share says. Likewise.
    std::optional<int> smooth_target(int frame) const;

    /// Learns from a frame. Returns its stress, the share of its time that it used: of this frame alone, or filtered
    /// over several where the triangle target follows it. Not a number before the first frame that counts.
    double add_frame(const FrameMeasurement& outcome);

    /// What `--adapt shading` has found out; nothing before the first frame that counts.
    const std::optional<visuals::shading::ShadingState>& shading() const { return shading_; }

private:
    void add_shading_frame(const FrameMeasurement& outcome);

    visuals::scene::Adaptation adapt_;
    double rate_hz_ = 60.0;
    /// What the settings ask for.
    int configured_triangles_ = 0;
    StressSettings stress_settings_;
    StressState stress_;
    std::optional<visuals::shading::ShadingState> shading_;
    /// By frame; empty = nothing is replayed.
    std::vector<QualityTargets> replayed_targets_;
};

/// A time of a run: where the aircraft are then, and from where they are seen.
struct FrameState {
    double time_s = 0.0;
    std::vector<sim::AircraftState> states;
    /// Parts that do not turn by themselves.
    std::vector<visuals::planning::ArticulatedPart> articulated_parts;
    visuals::scene::Camera camera;
    visuals::scene::Camera inset_camera;
    /// Triangles of ground that the picture aims at.
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

/// Makes the pictures of a run: plans a moment for the view and for the inset, has the renderer draw both, and reads
/// the picture or hands it to whoever shows it. Knows nothing of how the moments come about.
class FrameRenderer {
public:
    /// All three must outlive it; begin() before the first picture. Scene and settings may become others: the function
    /// below that fits must be called then.
    FrameRenderer(visuals::scene::Renderer& renderer, const visuals::planning::Scene& scene,
        const settings::RunSettings& settings)
        : renderer_(renderer), scene_(scene), settings_(settings) {}

    /// Gives the renderer the models of the scene.
    void load_models(PictureContent content);

    /// Makes planners, the view's ground detailed for the camera of the first picture. Loading work.
    void begin(const visuals::scene::Camera& first);

    /// Lets go of all that looks at the scene; begin() again after that.
    void end();

    /// Lines that the next pictures show in their upper left corner.
    void set_overlay_lines(std::vector<std::string> overlay_lines) { overlay_lines_ = std::move(overlay_lines); }

    /// Shows a finished picture; called with the renderer that holds it, in place of reading its pixels.
    using Presenter = std::function<void(visuals::scene::Renderer&)>;

    void set_presenter(Presenter presenter) { presenter_ = std::move(presenter); }

    /// The next pictures may be drawn straight into a window of that size.
    void set_window_target(const glm::ivec2& window_px) { renderer_.set_window_target(window_px); }

    /// Whether pictures are read before they are shown, as whoever records each of them wants. A driver must not draw
    /// them straight into the window then.
    void set_reads_before_presenting(bool wanted) { reads_before_presenting_ = wanted; }

    /// The settings of the second view, which has a camera and a size of its own; null = there is none.
    const settings::RunSettings* inset_settings() const { return inset_ ? &inset_->settings() : nullptr; }

    /// Plans a moment, after the pictures before it. `smooth`: polygons that are smooth, nothing = as the settings'
    /// share says. `on_refined`: PlanRequest::on_refined.
    visuals::planning::PlanCounts plan(
        const FrameState& now, std::optional<int> smooth, std::function<void()> on_refined);

    /// Goes on as if a moment had been planned, for a picture that nobody sees (Planner::advance_without_drawing).
    void advance_without_drawing(const FrameState& now, std::optional<int> smooth);

    /// Begins to mesh the ground for the next moment, beside the drawing of this one.
    void mesh_async(const FrameState& next);

    /// Draws what was planned, and waits for it.
    void draw();

    /// Reads what was drawn, or hands it to the presenter.
    void show();

    /// Reads the last picture, which was of that moment, where a presenter showed it; draws it once more if it went
    /// straight into a window.
    void read(const FrameState& now, std::optional<int> smooth);

    /// The last picture that was read, top row first.
    const visuals::scene::Picture& picture() const { return picture_; }

    /// Returns when nothing is being meshed. Throws what that work threw.
    void wait();

    /// Returns when the ground of the first view is not being meshed; that of the inset may be. Throws what that work
    /// threw.
    void wait_for_first_view();

    /// Makes the renderer ready for pictures of that size over ground of that texture; null: of the one that it has, if
    /// any. Throws Error and leaves it as it was.
    void prepare_renderer(const visuals::scene::ViewSettings& view, const visuals::scene::GroundTexture* texture);

    /// The settings and the scene's ground are others. The detail of the ground goes on where both it and its control
    /// are the same; else it begins anew for this camera.
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

/// The conductor of a run: takes each frame from simulation through plan and picture to its record. The only place that
/// reads the clock during a flight. What flies is the simulation's matter, how fine a picture may be the decider's, and
/// the picture itself the picture maker's; a source flies in place of the path where motion comes from outside.
///
/// A flight without a window is frames() pictures by draw(frame). A window asks for pictures of its own times by
/// draw_at(), and changes settings and simulation between them.
class Session {
public:
    /// Loads the world and draws once in every drawing state, with this renderer, which must be of the settings'
    /// picture size, or with one that it makes as the settings say. Loads no world where it is given one, which must be
    /// of these settings but for the view's. Throws Error. Stays in its place: parts of it point at others.
    explicit Session(const settings::RunSettings& settings, PictureContent content = PictureContent::World,
        std::unique_ptr<visuals::scene::Renderer> renderer = nullptr,
        std::optional<world::World> loaded = std::nullopt);
    ~Session() = default;
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    Session(Session&&) = delete;
    Session& operator=(Session&&) = delete;

    const world::World& world() const { return world_; }

    const settings::RunSettings& settings() const { return settings_; }

    const visuals::scene::Renderer& renderer() const { return *renderer_; }

    /// Number of frames of the run.
    int frames() const { return static_cast<int>(times_.times_s.size()); }

    /// Frames a second of simulated time, for video and stress.
    double rate_hz() const { return times_.rate_hz; }

    /// Flies as many frames as there are decisions, at most frames() (asserted), each as decided whatever the clock
    /// says. Before the first draw().
    void replay(std::vector<QualityTargets> quality_targets);

    /// The source flies all aircraft from now on, whatever is loaded anew. It must outlive the session.
    void set_state_source(StateSource& source);

    /// Simulates up to the frame's time, plans, draws and reads the picture. Frames come in order.
    report::FrameRecord draw(int frame);

    /// The same for a time not before those of earlier frames, and the time of the next picture where it is known: that
    /// one's ground is meshed while this one is drawn. Its camera is then chosen now, so that what apply() or the
    /// simulation change later shows in the picture after it.
    report::FrameRecord draw_at(double time_s, std::optional<double> next_s);

    /// How pictures are shown and what is written into them; to be changed between frames.
    FrameRenderer& pictures() { return pictures_; }

    /// Changes what the next frames show. Loads what has to be loaded anew; the flight then starts again where its
    /// aircraft, path or ground are others. Throws Error and leaves everything as it was; any other exception leaves a
    /// session that cannot go on.
    void apply(const settings::RunSettings& settings);

    /// Puts the sun where the settings' time or angles say: the ground's other colours are made beside the pictures to
    /// come. One at a time (asserted).
    void begin_set_sun(const settings::RunSettings& settings);

    bool is_setting_sun() const { return is_setting_sun_; }

    /// Shows what begin_set_sun() made, if it is ready; returns whether it was. apply() gives up what is not shown yet
    /// where it loads or plans anything anew. Throws what that work threw.
    bool poll_set_sun();

    /// Before the first draw(): draws only this part of the frames, as if those before it had been drawn. What later
    /// pictures depend on is planned of them, and the last one whole. Returns the part's frames; frames() then ends
    /// with it. Throws Error where there are fewer frames than parts.
    settings::FrameRange begin_frame_range(const settings::FlightPart& part);

    /// To be changed between frames. Begin at another time by begin_at().
    Simulation& simulation() { return *simulation_; }

    const Simulation& simulation() const { return *simulation_; }

    /// Goes to a time of the path.
    void begin_at(double time_s);

    /// The camera of the last picture.
    const visuals::scene::Camera& camera() const { return current_.camera; }

    /// Simulation::state_hash when the last picture's time was reached.
    std::uint64_t state_hash_of_last_picture() const { return current_.state_hash; }

    /// States of all aircraft in the last picture.
    std::span<const sim::AircraftState> states() const { return current_.states; }

    /// Triangles of ground that the last picture aimed at.
    int triangle_target() const { return current_.triangle_target; }

    /// Reads the last picture where a presenter showed it; draws it once more if it went straight into a window.
    void read_picture() { pictures_.read(current_, smooth_target_); }

    /// Picture of the last frame that was read, top row first.
    const visuals::scene::Picture& picture() const { return pictures_.picture(); }

    /// What `--adapt shading` has found out.
    const std::optional<visuals::shading::ShadingState>& shading() const { return quality_controller_.shading(); }

    /// Over the aircraft states at every fixed step so far, to the end of the run once its last frame is drawn, and
    /// over the hashes of every frame's pixels.
    std::uint64_t state_hash() const { return simulation_->state_hash(); }

    std::uint64_t picture_hash() const { return picture_hash_.value(); }

    /// Adds the last picture to the picture hash and returns its own hash. Apart from draw(), because it is not the
    /// frame's work.
    std::uint64_t hash_picture();

private:
    world::RenderDevice render_device() const;
    void release_texture_memory();
    void start_flight();
    visuals::scene::Camera camera_of(const settings::RunSettings& settings) const;
    void set_cameras(FrameState& frame_state) const;
    void simulate_to(double time_s, int frame, FrameState& frame_state);
    report::FrameRecord render_frame(int frame, double time_s, std::optional<double> next_s);
    bool ground_has_memory() const;
    void fill_in(const visuals::planning::PlanCounts& counts, report::FrameRecord& record);
    void apply_world_change(const settings::RunSettings& settings);
    void apply_picture_change(const settings::RunSettings& settings);
    void apply_sun_change(const settings::RunSettings& settings, world::SceneGround ground);
    world::SceneGround ground_for(const settings::RunSettings& settings) const;
    void set_ground(world::SceneGround ground);

    settings::RunSettings settings_;
    std::unique_ptr<visuals::scene::Renderer> renderer_;
    world::World world_;
    FrameRenderer pictures_;
    std::optional<Simulation> simulation_;
    world::PictureTimes times_;
    GroundHeight ground_height_;
    FrameState current_;
    FrameState next_;
    bool next_is_simulated_ = false;
    /// Null where the path flies the aircraft.
    StateSource* source_ = nullptr;
    QualityController quality_controller_;
    /// The smooth polygons of the last picture; nothing: by the settings' share.
    std::optional<int> smooth_target_;
    int last_triangles_ = 0;
    /// The number of pictures drawn by draw_at() so far.
    int frames_drawn_ = 0;
    Hash picture_hash_;
    report::KernelCounters counters_;
    base::Stopwatch since_first_frame_;
    /// The ground in the colours of another sun, which is made between pictures, and the air that it belongs to. The
    /// task comes last because it reads the scene.
    visuals::scene::AirSettings recoloured_air_;
    std::optional<world::SceneGround> recoloured_ground_; ///< written by the task
    bool is_setting_sun_ = false;
    BackgroundTask recolouring_;
};

} // namespace octant::ui::flight
