#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octant::models::heights {

/// The rasters that names stand for, in their order: a file stands for itself; a folder for the rasters in it and its
/// folders, by name; a pattern (*, ?, [...]) for what matches it, by name; an archive (.zip, .tar, .tgz, .tar.gz, .gz)
/// for the rasters in it; GDAL's names within files (as NETCDF:"a.nc":height) for themselves. Pictures are left out of
/// folders and archives where they hold anything else. Throws Error where there is nothing.
std::vector<std::filesystem::path> map_inputs(const std::vector<std::string>& names);

/// Whether a name has more to it than a file's: a folder, a pattern or a name within a file.
bool is_many(const std::string& name);

} // namespace octant::models::heights
