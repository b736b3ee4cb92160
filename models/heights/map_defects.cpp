#include "models/heights/map_defects.h"

#include "models/heights/local_frame.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace octant::models::heights {

namespace {

constexpr double relief_at_1_m = 20.0;
constexpr double relief_exponent = 0.58;
constexpr float pit_share = 0.6F;   ///< of that relief, for pits
constexpr int sharp_reach = 4;      ///< the widest ring for which that relief itself is the limit
constexpr double wide_factor = 3.0; ///< for wider rings: mesas and stacks are as wide
/// The share of a ring that has heights, at least, of its samples within the map.
constexpr double ring_share = 0.6;
constexpr int min_ring = 3; ///< samples of a ring with heights, at least

} // namespace

SpikeFinder::SpikeFinder(int columns, int rows, double spacing_m)
    : columns_(columns), rows_(rows), relief_m_{}, band_(static_cast<std::size_t>(columns) * (2 * reach + 1)) {
    for (int k = 1; k <= reach; ++k) {
        const double sure = k > sharp_reach ? wide_factor : 1.0;
        relief_m_[static_cast<std::size_t>(k)] =
            static_cast<float>(sure * relief_at_1_m * std::pow(k * spacing_m, relief_exponent));
    }
}

float SpikeFinder::at(int column, int row) const {
    const auto line = static_cast<std::size_t>(row % (2 * reach + 1));
    return band_[line * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)];
}

void SpikeFinder::take(int first_row, std::span<const float> heights_m) {
    if (first_row != end_row_) {
        begin_row_ = end_row_ = first_row;
        found_.clear();
        count_ = 0;
    }
    const auto width = static_cast<std::size_t>(columns_);
    for (; !heights_m.empty(); heights_m = heights_m.subspan(width)) {
        const auto line = static_cast<std::size_t>(end_row_ % (2 * reach + 1));
        std::copy_n(heights_m.begin(), width, band_.begin() + static_cast<std::ptrdiff_t>(line * width));
        ++end_row_;
        if (end_row_ - begin_row_ > reach) { check_row_of_samples(end_row_ - 1 - reach); }
    }
    if (end_row_ == rows_) {
        for (int row = std::max(begin_row_, rows_ - reach); row < rows_; ++row) { check_row_of_samples(row); }
    }
}

void SpikeFinder::check_row_of_samples(int row) {
    // Quick: few samples differ so much from others of their row, and lie beyond both neighbours.
    const float min_m = pit_share * relief_m_[1];
    const auto width = static_cast<std::size_t>(columns_);
    const auto line = std::span(band_).subspan(static_cast<std::size_t>(row % (2 * reach + 1)) * width, width);
    for (std::size_t x = 0; x < width; ++x) {
        const float height_m = line[x];
        const float west_m = line[x == 0 ? 1 : x - 1];
        const float east_m = line[x + 1 < width ? x + 1 : x - 1];
        const float far_m = line[x < reach ? std::min(x + reach, width - 1) : x - reach];
        const bool is_alike = std::abs(height_m - west_m) <= min_m && std::abs(height_m - far_m) <= min_m;
        const bool is_between = (west_m < height_m && height_m < east_m) || (west_m > height_m && height_m > east_m);
        if (!is_alike && !is_between && !std::isnan(height_m)) { // neighbours may be voids
            check_sample(static_cast<int>(x), row);
        }
    }
}

void SpikeFinder::add(const Spike& spike) {
    for (Spike& known : found_) {
        const int apart = std::max(std::abs(known.column - spike.column), std::abs(known.row - spike.row));
        if (apart < reach && std::signbit(known.above_m) == std::signbit(spike.above_m)) {
            const bool is_further = std::abs(spike.above_m) > std::abs(known.above_m);
            const int radius = std::max({known.radius, spike.radius, apart});
            known = is_further ? spike : known;
            known.radius = radius;
            return;
        }
    }
    ++count_;
    if (found_.size() < max_listed_spikes) { found_.push_back(spike); }
}

void SpikeFinder::check_sample(int column, int row) {
    const float height_m = at(column, row);
    for (int k = 1; k <= reach; ++k) {
        float lowest_m = std::numeric_limits<float>::infinity();
        float highest_m = -lowest_m;
        int known = 0;
        int within = 0;
        const auto look = [&](int x, int y) {
            const bool inside = x >= 0 && x < columns_ && y >= begin_row_ && y < end_row_;
            within += inside ? 1 : 0;
            const float there_m = inside ? at(x, y) : std::numeric_limits<float>::quiet_NaN();
            if (!std::isnan(there_m)) {
                lowest_m = std::min(lowest_m, there_m);
                highest_m = std::max(highest_m, there_m);
                ++known;
            }
        };
        for (int i = -k; i < k; ++i) { // once round
            look(column + i, row - k);
            look(column + k, row + i);
            look(column - i, row + k);
            look(column - k, row - i);
        }
        // One sample of a wider spike stands for all of it.
        if (k == 1 && height_m < highest_m && height_m > lowest_m) { return; }
        const bool is_spike = height_m > highest_m;
        const float gap_m = is_spike ? height_m - highest_m : lowest_m - height_m;
        const float min_m = relief_m_[static_cast<std::size_t>(k)] * (is_spike ? 1.0F : pit_share);
        if (known >= std::max<double>(min_ring, ring_share * within) && gap_m > min_m) {
            add({column, row, height_m, is_spike ? gap_m : -gap_m, k - 1});
            return;
        }
    }
}

namespace {

/// Samples on each side of a seam.
constexpr int depth = 2;
/// Points along a seam that are looked at.
constexpr int max_points = 1024;
constexpr std::size_t min_points = 8;

/// A side of a file: from its first sample along it, and outwards.
struct Side {
    int column = 0;
    int row = 0;
    int along_column = 0; ///< step along the side
    int along_row = 0;
    int samples = 0;
    int out_column = 0; ///< step outwards
    int out_row = 0;
};

std::array<Side, 4> sides_of(const SourcePiece& piece) {
    const int east = piece.raster.columns - 1;
    const int north = piece.raster.rows - 1;
    return {Side{0, 0, 0, 1, north + 1, -1, 0}, Side{east, 0, 0, 1, north + 1, 1, 0}, Side{0, 0, 1, 0, east + 1, 0, -1},
        Side{0, north, 1, 0, east + 1, 0, 1}};
}

/// A file on its grid.
struct Placed {
    const SourceGrid* grid = nullptr;
    const SourcePiece* piece = nullptr;
    MapRectangle around; ///< with a border, in the frame that all grids look from
};

Placed placed(const SourceGrid& grid, const SourcePiece& piece) {
    Placed result{&grid, &piece, {}};
    constexpr int parts = 4; // of an edge, which may be curved in the frame
    for (int i = 0; i <= parts; ++i) {
        for (int j = 0; j <= parts; ++j) {
            glm::dvec2 at = glm::dvec2(i, j) / static_cast<double>(parts) *
                            glm::dvec2(piece.raster.columns - 1, piece.raster.rows - 1);
            at += glm::dvec2(piece.column, piece.row);
            grid.frame_from_grid({&at.x, 1}, {&at.y, 1});
            result.around.add(at);
        }
    }
    const glm::dvec2 cells(piece.raster.columns - 1, piece.raster.rows - 1);
    const glm::dvec2 border = result.around.size() * (0.02 + static_cast<double>(depth + 1) / cells);
    result.around.min -= border;
    result.around.max += border;
    return result;
}

bool may_meet(const Placed& a, const Placed& b) {
    return glm::all(glm::lessThanEqual(a.around.min, b.around.max)) &&
           glm::all(glm::lessThanEqual(b.around.min, a.around.max));
}

/// Heights of files at single places.
class Reader {
public:
    explicit Reader(const GdalSession& gdal) : gdal_(gdal) {}

    /// Bilinear at a column and row of the piece, its own height at a sample; nothing outside it and beside voids.
    std::optional<double> at(const SourcePiece& piece, const glm::dvec2& column_row) const {
        constexpr double at_sample = 1e-3;
        const glm::dvec2 low = glm::floor(column_row + at_sample);
        const glm::dvec2 share = glm::max(column_row - low, 0.0);
        const glm::ivec2 first(low);
        const glm::ivec2 count(share.x > at_sample ? 2 : 1, share.y > at_sample ? 2 : 1);
        if (first.x < 0 || first.y < 0 || first.x + count.x > piece.raster.columns ||
            first.y + count.y > piece.raster.rows) {
            return std::nullopt;
        }
        std::array<float, 4> heights_m = {};
        const auto samples = static_cast<std::size_t>(count.x * count.y);
        read_heights(
            piece.file, piece.raster, {first.x, count.x, first.y, count.y}, std::span(heights_m).first(samples), gdal_);
        const auto sample = [&](int x, int y) {
            return static_cast<double>(
                heights_m.at(static_cast<std::size_t>(std::min(y, count.y - 1) * count.x + std::min(x, count.x - 1))));
        };
        const double height_m = bilinear(sample(0, 0), sample(1, 0), sample(0, 1), sample(1, 1), share);
        return std::isnan(height_m) ? std::nullopt : std::optional(height_m);
    }

private:
    const GdalSession& gdal_;
};

/// A place on a file's grid, by column and row, as one on another file.
std::optional<glm::dvec2> on_piece(const Placed& from, const Placed& to, glm::dvec2 at) {
    const glm::dvec2 begin(to.piece->column, to.piece->row);
    if (from.grid != to.grid) {
        from.grid->frame_from_grid({&at.x, 1}, {&at.y, 1});
        to.grid->grid_from_frame({&at.x, 1}, {&at.y, 1});
    }
    at -= begin;
    const bool inside =
        at.x >= 0.0 && at.y >= 0.0 && at.x <= to.piece->raster.columns - 1.0 && at.y <= to.piece->raster.rows - 1.0;
    return inside ? std::optional(at) : std::nullopt;
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The standard error of the median of normally distributed values, by their median distance from it, which outliers do
/// not change.
double error_of_median(std::vector<double> values, double median) {
    constexpr double error_of_mean_distance = 1.2533 * 1.4826;
    for (double& value : values) { value = std::abs(value - median); }
    const double root = std::sqrt(static_cast<double>(values.size()));
    return error_of_mean_distance * median_of(std::move(values)) / root;
}

/// What is measured at the points of a seam.
struct Measured {
    std::vector<double> rises_m;
    std::vector<double> steps_m;
    std::vector<glm::dvec2> column_row;
};

/// Whether the side of `a` is seen at a point: what lies behind it belongs to `b` alone, or `a` comes first.
bool is_seen(const Placed& a, const Placed& b, bool a_is_first, const glm::dvec2& edge) {
    return a_is_first || !on_piece(a, b, edge);
}

Measured measured(const Placed& a, const Placed& b, const Side& side, bool a_is_first, const Reader& read) {
    Measured found;
    const int points = std::min(side.samples, max_points);
    for (int i = 0; i < points; ++i) {
        const int along = points == 1 ? 0 : (side.samples - 1) * i / (points - 1);
        const glm::dvec2 edge(side.column + along * side.along_column, side.row + along * side.along_row);
        const glm::dvec2 out(side.out_column, side.out_row);
        const glm::dvec2 begin(a.piece->column, a.piece->row);
        std::array<double, 2 * depth> heights_m = {};
        bool is_known = on_piece(a, b, begin + edge + static_cast<double>(depth) * out) &&
                        on_piece(a, b, begin + edge + out) && is_seen(a, b, a_is_first, begin + edge);
        for (int j = 0; is_known && j < 2 * depth; ++j) {
            const glm::dvec2 at = edge + static_cast<double>(j - depth + 1) * out;
            const auto there = j < depth ? std::optional(at) : on_piece(a, b, begin + at);
            const auto height_m = there ? read.at(j < depth ? *a.piece : *b.piece, *there) : std::nullopt;
            is_known = height_m.has_value();
            heights_m.at(static_cast<std::size_t>(j)) = height_m.value_or(0.0);
        }
        if (is_known) {
            const double rise_m = heights_m[2] - heights_m[1];
            found.rises_m.push_back(rise_m);
            found.steps_m.push_back(1.5 * rise_m - 0.5 * (heights_m[3] - heights_m[0]));
            found.column_row.push_back(begin + edge + 0.5 * out);
        }
    }
    return found;
}

/// Nothing where the ground runs on smoothly enough. `cell_m`: of the finer ground.
std::optional<SeamStep> step_of(const Placed& a, const Placed& b, Measured at, double cell_m) {
    if (at.steps_m.size() < min_points) { return std::nullopt; }
    constexpr double sure = 6.0; // standard errors
    const double step_m = median_of(at.steps_m);
    const double min_m = std::max(1.0, 0.01 * cell_m);
    if (std::abs(step_m) < std::max(min_m, sure * error_of_median(at.steps_m, step_m))) { return std::nullopt; }
    return SeamStep{a.piece, b.piece, median_of(at.rises_m), step_m, std::move(at.column_row), a.grid};
}

} // namespace

std::vector<SeamStep> steps_at_seams(const std::vector<SourceGrid>& grids, double cell_m, const GdalSession& gdal) {
    if (grids.size() == 1 && grids.front().pieces().size() == 1) {
        return {}; // which may have no place
    }
    std::vector<Placed> pieces; // in their order
    for (const SourceGrid& grid : grids) {
        for (const SourcePiece& piece : grid.pieces()) { pieces.push_back(placed(grid, piece)); }
    }
    const Reader read(gdal);
    std::vector<SeamStep> found;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t j = 0; j < pieces.size(); ++j) {
            const Placed& a = pieces[i];
            const Placed& b = pieces[j];
            if (i == j || !may_meet(a, b)) { continue; }
            for (const Side& side : sides_of(*a.piece)) {
                auto step = step_of(a, b, measured(a, b, side, i < j, read), cell_m);
                const bool is_known = std::ranges::any_of(
                    found, [&](const SeamStep& each) { return each.a == b.piece && each.b == a.piece; });
                if (step && !is_known) { found.push_back(std::move(*step)); }
            }
        }
    }
    return found;
}

} // namespace octant::models::heights
