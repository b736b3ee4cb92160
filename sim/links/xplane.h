#pragma once

#include "sim/links/fix.h"
#include "sim/links/wire_bytes.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace octant::sim::links {

/// Where programs usually listen for X-Plane's UDP output, and where X-Plane takes requests.
inline constexpr std::uint16_t xplane_port = 49003;
inline constexpr std::uint16_t xplane_request_port = 49000;

/// The motion that one X-Plane sends by UDP: as DATA, the groups that are ticked "network via UDP", of which 20 (place)
/// moves it and 1 (times), 17 (attitude), 21 or 3 and 18 (velocity) complete it, in the same packet or in others; or as
/// RREF, the answers to xplane_requests(). Places come in single precision, steps of half a metre; where group 21 or an
/// answer tells the local metres too, the motion between packets is theirs.
class XPlanePose {
public:
    /// Reads a packet. `fix` is set where it completes one and the result has no fault. A packet without a place is
    /// Unused.
    DecodeResult take(Bytes datagram, std::optional<Fix>& fix);

private:
    void take_group(std::int32_t group, const WireReader& row);
    bool take_answer(std::int32_t number, float value);
    Fix complete();
    void smooth(Fix& fix);

    /// Values as X-Plane has them since the last fix: degrees, metres, m/s; the local axes are x east, y up, z south.
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
    glm::dvec3 smooth_{0.0}; ///< the place of the last fix
};

/// The packets that ask an X-Plane for the answers that XPlanePose takes, so many a second; 0 ends them. One for each
/// value, 413 bytes.
std::vector<std::vector<std::byte>> xplane_requests(int per_second);

/// A packet of DATA with groups 1, 3, 17, 18, 20 and 21, as X-Plane 11 and 12 send it. The origin of the local axes is
/// `origin`. Air is still and standard.
std::vector<std::byte> encode_xplane(const Fix& fix, const Geodetic& origin, double time_s);

/// What a person should be told of a packet.
std::string xplane_text(const DecodeResult& result);

} // namespace octant::sim::links
