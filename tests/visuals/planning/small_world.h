#pragma once

#include "sim/base/random_generator.h"
#include "visuals/planning/planner.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace octant::tests {

/// Random places and attitudes.
class PlaceDice : public RandomGenerator {
public:
    using RandomGenerator::RandomGenerator;

    glm::dvec3 in_box(const glm::dvec3& half) {
        return {between(-half.x, half.x), between(-half.y, half.y), between(-half.z, half.z)};
    }

    /// Any attitude.
    glm::dquat attitude();
};

using Height = std::function<double(double x_m, double y_m)>;

/// Square cells of two triangles over a square map, in painting order for every eye: the rows and in them the cells
/// from the farthest to the eye's own.
std::shared_ptr<const visuals::landscape::Ground> cell_ground(int cells, double cell_m, const Height& height);

using GroundTriangle = std::array<glm::dvec3, 3>;

/// Triangles painted in the order given, above a level of nothing.
std::shared_ptr<const visuals::landscape::Ground> triangle_ground(std::vector<GroundTriangle> triangles);

/// A box around the origin as a model of six polygons.
models::polygons::PolygonModel box_model(const glm::dvec3& half_m);

/// A model as the scene has it, painted in file order: right for convex bodies.
visuals::planning::AircraftModel convex_aircraft(models::polygons::PolygonModel model);

/// The concave example of the 1989 paper scaled down, painted by its eight orders, which are right for every eye.
visuals::planning::AircraftModel concave_aircraft(double scale);

/// Aircraft of these models over a ground; without one there is nothing to see below them.
visuals::planning::Scene small_scene(std::vector<visuals::planning::AircraftModel> models,
    std::vector<std::uint32_t> aircraft, std::shared_ptr<const visuals::landscape::Ground> ground = nullptr);

sim::AircraftState state_at(const glm::dvec3& position_m, const glm::dquat& attitude = {1.0, 0.0, 0.0, 0.0});

/// 640 x 480, no sky, no shadows.
visuals::scene::Settings plain_settings();

} // namespace octant::tests
