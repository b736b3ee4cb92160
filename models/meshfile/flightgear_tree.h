#pragma once

#include "models/meshfile/xml_tree.h"

#include <filesystem>

namespace octant::models::meshfile {

/// The elements of a FlightGear file. What the outermost element, or one in it, includes from
/// another file stands behind its own; an included file that is not there is left out. Throws
/// Error for files that cannot be read, and for includes more than 8 deep or 500 in all.
XmlElement flightgear_tree(const std::filesystem::path& file);

} // namespace octant::models::meshfile
