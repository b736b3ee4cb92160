#include "visuals/nature/houses.h"
#include "visuals/nature/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

using namespace octant::visuals::nature;
using octant::models::ColourVertex;

namespace {

/// The distance at which a line of sight of unit length meets a triangle; 0 if it passes by.
double met_m(const glm::dvec3& way, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double facing = glm::dot(normal, way);
    if (std::abs(facing) < 1e-9) { return 0.0; }
    const double distance_m = glm::dot(normal, a) / facing;
    const glm::dvec3 at = distance_m * way;
    const bool inside = glm::dot(glm::cross(b - a, at - a), normal) >= 0.0 &&
                        glm::dot(glm::cross(c - b, at - b), normal) >= 0.0 &&
                        glm::dot(glm::cross(a - c, at - c), normal) >= 0.0;
    return inside && distance_m > 0.0 ? distance_m : 0.0;
}

struct Triangles {
    std::vector<ColourVertex> vertices;
    std::vector<std::uint32_t> indices;
    StandingMesh mesh{vertices, indices};

    glm::dvec3 corner(std::size_t index) const { return glm::dvec3(vertices[indices[index]].position_m); }

    /// Distances of the triangles that a line of sight meets, in their order.
    std::vector<double> met(const glm::dvec3& way) const {
        std::vector<double> distances_m;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const double distance_m = met_m(way, corner(i), corner(i + 1), corner(i + 2));
            if (distance_m > 0.0) { distances_m.push_back(distance_m); }
        }
        return distances_m;
    }
};

/// Places and sizes from all sides.
struct Views {
    std::mt19937 random{7};

    double between(double low, double high) { return std::uniform_real_distribution(low, high)(random); }

    std::uint32_t bits() { return static_cast<std::uint32_t>(random()); }

    GroundAnchor anchor(double distance_m, double max_slope) {
        const double azimuth_rad = between(0.0, 6.283);
        const double down_rad = between(-0.4, 1.5);
        const glm::dvec3 at_m(std::cos(down_rad) * std::cos(azimuth_rad), std::cos(down_rad) * std::sin(azimuth_rad),
            -std::sin(down_rad));
        return {
            glm::vec3(at_m * distance_m), glm::vec2(between(-max_slope, max_slope), between(-max_slope, max_slope))};
    }

    Plant plant() {
        Plant plant;
        plant.kind = static_cast<PlantKind>(random() % 3);
        plant.random_bits = bits();
        plant.radius_m = static_cast<float>(between(1.0, 5.0));
        plant.height_m = static_cast<float>(between(1.0, 4.0)) * plant.radius_m;
        plant.height_px = static_cast<float>(std::exp(between(1.0, 6.5)));
        plant.anchor = anchor(between(2.0, 12.0) * static_cast<double>(plant.height_m), 0.45);
        return plant;
    }
};

/// Whether the eye is above the ground of a thing: nobody sees it from below.
bool is_above(const GroundAnchor& anchor) {
    return -anchor.at_m.z > anchor.height_at_offset_m(-glm::vec2(anchor.at_m)) + 1.0F;
}

} // namespace

TEST_CASE("what is painted of a plant or a house comes from near to far for every eye, and has no holes") {
    PlantMesher mesher(Daylight({}));
    Views views;
    int sights = 0;
    int several = 0;
    for (int trial = 0; trial < 600; ++trial) {
        Triangles triangles;
        glm::vec3 middle_m;
        double inside_m = 0.0;
        if (trial % 6 == 0) {
            House house{views.anchor(views.between(15.0, 60.0), 0.05)};
            house.random_bits = views.bits();
            house.height_px = 80.0F;
            if (!is_above(house.anchor)) { continue; }
            add_house(house, Daylight({}), triangles.mesh);
            middle_m = house.anchor.at_m + glm::vec3(0.0F, 0.0F, 0.4F * house_height_m);
            inside_m = 2.0;
        } else {
            const Plant plant = views.plant();
            if (!is_above(plant.anchor)) { continue; }
            mesher.add(plant, triangles.mesh);
            middle_m = plant.anchor.at_m + glm::vec3(0.0F, 0.0F, 0.5F * plant.height_m);
            inside_m = 0.3 * std::min(static_cast<double>(plant.radius_m), 0.5 * static_cast<double>(plant.height_m));
        }
        for (int sight = 0; sight < 60; ++sight) {
            const glm::dvec3 aside(views.between(-1.0, 1.0), views.between(-1.0, 1.0), views.between(-1.0, 1.0));
            const double spread = sight % 2 == 0 ? inside_m : 4.0 * inside_m;
            const glm::dvec3 way = glm::normalize(glm::dvec3(middle_m) + 0.577 * spread * aside);
            const std::vector<double> met_m = triangles.met(way);
            ++sights;
            several += met_m.size() > 1 ? 1 : 0;
            INFO("trial " << trial);
            if (sight % 2 == 0) { REQUIRE_FALSE(met_m.empty()); }
            for (std::size_t i = 1; i < met_m.size(); ++i) { REQUIRE(met_m[i] > met_m[i - 1] - 1e-3 * met_m[i]); }
        }
    }
    CHECK(sights > 10'000);
    CHECK(several > 200);
}

TEST_CASE("from the side a conifer narrows upwards, in steps where its boughs end") {
    PlantMesher mesher(Daylight({}));
    Views views;
    for (const auto& [height_px, min_steps] : {std::pair{50.0F, 0}, {110.0F, 2}, {300.0F, 6}}) {
        Plant plant{PlantKind::Conifer, {glm::vec3(60.0F, 0.0F, -6.0F), glm::vec2(0.0F)}, 3.0F, 13.0F, height_px};
        plant.random_bits = views.bits();
        Triangles triangles;
        mesher.add(plant, triangles.mesh);
        // How far what is seen reaches to the left, at a height over the foot.
        const auto left_m = [&](double height_m) {
            double widest_m = 0.0;
            for (std::size_t i = 0; i < triangles.indices.size(); ++i) {
                const glm::dvec3 a = triangles.corner(i);
                const glm::dvec3 b = triangles.corner(i % 3 == 2 ? i - 2 : i + 1);
                const double share = (height_m - 6.0 - a.z) / (b.z - a.z);
                if (share >= 0.0 && share <= 1.0) { widest_m = std::max(widest_m, a.y + share * (b.y - a.y)); }
            }
            return widest_m;
        };
        INFO(height_px);
        CHECK(left_m(3.5) > 1.3 * left_m(6.5));
        CHECK(left_m(6.5) > 1.3 * left_m(10.0));
        int steps = 0;
        bool was_growing = false;
        for (double height_m = 3.0; height_m < 12.0; height_m += 0.02) {
            const bool is_growing = left_m(height_m + 0.02) > left_m(height_m) + 1e-4;
            steps += is_growing && !was_growing ? 1 : 0;
            was_growing = is_growing;
        }
        CHECK(steps >= min_steps);
    }
}

TEST_CASE("no ground is seen between a broad-leaved tree's crown and its trunk") {
    PlantMesher mesher(Daylight({}));
    Views views;
    int gaps = 0;
    for (int i = 0; i < 400; ++i) {
        Plant plant{PlantKind::Broadleaf, {glm::vec3(60.0F, 0.0F, -3.0F), glm::vec2(0.0F)}, 3.0F, 9.0F, 40.0F};
        plant.height_px = 40.0F + static_cast<float>(i % 8) * 10.0F;
        plant.random_bits = views.bits();
        Triangles triangles;
        mesher.add(plant, triangles.mesh);
        // Beside the axis, as a line of sight along an edge meets nothing.
        const auto is_ground = [&](double height_m) {
            return triangles.met(glm::dvec3(60.0, 0.043, height_m - 3.0)).empty();
        };
        constexpr double step_m = 0.05;
        for (double height_m = 0.1; height_m < 6.0; height_m += step_m) {
            gaps += is_ground(height_m) && is_ground(height_m + step_m) ? 1 : 0;
        }
    }
    CHECK(gaps == 0);
}

TEST_CASE("leaves show the pattern of closed woods, less of it far away, trunks and houses none") {
    PlantMesher mesher(Daylight({}));
    for (const PlantKind kind : {PlantKind::Broadleaf, PlantKind::Conifer, PlantKind::Shrub}) {
        std::uint32_t least = 24;
        for (const float height_px : {10.0F, 30.0F, 60.0F, 100.0F, 300.0F}) {
            Triangles triangles;
            mesher.add({kind, {glm::vec3(60.0F, 0.0F, -6.0F), glm::vec2(0.0F)}, 3.0F, 9.0F, height_px}, triangles.mesh);
            INFO(height_px);
            for (const ColourVertex& vertex : triangles.vertices) {
                // Only trunks, which are brown, have more red than green.
                const bool is_trunk = (vertex.colour & 0xffU) > (vertex.colour >> 8U & 0xffU);
                const std::uint32_t covers = vertex.colour >> 24U;
                REQUIRE((is_trunk ? covers == 0 : covers >= least && covers <= 64));
                least = std::max(least, covers);
            }
        }
        CHECK(least == 64);
    }
    Triangles triangles;
    add_house({{glm::vec3(30.0F, 0.0F, -6.0F), glm::vec2(0.0F)}}, Daylight({}), triangles.mesh);
    for (const ColourVertex& vertex : triangles.vertices) { REQUIRE(vertex.colour >> 24U == 0); }
}

TEST_CASE("plants and houses stay within their circles and above their ground") {
    PlantMesher mesher(Daylight({}));
    Views views;
    for (int trial = 0; trial < 500; ++trial) {
        Triangles triangles;
        GroundAnchor anchor;
        float radius_m = 0.0F;
        float height_m = 0.0F;
        if (trial % 6 == 0) {
            House house{views.anchor(40.0, 0.05)};
            house.random_bits = views.bits();
            add_house(house, Daylight({}), triangles.mesh);
            anchor = house.anchor;
            radius_m = house_radius * house.half_m;
            height_m = house_height_m;
        } else {
            const Plant plant = views.plant();
            mesher.add(plant, triangles.mesh);
            anchor = plant.anchor;
            radius_m = plant.radius_m;
            height_m = plant.height_m;
        }
        for (const ColourVertex& vertex : triangles.vertices) {
            const glm::vec3 off_m = vertex.position_m - anchor.at_m;
            const float ground_m = anchor.height_at_offset_m(glm::vec2(off_m));
            REQUIRE(glm::length(glm::vec2(off_m)) <= radius_m * 1.0001F);
            REQUIRE(off_m.z > ground_m - 1e-4F * height_m);
            REQUIRE(off_m.z < height_m + std::max(ground_m, 0.0F) + 1e-3F);
        }
    }
}

TEST_CASE("plants do not change suddenly as they grow in the picture") {
    PlantMesher mesher(Daylight({}));
    Views views;
    for (int trial = 0; trial < 40; ++trial) {
        Plant plant = views.plant();
        plant.anchor.at_m = glm::vec3(30.0F, 10.0F, -8.0F);
        // Beside the axis, as a line of sight along an edge meets nothing.
        const glm::dvec3 middle_m = glm::dvec3(plant.anchor.at_m + glm::vec3(0.05F, -0.07F, 0.5F * plant.height_m));
        for (const float px : {70.0F, 100.0F, 105.0F, 160.0F}) {
            std::vector<double> distances_m;
            for (const float height_px : {px * 0.9999F, px * 1.0001F}) {
                Triangles triangles;
                plant.height_px = height_px;
                mesher.add(plant, triangles.mesh);
                const std::vector<double> met_m = triangles.met(glm::normalize(middle_m));
                REQUIRE_FALSE(met_m.empty());
                distances_m.push_back(met_m[0]);
            }
            INFO("trial " << trial << " at " << px);
            CHECK(std::abs(distances_m[0] - distances_m[1]) < 0.01 * static_cast<double>(plant.radius_m));
        }
    }
}
