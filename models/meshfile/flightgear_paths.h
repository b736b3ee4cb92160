#pragma once

#include <filesystem>
#include <string>

namespace octant::models::meshfile {

/// The file that a path in a FlightGear model means: beside the model, or from one of the folders above it, as
/// FlightGear's root is. Empty where there is none.
std::filesystem::path flightgear_file(const std::filesystem::path& model, const std::string& name);

/// The folder that a <texture-path> in a FlightGear model means; empty for an empty one.
std::filesystem::path flightgear_pictures(const std::filesystem::path& model, const std::string& texture_path);

} // namespace octant::models::meshfile
