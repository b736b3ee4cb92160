#pragma once

#include "ui/settings/setting_row.h"
#include "ui/settings/settings.h"

#include <span>
#include <string>
#include <string_view>

namespace octant::ui::window {

// Widgets made from the list of all settings (ui/settings_fields.h), between ImGui::NewFrame and
// ImGui::Render. What a person changes is in the settings at once; text and what loads something
// anew, on Enter. Values stay within their bounds.

/// Settings by their names, in that order. A name that is no setting shows nothing.
void edit_settings(settings::Settings& settings, std::span<const std::string_view> names);

/// Shows all settings of one group, in the order of help.
void edit_group(settings::Settings& settings, settings::SettingGroup group);

/// A list of built-in names, and a field for any other such as a file. True when it was changed.
bool choose_name(
    const settings::FieldInfo& info, std::string& name, std::span<const std::string_view> names);

} // namespace octant::ui::window
