#pragma once

#include "sim/links/fix.h"
#include "sim/links/wire_bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace octant::sim::links {

/// FlightGear's native flight-dynamics packet (FGNetFDM, public domain): the C structure as it is, all numbers
/// big-endian, told by its version and its size alone.
inline constexpr std::size_t fdm_24_bytes = 408;
inline constexpr std::size_t fdm_25_bytes = 552;
inline constexpr std::uint16_t fdm_port = 5550;

/// Reads one datagram of version 24 or 25. `fix` is set where the result has no fault. The body rates come from the
/// rates of the angles. An agl below -9000 means that the sender knows none.
DecodeResult decode_fdm(Bytes datagram, Fix& fix);

/// What a person should be told of a datagram: "FDM version 24 of 408 bytes: fine".
std::string fdm_text(const DecodeResult& result);

/// A datagram of version 24. What is not in `fix` is zero, agl then -9999; `ticks` go into cur_time. The rates of the
/// angles are the body rates turned back.
std::array<std::byte, fdm_24_bytes> encode_fdm(const Fix& fix);

} // namespace octant::sim::links
