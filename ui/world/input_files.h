#pragma once

#include "ui/settings/settings.h"

#include <string>
#include <utility>
#include <vector>

namespace octant::ui::world {

/// The settings with every file named by its absolute path, so that they mean the same from any
/// folder. Built-in names stay.
settings::RunSettings with_absolute_files(settings::RunSettings settings);

/// The files that a run reads for these settings, built-in ones too, and hashes of their bytes (16
/// hex digits; of an imported ground all but its tiles, whose checksums count): two runs with the
/// same settings and hashes show the same. Throws Error when one cannot be read.
std::vector<std::pair<std::string, std::string>>
input_hashes(const settings::RunSettings& settings);

} // namespace octant::ui::world
