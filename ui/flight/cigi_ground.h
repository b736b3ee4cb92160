#pragma once

#include "sim/links/cigi_image_generator.h"
#include "ui/flight/live_georeference.h"
#include "ui/world/world.h"

namespace octant::ui::flight {

/// What CIGI hosts ask of the ground of a run, by the place that it has on the earth. Until that is
/// known nothing is inside the database. World and place must outlive this.
class WorldCigiGround final : public sim::links::CigiGround {
public:
    WorldCigiGround(const world::World& world, const LiveGeoreference& place)
        : world_(world)
        , place_(place) {}

    std::optional<sim::links::CigiSurfacePoint> below(const glm::dvec3& place) const override;

    /// Looked for in steps of at most 2 m, or of a ten-thousandth of the line, then halved.
    std::optional<TerrainHit> first_hit(const glm::dvec3& from, const glm::dvec3& to) const override;

    double distance_m(const glm::dvec3& from, const glm::dvec3& to) const override;

    glm::dvec3 moved(const glm::dvec3& place, const glm::dvec3& ned_m) const override;

private:
    const EarthFrame& frame() const;
    glm::dvec3 world_position(const glm::dvec3& place) const;
    glm::dvec3 geodetic_position(const glm::dvec3& at_m) const;
    std::optional<double> height_m(const glm::dvec3& at_m) const;

    const world::World& world_;
    const LiveGeoreference& place_;
};

} // namespace octant::ui::flight
