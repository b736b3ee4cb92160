// Sources: "Terrain Tiles" of Mapzen (Terrarium), "Mapbox Terrain-RGB v1" (documentation of both); heightmap-1.0 as
// CesiumGS's wiki and Cesium Terrain Builder have it: 65 x 65 little-endian unsigned numbers of 16 bits from the
// north-west corner, a fifth of a metre each, from -1000 m on; then a byte of child tiles, and a water mask of one byte
// or 256 x 256.
#include "models/heights/colour_coded_heights.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/import_options.h"
#include "sim/base/error.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <numbers>
#include <utility>
#include <vector>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

/// A height is the offset and each channel times its weight, in a unit in which both are exact.
struct Weights {
    std::array<double, 3> channel;
    double offset;
    const char* unit;
    double unit_m;
};

constexpr std::array<Weights, 2> weights_of_codes = {
    Weights{{256.0, 1.0, 1.0 / 256.0}, -32768.0, "m", 1.0}, Weights{{65536.0, 256.0, 1.0}, -100000.0, "dm", 0.1}};

const Weights& weights_of(HeightEncoding code) { return weights_of_codes.at(static_cast<std::size_t>(code)); }

/// Number of a tile in its scheme.
struct TileId {
    int zoom = 0;
    int column = 0;
    int row = 0;
};

/// The number at the end of a path, ZOOM/COLUMN/ROW.EXTENSION; nothing for other paths and numbers that no zoom level
/// has. A level has `columns_of_first` * 2^zoom columns.
std::optional<TileId> tile_number(const path& file, int columns_of_first) {
    const std::array<std::string, 3> parts = {file.parent_path().parent_path().filename().string(),
        file.parent_path().filename().string(), file.stem().string()};
    std::array<int, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string& part = parts.at(i);
        const bool is_number = !part.empty() && part.size() <= 8 &&
                               std::ranges::all_of(part, [](unsigned char c) { return std::isdigit(c) != 0; });
        if (!is_number) { return std::nullopt; }
        numbers.at(i) = std::stoi(part);
    }
    constexpr int deepest = 24;
    const TileId tile{numbers[0], numbers[1], numbers[2]};
    const bool exists =
        tile.zoom <= deepest && tile.column < (columns_of_first << tile.zoom) && tile.row < (1 << tile.zoom);
    return exists ? std::optional(tile) : std::nullopt;
}

std::string as_xml(const std::string& text) {
    char* const escaped = CPLEscapeString(text.c_str(), static_cast<int>(text.size()), CPLES_XML);
    std::string xml = escaped;
    CPLFree(escaped);
    return xml;
}

std::string place_xml(const std::string& system, const std::array<double, 6>& transform) {
    return fmt::format("<SRS dataAxisToSRSAxisMapping=\"{}\">{}</SRS><GeoTransform>{:.17g}, {:.17g}, {:.17g}, "
                       "{:.17g}, {:.17g}, "
                       "{:.17g}</GeoTransform>",
        system == "EPSG:4326" ? "2,1" : "1,2", as_xml(system), transform[0], transform[1], transform[2], transform[3],
        transform[4], transform[5]);
}

/// Where a square tile of the web Mercator scheme lies, whose row 0 is the north.
std::string mercator_place(const TileId& tile, int pixels) {
    constexpr double half_m = std::numbers::pi * 6378137.0;
    const double side_m = 2.0 * half_m / (1 << tile.zoom);
    const double step_m = side_m / pixels;
    return place_xml(
        "EPSG:3857", {tile.column * side_m - half_m, step_m, 0.0, half_m - tile.row * side_m, 0.0, -step_m});
}

Dataset open_virtual(const std::string& xml) {
    constexpr unsigned flags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
    constexpr std::array<const char*, 2> drivers = {"VRT", nullptr};
    return Dataset(GDALOpenEx(xml.c_str(), flags, drivers.data(), nullptr, nullptr));
}

int alpha_band_of(GDALDatasetH dataset) {
    const int count = GDALGetRasterCount(dataset);
    const bool is_alpha =
        count >= 4 && GDALGetRasterColorInterpretation(GDALGetRasterBand(dataset, count)) == GCI_AlphaBand;
    return is_alpha ? count : 0;
}

/// Pairs of neighbours in which a channel jumps, and those of them in which the next higher channel takes the carry, as
/// the digits of a number do.
struct Jumps {
    long pairs = 0;
    long carries = 0;

    void add(int low, int high) {
        constexpr int jump = 128;
        if (std::abs(low) > jump) {
            ++pairs;
            carries += high == (low < 0 ? 1 : -1) ? 1 : 0;
        }
    }

    bool are_digits() const { return pairs >= 4 && 10 * carries >= 6 * pairs; }
};

/// What neighbouring pixels of a picture tell of its channels.
struct Neighbours {
    long pixels = 0;
    long heights = 0; ///< pixels whose decoded height some ground has
    long pairs = 0;
    long close = 0; ///< pairs whose red and green, as one number, differ little
    Jumps green;
    Jumps blue;
    double change_blue = 0.0;
    glm::ivec3 least{255};
    glm::ivec3 greatest{0};
    double furthest_m = 0.0; ///< from sea level

    void add_pair(const glm::ivec3& a, const glm::ivec3& b) {
        const glm::ivec3 step = b - a;
        ++pairs;
        close += std::abs(256 * step.x + step.y) <= 1024 ? 1 : 0;
        green.add(step.y, step.x);
        blue.add(step.z, step.y);
        change_blue += std::abs(step.z);
    }

    void add(const glm::ivec3& pixel, const Weights& weights) {
        const double code =
            weights.offset + weights.channel[0] * pixel.x + weights.channel[1] * pixel.y + weights.channel[2] * pixel.z;
        const double height_m = code * weights.unit_m;
        ++pixels;
        heights += height_m >= lowest_import_m && height_m <= highest_import_m ? 1 : 0;
        furthest_m = std::max(furthest_m, std::abs(height_m));
        least = glm::min(least, pixel);
        greatest = glm::max(greatest, pixel);
    }

    bool are_heights(HeightEncoding code) const {
        if (pixels == 0 || heights < pixels || 10 * close < 9 * pairs) { return false; }
        constexpr double sea_m = 0.05;
        if (furthest_m < sea_m || green.are_digits() || blue.are_digits()) { return true; }
        // Of steep ground the lowest channel is noise: 85 on average.
        const bool blue_is_noise = pairs > 0 && change_blue > 60.0 * static_cast<double>(pairs);
        const glm::ivec3 range = greatest - least;
        return code == HeightEncoding::Terrarium ? blue_is_noise || (range.x <= 1 && greatest.z == 0) // whole metres
                                                 : greatest.x > 0 && (blue_is_noise || (range.x == 0 && range.y <= 3));
    }
};

/// The interleaved channels of some rows of a picture, spread evenly.
std::vector<std::vector<std::uint8_t>> sampled_rows(GDALDatasetH dataset) {
    constexpr int max_rows = 64;
    const int columns = GDALGetRasterXSize(dataset);
    const int rows = GDALGetRasterYSize(dataset);
    const int count = std::min(rows, max_rows);
    std::vector<std::vector<std::uint8_t>> sampled;
    for (int i = 0; i < count; ++i) {
        const int row = static_cast<int>(std::int64_t{i} * rows / count);
        std::vector<std::uint8_t> line(std::size_t{3} * static_cast<std::size_t>(columns));
        for (int channel = 0; channel < 3; ++channel) {
            const CPLErr result = GDALRasterIO(GDALGetRasterBand(dataset, channel + 1), GF_Read, 0, row, columns, 1,
                line.data() + channel, columns, 1, GDT_Byte, 3, 0);
            if (result != CE_None) { return {}; }
        }
        sampled.push_back(std::move(line));
    }
    return sampled;
}

bool is_coded_by(const std::vector<std::vector<std::uint8_t>>& rows, HeightEncoding code) {
    const Weights& weights = weights_of(code);
    Neighbours found;
    for (const std::vector<std::uint8_t>& line : rows) {
        constexpr glm::ivec3 nothing(0); // black is without data
        glm::ivec3 last = nothing;
        for (std::size_t at = 0; at + 2 < line.size(); at += 3) {
            const glm::ivec3 pixel(line[at], line[at + 1], line[at + 2]);
            if (pixel != nothing) {
                found.add(pixel, weights);
                if (last != nothing) { found.add_pair(last, pixel); }
            }
            last = pixel;
        }
    }
    return found.are_heights(code);
}

} // namespace

std::string_view name_of(HeightEncoding code) { return code == HeightEncoding::Terrarium ? "Terrarium" : "Mapbox"; }

std::optional<HeightEncoding> height_encoding_from_name(const std::string& name) {
    for (const HeightEncoding code : {HeightEncoding::Terrarium, HeightEncoding::Mapbox}) {
        if (EQUAL(name.c_str(), std::string(name_of(code)).c_str())) { return code; }
    }
    return std::nullopt;
}

std::optional<HeightEncoding> height_encoding_of(void* dataset) {
    const int count = GDALGetRasterCount(dataset);
    if (count < 3 || count > 4) { return std::nullopt; }
    for (int band = 1; band <= count; ++band) {
        if (GDALGetRasterDataType(GDALGetRasterBand(dataset, band)) != GDT_Byte) { return std::nullopt; }
    }
    const std::vector<std::vector<std::uint8_t>> rows = sampled_rows(dataset);
    for (const HeightEncoding code : {HeightEncoding::Terrarium, HeightEncoding::Mapbox}) {
        if (is_coded_by(rows, code)) { return code; }
    }
    return std::nullopt;
}

Dataset decoded_heights(const path& file, void* dataset, HeightEncoding code) {
    if (GDALGetRasterCount(dataset) < 3) {
        throw_error_in(file, fmt::format("expected red, green and blue for --band {}, got {} band(s)", name_of(code),
                                 GDALGetRasterCount(dataset)));
    }
    const Weights& weights = weights_of(code);
    const std::string source = as_xml(GDALGetDescription(dataset));
    std::array<double, 6> transform{};
    std::string place;
    const int columns = GDALGetRasterXSize(dataset);
    const int rows = GDALGetRasterYSize(dataset);
    if (GDALGetGeoTransform(dataset, transform.data()) == CE_None) {
        const OGRSpatialReferenceH system = GDALGetSpatialRef(dataset);
        char* wkt = nullptr;
        const bool is_written = system != nullptr && OSRExportToWkt(system, &wkt) == OGRERR_NONE;
        place = place_xml(is_written ? wkt : "", transform);
        CPLFree(wkt);
    } else if (const auto tile = tile_number(file, 1); tile && columns == rows) {
        place = mercator_place(*tile, columns);
    }
    std::string sources;
    for (int channel = 0; channel < 3; ++channel) {
        sources += fmt::format("<ComplexSource><SourceFilename>{}</SourceFilename><SourceBand>{}</SourceBand>"
                               "<ScaleOffset>{:.17g}</ScaleOffset><ScaleRatio>{:.17g}</ScaleRatio></ComplexSource>",
            source, channel + 1, channel == 0 ? weights.offset : 0.0,
            weights.channel.at(static_cast<std::size_t>(channel)));
    }
    std::string alpha;
    if (const int band = alpha_band_of(dataset)) {
        alpha = fmt::format("<VRTRasterBand dataType=\"Byte\" band=\"2\"><ColorInterp>Alpha</ColorInterp>"
                            "<SimpleSource><SourceFilename>{}</SourceFilename><SourceBand>{}</SourceBand>"
                            "</SimpleSource></VRTRasterBand>",
            source, band);
    }
    Dataset heights = open_virtual(
        fmt::format("<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\">{}<VRTRasterBand dataType=\"Float64\" "
                    "band=\"1\" subClass=\"VRTDerivedRasterBand\"><UnitType>{}</UnitType>"
                    "<PixelFunctionType>sum</PixelFunctionType><SourceTransferType>Float64"
                    "</SourceTransferType>{}</VRTRasterBand>{}</VRTDataset>",
            columns, rows, place, weights.unit, sources, alpha));
    if (!heights) { throw_unreadable(file, "a height field", "colours that cannot be decoded"); }
    return heights;
}

Dataset open_cesium_heightmap(const std::string& file) {
    constexpr int samples = 65;
    constexpr std::size_t heights_bytes = std::size_t{2} * samples * samples;
    constexpr std::array<std::size_t, 4> sizes = {
        heights_bytes, heights_bytes + 1, heights_bytes + 2, heights_bytes + 1 + 256 * 256};
    if (path(file).extension() != ".terrain") { return nullptr; }
    std::string name = file;
    std::vector<std::uint8_t> bytes(heights_bytes + 256 * 256 + 16);
    std::size_t size = 0;
    for (int attempt = 0; attempt < 2; ++attempt) {
        VSILFILE* const stream = VSIFOpenL(name.c_str(), "rb");
        if (stream == nullptr) { return nullptr; }
        size = VSIFReadL(bytes.data(), 1, bytes.size(), stream);
        VSIFCloseL(stream);
        const bool is_compressed = attempt == 0 && size > 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
        if (!is_compressed) { break; }
        name = "/vsigzip/" + std::filesystem::absolute(file).string();
    }
    if (std::ranges::find(sizes, size) == sizes.end()) {
        throw_error_in(file, "expected a Cesium heightmap of 65 x 65 samples, got another kind of terrain tile, "
                             "such "
                             "as a quantized mesh");
    }
    std::string place;
    if (const auto tile = tile_number(file, 2)) {
        const double side_deg = 180.0 / (1 << tile->zoom);
        const double step_deg = side_deg / (samples - 1); // samples lie on the tile's edges
        place = place_xml("EPSG:4326", {tile->column * side_deg - 180.0 - 0.5 * step_deg, step_deg, 0.0,
                                           (tile->row + 1) * side_deg - 90.0 + 0.5 * step_deg, 0.0, -step_deg});
    }
    return open_virtual(
        fmt::format("<VRTDataset rasterXSize=\"{0}\" rasterYSize=\"{0}\">{1}<VRTRasterBand dataType=\"UInt16\" "
                    "band=\"1\" subClass=\"VRTRawRasterBand\"><UnitType>m</UnitType><Offset>-1000</Offset>"
                    "<Scale>0.2</Scale><SourceFilename relativeToVRT=\"0\">{2}</SourceFilename>"
                    "<ImageOffset>0</ImageOffset><PixelOffset>2</PixelOffset><LineOffset>{3}</LineOffset>"
                    "<ByteOrder>LSB</ByteOrder></VRTRasterBand></VRTDataset>",
            samples, place, as_xml(name), 2 * samples));
}

} // namespace octant::models::heights
