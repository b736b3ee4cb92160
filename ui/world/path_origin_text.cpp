#include "ui/world/path_origin_text.h"

#include "models/heights/height_source.h"
#include "models/heights/map_frame.h"
#include "models/heights/map_inputs.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/settings/terrain_name.h"
#include "ui/world/terrain_file.h"
#include "visuals/groundfile/ground_file.h"

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
    /// N, S, E, W or none.
    char letter = '\0';
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

/// X,Y or LAT,LON as they stand in the text.
struct Pair {
    double first = 0.0;
    double second = 0.0;
    /// Whether a letter says that these are degrees.
    bool lettered = false;
};

Pair pair_of(const std::string& text) {
    const auto fields = split_fields(text, ',');
    const auto first = fields.size() == 2 ? part_of(fields[0], "NS") : std::nullopt;
    const auto second = fields.size() == 2 ? part_of(fields[1], "EW") : std::nullopt;
    if (!first || !second || (first->letter == '\0') != (second->letter == '\0')) {
        refuse("X,Y in metres or LAT,LON in degrees", text);
    }
    return {first->value, second->value, first->letter != '\0'};
}

std::optional<GeoPosition> place_of(const settings::PathSettings& settings) {
    const std::string& terrain = settings.terrain;
    if (settings::is_built_in_ground(terrain)) {
        return std::nullopt;
    }
    if (settings::is_imported_ground(terrain)) {
        return visuals::groundfile::open_ground(terrain).metadata().place;
    }
    return models::heights::HeightSource(
               models::heights::map_inputs({terrain}), import_options(settings))
        .place();
}

} // namespace

void check_path_origin(const settings::PathSettings& settings) {
    if (settings.place && pair_of(*settings.place).lettered) {
        constexpr glm::dvec2 any_extent_m(1.0);
        const auto frame = models::heights::frame_of_ground(std::nullopt, place_of(settings));
        path_origin_from_text(*settings.place, frame.get(), any_extent_m);
    }
}

glm::dvec2 path_origin_from_text(
    const std::string& text, const EarthFrame* map_frame, const glm::dvec2& half_extent_m) {
    const Pair pair = pair_of(text);
    const glm::dvec2 as_metres(pair.first, pair.second);
    if (map_frame == nullptr) {
        if (pair.lettered) {
            refuse("X,Y in metres on a map without a place on the earth", text);
        }
        return as_metres;
    }
    const bool can_be_degrees = std::abs(pair.first) <= 90.0 && std::abs(pair.second) <= 360.0;
    if (!can_be_degrees) {
        if (pair.lettered) {
            refuse("latitude up to 90 and longitude up to 360 degrees", text);
        }
        return as_metres;
    }
    const glm::dvec2 local_m = map_frame->local_from_geo({pair.first, pair.second});
    const bool on_map =
        std::abs(local_m.x) <= half_extent_m.x && std::abs(local_m.y) <= half_extent_m.y;
    return pair.lettered || on_map ? local_m : as_metres;
}

} // namespace octant::ui::world
