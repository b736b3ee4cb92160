#include "models/meshfile/flightgear_rest_placements.h"

#include "models/meshfile/flightgear_conditions.h"
#include "models/meshfile/flightgear_numbers.h"
#include "sim/base/units.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <limits>
#include <string_view>

namespace octant::models::meshfile {

namespace {

/// Degrees or metres, for the property's value of 0; without one for the position at the start.
/// `unit`: as its elements' names end.
double value_at_rest(
    const std::filesystem::path& file, const XmlElement& animation, std::string_view unit) {
    const auto number = [&](std::string_view name, double without) {
        return number_in(file, animation, std::string(name) + std::string(unit), without);
    };
    const bool has_property = !animation.text_of("property").empty();
    const double input = has_property ? 0.0 : number("starting-position", 0.0);
    if (animation.find("interpolation") != nullptr) {
        return interpolated(file, animation, input);
    }
    constexpr double any = std::numeric_limits<double>::max();
    const double factor = input == 0.0 ? 1.0 : number_in(file, animation, "factor", 1.0);
    const double value = input * factor + number("offset", 0.0);
    return std::min(std::max(value, number("min", -any)), number("max", any));
}

AffineTransform turned_about(const RotationAxis& axis, double angle_rad) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle_rad, axis.direction));
    return {turn, axis.point_m - turn * axis.point_m};
}

} // namespace

std::optional<FlightGearRestPlacement>
placement_at_rest(const std::filesystem::path& file, const XmlElement& animation) {
    const std::string_view kind = animation.text_of("type");
    const bool turns = kind == "rotate";
    if ((!turns && kind != "translate") || animation.find("expression") != nullptr ||
        !holds_at_rest(animation)) {
        return std::nullopt;
    }
    const double value = value_at_rest(file, animation, turns ? "-deg" : "-m");
    if (value == 0.0) { // then its axis does not count: files have faulty ones
        return std::nullopt;
    }
    RotationAxis axis = axis_in(file, animation);
    const double length = glm::length(axis.direction);
    if (!(length > 0.0)) {
        return std::nullopt;
    }
    axis.direction /= length;
    FlightGearRestPlacement move;
    move.placement = turns ? turned_about(axis, rad_from_deg(value))
                           : AffineTransform{glm::dmat3(1.0), value * axis.direction};
    for (const XmlElement& named : animation.children) {
        if (named.name == "object-name") {
            move.objects.insert(named.text);
        }
    }
    if (move.objects.empty()) {
        move.objects.insert("");
    }
    return move;
}

} // namespace octant::models::meshfile
