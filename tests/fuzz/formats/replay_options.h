#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::tests::formats {

/// What format_replay is asked for.
struct ReplayOptions {
    std::string only; ///< name of a target; empty = all
    std::uint64_t mutations = 3000;
    std::uint64_t seed = 1;
    std::vector<std::filesystem::path> files;    ///< inputs to try in place of mutations
    std::optional<std::filesystem::path> corpus; ///< where to write seeds and words for libFuzzer
};

/// Reads the command line. Throws Error for options that are not known or lack a value.
ReplayOptions read_replay_options(std::span<char* const> words);

} // namespace octant::tests::formats
