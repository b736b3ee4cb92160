#pragma once

#include <optional>
#include <vector>

#include "small_world.h"

namespace octant::tests {

/// What one sight line meets.
struct Sight {
    double painted_m = 0.0; ///< what the plan's order leaves on top; infinite: nothing
    double nearest_m = 0.0; ///< what is nearest of all that the plan paints
};

/// Paints a plan without depth, one sight line at a time.
class PlanPainter {
public:
    PlanPainter(const visuals::scene::FramePlan& plan, const visuals::planning::Scene& scene);

    /// Along a ray from the eye, world axes, distances in multiples of its length. Nothing where the ray passes so
    /// close to an edge that rounding decides what it meets.
    std::optional<Sight> look(const glm::dvec3& ray) const;

private:
    struct Triangle {
        glm::dvec3 a;
        glm::dvec3 b;
        glm::dvec3 c;
        const visuals::scene::Clip* clip = nullptr;
        bool again = false; ///< painted once more: tells nothing new of what is nearest
    };

    void add_aircraft(const visuals::scene::FramePlan& plan, const visuals::planning::Scene& scene,
        const visuals::scene::PaintStep& step);

    std::vector<Triangle> triangles_; ///< first painted first
};

struct SightCount {
    int seen = 0;
    int wrong = 0;
};

/// Sight lines around the aircraft and between them that a picture of 4:3 shows.
SightCount count_wrong_sights(const visuals::scene::FramePlan& plan, const visuals::planning::Scene& scene,
    const std::vector<sim::AircraftState>& states, const visuals::scene::Camera& camera, PlaceDice& dice);

} // namespace octant::tests
