#include "ui/flight/live_flight.h"

#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/units.h"
#include "sim/sun_position.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <utility>

namespace octant::ui::flight {

namespace links = sim::links;
namespace scene = visuals::scene;

namespace {

constexpr double max_difference_m = 5.0;
constexpr std::size_t max_offsets = 1024;

} // namespace

LiveGeoreference::LiveGeoreference(const world::World& world, std::optional<LiveHeightMode> height)
    : world_(world), height_mode_is_given_(height.has_value()),
      height_(height.value_or(world.ground.frame ? LiveHeightMode::Msl : LiveHeightMode::Offset)) {}

std::optional<double> LiveGeoreference::ground_m(const glm::dvec2& at_m) const {
    return world_.scene.ground->height_at(at_m.x, at_m.y);
}

/// A vehicle at the height of the place where it started most likely stands there.
void LiveGeoreference::compare_grounds(const links::Fix& fix, std::optional<double> ours_m) {
    constexpr double at_home_m = 1.0;
    const bool is_home = fix.above_home_m && std::abs(*fix.above_home_m) < at_home_m;
    const auto theirs_m = fix.above_ground_m ? fix.above_ground_m : is_home ? fix.above_home_m : std::nullopt;
    if (ours_m && theirs_m) {
        our_ground_m_ = *ours_m;
        their_ground_m_ = fix.altitude_m - *theirs_m;
        grounds_differ_ = std::abs(our_ground_m_ - their_ground_m_) > max_difference_m;
    }
    agl_unknown_ = height_ == LiveHeightMode::Agl && !fix.above_ground_m;
}

/// FlightGear, while it loads, says that it stands on the ground where it will fly: until a vehicle has moved a little
/// its newest fix counts. One that has jumped begins anew.
double LiveGeoreference::offset_m(
    const links::VehicleKey& key, const links::Fix& fix, const glm::dvec2& at_m, double ours_m) {
    constexpr int settled = 3;
    constexpr double moved_m = 0.5;
    constexpr double jumped_m = 5000.0;
    if (offsets_.size() >= max_offsets && !offsets_.contains(key)) { offsets_.erase(offsets_.begin()); }
    const auto [known, is_new] = offsets_.try_emplace(key, Offset{.last_at_m = at_m});
    Offset& offset = known->second;
    const double way_m = glm::distance(at_m, offset.last_at_m);
    offset.moves = way_m > jumped_m ? 0 : offset.moves + (way_m > moved_m ? 1 : 0);
    offset.last_at_m = at_m;
    if (offset.moves <= settled) {
        const double above_m = fix.above_home_m.value_or(fix.altitude_m);
        const double theirs_m = fix.altitude_m - fix.above_ground_m.value_or(above_m);
        offset.added_m = ours_m - theirs_m;
    }
    return offset.added_m;
}

double LiveGeoreference::height_of(const links::VehicleKey& key, const links::Fix& fix, const glm::dvec2& at_m) {
    const std::optional<double> ours_m = ground_m(at_m);
    off_the_map_ = !ours_m;
    compare_grounds(fix, ours_m);
    // A host of CIGI asks for the heights of our ground and means them.
    const bool means_ours = key.protocol == links::Protocol::Cigi && !height_mode_is_given_;
    switch (means_ours ? LiveHeightMode::Msl : height_) {
    case LiveHeightMode::Msl:
        break;
    case LiveHeightMode::Agl:
        if (ours_m && fix.above_ground_m) { return *ours_m + *fix.above_ground_m; }
        break;
    case LiveHeightMode::Offset:
        return fix.altitude_m + offset_m(key, fix, at_m, ours_m.value_or(0.0));
    }
    return fix.altitude_m;
}

void LiveGeoreference::georeference_generated_ground(const GeoPosition& first) {
    assigned_frame_.emplace(GeoPosition{}); // As we send from ground without a place.
    if (!ground_m(assigned_frame_->local_from_geo(first))) {
        // So that the first fix comes to lie at the flight's place.
        assigned_frame_.emplace(TransverseMercator(first).geo_from_local(-world_.flight.place_m));
    }
}

glm::dvec3 LiveGeoreference::over_ground(const links::VehicleKey& key, const links::Fix& fix, const glm::dvec2& at_m) {
    const double height_m = height_of(key, fix, at_m);
    under_ground_m_ = ground_m(at_m).value_or(height_m) - height_m;
    return {at_m, height_m};
}

links::WorldPosition LiveGeoreference::world_position(const links::VehicleKey& key, const links::Fix& fix) {
    if (fix.local_m) { return {.at_m = over_ground(key, fix, world_.flight.place_m + *fix.local_m)}; }
    const GeoPosition place{fix.latitude_deg, fix.longitude_deg};
    if (frame() == nullptr) { georeference_generated_ground(place); }
    const FramePosition local = frame()->place_of(place);
    return {.at_m = over_ground(key, fix, local.east_north_m), .north_bearing_rad = local.north_bearing_rad};
}

std::vector<std::string> LiveGeoreference::lines() const {
    std::vector<std::string> lines;
    if (assigned_frame_) {
        lines.push_back(fmt::format("made ground, placed at the first position {:.5f}, {:.5f}",
            assigned_frame_->origin().latitude_deg, assigned_frame_->origin().longitude_deg));
    }
    if (const Ellipsoid below = ellipsoid_below(origin()); !below.is_earth()) {
        lines.push_back(fmt::format("latitudes and longitudes are taken as places on {}", name_of_body(below)));
    }
    if (off_the_map_) { lines.emplace_back("off the map"); }
    if (grounds_differ_ && height_ == LiveHeightMode::Msl) {
        lines.push_back(
            fmt::format("grounds differ by {:.1f} m: theirs {:.1f} m, ours {:.1f} m; --height agl or offset",
                our_ground_m_ - their_ground_m_, their_ground_m_, our_ground_m_));
    }
    constexpr double told_m = 5.0; // what stands may lie a little lower
    if (under_ground_m_ > told_m) { lines.push_back(fmt::format("{:.1f} m under our ground", under_ground_m_)); }
    if (agl_unknown_) {
        lines.emplace_back("--height agl: the sender tells no height above ground, so that above the sea counts");
    }
    return lines;
}

namespace {

/// What CIGI hosts ask of the ground of a run, by the place that it has on the earth. Until that is known nothing is
/// inside the database. World and place must outlive this.
class WorldCigiGround final : public links::CigiGround {
public:
    WorldCigiGround(const world::World& world, const LiveGeoreference& place) : world_(world), place_(place) {}

    std::optional<links::CigiSurfacePoint> below(const glm::dvec3& place) const override {
        const FramePosition local = frame().place_of({place.x, place.y});
        const glm::dvec3 at_m(local.east_north_m, place.z);
        const auto ground_m = height_m(at_m);
        if (!ground_m) { return std::nullopt; }
        constexpr double aside_m = 0.5;
        const auto slope = [&](const glm::dvec3& along) {
            const double ahead_m = height_m(at_m + along).value_or(*ground_m);
            const double behind_m = height_m(at_m - along).value_or(*ground_m);
            return (ahead_m - behind_m) / (2.0 * aside_m);
        };
        const glm::dvec3 normal = glm::normalize(
            glm::dvec3(-slope(glm::dvec3(aside_m, 0.0, 0.0)), -slope(glm::dvec3(0.0, aside_m, 0.0)), 1.0));
        return links::CigiSurfacePoint{glm::dvec3(place.x, place.y, *ground_m),
            wrapped_to_two_pi(std::atan2(normal.x, normal.y) - local.north_bearing_rad),
            std::asin(std::clamp(normal.z, -1.0, 1.0))};
    }

    /// Looked for in steps of at most 2 m, or of a ten-thousandth of the line, then halved.
    std::optional<links::CigiGround::TerrainHit> first_hit(
        const glm::dvec3& from, const glm::dvec3& to) const override {
        constexpr double step_m = 2.0;
        constexpr double max_steps = 10000.0;
        constexpr double found_m = 0.01;
        constexpr int max_split_depth = 64;
        const glm::dvec3 from_m = world_position(from);
        const glm::dvec3 to_m = world_position(to);
        const double length_m = glm::length(to_m - from_m);
        const double steps = std::clamp(std::ceil(length_m / step_m), 1.0, max_steps);
        const auto is_under = [&](double share) {
            const glm::dvec3 at_m = glm::mix(from_m, to_m, share);
            const auto ground_m = height_m(at_m);
            return ground_m && at_m.z < *ground_m;
        };
        double open = 0.0;
        for (double step = 1.0; step <= steps; step += 1.0) {
            double met = step / steps;
            if (!is_under(met)) {
                open = met;
                continue;
            }
            // Bounded: of points very far away no two may be found_m apart.
            for (int i = 0; i < max_split_depth && (met - open) * length_m > found_m; ++i) {
                const double middle = 0.5 * (open + met);
                (is_under(middle) ? met : open) = middle;
            }
            const auto surface = below(geodetic_position(glm::mix(from_m, to_m, met)));
            return surface ? std::optional(TerrainHit{met * length_m, *surface}) : std::nullopt;
        }
        return std::nullopt;
    }

    double distance_m(const glm::dvec3& from, const glm::dvec3& to) const override {
        return glm::length(world_position(to) - world_position(from));
    }

    glm::dvec3 moved(const glm::dvec3& place, const glm::dvec3& ned_m) const override {
        const FramePosition local = frame().place_of({place.x, place.y});
        const glm::dvec2 moved_m = rotated_clockwise({ned_m.y, ned_m.x}, local.north_bearing_rad);
        return geodetic_position({local.east_north_m + moved_m, place.z - ned_m.z});
    }

private:
    const EarthFrame& frame() const { return frame_or_at_zero(place_.frame()); }

    glm::dvec3 world_position(const glm::dvec3& place) const {
        return {frame().local_from_geo({place.x, place.y}), place.z};
    }

    glm::dvec3 geodetic_position(const glm::dvec3& at_m) const {
        const GeoPosition geo = frame().geo_from_local(glm::dvec2(at_m.x, at_m.y));
        return {geo.latitude_deg, geo.longitude_deg, at_m.z};
    }

    std::optional<double> height_m(const glm::dvec3& at_m) const {
        return place_.frame() != nullptr ? world_.scene.ground->height_at(at_m.x, at_m.y) : std::nullopt;
    }

    const world::World& world_;
    const LiveGeoreference& place_;
};

/// The sun's own time at a longitude; nothing where the date is none.
std::optional<std::string> solar_time(const links::CigiCelestial& universal, double longitude_deg) {
    namespace chrono = std::chrono;
    constexpr unsigned century = 100;
    constexpr unsigned ten_thousand = 10000;
    const chrono::year_month_day date(chrono::year(static_cast<int>(universal.date % ten_thousand)),
        chrono::month(universal.date / (century * ten_thousand)), chrono::day(universal.date / ten_thousand % century));
    constexpr double minutes_a_degree = 4.0;
    if (!date.ok()) { return std::nullopt; }
    const auto time = chrono::sys_days(date) + chrono::hours(universal.hour) +
                      chrono::minutes(universal.minute + std::lround(minutes_a_degree * longitude_deg));
    const auto day = chrono::floor<chrono::days>(time);
    const chrono::year_month_day there(day);
    const auto minute = (time - day).count();
    std::string text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}", static_cast<int>(there.year()),
        static_cast<unsigned>(there.month()), static_cast<unsigned>(there.day()), minute / 60, minute % 60);
    return sim::solar_time_from_text(text) ? std::optional(std::move(text)) : std::nullopt;
}

} // namespace

scene::AirSettings air_from_cigi(scene::AirSettings defaults, const std::optional<links::CigiAtmosphere>& atmosphere,
    const std::optional<links::CigiCelestial>& celestial, const std::optional<GeoPosition>& place) {
    if (atmosphere) {
        constexpr double min_m = 50.0;
        constexpr double max_m = 5e5;
        defaults.visibility_m = std::clamp(atmosphere->visibility_m, min_m, max_m);
    }
    if (celestial && celestial->is_valid) {
        const double longitude_deg = place ? place->longitude_deg : 0.0;
        if (auto time = solar_time(*celestial, longitude_deg)) { defaults.time = std::move(time); }
    }
    return defaults;
}

namespace {

constexpr std::size_t no_aircraft = std::numeric_limits<std::size_t>::max();

} // namespace

LiveFlight::LiveFlight(const LiveOptions& options, const world::World& world)
    : options_(options), world_(world), place_(world, options.height),
      cigi_ground_(std::make_unique<WorldCigiGround>(world, place_)),
      traffic_([this](const links::VehicleKey& key, const links::Fix& fix) { return place_.world_position(key, fix); },
          cigi_ground_.get(), ellipsoid_below(world.ground.place)) {}

void LiveFlight::states_at(double time_s, std::span<sim::AircraftState> states) {
    vehicle_states_.resize(states.size());
    const std::size_t shown = options_.step ? traffic_.show_newest(time_s, vehicle_states_)
                                            : traffic_.show(time_s, options_.delay_s, vehicle_states_);
    assign_aircraft(shown);
    for (std::size_t i = 1; i < states.size(); ++i) {
        states[i].position_m = glm::dvec3(0.0);
        states[i].is_present = false;
    }
    for (std::size_t i = 0; i < shown; ++i) { states[slots_[i].aircraft] = vehicle_states_[i]; }
    for (sim::AircraftState& state : states) { state.time_s = time_s; }
    turn_parts(time_s);
}

bool LiveFlight::is_flown(std::size_t aircraft) const {
    return std::ranges::find(slots_, aircraft, &VehicleSlot::aircraft) != slots_.end();
}

/// The aircraft that shows what this vehicle is said to be: the free ones from its own number on, for entities of a
/// type that has a shape those of that shape first.
std::size_t LiveFlight::free_aircraft(const links::VehicleKey& key, std::optional<std::uint16_t> type) const {
    const std::vector<std::uint32_t>& models = world_.scene.aircraft;
    const bool has_number = key.protocol == links::Protocol::Cigi && key.vehicle < models.size();
    const std::size_t first = has_number ? static_cast<std::size_t>(key.vehicle) : 0;
    std::optional<std::size_t> any;
    const auto shape = type ? options_.shapes.find(*type) : options_.shapes.end();
    for (std::size_t i = 0; i < models.size(); ++i) {
        const std::size_t place = (first + i) % models.size();
        if (is_flown(place)) { continue; }
        if (shape == options_.shapes.end() || models[place] == models.at(shape->second)) { return place; }
        any = any.value_or(place);
    }
    return *any;
}

/// Gives the first vehicles an aircraft each; those that have one keep it while they are of one type.
void LiveFlight::assign_aircraft(std::size_t vehicles) {
    for (std::size_t i = 0; i < vehicles; ++i) {
        const links::VehicleKey& key = traffic_.vehicles()[i].key();
        const bool is_entity = key.protocol == links::Protocol::Cigi;
        const auto type = is_entity ? traffic_.cigi().type_of(static_cast<std::uint16_t>(key.vehicle)) : std::nullopt;
        if (i == slots_.size()) {
            slots_.push_back({no_aircraft, type});
            slots_[i].aircraft = free_aircraft(key, type);
        } else if (type && type != slots_[i].type && !options_.shapes.empty()) {
            slots_[i] = {no_aircraft, type};
            slots_[i].aircraft = free_aircraft(key, type);
        }
    }
}

/// The aircraft that shows an entity of a CIGI host.
std::optional<std::size_t> LiveFlight::aircraft_of(std::uint16_t entity) const {
    const auto vehicles = traffic_.vehicles();
    const auto found = std::ranges::find_if(vehicles, [entity](const links::LiveVehicle& vehicle) {
        return vehicle.key().protocol == links::Protocol::Cigi && vehicle.key().vehicle == entity;
    });
    const auto number = static_cast<std::size_t>(found - vehicles.begin());
    return number < slots_.size() ? std::optional(slots_[number].aircraft) : std::nullopt;
}

/// Turns the articulated parts; in steps as far as their packets say and no further.
void LiveFlight::turn_parts(double time_s) {
    turned_.clear();
    const double shown_s = options_.step ? 0.0 : time_s - options_.delay_s;
    for (const links::CigiPartPose& part : traffic_.cigi().parts().turned(shown_s)) {
        if (const auto aircraft = aircraft_of(part.entity)) {
            turned_.push_back({static_cast<std::uint32_t>(*aircraft), part.part, part.turn, part.offset_m});
        }
    }
}

// The cameras that a host of CIGI asks for: its views from its entities.

namespace {

/// Right and upper side of a usual picture's plane at distance 1.
glm::dvec2 default_half_tangent(double aspect) {
    const double high = std::tan(0.5 * scene::Camera().vertical_fov_rad);
    return {high * aspect, high};
}

/// Gives a camera the frustum of a host's view; sides that the host has not told are the usual ones. Leaves it as it is
/// where sides meet.
void set_frustum(const links::CigiViewDefinition& definition, double aspect, scene::Camera& camera) {
    const glm::dvec2 half = default_half_tangent(aspect);
    const auto side = [](bool is_given, double angle_rad, double default_tangent) {
        return is_given ? std::tan(angle_rad) : default_tangent;
    };
    const glm::dvec2 least(
        side(definition.sets.x, definition.left_rad, -half.x), side(definition.sets.w, definition.bottom_rad, -half.y));
    const glm::dvec2 most(
        side(definition.sets.y, definition.right_rad, half.x), side(definition.sets.z, definition.top_rad, half.y));
    const glm::dvec2 size = most - least;
    constexpr double narrowest = 1e-3;
    if (size.x < narrowest || size.y < narrowest) { return; }
    camera.vertical_fov_rad = 2.0 * std::atan(0.5 * size.y);
    camera.middle = 0.5 * (least + most);
    camera.pixel_aspect = size.x / (size.y * aspect);
}

double width_rad(const scene::Camera& camera, double aspect) {
    const double half = std::tan(0.5 * camera.vertical_fov_rad) * camera.pixel_aspect * aspect;
    return 2.0 * std::atan(half);
}

} // namespace

/// The host's camera or the usual one; that of the first view is turned to this channel's side.
scene::Camera LiveFlight::camera(std::size_t view, std::span<const sim::AircraftState> states,
    const scene::Camera& default_camera, double aspect) const {
    const auto number = cigi_view(view);
    scene::Camera camera = (number ? camera_of_view(*number, states, aspect) : std::nullopt).value_or(default_camera);
    if (view == 0 && options_.channel != LiveChannel::Front) {
        const double side = options_.channel == LiveChannel::Left ? 1.0 : -1.0;
        camera.view_to_world =
            camera.view_to_world * glm::angleAxis(side * width_rad(camera, aspect), glm::dvec3(0.0, 1.0, 0.0));
    }
    return camera;
}

/// The number of the host's view that a view shows: the first one that was asked for, or the lowest that the host has
/// told, then those after it.
std::optional<std::uint16_t> LiveFlight::cigi_view(std::size_t view) const {
    const auto& views = traffic_.cigi().views();
    std::optional<std::uint16_t> number;
    if (options_.view) {
        number = static_cast<std::uint16_t>(*options_.view);
    } else if (!views.empty()) {
        number = views.begin()->first;
    }
    for (; view > 0 && number; --view) {
        const auto next = views.upper_bound(*number);
        number = next == views.end() ? std::nullopt : std::optional(next->first);
    }
    return number;
}

/// A view from its entity, turned and moved, with its frustum.
std::optional<scene::Camera> LiveFlight::camera_of_view(
    std::uint16_t number, std::span<const sim::AircraftState> states, double aspect) const {
    const auto& views = traffic_.cigi().views();
    const auto& definitions = traffic_.cigi().definitions();
    const auto definition = views.find(number);
    const auto aircraft = definition == views.end() ? std::nullopt : aircraft_of(definition->second.entity);
    if (!aircraft) { return std::nullopt; }
    const links::CigiViewControl& view = definition->second;
    const sim::AircraftState& state = states[*aircraft];
    scene::Camera camera;
    if (const auto defined = definitions.find(number); defined != definitions.end()) {
        set_frustum(defined->second, aspect, camera);
    }
    // Body axes of the view (ahead, right, down) within those of the entity, then those of OpenGL.
    const glm::dquat north_up = body_to_world_from_euler({});
    const glm::dquat turned = glm::conjugate(north_up) * body_to_world_from_euler(view.angles);
    const glm::dquat view_to_world = state.body_to_world * turned;
    camera.view_to_world = glm::normalize(view_to_world * scene::body_from_view());
    camera.eye_m = state.position_m + state.body_to_world * view.offset_m;
    return camera;
}

/// Where the host wants a picture of another shape, or of another kind, than this is.
std::optional<std::string> LiveFlight::frustum_line() const {
    const auto number = cigi_view(0);
    const auto& definitions = traffic_.cigi().definitions();
    const auto defined = number ? definitions.find(*number) : definitions.end();
    if (defined == definitions.end()) { return std::nullopt; }
    if (defined->second.parallel) {
        return fmt::format("CIGI: view {} is orthographic; it is shown in perspective", *number);
    }
    scene::Camera camera;
    set_frustum(defined->second, aspect_, camera);
    constexpr double same = 0.02;
    if (std::abs(camera.pixel_aspect - 1.0) <= same) { return std::nullopt; }
    return fmt::format("CIGI: view {} has the shape {:.2f}:1, this picture {:.2f}:1; pixels are {:.2f} times as "
                       "wide as high",
        *number, camera.pixel_aspect * aspect_, aspect_, camera.pixel_aspect);
}

// What is told, and the environment.

scene::AirSettings LiveFlight::air_of(const scene::AirSettings& own) const {
    const links::CigiImageGenerator& cigi = traffic_.cigi();
    return air_from_cigi(own, cigi.atmosphere(), cigi.celestial(), place_.origin());
}

std::vector<std::string> LiveFlight::lines() const {
    std::vector<std::string> lines = traffic_.lines();
    const std::vector<std::string> of_place = place_.lines();
    lines.insert(lines.end(), of_place.begin(), of_place.end());
    for (const VehicleSlot& place : slots_) {
        if (place.type && !options_.shapes.empty() && !options_.shapes.contains(*place.type)) {
            lines.push_back(fmt::format("CIGI: --entities has no entity type {}: it is shown as {}", *place.type,
                world_.scene.model_of(place.aircraft).polygons.name));
            break;
        }
    }
    if (const auto line = frustum_line()) { lines.push_back(*line); }
    return lines;
}

void LiveFlight::fill_in(report::FrameRecord& record, double finished_s) {
    const links::TrafficCounts& now = traffic_.counts();
    const auto since = [&](long links::TrafficCounts::*count) {
        return static_cast<int>(now.*count - reported_counts_.*count);
    };
    record.packets = since(&links::TrafficCounts::accepted);
    if (now.lost) { record.packets_lost = static_cast<double>(*now.lost - reported_counts_.lost.value_or(0)); }
    record.packets_late = since(&links::TrafficCounts::late);
    record.packets_wrong = since(&links::TrafficCounts::wrong);
    reported_counts_ = now;
    if (traffic_.cigi().has_host()) {
        constexpr std::uint32_t positive = 0x7fffffff;
        record.host_frame = static_cast<int>(traffic_.cigi().host_frame() & positive);
    }
    record.stale = traffic_.is_stale() ? 1 : 0;
    if (!traffic_.vehicles().empty()) { record.jitter_ms = 1000.0 * traffic_.vehicles().front().clock().jitter_s(); }
    if (record.packets > 0 && traffic_.newest_s() > newest_s_) {
        newest_s_ = traffic_.newest_s();
        record.latency_ms = 1000.0 * (finished_s - newest_s_);
    }
}

void apply_host_visibility(LiveFlight& live, Session& session) {
    const glm::dvec2 size_px(session.settings().view.size_px);
    live.set_aspect(size_px.x / size_px.y);
    if (!live.traffic().cigi().atmosphere()) { return; }
    const double visibility_m = live.air_of(session.settings().air).visibility_m;
    if (visibility_m != session.settings().air.visibility_m) {
        settings::RunSettings settings = session.settings();
        settings.air.visibility_m = visibility_m;
        session.apply(settings);
    }
}

std::optional<std::string> apply_host_time_of_day(const LiveFlight& live, Session& session) {
    const std::optional<std::string> told = live.air_of(session.settings().air).time;
    if (!live.is_stepped()) { return session.follow_time_of_day(told) ? session.settings().air.time : std::nullopt; }
    if (told == session.settings().air.time) { return std::nullopt; }
    set_time_of_day(*told, session);
    return told;
}

void set_time_of_day(const std::string& time_of_day, Session& session) {
    settings::RunSettings settings = session.settings();
    settings.air.time = time_of_day;
    session.apply(settings);
}

} // namespace octant::ui::flight
