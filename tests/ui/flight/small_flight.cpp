#include "small_flight.h"

#include "models/heights/height_field.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "sim/base/axes.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/planning/aircraft_model.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace octant::tests {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

planning::AircraftModel tetrahedron() {
    models::TriangleMesh mesh;
    mesh.vertices_m = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    models::polygons::PolygonModel polygons = models::polygons::polygons_from_mesh(mesh);
    visuals::draworder::DrawOrder order = visuals::draworder::file_order(polygons);
    return planning::aircraft_model(std::move(polygons), std::move(order), glm::dvec3(0.0));
}

} // namespace

sim::Trajectory straight_flight(const glm::dvec3& from_m, const glm::dvec3& velocity_mps, double length_s) {
    constexpr double rate_hz = 20.0;
    const double heading_rad = std::atan2(velocity_mps.x, velocity_mps.y);
    std::vector<sim::AircraftState> samples;
    for (int i = 0; i <= static_cast<int>(std::lround(length_s * rate_hz)); ++i) {
        sim::AircraftState& state = samples.emplace_back();
        state.time_s = i / rate_hz;
        state.position_m = from_m + state.time_s * velocity_mps;
        state.velocity_mps = velocity_mps;
        state.body_to_world = body_to_world_from_euler({heading_rad, 0.0, 0.0});
    }
    return sim::Trajectory(std::move(samples));
}

std::shared_ptr<const landscape::Ground> ground_with_plateau(double height_m) {
    constexpr int side = 41;
    constexpr double spacing_m = 100.0;
    std::vector<float> heights_m(side * side, 0.0F);
    std::fill(heights_m.begin() + 3 * side * side / 4, heights_m.end(), static_cast<float>(height_m));
    scene::GroundSettings by_quadtree;
    by_quadtree.lod.metric = visuals::terrain::GroundMetric::Midpoint;
    return landscape::make_field_ground({side, side, spacing_m, std::move(heights_m)}, by_quadtree, {});
}

ui::world::World small_world(int aircraft) {
    ui::world::World world;
    world.scene.ground = ground_with_plateau(0.0);
    world.scene.add_model(tetrahedron());
    world.scene.aircraft.assign(static_cast<std::size_t>(aircraft), 0);
    world.flight.trajectory = straight_flight({0, -500, 300}, {0, 100, 0}, 10.0);
    return world;
}

} // namespace octant::tests
