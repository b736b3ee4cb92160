#include "ui/flight/live_place.h"

#include "flightpaths/local_tangent.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::flight {

namespace {

constexpr double most_difference_m = 5.0;
constexpr std::size_t most_offsets = 1024;

constexpr std::array<std::pair<LiveHeight, std::string_view>, 3> names{
    {{LiveHeight::Msl, "msl"}, {LiveHeight::Agl, "agl"}, {LiveHeight::Offset, "offset"}}};

} // namespace

std::optional<LiveHeight> live_height_from(std::string_view name) {
    for (const auto& [height, known] : names) {
        if (known == name) {
            return height;
        }
    }
    return std::nullopt;
}

std::string_view name_of(LiveHeight height) {
    return names.at(static_cast<std::size_t>(height)).second;
}

LivePlace::LivePlace(const world::World& world, std::optional<LiveHeight> height)
    : world_(world)
    , height_is_chosen_(height.has_value())
    , height_(height.value_or(world.ground_place ? LiveHeight::Msl : LiveHeight::Offset))
    , origin_(world.ground_place) {}

std::optional<double> LivePlace::ground_m(const glm::dvec2& at_m) const {
    return world_.scene.ground->height_at(at_m.x, at_m.y);
}

double LivePlace::height_of(
    const sim::links::VehicleKey& key, const sim::links::Fix& fix, const glm::dvec2& at_m) {
    const std::optional<double> ours_m = ground_m(at_m);
    off_the_map_ = !ours_m;
    if (ours_m && fix.above_ground_m) {
        our_ground_m_ = *ours_m;
        their_ground_m_ = fix.altitude_m - *fix.above_ground_m;
        grounds_differ_ = std::abs(our_ground_m_ - their_ground_m_) > most_difference_m;
    }
    // A host of CIGI asks for the heights of our ground and means them.
    const bool means_ours = key.protocol == sim::links::Protocol::Cigi && !height_is_chosen_;
    switch (means_ours ? LiveHeight::Msl : height_) {
    case LiveHeight::Msl:
        break;
    case LiveHeight::Agl:
        if (ours_m && fix.above_ground_m) {
            return *ours_m + *fix.above_ground_m;
        }
        break;
    case LiveHeight::Offset: {
        const auto known = offsets_m_.find(key);
        if (known != offsets_m_.end()) {
            return fix.altitude_m + known->second;
        }
        const double theirs_m = fix.altitude_m - fix.above_ground_m.value_or(fix.altitude_m);
        const double offset_m = ours_m.value_or(0.0) - theirs_m;
        if (offsets_m_.size() < most_offsets) {
            offsets_m_.emplace(key, offset_m);
        }
        return fix.altitude_m + offset_m;
    }
    }
    return fix.altitude_m;
}

glm::dvec3 LivePlace::world_from(const sim::links::VehicleKey& key, const sim::links::Fix& fix) {
    const glm::dvec2 place_m = world_.flight.place_m;
    if (fix.local_m) {
        const glm::dvec2 own_m = place_m + *fix.local_m;
        return {own_m, height_of(key, fix, own_m)};
    }
    if (!origin_ &&
        ground_m(flightpaths::local_from_geo({}, fix.latitude_deg, fix.longitude_deg))) {
        origin_ = GeoPlace{}; // As we send from ground without a place.
    }
    if (!origin_) {
        // The world's origin, so that this fix comes to lie at the flight's place.
        const GeoPlace origin =
            flightpaths::geo_from_local({fix.latitude_deg, fix.longitude_deg}, -place_m);
        origin_ = origin;
    }
    const glm::dvec2 at_m =
        flightpaths::local_from_geo(*origin_, fix.latitude_deg, fix.longitude_deg);
    return {at_m, height_of(key, fix, at_m)};
}

std::vector<std::string> LivePlace::lines() const {
    std::vector<std::string> lines;
    if (!world_.ground_place && origin_) {
        lines.push_back(fmt::format(
            "made ground, placed at the first position {:.5f}, {:.5f}",
            origin_->latitude_deg,
            origin_->longitude_deg));
    }
    if (off_the_map_) {
        lines.emplace_back("off the map");
    }
    if (grounds_differ_ && height_ == LiveHeight::Msl) {
        lines.push_back(fmt::format(
            "grounds differ by {:.1f} m: theirs {:.1f} m, ours {:.1f} m; --height agl or offset",
            our_ground_m_ - their_ground_m_,
            their_ground_m_,
            our_ground_m_));
    }
    return lines;
}

} // namespace octant::ui::flight
