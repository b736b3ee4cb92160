#pragma once

#include "ui/settings/setting_row.h"
#include "ui/settings/settings.h"

#include <span>
#include <string>
#include <string_view>

namespace octant::ui::window {

// Widgets made from the rows of all settings (ui/settings/settings_fields.h), between ImGui::NewFrame and
// ImGui::Render. A change takes effect at once, or on Enter for text and for what loads something anew. Values stay
// within their limits.

/// Shows the settings of these names, in this order. A name that is no setting shows nothing.
void edit_settings(settings::RunSettings& settings, std::span<const std::string_view> names);

/// Shows all settings of one group, in the order of help.
void edit_group(settings::RunSettings& settings, settings::SettingGroup group);

/// Shows a list of built-in names and a field for any other text, such as a file. Returns whether `name` was changed.
bool choose_name(const settings::FieldInfo& info, std::string& name, std::span<const std::string_view> names);

} // namespace octant::ui::window
