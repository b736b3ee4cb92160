#include "models/heights/raster_file.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/height_band.h"
#include "models/heights/web_tiles.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
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

/// What a file begins with.
std::string first_bytes(const path& file) {
    std::string bytes(8, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
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

/// Of the largest file behind a raster that is no label, which is the one with its numbers.
std::uintmax_t bytes_of(GDALDatasetH dataset) {
    constexpr std::array<std::string_view, 6> labels = {
        ".xml", ".hdr", ".prj", ".lbl", ".LBL", ".stx"};
    std::uintmax_t largest = 0;
    for (const std::string& name : taken(GDALGetFileList(dataset))) {
        std::error_code code;
        const std::uintmax_t bytes = std::filesystem::file_size(name, code);
        const bool is_label = std::ranges::any_of(
            labels, [&name](std::string_view ending) { return name.ends_with(ending); });
        largest = code || is_label ? largest : std::max(largest, bytes);
    }
    return largest;
}

/// Where the last block of a GeoTIFF ends.
std::uintmax_t end_of_blocks(GDALDatasetH dataset) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    int width = 1;
    int height = 1;
    GDALGetBlockSize(band, &width, &height);
    const auto number = [&](const char* what, int x, int y) -> std::uintmax_t {
        const char* const text =
            GDALGetMetadataItem(band, fmt::format("BLOCK_{}_{}_{}", what, x, y).c_str(), "TIFF");
        return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
    };
    std::uintmax_t end = 0;
    for (int y = 0; y * height < GDALGetRasterYSize(dataset); ++y) {
        for (int x = 0; x * width < GDALGetRasterXSize(dataset); ++x) {
            end = std::max(end, number("OFFSET", x, y) + number("SIZE", x, y));
        }
    }
    return end;
}

/// How many bytes of a label an ISIS cube has before its numbers.
std::uintmax_t bytes_of_label(GDALDatasetH dataset) {
    char** const label = GDALGetMetadata(dataset, "json:ISIS3");
    const std::string_view text = CSLCount(label) == 0 ? "" : label[0];
    constexpr std::string_view key = "\"StartByte\":";
    const std::size_t at = text.find(key);
    return at == std::string_view::npos
               ? 0
               : std::max(std::strtoull(text.data() + at + key.size(), nullptr, 10), 1ULL) - 1;
}

/// Whether a format has its heights as plain numbers one after the other.
bool is_plain(std::string_view driver, const path& file) {
    constexpr std::array<std::string_view, 10> plain = {
        "EHdr", "ENVI", "ISIS2", "ISIS3", "PDS", "PDS4", "VICAR", "GSBG", "GS7BG", "BT"};
    constexpr std::string_view classic_netcdf = "CDF";
    return std::ranges::find(plain, driver) != plain.end() ||
           (driver == "netCDF" && first_bytes(file).starts_with(classic_netcdf));
}

/// What is wrong with a file that no driver opens: one that ends too soon.
std::string cut_short_unopened(const path& file) {
    std::error_code code;
    const std::uintmax_t bytes = std::filesystem::file_size(file, code);
    const std::string ending = file.extension().string();
    if (code) {
        return {};
    }
    if (ending == ".hgt" || ending == ".HGT") {
        constexpr std::uintmax_t coarse = std::uintmax_t{2} * 1201 * 1201;
        constexpr std::uintmax_t fine = std::uintmax_t{2} * 3601 * 3601;
        return fmt::format(
            "only the first {} of the {} bytes of a .hgt tile",
            bytes,
            bytes <= coarse ? coarse : fine);
    }
    // A TIFF begins with where its description lies, in the byte order of its first two letters.
    const std::string first = first_bytes(file);
    const bool is_tiff = first.starts_with(std::string_view("II*\0", 4)) ||
                         first.starts_with(std::string_view("MM\0*", 4));
    if (!is_tiff || first.size() < 8) {
        return {};
    }
    std::uintmax_t described_at = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t from_high = first.front() == 'M' ? 4 + i : 7 - i;
        described_at = described_at << 8U | static_cast<unsigned char>(first[from_high]);
    }
    return described_at < bytes
               ? std::string()
               : fmt::format("only the first {} of its more than {} bytes", bytes, described_at);
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
        const std::string cut_short = cut_short_unopened(file);
        if (!cut_short.empty()) {
            error_unreadable(file, "a height field", cut_short);
        }
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

std::string cut_short_text(const path& file, void* dataset) {
    const std::string_view driver = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
    std::uintmax_t expected = 0;
    if (driver == "GTiff") {
        expected = end_of_blocks(dataset);
    } else if (is_plain(driver, file)) {
        const GDALDataType type = GDALGetRasterDataType(GDALGetRasterBand(dataset, 1));
        expected = bytes_of_label(dataset) +
                   static_cast<std::uintmax_t>(GDALGetRasterXSize(dataset)) *
                       static_cast<std::uintmax_t>(GDALGetRasterYSize(dataset)) *
                       static_cast<std::uintmax_t>(GDALGetDataTypeSizeBytes(type));
    }
    const std::uintmax_t bytes = bytes_of(dataset);
    return bytes == 0 || bytes >= expected
               ? std::string()
               : fmt::format("only the first {} of its {} bytes", bytes, expected);
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
