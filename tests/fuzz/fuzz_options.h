#pragma once

#include "tests/fuzz/trial.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::tests::fuzz {

/// What the command line asks for.
struct FuzzOptions {
    double seconds = 10.0;     ///< of wall time
    std::optional<long> cases; ///< instead of seconds
    std::uint64_t seed = 1;    ///< of the first case; the next ones count on
    std::optional<std::uint64_t> only;
    std::vector<std::string> kinds;           ///< empty: all
    std::optional<int> polygons;              ///< nothing: 6 to 60, by the seed
    std::vector<std::filesystem::path> files; ///< checked instead of made models
    std::filesystem::path keep;               ///< where reduced failures are written; empty: nowhere
    bool whole = false;                       ///< keep failures as they are
    bool verbose = false;                     ///< a line a case, good ones too
    TrialOptions trial;
};

/// The text of --help.
std::string help_text();

/// Throws Error for words that are not understood. --help leads to nothing.
std::optional<FuzzOptions> read_fuzz_options(std::span<char* const> words);

} // namespace octant::tests::fuzz
