#include "models/heights/height_raster.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/height_band.h"
#include "models/heights/import_options.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_inputs.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <new>
#include <numbers>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant::models::heights {

namespace {

using std::filesystem::path;
using GeoTransform = std::array<double, 6>;

/// Whether a raw number stands for no data by the file's word or the options'.
bool is_void(double raw, const HeightRaster& raster) {
    return !std::isfinite(raw) || (raster.no_data && is_same_raw(raw, *raster.no_data)) ||
           std::ranges::any_of(raster.user_void_values, [raw](double mark) { return is_same_raw(raw, mark); });
}

double height_of(double raw, const HeightRaster& raster) {
    const bool plain = raster.scale_m == 1.0 && raster.offset_m == 0.0;
    return plain ? raw : raw * raster.scale_m + raster.offset_m;
}

/// The heights that are believed on a body.
glm::dvec2 believed_m(const Ellipsoid& ellipsoid) {
    return ellipsoid.is_earth() ? glm::dvec2(lowest_import_m, highest_import_m)
                                : glm::dvec2(-max_height_other_body_m, max_height_other_body_m);
}

bool is_believed(double height_m, const Ellipsoid& ellipsoid) {
    const glm::dvec2 range_m = believed_m(ellipsoid);
    return height_m >= range_m.x && height_m <= range_m.y;
}

/// Whether a number must be looked at among all others of its raster before it counts as a height.
bool is_doubtful(double raw, double height_m, const HeightRaster& raster) {
    return !is_believed(height_m, raster.ellipsoid) || is_common_void_value(raw);
}

std::optional<GeoTransform> transform_of(const path& file, GDALDatasetH dataset) {
    GeoTransform t = {};
    if (GDALGetGeoTransform(dataset, t.data()) != CE_None) { return std::nullopt; }
    // What is left of a rotation by 0 or 180 degrees.
    t[2] = std::abs(t[2]) <= 1e-9 * std::abs(t[1]) ? 0.0 : t[2];
    t[4] = std::abs(t[4]) <= 1e-9 * std::abs(t[5]) ? 0.0 : t[4];
    const double area = t[1] * t[5] - t[2] * t[4];
    if (!std::isfinite(t[0]) || !std::isfinite(t[3]) || !std::isnormal(area)) {
        throw_error_in(file, fmt::format("expected a cell size that is a number, got {} x {}", t[1], t[5]));
    }
    return t;
}

/// Turns an upright raster so that it runs from the south-west; a rotated one stays from the south.
void take_transform(const GeoTransform& t, HeightRaster& raster) {
    const bool upright = t[2] == 0.0 && t[4] == 0.0;
    raster.rows_run_west = upright && t[1] < 0.0;
    raster.first_row_is_south = upright && t[5] > 0.0;
    const double first_line = raster.first_row_is_south ? 0.5 : raster.rows - 0.5;
    const double first_pixel = raster.rows_run_west ? raster.columns - 0.5 : 0.5;
    const double right = raster.rows_run_west ? -1.0 : 1.0;
    const double up = raster.first_row_is_south ? 1.0 : -1.0;
    raster.map = GridTransform{t[0] + first_pixel * t[1] + first_line * t[2], right * t[1], up * t[2],
        t[3] + first_pixel * t[4] + first_line * t[5], right * t[4], up * t[5]};
}

/// Reads a window of one of the raster's bands, as double or std::uint8_t, row after row from the south.
template <typename Number>
void read_window(const path& file, const HeightRaster& raster, GDALRasterBandH band, const GridWindow& window,
    Number* numbers, const GdalSession& gdal) {
    const int line = raster.first_row_is_south ? window.first_row : raster.rows - window.first_row - window.rows;
    const int pixel =
        raster.rows_run_west ? raster.columns - window.first_column - window.columns : window.first_column;
    const auto size = static_cast<GSpacing>(sizeof(Number));
    const GSpacing line_size = size * window.columns;
    Number* const start =
        numbers + (raster.rows_run_west ? window.columns - 1 : 0) +
        (raster.first_row_is_south ? std::ptrdiff_t{0} : std::ptrdiff_t{window.rows - 1} * window.columns);
    const CPLErr result = GDALRasterIOEx(band, GF_Read, pixel, line, window.columns, window.rows, start, window.columns,
        window.rows, std::is_same_v<Number, double> ? GDT_Float64 : GDT_Byte, raster.rows_run_west ? -size : size,
        raster.first_row_is_south ? line_size : -line_size, nullptr);
    if (result != CE_None || gdal.failed()) {
        const std::string cut_short = truncation_error(file, raster.datasets.front().get());
        if (!cut_short.empty()) { throw_unreadable(file, "a height field", cut_short); }
        throw_unreadable(file, "a height field", gdal.reason(file));
    }
}

/// Raw numbers of one line, NaN without data by the file's word or the options'.
void read_raw_line(const path& file, const HeightRaster& raster, const GridWindow& line, std::span<double> raw,
    const GdalSession& gdal) {
    assert(line.rows == 1);
    read_window(file, raster, raster.band, line, raw.data(), gdal);
    if (raster.text_voids.samples > 0) { // a text grid is upright, its first line is the north
        const std::int64_t from_north = raster.rows - 1 - line.first_row;
        raster.text_voids.apply(from_north * raster.columns + line.first_column, raw);
    }
    std::vector<std::uint8_t> mask(raster.mask == nullptr ? 0 : raw.size());
    if (raster.mask != nullptr) { read_window(file, raster, raster.mask, line, mask.data(), gdal); }
    for (std::size_t x = 0; x < raw.size(); ++x) {
        if ((raster.mask != nullptr && mask[x] == 0) || is_void(raw[x], raster)) {
            raw[x] = std::numeric_limits<double>::quiet_NaN();
        }
    }
}

/// 2^bits of the unsigned numbers that a band holds or may have been made of.
double modulus_of(GDALRasterBandH band) { return GDALGetRasterDataType(band) == GDT_UInt32 ? 4294967296.0 : 65536.0; }

const UndeclaredVoids& undeclared_voids(const path& file, const HeightRaster& raster, const GdalSession& gdal) {
    if (!raster.undeclared) {
        const glm::dvec2 range_m = believed_m(raster.ellipsoid);
        VoidDetector detector(range_m.x, range_m.y, modulus_of(raster.band));
        std::vector<double> line(static_cast<std::size_t>(raster.columns));
        for (int row = 0; row < raster.rows; ++row) {
            read_raw_line(file, raster, {0, raster.columns, row, 1}, line, gdal);
            for (const double raw : line) {
                if (!std::isnan(raw)) { detector.add(raw, height_of(raw, raster)); }
            }
        }
        raster.undeclared = detector.result();
    }
    return *raster.undeclared;
}

/// The height in metres of a raw number; NaN for one that stands for no data. Throws Error for one that is neither.
float height_from_raw(const path& file, double raw, const HeightRaster& raster, const GdalSession& gdal) {
    if (std::isnan(raw)) { return std::numeric_limits<float>::quiet_NaN(); }
    const double height_m = height_of(raw, raster);
    if (is_doubtful(raw, height_m, raster)) {
        if (undeclared_voids(file, raster, gdal).has(raw)) { return std::numeric_limits<float>::quiet_NaN(); }
        check_height(file, height_m, raw, raster.declares_unit, raster.ellipsoid);
    }
    return static_cast<float>(height_m);
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

/// Whether attributes of axes by the CF conventions say degrees east or north.
bool has_cf_degrees(GDALDatasetH dataset) {
    char** const list = GDALGetMetadata(dataset, nullptr);
    for (int i = 0; i < CSLCount(list); ++i) {
        const std::string_view entry = list[i];
        const std::size_t value = entry.find("#units=");
        if (value == std::string_view::npos) { continue; }
        std::string unit = lower_case(entry.substr(value + 7));
        std::erase(unit, '_');
        std::erase(unit, ' ');
        const bool is_degrees = unit.starts_with("degree");
        const std::string direction =
            unit.substr(unit.starts_with("degrees") ? 7 : std::min<std::size_t>(6, unit.size()));
        if (is_degrees && (direction == "north" || direction == "east" || direction == "n" || direction == "e")) {
            return true;
        }
    }
    return false;
}

/// Where a raster without a coordinate system may have degrees for axes.
struct DegreeSigns {
    bool fit = false;     ///< all its coordinates are longitudes and latitudes
    bool by_name = false; ///< its axes say so
    glm::dvec2 cell{0.0};
    glm::dvec2 extent{0.0};
    double furthest = 0.0; ///< of all coordinates, from 0

    bool is_fine() const { return std::max(cell.x, cell.y) < 1.0; }
};

DegreeSigns degree_signs(GDALDatasetH dataset, const HeightRaster& raster) {
    MapRectangle bounds;
    for (const double column : {-0.5, raster.columns - 0.5}) {
        for (const double row : {-0.5, raster.rows - 0.5}) { bounds.add(raster.map->at(column, row)); }
    }
    DegreeSigns signs;
    signs.cell = raster.map->steps();
    signs.extent = bounds.size();
    const glm::dvec2 furthest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    signs.furthest = std::max(furthest.x, furthest.y);
    // Outer edges of cells may lie behind a pole.
    const double edge_deg = std::clamp(signs.cell.y, 1.0, 5.0);
    signs.fit = bounds.min.x >= -360.0 - edge_deg && bounds.max.x <= 360.0 + edge_deg &&
                bounds.min.y >= -90.0 - edge_deg && bounds.max.y <= 90.0 + edge_deg &&
                signs.extent.x <= 360.0 + edge_deg;
    signs.by_name = has_cf_degrees(dataset);
    return signs;
}

void note(const path& file, HeightRaster& raster, std::string_view text) {
    raster.notes.push_back({fmt::format("{}: {}", file.filename().string(), text)});
}

SpatialReference wgs84_system() { return coordinate_system_from_name("EPSG:4326"); }

/// The system of a raster that names none: degrees are taken for WGS 84, all else for metres. Throws Error where either
/// may be meant.
SpatialReference assumed_system(const path& file, GDALDatasetH dataset, HeightRaster& raster) {
    constexpr double widest_deg = 9.0; // 1000 km; more would not be read
    const DegreeSigns signs = degree_signs(dataset, raster);
    if (!signs.fit) { return nullptr; }
    const bool is_world = signs.extent.x > 170.0 && signs.extent.y > 85.0;
    const bool is_small = std::max(signs.extent.x, signs.extent.y) <= widest_deg;
    if (signs.by_name || (signs.is_fine() && is_small)) {
        note(file, raster,
            fmt::format("no coordinate system is named, {}: taken as longitude and latitude on WGS 84; "
                        "--terrain-system names another one, or metres",
                signs.by_name ? "axes are in degrees"
                              : fmt::format("cells of {:.6g} look like degrees", signs.cell.x)));
        return wgs84_system();
    }
    if (signs.is_fine() || is_world) {
        throw_error_in(file, fmt::format("expected a coordinate system, got none and cells of {:g}, which are degrees "
                                         "or metres: --terrain-system EPSG:4326 or --terrain-system metres says which",
                                 signs.cell.x));
    }
    constexpr double coarsest_deg = 10.0;
    if (std::max(signs.cell.x, signs.cell.y) <= coarsest_deg) {
        note(file, raster,
            fmt::format("no coordinate system is named, and cells of {:g} may be degrees: taken as metres; "
                        "--terrain-system EPSG:4326 takes them as degrees",
                signs.cell.x));
    }
    return nullptr;
}

/// Throws Error where a geographic system does not fit the coordinates.
void check_degrees(const path& file, GDALDatasetH dataset, const HeightRaster& raster) {
    const SpatialReferenceHandle system = raster.system.get();
    if (system == nullptr || OSRIsGeographic(system) == 0) { return; }
    const DegreeSigns signs = degree_signs(dataset, raster);
    if (!signs.fit) {
        const bool is_own = GDALGetSpatialRef(dataset) != nullptr;
        throw_error_in(
            file, fmt::format("expected longitudes and latitudes, as {} says, got coordinates up to {:.10g}{}",
                      is_own ? "the system of the file" : "--terrain-system", signs.furthest,
                      is_own ? "" : ": --terrain-system takes a system in metres, or the word metres"));
    }
}

/// Whether a geographic system of the Earth leaves its datum open.
bool has_unnamed_datum(SpatialReferenceHandle system) {
    const char* const datum = OSRGetAttrValue(system, "DATUM", 0);
    std::string name = lower_case(datum == nullptr ? "" : datum);
    std::ranges::replace(name, '_', ' ');
    constexpr std::array<std::string_view, 4> open = {"unknown", "not specified", "unnamed", "undefined"};
    const bool is_open = name.empty() || std::ranges::any_of(open, [&](std::string_view word) {
        return name.find(word) != std::string::npos;
    });
    const double radius_m = OSRGetSemiMajor(system, nullptr);
    return is_open && radius_m > 6.3e6 && radius_m < 6.4e6;
}

/// Whether a system that should count lengths, a local one or a projection, counts degrees.
bool has_degrees_for_lengths(SpatialReferenceHandle system) {
    constexpr double degree = std::numbers::pi / 180.0; // no unit of length is so many metres
    return (OSRIsLocal(system) != 0 || OSRIsProjected(system) != 0) &&
           std::abs(OSRGetLinearUnits(system, nullptr) - degree) < 1e-9;
}

/// The coordinate system of a raster that has a map. Null where lengths are metres.
SpatialReference system_of_raster(
    const path& file, GDALDatasetH dataset, const ImportOptions& options, HeightRaster& raster) {
    const SpatialReferenceHandle own = GDALGetSpatialRef(dataset);
    if (own == nullptr && options.system) {
        return *options.system == local_metres_name ? nullptr : coordinate_system_from_name(*options.system);
    }
    if (own == nullptr) { return assumed_system(file, dataset, raster); }
    if (options.system) { note(file, raster, "--terrain-system ignored: the file names its own system"); }
    if (has_degrees_for_lengths(own) || (OSRIsGeographic(own) != 0 && has_unnamed_datum(own))) {
        note(file, raster, "degrees on a datum that is not named are taken as WGS 84");
        return wgs84_system();
    }
    return spatial_reference_of(own);
}

/// Checks the words of a text grid and takes those that stand for no data.
void take_text(const path& file, const std::string& driver, HeightRaster& raster) {
    raster.text_voids = check_text_grid(file, driver, raster.columns, raster.rows);
    const TextVoids& found = raster.text_voids;
    if (found.declares_no_number) { raster.no_data.reset(); }
    if (found.samples > 0) {
        note(file, raster,
            fmt::format("{} sample{} with a word such as '{}' count as missing", found.samples,
                found.samples == 1 ? "" : "s", found.word));
    }
    if (found.numbers_left > 0) {
        note(file, raster,
            fmt::format("{} extra number{} after the last height ignored; a row may be too long, which shifts all rows "
                        "below it",
                found.numbers_left, found.numbers_left == 1 ? "" : "s"));
    }
}

/// The first height that a few lines of the raster have, as the file says it; nothing where they are empty.
std::optional<double> some_height_m(const path& file, const HeightRaster& raster, const GdalSession& gdal) {
    std::vector<double> line(static_cast<std::size_t>(raster.columns));
    for (const int eighth : {4, 2, 6, 1, 7}) {
        const GridWindow window{0, raster.columns, raster.rows * eighth / 8, 1};
        read_raw_line(file, raster, window, line, gdal);
        for (const double raw : line) {
            if (!std::isnan(raw) && !is_common_void_value(raw)) { return height_of(raw, raster); }
        }
    }
    return std::nullopt;
}

/// Planetary archives often have heights as distances from the centre: these become heights above the equator's radius.
/// All ground of a planet lies within max_height_other_body_m of that.
void take_distances(const path& file, HeightRaster& raster, const GdalSession& gdal) {
    const double radius_m = raster.ellipsoid.semi_major_m;
    if (raster.ellipsoid.is_earth() || radius_m < 4.0 * max_height_other_body_m) { return; }
    const auto height_m = some_height_m(file, raster, gdal);
    if (height_m && std::abs(*height_m - radius_m) <= max_height_other_body_m) {
        raster.offset_m -= radius_m;
        note(file, raster,
            fmt::format("heights count from the centre of {}; {} m are taken off them", name_of_body(raster.ellipsoid),
                radius_m));
    }
}

/// Some drivers read zeros where a file of plain numbers ends too soon.
void check_whole(const path& file, GDALDatasetH dataset) {
    const bool tells_itself = std::string_view(GDALGetDriverShortName(GDALGetDatasetDriver(dataset))) == "GTiff";
    const std::string cut_short = tells_itself ? std::string() : truncation_error(file, dataset);
    if (!cut_short.empty()) { throw_unreadable(file, "a height field", cut_short); }
}

/// Stands for no data where the source declares none; read_height_field takes it so, too.
constexpr double usual_no_data = -32768.0;

/// A list of one, which GDAL frees.
template <typename Number>
Number* list_of(Number value) {
    void* const memory = CPLMalloc(sizeof(Number));
    return new (memory) Number(value);
}

/// A band of a raster that is placed by ground control points alone, laid by GDAL on a grid of their coordinate system
/// (bilinear; no data where it has none). The source must outlive the grid. Null for any other raster. Throws Error for
/// points that no grid fits.
Dataset grid_by_control_points(const path& file, void* source, int band, const GdalSession& gdal) {
    std::array<double, 6> transform = {};
    const int points = GDALGetGCPCount(source);
    if (points == 0 || GDALGetRasterCount(source) == 0 || GDALGetGeoTransform(source, transform.data()) == CE_None) {
        return nullptr;
    }
    int declared = 0;
    const double value = GDALGetRasterNoDataValue(GDALGetRasterBand(source, band), &declared);
    const std::unique_ptr<GDALWarpOptions, void (*)(GDALWarpOptions*)> options(
        GDALCreateWarpOptions(), [](GDALWarpOptions* own) { GDALDestroyWarpOptions(own); });
    options->nBandCount = 1;
    options->panSrcBands = list_of(band);
    options->panDstBands = list_of(1);
    options->padfDstNoDataReal = list_of(declared != 0 ? value : usual_no_data);
    if (declared != 0) { options->padfSrcNoDataReal = list_of(value); }
    constexpr double exact = 0.0;
    const char* const system = GDALGetGCPProjection(source);
    Dataset grid(GDALAutoCreateWarpedVRT(source, system, system, GRA_Bilinear, exact, options.get()));
    if (!grid) {
        throw_error_in(
            file, fmt::format("expected control points that a grid fits, got {}: {}", points, gdal.reason(file)));
    }
    return grid;
}

/// Whether heights count from the ellipsoid and not from the sea, as the system says.
bool is_ellipsoidal(SpatialReferenceHandle system) {
    const char* const datum = OSRGetAttrValue(system, "VERT_DATUM", 0);
    return datum == nullptr ? OSRGetAxesCount(system) == 3
                            : std::string_view(datum).find("llipsoid") != std::string_view::npos;
}

void note_ellipsoid(const path& file, HeightRaster& raster) {
    if (raster.system && raster.ellipsoid.is_earth() && is_ellipsoidal(raster.system.get())) {
        note(file, raster,
            "heights count from the ellipsoid, and the sea lies up to 100 m above or below it: "
            "--ground-look water-level=METRES says where");
    }
}

} // namespace

bool is_same_raw(double raw, double mark) {
    constexpr double float_rounding = 0x1p-24; // as people write fewer digits than a file has
    return std::abs(raw - mark) <= std::abs(mark) * float_rounding;
}

void check_height(const path& file, double height_m, double raw, bool declares_unit, const Ellipsoid& ellipsoid) {
    if (!is_believed(height_m, ellipsoid)) {
        const glm::dvec2 range_m = believed_m(ellipsoid);
        throw_error_in(
            file, fmt::format("expected heights from {:g} to {:g} m, got {:.7g} m: {}--void {} treats it as missing",
                      range_m.x, range_m.y, height_m,
                      declares_unit ? "" : "--height-scale says how many metres a unit is, ", raw_text(raw)));
    }
}

HeightRaster open_height_raster(const path& file, const ImportOptions& options, GdalSession& gdal) {
    HeightRaster raster;
    ImportOptions own = options;
    std::vector<MapNote> notes;
    raster.datasets.push_back(open_raster_file(file, gdal, own.band, notes));
    check_whole(file, raster.datasets.back().get());
    static_cast<HeightBand&>(raster) = height_band_of(file, raster.datasets.back().get(), own);
    raster.notes.insert(raster.notes.begin(), notes.begin(), notes.end());
    if (raster.decoded) { raster.datasets.push_back(std::move(raster.decoded)); }
    raster.user_void_values = options.voids.values;
    if (options.voids.only) {
        raster.no_data.reset();
        raster.undeclared.emplace(); // nothing is searched for
    }
    if (Dataset grid = grid_by_control_points(file, raster.datasets.back().get(), raster.number, gdal)) {
        raster.datasets.push_back(std::move(grid));
        raster.band = GDALGetRasterBand(raster.datasets.back().get(), 1);
        raster.mask = nullptr;
        raster.no_data = declared_no_data(raster.band);
    }
    GDALDatasetH dataset = raster.datasets.back().get();
    raster.columns = GDALGetRasterXSize(dataset);
    raster.rows = GDALGetRasterYSize(dataset);
    if (const auto transform = transform_of(file, dataset)) {
        take_transform(*transform, raster);
        raster.system = system_of_raster(file, dataset, options, raster);
        check_degrees(file, dataset, raster);
        raster.ellipsoid = raster.system ? ellipsoid_of(wkt_of(raster.system.get())) : Ellipsoid();
    }
    const GDALDriverH reader = GDALGetDatasetDriver(raster.datasets.front().get());
    const std::string driver = reader == nullptr ? "" : GDALGetDriverShortName(reader);
    if (is_text_grid(driver)) { take_text(file, driver, raster); }
    take_distances(file, raster, gdal);
    note_ellipsoid(file, raster);
    const GDALDataType type = GDALGetRasterDataType(raster.band);
    raster.has_integer_metres = (type == GDT_Byte || type == GDT_Int16) && raster.scale_m == 1.0 &&
                                raster.offset_m == 0.0 && raster.text_voids.samples == 0;
    gdal.forget();
    return raster;
}

std::vector<MapNote> notes_of(const path& file, const HeightRaster& raster) {
    std::vector<MapNote> notes = raster.notes;
    if (raster.undeclared && !raster.undeclared->note.empty()) {
        notes.push_back({file.filename().string() + ": " + raster.undeclared->note});
    }
    return notes;
}

void read_raw(const path& file, const HeightRaster& raster, const GridWindow& window, std::span<double> raw,
    const GdalSession& gdal) {
    const auto columns = static_cast<std::size_t>(window.columns);
    assert(raw.size() == columns * static_cast<std::size_t>(window.rows));
    for (int row = 0; row < window.rows; ++row) {
        const GridWindow one{window.first_column, window.columns, window.first_row + row, 1};
        const auto line = raw.subspan(static_cast<std::size_t>(row) * columns, columns);
        read_raw_line(file, raster, one, line, gdal);
    }
}

void read_heights(const path& file, const HeightRaster& raster, const GridWindow& window, std::span<float> heights_m,
    const GdalSession& gdal) {
    const auto columns = static_cast<std::size_t>(window.columns);
    assert(heights_m.size() == columns * static_cast<std::size_t>(window.rows));
    std::vector<double> line(columns);
    for (int line_in_file = 0; line_in_file < window.rows; ++line_in_file) {
        const int row = raster.first_row_is_south ? line_in_file : window.rows - 1 - line_in_file;
        const GridWindow one{window.first_column, window.columns, window.first_row + row, 1};
        read_raw_line(file, raster, one, line, gdal);
        std::ranges::transform(line, heights_m.begin() + static_cast<std::ptrdiff_t>(row) * window.columns,
            [&](double raw) { return height_from_raw(file, raw, raster, gdal); });
    }
}

} // namespace octant::models::heights
