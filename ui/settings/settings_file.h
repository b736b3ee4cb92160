#pragma once

#include "ui/settings/settings.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace octant::ui::settings {

/// Returns all settings as a JSON object in the order of help. Settings that are not set are null.
nlohmann::ordered_json settings_json(const RunSettings& settings);

/// Reads settings from a settings file or from a recording: its run.json ("settings" there), its folder or its packed
/// file. Files that lie in the recording, or where it says that they lie from it, are then named from here. Settings
/// that are not there keep their defaults. Throws Error with file and line for an unknown key, a wrong type or a value
/// out of range. A note for each value under an old name is added to `notes` unless that is null.
RunSettings read_settings(const std::filesystem::path& given, std::vector<std::string>* notes = nullptr);

} // namespace octant::ui::settings
