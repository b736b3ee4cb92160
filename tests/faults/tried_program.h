#pragma once

#include "tests/faults/fault_counters.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace octant::tests::faults {

/// Which call fails.
struct Fault {
    enum class Kind { None, Allocation, Write };

    Kind kind = Kind::None;
    std::uint64_t point = 0; ///< from 1 on
    bool goes_on = false;    ///< so do all after it: a full disk
};

/// How a run ended.
struct RunSummary {
    int exit_code = 0;
    int signal = 0; ///< that ended it; 0 = none
    bool timed_out = false;
    std::string errors; ///< what it wrote to standard error
    std::uint64_t allocations = 0;
    std::uint64_t writes = 0;
};

/// Runs a program with failing_calls preloaded.
class TriedProgram {
public:
    /// Keeps its counters in `scratch`. Throws Error.
    TriedProgram(std::filesystem::path program, std::filesystem::path preloaded, const std::filesystem::path& scratch);
    ~TriedProgram();
    TriedProgram(TriedProgram&&) = delete;
    TriedProgram& operator=(TriedProgram&&) = delete;
    TriedProgram(const TriedProgram&) = delete;
    TriedProgram& operator=(const TriedProgram&) = delete;

    /// Runs it in a folder, for five minutes at most. Throws Error when it cannot be started.
    RunSummary run(const std::vector<std::string>& words, const std::filesystem::path& folder, const Fault& fault);

private:
    std::filesystem::path program_;
    std::filesystem::path preloaded_;
    std::filesystem::path counters_file_;
    std::filesystem::path errors_file_;
    FaultCounters* counters_ = nullptr;
};

} // namespace octant::tests::faults
