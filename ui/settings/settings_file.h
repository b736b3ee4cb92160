#pragma once

#include "ui/settings/settings.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace octant::ui::settings {

/// All settings as a JSON object in the order of help. Unset options are null.
nlohmann::ordered_json settings_json(const Settings& settings);

/// Settings from a settings file or from a recording's run.json (its "settings" object). Fields
/// that are not there keep their defaults. Throws Error with file and line for an unknown key, a
/// wrong type or a value out of range.
Settings read_settings(const std::filesystem::path& path);

} // namespace octant::ui::settings
