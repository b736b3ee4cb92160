// Source: membrane (Laplace) interpolation by a coarse-to-fine cascade: heights are averaged to half the resolution
// until no void is left ("pull"), voids then take the coarser level's height ("push", after Gortler et al., The
// Lumigraph, 1996, section 3.4) and are relaxed by Gauss-Seidel. Deviations: a fixed number of sweeps a level instead
// of a residual, so that cost and result are the same everywhere; the rim of the map takes part with the neighbours it
// has.

#include "models/heights/height_voids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace octant::models::heights {

namespace {

/// Distinct numbers that no ground has as a height and that count as voids at most.
constexpr std::size_t max_absurd = 3;

/// Whether a number is one that a person writes: a whole one of up to ten digits or a power of ten. Damaged samples are
/// hardly ever.
bool is_written(double raw) {
    const double size = std::abs(raw);
    return (size < 1e10 && size == std::floor(size)) ||
           static_cast<float>(size) == static_cast<float>(std::pow(10.0, std::round(std::log10(size))));
}

std::string samples_text(std::int64_t samples) { return fmt::format("{} sample{}", samples, samples == 1 ? "" : "s"); }

} // namespace

bool UndeclaredVoids::has(double raw) const {
    return raw >= wraparound_threshold || std::abs(raw) >= undeclared_void_threshold ||
           std::ranges::find(values, raw) != values.end();
}

std::string raw_text(double raw) {
    constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
    const float single = std::abs(raw) <= largest ? static_cast<float>(raw) : 0.0F;
    return static_cast<double>(single) == raw ? fmt::format("{}", single) : fmt::format("{}", raw);
}

bool is_common_void_value(double raw) {
    constexpr std::array<double, 15> usual = {-999.0, -9999.0, -10000.0, -32767.0, -32768.0, -99999.0,
        -100000.0, // black of a Mapbox tile, in tenths of a metre
        9999.0, 99999.0, 32767.0,
        32768.0, // -32768, -10000, -9999 and -1 as unsigned numbers of 16 bits
        55536.0, 55537.0, 65535.0, 4294967295.0};
    const bool is_common_height = raw > -999.0 && raw < 9999.0; // nearly all samples
    return !is_common_height && std::ranges::find(usual, raw) != usual.end();
}

void VoidDetector::count(std::vector<Mark>& marks, double raw, double height_m) {
    const auto found = std::ranges::find(marks, raw, &Mark::raw);
    if (found != marks.end()) {
        ++found->samples;
    } else if (marks.size() <= max_absurd || is_common_void_value(raw)) {
        marks.push_back({raw, height_m, 1});
    } else {
        ++marks.back().samples;
    }
}

/// Whether a number is a negative height that was stored unsigned.
bool VoidDetector::is_wrapped(double raw) const {
    return raw < modulus_ && raw - modulus_ >= lowest_m_ && raw == std::floor(raw);
}

void VoidDetector::add(double raw, double height_m) {
    const bool is_height = height_m >= lowest_m_ && height_m <= highest_m_;
    if (is_common_void_value(raw)) {
        count(usual_, raw, height_m);
    } else if (std::abs(raw) >= undeclared_void_threshold) {
        count(beyond_, raw, height_m);
    } else if (is_height) {
        ++ordinary_;
        min_m_ = std::min(min_m_, height_m);
        max_m_ = std::max(max_m_, height_m);
    } else if (is_wrapped(raw)) {
        wrapped_.raw = wrapped_.samples == 0 ? raw : std::min(wrapped_.raw, raw);
        max_wrapped_ = std::max(max_wrapped_, raw);
        ++wrapped_.samples;
    } else {
        count(absurd_, raw, height_m);
    }
}

double VoidDetector::distance_m(double height_m) const { return std::max({min_m_ - height_m, height_m - max_m_, 0.0}); }

UndeclaredVoids VoidDetector::result() const {
    const bool has_heights = min_m_ <= max_m_;
    const double range_m = has_heights ? max_m_ - min_m_ : 0.0;
    const double near_m = std::max(50.0, 0.02 * range_m);
    const double far_m = std::max(1000.0, 0.5 * range_m);
    UndeclaredVoids voids;
    std::string counts;
    bool may_be_heights = false;
    const auto take = [&](const Mark& mark) {
        voids.values.push_back(mark.raw);
        may_be_heights |= mark.height_m >= lowest_m_ && mark.height_m <= highest_m_;
        counts += fmt::format("{}{} of {}", counts.empty() ? "" : ", ", samples_text(mark.samples), raw_text(mark.raw));
    };
    std::ranges::for_each(beyond_, take);
    for (const Mark& mark : usual_) {
        if (distance_m(mark.height_m) > near_m) { take(mark); }
    }
    std::int64_t absurd = 0;
    for (const Mark& mark : absurd_) { absurd += mark.samples; }
    const bool are_few = absurd_.size() <= 1 || (absurd_.size() <= max_absurd && absurd < ordinary_);
    if (has_heights && are_few) {
        for (const Mark& mark : absurd_) {
            if (distance_m(mark.height_m) > far_m && is_written(mark.raw)) { take(mark); }
        }
    }
    if (has_heights && wrapped_.samples > 0 && absurd_.empty()) {
        voids.wraparound_threshold = wrapped_.raw;
        counts += fmt::format("{}{} from {:.15g} to {:.15g} (negative numbers stored as unsigned ones)",
            counts.empty() ? "" : ", ", samples_text(wrapped_.samples), wrapped_.raw, max_wrapped_);
    }
    if (!counts.empty()) {
        voids.note = fmt::format("{} count as missing, though the file does not say so{}", counts,
            may_be_heights ? "; --void none takes them for heights" : "");
    }
    return voids;
}

namespace {

constexpr int sweeps_a_level = 24;

std::vector<std::size_t> voids_of(const HeightGrid& grid) {
    std::vector<std::size_t> voids;
    for (std::size_t i = 0; i < grid.heights_m.size(); ++i) {
        if (std::isnan(grid.heights_m[i])) { voids.push_back(i); }
    }
    return voids;
}

float mean_of_neighbours(const HeightGrid& grid, int column, int row) {
    double sum = 0.0;
    int count = 0;
    constexpr std::array<std::array<int, 2>, 4> steps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    for (const auto& step : steps) {
        const int x = column + step[0];
        const int y = row + step[1];
        if (x >= 0 && x < grid.columns && y >= 0 && y < grid.rows) {
            sum += grid.at(x, y);
            ++count;
        }
    }
    return static_cast<float>(sum / count);
}

void relax(HeightGrid& grid, const std::vector<std::size_t>& voids) {
    const auto columns = static_cast<std::size_t>(grid.columns);
    for (int sweep = 0; sweep < sweeps_a_level; ++sweep) {
        for (const std::size_t i : voids) {
            grid.heights_m[i] = mean_of_neighbours(grid, static_cast<int>(i % columns), static_cast<int>(i / columns));
        }
    }
}

float from_coarser(const HeightGrid& coarse, int column, int row) {
    if (coarse.columns < 2 || coarse.rows < 2) { return coarse.at(column / 2, row / 2); }
    return interpolated(coarse, (column - 0.5) / 2.0, (row - 0.5) / 2.0);
}

template <typename Guess>
void fill(HeightGrid& grid, const std::vector<std::size_t>& voids, const Guess& guess) {
    const auto columns = static_cast<std::size_t>(grid.columns);
    for (const std::size_t i : voids) {
        grid.heights_m[i] = guess(static_cast<int>(i % columns), static_cast<int>(i / columns));
    }
    relax(grid, voids);
}

} // namespace

long fill_voids(HeightGrid& grid) {
    const std::vector<std::size_t> voids = voids_of(grid);
    if (voids.empty() || voids.size() == grid.heights_m.size()) { return static_cast<long>(voids.size()); }
    HeightGrid coarse =
        block_means(grid.columns, grid.rows, 2, [&](int column, int row) { return grid.at(column, row); });
    fill_voids(coarse);
    fill(grid, voids, [&coarse](int column, int row) { return from_coarser(coarse, column, row); });
    return static_cast<long>(voids.size());
}

long fill_voids_from(HeightGrid& grid, const std::function<float(int, int)>& guess) {
    const std::vector<std::size_t> voids = voids_of(grid);
    fill(grid, voids, guess);
    return static_cast<long>(voids.size());
}

} // namespace octant::models::heights
