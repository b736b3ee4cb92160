#pragma once

#include "models/heights/gdal_session.h"
#include "models/heights/height_field.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::models::heights {

/// Whether a name is one of GDAL's that leads into a file of this computer: an archive (/vsizip/, /vsitar/, /vsigzip/)
/// or a part of a file (NETCDF:"a.nc":height).
bool is_subdataset_name(const std::string& name);

/// Throws Error unless the path is a readable, regular file with content on this computer, or a name within one.
void check_local_file(const std::filesystem::path& file);

/// Opens a raster by whichever of GDAL's drivers knows it. Of a file with sub-datasets, that is the only one; the one
/// that `band` names, which is then reset; or the only one whose name says heights (height_band.h), with a note. Throws
/// Error: another kind of file, several sub-datasets (they are named), a file that refers to others that are not on
/// this computer.
Dataset open_raster_file(const std::filesystem::path& file, GdalSession& gdal, std::optional<std::string>& band,
    std::vector<MapNote>& notes);

/// "only the first N of its M bytes" for a raster whose heights lie beyond the end of its file, as its own description
/// says: GeoTIFF, and formats that have heights as plain numbers. Empty else.
std::string truncation_error(const std::filesystem::path& file, void* dataset);

/// The files of this computer that a raster is read from: itself, and those it refers to. Only itself where it cannot
/// be opened.
std::vector<std::filesystem::path> referenced_files(const std::filesystem::path& file);

} // namespace octant::models::heights
