#include "ui/world/aircraft_frame.h"

#include "models/meshfile/mesh_file.h"
#include "models/polygons/aircraft_shape.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <cmath>
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

std::string nose_and_top(const FileAxes& axes) {
    return fmt::format("nose towards {}, up {}", axis_along(axes, {1.0, 0.0, 0.0}), axis_along(axes, {0.0, 0.0, -1.0}));
}

std::string_view source_of(AxesSource source) {
    switch (source) {
    case AxesSource::Given:
        return "as --axes says";
    case AxesSource::Format:
        return "as files of this format have it";
    case AxesSource::Shape:
        return "guessed from the shape";
    case AxesSource::Unclear:
        break;
    }
    return "a guess, the shape does not say it clearly";
}

/// A contradiction of what a format prescribes must be as clear as this (AxesGuess).
constexpr double contradiction_lead = 3.0;

struct LengthUnit {
    std::string_view name;
    double m = 1.0;
};

/// By how common they are in models.
constexpr std::array length_units{LengthUnit{"centimetres", 0.01}, LengthUnit{"millimetres", 0.001},
    LengthUnit{"inches", 0.0254}, LengthUnit{"feet", 0.3048}, LengthUnit{"kilometres", 1000.0}};

constexpr double shortest_m = 1.0;
constexpr double longest_m = 120.0;

/// Most aircraft are as long as this.
constexpr double usual_shortest_m = 5.0;
constexpr double usual_longest_m = 60.0;

} // namespace

AircraftAxes aircraft_axes(const std::string& setting, const fs::path& file, const models::TriangleMesh& mesh) {
    if (setting != automatic) { return {FileAxes::from_text(setting), AxesSource::Given, std::nullopt}; }
    if (const auto prescribed = models::meshfile::axes_of_format(file)) {
        const auto seen = models::polygons::guess_axes(mesh);
        const bool contradicts = seen && seen->lead >= contradiction_lead && seen->axes.text() != prescribed->text();
        // AC3D files are for whoever reads them: FlightGear's nose is towards -x, that of X-Plane's tools towards -z.
        if (contradicts && extension_of(file) == ".ac") {
            return {seen->axes, AxesSource::Shape, models::polygons::nose_at_other_end(seen->axes)};
        }
        return {*prescribed, AxesSource::Format, contradicts ? std::optional(seen->axes) : std::nullopt};
    }
    const auto guessed = models::polygons::guess_axes(mesh, models::meshfile::axes_hints_of_format(file));
    if (!guessed) { return {}; }
    return {guessed->axes, guessed->is_clear() ? AxesSource::Shape : AxesSource::Unclear,
        models::polygons::nose_at_other_end(guessed->axes)};
}

void check_axes(const std::string& setting) {
    if (setting != automatic) { FileAxes::from_text(setting); }
}

std::string axes_text(const AircraftAxes& axes) {
    return fmt::format("{}: {}", nose_and_top(axes.axes), source_of(axes.source));
}

std::optional<std::string> axes_note(const AircraftAxes& axes, const fs::path& file) {
    if (axes.source == AxesSource::Given || (axes.source == AxesSource::Format && !axes.alternative)) {
        return std::nullopt;
    }
    std::string note = fmt::format("{}: {}", file.filename().string(), axes_text(axes));
    if (axes.source == AxesSource::Format) {
        note += fmt::format(
            "; the shape says {}: --axes {} turns it", nose_and_top(*axes.alternative), axes.alternative->text());
    } else if (axes.alternative) {
        note += fmt::format("; --axes {} if it flies tail first", axes.alternative->text());
    }
    return note;
}

std::string likely_unit(double longest) {
    if (longest >= shortest_m && longest <= longest_m) { return "metres"; }
    for (const bool is_usual : {true, false}) {
        for (const LengthUnit& unit : length_units) {
            const double length_m = longest * unit.m;
            if (length_m >= (is_usual ? usual_shortest_m : shortest_m) &&
                length_m <= (is_usual ? usual_longest_m : longest_m)) {
                return std::string(unit.name);
            }
        }
    }
    return {};
}

std::optional<std::string> size_note(const glm::dvec3& extent_m, double scale, const fs::path& file) {
    const double longest = std::max({extent_m.x, extent_m.y, extent_m.z});
    const std::string unit = likely_unit(longest);
    if (unit == "metres" || !(longest > 0.0)) { return std::nullopt; }
    std::string note = fmt::format(
        "{}: the aircraft is {:.3g} m long or wide, expected 1 to 120 m", file.filename().string(), longest);
    const auto found = std::ranges::find(length_units, unit, &LengthUnit::name);
    if (found != length_units.end()) {
        return note + fmt::format("; its unit is likely {}: --aircraft-scale {:.6g}", unit, scale * found->m);
    }
    // A model of no unit: of this factor, rounded to one digit, it has the length of a small aircraft.
    constexpr double small_m = 10.0;
    const double factor = scale * small_m / longest;
    const double power = std::pow(10.0, std::floor(std::log10(factor)));
    return note + fmt::format("; no unit of length makes it one, --aircraft-scale {:.6g} makes it about {:.0f} m",
                      std::round(factor / power) * power, small_m);
}

glm::dvec3 flown_origin(const fs::path& file, const models::BoundingBox& bounds) {
    if (models::meshfile::axes_of_format(file)) { return glm::dvec3(0.0); }
    const glm::dvec3 extent = bounds.max_m - bounds.min_m;
    const double margin = 0.25 * std::max({extent.x, extent.y, extent.z});
    for (int k = 0; k < 3; ++k) {
        if (bounds.min_m[k] > margin || bounds.max_m[k] < -margin) { return 0.5 * (bounds.min_m + bounds.max_m); }
    }
    return glm::dvec3(0.0);
}

std::optional<std::string> origin_note(const glm::dvec3& origin, const fs::path& file) {
    if (origin == glm::dvec3(0.0)) { return std::nullopt; }
    return fmt::format(
        "{}: its origin lies outside the aircraft, which flies about its middle at {:.4g}, {:.4g}, {:.4g}",
        file.filename().string(), origin.x, origin.y, origin.z);
}

void move_mesh(models::TriangleMesh& mesh, const glm::dvec3& origin, double factor) {
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m -= origin; }
    scale_mesh(mesh, factor);
}

void scale_mesh(models::TriangleMesh& mesh, double factor) {
    if (factor == 1.0) { return; }
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m *= factor; }
}

} // namespace octant::ui::world
