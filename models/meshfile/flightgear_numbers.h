#pragma once

#include "models/meshfile/rotating_model.h"
#include "models/meshfile/xml_tree.h"

#include <filesystem>
#include <string_view>

namespace octant::models::meshfile {

/// The number in a child of an element of a FlightGear file; `without` where there is none. Throws
/// Error for what is no number, or beyond max_coordinate.
double number_in(
    const std::filesystem::path& file,
    const XmlElement& parent,
    std::string_view name,
    double without = 0.0);

/// What the table of an animation makes of a property's value; the value itself without one.
double interpolated(const std::filesystem::path& file, const XmlElement& animation, double value);

/// A point of an animation's axis and its direction, as long as the file has it: without a length
/// where it gives none. It does not turn.
RotationAxis axis_in(const std::filesystem::path& file, const XmlElement& animation);

} // namespace octant::models::meshfile
