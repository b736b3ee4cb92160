#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace octant::models::polygons {

/// A comment of an OBJ file that says how a part turns:
///     # pivot NAME X Y Z axis AX AY AZ [rpm N]
struct PivotLine {
    std::string part;
    Pivot pivot; ///< in body axes; its part is not known yet
    int line = 0;
};

/// Reads a comment; nothing for one that is no pivot (does not begin with "# pivot" or lacks the word axis). Throws
/// Error "file:line: ..." for one that cannot be read.
std::optional<PivotLine> pivot_line(
    std::string_view comment, const FileAxes& axes, const std::filesystem::path& path, int line);

/// The comment that pivot_line reads back, with a line end. What pivot_line has made comes back bit for bit; other
/// rates within rounding.
std::string pivot_text(const Pivot& pivot, std::string_view part, const FileAxes& axes);

} // namespace octant::models::polygons
