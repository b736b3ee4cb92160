#include "models/heights/map_inputs.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/raster_file.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <glob.h>
#include <string_view>
#include <utility>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

bool is_pattern(const std::string& name) {
    std::error_code code;
    return name.find_first_of("*?[") != std::string::npos && !std::filesystem::exists(name, code);
}

bool is_folder(const std::string& name) {
    std::error_code code;
    return std::filesystem::is_directory(name, code);
}

/// The short name of the driver that takes a file for a raster of its own; empty if there is none.
std::string driver_of(const std::string& file) {
    if (path(file).extension() == ".terrain") {
        return "Cesium heightmap"; // which is not one of GDAL's
    }
    const GDALDriverH driver = GDALIdentifyDriverEx(file.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
    return driver == nullptr ? "" : GDALGetDriverShortName(driver);
}

/// The rasters among some files, sorted, without pictures where there is anything else.
std::vector<path> rasters_among(std::vector<std::string> files) {
    constexpr std::array<std::string_view, 7> picture_drivers = {"PNG", "JPEG", "GIF", "BMP", "PDF", "WEBP", "SVG"};
    std::ranges::sort(files);
    std::vector<path> heights;
    std::vector<path> pictures;
    for (const std::string& file : files) {
        const std::string driver = driver_of(file);
        if (!driver.empty()) {
            const bool is_picture = std::ranges::find(picture_drivers, driver) != picture_drivers.end();
            (is_picture ? pictures : heights).emplace_back(file);
        }
    }
    return heights.empty() ? pictures : heights;
}

std::vector<path> in_folder(const std::string& folder) {
    if (!driver_of(folder).empty()) {
        return {folder}; // a format whose datasets are folders
    }
    std::vector<std::string> files;
    std::error_code code;
    for (std::filesystem::recursive_directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
        if (at->is_regular_file(code)) { files.push_back(at->path().string()); }
    }
    return rasters_among(std::move(files));
}

/// What GDAL puts before the name of an archive; empty for other files.
std::string archive_prefix(const std::string& name) {
    const auto ends = [&name](std::string_view end) {
        return name.size() > end.size() && EQUAL(name.c_str() + name.size() - end.size(), end.data());
    };
    if (ends(".zip")) { return "/vsizip/"; }
    if (ends(".tar") || ends(".tgz") || ends(".tar.gz")) { return "/vsitar/"; }
    return ends(".gz") ? "/vsigzip/" : "";
}

std::vector<path> in_archive(const std::string& name, const std::string& prefix) {
    const std::string inside = prefix + std::filesystem::absolute(name).string();
    if (prefix == "/vsigzip/") { return rasters_among({inside}); }
    std::vector<std::string> files;
    char** const list = VSIReadDirRecursive(inside.c_str());
    for (int i = 0; i < CSLCount(list); ++i) { files.push_back(inside + "/" + list[i]); }
    CSLDestroy(list);
    return rasters_among(std::move(files));
}

std::vector<path> matching(const std::string& pattern) {
    std::vector<path> files;
    glob_t found{};
    if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) {
        files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    }
    ::globfree(&found);
    return files;
}

} // namespace

bool is_many(const std::string& name) { return is_pattern(name) || is_folder(name) || is_subdataset_name(name); }

std::vector<path> map_inputs(const std::vector<std::string>& names) {
    const GdalSession gdal;
    std::vector<path> files;
    for (const std::string& name : names) {
        const std::string prefix = archive_prefix(name);
        std::vector<path> some = {name};
        if (is_pattern(name)) {
            some = matching(name);
        } else if (is_folder(name)) {
            some = in_folder(name);
        } else if (!prefix.empty() && !is_subdataset_name(name) && driver_of(name).empty()) {
            check_local_file(name);
            some = in_archive(name, prefix);
        }
        if (some.empty()) { throw_error_in(name, "expected maps of heights that GDAL reads, found none"); }
        files.insert(files.end(), some.begin(), some.end());
    }
    return files;
}

} // namespace octant::models::heights
