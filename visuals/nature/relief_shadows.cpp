// Shadows by a sweep away from the sun: the height below which a place is in shadow is that of the place a step nearer
// to the sun, or of its shadow, less what the sun's rays fall on the way. The light in hollows by how far a place lies
// below the mean of ever wider surroundings.
#include "visuals/nature/relief_shadows.h"

#include "sim/base/thread_pool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace octant::visuals::nature {

namespace {

constexpr int max_steps = 1024;   ///< along a side
constexpr double min_fall = 0.01; ///< of the sun's rays, metres a metre: a sun of half a degree
constexpr double softness_m = 2.0;
constexpr double soft_steps = 2.0; ///< over which a shadow's edge is soft along the sun's way
constexpr int min_surrounding = 2; ///< half its width, in steps; each next is twice as wide
constexpr int surroundings = 5;
constexpr double lost_a_slope = 0.85;
constexpr double min_sky = 0.35;

/// Heights of the reduced grid, row after row from the south.
struct Grid {
    int columns = 0;
    int rows = 0;
    double step_m = 1.0;
    std::vector<float> height_m;

    float at(int column, int row) const {
        return height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(column)];
    }
};

Grid reduced(const terrain::GroundSamples& ground) {
    int stride = 1;
    while ((std::max(ground.columns(), ground.rows()) - 1) / stride > max_steps) { stride *= 2; }
    Grid grid{(ground.columns() - 1) / stride + 1, (ground.rows() - 1) / stride + 1, stride * ground.spacing_m(), {}};
    grid.height_m.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
    parallel_for_rows(grid.rows, [&](int row) {
        const auto columns = static_cast<std::size_t>(grid.columns);
        const std::span<float> of_row =
            std::span(grid.height_m).subspan(static_cast<std::size_t>(row) * columns, columns);
        if (stride == 1) {
            ground.copy_row(row, of_row);
            return;
        }
        for (int column = 0; column < grid.columns; ++column) {
            of_row[static_cast<std::size_t>(column)] =
                static_cast<float>(ground.height_m(column * stride, row * stride));
        }
    });
    return grid;
}

/// One line of places across the sun's way, and the next one farther from the sun.
class Sweep {
public:
    Sweep(const Grid& grid, const glm::dvec3& to_sun)
        : grid_(grid), by_columns_(std::abs(to_sun.x) >= std::abs(to_sun.y)),
          lines_(by_columns_ ? grid.columns : grid.rows), places_(by_columns_ ? grid.rows : grid.columns) {
        const double along = by_columns_ ? to_sun.x : to_sun.y;
        const double across = by_columns_ ? to_sun.y : to_sun.x;
        const double level = std::hypot(to_sun.x, to_sun.y);
        forwards_ = along < 0.0;
        drift_ = across / std::abs(along);
        const double fall = std::max(to_sun.z / std::max(level, 1e-9), min_fall);
        fall_m_ = grid.step_m * std::hypot(1.0, drift_) * fall;
        before_m_.assign(static_cast<std::size_t>(places_), nothing_m);
        now_m_ = before_m_;
    }

    /// Calls shade(column, row, metres by which the shadow lies above the ground, metres over which its edge is soft)
    /// for each place.
    template <class Shade>
    void run(const Shade& shade) {
        for (int i = 0; i < lines_; ++i) {
            const int line = forwards_ ? i : lines_ - 1 - i;
            for (int place = 0; place < places_; ++place) {
                const float own_m = height_m(line, place);
                const double shadow_m = shadow_at(place + drift_) - fall_m_;
                shade(by_columns_ ? line : place, by_columns_ ? place : line, shadow_m - static_cast<double>(own_m),
                    soft_steps * fall_m_ + softness_m);
                now_m_[static_cast<std::size_t>(place)] = std::max(own_m, static_cast<float>(shadow_m));
            }
            std::swap(before_m_, now_m_);
        }
    }

private:
    static constexpr float nothing_m = -1e9F;

    float height_m(int line, int place) const { return by_columns_ ? grid_.at(line, place) : grid_.at(place, line); }

    /// Ground or shadow on the line before, between places.
    double shadow_at(double place) const {
        const double below = std::floor(place);
        const auto first = static_cast<std::ptrdiff_t>(below);
        if (first < 0 || first + 1 >= places_) { return static_cast<double>(nothing_m); }
        const double share = place - below;
        const auto at = static_cast<std::size_t>(first);
        return static_cast<double>(before_m_[at]) * (1.0 - share) + static_cast<double>(before_m_[at + 1]) * share;
    }

    const Grid& grid_;
    bool by_columns_; ///< lines of equal column; else of equal row
    int lines_;
    int places_;
    bool forwards_ = true;
    double drift_ = 0.0;
    double fall_m_ = 0.0;
    std::vector<float> before_m_;
    std::vector<float> now_m_;
};

/// Sums of heights over rectangles from the first sample, one wider and higher than the grid.
class Sums {
public:
    explicit Sums(const Grid& grid)
        : grid_(grid), width_(static_cast<std::size_t>(grid.columns) + 1),
          sums_(width_ * (static_cast<std::size_t>(grid.rows) + 1)) {
        for (int row = 0; row < grid.rows; ++row) {
            double sum = 0.0;
            for (int column = 0; column < grid.columns; ++column) {
                sum += static_cast<double>(grid.at(column, row));
                sums_[index(column + 1, row + 1)] = sums_[index(column + 1, row)] + sum;
            }
        }
    }

    double mean(int column, int row, int half) const {
        const int west = std::max(column - half, 0);
        const int east = std::min(column + half + 1, grid_.columns);
        const int south = std::max(row - half, 0);
        const int north = std::min(row + half + 1, grid_.rows);
        const double sum = sums_[index(east, north)] - sums_[index(west, north)] - sums_[index(east, south)] +
                           sums_[index(west, south)];
        return sum / (static_cast<double>(east - west) * (north - south));
    }

private:
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column);
    }

    const Grid& grid_;
    std::size_t width_;
    std::vector<double> sums_;
};

double sky_left(const Grid& grid, const Sums& sums, int column, int row) {
    const double own_m = static_cast<double>(grid.at(column, row));
    double slopes = 0.0;
    int half = min_surrounding;
    for (int i = 0; i < surroundings; ++i, half *= 2) {
        slopes += std::max(sums.mean(column, row, half) - own_m, 0.0) / (half * grid.step_m);
    }
    return std::clamp(1.0 - lost_a_slope * slopes / surroundings, min_sky, 1.0);
}

std::uint8_t byte_of(double share) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255.0));
}

} // namespace

ReliefShadows::ReliefShadows(
    const terrain::GroundSamples& ground, const glm::dvec3& to_sun, const ReliefShadows* same_ground) {
    const Grid grid = reduced(ground);
    spacing_m_ = static_cast<float>(grid.step_m);
    const auto columns = static_cast<std::size_t>(grid.columns);
    sun_.push_back({grid.columns, grid.rows, std::vector<std::uint8_t>(grid.height_m.size(), 255)});
    MipLevels sky;
    std::optional<Sums> sums;
    if (same_ground == nullptr) {
        sky = sun_;
        sums.emplace(grid);
    }
    const std::size_t rows = sums ? static_cast<std::size_t>(grid.rows) : 0;
    // The first task is the sweep, each other one the sky above a row.
    parallel_for(rows + 1, core_count(), [&](std::size_t task, std::size_t) {
        if (task > 0) {
            const auto row = static_cast<int>(task - 1);
            for (int column = 0; column < grid.columns; ++column) {
                sky.front().shares[(task - 1) * columns + static_cast<std::size_t>(column)] =
                    byte_of(sky_left(grid, *sums, column, row));
            }
        } else if (std::hypot(to_sun.x, to_sun.y) > 1e-6) {
            Sweep(grid, to_sun).run([&](int column, int row, double height_above_ground_m, double soft_m) {
                sun_.front().shares[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] =
                    byte_of(1.0 - height_above_ground_m / soft_m);
            });
        }
    });
    soften(sun_.front());
    add_coarser_levels(sun_);
    if (same_ground == nullptr) { add_coarser_levels(sky); }
    sky_ = same_ground == nullptr ? std::make_shared<const MipLevels>(std::move(sky)) : same_ground->sky_;
}

/// The mean of the places around each one, the nearer ones counting twice: edges along the sun's way are soft, too, and
/// show no steps of the grid.
void ReliefShadows::soften(MipLevel& level) {
    const auto columns = static_cast<std::size_t>(level.columns);
    const std::vector<std::uint8_t> sharp = level.shares;
    parallel_for_rows(level.rows, [&](int row) {
        for (int column = 0; column < level.columns; ++column) {
            unsigned sum = 8;
            for (int j = -1; j <= 1; ++j) {
                const auto from = static_cast<std::size_t>(std::clamp(row + j, 0, level.rows - 1)) * columns;
                for (int i = -1; i <= 1; ++i) {
                    const auto at = static_cast<std::size_t>(std::clamp(column + i, 0, level.columns - 1));
                    sum += (i == 0 ? 2U : 1U) * (j == 0 ? 2U : 1U) * sharp[from + at];
                }
            }
            level.shares[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] =
                static_cast<std::uint8_t>(sum / 16);
        }
    });
}

void ReliefShadows::add_coarser_levels(MipLevels& levels) {
    while (levels.back().columns > 2 && levels.back().rows > 2) {
        const MipLevel& fine = levels.back();
        MipLevel coarse{(fine.columns - 1) / 2 + 1, (fine.rows - 1) / 2 + 1, {}};
        coarse.shares.reserve(static_cast<std::size_t>(coarse.columns) * static_cast<std::size_t>(coarse.rows));
        for (int row = 0; row < coarse.rows; ++row) {
            std::array<const std::uint8_t*, 3> of{};
            for (int j = -1; j <= 1; ++j) {
                const int r = std::clamp(2 * row + j, 0, fine.rows - 1);
                of[static_cast<std::size_t>(j + 1)] =
                    &fine.shares[static_cast<std::size_t>(r) * static_cast<std::size_t>(fine.columns)];
            }
            for (int column = 0; column < coarse.columns; ++column) {
                unsigned sum = 8;
                for (int i = -1; i <= 1; ++i) {
                    const int c = std::clamp(2 * column + i, 0, fine.columns - 1);
                    sum += (i == 0 ? 2U : 1U) * (of[0][c] + 2U * of[1][c] + of[2][c]);
                }
                coarse.shares.push_back(static_cast<std::uint8_t>(sum / 16));
            }
        }
        levels.push_back(std::move(coarse));
    }
}

LightVisibility ReliefShadows::at(float east_m, float north_m, float footprint_m) const {
    float step_m = spacing_m_;
    std::size_t number = 0;
    while (number + 1 < sun_.size() && 2.0F * step_m <= footprint_m) {
        step_m *= 2.0F;
        ++number;
    }
    const MipLevel& level = sun_[number];
    const float x = std::clamp(east_m / step_m, 0.0F, static_cast<float>(level.columns - 1));
    const float y = std::clamp(north_m / step_m, 0.0F, static_cast<float>(level.rows - 1));
    // A narrow ground may be reduced to a single row or column.
    const int column = std::min(static_cast<int>(x), std::max(level.columns - 2, 0));
    const int row = std::min(static_cast<int>(y), std::max(level.rows - 2, 0));
    const std::size_t east = level.columns > 1 ? 1 : 0;
    const float u = x - static_cast<float>(column);
    const float v = y - static_cast<float>(row);
    const auto width = static_cast<std::size_t>(level.columns);
    const std::size_t first = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
    const auto between = [&](const MipLevel& of) {
        const std::uint8_t* const south = &of.shares[first];
        const std::uint8_t* const north = of.rows > 1 ? south + width : south;
        const float below = static_cast<float>(south[0]) * (1.0F - u) + static_cast<float>(south[east]) * u;
        const float above = static_cast<float>(north[0]) * (1.0F - u) + static_cast<float>(north[east]) * u;
        return (below * (1.0F - v) + above * v) * (1.0F / 255.0F);
    };
    return {between(level), between((*sky_)[number])};
}

} // namespace octant::visuals::nature
