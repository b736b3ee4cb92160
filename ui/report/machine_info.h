#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::report {

/// The machine's processor time since it started, in clock ticks summed over its cores (first line of /proc/stat), and
/// this process's with its finished children. All zero where unknown.
struct CpuTimes {
    std::uint64_t total = 0;
    std::uint64_t idle = 0; ///< with waiting for disks
    std::uint64_t steal = 0;
    std::uint64_t own = 0;
};

/// Where a flight was timed.
struct MachineInfo {
    std::string host; ///< its name among Slurm's nodes, else in its network
    std::string cpu;
    int cores = 0;
    std::uint64_t memory_kb = 0;
    std::string os;
    std::string kernel;
    std::string compiler;
    std::string lp_num_threads; ///< the environment variable, "not set" without one
    std::string start_time_utc; ///< 2026-01-31T23:59:59.123Z: tells which of two flights in turns began first
    double load_average_1min = 0.0;
    CpuTimes cpu_times;
};

/// Shares of all the machine's processor time between two readings, in [0, 1].
struct CpuUse {
    double stolen = 0.0; ///< taken by the host for other machines
    double others = 0.0; ///< used by other programs on this machine
};

/// Reads /proc and /etc; entries that are missing stay "unknown" or zero. Never throws for a missing file. `root`
/// replaces "/".
MachineInfo read_machine_info(std::chrono::system_clock::time_point start, const std::filesystem::path& root = "/");

CpuTimes read_cpu_times(const std::filesystem::path& root = "/");

/// Nothing when no time passed between the readings or the machine gives none.
std::optional<CpuUse> cpu_use_between(const CpuTimes& start, const CpuTimes& end);

/// Limits of noise_reasons.
inline constexpr double noisy_steal_share = 0.01;
inline constexpr double noisy_others_share = 0.10;
inline constexpr double noisy_load_per_core = 0.5;

/// Reasons not to trust the times of a flight, one sentence each; empty = quiet. More than 1 % of the processor time
/// stolen or more than 10 % used by other programs during the flight. Without figures from the flight (it was killed):
/// a load average above half the cores at its start.
std::vector<std::string> noise_reasons(double load_average_1min, int cores, const std::optional<CpuUse>& during);

/// "2026-01-31T23:59:59.123Z".
std::string utc_text(std::chrono::system_clock::time_point time);

} // namespace octant::ui::report
