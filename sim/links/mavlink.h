#pragma once

#include "sim/base/earth_frame.h"
#include "sim/links/fix.h"
#include "sim/links/wire_bytes.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace octant::sim::links {

inline constexpr std::uint16_t mavlink_port = 14550;

/// The messages that hold a pose.
enum class MavLinkKind : std::uint32_t {
    Heartbeat = 0,
    Attitude = 30,
    GlobalPositionInt = 33,
    HilStateQuaternion = 115
};

/// One frame of MAVLink 1 or 2 whose check sum is right.
struct MavLinkFrame {
    MavLinkKind kind = MavLinkKind::Heartbeat;
    std::uint8_t system = 0;
    /// As long as its kind says: zeros that version 2 cuts off stand there again.
    std::vector<std::byte> payload;
};

/// Reads the frame at the beginning of `bytes` and says how long it is; where none begins there, the length is that of
/// what is to be skipped, at least 1. Frames of other kinds are Unused with their number as DecodeResult::got; their
/// check sums cannot be told.
struct MavLinkParse {
    DecodeResult result;
    std::size_t length = 0;
    std::optional<MavLinkFrame> frame;
    /// Of frames whose result is None or Unused.
    std::uint8_t system = 0;
    std::uint8_t component = 0;
    std::uint8_t sequence = 0; ///< counts the frames of a component on one link
};

MavLinkParse parse_mavlink(Bytes bytes);

/// The pose of one system, from one kind of message: HIL_STATE_QUATERNION where that ever comes, else ATTITUDE over the
/// positions of GLOBAL_POSITION_INT, which tell the height of its home to both.
class MavLinkPose {
public:
    /// A fix where the message completes one. Attitudes between positions carry these on over the ellipsoid.
    std::optional<Fix> take(const MavLinkFrame& frame, const Ellipsoid& ellipsoid = wgs84);

private:
    std::optional<Fix> take_hil(const MavLinkFrame& frame);
    std::optional<Fix> take_position(const MavLinkFrame& frame);
    std::optional<Fix> take_attitude(const MavLinkFrame& frame, const Ellipsoid& ellipsoid);

    bool hil_ = false;
    std::optional<Fix> position_;
    std::optional<double> attitude_s_;
};

std::string mavlink_text(const DecodeResult& result);

} // namespace octant::sim::links
