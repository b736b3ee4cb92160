#include "ui/world/aircraft_axes.h"

#include "models/meshfile/mesh_file.h"
#include "models/polygons/file_axes.h"

#include <cstddef>
#include <fmt/format.h>
#include <string_view>

namespace octant::ui::world {

namespace fs = std::filesystem;
using models::polygons::FileAxes;
using AxesSource = AircraftAxes::AxesSource;

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

glm::dvec3 up_in_file(const FileAxes& axes) { return axes.file_from_body({0.0, 0.0, -1.0}); }

std::string_view source_of(AxesSource source) {
    switch (source) {
    case AxesSource::Given:
        return "as --axes says";
    case AxesSource::Format:
        return "as files of this format have it";
    case AxesSource::Guess:
        return "guessed from the shape";
    case AxesSource::Default:
        break;
    }
    return "taken for granted, the shape does not say";
}

} // namespace

AircraftAxes aircraft_axes(const std::string& setting, const fs::path& file, const models::TriangleMesh& mesh) {
    if (setting != automatic) { return {FileAxes::from_text(setting), AxesSource::Given}; }
    if (const auto axes = models::meshfile::axes_of_format(file)) { return {*axes, AxesSource::Format}; }
    const auto default_axes = models::meshfile::default_axes_of_format(file);
    const auto guessed = models::polygons::guess_axes(mesh);
    if (guessed && (!default_axes || up_in_file(*guessed) == up_in_file(*default_axes))) {
        return {*guessed, AxesSource::Guess};
    }
    return {default_axes.value_or(FileAxes()), AxesSource::Default};
}

void check_axes(const std::string& setting) {
    if (setting != automatic) { FileAxes::from_text(setting); }
}

std::string axes_text(const AircraftAxes& axes) {
    return fmt::format("nose towards {}, up {}: {}", axis_along(axes.axes, {1.0, 0.0, 0.0}),
        axis_along(axes.axes, {0.0, 0.0, -1.0}), source_of(axes.source));
}

void note_axes(const AircraftAxes& axes, const fs::path& file, std::vector<std::string>& notes) {
    if (axes.source == AxesSource::Guess || axes.source == AxesSource::Default) {
        notes.push_back(fmt::format("{}: {}; --axes to change", file.filename().string(), axes_text(axes)));
    }
}

} // namespace octant::ui::world
