#pragma once

#include "sim/links/cigi_packets.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace octant::sim::links {

// CIGI 3.3 from image generator to host; each function adds a packet to a message. A message begins with Start of
// Frame.

struct CigiStartOfFrame {
    std::uint32_t ig_frame = 0;
    std::uint32_t host_frame = 0; ///< of the last IG Control
    std::uint32_t timestamp = 0;  ///< 10 microseconds each
    CigiMode mode = CigiMode::Operate;
    std::int8_t database = 0;
};

/// What an answer says of itself.
struct CigiResponseHeader {
    std::uint16_t id = 0;
    bool valid = false;
    std::uint8_t host_frame = 0; ///< its four low bits
};

/// A surface below or before something.
struct CigiSurfacePoint {
    glm::dvec3 place{0.0};      ///< latitude and longitude in degrees, height in metres
    double azimuth_rad = 0.0;   ///< of the normal, from north
    double elevation_rad = 0.0; ///< of the normal
};

void add_start_of_frame(WireWriter& message, const CigiStartOfFrame& frame);

/// The height asked for, HAT or HOT.
void add_height_response(WireWriter& message, const CigiResponseHeader& head, CigiHeightKind kind, double height_m);

/// Both heights, and the surface's normal.
void add_extended_height_response(
    WireWriter& message, const CigiResponseHeader& head, double hat_m, const CigiSurfacePoint& surface);

struct CigiLosResponse {
    bool visible = false;
    std::optional<double> range_m; ///< to what is met, if anything is
    std::optional<CigiSurfacePoint> met;
};

void add_los_response(WireWriter& message, const CigiResponseHeader& head, bool extended, const CigiLosResponse& sight);

/// Where an entity is: latitude and longitude in degrees, height in metres.
void add_position(WireWriter& message, std::uint16_t entity, const glm::dvec3& place, const EulerAngles& angles);

/// Sizes of these packets, to see whether one more fits into a message.
inline constexpr std::size_t cigi_max_response_bytes = 56;

// CIGI 3.3 from host to image generator; each function adds a packet to a message in the writer's byte order. A message
// begins with IG Control. What decode_cigi() reads comes back the same, but for angles and offsets, which are single
// precision on the wire.

void add_ig_control(WireWriter& message, const CigiIgControl& control);
void add_entity(WireWriter& message, const CigiEntityControl& entity);
void add_rate(WireWriter& message, const CigiRateControl& rate);
/// All six components are enabled.
void add_view_control(WireWriter& message, const CigiViewControl& view);
/// The four sides are enabled, near and far planes are left to the image generator.
void add_view_definition(WireWriter& message, const CigiViewDefinition& view);

/// What a message of an image generator begins with; nothing for anything else.
std::optional<CigiStartOfFrame> start_of_frame_of(Bytes message);

} // namespace octant::sim::links
