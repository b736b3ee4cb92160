#include "models/meshfile/flightgear_rotations.h"

#include "models/meshfile/flightgear_numbers.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

namespace octant::models::meshfile {

namespace {

/// What a property of a kind is worth at cruise.
struct CruiseValue {
    std::string_view part_of_name;
    double value = 0.0;
};

/// Turns a minute.
constexpr double main_rotor = 390.0;
constexpr double tail_rotor = 2000.0;
constexpr double propeller = 2400.0;

/// The first one that fits counts.
constexpr std::array cruise_values{
    CruiseValue{"rotors/main", main_rotor},
    CruiseValue{"rotors/tail", tail_rotor},
    CruiseValue{"rpm", propeller},
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

/// Turns a minute of what is called a rotor or propeller, about an axis mostly along x, y or z;
/// 0 for what is called otherwise.
double rate_by_name(const XmlElement& animation, const glm::dvec3& direction) {
    const auto named = [](const XmlElement& child) {
        std::string name = child.name == "object-name" ? child.text : "";
        std::ranges::transform(name, name.begin(), [](unsigned char letter) {
            return static_cast<char>(std::tolower(letter));
        });
        return std::ranges::any_of(std::array{"rotor", "prop", "blade"}, [&](const char* part) {
            return name.find(part) != name.npos;
        });
    };
    if (std::ranges::none_of(animation.children, named)) {
        return 0.0;
    }
    const glm::dvec3 along = glm::abs(direction);
    const bool upright = along.z > std::max(along.x, along.y);
    return upright ? main_rotor : along.x > along.y ? propeller : tail_rotor;
}

/// Whether a property is one of what turns on the ground or in the cockpit.
bool is_of_other_wheels(std::string_view property) {
    return std::ranges::any_of(
        std::array<std::string_view, 4>{"gear", "wheel", "roll", "instrument"},
        [&](std::string_view part) { return property.find(part) != property.npos; });
}

} // namespace

std::optional<FlightGearRotation>
rotation_in_flight(const std::filesystem::path& file, const XmlElement& animation) {
    const std::string_view kind = animation.text_of("type");
    const std::string_view property = animation.text_of("property");
    double rate = turns_per_minute(kind, property);
    const bool by_name = rate == 0.0 && kind == "spin" && !is_of_other_wheels(property);
    if (by_name) {
        rate = rate_by_name(animation, glm::dvec3(0, 0, 1));
    }
    if (rate == 0.0) { // then its numbers do not count: files have faulty ones
        return std::nullopt;
    }
    const double factor = number_in(file, animation, "factor", 1.0);
    FlightGearRotation turn{{}, axis_in(file, animation)};
    const double length = glm::length(turn.about.direction);
    if (factor == 0.0 || !(length > 0.0)) {
        return std::nullopt;
    }
    turn.about.direction /= length;
    if (by_name) {
        rate = rate_by_name(animation, turn.about.direction);
    }
    // An angle's factor only says which way round.
    turn.about.turns_per_s = kind == "spin" ? interpolated(file, animation, rate) * factor / 60.0
                                            : std::copysign(rate, factor) / 60.0;
    for (const XmlElement& named : animation.children) {
        if (named.name == "object-name") {
            turn.objects.insert(named.text);
        }
    }
    return turn;
}

} // namespace octant::models::meshfile
