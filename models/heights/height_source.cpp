#include "models/heights/height_source.h"

#include "models/heights/height_field_import.h"
#include "models/heights/height_raster.h"
#include "models/heights/plain_pgm.h"
#include "sim/base/error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <ogr_srs_api.h>
#include <utility>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

constexpr double square_tolerance = 1e-6;
constexpr double scale_tolerance = 0.01;
constexpr double grid_tolerance = 0.01; ///< of a cell: how far off the common grid a file may lie

/// A file and where its south-west sample lies on the common grid.
struct Piece {
    path file;
    OpenRaster raster;
    int column = 0;
    int row = 0;
};

/// The call that makes one file which needs no resampling.
std::string warp_call(const std::vector<path>& files, const std::optional<LocalFrame>& local) {
    std::string system = "EPSG:...";
    std::string spacing = "METRES METRES";
    if (local) {
        const GeoPlace place = local->place();
        const int zone =
            std::clamp(static_cast<int>((place.longitude_deg + 180.0) / 6.0) + 1, 1, 60);
        system = fmt::format("EPSG:{}", (place.latitude_deg < 0.0 ? 32700 : 32600) + zone);
        const double step_m = std::sqrt(local->step_east_m() * local->step_north_m());
        spacing = fmt::format("{0:.6g} {0:.6g}", step_m);
    }
    return fmt::format(
        "gdalwarp -t_srs {} -tr {} -r bilinear {}{} OUT.tif",
        system,
        spacing,
        files.front().filename().string(),
        files.size() > 1 ? " ..." : "");
}

bool is_true_to_scale(const LocalFrame& local, double step_east_m, double step_north_m) {
    return std::abs(local.step_east_m() / step_east_m - 1.0) <= scale_tolerance &&
           std::abs(local.step_north_m() / step_north_m - 1.0) <= scale_tolerance;
}

/// Metres a unit of the coordinate system; nothing for degrees and other systems.
std::optional<double> unit_m_of(const OpenRaster& raster) {
    if (raster.system == nullptr) {
        constexpr double coarsest_degrees = 0.02;
        return raster.frame->step_east < coarsest_degrees ? std::nullopt : std::optional(1.0);
    }
    if (OSRIsProjected(raster.system) == 0 && OSRIsLocal(raster.system) == 0) {
        return std::nullopt;
    }
    return OSRGetLinearUnits(raster.system, nullptr);
}

bool same_system(SystemHandle a, SystemHandle b) {
    return a == nullptr || b == nullptr ? a == b : OSRIsSame(a, b) != 0;
}

} // namespace

struct HeightSource::Content {
    std::vector<path> files;
    std::unique_ptr<GdalSession> gdal;
    std::vector<Piece> pieces;
    std::optional<HeightField> whole; ///< set instead of pieces where one file had to be resampled
    int columns = 0;
    int rows = 0;
    double spacing_m = 0.0;
    std::optional<GeoPlace> place;
    std::optional<MapSystem> system;
    bool whole_metres = true;

    void open(const ImportOptions& options);
    void put_together();
    void settle(const ImportOptions& options);
    void take_whole(const ImportOptions& options, const std::optional<LocalFrame>& local);

    template <typename Height, typename ReadRows>
    void read(int first_row, std::span<Height> heights, Height no_height, const ReadRows& rows_of);
};

void HeightSource::Content::open(const ImportOptions& options) {
    for (const path& file : files) {
        check_local_file(file);
        if (is_plain_pgm(file)) {
            take_whole(options, std::nullopt);
            return;
        }
    }
    gdal = std::make_unique<GdalSession>();
    for (const path& file : files) {
        Piece& piece = pieces.emplace_back();
        piece.file = file;
        piece.raster = open_height_raster(file, options.height_scale, *gdal);
        whole_metres = whole_metres && piece.raster.whole_metres;
        if (files.size() > 1 && !piece.raster.frame) {
            error_in(file, "expected a file that knows its place, beside others, got a picture");
        }
    }
    put_together();
    settle(options);
    if (gdal) {
        gdal->forget(); // a system without a place on the earth is no fault
    }
}

/// Lays all files on the grid of the first and finds how large the ground is.
void HeightSource::Content::put_together() {
    const OpenRaster& first = pieces.front().raster;
    int west = 0;
    int south = 0;
    std::int64_t east = first.columns;
    std::int64_t north = first.rows;
    for (Piece& piece : pieces) {
        const OpenRaster& raster = piece.raster;
        if (!raster.frame) {
            continue;
        }
        const GridFrame& own = *raster.frame;
        const GridFrame& frame = *first.frame;
        if (!same_system(raster.system, first.system)) {
            error_in(
                piece.file,
                fmt::format(
                    "expected the coordinate system of {}, got another",
                    files.front().filename().string()));
        }
        const double column = (own.west - frame.west) / frame.step_east;
        const double row = (own.south - frame.south) / frame.step_north;
        const bool same_step =
            std::abs(own.step_east / frame.step_east - 1.0) <= square_tolerance &&
            std::abs(own.step_north / frame.step_north - 1.0) <= square_tolerance;
        if (!same_step || !(std::abs(column - std::round(column)) <= grid_tolerance) ||
            !(std::abs(row - std::round(row)) <= grid_tolerance) ||
            std::max(std::abs(column), std::abs(row)) > largest_samples) {
            error_in(
                piece.file,
                fmt::format(
                    "expected samples on the grid of {} and at most {} cells from it, got cells of "
                    "{:g} x {:g} at {:.3f}, {:.3f}",
                    files.front().filename().string(),
                    static_cast<int>(largest_samples),
                    own.step_east,
                    own.step_north,
                    column,
                    row));
        }
        piece.column = static_cast<int>(std::lround(column));
        piece.row = static_cast<int>(std::lround(row));
        west = std::min(west, piece.column);
        south = std::min(south, piece.row);
        east = std::max<std::int64_t>(east, std::int64_t{piece.column} + raster.columns);
        north = std::max<std::int64_t>(north, std::int64_t{piece.row} + raster.rows);
    }
    for (Piece& piece : pieces) {
        piece.column -= west;
        piece.row -= south;
    }
    const auto fits = [](std::int64_t n) { return n >= 2 && n <= largest_samples; };
    if (!fits(east - west) || !fits(north - south)) {
        error_in(
            files.front(),
            fmt::format(
                "expected 2 x 2 to {0} x {0} samples, got {1} x {2}",
                static_cast<int>(largest_samples),
                east - west,
                north - south));
    }
    columns = static_cast<int>(east - west);
    rows = static_cast<int>(north - south);
}

/// Finds spacing and place, or that the ground must be resampled.
void HeightSource::Content::settle(const ImportOptions& options) {
    const OpenRaster& first = pieces.front().raster;
    if (!first.frame) {
        spacing_m = options.spacing_m;
        return;
    }
    GridFrame frame = *first.frame;
    frame.west -= pieces.front().column * frame.step_east;
    frame.south -= pieces.front().row * frame.step_north;
    const auto local = first.system == nullptr
                           ? std::nullopt
                           : LocalFrame::around(first.system, frame, columns, rows);
    const auto unit_m = unit_m_of(first);
    const bool square = std::abs(frame.step_east / frame.step_north - 1.0) <= square_tolerance;
    if (!unit_m || !square ||
        (local &&
         !is_true_to_scale(*local, frame.step_east * *unit_m, frame.step_north * *unit_m))) {
        take_whole(options, local);
        return;
    }
    spacing_m = frame.step_east * *unit_m;
    if (local) {
        place = local->place();
    }
    if (first.system != nullptr) {
        system = map_system(first.system, frame, columns, rows);
    }
}

void HeightSource::Content::take_whole(
    const ImportOptions& options, const std::optional<LocalFrame>& local) {
    if (files.size() > 1 || columns > largest_import_samples || rows > largest_import_samples) {
        error_in(
            files.front(),
            "expected square cells in metres to read piece by piece, got others: make them with " +
                warp_call(files, local));
    }
    pieces.clear();
    gdal.reset();
    whole = read_height_field(files.front(), options);
    columns = whole->columns();
    rows = whole->rows();
    spacing_m = whole->spacing_m();
    place = whole->place;
    system = whole->system;
    whole_metres = false;
}

template <typename Height, typename ReadRows>
void HeightSource::Content::read(
    int first_row, std::span<Height> heights, Height no_height, const ReadRows& rows_of) {
    const auto width = static_cast<std::size_t>(columns);
    const int count = static_cast<int>(heights.size() / width);
    assert(heights.size() % width == 0 && first_row >= 0 && first_row + count <= rows);
    const bool alone = pieces.size() == 1;
    if (!alone) {
        std::fill(heights.begin(), heights.end(), no_height);
    }
    std::vector<Height> own;
    for (const Piece& piece : pieces) {
        const int begin = std::max(first_row, piece.row);
        const int end = std::min(first_row + count, piece.row + piece.raster.rows);
        if (begin >= end) {
            continue;
        }
        const RowBand band{begin - piece.row, end - begin};
        if (alone) {
            rows_of(piece, band, heights);
            continue;
        }
        const auto own_width = static_cast<std::size_t>(piece.raster.columns);
        own.resize(own_width * static_cast<std::size_t>(band.count));
        rows_of(piece, band, std::span<Height>(own));
        for (int row = begin; row < end; ++row) {
            const Height* const from = &own[static_cast<std::size_t>(row - begin) * own_width];
            Height* const to = &heights
                                   [static_cast<std::size_t>(row - first_row) * width +
                                    static_cast<std::size_t>(piece.column)];
            for (std::size_t x = 0; x < own_width; ++x) {
                const bool free = to[x] == no_height || to[x] != to[x];
                to[x] = free ? from[x] : to[x];
            }
        }
    }
}

HeightSource::HeightSource(std::vector<path> files, const ImportOptions& options)
    : content_(std::make_unique<Content>()) {
    assert(!files.empty());
    content_->files = std::move(files);
    content_->open(options);
}

HeightSource::~HeightSource() = default;

int HeightSource::columns() const {
    return content_->columns;
}

int HeightSource::rows() const {
    return content_->rows;
}

double HeightSource::spacing_m() const {
    return content_->spacing_m;
}

std::optional<GeoPlace> HeightSource::place() const {
    return content_->place;
}

std::optional<MapSystem> HeightSource::system() const {
    return content_->system;
}

std::string HeightSource::name() const {
    const std::string first = content_->files.front().filename().string();
    const std::size_t more = content_->files.size() - 1;
    return more == 0 ? first : fmt::format("{} and {} more", first, more);
}

std::int64_t HeightSource::filled_voids() const {
    return content_->whole ? content_->whole->filled_voids : 0;
}

bool HeightSource::whole_metres() const {
    return content_->whole_metres;
}

void HeightSource::read(int first_row, std::span<float> heights_m) {
    if (content_->whole) {
        const int columns = content_->columns;
        for (std::size_t i = 0; i < heights_m.size(); ++i) {
            const auto width = static_cast<std::size_t>(columns);
            heights_m[i] = content_->whole->height_m(
                static_cast<int>(i % width), first_row + static_cast<int>(i / width));
        }
        return;
    }
    content_->read(
        first_row,
        heights_m,
        std::numeric_limits<float>::quiet_NaN(),
        [this](const Piece& piece, RowBand band, std::span<float> heights) {
            read_heights(piece.file, piece.raster, band, heights, *content_->gdal);
        });
}

void HeightSource::read(int first_row, std::span<std::int16_t> heights_m) {
    assert(whole_metres());
    content_->read(
        first_row,
        heights_m,
        void_metres,
        [this](const Piece& piece, RowBand band, std::span<std::int16_t> heights) {
            read_whole_metres(piece.file, piece.raster, band, heights, *content_->gdal);
        });
}

} // namespace octant::models::heights
