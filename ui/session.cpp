#include "ui/session.h"

#include "sim/base/units.h"
#include "sim/fixed_step.h"
#include "ui/report/statistics.h"
#include "visuals/gl/platform_tuning.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace octant::ui {

namespace scene = visuals::scene;
namespace gl = visuals::gl;

std::unique_ptr<gl::Context> make_context(scene::ContextKind kind) {
    return kind == scene::ContextKind::Egl ? gl::make_egl_context() : gl::make_osmesa_context();
}

namespace {

DrawnBy drawn_by(const gl::Context& context) {
    return gl::is_processor(context.description().renderer) ? DrawnBy::Processor : DrawnBy::Gpu;
}

void add_state(Hash& hash, const sim::AircraftState& state) {
    hash.add(std::as_bytes(std::span(glm::value_ptr(state.position_m), 3)));
    hash.add(std::as_bytes(std::span(glm::value_ptr(state.velocity_mps), 3)));
    hash.add(std::as_bytes(std::span(glm::value_ptr(state.body_to_world), 4)));
}

} // namespace

Session::Session(const scene::Settings& settings, Shows shows)
    : settings_(settings)
    , context_(make_context(settings.context))
    , world_(load_world(settings, drawn_by(*context_)))
    , renderer_(std::make_unique<gl::Renderer>(
          context_->functions(), settings.size_px.x, settings.size_px.y, settings.samples))
    , planner_(world_.scene, settings_)
    , formation_(formation_of(world_.scene))
    , ground_height_(
          [this](double x_m, double y_m) { return world_.scene.ground->height_at(x_m, y_m); })
    , next_step_(sim::step_at(world_.flight.trajectory.start_s())) {
    load_into_renderer(shows);
    renderer_->warm_up();
    gl::spread_raster_threads();
    states_.resize(world_.scene.aircraft.size());
    make_frame_times();
    load_settings_ = scene::load_settings(settings_, rate_hz_);
    load_ = scene::starting_at(scene::triangle_target(settings_), load_settings_);
    states_at(frame_times_s_.front());
    rig_ = scene::advanced(rig_, states_.front());
    planner_.settle(camera(states_.front(), rig_));
}

Session::~Session() {
    context_->make_current();
}

void Session::load_into_renderer(Shows shows) {
    if (shows == Shows::PolygonNumbers) {
        ids_.emplace(world_.scene);
        renderer_->load_models(ids_->models());
        return;
    }
    std::vector<scene::ModelBuffers> buffers;
    for (const scene::AircraftModel& model : world_.scene.models) {
        buffers.push_back(model.buffers);
    }
    renderer_->load_models(buffers);
    if (world_.scene.ground_texture) {
        renderer_->load_ground_texture(*world_.scene.ground_texture);
        world_.scene.ground_texture->albedo.texels = {};
        world_.scene.ground_texture->normal.texels = {};
    }
}

void Session::make_frame_times() {
    const sim::Trajectory& path = world_.flight.trajectory;
    double until_s = path.end_s();
    if (settings_.seconds) {
        until_s = std::min(until_s, path.start_s() + *settings_.seconds);
    }
    rate_hz_ = settings_.frame_per_sample ? world_.flight.rate_hz : settings_.rate_hz;
    const double half_frame_s = 0.5 / rate_hz_;
    if (settings_.frame_per_sample) {
        for (const sim::AircraftState& sample : path.samples()) {
            frame_times_s_.push_back(sample.time_s);
        }
        std::erase_if(
            frame_times_s_, [&](double time_s) { return time_s > until_s + half_frame_s; });
    } else {
        const auto count =
            static_cast<long>(std::floor((until_s - path.start_s()) * rate_hz_ + 1e-6)) + 1;
        for (long frame = 0; frame < count; ++frame) {
            frame_times_s_.push_back(path.start_s() + static_cast<double>(frame) / rate_hz_);
        }
    }
    if (settings_.frames && frame_times_s_.size() > static_cast<std::size_t>(*settings_.frames)) {
        frame_times_s_.resize(static_cast<std::size_t>(*settings_.frames));
    }
}

void Session::states_at(double time_s) {
    states_.front() = world_.flight.trajectory.state_at(time_s);
    for (std::size_t i = 1; i < states_.size(); ++i) {
        states_[i] = formation_.wingman_of(states_.front(), static_cast<int>(i));
    }
}

void Session::simulate_to(double time_s) {
    for (; next_step_ <= sim::step_at(time_s); ++next_step_) {
        states_at(sim::time_of_step(next_step_));
        rig_ = scene::advanced(rig_, states_.front());
        for (const sim::AircraftState& state : states_) {
            add_state(state_hash_, state);
        }
    }
    states_at(time_s);
}

void Session::replay(std::vector<int> triangle_targets) {
    assert(triangle_targets.size() <= frame_times_s_.size());
    frame_times_s_.resize(triangle_targets.size());
    replayed_targets_ = std::move(triangle_targets);
}

int Session::choose_triangle_target(int frame) {
    if (!replayed_targets_.empty()) {
        load_ = scene::with_target(load_, replayed_targets_[static_cast<std::size_t>(frame)]);
    }
    return settings_.adapt.terrain || !replayed_targets_.empty()
               ? load_.triangles()
               : scene::triangle_target(settings_);
}

/// What the frame's row says as its stress; decides the next frame's target where it adapts.
double Session::stress_after(const report::FrameRecord& record) {
    if (!settings_.adapt.terrain) {
        return record.frame_ms * rate_hz_ / 1000.0;
    }
    if (!record.warm_up) {
        load_ =
            scene::next_state(load_, load_settings_, {record.frame_ms, record.terrain_triangles});
    }
    return load_.stress.value_or(std::numeric_limits<double>::quiet_NaN());
}

scene::Camera Session::camera(const sim::AircraftState& state, const scene::RigMemory& rig) const {
    scene::Subject subject = world_.scene.models[world_.scene.aircraft.front()].subject;
    subject.radius_m = formation_.framed_radius_m(subject.radius_m);
    return scene::camera_of(settings_, state, rig, subject, world_.points, ground_height_);
}

/// Begins on the ground of a frame to come, with the camera that it is going to have.
void Session::mesh_ahead(int frame) {
    if (!settings_.mesh_ahead) {
        return;
    }
    const double time_s = frame_times_s_[static_cast<std::size_t>(frame)];
    const sim::Trajectory& path = world_.flight.trajectory;
    scene::RigMemory rig = rig_;
    for (long step = next_step_; step <= sim::step_at(time_s); ++step) {
        rig = scene::advanced(rig, path.state_at(sim::time_of_step(step)));
    }
    planner_.set_triangle_target(triangle_target_ahead_);
    planner_.prepare(camera(path.state_at(time_s), rig));
}

report::FrameRecord Session::draw(int frame) {
    if (frame == 0) {
        since_first_frame_ = Stopwatch();
    }
    report::FrameRecord record;
    record.frame = frame;
    record.warm_up = frame < settings_.warm_up;
    record.sim_time_s = frame_times_s_[static_cast<std::size_t>(frame)];
    record.wall_s = since_first_frame_.s();

    const Stopwatch whole;
    Stopwatch stage;
    simulate_to(record.sim_time_s);
    record.sim_ms = stage.lap_ms();

    record.triangle_target =
        frame == frame_ahead_ ? triangle_target_ahead_ : choose_triangle_target(frame);
    planner_.set_triangle_target(record.triangle_target);
    const scene::Camera seen_from = camera(states_.front(), rig_);
    scene::PlanCounts counts;
    const scene::FramePlan& plan = planner_.plan(seen_from, states_, counts);
    record.plan_ms = stage.lap_ms();

    if (frame + 1 < frames()) {
        frame_ahead_ = frame + 1;
        triangle_target_ahead_ = choose_triangle_target(frame_ahead_);
        mesh_ahead(frame_ahead_);
    }
    renderer_->draw(ids_ ? ids_->of(plan) : plan);
    renderer_->finish();
    record.draw_ms = stage.lap_ms();
    renderer_->finish_and_read(picture_);
    record.read_ms = stage.lap_ms();
    record.frame_ms = whole.ms();

    record.terrain_triangles = counts.ground.triangles;
    record.terrain_fans = counts.ground.fans;
    record.aircraft_polygons = counts.aircraft_polygons;
    record.draw_cell = counts.draw_cell;
    record.draw_calls = renderer_->draw_calls();
    record.shadow_triangles = counts.shadow_triangles;
    record.cuts = counts.cuts;
    record.unordered = counts.unordered;
    record.resolution_c = counts.ground.resolution;
    record.error_px = counts.ground.error_px;
    record.triangle_change = frame == 0 ? 0 : counts.ground.triangles - last_triangles_;
    last_triangles_ = counts.ground.triangles;
    record.stress = stress_after(record);
    record.overrun = record.frame_ms > report::overrun_16_ms ? 1 : 0;
    record.eye_m = seen_from.eye_m;
    record.aircraft_m = states_.front().position_m;
    record.aircraft_agl_m = record.aircraft_m.z -
                            ground_height_(record.aircraft_m.x, record.aircraft_m.y).value_or(0.0);
    return record;
}

void Session::hash_picture() {
    picture_hash_.add(std::as_bytes(std::span(picture_.rgba)));
}

} // namespace octant::ui
