#pragma once

#include "sim/links/cigi_packets.h"

#include <glm/gtc/quaternion.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace octant::sim::links {

/// A part of an entity as its host has turned and moved it: a rotor, a flap, a store.
struct CigiPartPose {
    std::uint16_t entity = 0;
    std::uint8_t part = 0;
    glm::dquat turn{1.0, 0.0, 0.0, 0.0}; ///< within the body's axes
    glm::dvec3 offset_m{0.0};            ///< along them
};

/// The articulated parts of a host's entities. Angles and offsets go on by the rates that it gives
/// them.
class CigiArticulatedParts {
public:
    static constexpr std::size_t max_parts = 1024;

    /// Angles and offsets that the packet does not set stay as they are; a part that is not enabled
    /// is the model's own again.
    void take(const CigiArticulatedPart& part, double at_s);

    /// Lets a part that has been told of before go on by these rates.
    void take(const CigiRateControl& rate, double at_s);

    void forget(std::uint16_t entity);

    /// All of them at a time of the clock that take() has.
    std::vector<CigiPartPose> turned(double now_s) const;

private:
    struct Pose {
        glm::dvec3 offset_m{0.0};
        glm::dvec3 angles_rad{0.0}; ///< roll, pitch, yaw
    };

    struct Part {
        Pose pose; ///< at that time
        Pose per_s;
        double at_s = 0.0;
    };

    static Pose pose_at(const Part& part, double now_s);

    std::map<std::pair<std::uint16_t, std::uint8_t>, Part> parts_;
};

} // namespace octant::sim::links
