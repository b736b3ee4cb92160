// Changed settings during a flight. All work that may fail comes first: loading, the work of threads, the memory of the
// renderer. The changes that cannot be undone come after it.
#include "ui/flight/session.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings_check.h"
#include "ui/world/path_placement.h"
#include "ui/world/scene_ground.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace octant::ui::flight {

namespace scene = visuals::scene;

void Session::apply(const settings::RunSettings& wanted) {
    const settings::RunSettings settings = world::with_sun_updated(wanted, settings_, world_.ground.place);
    const settings::SettingsChange change = settings::change_between(settings_, settings);
    if (change > settings::SettingsChange::Look && recoloured_air_) {
        recoloured_air_.reset();
        recolouring_.wait();
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
    pictures_.remove_views();
    settings_ = world::with_sun_at_time(settings, world.ground.place);
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
    const settings::RunSettings own = world::with_ground_defaults(settings, world_.ground.place);
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

    settings_ = settings;
    world_.points = points;
    set_ground(std::move(ground));
    pictures_.update_views(camera());
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
    pictures_.set_sun(camera());
}

bool Session::follow_time_of_day(const std::optional<std::string>& time) {
    if (recoloured_air_) {
        if (recolouring_.is_running()) { return false; }
        settings::RunSettings settings = settings_;
        settings.air = *std::exchange(recoloured_air_, std::nullopt);
        settings.air.visibility_m = settings_.air.visibility_m;
        recolouring_.wait();
        apply_sun_change(settings, std::move(recoloured_ground_));
        return true;
    }
    if (time == settings_.air.time) { return false; }
    settings::RunSettings wanted = settings_;
    wanted.air.time = time;
    wanted = world::with_sun_updated(std::move(wanted), settings_, world_.ground.place);
    recoloured_air_ = wanted.air;
    recolouring_.begin([this, settings = std::move(wanted)] {
        recoloured_ground_ = ground_for(settings);
        if (settings.air.sky) { recoloured_ground_.ground->backdrop(); }
    });
    return false;
}

} // namespace octant::ui::flight
