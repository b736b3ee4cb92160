#include "models/heights/height_band.h"

#include "models/heights/colour_coded_heights.h"
#include "models/heights/gdal_functions.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <utility>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

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
    constexpr std::array<std::pair<std::string_view, double>, 42> known = {{
        {"m", 1.0},
        {"metre", 1.0},
        {"meter", 1.0},
        {"ft", foot_m},
        {"foot", foot_m},
        {"ift", foot_m},
        {"ftintl", foot_m},
        {"footintl", foot_m},
        {"intlft", foot_m},
        {"intlfoot", foot_m},
        {"internationalft", foot_m},
        {"internationalfoot", foot_m},
        {"footinternational", foot_m},
        {"usft", survey_foot_m},
        {"usfoot", survey_foot_m},
        {"ftus", survey_foot_m},
        {"footus", survey_foot_m},
        {"sft", survey_foot_m},
        {"sfoot", survey_foot_m},
        {"ussft", survey_foot_m},
        {"ussurveyft", survey_foot_m},
        {"ussurveyfoot", survey_foot_m},
        {"surveyft", survey_foot_m},
        {"surveyfoot", survey_foot_m},
        {"footussurvey", survey_foot_m},
        {"ftussurvey", survey_foot_m},
        {"dm", 0.1},
        {"decimetre", 0.1},
        {"decimeter", 0.1},
        {"cm", 0.01},
        {"centimetre", 0.01},
        {"centimeter", 0.01},
        {"mm", 0.001},
        {"millimetre", 0.001},
        {"millimeter", 0.001},
        {"km", 1000.0},
        {"kilometre", 1000.0},
        {"kilometer", 1000.0},
        {"yard", 0.9144},
        {"yd", 0.9144},
        {"fathom", 1.8288},
        {"inch", 0.0254},
    }};
    const auto found = std::ranges::find(known, name, &std::pair<std::string_view, double>::first);
    return found == known.end() ? std::nullopt : std::optional(found->second);
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
        band.notes.push_back(
            {fmt::format("{}: the coordinate system is in feet ({}), heights name no unit and count as metres: "
                         "--height-scale {:.9g} says that they are feet, too",
                file.filename().string(), name == nullptr ? "no name" : name, unit_m)});
    }
}

/// Applies the unit that the band names, else its system, else the options, else metres.
void take_unit(const path& file, OGRSpatialReferenceH system, const std::optional<double>& given, HeightBand& band) {
    const std::string unit = GDALGetRasterUnitType(band.band);
    const bool is_named = !is_unspecified(unit);
    const auto named = is_named ? metres_from_unit(unit) : vertical_unit_m(system);
    if (!named && !given && is_named) {
        throw_error_in(
            file, fmt::format("expected heights in metres or feet, got '{}': --height-scale says how many metres "
                              "that is",
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

/// The band of heights where no option names one.
int chosen_band(const path& file, GDALDatasetH dataset, std::vector<MapNote>& notes) {
    const int count = GDALGetRasterCount(dataset);
    const std::vector<int> named = count > 1 ? bands_named_heights(dataset) : std::vector<int>();
    const int number = named.empty() ? first_other_band(dataset) : named.front();
    const GDALColorInterp colour = colour_of(dataset, number);
    const bool is_coloured = GDALGetRasterColorTable(GDALGetRasterBand(dataset, number)) != nullptr ||
                             (colour != GCI_Undefined && colour != GCI_GrayIndex);
    if (is_coloured) { throw_error_in(file, "expected one band of heights, got a colour picture"); }
    const bool has_alpha = count > 1 && colour_of(dataset, count) == GCI_AlphaBand;
    const int others = count - 1 - (has_alpha ? 1 : 0);
    if (named.empty() && others >= 2 && is_bytes(dataset)) {
        throw_error_in(
            file, fmt::format("expected one band of heights, got {} of 8 bits, which make a picture: --band N "
                              "takes one of them for heights",
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
        band.notes.push_back(
            {fmt::format("{}: heights are decoded from colours by the rule of {} tiles: --band N takes one band "
                         "as it is",
                file.filename().string(), name_of(*code))});
        take_band(file, band.decoded.get(), options, band);
        return band;
    }
    band.number = options.band ? band_named(file, dataset, *options.band) : chosen_band(file, dataset, band.notes);
    take_band(file, dataset, options, band);
    return band;
}

} // namespace octant::models::heights
