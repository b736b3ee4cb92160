#pragma once

#include <filesystem>

namespace octant::ui::base {

/// Where the program keeps what the user chose: $XDG_CONFIG_HOME/octant, else ~/.config/octant. Empty where the
/// environment names no home.
std::filesystem::path configuration_folder();

/// Where the program keeps what it can compute anew: $XDG_CACHE_HOME/octant, else ~/.cache/octant. Empty where the
/// environment names no home.
std::filesystem::path cache_folder();

} // namespace octant::ui::base
