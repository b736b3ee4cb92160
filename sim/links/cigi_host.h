#pragma once

#include "sim/links/cigi_packets.h"
#include "sim/links/cigi_responses.h"

#include <optional>

namespace octant::sim::links {

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
