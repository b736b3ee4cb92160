#include "flightpaths/track_steps.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace octant::flightpaths {

namespace {

/// A stretch of samples at no less than one a second.
struct Stretch {
    std::vector<glm::dvec2> over_ground_mps;
    std::vector<double> airspeeds_mps;
    std::vector<double> headings_rad;
};

struct FittedWind {
    glm::dvec2 wind_mps{0.0};
    double variance = 0.0;
    bool from_circling = false;
};

constexpr double slowest_mps = 7.0;
/// Stronger winds at heights where aircraft circle are none.
constexpr double strongest_mps = 80.0;

/// How far the course turns in all, and how many of eight sectors it has.
struct Turning {
    double in_all_rad = 0.0;
    int sectors = 0;
};

Turning turning_of(const std::vector<glm::dvec2>& velocities_mps, const glm::dvec2& wind_mps) {
    Turning turning;
    std::array<int, 8> counts{};
    double last_rad = 0.0;
    for (std::size_t i = 0; i < velocities_mps.size(); ++i) {
        const glm::dvec2 through_air_mps = velocities_mps[i] - wind_mps;
        const double course_rad = wrapped_to_two_pi(std::atan2(through_air_mps.x, through_air_mps.y));
        if (i > 0) { turning.in_all_rad += std::abs(wrapped_to_pi(course_rad - last_rad)); }
        last_rad = course_rad;
        ++counts[static_cast<std::size_t>(course_rad / (0.25 * pi)) % counts.size()];
    }
    const auto enough = static_cast<int>(velocities_mps.size() / 40);
    turning.sectors = static_cast<int>(std::ranges::count_if(counts, [&](int count) { return count > enough; }));
    return turning;
}

/// The circle through the ends of velocities: its middle is the wind, its radius the airspeed. Least squares.
std::optional<FittedWind> wind_of_circles(const Stretch& stretch) {
    glm::dmat3 normal(0.0);
    glm::dvec3 right(0.0);
    for (const glm::dvec2& velocity : stretch.over_ground_mps) {
        const glm::dvec3 row(2.0 * velocity, 1.0);
        normal += glm::outerProduct(row, row);
        right += row * glm::dot(velocity, velocity);
    }
    if (!(std::abs(glm::determinant(normal)) > 1e-9)) { return std::nullopt; }
    const glm::dvec3 solution = glm::inverse(normal) * right;
    const glm::dvec2 wind_mps(solution);
    const double square = solution.z + glm::dot(wind_mps, wind_mps);
    if (!(square > slowest_mps * slowest_mps) || !(glm::length(wind_mps) < strongest_mps)) { return std::nullopt; }
    const double airspeed_mps = std::sqrt(square);
    double squares = 0.0;
    for (const glm::dvec2& velocity : stretch.over_ground_mps) {
        const double difference = glm::length(velocity - wind_mps) - airspeed_mps;
        squares += difference * difference;
    }
    const auto count = static_cast<double>(stretch.over_ground_mps.size());
    const double spread_mps = std::sqrt(squares / count);
    const Turning turning = turning_of(stretch.over_ground_mps, wind_mps);
    if (spread_mps > 0.07 * airspeed_mps || turning.sectors < 7 || turning.in_all_rad < 3.2 * pi ||
        glm::length(wind_mps) > 0.9 * airspeed_mps) {
        return std::nullopt;
    }
    // Changes of airspeed within a circle last about a quarter of it.
    const double circles = turning.in_all_rad / (2.0 * pi);
    return FittedWind{wind_mps, 0.25 + spread_mps * spread_mps / (2.0 * circles), true};
}

/// The wind under which measured airspeeds, with headings where there are any, are those of the motion.
std::optional<FittedWind> wind_of_airspeeds(const Stretch& stretch) {
    glm::dvec2 wind_mps(0.0);
    double variance = 0.0;
    constexpr double prior_mps = 10.0;
    for (int round = 0; round < 4; ++round) {
        glm::dmat2 normal(1.0 / (prior_mps * prior_mps));
        glm::dvec2 right(0.0);
        double count = 0.0;
        const auto add = [&](const glm::dvec2& row, double value, double weight) {
            normal += weight * glm::outerProduct(row, row);
            right += weight * row * value;
        };
        for (std::size_t i = 0; i < stretch.over_ground_mps.size(); ++i) {
            const glm::dvec2& ground_mps = stretch.over_ground_mps[i];
            const glm::dvec2 air_mps = ground_mps - wind_mps;
            const double speed_mps = glm::length(air_mps);
            if (speed_mps < slowest_mps) { continue; }
            constexpr double speed_weight = 0.25; // 2 m/s
            if (std::isfinite(stretch.airspeeds_mps[i])) {
                const glm::dvec2 along = air_mps / speed_mps;
                add(along, glm::dot(ground_mps, along) - stretch.airspeeds_mps[i], speed_weight);
                count += 1.0;
            }
            if (std::isfinite(stretch.headings_rad[i])) {
                const double heading_rad = stretch.headings_rad[i];
                const glm::dvec2 across(std::cos(heading_rad), -std::sin(heading_rad));
                add(across, glm::dot(ground_mps, across), speed_weight);
                count += 1.0;
            }
        }
        constexpr double least = 15.0;
        if (count < least) { return std::nullopt; }
        wind_mps = glm::inverse(normal) * right;
        // Errors of airspeed and compass last: no more than a few values are independent.
        const glm::dmat2 covariance = glm::inverse(normal);
        variance = 0.5 + std::max(covariance[0][0], covariance[1][1]) * count / 6.0;
    }
    constexpr double useless_mps2 = 36.0;
    if (!(variance <= useless_mps2) || !(glm::length(wind_mps) <= strongest_mps)) { return std::nullopt; }
    return FittedWind{wind_mps, variance, false};
}

Stretch stretch_of(const AirData& air, std::size_t begin, std::size_t end) {
    Stretch stretch;
    double next_s = air.times_s[begin];
    for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec2 velocity_mps(air.velocities_mps[i]);
        if (air.times_s[i] < next_s || glm::length(velocity_mps) < 0.5) { continue; }
        next_s = air.times_s[i] + 0.75;
        stretch.over_ground_mps.push_back(velocity_mps);
        stretch.airspeeds_mps.push_back(air.airspeeds_mps[i]);
        stretch.headings_rad.push_back(air.headings_rad[i]);
    }
    return stretch;
}

bool has_measured(const AirData& air) {
    const auto finite = [](double value) { return std::isfinite(value); };
    return std::ranges::any_of(air.airspeeds_mps, finite) || std::ranges::any_of(air.headings_rad, finite);
}

} // namespace

WindEstimate::WindEstimate(const AirData& air) {
    constexpr std::array windows_s{90.0, 240.0};
    constexpr std::size_t least_samples = 20;
    const bool is_measured = has_measured(air);
    for (const double window_s : windows_s) {
        std::size_t begin = 0;
        std::size_t end = 0;
        for (double from_s = air.times_s.front(); from_s < air.times_s.back(); from_s += 0.5 * window_s) {
            while (begin < air.times_s.size() && air.times_s[begin] < from_s) { ++begin; }
            while (end < air.times_s.size() && air.times_s[end] < from_s + window_s) { ++end; }
            if (end <= begin) { continue; }
            const Stretch stretch = stretch_of(air, begin, end);
            if (stretch.over_ground_mps.size() < least_samples) { continue; }
            auto wind = is_measured ? wind_of_airspeeds(stretch) : std::nullopt;
            if (!wind) { wind = wind_of_circles(stretch); }
            if (!wind) { continue; }
            estimates_.push_back({0.5 * (air.times_s[begin] + air.times_s[end - 1]), wind->wind_mps, wind->variance});
            winds_.push_back({air.times_s[begin], air.times_s[end - 1], wind->wind_mps, wind->from_circling});
        }
    }
    std::ranges::stable_sort(winds_, {}, &TrackInference::Wind::from_s);
    std::ranges::stable_sort(estimates_, {}, &Estimate::time_s);
}

glm::dvec2 WindEstimate::wind_mps(double time_s) const {
    constexpr double usual_mps = 8.0;
    constexpr double lasts_s = 600.0;
    glm::dvec2 sum(0.0);
    double weights = 1.0 / (usual_mps * usual_mps) * 0.1;
    for (const Estimate& estimate : estimates_) {
        const double weight = std::exp(-std::abs(estimate.time_s - time_s) / lasts_s) / estimate.variance;
        sum += weight * estimate.wind_mps;
        weights += weight;
    }
    return sum / weights;
}

} // namespace octant::flightpaths
