#pragma once

#include "ui/settings/setting_row.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::window {

// How a setting is shown, which follows from its row (ui/settings/setting_row.h). No function here makes widgets.

/// How a number is changed by hand.
enum class NumberStyle {
    /// A linear slider between the limits.
    Slider,
    /// A logarithmic slider, for limits of one sign that are three decades or more apart.
    LogSlider,
    /// A field to drag in, for wide limits on both sides of zero.
    Drag,
    /// A field whose number takes effect on Enter, because each change loads something anew.
    Typed
};

NumberStyle number_style(const settings::SettingInfo& info);

/// Returns the number, within its limits, that an optional setting has when a person switches it on.
double start_value(const settings::SettingInfo& info);

/// Returns the word for an optional setting that is not set: "auto" or "none".
std::string_view unset_word(const settings::FieldInfo& info);

/// Returns what holds while the setting is not set, which its meaning says in brackets; empty where it does not.
std::string_view unset_meaning(const settings::FieldInfo& info);

/// Returns the meaning of a setting and, on a second line, its option with form and limits.
std::string tooltip_of(const settings::FieldInfo& info);

/// Returns the names in one line, separated by commas.
std::string comma_separated(std::span<const std::string> names);

/// Returns the names of a line that are separated by commas. Blanks around names and empty names are dropped.
std::vector<std::string> split_at_commas(std::string_view text);

} // namespace octant::ui::window
