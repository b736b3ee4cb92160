#include "ui/flight/session.h"

#include "ui/base/stop_signals.h"
#include "ui/flight/renderer_choice.h"
#include "ui/report/statistics.h"
#include "ui/world/scene_ground.h"
#include "visuals/landscape/ground_texture_maker.h"
#include "visuals/scene/camera_rig.h"

#include <algorithm>
#include <utility>

namespace octant::ui::flight {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

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
    : settings_(settings), renderer_(renderer ? std::move(renderer) : make_renderer(settings)),
      world_(loaded_or_load_world(std::move(loaded), settings, render_device())),
      pictures_(*renderer_, world_.scene, settings_), times_(world::picture_times_of(settings_, world_.flight)),
      ground_height_([this](double x_m, double y_m) { return world_.scene.ground->height_at(x_m, y_m); }) {
    settings_ = world::with_sun_at_time(settings_, world_.ground.place);
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
    pictures_.update_views(camera_of(settings_));
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

/// Chooses the cameras of all views for the time that the simulation has reached.
void Session::set_cameras(FrameState& frame_state) const {
    frame_state.cameras.resize(pictures_.view_count());
    for (std::size_t view = 0; view < pictures_.view_count(); ++view) {
        const settings::RunSettings& settings = pictures_.view_settings(view);
        scene::Camera& camera = frame_state.cameras[view];
        camera = camera_of(settings);
        if (source_ != nullptr) {
            const glm::dvec2 size_px(settings.view.size_px);
            camera = source_->camera(view, simulation_->states(), camera, size_px.x / size_px.y);
        }
    }
}

void Session::simulate_to(double time_s, int frame, FrameState& frame_state) {
    simulation_->advance_to(time_s);
    frame_state.time_s = time_s;
    frame_state.states.assign(simulation_->states().begin(), simulation_->states().end());
    if (source_ != nullptr) {
        const auto turned = source_->articulated_parts();
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

settings::FrameRange Session::begin_frame_range(const settings::FlightPart& part) {
    const settings::FrameRange range = settings::frames_of(part, frames());
    times_.truncate_to(static_cast<std::size_t>(range.end));
    const visuals::terrain::DetailControl control = settings_.ground.lod.control;
    const bool ground_has_memory =
        control != visuals::terrain::DetailControl::Exact && control != visuals::terrain::DetailControl::Fixed;
    for (int before = 0; before < range.first; ++before) {
        simulate_to(times_.times_s[static_cast<std::size_t>(before)], before, current_);
        if (ground_has_memory || before + 1 == range.first) {
            last_triangles_ = pictures_.plan(current_, smooth_target_).counts.ground.triangles;
        } else {
            pictures_.advance_without_drawing(current_, smooth_target_);
        }
    }
    since_first_frame_ = Stopwatch();
    return range;
}

report::FrameRecord Session::draw_at(double time_s, std::optional<double> next_s) {
    return render_frame(frames_drawn_++, time_s, next_s);
}

report::FrameRecord Session::render_frame(int frame, double time_s, std::optional<double> next_s) {
    if (frame == 0) { since_first_frame_ = Stopwatch(); }
    report::FrameRecord record;
    record.frame = frame;
    record.warm_up = frame < settings_.time.warm_up;
    record.sim_time_s = time_s;
    record.wall_s = since_first_frame_.s();

    counters_.begin();
    const int pauses = base::StopSignals::pauses();
    const Stopwatch whole;
    Stopwatch stage;
    if (next_is_simulated_ && next_.time_s == time_s) {
        std::swap(current_, next_);
    } else {
        simulate_to(time_s, frame, current_);
    }
    next_is_simulated_ = false;
    record.sim_ms = stage.lap_ms();

    smooth_target_ = quality_controller_.smooth_target(frame);
    const FrameRenderer::PlannedPicture planned = pictures_.plan(current_, smooth_target_);
    record.refine_ms = planned.refine_ms;
    record.mesh_wait_ms = planned.mesh_wait_ms;
    record.plan_ms = stage.lap_ms();

    if (next_s && settings_.ground.mesh_async) {
        simulate_to(*next_s, frame + 1, next_);
        next_is_simulated_ = true;
        record.sim_ms += stage.lap_ms();
        pictures_.mesh_async(next_);
    }
    const OffCpuTimer idle;
    pictures_.draw();
    record.draw_wait_ms = idle.ms();
    record.draw_ms = stage.lap_ms();
    pictures_.show();
    record.read_ms = stage.lap_ms();
    record.frame_ms = whole.ms();
    record.paused = base::StopSignals::pauses() != pauses;
    record.counters = counters_.lap();
    record.state_hash = current_.state_hash;
    fill_in(planned.counts, record);
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
    record.eye_m = camera().eye_m;
    record.aircraft_m = current_.states.front().position_m;
    record.aircraft_agl_m =
        record.aircraft_m.z - ground_height_(record.aircraft_m.x, record.aircraft_m.y).value_or(0.0);
}

std::uint64_t Session::hash_picture() {
    const std::uint64_t hash = hash_by_quarters(std::as_bytes(std::span(picture().rgba)));
    picture_hash_.add_word(hash);
    return hash;
}

} // namespace octant::ui::flight
