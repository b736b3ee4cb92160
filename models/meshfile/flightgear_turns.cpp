#include "models/meshfile/flightgear_turns.h"

#include "models/meshfile/flightgear_numbers.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace octant::models::meshfile {

namespace {

/// What a property of a kind is worth at cruise.
struct CruiseValue {
    std::string_view part_of_name;
    double value = 0.0;
};

/// The first one that fits counts.
constexpr std::array cruise_values{
    CruiseValue{"rotors/main", 390.0},
    CruiseValue{"rotors/tail", 2000.0},
    CruiseValue{"rpm", 2400.0},
    CruiseValue{"/n1", 90.0},
    CruiseValue{"/n2", 90.0}};

/// Whether a property is one of an engine or rotor itself, not of a dial that shows it.
bool is_of_engine(std::string_view property) {
    return property.find("instrument") == property.npos &&
           (property.find("engine") != property.npos || property.find("rotor") != property.npos ||
            property.find("propeller") != property.npos);
}

double at_cruise(std::string_view property) {
    if (!is_of_engine(property)) {
        return 0.0;
    }
    const auto* const found = std::ranges::find_if(cruise_values, [&](const CruiseValue& one) {
        return property.find(one.part_of_name) != property.npos;
    });
    return found == cruise_values.end() ? 0.0 : found->value;
}

/// Turns a minute while the factor is 1; 0 for what does not turn in flight.
double turns_per_minute(std::string_view kind, std::string_view property) {
    const bool is_angle = property.find("position-deg") != property.npos;
    if (kind == "spin" ? is_angle : !is_angle) {
        return 0.0;
    }
    return kind == "spin" || kind == "rotate" ? at_cruise(property) : 0.0;
}

glm::dvec3 vector_in(
    const std::filesystem::path& file,
    const XmlElement& parent,
    const std::array<std::string_view, 3>& names) {
    return {
        number_in(file, parent, names[0]),
        number_in(file, parent, names[1]),
        number_in(file, parent, names[2])};
}

/// A point of the axis and its direction, which has no length where the file gives none.
TurningAxis axis_in(const std::filesystem::path& file, const XmlElement& animation) {
    TurningAxis about;
    about.direction = glm::dvec3(0.0);
    if (const XmlElement* axis = animation.find("axis")) {
        if (axis->find("x1-m") != nullptr || axis->find("x2-m") != nullptr) {
            about.point_m = vector_in(file, *axis, {"x1-m", "y1-m", "z1-m"});
            about.direction = vector_in(file, *axis, {"x2-m", "y2-m", "z2-m"}) - about.point_m;
        } else {
            about.direction = vector_in(file, *axis, {"x", "y", "z"});
        }
    }
    if (const XmlElement* centre = animation.find("center")) {
        about.point_m = vector_in(file, *centre, {"x-m", "y-m", "z-m"});
    }
    return about;
}

} // namespace

std::optional<FlightGearTurn>
turn_in_flight(const std::filesystem::path& file, const XmlElement& animation) {
    const std::string_view kind = animation.text_of("type");
    const double rate = turns_per_minute(kind, animation.text_of("property"));
    if (rate == 0.0) { // then its numbers do not count: files have faulty ones
        return std::nullopt;
    }
    const double factor = number_in(file, animation, "factor", 1.0);
    FlightGearTurn turn{{}, axis_in(file, animation)};
    const double length = glm::length(turn.about.direction);
    if (factor == 0.0 || !(length > 0.0)) {
        return std::nullopt;
    }
    // An angle's factor only says which way round.
    const double times = kind == "spin" ? factor : std::copysign(1.0, factor);
    turn.about.direction /= length;
    turn.about.turns_per_s = rate * times / 60.0;
    for (const XmlElement& named : animation.children) {
        if (named.name == "object-name") {
            turn.objects.insert(named.text);
        }
    }
    return turn;
}

} // namespace octant::models::meshfile
