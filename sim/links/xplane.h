#pragma once

#include "sim/links/fix.h"
#include "sim/links/wire_bytes.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace octant::sim::links {

/// The usual port for the UDP output of X-Plane, and the port where X-Plane accepts requests.
inline constexpr std::uint16_t xplane_port = 49003;
inline constexpr std::uint16_t xplane_request_port = 49000;

/// The motion that one X-Plane sends by UDP: as DATA, the groups ticked "network via UDP", of which 20 (position) moves
/// it and 1 (times), 17 (attitude), 21 or 3 and 18 (velocity) complete it, in the same or in other packets; or as RREF,
/// the answers to xplane_requests(). Positions have single precision, steps of half a metre; if group 21 or an answer
/// has the local metres too, the motion between packets comes from them.
class XPlanePose {
public:
    /// Reads a packet. Sets `fix` if the packet completes one and the result has no fault. A packet without a position
    /// is Unused.
    DecodeResult take(Bytes datagram, std::optional<Fix>& fix);

private:
    void take_group(std::int32_t group, const WireReader& row);
    bool take_answer(std::int32_t number, float value);
    Fix complete();
    void smooth(Fix& fix);

    /// Values of X-Plane since the last fix: degrees, metres, m/s; local axes are x east, y up, z south.
    struct ReceivedValues {
        std::optional<glm::dvec3> place; ///< latitude, longitude, height above the sea
        std::optional<double> above_ground_m;
        std::optional<glm::dvec3> local_m;
        std::optional<glm::dvec3> local_mps;
        std::optional<double> ground_speed_mps;
        std::optional<glm::dvec2> path_deg; ///< over the ground from true north, and up
        std::optional<glm::dvec3> body_rates_degps;
        std::optional<double> time_s;
    };

    ReceivedValues received_;
    glm::dvec3 attitude_deg_{0.0}; ///< pitch, roll, true heading
    std::optional<double> last_time_s_;
    std::optional<glm::dvec3> last_local_m_;
    glm::dvec3 smooth_{0.0}; ///< smoothed position of the last fix
};

/// The packets, one per value and 413 bytes each, that request `per_second` answers per second for XPlanePose; 0 ends
/// them.
std::vector<std::vector<std::byte>> xplane_requests(int per_second);

/// A packet of DATA with groups 1, 3, 17, 18, 20 and 21, as X-Plane 11 and 12 send it. The origin of the local axes is
/// `origin`. Air is still and standard.
std::vector<std::byte> encode_xplane(const Fix& fix, const Geodetic& origin, double time_s);

/// Message about a packet.
std::string xplane_text(const DecodeResult& result);

} // namespace octant::sim::links
