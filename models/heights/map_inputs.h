#pragma once

#include "models/heights/gdal_session.h"
#include "models/heights/height_field.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::models::heights {

/// Whether a name is a GDAL name for a part of a local file: an archive (/vsizip/, /vsitar/, /vsigzip/) or a subdataset
/// (NETCDF:"a.nc":height).
bool is_subdataset_name(const std::string& name);

/// Throws Error unless the path is a readable, regular local file with content, or a name within one.
void check_local_file(const std::filesystem::path& file);

/// Opens a raster by whichever of GDAL's drivers knows it. For a file with several sub-datasets it opens
/// - the one that `band` names; `band` is then reset; else
/// - the only one whose name says heights (height_band.h), and adds a note.
/// Throws Error: another kind of file, several sub-datasets (the message lists them), a file that refers to others that
/// are not on this computer.
Dataset open_raster_file(const std::filesystem::path& file, GdalSession& gdal, std::optional<std::string>& band,
    std::vector<MapNote>& notes);

/// "only the first N of its M bytes" for a raster whose heights lie beyond the end of its file, as its own description
/// says: GeoTIFF, and formats that have heights as plain numbers. Empty else.
std::string truncation_error(const std::filesystem::path& file, void* dataset);

/// The local files that a raster consists of: itself and those that it refers to. Only itself if it cannot be opened.
std::vector<std::filesystem::path> referenced_files(const std::filesystem::path& file);

/// The rasters that names stand for, in their order: a file stands for itself; a folder for the rasters in it and its
/// folders, by name; a pattern (*, ?, [...]) for what matches it, by name; an archive (.zip, .tar, .tgz, .tar.gz, .gz)
/// for the rasters in it; GDAL's names within files (as NETCDF:"a.nc":height) for themselves. Pictures are left out of
/// folders and archives where they hold anything else. Throws Error where there is nothing.
std::vector<std::filesystem::path> map_inputs(const std::vector<std::string>& names);

/// Whether a name is a folder, a pattern or a name within a file.
bool is_many(const std::string& name);

} // namespace octant::models::heights
