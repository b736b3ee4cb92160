#pragma once

#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "sim/links/fix.h"
#include "sim/links/wire_bytes.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace octant::sim::links {

/// The word by which the byte order of a CIGI 3 message is told, as its sender writes it.
inline constexpr std::uint16_t cigi_magic = 0x8000;
inline constexpr std::uint16_t swapped_cigi_magic = 0x0080;

/// Adds a packet of zeros with its opcode and size; says where it begins.
inline std::size_t add_cigi_packet_header(WireWriter& message, std::uint8_t opcode, std::uint8_t size) {
    const std::size_t at = message.size();
    message.add_zeros(size);
    message.set(at, opcode);
    message.set(at + 1, size);
    return at;
}

/// Degrees in single precision.
inline void set_cigi_angle(WireWriter& message, std::size_t at, double angle_rad) {
    message.set(at, static_cast<float>(deg_from_rad(angle_rad)));
}

/// The Common Image Generator Interface 3.3, from host to image generator: what of it is understood. Angles are radians
/// here, places degrees and metres. On the wire each packet begins with its opcode and its size; a message begins with
/// IG Control, by which its byte order is told.
inline constexpr std::uint16_t cigi_port = 8004;

enum class CigiMode : std::uint8_t { Standby = 0, Operate = 1, Debug = 2 };

struct CigiIgControl {
    std::int8_t database = 0;
    CigiMode mode = CigiMode::Standby;
    bool timestamp_valid = false;
    std::uint32_t host_frame = 0;
    std::uint32_t timestamp = 0; ///< 10 microseconds each
    std::uint32_t last_ig_frame = 0;
};

/// A place: latitude and longitude in degrees, height in metres; or metres from a parent along its body axes.
struct CigiEntityControl {
    std::uint16_t entity = 0;
    int state = 0; ///< 0 standby, 1 active, 2 destroyed
    bool attached = false;
    int clamp = 0; ///< 0 none, 1 to the ground's height, 2 to its slope too
    std::uint16_t type = 0;
    std::uint16_t parent = 0;
    EulerAngles attitude;
    glm::dvec3 place{0.0};
};

struct CigiClampedEntity {
    std::uint16_t entity = 0;
    double heading_rad = 0.0;
    glm::dvec3 place{0.0}; ///< without height
};

struct CigiRateControl {
    std::uint16_t entity = 0;
    std::uint8_t part = 0;
    bool of_part = false;
    bool local = false; ///< along the body's axes, else north, east, down
    glm::dvec3 mps{0.0};
    glm::dvec3 radps{0.0}; ///< of roll, pitch, yaw
};

struct CigiArticulatedPart {
    std::uint16_t entity = 0;
    std::uint8_t part = 0;
    bool enabled = false;
    glm::bvec3 moves{false}; ///< x, y, z; others stay as they are
    glm::bvec3 sets{false};  ///< roll, pitch, yaw; likewise
    glm::dvec3 offset_m{0.0};
    EulerAngles angles;
};

/// A time of day, taken as universal, and its date.
struct CigiCelestial {
    bool is_valid = false;
    int hour = 0;
    int minute = 0;
    std::uint32_t date = 0; ///< month, day, year as decimals
};

struct CigiAtmosphere {
    bool enabled = false;
    double visibility_m = 0.0;
};

/// Where a view looks from: offsets along the body axes of its entity and angles from them.
struct CigiViewControl {
    std::uint16_t view = 0;
    std::uint8_t group = 0;
    std::uint16_t entity = 0;
    glm::dvec3 offset_m{0.0};
    EulerAngles angles;
};

/// The sides of a view's frustum, as angles from straight ahead.
struct CigiViewDefinition {
    std::uint16_t view = 0;
    std::uint8_t group = 0;
    glm::bvec4 sets{true}; ///< left, right, top, bottom; others stay as they are
    double left_rad = 0.0; ///< negative to the left
    double right_rad = 0.0;
    double top_rad = 0.0;
    double bottom_rad = 0.0; ///< negative below
    bool parallel = false;   ///< an orthographic projection is asked for
};

enum class CigiHeightKind { Hat = 0, Hot = 1, Extended = 2 };

struct CigiHeightRequest {
    std::uint16_t id = 0;
    CigiHeightKind kind = CigiHeightKind::Hat;
    bool from_entity = false; ///< the place is in metres along the entity's axes
    std::uint8_t period = 0;  ///< frames; 0 = once, and ends what was asked periodically
    std::uint16_t entity = 0;
    glm::dvec3 place{0.0};
};

/// A line of sight between two places, or along a direction.
struct CigiLosRequest {
    std::uint16_t id = 0;
    bool extended = false;
    bool from_entity = false;
    bool to_entity = false;
    bool is_vector = false;
    std::uint8_t period = 0;
    std::uint16_t entity = 0;
    std::uint16_t to = 0; ///< entity of the destination
    bool to_is_given = false;
    glm::dvec3 source{0.0};
    glm::dvec3 destination{0.0};
    double azimuth_rad = 0.0; ///< of a vector: from north or the entity's nose
    double elevation_rad = 0.0;
    double min_m = 0.0;
    double max_m = 0.0;
};

struct CigiPositionRequest {
    std::uint16_t object = 0;
    bool continuous = false;
    int object_class = 0; ///< 0 = an entity
};

/// A packet that is not understood, or whose size is another than its opcode's.
struct CigiUnknownPacket {
    std::uint8_t opcode = 0;
};

using CigiPacket = std::variant<CigiIgControl, CigiEntityControl, CigiClampedEntity, CigiRateControl,
    CigiArticulatedPart, CigiCelestial, CigiAtmosphere, CigiViewControl, CigiViewDefinition, CigiHeightRequest,
    CigiLosRequest, CigiPositionRequest, CigiUnknownPacket>;

/// Reads a whole message of a host. `packets` holds what of it is right, in order; with a fault in the message's form
/// (no IG Control first, a packet that runs over the end) nothing. Packets with numbers that are none are left out.
DecodeResult decode_cigi(Bytes message, std::vector<CigiPacket>& packets);

std::string cigi_text(const DecodeResult& result);

} // namespace octant::sim::links
