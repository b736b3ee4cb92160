#pragma once

#include "models/heights/height_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace octant::models::heights {

/// Raw numbers of a band that mean "no data" although the file does not declare them.
struct UndeclaredVoids {
    std::vector<double> values;
    /// Unsigned numbers from here on are wrapped negative numbers, which also mean "no data".
    double wraparound_threshold = std::numeric_limits<double>::infinity();
    std::string note; ///< number of samples and values; empty without any

    bool has(double raw) const;
};

/// Numbers of at least this magnitude, such as -FLT_MAX, are no heights in any unit.
inline constexpr double undeclared_void_threshold = 1e30;

/// The shortest text that --void reads as this stored number.
std::string raw_text(double raw);

/// Whether software commonly writes this number for "no data", such as -9999.
bool is_common_void_value(double raw);

/// Decides from all samples of a band which undeclared numbers mean "no data":
/// - a common number (is_common_void_value) that is far from all other heights; deep-sea maps have true heights of
///   -9999 m;
/// - numbers outside the plausible heights, if there is one of them, or if there are up to three that have fewer
///   samples than heights, are far from all heights and are whole or a power of ten; more are heights in an unknown
///   unit;
/// - negative heights stored in unsigned numbers;
/// - all numbers from undeclared_void_threshold on.
class VoidDetector {
public:
    /// `modulus`: 2^bits of the unsigned type in which samples are or were stored.
    VoidDetector(double lowest_m, double highest_m, double modulus)
        : lowest_m_(lowest_m), highest_m_(highest_m), modulus_(modulus) {}

    /// Adds a sample that the file does not declare as without data.
    void add(double raw, double height_m);

    UndeclaredVoids result() const;

private:
    struct Mark {
        double raw = 0.0;
        double height_m = 0.0;
        std::int64_t samples = 0;
    };

    static void count(std::vector<Mark>& marks, double raw, double height_m);
    bool is_wrapped(double raw) const;
    /// The distance of a height from the range of ordinary heights; 0 within, infinite without any.
    double distance_m(double height_m) const;

    double lowest_m_;
    double highest_m_;
    double modulus_;
    std::int64_t ordinary_ = 0; ///< number of samples that are heights and no common void values
    double min_m_ = std::numeric_limits<double>::infinity(); ///< range of ordinary samples
    double max_m_ = -std::numeric_limits<double>::infinity();
    std::vector<Mark> usual_;
    std::vector<Mark> absurd_; ///< at most max_absurd + 1
    std::vector<Mark> beyond_; ///< at most max_absurd + 1; the last stands for all others
    Mark wrapped_;             ///< the smallest of them, and their number
    double max_wrapped_ = 0.0;
};

/// A coarser grid: the means of the known samples of blocks of `edge` x `edge` samples, NaN for blocks without any.
/// `height_at(column, row)` gives a sample of the grid of `columns` x `rows`, NaN without data.
template <typename HeightAt>
HeightGrid block_means(int columns, int rows, int edge, const HeightAt& height_at) {
    HeightGrid means{(columns + edge - 1) / edge, (rows + edge - 1) / edge, {}};
    means.heights_m.reserve(static_cast<std::size_t>(means.columns) * static_cast<std::size_t>(means.rows));
    for (int south = 0; south < rows; south += edge) {
        for (int west = 0; west < columns; west += edge) {
            double sum = 0.0;
            int known = 0;
            for (int row = south; row < std::min(south + edge, rows); ++row) {
                for (int column = west; column < std::min(west + edge, columns); ++column) {
                    const float height = height_at(column, row);
                    sum += std::isnan(height) ? 0.0 : static_cast<double>(height);
                    known += std::isnan(height) ? 0 : 1;
                }
            }
            means.heights_m.push_back(
                known == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(sum / known));
        }
    }
    return means;
}

/// Gives each NaN sample a height that interpolates the border of its void smoothly (a membrane). Returns the number of
/// such samples. Known samples stay as they are. A grid without known samples stays unchanged. Needs temporary memory
/// of a third of the grid and 8 bytes a void; none without voids.
long fill_voids(HeightGrid& grid);

/// Fills a piece of a larger grid: `guess` gives the approximate height of a void by its column and row, such as that
/// of a coarser grid.
long fill_voids_from(HeightGrid& grid, const std::function<float(int, int)>& guess);

} // namespace octant::models::heights
