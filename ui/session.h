#pragma once

#include "sim/base/hash.h"
#include "ui/formation.h"
#include "ui/report/frame_record.h"
#include "ui/stopwatch.h"
#include "ui/world.h"
#include "visuals/gl/context.h"
#include "visuals/gl/picture.h"
#include "visuals/gl/renderer.h"
#include "visuals/scene/camera_rig.h"
#include "visuals/scene/id_plan.h"
#include "visuals/scene/load_controller.h"
#include "visuals/scene/planner.h"
#include "visuals/scene/settings.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace octant::ui {

/// The context that the settings ask for, current in this thread. Throws Error.
std::unique_ptr<visuals::gl::Context> make_context(visuals::scene::ContextKind kind);

/// What the pictures of a session show.
enum class Shows {
    World,
    PolygonNumbers ///< scene::IdPlan: which polygon or triangle of ground each pixel belongs to
};

/// The conductor of a run: takes each frame from simulation through plan and picture to its record.
/// The only place that reads the clock during a flight.
class Session {
public:
    /// Makes the context, loads the world and draws once in every drawing state. Throws Error.
    /// Stays in its place: parts of it point at others.
    explicit Session(const visuals::scene::Settings& settings, Shows shows = Shows::World);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    Session(Session&&) = delete;
    Session& operator=(Session&&) = delete;

    const World& world() const { return world_; }

    const visuals::gl::ContextDescription& context() const { return context_->description(); }

    /// Number of frames of the run.
    int frames() const { return static_cast<int>(frame_times_s_.size()); }

    /// Frames a second of simulated time, for video and stress.
    double rate_hz() const { return rate_hz_; }

    /// Makes the session's context current: to be called before draw() when several sessions take
    /// turns.
    void make_current() { context_->make_current(); }

    /// Flies as many frames as there are numbers, at most frames() (asserted), each with that
    /// triangle target whatever the clock says. Before the first draw().
    void replay(std::vector<int> triangle_targets);

    /// Simulates up to the frame's time, plans, draws and reads the picture. Frames come in order.
    report::FrameRecord draw(int frame);

    /// Picture of the last frame, top row first.
    const visuals::gl::Picture& picture() const { return picture_; }

    /// Over the aircraft states at every fixed step so far, and over the pixels of every frame.
    std::uint64_t state_hash() const { return state_hash_.value(); }

    std::uint64_t picture_hash() const { return picture_hash_.value(); }

    /// Adds the last picture to the picture hash. Apart from draw(), because it is not the frame's
    /// work.
    void hash_picture();

private:
    void load_into_renderer(Shows shows);
    void make_frame_times();
    void simulate_to(double time_s);
    int choose_triangle_target(int frame);
    double stress_after(const report::FrameRecord& record);
    void states_at(double time_s);
    visuals::scene::Camera
    camera(const sim::AircraftState& state, const visuals::scene::RigMemory& rig) const;
    void mesh_ahead(int frame);

    visuals::scene::Settings settings_;
    std::unique_ptr<visuals::gl::Context> context_;
    World world_;
    std::unique_ptr<visuals::gl::Renderer> renderer_; ///< goes before its context
    visuals::scene::Planner planner_;
    std::optional<visuals::scene::IdPlan> ids_;
    Formation formation_;
    visuals::scene::GroundHeight ground_height_;
    std::vector<double> frame_times_s_;
    double rate_hz_ = 0.0;
    long next_step_ = 0;
    visuals::scene::RigMemory rig_;
    std::vector<sim::AircraftState> states_;
    visuals::gl::Picture picture_;
    int last_triangles_ = 0;
    visuals::scene::LoadSettings load_settings_;
    visuals::scene::LoadState load_;
    int frame_ahead_ = -1; ///< the one that triangle_target_ahead_ was chosen for
    int triangle_target_ahead_ = 0;
    std::vector<int> replayed_targets_; ///< by frame; empty = nothing is replayed
    Hash state_hash_;
    Hash picture_hash_;
    Stopwatch since_first_frame_;
};

} // namespace octant::ui
