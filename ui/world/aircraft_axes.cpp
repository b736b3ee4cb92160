#include "ui/world/aircraft_axes.h"

#include "models/meshfile/format_axes.h"
#include "models/polygons/axes_guess.h"

#include <fmt/format.h>
#include <string_view>

namespace octant::ui::world {

using models::polygons::FileAxes;
using From = AircraftAxes::From;

namespace {

constexpr std::string_view automatic = "auto";

/// Which axis of a file a direction in body axes lies along, such as "-x".
std::string axis_along(const FileAxes& axes, const glm::dvec3& in_body) {
    constexpr std::string_view letters = "xyz";
    const glm::dvec3 in_file = axes.file_from_body(in_body);
    std::string text;
    for (int k = 0; k < 3; ++k) {
        if (in_file[k] != 0.0) {
            text += in_file[k] > 0.0 ? '+' : '-';
            text += letters[static_cast<std::size_t>(k)];
        }
    }
    return text;
}

glm::dvec3 up_in_file(const FileAxes& axes) {
    return axes.file_from_body({0.0, 0.0, -1.0});
}

std::string_view source_of(From from) {
    switch (from) {
    case From::Given:
        return "as --axes says";
    case From::Format:
        return "as files of this format have it";
    case From::Guess:
        return "guessed from the shape";
    case From::Usual:
        break;
    }
    return "taken for granted, the shape does not say";
}

} // namespace

AircraftAxes aircraft_axes(
    const std::string& setting,
    const std::filesystem::path& file,
    const models::TriangleMesh& mesh) {
    if (setting != automatic) {
        return {FileAxes::from_text(setting), From::Given};
    }
    if (const auto axes = models::meshfile::axes_of_format(file)) {
        return {*axes, From::Format};
    }
    const auto usual = models::meshfile::usual_axes(file);
    const auto guessed = models::polygons::guessed_axes(mesh);
    if (guessed && (!usual || up_in_file(*guessed) == up_in_file(*usual))) {
        return {*guessed, From::Guess};
    }
    return {usual.value_or(FileAxes()), From::Usual};
}

void check_axes(const std::string& setting) {
    if (setting != automatic) {
        FileAxes::from_text(setting);
    }
}

std::string in_words(const AircraftAxes& axes) {
    return fmt::format(
        "nose towards {}, up {}: {}",
        axis_along(axes.axes, {1.0, 0.0, 0.0}),
        axis_along(axes.axes, {0.0, 0.0, -1.0}),
        source_of(axes.from));
}

std::string note_of(const AircraftAxes& axes, const std::filesystem::path& file) {
    if (axes.from == From::Given || axes.from == From::Format) {
        return {};
    }
    return fmt::format("{}: {}; --axes to change", file.filename().string(), in_words(axes));
}

} // namespace octant::ui::world
