#pragma once

#include "ui/settings/settings.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::sweep {

/// One flight of a sweep.
struct SweepRun {
    std::string name; ///< "turn-f15-2000-r2"; letters, digits, dots and dashes, once in a sweep
    int repeat = 1;   ///< from 1; runs that differ only in it must have the same hashes
    settings::RunSettings settings;
    std::vector<std::pair<std::string, std::string>> varied; ///< names and values of the varied settings
};

/// The flights of a sweep file.
struct Sweep {
    std::string name;
    std::vector<SweepRun> runs;          ///< in the order of the file, in which repeats change fastest
    std::vector<std::string> notes = {}; ///< of values under old names, each once
};

/// The largest number of flights that one file may ask for.
inline constexpr std::size_t max_runs = 100000;

/// Reads a sweep:
///   name = "budgets"                     # else the file's name
///   repeats = 3                          # else 1
///   [settings]                           # what all flights share, by the names of fly's options
///   size = "320x180"
///   [vary]                               # every combination is flown
///   path = ["straight", "turn"]
///   triangles = { from = 2000, to = 8000, step = 2000 }
///   [vary.method.paper]                  # several settings under a name of their own
///   order-method = "paper"
///   [vary.method.tree]
///   order-method = "exact"
/// Relative file names are relative to the sweep's folder if the file exists there. Throws Error "file:line: expected
/// ..., got ..." for anything else, and for settings that octant fly refuses without loading a world.
Sweep read_sweep(const std::filesystem::path& file);

/// Indices of the sweep's runs in the order of flying: all first repeats, then all second ones; shuffled within each
/// repeat, so that a machine that slowly becomes slower does not become a difference between variants. The same for
/// each call: the order depends on the sweep's name and runs only.
std::vector<std::size_t> flying_order(const Sweep& sweep);

} // namespace octant::ui::sweep
