// A small linear programme for the separation of convex sets. The plane n.x = d with the largest margin t solves
//      maximise t:  n.b - d >= t,  d - n.a >= t,  d w - n.g >= 0 for generators (g, w),  |n_i|
//      <= 1.
// It is solved by the simplex method of G. B. Dantzig in dictionary form. The free unknowns n, d, t are written as
// differences y_i - y_0 of unknowns >= 0. The origin is feasible, so there is no first phase, and the search ends as
// soon as the margin is positive. Nearly all bounds are zero, so that many rows tie for leaving; the one with the
// largest factor goes, as in P. M. J. Harris, "Pivot selection methods of the Devex LP code", 1973.
//
// Deviations: the number of steps is limited, and a plane counts only once the points have been measured against it.
// Without a plane the sets count as inseparable, which never makes an order wrong.
#include "visuals/separation/convex_separation.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace octant::visuals::separation {

namespace {

/// These are n.x, n.y, n.z, d, t, and y_0, which is subtracted from all of them.
constexpr std::size_t unknowns = 6;
constexpr double min_air = 1e-9; ///< The margin that is enough.
constexpr double rounding = 1e-10;
constexpr double slack_tolerance = 1e-13;
constexpr int max_steps = 400; ///< A programme that takes more steps counts as unsolved.

/// A dictionary of the simplex method: slack = bound - sum of factors * unknowns for every row, and value = sum of gain
/// * unknowns. Four rows lie side by side, so that they are worked on at once.
class Dictionary {
public:
    explicit Dictionary(std::size_t max_rows) {
        fours_.reserve((max_rows + lanes - 1) / lanes);
        row_name_.reserve(max_rows);
        gain_ = {0, 0, 0, 0, 1, -1};
        for (std::size_t i = 0; i < unknowns; ++i) { column_name_.at(i) = i; }
    }

    /// Adds the row factor . (n, d, t) <= bound with bound >= 0.
    void add(const glm::dvec3& n, double d, double t, double bound) {
        const std::size_t row = row_name_.size();
        if (row % lanes == 0) { fours_.emplace_back(); }
        const std::array<double, unknowns> factors{n.x, n.y, n.z, d, t, -(n.x + n.y + n.z + d + t)};
        Four& four = fours_.back();
        for (std::size_t i = 0; i < unknowns; ++i) { four.factor.at(i).at(row % lanes) = factors.at(i); }
        four.bound.at(row % lanes) = bound;
        row_name_.push_back(unknowns + row);
    }

    /// Climbs until the value exceeds a limit. Returns false when it cannot.
    bool exceeds(double limit) {
        for (int step = 0; step < max_steps && value_ <= limit; ++step) {
            const std::size_t enter = entering();
            if (gain_.at(enter) <= rounding) { return false; }
            const std::size_t leave = leaving(enter);
            if (leave == row_name_.size()) {
                // The value is bounded, so a gain without a leaving row is rounding.
                gain_.at(enter) = 0.0;
            } else {
                pivot(leave, enter);
            }
        }
        return value_ > limit;
    }

    /// The values of n.x, n.y, n.z and d in the present solution.
    glm::dvec4 plane() const {
        std::array<double, unknowns> at{};
        for (std::size_t i = 0; i < row_name_.size(); ++i) {
            if (row_name_[i] < unknowns) { at.at(row_name_[i]) = fours_[i / lanes].bound.at(i % lanes); }
        }
        return glm::dvec4(at[0], at[1], at[2], at[3]) - at[5];
    }

private:
    static constexpr std::size_t lanes = 4;
    using Lanes = std::array<double, lanes>;

    /// Four rows. Those that fill the last four are all zero and stay so.
    struct Four {
        std::array<Lanes, unknowns> factor{};
        Lanes bound{};
    };

    /// The column with the largest gain.
    std::size_t entering() const { return static_cast<std::size_t>(std::ranges::max_element(gain_) - gain_.begin()); }

    /// The row that bounds the entering unknown first.
    std::size_t leaving(std::size_t column) const {
        Lanes nearest;
        nearest.fill(HUGE_VAL);
        for (const Four& four : fours_) {
            const Lanes& factor = four.factor[column];
            for (std::size_t i = 0; i < lanes; ++i) {
                const double at = (four.bound[i] + slack_tolerance) / factor[i];
                nearest[i] = factor[i] > rounding && at < nearest[i] ? at : nearest[i];
            }
        }
        const double first = std::ranges::min(nearest);
        std::size_t best = row_name_.size();
        double largest = rounding;
        for (std::size_t row = 0; row < row_name_.size(); ++row) {
            const Four& four = fours_[row / lanes];
            const double factor = four.factor[column][row % lanes];
            if (factor > largest && four.bound[row % lanes] <= first * factor) {
                best = row;
                largest = factor;
            }
        }
        return best;
    }

    /// Exchanges the unknowns of a row and a column.
    void pivot(std::size_t row, std::size_t column) {
        Four& home = fours_[row / lanes];
        const std::size_t lane = row % lanes;
        const double inverse = 1.0 / home.factor[column][lane];
        std::array<double, unknowns> pivot;
        for (std::size_t i = 0; i < unknowns; ++i) { pivot[i] = home.factor[i][lane] * inverse; }
        pivot[column] = inverse;
        const double bound = home.bound[lane] * inverse;
        for (Four& four : fours_) { eliminate(four, pivot, bound, column); }
        for (std::size_t i = 0; i < unknowns; ++i) { home.factor[i][lane] = pivot[i]; }
        home.bound[lane] = bound;
        const double share = gain_[column];
        value_ += share * bound;
        gain_[column] = 0.0;
        for (std::size_t i = 0; i < unknowns; ++i) { gain_[i] -= share * pivot[i]; }
        std::swap(row_name_[row], column_name_.at(column));
    }

    static void eliminate(Four& four, const std::array<double, unknowns>& pivot, double bound, std::size_t column) {
        const Lanes share = std::exchange(four.factor[column], Lanes{});
        for (std::size_t i = 0; i < unknowns; ++i) {
            for (std::size_t lane = 0; lane < lanes; ++lane) { four.factor[i][lane] -= share[lane] * pivot[i]; }
        }
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            four.bound[lane] = std::max(0.0, four.bound[lane] - share[lane] * bound);
        }
    }

    std::array<double, unknowns> gain_{};
    double value_ = 0.0;
    std::vector<Four> fours_;
    std::vector<std::size_t> row_name_;
    std::array<std::size_t, unknowns> column_name_{};
};

} // namespace

bool separable(std::span<const glm::dvec3> b, std::span<const glm::dvec3> a, std::span<const glm::dvec4> eyes) {
    Dictionary program(6 + b.size() + a.size() + eyes.size());
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 n(0.0);
        n[axis] = 1.0;
        program.add(n, 0.0, 0.0, 1.0);
        program.add(-n, 0.0, 0.0, 1.0);
    }
    for (const glm::dvec3& point : b) { program.add(-point, 1.0, 1.0, 0.0); }
    for (const glm::dvec3& point : a) { program.add(point, -1.0, 1.0, 0.0); }
    for (const glm::dvec4& eye : eyes) { program.add({eye.x, eye.y, eye.z}, -eye.w, 0.0, 0.0); }
    if (!program.exceeds(min_air)) { return false; }
    const glm::dvec4 plane = program.plane();
    const glm::dvec3 normal(plane.x, plane.y, plane.z);
    const auto above = [&](const glm::dvec3& point) { return glm::dot(normal, point) > plane.w; };
    const auto below = [&](const glm::dvec3& point) { return glm::dot(normal, point) < plane.w; };
    return std::ranges::all_of(b, above) && std::ranges::all_of(a, below) &&
           std::ranges::all_of(eyes, [&](const glm::dvec4& eye) {
               const glm::dvec3 at(eye.x, eye.y, eye.z);
               return glm::dot(normal, at) - plane.w * eye.w < rounding;
           });
}

} // namespace octant::visuals::separation
