#include "models/heights/raster_file.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/height_band.h"
#include "models/heights/web_tiles.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>
#include <unistd.h>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

constexpr std::array<std::string_view, 4> archives = {
    "/vsizip/", "/vsitar/", "/vsigzip/", "/vsi7z/"};
constexpr unsigned open_flags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
constexpr std::size_t most_named = 6; ///< sub-datasets in a message

/// Strings that GDAL owns, as ours; they are released.
std::vector<std::string> taken(char** list) {
    std::vector<std::string> texts;
    for (int i = 0; i < CSLCount(list); ++i) {
        texts.emplace_back(list[i]);
    }
    CSLDestroy(list);
    return texts;
}

bool is_virtual(std::string_view name) {
    return name.starts_with("/vsi");
}

bool is_in_archive(std::string_view name) {
    for (const std::string_view archive : archives) {
        if (name.starts_with(archive)) {
            const std::string_view rest = name.substr(archive.size());
            return !is_virtual(rest) || is_in_archive(rest);
        }
    }
    return false;
}

/// The names of a dataset's raster sub-datasets.
std::vector<std::string> subdatasets_of(GDALDatasetH dataset) {
    std::vector<std::string> names;
    char** const list = GDALGetMetadata(dataset, "SUBDATASETS");
    for (int i = 1;; ++i) {
        const char* const name =
            CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_NAME", i).c_str());
        if (name == nullptr) {
            return names;
        }
        names.emplace_back(name);
    }
}

/// Throws Error when the raster's values would come from elsewhere.
void check_sources(const path& file, GDALDatasetH dataset) {
    for (const std::string& name : taken(GDALGetFileList(dataset))) {
        const bool is_far =
            name.find("://") != std::string::npos || (is_virtual(name) && !is_in_archive(name));
        if (is_far) {
            error_in(
                file,
                fmt::format(
                    "expected heights on this computer, got a reference to '{}'", printable(name)));
        }
    }
}

Dataset open_named(const std::string& name) {
    if (Dataset heightmap = open_cesium_heightmap(name)) {
        return heightmap;
    }
    return Dataset(GDALOpenEx(name.c_str(), open_flags, nullptr, nullptr, nullptr));
}

/// The name of a variable at the end of a sub-dataset's: height of NETCDF:"a.nc":height.
std::string variable_of(const std::string& subdataset) {
    return subdataset.substr(subdataset.find_last_of(":/") + 1);
}

std::string chosen_subdataset(
    const path& file,
    const std::vector<std::string>& names,
    std::optional<std::string>& band,
    std::vector<MapNote>& notes) {
    if (names.size() == 1) {
        return names.front();
    }
    std::vector<std::string> variables;
    std::vector<std::string> heights;
    for (const std::string& name : names) {
        variables.push_back(variable_of(name));
        if (band && EQUAL(variables.back().c_str(), band->c_str())) {
            band.reset();
            return name;
        }
        if (is_name_of_heights(variables.back())) {
            heights.push_back(name);
        }
    }
    const bool is_cut = variables.size() > most_named;
    variables.resize(std::min(variables.size(), most_named));
    if (!band && heights.size() == 1) {
        notes.push_back({fmt::format(
            "{}: {} is taken for heights, of {}{}: --band NAME chooses another",
            file.filename().string(),
            variable_of(heights.front()),
            fmt::join(variables, ", "),
            is_cut ? ", ..." : "")});
        return heights.front();
    }
    error_in(
        file,
        fmt::format(
            "expected one raster, got {}: --band names one of {}{}, or write {} for the file",
            names.size(),
            fmt::join(variables, ", "),
            is_cut ? ", ..." : "",
            names.front()));
}

} // namespace

bool is_name_within_file(const std::string& name) {
    if (is_virtual(name)) {
        return is_in_archive(name);
    }
    // DRIVER:..., unless a file is called that.
    const std::size_t colon = name.find(':');
    std::error_code code;
    return colon != std::string::npos && colon > 1 && name.find('/') > colon &&
           name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == colon &&
           name.find("://") == std::string::npos && name.find("/vsi") == std::string::npos &&
           !std::filesystem::exists(name, code);
}

void check_local_file(const path& file) {
    if (is_name_within_file(file.string())) {
        return;
    }
    if (is_virtual(file.string())) {
        error_in(file, "expected a file on this computer, got a virtual path of GDAL");
    }
    std::error_code code;
    const auto status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status)) {
        const bool odd = code && code.value() != ENOENT;
        error_in(file, odd ? code.message() : "expected a file, found none");
    }
    if (std::filesystem::is_directory(status)) {
        return; // some formats are folders
    }
    if (!std::filesystem::is_regular_file(status)) {
        error_in(file, "expected a regular file, got a device or pipe");
    }
    if (::access(file.c_str(), R_OK) != 0) {
        error_in(file, fmt::format("cannot be opened for reading: {}", std::strerror(errno)));
    }
    if (std::filesystem::file_size(file, code) == 0) {
        error_unreadable(file, "a height field", "an empty file");
    }
}

Dataset open_raster_file(
    const path& file,
    GdalSession& gdal,
    std::optional<std::string>& band,
    std::vector<MapNote>& notes) {
    Dataset dataset = open_named(file.string());
    if (!dataset) {
        error_unreadable(
            file,
            "a height field",
            gdal.names_no_format() ? "another kind of file (any raster format of GDAL's is read)"
                                   : gdal.reason(file));
    }
    if (GDALGetRasterCount(dataset.get()) == 0) {
        const std::vector<std::string> names = subdatasets_of(dataset.get());
        if (!names.empty()) {
            const std::string chosen = chosen_subdataset(file, names, band, notes);
            dataset = open_named(chosen);
            if (!dataset) {
                error_unreadable(file, "a height field", gdal.reason(file));
            }
        }
    }
    check_sources(file, dataset.get());
    gdal.forget();
    return dataset;
}

std::vector<path> files_behind(const path& file) {
    std::vector<path> files;
    const GdalSession gdal;
    if (const Dataset dataset = open_named(file.string())) {
        std::error_code code;
        for (const std::string& name : taken(GDALGetFileList(dataset.get()))) {
            if (std::filesystem::is_regular_file(name, code)) {
                files.emplace_back(name);
            }
        }
    }
    if (files.empty()) {
        files.push_back(file);
    }
    return files;
}

} // namespace octant::models::heights
