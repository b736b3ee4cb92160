#pragma once

#include "visuals/nature/crown.h"
#include "visuals/nature/daylight.h"
#include "visuals/nature/standing_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::nature {

/// A tree or a shrub.
struct Plant {
    PlantKind kind = PlantKind::Broadleaf;
    GroundAnchor anchor;
    float radius_m = 1.0F; ///< of the upright cylinder that holds it
    float height_m = 1.0F;
    float height_px = 1.0F; ///< in the picture
    float fineness = 1.0F;  ///< plants so many times as high in the picture have as many triangles at 1
    float sun = 1.0F;       ///< the share of sunlight that the relief lets through
    std::uint32_t random_bits = 0;
};

/// Makes the triangles of plants under one daylight: a trunk and a crown that has more triangles as it grows in the
/// picture, or in their place a polygon that faces the eye. New triangles grow out of those before them, and far crowns
/// have less contrast, so that nothing pops and little crawls.
class PlantMesher {
public:
    /// Makes the crowns and the light on them: loading work.
    explicit PlantMesher(const Daylight& day);

    /// Appends the triangles of a plant that face the eye, from near to far.
    void add(const Plant& plant, StandingMesh& to) const;

private:
    static constexpr std::size_t kinds = 3;
    static constexpr std::size_t variants = 4;
    static constexpr std::size_t turns = compass_directions.size();

    /// Factors on the two parts of daylight.
    struct Light {
        float ambient = 1.0F;
        float sun = 0.0F;
    };

    struct Species {
        std::vector<Crown> crowns;
        Light mean;
        glm::vec3 leaf{0.0F}; ///< display values, before light falls on it
    };

    /// How a plant's crown space lies around the eye.
    struct Placement;

    Light light_on(const glm::vec3& normal, float openness) const;
    glm::vec3 lit(const Plant& plant, const glm::vec3& own, const Light& light) const;
    glm::vec3 leaf_of(const Plant& plant) const;
    glm::vec3 lit_leaf(const Plant& plant, const glm::vec3& leaf, const Light& light) const;
    Species make_species(PlantKind kind) const;
    void add_crown(const Plant& plant, const Placement& placement, StandingMesh& to) const;
    void add_trunk(const Plant& plant, const Placement& placement, float lowest, StandingMesh& to) const;
    void add_outline(const Plant& plant, StandingMesh& to) const;

    glm::vec3 to_sun_;
    glm::vec3 ambient_;
    glm::vec3 sunlight_;
    std::array<Species, kinds> species_;
};

} // namespace octant::visuals::nature
