#include "models/heights/height_band.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/import_options.h"
#include "models/heights/local_frame.h"
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
#include <fmt/ranges.h>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace octant::models::heights {

// Sources: "Terrain Tiles" of Mapzen (Terrarium), "Mapbox Terrain-RGB v1" (documentation of both); heightmap-1.0 as
// CesiumGS's wiki and Cesium Terrain Builder have it: 65 x 65 little-endian unsigned numbers of 16 bits from the
// north-west corner, a fifth of a metre each, from -1000 m on; then a byte of child tiles, and a water mask of one byte
// or 256 x 256.

namespace {

using std::filesystem::path;

/// How 8-bit red, green and blue encode a height.
enum class HeightEncoding {
    Terrarium, ///< (R * 256 + G + B / 256) - 32768 m (Mapzen, tilezen/joerd)
    Mapbox     ///< -10000 + (R * 65536 + G * 256 + B) * 0.1 m (Mapbox Terrain-RGB, MapTiler)
};

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
    glm::ivec3 min{255};
    glm::ivec3 max{0};
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
        min = glm::min(min, pixel);
        max = glm::max(max, pixel);
    }

    bool are_heights(HeightEncoding code) const {
        if (pixels == 0 || heights < pixels || 10 * close < 9 * pairs) { return false; }
        constexpr double sea_m = 0.05;
        if (furthest_m < sea_m || green.are_digits() || blue.are_digits()) { return true; }
        // Of steep ground the lowest channel is noise: 85 on average.
        const bool blue_is_noise = pairs > 0 && change_blue > 60.0 * static_cast<double>(pairs);
        const glm::ivec3 range = max - min;
        return code == HeightEncoding::Terrarium ? blue_is_noise || (range.x <= 1 && max.z == 0) // whole metres
                                                 : max.x > 0 && (blue_is_noise || (range.x == 0 && range.y <= 3));
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

std::string_view name_of(HeightEncoding code) { return code == HeightEncoding::Terrarium ? "Terrarium" : "Mapbox"; }

/// The encoding by its name in --band: terrarium or mapbox.
std::optional<HeightEncoding> height_encoding_from_name(const std::string& name) {
    for (const HeightEncoding code : {HeightEncoding::Terrarium, HeightEncoding::Mapbox}) {
        if (EQUAL(name.c_str(), std::string(name_of(code)).c_str())) { return code; }
    }
    return std::nullopt;
}

/// The encoding of an image that holds heights; nothing for other images. Samples of all rows decide: all must decode
/// to plausible heights, and heights of neighbours must be close although the channel of the lower digits jumps, which
/// it does not in photographs.
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

/// The heights of such an image, metres, as one band, followed by its alpha band if it has one. Opens `dataset` again
/// by its name. Throws Error for an image with fewer than three bands.
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
        place = place_xml(system == nullptr ? "" : wkt_of(system), transform);
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

} // namespace

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
        throw_error_in(file, "expected a Cesium heightmap of 65 x 65 samples, got another kind of terrain tile, such "
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

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The words of a name in lower case. Signs and blanks part words; full stops are left out, so that "U.S." is one word.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    bool in_word = false;
    for (const char c : text) {
        if (c == '.') { continue; }
        const bool is_ascii = static_cast<unsigned char>(c) < 0x80;
        if (is_ascii && !is_letter(c) && !is_digit(c)) {
            in_word = false;
            continue;
        }
        if (!in_word) { words.emplace_back(); }
        in_word = true;
        words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return words;
}

/// The words of a band's name, in which a capital letter may begin a word, too: heightError.
std::vector<std::string> words_of_name(std::string_view name) {
    std::string parted;
    for (const char c : name) {
        const bool begins = !parted.empty() && std::islower(static_cast<unsigned char>(parted.back())) != 0 &&
                            std::isupper(static_cast<unsigned char>(c)) != 0;
        parted += begins ? " " : "";
        parted += c;
    }
    return words_of(parted);
}

bool is_unspecified(std::string_view unit) {
    constexpr std::array<std::string_view, 8> words = {
        "", "unspecified", "unknown", "none", "na", "n a", "undefined", "not specified"};
    const std::string joined = fmt::format("{}", fmt::join(words_of(unit), " "));
    return std::ranges::find(words, joined) != words.end();
}

/// Metres of a unit whose name is these letters without blanks, in the singular.
std::optional<double> metres_of_name(std::string_view name) {
    constexpr double foot_m = 0.3048;
    constexpr double survey_foot_m = 1200.0 / 3937.0;
    struct Unit {
        std::string_view names; ///< each between blanks
        double metres;
    };
    constexpr std::array<Unit, 10> units{{
        {" m metre meter ", 1.0},
        {" ft foot ift ftintl footintl intlft intlfoot internationalft internationalfoot footinternational ", foot_m},
        {" usft usfoot ftus footus sft sfoot ussft ussurveyft ussurveyfoot surveyft surveyfoot footussurvey "
         "ftussurvey ",
            survey_foot_m},
        {" dm decimetre decimeter ", 0.1},
        {" cm centimetre centimeter ", 0.01},
        {" mm millimetre millimeter ", 0.001},
        {" km kilometre kilometer ", 1000.0},
        {" yard yd ", 0.9144},
        {" fathom ", 1.8288},
        {" inch ", 0.0254},
    }};
    const std::string word = fmt::format(" {} ", name);
    const auto found =
        std::ranges::find_if(units, [&](const Unit& unit) { return unit.names.find(word) != unit.names.npos; });
    return found == units.end() ? std::nullopt : std::optional(found->metres);
}

std::string singular(std::string word) {
    if (word == "feet") { return "foot"; }
    const bool is_plural = word.size() > 3 && word.ends_with('s');
    if (is_plural) { word.pop_back(); }
    return word == "inche" ? "inch" : word;
}

/// Whether a word behind the name of a length makes another quantity of it, such as metres a second.
bool makes_no_length(std::string_view word) {
    constexpr std::array<std::string_view, 17> words = {"s", "sec", "second", "seconds", "per", "h", "hr", "hour",
        "day", "days", "d", "yr", "year", "a", "kg", "square", "squared"};
    return is_digit(word.front()) || std::ranges::find(words, word) != words.end();
}

/// The unit of heights that a coordinate system names, in metres.
std::optional<double> vertical_unit_m(OGRSpatialReferenceH system) {
    if (system == nullptr || OSRGetAttrValue(system, "VERT_CS", 0) == nullptr) { return std::nullopt; }
    return OSRGetTargetLinearUnits(system, "VERT_CS", nullptr);
}

/// Says so where lengths on the map are in feet and heights, which name no unit, count as metres.
void note_feet(const path& file, OGRSpatialReferenceH system, HeightBand& band) {
    if (system == nullptr || OSRIsProjected(system) == 0) { return; }
    char* name = nullptr; // the system's own
    const double unit_m = OSRGetLinearUnits(system, &name);
    if (std::abs(unit_m - 0.3048) < 1e-5) {
        band.notes.push_back({fmt::format("{}: the coordinate system is in feet ({}), heights name no unit and count "
                                          "as metres: --height-scale {:.9g} says that they are feet, too",
            file.filename().string(), name == nullptr ? "no name" : name, unit_m)});
    }
}

/// Applies the unit that the band names, else its system, else the options, else metres.
void take_unit(const path& file, OGRSpatialReferenceH system, const std::optional<double>& given, HeightBand& band) {
    const std::string unit = GDALGetRasterUnitType(band.band);
    const bool is_named = !is_unspecified(unit);
    const auto named = is_named ? metres_from_unit(unit) : vertical_unit_m(system);
    if (!named && !given && is_named) {
        throw_error_in(file,
            fmt::format("expected heights in metres or feet, got '{}': --height-scale says how many metres that is",
                printable(unit)));
    }
    if (!named && !given) { note_feet(file, system, band); }
    band.declares_unit = named.has_value();
    const double unit_m = named ? *named : given.value_or(1.0);
    band.scale_m = GDALGetRasterScale(band.band, nullptr) * unit_m;
    band.offset_m = GDALGetRasterOffset(band.band, nullptr) * unit_m;
}

/// A band's name; empty for one without.
std::string name_of(GDALDatasetH dataset, int number) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, number);
    std::string name = GDALGetDescription(band);
    if (name.empty()) {
        for (const char* const key : {"standard_name", "long_name", "NETCDF_VARNAME", "GRIB_ELEMENT"}) {
            const char* const value = GDALGetMetadataItem(band, key, nullptr);
            if (value != nullptr && *value != '\0') { return value; }
        }
    }
    return name;
}

std::string band_text(GDALDatasetH dataset, int number) {
    const std::string name = name_of(dataset, number);
    return name.empty() ? fmt::format("{}", number) : fmt::format("{} ({})", number, printable(name));
}

std::string bands_text(GDALDatasetH dataset) {
    constexpr int max_named = 8;
    std::vector<std::string> texts;
    const int count = GDALGetRasterCount(dataset);
    for (int number = 1; number <= std::min(count, max_named); ++number) {
        texts.push_back(band_text(dataset, number));
    }
    return fmt::format("{}{}", fmt::join(texts, ", "), count > max_named ? ", ..." : "");
}

/// The band that an option names by its number or its name.
int band_named(const path& file, GDALDatasetH dataset, const std::string& wanted) {
    const int count = GDALGetRasterCount(dataset);
    const bool is_number = !wanted.empty() && std::ranges::all_of(wanted, is_digit);
    if (is_number && wanted.size() < 6) {
        const int number = std::stoi(wanted);
        if (number >= 1 && number <= count) { return number; }
    }
    for (int number = 1; number <= count; ++number) {
        if (EQUAL(name_of(dataset, number).c_str(), wanted.c_str())) { return number; }
    }
    throw_error_in(file, fmt::format("--band {}: the file has {}, {}", printable(wanted),
                             count == 1 ? "one band" : fmt::format("{} bands", count), bands_text(dataset)));
}

bool is_bytes(GDALDatasetH dataset) {
    for (int number = 1; number <= GDALGetRasterCount(dataset); ++number) {
        if (GDALGetRasterDataType(GDALGetRasterBand(dataset, number)) != GDT_Byte) { return false; }
    }
    return true;
}

GDALColorInterp colour_of(GDALDatasetH dataset, int number) {
    return GDALGetRasterColorInterpretation(GDALGetRasterBand(dataset, number));
}

/// Whether a band's name says that it holds something else: a measure of heights, such as their error or slope, or
/// heights of other things than the ground, such as trees.
bool says_no_heights(const std::vector<std::string>& words) {
    constexpr std::array<std::string_view, 46> others = {"error", "errors", "err", "std", "stdev", "stddev", "sd",
        "deviation", "sigma", "rms", "rmse", "uncertainty", "unc", "variance", "var", "precision", "accuracy",
        "confidence", "quality", "qa", "count", "counts", "num", "number", "mask", "flag", "flags", "slope", "aspect",
        "hillshade", "shade", "curvature", "roughness", "gradient", "canopy", "vegetation", "tree", "trees", "geoid",
        "undulation", "wave", "waves", "cloud", "snow", "change", "difference"};
    const auto end = std::ranges::find(words, "above"); // "above geoid" only says what heights count from
    return std::any_of(
        words.begin(), end, [&](const std::string& word) { return std::ranges::find(others, word) != others.end(); });
}

/// The bands whose names say heights.
std::vector<int> bands_named_heights(GDALDatasetH dataset) {
    std::vector<int> numbers;
    for (int number = 1; number <= GDALGetRasterCount(dataset); ++number) {
        if (is_height_band_name(name_of(dataset, number))) { numbers.push_back(number); }
    }
    return numbers;
}

/// The first band whose name does not say that it holds no heights; the first where all do.
int first_other_band(GDALDatasetH dataset) {
    for (int number = 1; number <= GDALGetRasterCount(dataset); ++number) {
        if (!says_no_heights(words_of_name(name_of(dataset, number)))) { return number; }
    }
    return 1;
}

/// Whether red, green and blue are the same in all pixels, as many programs write pictures of heights.
bool is_grey_picture(GDALDatasetH dataset) {
    if (GDALGetRasterCount(dataset) < 3 || colour_of(dataset, 1) != GCI_RedBand ||
        colour_of(dataset, 2) != GCI_GreenBand || colour_of(dataset, 3) != GCI_BlueBand) {
        return false;
    }
    const int columns = GDALGetRasterXSize(dataset);
    std::array<std::vector<double>, 3> lines;
    for (std::vector<double>& line : lines) { line.resize(static_cast<std::size_t>(columns)); }
    for (int row = 0; row < GDALGetRasterYSize(dataset); ++row) {
        for (int channel = 0; channel < 3; ++channel) {
            std::vector<double>& line = lines[static_cast<std::size_t>(channel)];
            if (GDALRasterIO(GDALGetRasterBand(dataset, channel + 1), GF_Read, 0, row, columns, 1, line.data(), columns,
                    1, GDT_Float64, 0, 0) != CE_None) {
                return false;
            }
        }
        if (lines[0] != lines[1] || lines[0] != lines[2]) { return false; }
    }
    return true;
}

/// The band of heights where no option names one.
int chosen_band(const path& file, GDALDatasetH dataset, std::vector<MapNote>& notes) {
    const int count = GDALGetRasterCount(dataset);
    const std::vector<int> named = count > 1 ? bands_named_heights(dataset) : std::vector<int>();
    const int number = named.empty() ? first_other_band(dataset) : named.front();
    const GDALColorInterp colour = colour_of(dataset, number);
    const bool is_coloured = GDALGetRasterColorTable(GDALGetRasterBand(dataset, number)) != nullptr ||
                             (colour != GCI_Undefined && colour != GCI_GrayIndex);
    if (is_coloured && is_grey_picture(dataset)) {
        notes.push_back({fmt::format(
            "{}: red, green and blue are the same everywhere: taken for heights", file.filename().string())});
        return number;
    }
    if (is_coloured) {
        throw_error_in(
            file, "expected one band of heights, got a colour picture: --band N takes one of its bands for heights");
    }
    const bool has_alpha = count > 1 && colour_of(dataset, count) == GCI_AlphaBand;
    const int others = count - 1 - (has_alpha ? 1 : 0);
    if (named.empty() && others >= 2 && is_bytes(dataset)) {
        throw_error_in(file, fmt::format("expected one band of heights, got {} of 8 bits, which make a picture: --band "
                                         "N takes one of them for heights",
                                 count));
    }
    if (others > 0 && (named.size() != 1 || number > 1)) { // a single one in front is no guess
        notes.push_back({fmt::format("{}: band {} of {} is taken for heights: --band N|NAME chooses another",
            file.filename().string(), band_text(dataset, number), bands_text(dataset))});
    }
    return number;
}

/// The band whose zeros are samples without data: the dataset's own mask, or its alpha band. Null where there is none
/// beside a declared value.
GDALRasterBandH mask_of(GDALDatasetH dataset, int number) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, number);
    const int flags = GDALGetMaskFlags(band);
    if ((flags & (GMF_ALL_VALID | GMF_NODATA)) == 0) { return GDALGetMaskBand(band); }
    for (int other = 1; other <= GDALGetRasterCount(dataset); ++other) {
        if (other != number && colour_of(dataset, other) == GCI_AlphaBand) { return GDALGetRasterBand(dataset, other); }
    }
    return nullptr;
}

void take_band(const path& file, GDALDatasetH dataset, const ImportOptions& options, HeightBand& band) {
    band.band = GDALGetRasterBand(dataset, band.number);
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band.band)) != 0) {
        throw_error_in(file, "expected real heights, got complex numbers");
    }
    take_unit(file, GDALGetSpatialRef(dataset), options.height_scale, band);
    band.no_data = declared_no_data(band.band);
    band.mask = mask_of(dataset, band.number);
}

} // namespace

bool is_height_band_name(std::string_view name) {
    constexpr std::array<std::string_view, 16> heights = {"elevation", "elevations", "elev", "dem", "dtm", "dsm",
        "height", "heights", "altitude", "alt", "topography", "topo", "orography", "terrain", "bathymetry", "hgt"};
    const std::vector<std::string> words = words_of_name(name);
    return !says_no_heights(words) && std::ranges::any_of(words, [&](const std::string& word) {
        return std::ranges::find(heights, word) != heights.end();
    });
}

std::optional<double> declared_no_data(void* band) {
    int declared = 0;
    double value = 0.0;
    switch (GDALGetRasterDataType(band)) {
    case GDT_Int64:
        value = static_cast<double>(GDALGetRasterNoDataValueAsInt64(band, &declared));
        break;
    case GDT_UInt64:
        value = static_cast<double>(GDALGetRasterNoDataValueAsUInt64(band, &declared));
        break;
    default:
        value = GDALGetRasterNoDataValue(band, &declared);
    }
    return declared != 0 ? std::optional(value) : std::nullopt;
}

std::optional<double> metres_from_unit(std::string_view unit) {
    const std::vector<std::string> words = words_of(unit);
    constexpr std::size_t longest = 3;
    for (std::size_t used = std::min(longest, words.size()); used > 0; --used) {
        if (used < words.size() && makes_no_length(words[used])) { continue; }
        std::string as_written;
        std::string in_singular;
        for (std::size_t i = 0; i < used; ++i) {
            as_written += words[i];
            in_singular += singular(words[i]);
        }
        for (const std::string& name : {as_written, in_singular}) {
            if (const std::optional<double> metres = metres_of_name(name)) { return metres; }
        }
    }
    return std::nullopt;
}

HeightBand height_band_of(const path& file, void* dataset, const ImportOptions& options) {
    if (GDALGetRasterCount(dataset) < 1) { throw_unreadable(file, "a height field", "no band"); }
    HeightBand band;
    const std::optional<HeightEncoding> forced = options.band ? height_encoding_from_name(*options.band) : std::nullopt;
    const std::optional<HeightEncoding> code = options.band ? forced : height_encoding_of(dataset);
    if (code) {
        band.decoded = decoded_heights(file, dataset, *code);
        band.notes.push_back({fmt::format(
            "{}: heights are decoded from colours by the rule of {} tiles: --band N takes one band as it is",
            file.filename().string(), name_of(*code))});
        take_band(file, band.decoded.get(), options, band);
        return band;
    }
    band.number = options.band ? band_named(file, dataset, *options.band) : chosen_band(file, dataset, band.notes);
    take_band(file, dataset, options, band);
    return band;
}

} // namespace octant::models::heights
