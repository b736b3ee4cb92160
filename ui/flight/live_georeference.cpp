#include "ui/flight/live_georeference.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::flight {

namespace {

constexpr double max_difference_m = 5.0;
constexpr std::size_t max_offsets = 1024;

constexpr std::array<std::pair<LiveHeightMode, std::string_view>, 3> names{
    {{LiveHeightMode::Msl, "msl"}, {LiveHeightMode::Agl, "agl"}, {LiveHeightMode::Offset, "offset"}}};

} // namespace

std::optional<LiveHeightMode> live_height_mode_from(std::string_view name) {
    for (const auto& [height, known] : names) {
        if (known == name) {
            return height;
        }
    }
    return std::nullopt;
}

std::string_view name_of(LiveHeightMode height) {
    return names.at(static_cast<std::size_t>(height)).second;
}

LiveGeoreference::LiveGeoreference(const world::World& world, std::optional<LiveHeightMode> height)
    : world_(world)
    , height_mode_is_given_(height.has_value())
    , height_(height.value_or(world.ground_frame ? LiveHeightMode::Msl : LiveHeightMode::Offset)) {}

std::optional<double> LiveGeoreference::ground_m(const glm::dvec2& at_m) const {
    return world_.scene.ground->height_at(at_m.x, at_m.y);
}

/// A vehicle at the height of the place where it started most likely stands there.
void LiveGeoreference::compare_grounds(const sim::links::Fix& fix, std::optional<double> ours_m) {
    constexpr double at_home_m = 1.0;
    const bool is_home = fix.above_home_m && std::abs(*fix.above_home_m) < at_home_m;
    const auto theirs_m = fix.above_ground_m ? fix.above_ground_m
                          : is_home          ? fix.above_home_m
                                             : std::nullopt;
    if (ours_m && theirs_m) {
        our_ground_m_ = *ours_m;
        their_ground_m_ = fix.altitude_m - *theirs_m;
        grounds_differ_ = std::abs(our_ground_m_ - their_ground_m_) > max_difference_m;
    }
    agl_unknown_ = height_ == LiveHeightMode::Agl && !fix.above_ground_m;
}

/// FlightGear, while it loads, says that it stands on the ground where it will fly: until a vehicle
/// has moved a little its newest fix counts. One that has jumped begins anew.
double LiveGeoreference::offset_m(
    const sim::links::VehicleKey& key,
    const sim::links::Fix& fix,
    const glm::dvec2& at_m,
    double ours_m) {
    constexpr int settled = 3;
    constexpr double moved_m = 0.5;
    constexpr double jumped_m = 5000.0;
    if (offsets_.size() >= max_offsets && !offsets_.contains(key)) {
        offsets_.erase(offsets_.begin());
    }
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

double LiveGeoreference::height_of(
    const sim::links::VehicleKey& key, const sim::links::Fix& fix, const glm::dvec2& at_m) {
    const std::optional<double> ours_m = ground_m(at_m);
    off_the_map_ = !ours_m;
    compare_grounds(fix, ours_m);
    // A host of CIGI asks for the heights of our ground and means them.
    const bool means_ours = key.protocol == sim::links::Protocol::Cigi && !height_mode_is_given_;
    switch (means_ours ? LiveHeightMode::Msl : height_) {
    case LiveHeightMode::Msl:
        break;
    case LiveHeightMode::Agl:
        if (ours_m && fix.above_ground_m) {
            return *ours_m + *fix.above_ground_m;
        }
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

glm::dvec3 LiveGeoreference::over_ground(
    const sim::links::VehicleKey& key, const sim::links::Fix& fix, const glm::dvec2& at_m) {
    const double height_m = height_of(key, fix, at_m);
    under_ground_m_ = ground_m(at_m).value_or(height_m) - height_m;
    return {at_m, height_m};
}

sim::links::WorldPosition
LiveGeoreference::world_position(const sim::links::VehicleKey& key, const sim::links::Fix& fix) {
    if (fix.local_m) {
        return {.at_m = over_ground(key, fix, world_.flight.place_m + *fix.local_m)};
    }
    const GeoPosition place{fix.latitude_deg, fix.longitude_deg};
    if (frame() == nullptr) {
        georeference_generated_ground(place);
    }
    const FramePosition local = frame()->place_of(place);
    return {
        .at_m = over_ground(key, fix, local.east_north_m), .north_bearing_rad = local.north_bearing_rad};
}

std::vector<std::string> LiveGeoreference::lines() const {
    std::vector<std::string> lines;
    if (assigned_frame_) {
        lines.push_back(fmt::format(
            "made ground, placed at the first position {:.5f}, {:.5f}",
            assigned_frame_->origin().latitude_deg,
            assigned_frame_->origin().longitude_deg));
    }
    if (const Ellipsoid below = ellipsoid_below(origin()); !below.is_earth()) {
        lines.push_back(
            fmt::format("latitudes and longitudes are taken as places on {}", name_of_body(below)));
    }
    if (off_the_map_) {
        lines.emplace_back("off the map");
    }
    if (grounds_differ_ && height_ == LiveHeightMode::Msl) {
        lines.push_back(fmt::format(
            "grounds differ by {:.1f} m: theirs {:.1f} m, ours {:.1f} m; --height agl or offset",
            our_ground_m_ - their_ground_m_,
            their_ground_m_,
            our_ground_m_));
    }
    constexpr double told_m = 5.0; // what stands may lie a little lower
    if (under_ground_m_ > told_m) {
        lines.push_back(fmt::format("{:.1f} m under our ground", under_ground_m_));
    }
    if (agl_unknown_) {
        lines.emplace_back(
            "--height agl: the sender tells no height above ground, so that above the sea counts");
    }
    return lines;
}

} // namespace octant::ui::flight
