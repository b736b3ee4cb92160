#pragma once

#include "models/polygons/file_axes.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Where the axes of an aircraft's file point, and how that is known.
struct AircraftAxes {
    enum class AxesSource {
        Given,  ///< by --axes
        Format, ///< the format prescribes them
        Shape,  ///< by the shape, clearly
        Unclear ///< the likeliest, though the shape does not say it clearly
    };

    models::polygons::FileAxes axes;
    AxesSource source = AxesSource::Unclear;
    /// What else to try: by the shape where the format prescribes other axes; where they are not clear, the nose at the
    /// other end. Nothing where nothing speaks for other axes.
    std::optional<models::polygons::FileAxes> alternative;
};

/// The settings --axes and --aircraft-scale.
struct AircraftFrameSettings {
    std::string axes = "auto"; ///< as aircraft_axes takes them
    double scale = 1.0;        ///< metres a unit of the file

    bool operator==(const AircraftFrameSettings&) const = default;
};

/// The setting --axes: "auto", or directions such as "right,up,back". With "auto" the format decides where it
/// prescribes axes, else mirror plane, fin, nose, wings, rotor, named materials and what is usual in the format
/// together. `mesh` is the aircraft in its file's axes. Throws Error.
AircraftAxes aircraft_axes(
    const std::string& setting, const std::filesystem::path& file, const models::TriangleMesh& mesh);

/// Throws Error unless it is "auto" or directions that aircraft_axes takes.
void check_axes(const std::string& setting);

/// "nose towards -x, up +y: guessed from the shape".
std::string axes_text(const AircraftAxes& axes);

/// Nothing where --axes gives the axes, or the format does and the shape does not contradict. Names the option that
/// turns the aircraft.
std::optional<std::string> axes_note(const AircraftAxes& axes, const std::filesystem::path& file);

/// Nothing for an aircraft whose longest side is 1 to 120 m long, else a note that names the likely unit of length and
/// the option that sets it. `extent_m`: of the bounding box, as flown; `scale`: that was applied already.
std::optional<std::string> size_note(const glm::dvec3& extent_m, double scale, const std::filesystem::path& file);

/// The likely unit of length of a file whose longest side is so many units long: "metres" where that is an aircraft's
/// length, else such as "centimetres", "feet"; empty where no unit makes it an aircraft.
std::string likely_unit(double longest);

/// The point of a file about which its aircraft flies: the file's origin, but the middle of the bounding box where the
/// origin lies outside it by more than a quarter of its longest side, in formats that prescribe nothing.
glm::dvec3 flown_origin(const std::filesystem::path& file, const models::BoundingBox& bounds);

/// Nothing where that is the file's own origin.
std::optional<std::string> origin_note(const glm::dvec3& origin, const std::filesystem::path& file);

/// Subtracts an origin from all coordinates, then multiplies them.
void move_mesh(models::TriangleMesh& mesh, const glm::dvec3& origin, double factor);

/// Multiplies all coordinates.
void scale_mesh(models::TriangleMesh& mesh, double factor);

} // namespace octant::ui::world
