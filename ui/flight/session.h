#pragma once

#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
#include "sim/base/hash.h"
#include "sim/base/stopwatch.h"
#include "sim/base/thread_pool.h"
#include "ui/flight/frame_renderer.h"
#include "ui/flight/quality_controller.h"
#include "ui/flight/simulation.h"
#include "ui/report/frame_record.h"
#include "ui/report/kernel_counters.h"
#include "ui/settings/frame_part.h"
#include "ui/settings/settings.h"
#include "ui/world/scene_ground.h"
#include "ui/world/world.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/renderer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::flight {

/// Makes the frames of a run, one a call: each goes from the simulation through the plan and the picture to its record.
/// Simulation moves the aircraft, QualityController chooses the number of triangles, FrameRenderer makes the picture.
///
/// A flight without a window is frames() pictures by draw(frame). A window or a live flight asks for pictures of its
/// own times by draw_at(), and changes settings and simulation between them.
class Session {
public:
    /// Loads the world, loads the models and the ground texture into the renderer, and warms the renderer up
    /// (Renderer::warm_up). The renderer is the given one, which must be of the settings' picture size, or one made as
    /// the settings say. A given world, which must be of these settings but for the view's, is not loaded again. Throws
    /// Error. A session cannot be moved, because parts of it point at others.
    explicit Session(const settings::RunSettings& settings, PictureContent content = PictureContent::World,
        std::unique_ptr<visuals::scene::Renderer> renderer = nullptr,
        std::optional<world::World> loaded = std::nullopt);
    ~Session() = default;
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    Session(Session&&) = delete;
    Session& operator=(Session&&) = delete;

    // What flies.

    const world::World& world() const { return world_; }

    const settings::RunSettings& settings() const { return settings_; }

    const visuals::scene::Renderer& renderer() const { return *renderer_; }

    /// To be changed between frames. Begin at another time by begin_at().
    Simulation& simulation() { return *simulation_; }

    const Simulation& simulation() const { return *simulation_; }

    /// How pictures are shown and what is written into them; to be changed between frames.
    FrameRenderer& pictures() { return pictures_; }

    /// The source flies all aircraft from now on, whatever is loaded anew. It must outlive the session.
    void set_state_source(StateSource& source);

    // Frames.

    /// Number of frames of the run.
    int frames() const { return static_cast<int>(times_.times_s.size()); }

    /// Frames a second of simulated time, for video and stress.
    double rate_hz() const { return times_.rate_hz; }

    /// Before the first draw(): flies as many frames as there are targets, at most frames() (asserted), each with its
    /// targets in place of those that --adapt would choose by the clock.
    void replay(std::vector<QualityTargets> quality_targets);

    /// Before the first draw(): draws only this part of the frames, as if those before it had been drawn. Of the frames
    /// before it only that is planned on which later pictures depend; the last of them is planned whole. Returns the
    /// part's frames; frames() then ends with it. Throws Error where there are fewer frames than parts.
    settings::FrameRange begin_frame_range(const settings::FlightPart& part);

    /// Simulates up to the frame's time, plans, draws and reads the picture. Frames come in order.
    report::FrameRecord draw(int frame);

    /// Goes to a time of the path.
    void begin_at(double time_s);

    /// As draw() for a time not before those of earlier frames, and the time of the next picture where it is known:
    /// that one's ground is meshed while this one is drawn. Its camera is then chosen now, so that what apply() or the
    /// simulation change later shows in the picture after it.
    report::FrameRecord draw_at(double time_s, std::optional<double> next_s);

    // Changed settings (session_settings.cpp).

    /// Changes what the next frames show. Loads what has to be loaded anew; the flight then starts again where its
    /// aircraft, path or ground are others. Throws Error and leaves everything as it was; any other exception leaves a
    /// session that cannot go on.
    void apply(const settings::RunSettings& settings);

    /// Brings the sun to the time of day, as AirSettings::time has it, without delaying a picture: the ground's colours
    /// are made while pictures are drawn. To be called before each picture. Returns whether pictures show another time
    /// from now on. apply() gives up what is not shown yet where it loads or plans anything anew. Throws what that work
    /// threw.
    bool follow_time_of_day(const std::optional<std::string>& time);

    // The last picture.

    const visuals::scene::Camera& camera() const { return current_.cameras.front(); }

    /// Of all aircraft.
    std::span<const sim::AircraftState> states() const { return current_.states; }

    /// Triangles of ground that it aimed at.
    int triangle_target() const { return current_.triangle_target; }

    /// Simulation::state_hash when its time was reached.
    std::uint64_t state_hash_of_last_picture() const { return current_.state_hash; }

    /// Reads it where a presenter showed it; draws it once more if it went straight into a window.
    void read_picture() { pictures_.read(current_, smooth_target_); }

    /// The last one that was read, top row first.
    const visuals::scene::Picture& picture() const { return pictures_.picture(); }

    /// Adds it to the picture hash and returns its own hash. Apart from draw(), because it is not the frame's work.
    std::uint64_t hash_picture();

    // Results.

    /// Over the aircraft states at every fixed step so far, to the end of the run once its last frame is drawn.
    std::uint64_t state_hash() const { return simulation_->state_hash(); }

    /// Over the hashes of every frame's pixels.
    std::uint64_t picture_hash() const { return picture_hash_.value(); }

    /// What `--adapt shading` has found out.
    const std::optional<visuals::shading::ShadingState>& shading() const { return quality_controller_.shading(); }

private:
    // Frames.
    world::RenderDevice render_device() const;
    void release_texture_memory();
    void start_flight();
    void simulate_to(double time_s, int frame, FrameState& frame_state);
    void set_cameras(FrameState& frame_state) const;
    visuals::scene::Camera camera_of(const settings::RunSettings& settings) const;
    report::FrameRecord render_frame(int frame, double time_s, std::optional<double> next_s);
    void fill_in(const visuals::planning::PlanCounts& counts, report::FrameRecord& record);

    // Changed settings (session_settings.cpp).
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
    Stopwatch since_first_frame_;
    /// follow_time_of_day(): the air of another time of day, present while the task makes the ground in its colours.
    std::optional<visuals::scene::AirSettings> recoloured_air_;
    /// Written by the task.
    world::SceneGround recoloured_ground_;
    /// The last member, because the task reads the others.
    BackgroundTask recolouring_;
};

} // namespace octant::ui::flight
