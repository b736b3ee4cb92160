#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace octant::models::meshfile::test {

/// A file with one to three faults: bytes flipped, the end cut off, a number made huge, negative, NaN or a fraction, a
/// line or a piece taken out, doubled or swapped with another. The same seed makes the same faults everywhere.
std::string mutated(std::string bytes, std::uint32_t seed);

} // namespace octant::models::meshfile::test
