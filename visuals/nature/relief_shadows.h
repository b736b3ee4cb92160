#pragma once

#include "visuals/terrain/ground_query.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace octant::visuals::nature {

/// What the relief leaves of the light at a place, 0..1.
struct LightVisibility {
    float sun = 1.0F; ///< 0 in the shadow of other ground
    float sky = 1.0F; ///< of the light from everywhere; less in hollows
};

/// Shadows of the ground on itself and the light in its hollows, worked out once for a place of the sun, on at most
/// 1,025 x 1,025 places.
class ReliefShadows {
public:
    /// `to_sun` is a unit vector in world axes. The ground is needed by the constructor alone. `same_ground`: the
    /// shadows of the same ground under another sun, with which the light in hollows is shared; null = none.
    ReliefShadows(
        const terrain::GroundSamples& ground, const glm::dvec3& to_sun, const ReliefShadows* same_ground = nullptr);

    /// At a place in metres east and north of the ground's first sample, as the mean over about `footprint_m`.
    LightVisibility at(float east_m, float north_m, float footprint_m) const;

private:
    /// Shares of light, 255 = all of it. Each level has every second place of the one before, as the mean of its
    /// surroundings there.
    struct MipLevel {
        int columns = 0;
        int rows = 0;
        std::vector<std::uint8_t> shares; ///< row after row from the south
    };

    using MipLevels = std::vector<MipLevel>;

    static void soften(MipLevel& level);
    static void add_coarser_levels(MipLevels& levels);

    float spacing_m_; ///< of the first level
    MipLevels sun_;
    std::shared_ptr<const MipLevels> sky_;
};

} // namespace octant::visuals::nature
