#include "visuals/planning/cockpit_dials.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace octant::visuals::planning {

namespace {

using Quantity = overlay::Dial::Quantity;

constexpr std::array<std::pair<std::string_view, Quantity>, 5> named_dials{
    {{"dial_speed", Quantity::Speed}, {"dial_altitude", Quantity::Altitude}, {"dial_attitude", Quantity::Attitude},
        {"dial_heading", Quantity::Heading}, {"dial_load", Quantity::LoadFactor}}};

/// The largest circle about the middle of a polygon's corners.
overlay::Dial dial_in(const models::polygons::PolygonModel& model, std::size_t polygon, Quantity quantity) {
    const auto corners = model.corners(polygon);
    glm::dvec3 middle_m(0.0);
    for (const std::uint32_t corner : corners) {
        middle_m += model.vertices_m[corner] / static_cast<double>(corners.size());
    }
    double radius_m = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 from_m = model.vertices_m[corners[i]];
        const glm::dvec3 along = glm::normalize(model.vertices_m[corners[(i + 1) % corners.size()]] - from_m);
        radius_m = std::min(radius_m, glm::length(glm::cross(along, middle_m - from_m)));
    }
    return {quantity, middle_m, radius_m};
}

} // namespace

overlay::InstrumentLayout dials_of(const models::polygons::PolygonModel& cockpit, const sim::AircraftLimits& limits) {
    overlay::InstrumentLayout layout;
    layout.speed_kt = overlay::speed_scale_kt(limits.max_speed_mps);
    layout.load_g = overlay::load_scale_g(limits.min_load_factor, limits.max_load_factor);
    for (const auto& [name, quantity] : named_dials) {
        const auto polygon = std::ranges::find_if(
            cockpit.polygons, [&, part = name](const auto& one) { return cockpit.parts[one.part] == part; });
        if (polygon != cockpit.polygons.end()) {
            const auto index = static_cast<std::size_t>(polygon - cockpit.polygons.begin());
            layout.dials.push_back(dial_in(cockpit, index, quantity));
        }
    }
    return layout;
}

} // namespace octant::visuals::planning
