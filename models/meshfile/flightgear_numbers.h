#pragma once

#include "models/meshfile/xml_tree.h"

#include <filesystem>
#include <string_view>

namespace octant::models::meshfile {

/// The number in a child of an element of a FlightGear file; `without` where there is none. Throws
/// Error for what is no number, or beyond most_coordinate.
double number_in(
    const std::filesystem::path& file,
    const XmlElement& parent,
    std::string_view name,
    double without = 0.0);

} // namespace octant::models::meshfile
