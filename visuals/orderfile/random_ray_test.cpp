// An independent test of painting orders by sampling: along each ray the polygon that is painted last must be the one
// nearest to the eye. It finds gaps between cells, which check_order() cannot find, and it measures how wrong an
// inexact order is: the share of wrong pixels.
#include "visuals/orderfile/random_ray_test.h"

#include "sim/base/random_generator.h"
#include "sim/base/units.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/ray_targets.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace octant::visuals::orderfile {

namespace {

/// A random point on the disc of a radius around the origin, across the line of sight from an eye to the origin.
glm::dvec3 target_on_disc(RandomGenerator& dice, const glm::dvec3& eye_m, double radius_m) {
    const glm::dvec3 ahead = glm::normalize(eye_m);
    const glm::dvec3 aside = std::abs(ahead.x) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, ahead));
    const glm::dvec3 up = glm::cross(ahead, right);
    const double from_middle_m = radius_m * std::sqrt(dice.next());
    const double angle_rad = dice.between(0.0, 2.0 * pi);
    return right * (from_middle_m * std::cos(angle_rad)) + up * (from_middle_m * std::sin(angle_rad));
}

/// Random eyes and rays, and what they see.
class RaySampler {
public:
    RaySampler(const models::polygons::PolygonModel& model, const RaySampling& samples,
        std::span<const std::uint32_t> two_sided)
        : samples_(samples), dice_(samples.seed), targets_(model, two_sided) {
        targets_.turn(samples.turn_rad, true);
        middle_m_ = targets_.in_model_m(glm::dvec3(0.0));
        radius_m_ = targets_.radius_m();
        if (glm::length(middle_m_) <= radius_m_) {
            middle_m_ = glm::dvec3(0.0);
            radius_m_ = models::polygons::radius_m(model);
        }
    }

    /// The next random eye, body axes.
    glm::dvec3 next_eye_m() {
        glm::dvec3 direction = dice_.direction();
        if (samples_.octant >= 0) { direction = glm::abs(direction) * draworder::octant_signs(samples_.octant); }
        const double spread = std::log(samples_.max_distance_radii / samples_.min_distance_radii);
        return middle_m_ + direction * (radius_m_ * samples_.min_distance_radii * std::exp(spread * dice_.next()));
    }

    /// Sends rays from an eye and compares what is painted last with what is nearest.
    void look(const glm::dvec3& eye_m, std::span<const std::uint32_t> painted, RayTestCounts& count) {
        ++count.eyes;
        const glm::dvec3 from_middle_m = eye_m - middle_m_;
        const double away_m = glm::length(from_middle_m);
        const double tolerance = 1e-9 * std::max(away_m, radius_m_) / targets_.radius_m();
        targets_.set_eye(targets_.in_radii(eye_m), painted);
        for (int i = 0; i < samples_.rays_per_eye; ++i) {
            const glm::dvec3 ray =
                away_m < radius_m_ ? dice_.direction()
                                   : glm::normalize(target_on_disc(dice_, from_middle_m, radius_m_) - from_middle_m);
            targets_.intersect(ray, hits_);
            if (hits_.empty()) { continue; }
            ++count.hits;
            const double nearest = std::ranges::min(hits_, {}, &draworder::RayHit::distance).distance;
            const draworder::RayHit& seen = *std::ranges::max_element(hits_, {}, &draworder::RayHit::painted);
            count.wrong += seen.painted == 0 || seen.distance - nearest > tolerance ? 1 : 0;
        }
    }

private:
    RaySampling samples_;
    RandomGenerator dice_;
    draworder::RayTargets targets_;
    /// A ball that holds the model: about the origin, or about the model's own middle where the origin lies outside.
    glm::dvec3 middle_m_{0.0};
    double radius_m_ = 0.0;
    std::vector<draworder::RayHit> hits_; ///< Of the ray cast last.
};

} // namespace

RayTestCounts& RayTestCounts::operator+=(const RayTestCounts& other) {
    eyes += other.eyes;
    eyes_without_cell += other.eyes_without_cell;
    hits += other.hits;
    wrong += other.wrong;
    return *this;
}

RayTestCounts count_wrong_rays(const models::polygons::PolygonModel& model, const PaintedListOfEye& painted_from,
    const RaySampling& samples, std::span<const std::uint32_t> two_sided) {
    RaySampler sampler(model, samples, two_sided);
    RayTestCounts count;
    for (int i = 0; i < samples.eyes; ++i) {
        const glm::dvec3 eye_m = sampler.next_eye_m();
        if (const auto painted = painted_from(eye_m)) { sampler.look(eye_m, *painted, count); }
    }
    return count;
}

RayTestCounts count_wrong_rays(const models::polygons::PolygonModel& model, const draworder::DrawOrder& order,
    const RaySampling& samples, std::span<const std::uint32_t> two_sided) {
    draworder::DrawOrder::Walk walk;
    std::vector<std::uint32_t> painted;
    const PaintedListOfEye painted_from = [&](const glm::dvec3& eye_m) {
        painted.clear();
        order.append_painted(eye_m, walk, painted);
        return std::span<const std::uint32_t>(painted);
    };
    return count_wrong_rays(model, painted_from, samples, two_sided);
}

RayTestCounts count_wrong_rays(
    const models::polygons::PolygonModel& model, const CellOrders& orders, const RaySampling& samples) {
    if (orders.parts) { return count_wrong_rays(model, *orders.parts, samples, orders.two_sided); }
    long eyes_without_cell = 0;
    const PaintedListOfEye painted_from =
        [&](const glm::dvec3& eye_m) -> std::optional<std::span<const std::uint32_t>> {
        if (!in_range(orders, eye_m)) { return std::nullopt; }
        const auto cell = cell_of(orders, eye_m);
        if (!cell) {
            ++eyes_without_cell;
            return std::nullopt;
        }
        return orders.cells[*cell].list;
    };
    RayTestCounts count = count_wrong_rays(model, painted_from, samples, orders.two_sided);
    count.eyes_without_cell = eyes_without_cell;
    return count;
}

} // namespace octant::visuals::orderfile
