#include "ui/world/place_text.h"

#include "flightpaths/local_tangent.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace octant::ui::world {

namespace {

[[noreturn]] void refuse(const std::string& expected, const std::string& text) {
    throw Error(fmt::format("--place: expected {}, got '{}'", expected, printable(text)));
}

struct Part {
    double value = 0.0;
    char letter = '\0'; ///< N, S, E, W or none
};

std::optional<Part> part_of(std::string_view text, std::string_view letters) {
    Part part;
    if (!text.empty() && letters.find(text.back()) != std::string_view::npos) {
        part.letter = text.back();
        text.remove_suffix(1);
    }
    const auto number = finite_number(text);
    if (!number || (part.letter != '\0' && *number < 0.0)) {
        return std::nullopt;
    }
    part.value = part.letter == 'S' || part.letter == 'W' ? -*number : *number;
    return part;
}

} // namespace

glm::dvec2 place_from_text(
    const std::string& text,
    const std::optional<models::heights::GeoPlace>& map_place,
    const glm::dvec2& half_extent_m) {
    const auto fields = split_fields(text, ',');
    const auto first = fields.size() == 2 ? part_of(fields[0], "NS") : std::nullopt;
    const auto second = fields.size() == 2 ? part_of(fields[1], "EW") : std::nullopt;
    if (!first || !second || (first->letter == '\0') != (second->letter == '\0')) {
        refuse("X,Y in metres or LAT,LON in degrees", text);
    }
    const bool lettered = first->letter != '\0';
    if (!map_place) {
        if (lettered) {
            refuse("X,Y in metres on a map without a place on the earth", text);
        }
        return {first->value, second->value};
    }
    const bool can_be_degrees = std::abs(first->value) <= 90.0 && std::abs(second->value) <= 360.0;
    if (!can_be_degrees) {
        if (lettered) {
            refuse("latitude up to 90 and longitude up to 360 degrees", text);
        }
        return {first->value, second->value};
    }
    const glm::dvec2 local_m = flightpaths::local_from_geo(
        {map_place->latitude_deg, map_place->longitude_deg}, first->value, second->value);
    const bool on_map =
        std::abs(local_m.x) <= half_extent_m.x && std::abs(local_m.y) <= half_extent_m.y;
    return lettered || on_map ? local_m : glm::dvec2(first->value, second->value);
}

} // namespace octant::ui::world
