#pragma once

#include "sim/links/fix.h"
#include "sim/links/wire_bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace octant::sim::links {

/// The native flight-dynamics packet of FlightGear (FGNetFDM, public domain): the C structure with big-endian numbers,
/// recognised only by its version and its size.
inline constexpr std::size_t fdm_24_bytes = 408;
inline constexpr std::size_t fdm_25_bytes = 552;
inline constexpr std::uint16_t fdm_port = 5550;

/// Reads one datagram of version 24 or 25. Sets `fix` if the result has no fault. Body rates are computed from the
/// rates of the angles. An agl below -9000 means that the sender does not know it.
DecodeResult decode_fdm(Bytes datagram, Fix& fix);

/// Message about a datagram, such as "FDM version 24 of 408 bytes: fine".
std::string fdm_text(const DecodeResult& result);

/// A datagram of version 24. Values that `fix` lacks are zero, agl -9999; `ticks` become cur_time. The rates of the
/// angles are computed from the body rates.
std::array<std::byte, fdm_24_bytes> encode_fdm(const Fix& fix);

} // namespace octant::sim::links
