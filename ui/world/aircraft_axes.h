#pragma once

#include "models/polygons/file_axes.h"
#include "models/triangle_mesh.h"

#include <filesystem>
#include <string>

namespace octant::ui::world {

/// Where the axes of an aircraft's file point, and how that is known.
struct AircraftAxes {
    /// Usual: its shape does not say, so that it is taken as its format's scenes mostly lie, else as x right, y up, z
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

/// What a person should be told of axes that were not given: empty for those of a format.
std::string axes_note(const AircraftAxes& axes, const std::filesystem::path& file);

} // namespace octant::ui::world
