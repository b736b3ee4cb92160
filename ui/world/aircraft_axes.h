#pragma once

#include "models/polygons/file_axes.h"
#include "models/triangle_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Where the axes of an aircraft's file point, and how that is known.
struct AircraftAxes {
    /// Default: the shape does not say; the axes are those that scenes of the format mostly have, else x right, y up, z
    /// back.
    enum class AxesSource { Given, Format, Guess, Default };

    models::polygons::FileAxes axes;
    AxesSource source = AxesSource::Default;
};

/// The setting --axes: "auto", or directions such as "right,up,back". With "auto" the format decides, then the shape,
/// whose top is towards +z where the format says so. `mesh` is the aircraft in its file's axes. Throws Error.
AircraftAxes aircraft_axes(
    const std::string& setting, const std::filesystem::path& file, const models::TriangleMesh& mesh);

/// Throws Error unless it is "auto" or directions that aircraft_axes takes.
void check_axes(const std::string& setting);

/// "nose towards -x, up +y: guessed from the shape".
std::string axes_text(const AircraftAxes& axes);

/// Appends a note where nose and top were found, unless the setting or the format says it.
void note_axes(const AircraftAxes& axes, const std::filesystem::path& file, std::vector<std::string>& notes);

} // namespace octant::ui::world
