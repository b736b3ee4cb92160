#include "models/heights/map_inputs.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/height_band.h"
#include "models/heights/text_grid.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <glob.h>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

constexpr std::array<std::string_view, 4> archives = {"/vsizip/", "/vsitar/", "/vsigzip/", "/vsi7z/"};
constexpr unsigned open_flags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
constexpr std::size_t max_named = 6; ///< sub-datasets in a message

/// Strings that GDAL owns, as ours; they are released.
std::vector<std::string> taken(char** list) {
    std::vector<std::string> texts;
    for (int i = 0; i < CSLCount(list); ++i) { texts.emplace_back(list[i]); }
    CSLDestroy(list);
    return texts;
}

bool is_virtual(std::string_view name) { return name.starts_with("/vsi"); }

bool is_in_archive(std::string_view name) {
    for (const std::string_view archive : archives) {
        if (name.starts_with(archive)) {
            const std::string_view rest = name.substr(archive.size());
            return !is_virtual(rest) || is_in_archive(rest);
        }
    }
    return false;
}

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
    for (const std::string& name_inside : taken(VSIReadDirRecursive(inside.c_str()))) {
        files.push_back(inside + "/" + name_inside);
    }
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

bool is_subdataset_name(const std::string& name) {
    if (is_virtual(name)) { return is_in_archive(name); }
    // DRIVER:..., unless a file is called that.
    const std::size_t colon = name.find(':');
    std::error_code code;
    return colon != std::string::npos && colon > 1 && name.find('/') > colon &&
           name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == colon &&
           name.find("://") == std::string::npos && name.find("/vsi") == std::string::npos &&
           !std::filesystem::exists(name, code);
}

void check_local_file(const path& file) {
    if (is_subdataset_name(file.string())) { return; }
    if (is_virtual(file.string())) {
        throw_error_in(file, "expected a file on this computer, got a virtual path of GDAL");
    }
    std::error_code code;
    const auto status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status)) {
        const bool odd = code && code.value() != ENOENT;
        throw_error_in(file, odd ? code.message() : "expected a file, found none");
    }
    if (std::filesystem::is_directory(status)) {
        return; // some formats are folders
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw_error_in(file, "expected a regular file, got a device or pipe");
    }
    if (::access(file.c_str(), R_OK) != 0) {
        throw_error_in(file, fmt::format("cannot be opened for reading: {}", std::strerror(errno)));
    }
    if (std::filesystem::file_size(file, code) == 0) { throw_unreadable(file, "a height field", "an empty file"); }
}

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

namespace {

/// The names of a dataset's raster sub-datasets.
std::vector<std::string> subdatasets_of(GDALDatasetH dataset) {
    std::vector<std::string> names;
    char** const list = GDALGetMetadata(dataset, "SUBDATASETS");
    for (int i = 1;; ++i) {
        const char* const name = CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_NAME", i).c_str());
        if (name == nullptr) { return names; }
        names.emplace_back(name);
    }
}

/// Throws Error when the raster's values would come from elsewhere.
void check_sources(const path& file, GDALDatasetH dataset) {
    for (const std::string& name : taken(GDALGetFileList(dataset))) {
        const bool is_own = name.starts_with("/vsisparse//vsimem/octant-"); // text_grid.h
        const bool is_far =
            name.find("://") != std::string::npos || (is_virtual(name) && !is_in_archive(name) && !is_own);
        if (is_far) {
            throw_error_in(
                file, fmt::format("expected heights on this computer, got a reference to '{}'", printable(name)));
        }
    }
}

Dataset open_named(const std::string& name) {
    if (Dataset heightmap = open_cesium_heightmap(name)) { return heightmap; }
    if (Dataset grid = open_grid_that_begins_with_word(name)) { return grid; }
    // Without IMMUTABLE, SQLite creates log files next to a GeoPackage while it is open. A log that exists already
    // holds heights, too, and is read.
    constexpr std::array<const char*, 2> immutable = {"@IMMUTABLE=YES", nullptr};
    std::error_code code;
    const bool has_log = std::filesystem::exists(name + "-wal", code);
    return Dataset(GDALOpenEx(name.c_str(), open_flags, nullptr, has_log ? nullptr : immutable.data(), nullptr));
}

/// The name of a variable at the end of a sub-dataset's: height of NETCDF:"a.nc":height.
std::string variable_of(const std::string& subdataset) { return subdataset.substr(subdataset.find_last_of(":/") + 1); }

std::string chosen_subdataset(const path& file, const std::vector<std::string>& names, std::optional<std::string>& band,
    std::vector<MapNote>& notes) {
    if (names.size() == 1) { return names.front(); }
    std::vector<std::string> variables;
    std::vector<std::string> heights;
    for (const std::string& name : names) {
        variables.push_back(variable_of(name));
        if (band && EQUAL(variables.back().c_str(), band->c_str())) {
            band.reset();
            return name;
        }
        if (is_height_band_name(variables.back())) { heights.push_back(name); }
    }
    const bool is_cut = variables.size() > max_named;
    variables.resize(std::min(variables.size(), max_named));
    if (!band && heights.size() == 1) {
        notes.push_back(
            {fmt::format("{}: {} is taken for heights, of {}{}: --band NAME chooses another", file.filename().string(),
                variable_of(heights.front()), fmt::join(variables, ", "), is_cut ? ", ..." : "")});
        return heights.front();
    }
    throw_error_in(file, fmt::format("expected one raster, got {}: --band names one of {}{}, or write {} for the file",
                             names.size(), fmt::join(variables, ", "), is_cut ? ", ..." : "", names.front()));
}

/// Reads numbers and text at places of a file.
class FileHeader {
public:
    explicit FileHeader(const path& file) : in_(file, std::ios::binary) {
        std::error_code code;
        const std::uintmax_t bytes = std::filesystem::file_size(file, code);
        bytes_ = code ? 0 : bytes;
    }

    std::uintmax_t bytes() const { return bytes_; }

    /// Returns fewer bytes than asked for at the end of the file.
    std::string text(std::uintmax_t at, std::size_t size) {
        std::string bytes(at < bytes_ ? std::min<std::uintmax_t>(size, bytes_ - at) : 0, '\0');
        in_.clear();
        in_.seekg(static_cast<std::streamoff>(at));
        in_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return bytes;
    }

    bool begins_with(std::string_view text_at_begin) { return text(0, text_at_begin.size()) == text_at_begin; }

    /// A number of up to 8 bytes; 0 beyond the end of the file.
    std::uintmax_t number(std::uintmax_t at, std::size_t size, bool low_first) {
        std::string bytes = text(at, size);
        if (low_first) { std::ranges::reverse(bytes); }
        std::uintmax_t value = 0;
        for (const char byte : bytes) { value = value << 8U | static_cast<unsigned char>(byte); }
        return bytes.size() == size ? value : 0;
    }

    /// The end of a part of the file, at most a large number.
    static std::uintmax_t end(std::uintmax_t at, std::uintmax_t size) {
        constexpr std::uintmax_t large = std::uintmax_t{1} << 62U;
        return std::min(at, large) + std::min(size, large);
    }

private:
    std::ifstream in_;
    std::uintmax_t bytes_ = 0;
};

/// Of the largest file behind a raster that is no label, which is the one with its numbers.
std::uintmax_t bytes_of(GDALDatasetH dataset) {
    constexpr std::array<std::string_view, 6> labels = {".xml", ".hdr", ".prj", ".lbl", ".LBL", ".stx"};
    std::uintmax_t largest = 0;
    for (const std::string& name : taken(GDALGetFileList(dataset))) {
        std::error_code code;
        const std::uintmax_t bytes = std::filesystem::file_size(name, code);
        const bool is_label =
            std::ranges::any_of(labels, [&name](std::string_view ending) { return name.ends_with(ending); });
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
    const int columns = (GDALGetRasterXSize(dataset) - 1) / std::max(width, 1) + 1;
    const int rows = (GDALGetRasterYSize(dataset) - 1) / std::max(height, 1) + 1;
    const auto number = [&](const char* what, int x, int y) -> std::uintmax_t {
        const char* const text = GDALGetMetadataItem(band, fmt::format("BLOCK_{}_{}_{}", what, x, y).c_str(), "TIFF");
        return text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
    };
    std::uintmax_t end = 0;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) { end = std::max(end, number("OFFSET", x, y) + number("SIZE", x, y)); }
    }
    return end;
}

/// How many bytes of a label an ISIS cube has before its numbers.
std::uintmax_t bytes_of_label(GDALDatasetH dataset) {
    char** const label = GDALGetMetadata(dataset, "json:ISIS3");
    const std::string_view text = CSLCount(label) == 0 ? "" : label[0];
    constexpr std::string_view key = "\"StartByte\":";
    const std::size_t at = text.find(key);
    return at == std::string_view::npos ? 0
                                        : std::max(std::strtoull(text.data() + at + key.size(), nullptr, 10), 1ULL) - 1;
}

/// Whether a format has its heights as plain numbers one after the other.
bool is_plain(std::string_view driver, const path& file) {
    constexpr std::array<std::string_view, 14> plain = {
        "EHdr", "ENVI", "ISIS2", "ISIS3", "PDS", "PDS4", "VICAR", "GSBG", "GS7BG", "BT", "SAGA", "RST", "ERS", "PNM"};
    constexpr std::string_view classic_netcdf = "CDF";
    return std::ranges::find(plain, driver) != plain.end() ||
           (driver == "netCDF" && FileHeader(file).begins_with(classic_netcdf));
}

/// Where the first directory of a TIFF file ends, which may be anywhere in it, or its lists of where strips and tiles
/// are.
std::uintmax_t end_of_tiff(FileHeader& header) {
    const bool low_first = header.begins_with("II");
    const bool is_big = header.number(2, 2, low_first) == 43;
    const std::size_t wide = is_big ? 8 : 4;
    const std::size_t entry_bytes = is_big ? 20 : 12;
    const std::uintmax_t begin = header.number(is_big ? 8 : 4, wide, low_first);
    if (begin == 0) { return 2 * wide; }
    const std::uintmax_t entries = header.number(begin, is_big ? 8 : 2, low_first);
    std::uintmax_t end = header.end(begin, (is_big ? 16 : 6) + entry_bytes * entries);
    if (end > header.bytes()) { return end; }
    for (std::uintmax_t entry = 0; entry < entries; ++entry) {
        const std::uintmax_t at = begin + (is_big ? 8 : 2) + entry * entry_bytes;
        const std::uintmax_t tag = header.number(at, 2, low_first);
        if (tag != 273 && tag != 279 && tag != 324 && tag != 325) { continue; } // offsets and sizes of strips and tiles
        const std::uintmax_t type = header.number(at + 2, 2, low_first);
        const std::uintmax_t value_bytes = type == 3 ? 2 : type == 4 ? 4 : 8; // SHORT, LONG, LONG8
        const std::uintmax_t count = std::min(header.number(at + 4, wide, low_first), header.bytes());
        if (count * value_bytes > wide) {
            end = std::max(end, header.end(header.number(at + 4 + wide, wide, low_first), count * value_bytes));
        }
    }
    return end;
}

/// Where the last of the chunks of a PNG file ends.
std::uintmax_t end_of_png(FileHeader& header) {
    constexpr std::uintmax_t around = 12; // length, kind and checksum of a chunk
    std::uintmax_t at = 8;
    while (header.text(at + 4, 4) != "IEND") {
        if (at >= header.bytes()) { return at + around; }
        at += around + header.number(at, 4, false);
    }
    return at + around;
}

/// Whether a JPEG or JPEG 2000 file has the mark that ends it. Small additions may follow.
bool has_end_mark(FileHeader& header) {
    constexpr std::uintmax_t last = 4096;
    const std::uintmax_t begin = header.bytes() - std::min(header.bytes(), last);
    return header.text(begin, last).find("\xff\xd9") != std::string::npos;
}

/// Where the boxes of a JPEG 2000 file end; a code stream ends with a mark.
std::uintmax_t end_of_jpeg_2000(FileHeader& header) {
    const bool has_boxes = header.begins_with(std::string_view("\0", 1));
    std::uintmax_t at = 0;
    while (has_boxes && at < header.bytes()) {
        std::uintmax_t size = header.number(at, 4, false);
        size = size == 1 ? header.number(at + 8, 8, false) : size;
        if (size < 8) { // to the end of the file, or no box
            break;
        }
        at = header.end(at, size);
    }
    return at >= header.bytes() || has_end_mark(header) ? at : header.bytes() + 2;
}

/// The least number of bytes of a complete file, as its own header says; 0 for formats whose header
/// does not say it.
std::uintmax_t bytes_by_header(FileHeader& header) {
    using namespace std::string_view_literals;
    if (header.begins_with("II*") || header.begins_with("II+") || header.begins_with("MM\0"sv)) {
        return end_of_tiff(header);
    }
    if (header.begins_with("\x89PNG\r\n\x1a\n"sv)) { return end_of_png(header); }
    if (header.begins_with("\0\0\0\x0cjP  "sv) || header.begins_with("\xff\x4f\xff\x51"sv)) {
        return end_of_jpeg_2000(header);
    }
    if (header.begins_with("\xff\xd8\xff"sv)) { // JPEG
        return has_end_mark(header) ? 0 : header.bytes() + 2;
    }
    if (header.begins_with("\x89HDF\r\n\x1a\n"sv)) {
        return header.number(header.number(8, 1, true) < 2 ? 40 : 28, 8, true);
    }
    if (header.begins_with("GRIB") && header.number(7, 1, false) == 2) { // its first message
        return header.number(8, 8, false);
    }
    if (header.begins_with("SQLite format 3\0"sv)) { // GeoPackage
        const std::uintmax_t page = header.number(16, 2, false);
        const bool is_valid = header.number(24, 4, false) == header.number(92, 4, false);
        const std::uintmax_t pages = is_valid ? header.number(28, 4, false) : 0;
        constexpr std::uintmax_t own = 100;
        return std::max(own, (page == 1 ? 65536 : page) * pages);
    }
    if (header.begins_with("EHFA_HEADER_TAG\0"sv)) { // Erdas Imagine: root and dictionary
        const std::uintmax_t at = header.number(16, 4, true);
        return 1 + std::max({at + 17, header.number(at + 8, 4, true), header.number(at + 14, 4, true)});
    }
    return 0;
}

/// Throws Error for a file that is shorter than its own header says. Libraries tell that in words
/// of their own, or read what is there and say nothing.
void check_end(const path& file) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) {
        return; // within an archive, or a folder
    }
    FileHeader header(file);
    const std::uintmax_t bytes = bytes_by_header(header);
    if (header.bytes() < bytes) {
        throw_unreadable(
            file, "a height field", fmt::format("only the first {} of its at least {} bytes", header.bytes(), bytes));
    }
}

/// How much of a .hgt tile, which has no header, is there; empty for other files.
std::string cut_short_tile(const path& file) {
    std::error_code code;
    const std::uintmax_t bytes = std::filesystem::file_size(file, code);
    const std::string ending = file.extension().string();
    if (code || (ending != ".hgt" && ending != ".HGT")) { return {}; }
    constexpr std::uintmax_t coarse = std::uintmax_t{2} * 1201 * 1201;
    constexpr std::uintmax_t fine = std::uintmax_t{2} * 3601 * 3601;
    return fmt::format("only the first {} of the {} bytes of a .hgt tile", bytes, bytes <= coarse ? coarse : fine);
}

} // namespace

Dataset open_raster_file(
    const path& file, GdalSession& gdal, std::optional<std::string>& band, std::vector<MapNote>& notes) {
    check_end(file);
    Dataset dataset = open_plain_pgm(file);
    if (!dataset) { dataset = open_named(file.string()); }
    if (!dataset) {
        const std::string cut_short = cut_short_tile(file);
        if (!cut_short.empty()) { throw_unreadable(file, "a height field", cut_short); }
        throw_unreadable(file, "a height field",
            gdal.is_unknown_format() ? "another kind of file (any raster format of GDAL's is read)"
                                     : gdal.reason(file));
    }
    if (GDALGetRasterCount(dataset.get()) == 0) {
        const std::vector<std::string> names = subdatasets_of(dataset.get());
        if (!names.empty()) {
            const std::string chosen = chosen_subdataset(file, names, band, notes);
            dataset = open_named(chosen);
            if (!dataset) { throw_unreadable(file, "a height field", gdal.reason(file)); }
        }
    }
    check_sources(file, dataset.get());
    gdal.forget();
    return dataset;
}

std::string truncation_error(const path& file, void* dataset) {
    const std::string_view driver = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
    std::uintmax_t expected = 0;
    if (driver == "GTiff") {
        expected = end_of_blocks(dataset);
    } else if (is_plain(driver, file)) {
        const GDALDataType type = GDALGetRasterDataType(GDALGetRasterBand(dataset, 1));
        expected = bytes_of_label(dataset) + static_cast<std::uintmax_t>(GDALGetRasterXSize(dataset)) *
                                                 static_cast<std::uintmax_t>(GDALGetRasterYSize(dataset)) *
                                                 static_cast<std::uintmax_t>(GDALGetDataTypeSizeBytes(type));
    }
    const std::uintmax_t bytes = bytes_of(dataset);
    return bytes == 0 || bytes >= expected ? std::string()
                                           : fmt::format("only the first {} of its {} bytes", bytes, expected);
}

std::vector<path> referenced_files(const path& file) {
    std::vector<path> files;
    const GdalSession gdal;
    if (const Dataset dataset = open_named(file.string())) {
        std::error_code code;
        for (const std::string& name : taken(GDALGetFileList(dataset.get()))) {
            if (std::filesystem::is_regular_file(name, code)) { files.emplace_back(name); }
        }
    }
    if (files.empty()) { files.push_back(file); }
    return files;
}

} // namespace octant::models::heights
