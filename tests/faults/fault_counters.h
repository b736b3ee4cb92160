#pragma once

#include <atomic>
#include <cstdint>

namespace octant::tests::faults {

/// Shared by the program that is tried and the one that tries it, through a mapped file. Points of each kind count from
/// 1 on; 0 fails none.
struct FaultCounters {
    std::atomic<std::uint64_t> allocations;        ///< so far
    std::atomic<std::uint64_t> writes;             ///< so far
    std::atomic<std::uint64_t> failing_allocation; ///< the one that fails
    std::atomic<std::uint64_t> failing_write;      ///< the one that fails
    std::atomic<std::uint64_t> goes_on;            ///< 1: so do all after it
};

/// The environment variable that names the mapped file.
inline constexpr const char* counters_variable = "OCTANT_FAULT_COUNTERS";

} // namespace octant::tests::faults
