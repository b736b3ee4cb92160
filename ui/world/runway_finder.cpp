#include "ui/world/runway_finder.h"

#include "models/heights/height_field.h"
#include "models/heights/local_frame.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "visuals/nature/runway.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace heights = models::heights;

namespace {

PlacementGround placement_ground(const heights::HeightField& field) {
    return {[&field](double x_m, double y_m) { return field.height_at(x_m, y_m); }, field.half_extent_m(),
        heights::frame_of_ground(field.system, field.place)};
}

/// Below the beginning of a path, along the way its aircraft looks there, or near the first 15 km.
heights::RunwayRequest runway_request_of(const sim::Trajectory& path, double water_m) {
    constexpr double step_m = 500.0;
    constexpr std::size_t max_places = 31;
    const sim::AircraftState& first = path.samples().front();
    const glm::dvec3 ahead = first.body_to_world * glm::dvec3(1.0, 0.0, 0.0);
    heights::RunwayRequest request;
    request.path_m.emplace_back(first.position_m);
    for (const sim::AircraftState& state : path.samples()) {
        const glm::dvec2 place_m(state.position_m);
        if (request.path_m.size() < max_places && glm::distance(request.path_m.back(), place_m) >= step_m) {
            request.path_m.push_back(place_m);
        }
    }
    request.heading_rad = std::atan2(ahead.x, ahead.y);
    request.water_m = water_m;
    return request;
}

/// Throws Error for a site that is none, or too rough.
void check_site(const std::optional<heights::RunwaySite>& site) {
    const std::string expected =
        fmt::format("--airfield: expected ground within {:.0f} km of the path on which a runway of 1,800 m "
                    "needs cuttings and embankments of at most {:.0f} m",
            heights::runway_search_radius_m / 1000.0, heights::max_earthwork_m);
    if (!site) { throw Error(fmt::format("{}, got only water or the edge of the map", expected)); }
    if (site->earthwork_m > heights::max_earthwork_m) {
        throw Error(fmt::format("{}, got {:.0f} m at best; another --place may do", expected, site->earthwork_m));
    }
}

std::string note_of(const heights::RunwaySite& site, const heights::RunwayRequest& request) {
    const std::array<std::string, 2> numbers = visuals::nature::runway_numbers(site.strip.heading_rad);
    std::string where = "where the path begins";
    if (!site.matches_request) {
        const glm::dvec2 way_m = site.strip.place({0.5 * site.strip.length_m, 0.0}) - request.path_m.front();
        const double bearing_deg = deg_from_rad(std::atan2(way_m.x, way_m.y));
        where = fmt::format("{:.1f} km from where the path begins, at {:03.0f} degrees, as rough ground, water "
                            "or the map's edge is in its way there",
            glm::length(way_m) / 1000.0, bearing_deg < 0.0 ? bearing_deg + 360.0 : bearing_deg);
    }
    return fmt::format("airfield: runway {}/{} lies {}; its cuttings and embankments are up to {:.0f} m high",
        numbers[0], numbers[1], where, site.earthwork_m);
}

} // namespace

RunwayFinder make_runway_finder(const settings::RunSettings& settings, const std::optional<LoadedPath>& script,
    std::optional<PathPlacement>& given_placement) {
    if (!settings.ground.airfield) { return nullptr; }
    return [&](const heights::HeightField& field, std::vector<std::string>& notes) {
        std::vector<std::string> unused; // placing the path on the levelled ground gives the same notes again
        const PlacementGround ground = placement_ground(field);
        const PlacedFlight first =
            script ? place_flight(settings, *script, ground, unused) : live_flight(settings, ground);
        given_placement = {first.place_m, first.heading_rad};
        const bool has_water = ellipsoid_below(field.place).is_earth();
        const heights::RunwayRequest request = runway_request_of(
            first.trajectory, has_water ? settings.air.water_level_m : -std::numeric_limits<double>::infinity());
        const auto site = heights::runway_site(field, request);
        check_site(site);
        notes.push_back(note_of(*site, request));
        return site->strip;
    };
}

RunwayFinder fixed_runway_finder(std::shared_ptr<const heights::RunwayStrip> runway) {
    if (!runway) { return nullptr; }
    return [runway = std::move(runway)](const heights::HeightField&, std::vector<std::string>&) { return *runway; };
}

} // namespace octant::ui::world
