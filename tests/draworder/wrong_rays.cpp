#include "wrong_rays.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace octant::tests {

namespace {

constexpr double missed = std::numeric_limits<double>::infinity();

/// A polygon as inner half-spaces, for quick ray tests.
struct Facet {
    glm::dvec3 normal{0.0};
    glm::dvec3 point_m{0.0};
    std::vector<glm::dvec3> corners_m;
    std::vector<glm::dvec3> inward;
};

Facet facet_of(const models::PolygonModel& model, std::size_t polygon) {
    Facet facet;
    facet.normal = models::normal_of(model, polygon);
    for (const std::uint32_t vertex : model.corners(polygon)) {
        facet.corners_m.push_back(model.vertices_m[vertex]);
    }
    facet.point_m = facet.corners_m[0];
    for (std::size_t i = 0; i < facet.corners_m.size(); ++i) {
        const glm::dvec3& next = facet.corners_m[(i + 1) % facet.corners_m.size()];
        facet.inward.push_back(glm::cross(facet.normal, next - facet.corners_m[i]));
    }
    return facet;
}

/// Distance along the ray to the facet's front.
double front_hit(const Facet& facet, const glm::dvec3& eye_m, const glm::dvec3& ray) {
    const double slope = glm::dot(ray, facet.normal);
    const double height_m = glm::dot(eye_m - facet.point_m, facet.normal);
    if (slope >= 0.0 || height_m <= 0.0) {
        return missed;
    }
    const double at = -height_m / slope;
    const glm::dvec3 hit_m = eye_m + ray * at;
    for (std::size_t i = 0; i < facet.inward.size(); ++i) {
        if (glm::dot(hit_m - facet.corners_m[i], facet.inward[i]) < 0.0) {
            return missed;
        }
    }
    return at;
}

/// A target on the disc of radius R around the origin, across the line of sight.
glm::dvec3 target_on_disc(Dice& dice, const glm::dvec3& eye_m, double radius_m) {
    const glm::dvec3 ahead = glm::normalize(eye_m);
    const glm::dvec3 aside = std::abs(ahead.x) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, ahead));
    const glm::dvec3 up = glm::cross(ahead, right);
    const double from_middle_m = radius_m * std::sqrt(dice.next());
    const double angle_rad = dice.between(0.0, 2.0 * pi);
    return right * (from_middle_m * std::cos(angle_rad)) +
           up * (from_middle_m * std::sin(angle_rad));
}

} // namespace

glm::dvec3 Dice::direction() {
    const double z = between(-1.0, 1.0);
    const double angle_rad = between(0.0, 2.0 * pi);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle_rad), across * std::sin(angle_rad), z};
}

models::PolygonModel paper_example() {
    models::PolygonModel model;
    model.name = "concave";
    model.vertices_m = {
        {-100, 40, 50},
        {-100, 40, -50},
        {0, 40, 50},
        {0, 40, -50},
        {0, 0, 50},
        {0, 0, -50},
        {100, 0, 50},
        {100, 0, -50},
        {-100, -40, 50},
        {-100, -40, -50},
        {100, -40, 50},
        {100, -40, -50},
        {0, -40, 50},
        {0, -40, -50}};
    constexpr std::array<std::array<std::uint32_t, 4>, 10> polygons{
        {{1, 3, 4, 2},
         {3, 5, 6, 4},
         {5, 7, 8, 6},
         {7, 11, 12, 8},
         {1, 2, 10, 9},
         {9, 10, 12, 11},
         {1, 9, 13, 3},
         {5, 13, 11, 7},
         {2, 4, 14, 10},
         {6, 8, 12, 14}}};
    for (const auto& corners : polygons) {
        models::Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size());
        polygon.corner_count = 4;
        for (const std::uint32_t corner : corners) {
            model.corner_vertices.push_back(corner - 1);
        }
        model.polygons.push_back(polygon);
    }
    model.materials.emplace_back();
    model.parts.emplace_back("default");
    return model;
}

RayCount count_wrong_rays(
    const models::PolygonModel& model,
    const visuals::draworder::DrawOrder& order,
    const EyeSamples& samples) {
    std::vector<Facet> facets;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        facets.push_back(facet_of(model, i));
    }
    const double radius_m = models::radius_m(model);
    const double spread = std::log(samples.most_distance_radii / samples.least_distance_radii);
    std::vector<double> hit(facets.size());
    Dice dice(samples.seed);
    RayCount count;
    for (int eye = 0; eye < samples.eyes; ++eye) {
        glm::dvec3 direction = dice.direction();
        if (samples.octant >= 0) {
            direction = glm::abs(direction) * visuals::draworder::octant_signs(samples.octant);
        }
        const double distance_m =
            radius_m * samples.least_distance_radii * std::exp(spread * dice.next());
        const glm::dvec3 eye_m = direction * distance_m;
        const auto painted = order.polygons_of(order.cell_of(eye_m));
        for (int i = 0; i < samples.rays_per_eye; ++i) {
            const glm::dvec3 ray = glm::normalize(target_on_disc(dice, eye_m, radius_m) - eye_m);
            std::ranges::transform(
                facets, hit.begin(), [&](const Facet& f) { return front_hit(f, eye_m, ray); });
            const double nearest = *std::ranges::min_element(hit);
            if (nearest == missed) {
                continue;
            }
            double seen = missed;
            for (const std::uint32_t polygon : painted) {
                seen = hit[polygon] == missed ? seen : hit[polygon];
            }
            ++count.hits;
            count.wrong += seen - nearest > 1e-9 * distance_m ? 1 : 0;
        }
    }
    return count;
}

} // namespace octant::tests
