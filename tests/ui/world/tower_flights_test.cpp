#include "ui/settings/settings.h"
#include "ui/world/world.h"
#include "visuals/landscape/ground.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/tower.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

// What the tower's pictures show over whole flights, by rays of this test's own.

namespace octant {

namespace {

/// How far a ray goes until ground stops it. Beyond the map the ground goes on at its border's height.
std::optional<double> ground_along(
    const visuals::landscape::Ground& ground, const glm::dvec3& from_m, const glm::dvec3& way, double reach_m) {
    double height_m = 0.0;
    for (double along_m = 4.0; along_m < reach_m; along_m += std::max(3.0, 0.01 * along_m)) {
        const glm::dvec3 at_m = from_m + along_m * way;
        height_m = ground.height_at(at_m.x, at_m.y).value_or(height_m);
        if (at_m.z < height_m) { return along_m; }
    }
    return std::nullopt;
}

/// The share of a picture that shows sky, by seven by five rays.
double sky_share(const visuals::landscape::Ground& ground, const visuals::scene::Camera& camera) {
    constexpr double far_m = 30000.0;
    const double half = std::tan(0.5 * camera.vertical_fov_rad);
    int sky = 0;
    int rays = 0;
    for (int column = -3; column <= 3; ++column) {
        for (int row = -2; row <= 2; ++row, ++rays) {
            const glm::dvec3 way = camera.view_to_world *
                                   glm::normalize(glm::dvec3(column / 3.5 * half * 16.0 / 9.0, row / 2.5 * half, -1.0));
            const bool is_ground = way.z < -0.003 || ground_along(ground, camera.eye_m, way, far_m).has_value();
            sky += is_ground ? 0 : 1;
        }
    }
    return static_cast<double>(sky) / rays;
}

/// Counts of a flight's pictures, one a second.
struct Pictures {
    int all = 0;
    int hidden = 0; ///< ground stands before the aircraft
    int small = 0;  ///< the sphere around it fills less than 0.15 of the picture's height
    int relief = 0; ///< a tenth of the picture is sky, a tenth ground
    int no_sky = 0;
};

void count(const char* path, const char* aircraft, const char* terrain, Pictures& pictures) {
    ui::settings::RunSettings settings;
    settings.path.name = path;
    settings.path.aircraft = {aircraft};
    settings.path.terrain = terrain;
    settings.view.kind = visuals::scene::View::Tower;
    const ui::world::World world = ui::world::load_world(settings);
    const visuals::landscape::Ground& ground = *world.scene.ground;
    const double radius_m = world.scene.model_of(0).subject.radius_m;
    const sim::Trajectory& flight = world.flight.trajectory;
    for (double time_s = flight.start_s(); time_s < flight.end_s(); time_s += 1.0) {
        const glm::dvec3 at_m = flight.state_at(time_s).position_m;
        const visuals::scene::Camera camera = visuals::scene::tower_camera(world.points.tower, at_m, radius_m);
        const double distance_m = glm::distance(camera.eye_m, at_m);
        const glm::dvec3 way = (at_m - camera.eye_m) / distance_m;
        const double size = radius_m / (distance_m * std::tan(0.5 * camera.vertical_fov_rad));
        const double sky = sky_share(ground, camera);
        ++pictures.all;
        pictures.hidden += ground_along(ground, camera.eye_m, way, distance_m - radius_m) ? 1 : 0;
        pictures.small += size < 0.15 ? 1 : 0;
        pictures.relief += sky >= 0.1 && sky <= 0.9 ? 1 : 0;
        pictures.no_sky += sky == 0.0 ? 1 : 0;
    }
}

} // namespace

TEST_CASE("over whole flights the tower sees the aircraft, large, and mostly relief and sky") {
    Pictures pictures;
    for (const char* path : {"straight", "jinking", "pop-up", "turn"}) {
        count(path, "f15", "hills", pictures);
        count(path, "500md", "canyon", pictures);
    }
    REQUIRE(pictures.all > 200);
    INFO(pictures.small << " small, " << pictures.relief << " before relief and sky, " << pictures.no_sky
                        << " without sky, of " << pictures.all);
    CHECK(pictures.hidden == 0);
    CHECK(pictures.small < 0.05 * pictures.all);
    CHECK(pictures.relief > 0.7 * pictures.all);
    CHECK(pictures.no_sky < 0.1 * pictures.all);
}

} // namespace octant
