#include "ui/studies/draw_order/ridge_tower.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace {

constexpr double eye_height_m = 3.0;
constexpr std::array distances_m = {300.0, 600.0, 1000.0, 1600.0, 2500.0};
constexpr int directions = 24;
constexpr double step_m = 20.0;

bool is_hidden(const world::World& world, const glm::dvec3& eye_m, const glm::dvec3& target_m) {
    const double distance_m = glm::distance(eye_m, target_m);
    for (double at_m = step_m; at_m < distance_m; at_m += step_m) {
        const glm::dvec3 point_m = glm::mix(eye_m, target_m, at_m / distance_m);
        const auto ground_m = world.scene.ground->height_at(point_m.x, point_m.y);
        if (ground_m && *ground_m > point_m.z) {
            return true;
        }
    }
    return false;
}

int visibility_changes(
    const world::World& world, const glm::dvec3& eye_m, const std::vector<glm::dvec3>& flight_m) {
    int changes = 0;
    bool hidden = is_hidden(world, eye_m, flight_m.front());
    for (const glm::dvec3& place_m : flight_m) {
        const bool now = is_hidden(world, eye_m, place_m);
        changes += now == hidden ? 0 : 1;
        hidden = now;
    }
    return changes;
}

} // namespace

glm::dvec3 ridge_tower(const world::World& world) {
    constexpr std::size_t every = 5;
    std::vector<glm::dvec3> flight_m;
    glm::dvec3 middle_m(0.0);
    const auto samples = world.flight.trajectory.samples();
    for (std::size_t i = 0; i < samples.size(); i += every) {
        flight_m.push_back(samples[i].position_m);
        middle_m += samples[i].position_m;
    }
    middle_m /= static_cast<double>(flight_m.size());
    glm::dvec3 best_m = middle_m;
    int most = -1;
    for (const double distance_m : distances_m) {
        for (int i = 0; i < directions; ++i) {
            const double angle_rad = 2.0 * pi * i / directions;
            glm::dvec3 eye_m =
                middle_m + distance_m * glm::dvec3(std::sin(angle_rad), std::cos(angle_rad), 0.0);
            const auto ground_m = world.scene.ground->height_at(eye_m.x, eye_m.y);
            if (!ground_m) {
                continue;
            }
            eye_m.z = *ground_m + eye_height_m;
            const int changes = visibility_changes(world, eye_m, flight_m);
            if (changes > most) {
                most = changes;
                best_m = eye_m;
            }
        }
    }
    return best_m;
}

} // namespace octant::ui::studies::draw_order
