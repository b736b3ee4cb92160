#pragma once

#include "sim/links/fix.h"
#include "sim/links/wire_bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace octant::sim::links {

/// Distributed Interactive Simulation: the Entity State PDU of IEEE 1278.1, 144 bytes and 16 more for each
/// articulation; big-endian, earth-centred metres. UDP.
inline constexpr std::size_t dis_entity_bytes = 144;
inline constexpr std::uint16_t dis_port = 3000;

/// How a receiver goes on between two states (dead reckoning, IEEE 1278.1 annex B): static; by velocity; by velocity
/// and rates of turn; that and by acceleration; velocity and acceleration.
enum class DeadReckoning : std::uint8_t { Static = 1, Fpw = 2, Rpw = 3, Rvw = 4, Fvw = 5 };

struct DisEntity {
    std::uint16_t site = 0;
    std::uint16_t application = 0;
    std::uint16_t entity = 0;
    std::uint8_t force = 0;
    std::array<std::uint8_t, 8> type{}; ///< kind, domain, country (2), category, ..., extra
    DeadReckoning reckoning = DeadReckoning::Static;
    std::array<char, 11> marking{};
    Fix fix; ///< its acceleration too
};

/// Reads one PDU. `entity` is set where the result has no fault; other PDUs of DIS are Unused with their type as
/// DecodeResult::got. Velocity and rates are those by which the sender wants it to go on: zero where its dead reckoning
/// leaves them out.
DecodeResult decode_dis(Bytes datagram, DisEntity& entity);

/// The marking as text, without the zeros and spaces at its end; what a terminal would obey is replaced.
std::string marking_of(const DisEntity& entity);

std::string dis_text(const DecodeResult& result);

/// The PDU of an entity; `fix` needs latitude and longitude. `time_s` is seconds past the hour.
std::array<std::byte, dis_entity_bytes> encode_dis(const DisEntity& entity, double time_s);

} // namespace octant::sim::links
