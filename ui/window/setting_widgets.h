#pragma once

#include "ui/settings/setting_rows.h"
#include "ui/settings/settings.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::window {

/// Returns the non-empty list `aircraft` with `count` >= 1 entries: removes the last ones or appends copies of the
/// first.
std::vector<std::string> with_aircraft_count(std::vector<std::string> aircraft, int count);

/// Returns `aircraft` with the first entry and all equal entries replaced by `leader`.
std::vector<std::string> with_lead_aircraft(std::vector<std::string> aircraft, const std::string& leader);

// The presentation of a setting follows from its row (ui/settings/setting_rows.h). These functions make no widgets.

/// The kind of widget that edits a number.
enum class NumberStyle {
    /// A linear slider between the limits.
    Slider,
    /// A logarithmic slider, for limits of one sign that are three decades or more apart.
    LogSlider,
    /// A field that is changed by dragging, for wide limits on both sides of zero.
    Drag,
    /// A text field that takes effect on Enter, because each change reloads something.
    Typed
};

NumberStyle number_style(const settings::SettingInfo& info);

/// Returns the initial number, within its limits, of an optional setting that the user switches on.
double start_value(const settings::SettingInfo& info);

/// Returns the text of an optional setting that is not set: "auto" or "none".
std::string_view unset_word(const settings::FieldInfo& info);

/// Returns the default that the meaning of the setting gives in brackets; empty if it gives none.
std::string_view unset_meaning(const settings::FieldInfo& info);

/// Returns the meaning of a setting and, on a second line, its option with form and limits.
std::string tooltip_of(const settings::FieldInfo& info);

/// Returns the names in one line, separated by commas.
std::string comma_separated(std::span<const std::string> names);

/// Splits a line at commas. Removes blanks around names and empty names.
std::vector<std::string> split_at_commas(std::string_view text);

// Widgets made from the rows of all settings (ui/settings/setting_rows.h), to be called between ImGui::NewFrame and
// ImGui::Render. A change takes effect at once; text, and settings that reload something, on Enter. Values stay within
// their limits.

/// Shows the named settings in this order. Unknown names are ignored.
void edit_settings(settings::RunSettings& settings, std::span<const std::string_view> names);

/// Shows all settings of one group in the order of the help.
void edit_group(settings::RunSettings& settings, settings::SettingGroup group);

/// Shows a list of built-in names and a field for other text, such as a file. Returns whether `name` was changed.
bool choose_name(const settings::FieldInfo& info, std::string& name, std::span<const std::string_view> names);

/// Makes a slider for the number of aircraft. It takes effect when it is released.
void count_slider(std::vector<std::string>& aircraft);

} // namespace octant::ui::window
