#include "ui/flight/session.h"

#include "sim/base/error.h"
#include "ui/base/stopwatch.h"
#include "ui/flight/renderer_choice.h"
#include "ui/report/statistics.h"
#include "ui/settings/settings_change.h"
#include "ui/settings/settings_check.h"
#include "ui/world/airfield.h"
#include "ui/world/scene_ground.h"
#include "ui/world/sun_at_time.h"
#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_texture_maker.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <future>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

namespace octant::ui::flight {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;
namespace shading = visuals::shading;

// Load management: the ground's triangle budget follows the frame time.
//
// Source: the load management of image generators (overload control by smoothed frame time with a dead band); no paper
// is followed.
//
// - The stress is smoothed by a first-order filter. Outside the dead band the budget glides to
//   where the smoothed stress is in the band's middle, twice as fast as the filter but in small
//   steps that geomorphs hide, and stays there: band and course together are the hysteresis.
// - A new budget takes the filter's memory with it as if the whole frame were ground: without that
//   the budget would overshoot by what it changes within the filter's time constant. What else a
//   frame holds makes a course slower, or end early and be followed by another, never swing back.

namespace {

using Trend = StressState::Trend;

double middle_of_band(const StressSettings& settings) { return 0.5 * (settings.min_stress + settings.max_stress); }

double time_constant_frames(const StressSettings& settings) {
    return std::max(1000.0 * settings.filter_s / settings.target_frame_ms, settings.filter_frames);
}

double filtered(double before, const StressSettings& settings, double stress) {
    return before + (1.0 - std::exp(-1.0 / time_constant_frames(settings))) * (stress - before);
}

Trend next_trend(Trend trend, const StressSettings& settings, double stress, bool budget_used) {
    const double above_middle = stress - middle_of_band(settings);
    const bool goes_on = std::abs(above_middle) > settings.settled_stress;
    if (stress > settings.max_stress || (trend == Trend::Falling && goes_on && above_middle > 0.0)) {
        return Trend::Falling;
    }
    const bool has_room = stress < settings.min_stress || (trend == Trend::Rising && goes_on && above_middle < 0.0);
    return has_room && budget_used ? Trend::Rising : Trend::Held;
}

/// What the target is multiplied with.
double change_of_target(const StressSettings& settings, double stress) {
    const double share_of_way = 1.0 - std::exp(-2.0 / time_constant_frames(settings));
    return std::clamp(1.0 + share_of_way * (middle_of_band(settings) / stress - 1.0), 1.0 - settings.max_fall,
        1.0 + settings.max_rise);
}

} // namespace

int StressState::triangles() const { return static_cast<int>(std::lround(target)); }

StressSettings stress_settings(const visuals::scene::Settings& settings, double rate_hz) {
    const int budget = visuals::scene::triangle_target(settings);
    StressSettings settings_of_run;
    settings_of_run.target_frame_ms = 1000.0 / rate_hz;
    settings_of_run.min_triangles = std::max(budget / 8, 1);
    constexpr int most = std::numeric_limits<int>::max();
    settings_of_run.max_triangles = budget > most / 4 ? most : 4 * budget;
    return settings_of_run;
}

StressState initial_state(double triangles, const StressSettings& settings) {
    StressState state;
    state.target = std::clamp<double>(triangles, settings.min_triangles, settings.max_triangles);
    state.expected_stress = middle_of_band(settings);
    return state;
}

StressState with_target(const StressState& state, int triangles) {
    StressState other = state;
    other.target = triangles;
    other.expected_stress = state.expected_stress * other.target / state.target;
    return other;
}

StressState next_state(const StressState& state, const StressSettings& settings, const FrameCost& cost) {
    assert(settings.target_frame_ms > 0.0 && settings.min_triangles >= 1 &&
           settings.max_triangles >= settings.min_triangles);
    assert(settings.min_stress > 0.0 && settings.max_stress >= settings.min_stress);
    assert(settings.max_counted_stress > settings.max_stress && settings.filter_frames >= 1.0);
    assert(cost.frame_ms >= 0.0);
    const double share_used = cost.frame_ms / settings.target_frame_ms;
    const double stress = filtered(state.expected_stress, settings, std::min(share_used, settings.max_counted_stress));
    const bool used = cost.triangles >= settings.used_share * state.target;
    StressState next;
    next.stress = filtered(state.stress.value_or(share_used), settings, share_used);
    next.trend = next_trend(state.trend, settings, stress, used);
    const double factor = next.trend == Trend::Held ? 1.0 : change_of_target(settings, stress);
    next.target = std::clamp<double>(state.target * factor, settings.min_triangles, settings.max_triangles);
    next.expected_stress = stress * next.target / state.target;
    return next;
}

void QualityController::begin(const scene::Settings& settings, double rate_hz) {
    adapt_ = settings.adapt;
    rate_hz_ = rate_hz;
    configured_triangles_ = scene::triangle_target(settings);
    stress_settings_ = stress_settings(settings, rate_hz);
    stress_ = initial_state(configured_triangles_, stress_settings_);
    shading_.reset();
}

int QualityController::triangle_target(int frame) {
    if (!replayed_targets_.empty()) {
        const auto number = static_cast<std::size_t>(frame);
        assert(number < replayed_targets_.size());
        stress_ = with_target(stress_, replayed_targets_[number].triangle_target);
        return stress_.triangles();
    }
    return adapt_.terrain ? stress_.triangles() : configured_triangles_;
}

std::optional<int> QualityController::smooth_target(int frame) const {
    if (!replayed_targets_.empty()) {
        const auto number = static_cast<std::size_t>(frame);
        assert(number < replayed_targets_.size());
        const int replayed = replayed_targets_[number].smooth_target;
        return replayed < 0 ? std::nullopt : std::optional(replayed);
    }
    if (!adapt_.shading) { return std::nullopt; }
    return shading_ ? shading_->smooth : 0;
}

double QualityController::add_frame(const FrameMeasurement& outcome) {
    add_shading_frame(outcome);
    if (!adapt_.terrain) { return outcome.frame_ms * rate_hz_ / 1000.0; }
    if (!outcome.warm_up) {
        stress_ = next_state(stress_, stress_settings_, {outcome.frame_ms, outcome.terrain_triangles});
    }
    return stress_.stress.value_or(std::numeric_limits<double>::quiet_NaN());
}

void QualityController::add_shading_frame(const FrameMeasurement& outcome) {
    if (!adapt_.shading || outcome.warm_up || outcome.smoothable_polygons == 0) { return; }
    if (!shading_) {
        shading_ = shading::initial_shading_state(outcome.smoothable_polygons);
        return;
    }
    shading::ShadingControllerSettings control;
    control.target_frame_ms = 1000.0 / rate_hz_;
    shading_ = shading::update_shading(*shading_, control,
        {outcome.frame_ms, outcome.smoothable_polygons - outcome.smooth_polygons, outcome.smooth_polygons},
        outcome.smoothable_polygons);
}

void FrameRenderer::load_models(PictureContent content) {
    if (content == PictureContent::PolygonIds) {
        ids_.emplace(scene_);
        renderer_.load_models(ids_->models());
        return;
    }
    std::vector<scene::ModelBuffers> buffers;
    for (const auto& model : scene_.models) { buffers.push_back(model->buffers); }
    renderer_.load_models(buffers);
}

void FrameRenderer::begin(const scene::Camera& first) {
    update_inset();
    planner_.emplace(scene_, settings_);
    planner_->reset_detail(first);
}

void FrameRenderer::end() {
    plan_ = nullptr;
    planner_.reset();
    inset_.reset();
}

planning::PlanRequest FrameRenderer::request(const FrameState& now, std::optional<int> smooth) const {
    return {.camera = now.camera,
        .states = now.states,
        .triangle_target = now.triangle_target,
        .smooth = {.polygons = smooth, .share = std::nullopt},
        .on_refined = nullptr,
        .overlay_lines = overlay_lines_,
        .articulated_parts = now.articulated_parts};
}

planning::PlanCounts FrameRenderer::plan(
    const FrameState& now, std::optional<int> smooth, std::function<void()> on_refined) {
    planning::PlanRequest wanted = request(now, smooth);
    wanted.on_refined = std::move(on_refined);
    const planning::PlannedFrame frame = planner_->plan(wanted);
    plan_ = ids_ ? &ids_->of(frame.plan) : &frame.plan;
    std::optional<double> share; // of the picture's polygons, and so of the inset's
    if (smooth && frame.counts.smoothable_polygons > 0) {
        share = std::min(static_cast<double>(*smooth) / frame.counts.smoothable_polygons, 1.0);
    }
    inset_plan_ = inset_ ? &inset_->plan(now.inset_camera, now.states, now.articulated_parts, share) : nullptr;
    return frame.counts;
}

void FrameRenderer::advance_without_drawing(const FrameState& now, std::optional<int> smooth) {
    planner_->advance_without_drawing(request(now, smooth));
    if (inset_) { inset_->advance_without_drawing(now.inset_camera, now.states, now.articulated_parts); }
}

void FrameRenderer::mesh_async(const FrameState& next) {
    const auto on_idle_thread = [this](std::function<void()> work) {
        return renderer_.begin_on_idle_thread(std::move(work));
    };
    planner_->begin_next_mesh(next.camera, next.triangle_target, on_idle_thread);
    if (inset_) { inset_->begin_next_mesh(next.inset_camera, on_idle_thread); }
}

void FrameRenderer::draw_plans() {
    renderer_.draw(*plan_);
    if (inset_plan_ != nullptr) { renderer_.draw_inset(*inset_plan_, inset_->rectangle()); }
}

void FrameRenderer::draw() {
    draw_plans();
    renderer_.finish();
}

void FrameRenderer::show() {
    picture_is_read_ = !presenter_ || reads_before_presenting_;
    if (!presenter_) {
        renderer_.finish_and_read(picture_);
        return;
    }
    if (reads_before_presenting_) { renderer_.finish_and_copy(picture_); }
    presenter_(renderer_);
}

void FrameRenderer::read(const FrameState& now, std::optional<int> smooth) {
    if (picture_is_read_) { return; }
    if (renderer_.is_drawn_to_window()) {
        if (plan_ == nullptr) { plan(now, smooth, nullptr); }
        renderer_.set_window_target(glm::ivec2(0));
        draw_plans();
    }
    renderer_.finish_and_read(picture_);
    picture_is_read_ = true;
}

void FrameRenderer::wait_for_first_view() { planner_->wait(); }

void FrameRenderer::wait() {
    wait_for_first_view();
    if (inset_) { inset_->wait(); }
}

void FrameRenderer::prepare_renderer(const scene::ViewSettings& view, const scene::GroundTexture* texture) {
    renderer_.resize(view.size_px, view.samples);
    if (texture == nullptr) { return; }
    try {
        renderer_.load_ground_texture(*texture);
    } catch (const Error&) {
        restore_window_size();
        throw;
    }
}

/// Gives the renderer its size back and draws the last picture once more. A driver that has no memory any more for what
/// it held before ends it all.
void FrameRenderer::restore_window_size() {
    try {
        renderer_.resize(settings_.view.size_px, settings_.view.samples);
    } catch (const Error& fault) { throw std::runtime_error(fault.what()); }
    if (plan_ != nullptr) { draw_plans(); }
}

void FrameRenderer::apply_settings(bool other_control, const scene::Camera& now) {
    plan_ = nullptr;
    update_ground(other_control, now);
    update_inset();
}

void FrameRenderer::update_ground(bool other_control, const scene::Camera& now) {
    std::unique_ptr<landscape::GroundMesher> mesher = planner_->take_mesher();
    const landscape::GroundMesher* const before = mesher.get();
    mesher = landscape::reuse_or_make_mesher(
        std::move(mesher), *scene_.ground, landscape::mesh_settings(settings_, scene_.ground_texture != nullptr));
    const bool settles = other_control || mesher.get() != before;
    planner_.reset();
    planner_.emplace(scene_, settings_, std::move(mesher));
    if (settles) { planner_->reset_detail(now); }
}

void FrameRenderer::update_inset() {
    if (!settings_.view.inset) {
        inset_.reset();
    } else if (inset_) {
        inset_->apply_settings(settings_);
    } else {
        inset_ = std::make_unique<InsetView>(settings_, scene_);
    }
}

void FrameRenderer::set_sun(const scene::Camera& now) {
    plan_ = nullptr;
    if (!planner_->set_sun()) { planner_->reset_detail(now); }
    if (inset_) { inset_->set_sun(settings_); }
}

void FrameRenderer::apply_look() {
    if (inset_) { inset_->apply_look(settings_); }
}

namespace {

std::unique_ptr<scene::Renderer> given_or_make_renderer(
    std::unique_ptr<scene::Renderer> given, const settings::RunSettings& settings) {
    return given ? std::move(given) : make_renderer(settings);
}

/// The world of the settings, loaded unless one is given that differs in nothing but its view.
world::World loaded_or_load_world(
    std::optional<world::World> given, const settings::RunSettings& settings, world::RenderDevice by) {
    if (!given) { return world::load_world(settings, by); }
    given->points = world::fixed_points(settings, *given);
    return std::move(*given);
}

} // namespace

Session::Session(const settings::RunSettings& settings, PictureContent content,
    std::unique_ptr<scene::Renderer> renderer, std::optional<world::World> loaded)
    : settings_(settings), renderer_(given_or_make_renderer(std::move(renderer), settings)),
      world_(loaded_or_load_world(std::move(loaded), settings, render_device())),
      pictures_(*renderer_, world_.scene, settings_), times_(world::picture_times_of(settings_, world_.flight)),
      ground_height_([this](double x_m, double y_m) { return world_.scene.ground->height_at(x_m, y_m); }) {
    settings_ = world::with_sun_at_time(settings_, world_.ground_place);
    pictures_.load_models(content);
    if (content == PictureContent::World && world_.scene.ground_texture) {
        renderer_->load_ground_texture(*world_.scene.ground_texture);
        release_texture_memory();
    }
    renderer_->warm_up();
    start_flight();
}

world::RenderDevice Session::render_device() const {
    return renderer_->info().is_software ? world::RenderDevice::Cpu : world::RenderDevice::Gpu;
}

/// Frees the texels of the texture, which the renderer has.
void Session::release_texture_memory() {
    std::shared_ptr<const scene::GroundTexture>& texture = world_.scene.ground_texture;
    if (texture) { texture = std::make_shared<const scene::GroundTexture>(landscape::without_texels(*texture)); }
}

void Session::start_flight() {
    simulation_.emplace(world_);
    quality_controller_.begin(settings_, rate_hz());
    begin_at(times_.times_s.front());
    pictures_.begin(camera_of(settings_));
    if (source_ != nullptr) { simulation_->set_state_source(*source_); }
}

void Session::set_state_source(StateSource& source) {
    source_ = &source;
    simulation_->set_state_source(source);
}

void Session::begin_at(double time_s) {
    simulation_->begin_at(time_s);
    next_is_simulated_ = false;
}

void Session::replay(std::vector<QualityTargets> quality_targets) {
    times_.truncate_to(quality_targets.size());
    quality_controller_.replay(std::move(quality_targets));
}

scene::Camera Session::camera_of(const settings::RunSettings& settings) const {
    scene::Subject subject = world_.scene.model_of(0).subject;
    if (!simulation_->is_live()) { subject.radius_m = simulation_->formation().framed_radius_m(subject.radius_m); }
    return scene::camera_of(
        settings.view, simulation_->states().front(), simulation_->rig(), subject, world_.points, ground_height_);
}

/// Chooses the cameras for the time that the simulation has reached.
void Session::set_cameras(FrameState& frame_state) const {
    frame_state.camera = camera_of(settings_);
    if (source_ != nullptr) {
        const glm::dvec2 size_px(settings_.view.size_px);
        frame_state.camera = source_->camera(simulation_->states(), frame_state.camera, size_px.x / size_px.y);
    }
    if (const settings::RunSettings* inset = pictures_.inset_settings()) {
        const glm::dvec2 size_px(inset->view.size_px);
        frame_state.inset_camera = camera_of(*inset);
        if (source_ != nullptr) {
            frame_state.inset_camera =
                source_->inset_camera(simulation_->states(), frame_state.inset_camera, size_px.x / size_px.y);
        }
    }
}

void Session::simulate_to(double time_s, int frame, FrameState& frame_state) {
    simulation_->advance_to(time_s);
    frame_state.time_s = time_s;
    frame_state.states.assign(simulation_->states().begin(), simulation_->states().end());
    if (source_ != nullptr) {
        const auto turned = source_->turned_parts();
        frame_state.articulated_parts.assign(turned.begin(), turned.end());
    }
    frame_state.state_hash = simulation_->state_hash();
    set_cameras(frame_state);
    frame_state.triangle_target = quality_controller_.triangle_target(frame);
}

report::FrameRecord Session::draw(int frame) {
    const auto number = static_cast<std::size_t>(frame);
    const bool last = number + 1 == times_.times_s.size();
    const report::FrameRecord record =
        render_frame(frame, times_.times_s[number], last ? std::optional<double>() : times_.times_s[number + 1]);
    if (last) { simulation_->advance_to(std::max(times_.last_step_s, record.sim_time_s)); }
    return record;
}

/// Whether the ground of a picture depends on the triangles that earlier ones had.
bool Session::ground_has_memory() const {
    const scene::DetailControl control = settings_.ground.detail;
    return control != scene::DetailControl::Exact && control != scene::DetailControl::Fixed;
}

settings::FrameRange Session::begin_frame_range(const settings::FlightPart& part) {
    const settings::FrameRange range = settings::frames_of(part, frames());
    times_.truncate_to(static_cast<std::size_t>(range.end));
    for (int before = 0; before < range.first; ++before) {
        simulate_to(times_.times_s[static_cast<std::size_t>(before)], before, current_);
        if (ground_has_memory() || before + 1 == range.first) {
            last_triangles_ = pictures_.plan(current_, smooth_target_, nullptr).ground.triangles;
        } else {
            pictures_.advance_without_drawing(current_, smooth_target_);
        }
    }
    since_first_frame_ = base::Stopwatch();
    return range;
}

report::FrameRecord Session::draw_at(double time_s, std::optional<double> next_s) {
    return render_frame(frames_drawn_++, time_s, next_s);
}

report::FrameRecord Session::render_frame(int frame, double time_s, std::optional<double> next_s) {
    if (frame == 0) { since_first_frame_ = base::Stopwatch(); }
    report::FrameRecord record;
    record.frame = frame;
    record.warm_up = frame < settings_.time.warm_up;
    record.sim_time_s = time_s;
    record.wall_s = since_first_frame_.s();

    counters_.begin();
    const base::Stopwatch whole;
    base::Stopwatch stage;
    if (next_is_simulated_ && next_.time_s == time_s) {
        std::swap(current_, next_);
    } else {
        simulate_to(time_s, frame, current_);
    }
    next_is_simulated_ = false;
    record.sim_ms = stage.lap_ms();

    smooth_target_ = quality_controller_.smooth_target(frame);
    const planning::PlanCounts counts = pictures_.plan(current_, smooth_target_, [&] {
        record.refine_ms = stage.lap_ms();
        pictures_.wait_for_first_view();
        record.mesh_wait_ms = stage.lap_ms();
    });
    record.plan_ms = record.refine_ms + record.mesh_wait_ms + stage.lap_ms();

    if (next_s && settings_.ground.mesh_async) {
        simulate_to(*next_s, frame + 1, next_);
        next_is_simulated_ = true;
        record.sim_ms += stage.lap_ms();
        pictures_.mesh_async(next_);
    }
    const base::OffCpuTimer idle;
    pictures_.draw();
    record.draw_wait_ms = idle.ms();
    record.draw_ms = stage.lap_ms();
    pictures_.show();
    record.read_ms = stage.lap_ms();
    record.frame_ms = whole.ms();
    record.counters = counters_.lap();
    record.state_hash = current_.state_hash;
    fill_in(counts, record);
    return record;
}

void Session::fill_in(const planning::PlanCounts& counts, report::FrameRecord& record) {
    record.triangle_target = current_.triangle_target;
    record.smooth_target = smooth_target_.value_or(-1);
    record.smooth_polygons = counts.smooth_polygons;
    record.aircraft_level = counts.aircraft_level;
    record.refine_splits = counts.refine_splits;
    record.refine_collapses = counts.refine_collapses;
    record.terrain_triangles = counts.ground.triangles;
    record.terrain_fans = counts.ground.fans;
    record.detail_triangles = counts.ground.detail_triangles;
    record.scenery_triangles = counts.ground.scenery_triangles;
    record.aircraft_polygons = counts.aircraft_polygons;
    record.draw_cell = counts.draw_cell;
    record.draw_calls = renderer_->draw_calls();
    record.shadow_triangles = counts.shadow_triangles;
    record.transparent_triangles = counts.transparent_triangles;
    record.cuts = counts.cuts;
    record.unordered = counts.unordered;
    record.resolution_c = counts.ground.resolution;
    record.error_px = counts.ground.error_px;
    record.triangle_change = record.frame == 0 ? 0 : counts.ground.triangles - last_triangles_;
    last_triangles_ = counts.ground.triangles;
    record.stress = quality_controller_.add_frame({record.frame_ms, record.terrain_triangles,
        counts.smoothable_polygons, counts.smooth_polygons, record.warm_up});
    record.overrun = record.frame_ms > report::overrun_16_ms ? 1 : 0;
    record.eye_m = current_.camera.eye_m;
    record.aircraft_m = current_.states.front().position_m;
    record.aircraft_agl_m =
        record.aircraft_m.z - ground_height_(record.aircraft_m.x, record.aircraft_m.y).value_or(0.0);
}

std::uint64_t Session::hash_picture() {
    Hash hash;
    hash.add(std::as_bytes(std::span(picture().rgba)));
    picture_hash_.add_word(hash.value());
    return hash.value();
}

// Changed settings during a flight. All work that may fail comes first: loading, the work of threads, the memory of the
// renderer. The changes that cannot be undone come after it.

void Session::apply(const settings::RunSettings& wanted) {
    const settings::RunSettings settings = world::with_sun_updated(wanted, settings_, world_.ground_place);
    const settings::SettingsChange change = settings::change_between(settings_, settings);
    if (change > settings::SettingsChange::Look && recoloured_ground_.valid()) {
        recoloured_ground_.wait();
        recoloured_ground_ = {};
    }
    switch (change) {
    case settings::SettingsChange::None:
        break;
    case settings::SettingsChange::Recording:
        settings_ = settings;
        break;
    case settings::SettingsChange::Look:
        if (settings.view.eye_m != settings_.view.eye_m || settings.view.look_m != settings_.view.look_m) {
            world_.points = world::fixed_points(settings, world_);
        }
        settings_ = settings;
        pictures_.apply_look();
        break;
    case settings::SettingsChange::Light:
        apply_sun_change(settings, ground_for(settings));
        break;
    case settings::SettingsChange::Picture:
        apply_picture_change(settings);
        break;
    case settings::SettingsChange::World:
    case settings::SettingsChange::Flight:
        apply_world_change(settings);
        break;
    }
}

void Session::apply_world_change(const settings::RunSettings& settings) {
    world::World world = world::load_world(settings, render_device(), &world_);
    world::PictureTimes times = world::picture_times_of(settings, world.flight);
    pictures_.wait();
    pictures_.prepare_renderer(settings.view, world.scene.ground_texture.get());

    const double time_s = simulation_->time_s();
    const bool goes_on =
        settings::change_between(settings_, settings) != settings::SettingsChange::Flight && !simulation_->by_hand();
    pictures_.end();
    settings_ = world::with_sun_at_time(settings, world.ground_place);
    world_ = std::move(world);
    times_ = std::move(times);
    pictures_.load_models(PictureContent::World);
    release_texture_memory();
    start_flight();
    if (goes_on) { begin_at(std::min(time_s, world_.flight.trajectory.end_s())); }
}

/// The ground for pictures by other settings: the one that is there, one made of its heights or, if neither will do,
/// one loaded. Without a texture where the one that is there stays.
world::SceneGround Session::ground_for(const settings::RunSettings& settings) const {
    const settings::RunSettings own = world::with_ground_defaults(settings, world_.ground_place);
    if (world_.scene.ground->matches_settings(own.ground, own.air)) {
        world::SceneGround same;
        same.ground = world_.scene.ground;
        return same;
    }
    std::optional<world::SceneGround> with_settings = world::rebuilt_scene_ground(world_.scene, own, render_device());
    return with_settings ? std::move(*with_settings)
                         : world::load_scene_ground(
                               settings, render_device(), world::fixed_runway_finder(world_.scene.ground->runway()));
}

void Session::apply_picture_change(const settings::RunSettings& settings) {
    settings::check_settings(settings);
    const scene::FixedViewpoints points = world::fixed_points(settings, world_);
    world::SceneGround ground = ground_for(settings);
    world::check_clouds(settings.air, *ground.ground);
    pictures_.wait();
    pictures_.prepare_renderer(settings.view, ground.texture.get());

    const bool other_control = !scene::same_detail_control(settings.ground, settings_.ground);
    settings_ = settings;
    world_.points = points;
    set_ground(std::move(ground));
    pictures_.apply_settings(other_control, current_.camera);
    if (next_is_simulated_) { set_cameras(next_); }
    quality_controller_.begin(settings_, rate_hz());
}

/// Ground for the scene, with its texture, which the renderer has.
void Session::set_ground(world::SceneGround ground) {
    world_.scene.ground = std::move(ground.ground);
    if (ground.texture) { // none comes with ground that was kept, which keeps its own
        world_.scene.ground_texture = std::move(ground.texture);
        release_texture_memory();
    }
}

void Session::apply_sun_change(const settings::RunSettings& settings, world::SceneGround ground) {
    pictures_.wait();
    if (ground.texture) { renderer_->load_ground_texture(*ground.texture); }
    settings_ = settings;
    set_ground(std::move(ground));
    pictures_.set_sun(current_.camera);
}

void Session::begin_set_sun(const settings::RunSettings& wanted) {
    assert(!recoloured_ground_.valid());
    settings::RunSettings settings = world::with_sun_updated(wanted, settings_, world_.ground_place);
    assert(settings::change_between(settings_, settings) <= settings::SettingsChange::Light);
    recoloured_air_ = settings.air;
    recoloured_ground_ = std::async(std::launch::async, [this, settings = std::move(settings)] {
        world::SceneGround ground = ground_for(settings);
        if (settings.air.sky) { ground.ground->backdrop(); }
        return ground;
    });
}

bool Session::poll_set_sun() {
    if (!recoloured_ground_.valid() ||
        recoloured_ground_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return false;
    }
    settings::RunSettings settings = settings_;
    settings.air = recoloured_air_;
    settings.air.visibility_m = settings_.air.visibility_m;
    apply_sun_change(settings, recoloured_ground_.get());
    return true;
}
} // namespace octant::ui::flight
