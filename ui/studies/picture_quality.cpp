// Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From Error Visibility to Structural
// Similarity", IEEE Trans. Image Processing 13 (4), 2004, equation (13). Deviations: even windows of 7 x 7 instead of a
// bell of 11 x 11, and only what is covered counts.
#include "ui/studies/picture_quality.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace octant::ui::studies {

namespace {

constexpr int reach_px = 3;

/// Sums over windows: pixels, x, y, x^2, y^2, x y.
using Sums = std::array<double, 6>;

void add(Sums& sums, const Sums& more, double sign = 1.0) {
    for (std::size_t k = 0; k < sums.size(); ++k) { sums[k] += sign * more[k]; }
}

Sums sums_of_pixel(double x, double y) { return {1.0, x, y, x * x, y * y, x * y}; }

/// Sums over all pixels above and left of each corner of the pixels.
std::vector<Sums> running_sums(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered) {
    const auto size = static_cast<std::size_t>(picture.size_px);
    std::vector<Sums> sums((size + 1) * (size + 1), Sums{});
    for (std::size_t row = 0; row < size; ++row) {
        Sums of_row{};
        for (std::size_t column = 0; column < size; ++column) {
            const std::size_t at = row * size + column;
            if (covered[at] != 0) { add(of_row, sums_of_pixel(picture.light[at], reference.light[at])); }
            Sums& below = sums[(row + 1) * (size + 1) + column + 1];
            below = sums[row * (size + 1) + column + 1];
            add(below, of_row);
        }
    }
    return sums;
}

double similarity(const Sums& sums) {
    const double small_mean = 0.01 * white_light * 0.01 * white_light;
    const double small_spread = 0.03 * white_light * 0.03 * white_light;
    const double x = sums[1] / sums[0];
    const double y = sums[2] / sums[0];
    const double xx = std::max(sums[3] / sums[0] - x * x, 0.0);
    const double yy = std::max(sums[4] / sums[0] - y * y, 0.0);
    const double xy = sums[5] / sums[0] - x * y;
    return (2.0 * x * y + small_mean) * (2.0 * xy + small_spread) /
           ((x * x + y * y + small_mean) * (xx + yy + small_spread));
}

} // namespace

double mean_square_error(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered) {
    assert(picture.size_px == reference.size_px);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        if (covered[i] != 0) {
            const double error = double{picture.light[i]} - double{reference.light[i]};
            sum += error * error;
            ++count;
        }
    }
    return count > 0.0 ? sum / count : 0.0;
}

double psnr_db(double mean_square) {
    return mean_square > 0.0 ? 10.0 * std::log10(white_light * white_light / mean_square)
                             : std::numeric_limits<double>::infinity();
}

double structural_similarity(
    const LightPicture& picture, const LightPicture& reference, std::span<const std::uint8_t> covered) {
    assert(picture.size_px == reference.size_px);
    const int size = picture.size_px;
    const std::vector<Sums> sums = running_sums(picture, reference, covered);
    const auto sums_at = [&](int row, int column) -> const Sums& {
        return sums[static_cast<std::size_t>(row) * (static_cast<std::size_t>(size) + 1) +
                    static_cast<std::size_t>(column)];
    };
    double total = 0.0;
    double count = 0.0;
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const auto at =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
            if (covered[at] == 0) { continue; }
            const int top = std::max(row - reach_px, 0);
            const int left = std::max(column - reach_px, 0);
            const int bottom = std::min(row + reach_px + 1, size);
            const int right = std::min(column + reach_px + 1, size);
            Sums window = sums_at(bottom, right);
            add(window, sums_at(top, right), -1.0);
            add(window, sums_at(bottom, left), -1.0);
            add(window, sums_at(top, left));
            total += similarity(window);
            ++count;
        }
    }
    return count > 0.0 ? total / count : 1.0;
}

} // namespace octant::ui::studies
