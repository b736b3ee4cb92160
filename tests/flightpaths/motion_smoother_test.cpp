#include "flightpaths/motion_smoother.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace octant::flightpaths;

namespace {

/// Solves a system of linear equations by Gauss's elimination with a choice of rows.
std::vector<double> solved(std::vector<std::vector<double>> a, std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t pivot = i;
        for (std::size_t k = i + 1; k < n; ++k) { pivot = std::abs(a[k][i]) > std::abs(a[pivot][i]) ? k : pivot; }
        std::swap(a[i], a[pivot]);
        std::swap(b[i], b[pivot]);
        for (std::size_t k = i + 1; k < n; ++k) {
            const double factor = a[k][i] / a[i][i];
            for (std::size_t j = i; j < n; ++j) { a[k][j] -= factor * a[i][j]; }
            b[k] -= factor * b[i];
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t j = i + 1; j < n; ++j) { b[i] -= a[i][j] * b[j]; }
        b[i] /= a[i][i];
    }
    return b;
}

using Matrix3 = std::array<std::array<double, 3>, 3>;

Matrix3 inverse_of(const Matrix3& m) {
    Matrix3 inverse{};
    for (std::size_t column = 0; column < 3; ++column) {
        std::vector<std::vector<double>> rows;
        for (const auto& row : m) { rows.emplace_back(row.begin(), row.end()); }
        std::vector<double> unit(3, 0.0);
        unit[column] = 1.0;
        const std::vector<double> x = solved(rows, unit);
        for (std::size_t row = 0; row < 3; ++row) { inverse[row][column] = x[row]; }
    }
    return inverse;
}

/// Positions, velocities and accelerations at all times that make the sum of all squared errors least, all at once.
std::vector<double> least_squares(const AxisSeries& series, double jerk) {
    const std::size_t n = series.times_s.size();
    std::vector<std::vector<double>> a(3 * n, std::vector<double>(3 * n, 0.0));
    std::vector<double> b(3 * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        const AxisMeasurement& one = series.measured[i];
        if (std::isfinite(one.position_variance)) {
            a[3 * i][3 * i] += 1.0 / one.position_variance;
            b[3 * i] += one.position_m / one.position_variance;
        }
        if (std::isfinite(one.velocity_variance)) {
            a[3 * i + 1][3 * i + 1] += 1.0 / one.velocity_variance;
            b[3 * i + 1] += one.velocity_mps / one.velocity_variance;
        }
    }
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const double t = series.times_s[i + 1] - series.times_s[i];
        const double m = series.memory_s;
        const double left = std::exp(-t / m);
        // State at i+1 minus state at i carried on.
        const Matrix3 on{{{1.0, t, m * (t - m * (1.0 - left))}, {0.0, 1.0, m * (1.0 - left)}, {0.0, 0.0, left}}};
        const Matrix3 weight =
            inverse_of({{{jerk * std::pow(t, 5) / 20, jerk * std::pow(t, 4) / 8, jerk * std::pow(t, 3) / 6},
                {jerk * std::pow(t, 4) / 8, jerk * std::pow(t, 3) / 3, jerk * t * t / 2},
                {jerk * std::pow(t, 3) / 6, jerk * t * t / 2, jerk * t}}});
        for (std::size_t row = 0; row < 6; ++row) {
            for (std::size_t column = 0; column < 6; ++column) {
                double sum = 0.0;
                for (std::size_t p = 0; p < 3; ++p) {
                    for (std::size_t q = 0; q < 3; ++q) {
                        const double left_of = row < 3 ? -on[p][row] : (p == row - 3 ? 1.0 : 0.0);
                        const double right_of = column < 3 ? -on[q][column] : (q == column - 3 ? 1.0 : 0.0);
                        sum += left_of * weight[p][q] * right_of;
                    }
                }
                a[3 * i + row][3 * i + column] += sum;
            }
        }
    }
    return solved(a, b);
}

} // namespace

TEST_CASE("the smoother's motion is that of least squares over all measurements at once") {
    const std::vector<double> times_s{0.0, 1.0, 1.7, 3.0, 3.5, 5.0, 6.0, 7.5, 8.0, 9.0, 10.5, 12.0};
    std::vector<AxisMeasurement> measured(times_s.size());
    for (std::size_t i = 0; i < times_s.size(); ++i) {
        const double t = times_s[i];
        measured[i].position_m = 20.0 * t + 30.0 * std::sin(0.4 * t) + (i % 3 == 0 ? 0.8 : -0.5);
        if (i != 4) { measured[i].position_variance = i == 7 ? 9.0 : 1.0; }
        measured[i].velocity_mps = 20.0 + 12.0 * std::cos(0.4 * t);
        if (i % 4 == 1) { measured[i].velocity_variance = 0.25; }
    }
    const AxisSeries series{times_s, measured, 20.0};
    const std::vector<double> expected = least_squares(series, 0.5);
    const std::vector<AxisMotion> motion = smoothed(series, std::vector<double>(times_s.size(), 0.5));
    for (std::size_t i = 0; i < times_s.size(); ++i) {
        INFO(i);
        // The filter begins with weak beliefs (300 m/s, 10 m/s^2) that least squares has not.
        CHECK(motion[i].position_m == Approx(expected[3 * i]).margin(0.03));
        CHECK(motion[i].velocity_mps == Approx(expected[3 * i + 1]).margin(0.1));
        CHECK(motion[i].acceleration_mps2 == Approx(expected[3 * i + 2]).margin(0.25));
    }
}

TEST_CASE("jerk is found to be little at rest and much in a turn") {
    std::vector<double> times_s;
    std::vector<AxisMeasurement> east;
    std::vector<AxisMeasurement> north;
    for (int i = 0; i < 120; ++i) {
        times_s.push_back(i);
        const double angle = i < 60 ? 0.0 : 0.3 * (i - 60);
        // Errors of a metre without pattern.
        const double error_m = std::sin(12.9898 * i) * std::cos(78.233 * i);
        east.push_back({100.0 * (1.0 - std::cos(angle)) + error_m, 0.5});
        north.push_back({100.0 * std::sin(angle) - error_m, 0.5});
    }
    const std::vector<AxisSeries> axes{{times_s, east, 20.0}, {times_s, north, 20.0}};
    const JerkFit fit = fitted_jerk(axes);
    CHECK(fit.jerk[30] < 1e-2);
    CHECK(fit.jerk[90] > 1.0);
}
