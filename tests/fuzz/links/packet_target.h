#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// What libFuzzer calls with each input; each *_fuzz.cpp has one of its own and makes a program.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace octant::tests {

/// Inputs of that decoder that are right.
std::vector<std::vector<std::byte>> packet_seeds();

/// Ends the program where a decoder gave what it must never give.
void expect(bool holds, const char* what);

} // namespace octant::tests
