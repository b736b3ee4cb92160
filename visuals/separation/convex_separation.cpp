// A small linear programme for the separation of convex sets. The plane n.x = d with the largest
// margin t solves
//      maximise t:  n.b - d >= t,  d - n.a >= t,  d w - n.g >= 0 for generators (g, w),  |n_i|
//      <= 1.
// It is solved by the simplex method of G. B. Dantzig in dictionary form. The free unknowns n, d, t
// are written as differences y_i - y_0 of unknowns >= 0. The origin is feasible, so there is no
// first phase, and the search ends as soon as the margin is positive. Nearly all bounds are zero,
// so that many rows tie for leaving; the one with the largest factor goes, as in P. M. J. Harris,
// "Pivot selection methods of the Devex LP code", 1973.
//
// Deviations: the number of steps is limited, and a plane counts only once the points have been
// measured against it. Without a plane the sets count as inseparable, which never makes an order
// wrong.
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
constexpr double least_air = 1e-9; ///< The margin that is enough.
constexpr double rounding = 1e-10;
constexpr double slack_tolerance = 1e-13;
constexpr int most_steps = 400; ///< A programme that takes more steps counts as unsolved.

/// A dictionary of the simplex method: slack = bound - sum of factors * unknowns for every row, and
/// value = sum of gain * unknowns.
class Dictionary {
public:
    Dictionary() {
        gain_ = {0, 0, 0, 0, 1, -1};
        for (std::size_t i = 0; i < unknowns; ++i) {
            column_name_.at(i) = i;
        }
    }

    /// Adds the row factor . (n, d, t) <= bound with bound >= 0.
    void add(const glm::dvec3& n, double d, double t, double bound) {
        rows_.push_back({{n.x, n.y, n.z, d, t, -(n.x + n.y + n.z + d + t)}, bound});
        row_name_.push_back(unknowns + row_name_.size());
    }

    /// Climbs until the value exceeds a limit. Returns false when it cannot.
    bool exceeds(double limit) {
        for (int step = 0; step < most_steps && value_ <= limit; ++step) {
            const std::size_t enter = entering();
            if (gain_.at(enter) <= rounding) {
                return false;
            }
            const std::size_t leave = leaving(enter);
            if (leave == rows_.size()) {
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
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (row_name_[i] < unknowns) {
                at.at(row_name_[i]) = rows_[i].bound;
            }
        }
        return glm::dvec4(at[0], at[1], at[2], at[3]) - at[5];
    }

private:
    struct Row {
        std::array<double, unknowns> factor{};
        double bound = 0.0;
    };

    /// The column with the largest gain.
    std::size_t entering() const {
        return static_cast<std::size_t>(std::ranges::max_element(gain_) - gain_.begin());
    }

    /// The row that bounds the entering unknown first.
    std::size_t leaving(std::size_t column) const {
        double nearest = HUGE_VAL;
        for (const Row& row : rows_) {
            if (row.factor[column] > rounding) {
                nearest = std::min(nearest, (row.bound + slack_tolerance) / row.factor[column]);
            }
        }
        std::size_t best = rows_.size();
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const double factor = rows_[i].factor[column];
            if (factor > rounding && rows_[i].bound <= nearest * factor &&
                (best == rows_.size() || factor > rows_[best].factor[column])) {
                best = i;
            }
        }
        return best;
    }

    /// Exchanges the unknowns of a row and a column.
    void pivot(std::size_t row, std::size_t column) {
        Row& pivot = rows_[row];
        const double inverse = 1.0 / pivot.factor[column];
        for (double& factor : pivot.factor) {
            factor *= inverse;
        }
        pivot.factor[column] = inverse;
        pivot.bound *= inverse;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (i != row) {
                const double share = rows_[i].factor[column];
                eliminate(rows_[i].factor, pivot.factor, column);
                rows_[i].bound = std::max(0.0, rows_[i].bound - share * pivot.bound);
            }
        }
        value_ += gain_[column] * pivot.bound;
        eliminate(gain_, pivot.factor, column);
        std::swap(row_name_[row], column_name_.at(column));
    }

    static void eliminate(
        std::array<double, unknowns>& factors,
        const std::array<double, unknowns>& pivot,
        std::size_t column) {
        const double share = factors[column];
        factors[column] = 0.0;
        for (std::size_t i = 0; i < unknowns; ++i) {
            factors[i] -= share * pivot[i];
        }
    }

    std::array<double, unknowns> gain_{};
    double value_ = 0.0;
    std::vector<Row> rows_;
    std::vector<std::size_t> row_name_;
    std::array<std::size_t, unknowns> column_name_{};
};

} // namespace

bool separable(
    std::span<const glm::dvec3> b,
    std::span<const glm::dvec3> a,
    std::span<const glm::dvec4> eyes) {
    Dictionary programme;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 n(0.0);
        n[axis] = 1.0;
        programme.add(n, 0.0, 0.0, 1.0);
        programme.add(-n, 0.0, 0.0, 1.0);
    }
    for (const glm::dvec3& point : b) {
        programme.add(-point, 1.0, 1.0, 0.0);
    }
    for (const glm::dvec3& point : a) {
        programme.add(point, -1.0, 1.0, 0.0);
    }
    for (const glm::dvec4& eye : eyes) {
        programme.add({eye.x, eye.y, eye.z}, -eye.w, 0.0, 0.0);
    }
    if (!programme.exceeds(least_air)) {
        return false;
    }
    const glm::dvec4 plane = programme.plane();
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
