// An independent test of painting orders by sampling: along each ray the polygon that is painted last must be the one
// nearest to the eye. It finds gaps between cells, which check_order() cannot find, and it measures how wrong an
// inexact order is: the share of wrong pixels.
#include "visuals/orderfile/random_ray_test.h"

#include "models/polygons/polygon_outlines.h"
#include "sim/base/random_generator.h"
#include "sim/base/units.h"
#include "visuals/draworder/octant_order.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace octant::visuals::orderfile {

namespace {

using draworder::DrawOrder;

/// The distance of a polygon that a ray misses.
constexpr double missed = std::numeric_limits<double>::infinity();

/// A polygon with its plane and a ball that holds it, for ray tests.
struct Facet {
    glm::dvec3 normal{0.0};
    glm::dvec3 point_m{0.0};
    glm::dvec3 middle_m{0.0};
    double radius2_m2 = 0.0;
    bool two_sided = false;
    std::vector<glm::dvec3> corners_m;
};

/// Puts the ball about the corners' mean, a little larger than rounding asks for.
void set_ball(Facet& facet) {
    for (const glm::dvec3& corner_m : facet.corners_m) {
        facet.middle_m += corner_m / static_cast<double>(facet.corners_m.size());
    }
    for (const glm::dvec3& corner_m : facet.corners_m) {
        const glm::dvec3 away_m = corner_m - facet.middle_m;
        facet.radius2_m2 = std::max(facet.radius2_m2, 1.001 * glm::dot(away_m, away_m));
    }
}

/// The facet of a polygon when its part has turned by an angle.
Facet facet_of(const models::polygons::PolygonModel& model, std::size_t polygon, double turn_rad) {
    Facet facet;
    facet.normal = models::polygons::normal_of(model, polygon);
    for (const std::uint32_t vertex : model.corners(polygon)) { facet.corners_m.push_back(model.vertices_m[vertex]); }
    const auto pivot = models::polygons::pivot_of(model, polygon);
    if (pivot && turn_rad != 0.0) {
        models::polygons::Pivot turn = model.pivots[*pivot];
        for (glm::dvec3& corner_m : facet.corners_m) { corner_m = models::polygons::turned(turn, corner_m, turn_rad); }
        turn.point_m = glm::dvec3(0.0);
        facet.normal = models::polygons::turned(turn, facet.normal, turn_rad);
    }
    facet.point_m = facet.corners_m[0];
    set_ball(facet);
    return facet;
}

/// How high an eye lies above a facet; nothing for one that sees only its back, or its edge.
std::optional<double> height_above_m(const Facet& facet, const glm::dvec3& eye_m) {
    const double height_m = glm::dot(eye_m - facet.point_m, facet.normal);
    const bool is_seen = height_m > 0.0 || (height_m < 0.0 && facet.two_sided);
    return is_seen ? std::optional(height_m) : std::nullopt;
}

/// The distance along a ray of unit length to a facet that its eye sees from a height, or `missed`.
double hit_m(const Facet& facet, double height_m, const glm::dvec3& eye_m, const glm::dvec3& ray) {
    const glm::dvec3 past = glm::cross(facet.middle_m - eye_m, ray);
    if (glm::dot(past, past) > facet.radius2_m2) { return missed; }
    const double slope = glm::dot(ray, facet.normal);
    if (slope * height_m >= 0.0) { return missed; }
    const double at = -height_m / slope;
    const bool hits = models::polygons::is_inside(facet.corners_m, facet.normal, eye_m + ray * at);
    return hits ? at : missed;
}

/// A random point on the disc of a radius around the origin that is perpendicular to the line of sight.
glm::dvec3 target_on_disc(RandomGenerator& dice, const glm::dvec3& eye_m, double radius_m) {
    const glm::dvec3 ahead = glm::normalize(eye_m);
    const glm::dvec3 aside = std::abs(ahead.x) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, ahead));
    const glm::dvec3 up = glm::cross(ahead, right);
    const double from_middle_m = radius_m * std::sqrt(dice.next());
    const double angle_rad = dice.between(0.0, 2.0 * pi);
    return right * (from_middle_m * std::cos(angle_rad)) + up * (from_middle_m * std::sin(angle_rad));
}

/// A ball that holds a model: about the origin, or about the model's own middle where the origin lies outside of the
/// model.
struct Ball {
    glm::dvec3 middle_m{0.0};
    double radius_m = 0.0;
};

Ball ball_around(const models::polygons::PolygonModel& model) {
    glm::dvec3 least(std::numeric_limits<double>::max());
    glm::dvec3 most(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& vertex_m : model.vertices_m) {
        least = glm::min(least, vertex_m);
        most = glm::max(most, vertex_m);
    }
    const Ball own{(least + most) / 2.0, glm::distance(least, most) / 2.0};
    const bool is_off = glm::length(own.middle_m) > own.radius_m;
    return is_off ? own : Ball{glm::dvec3(0.0), models::polygons::radius_m(model)};
}

/// Random eyes and rays, and what they see.
class RaySampler {
public:
    RaySampler(const models::polygons::PolygonModel& model, const RaySampling& samples,
        std::span<const std::uint32_t> two_sided)
        : samples_(samples), ball_(ball_around(model)), dice_(samples.seed) {
        for (std::size_t i = 0; i < model.polygons.size(); ++i) {
            facets_.push_back(facet_of(model, i, samples.turn_rad));
        }
        for (const std::uint32_t polygon : two_sided) { facets_[polygon].two_sided = true; }
        hit_.resize(facets_.size());
    }

    /// The next random eye, body axes.
    glm::dvec3 next_eye_m() {
        glm::dvec3 direction = dice_.direction();
        if (samples_.octant >= 0) { direction = glm::abs(direction) * draworder::octant_signs(samples_.octant); }
        const double spread = std::log(samples_.max_distance_radii / samples_.min_distance_radii);
        const double away_m = ball_.radius_m * samples_.min_distance_radii * std::exp(spread * dice_.next());
        return ball_.middle_m + direction * away_m;
    }

    /// Sends rays from an eye and compares what is painted last with what is nearest.
    void look(const glm::dvec3& eye_m, std::span<const std::uint32_t> painted, RayTestCounts& count) {
        const glm::dvec3 from_middle_m = eye_m - ball_.middle_m;
        const double away_m = glm::length(from_middle_m);
        find_visible(eye_m);
        for (int i = 0; i < samples_.rays_per_eye; ++i) {
            const glm::dvec3 ray =
                away_m < ball_.radius_m
                    ? dice_.direction()
                    : glm::normalize(target_on_disc(dice_, from_middle_m, ball_.radius_m) - from_middle_m);
            double nearest = missed;
            for (const auto& [polygon, height_m] : seen_) {
                hit_[polygon] = hit_m(facets_[polygon], height_m, eye_m, ray);
                nearest = std::min(nearest, hit_[polygon]);
            }
            if (nearest == missed) { continue; }
            const auto last =
                std::find_if(painted.rbegin(), painted.rend(), [&](std::uint32_t p) { return hit_[p] != missed; });
            const double seen = last == painted.rend() ? missed : hit_[*last];
            ++count.hits;
            count.wrong += seen - nearest > 1e-9 * std::max(away_m, ball_.radius_m) ? 1 : 0;
        }
    }

private:
    /// Finds the facets that an eye sees.
    void find_visible(const glm::dvec3& eye_m) {
        seen_.clear();
        std::ranges::fill(hit_, missed);
        for (std::uint32_t i = 0; i < facets_.size(); ++i) {
            if (const auto height_m = height_above_m(facets_[i], eye_m)) { seen_.push_back({i, *height_m}); }
        }
    }

    struct RayHitResult {
        std::uint32_t polygon = 0;
        double height_m = 0.0;
    };

    RaySampling samples_;
    Ball ball_;
    RandomGenerator dice_;
    std::vector<Facet> facets_;
    std::vector<RayHitResult> seen_; ///< By the eye that looks.
    std::vector<double> hit_;        ///< By polygon, along the ray that is looked along.
};

} // namespace

RayTestCounts& RayTestCounts::operator+=(const RayTestCounts& other) {
    eyes += other.eyes;
    eyes_without_cell += other.eyes_without_cell;
    hits += other.hits;
    wrong += other.wrong;
    return *this;
}

RayTestCounts count_wrong_rays(
    const models::polygons::PolygonModel& model, const DrawOrder& order, const RaySampling& samples) {
    DrawOrder::Walk walk;
    std::vector<std::uint32_t> painted;
    const PaintedListOfEye painted_from = [&](const glm::dvec3& eye_m) {
        painted.clear();
        order.append_painted(eye_m, walk, painted);
        return std::span<const std::uint32_t>(painted);
    };
    return count_wrong_rays(model, painted_from, samples);
}

RayTestCounts count_wrong_rays(
    const models::polygons::PolygonModel& model, const PaintedListOfEye& painted_from, const RaySampling& samples) {
    RaySampler sampling(model, samples, {});
    RayTestCounts count;
    for (int eye = 0; eye < samples.eyes; ++eye) {
        const glm::dvec3 eye_m = sampling.next_eye_m();
        ++count.eyes;
        sampling.look(eye_m, painted_from(eye_m), count);
    }
    return count;
}

RayTestCounts count_wrong_rays(
    const models::polygons::PolygonModel& model, const CellOrders& orders, const RaySampling& samples) {
    RaySampler sampling(model, samples, orders.two_sided);
    RayTestCounts count;
    if (orders.parts) {
        DrawOrder::Walk walk;
        std::vector<std::uint32_t> painted;
        for (int eye = 0; eye < samples.eyes; ++eye) {
            const glm::dvec3 eye_m = sampling.next_eye_m();
            painted.clear();
            orders.parts->append_painted(eye_m, walk, painted);
            ++count.eyes;
            sampling.look(eye_m, painted, count);
        }
        return count;
    }
    for (int eye = 0; eye < samples.eyes; ++eye) {
        const glm::dvec3 eye_m = sampling.next_eye_m();
        if (!in_range(orders, eye_m)) { continue; }
        if (const auto cell = cell_of(orders, eye_m)) {
            ++count.eyes;
            sampling.look(eye_m, orders.cells[*cell].list, count);
        } else {
            ++count.eyes_without_cell;
        }
    }
    return count;
}

} // namespace octant::visuals::orderfile
