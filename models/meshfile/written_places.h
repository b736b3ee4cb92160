#pragma once

#include <filesystem>

namespace octant::models::meshfile {

/// Whether write_mesh rounds places to float in the format that the ending says. Throws Error where
/// no format has it.
bool writes_places_in_float(const std::filesystem::path& path);

} // namespace octant::models::meshfile
