#include "sim/base/error.h"
#include "ui/flight/session.h"
#include "ui/settings/settings_change.h"
#include "ui/settings/settings_check.h"
#include "ui/world/scene_ground.h"
#include "visuals/scene/ground_palette.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

// What a session does when its settings change while a flight goes on.

namespace octant::ui::flight {

namespace scene = visuals::scene;

void Session::apply(const settings::Settings& settings) {
    switch (settings::change_between(settings_, settings)) {
    case settings::SettingsChange::None:
        break;
    case settings::SettingsChange::Look:
        if (settings.view.eye_m != settings_.view.eye_m ||
            settings.view.look_m != settings_.view.look_m) {
            world_.points = world::fixed_points(settings, world_);
        }
        settings_ = settings;
        break;
    case settings::SettingsChange::Picture:
        change_picture(settings);
        break;
    case settings::SettingsChange::World:
    case settings::SettingsChange::Flight:
        change_world(settings);
        break;
    }
}

/// Loading comes before what could not be taken back; a driver that then has no memory ends it all.
void Session::change_world(const settings::Settings& settings) {
    world::World world = world::load_world(settings, drawn_by());
    world::FrameTimes times = world::frame_times_of(settings, world.flight);
    std::unique_ptr<InsetView> inset;
    if (settings.view.inset) {
        inset = std::make_unique<InsetView>(settings, world, drawn_by());
    }
    renderer_->resize(settings.view.size_px, settings.view.samples);
    const double time_s = simulation_->time_s();
    const bool goes_on =
        settings::change_between(settings_, settings) != settings::SettingsChange::Flight &&
        !simulation_->by_hand();
    plan_ = nullptr;
    planner_.reset();
    settings_ = settings;
    world_ = std::move(world);
    inset_ = std::move(inset);
    times_ = std::move(times);
    try {
        load_into_renderer(Shows::World);
    } catch (const Error& fault) {
        throw std::runtime_error(fault.what());
    }
    start_flight();
    if (goes_on) {
        begin_at(std::min(time_s, world_.flight.trajectory.end_s()));
    }
}

/// All that may fail comes before what could not be taken back.
void Session::change_picture(const settings::Settings& settings) {
    settings::check_settings(settings);
    const scene::FixedPoints points = world::fixed_points(settings, world_);
    std::unique_ptr<InsetView> new_inset;
    if (settings.view.inset && !inset_) {
        new_inset = std::make_unique<InsetView>(settings, world_, drawn_by());
    }
    world::World other;
    const bool follows =
        world_.scene.ground->can_follow(world::ground_settings(settings)) &&
        !(world_.scene.ground_texture &&
          !scene::same_colours(
              world::ground_settings(settings).air, world::ground_settings(settings_).air));
    if (!follows) {
        world::load_scene_ground(settings, drawn_by(), other);
    }
    renderer_->resize(settings.view.size_px, settings.view.samples);

    const bool other_control = settings.ground.detail != settings_.ground.detail ||
                               settings.ground.resolution_c != settings_.ground.resolution_c;
    plan_ = nullptr;
    planner_.reset();
    settings_ = settings;
    world_.points = points;
    take_ground(follows ? nullptr : &other);
    planner_.emplace(world_.scene, settings_);
    if (other_control || !follows) {
        planner_->settle(now_.camera);
    }
    follow_inset(std::move(new_inset));
    if (next_is_reached_) {
        look(next_);
    }
    load_settings_ = scene::load_settings(settings_, rate_hz());
    load_ = scene::starting_at(scene::triangle_target(settings_), load_settings_);
    shading_.reset();
}

/// The ground of another world, or the same by other settings.
void Session::take_ground(world::World* other) {
    if (other == nullptr) {
        world_.scene.ground->follow(world::ground_settings(settings_));
        return;
    }
    world_.scene.ground = std::move(other->scene.ground);
    world_.scene.ground_texture = std::move(other->scene.ground_texture);
    try {
        load_texture();
    } catch (const Error& fault) {
        throw std::runtime_error(fault.what());
    }
}

void Session::follow_inset(std::unique_ptr<InsetView> new_inset) {
    if (new_inset) {
        inset_ = std::move(new_inset);
    } else if (!settings_.view.inset) {
        inset_.reset();
    } else {
        inset_->follow(settings_);
    }
}

} // namespace octant::ui::flight
