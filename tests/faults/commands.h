#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::tests::faults {

/// A command that is tried, in a folder that holds what the commands before it made.
struct TriedCommand {
    std::string_view name;
    std::vector<std::string> words;
    /// What it may leave when it fails, because it goes on from there or grows while it runs.
    std::vector<std::string> may_leave;
    /// What it does without: after these faults it may also end well, with a note.
    bool may_end_well = false;
};

/// Makes what the tried commands read.
std::span<const std::vector<std::string>> preparations();

std::span<const TriedCommand> tried_commands();

} // namespace octant::tests::faults
