#pragma once

#include "ui/settings/setting_row.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::window {

// How a setting is shown, decided from what the list of settings says of it. Knows no widgets.

/// How a number is changed by hand.
enum class NumberStyle {
    Slider,
    LogSlider, ///< bounds of one sign and three decades or more apart
    Drag,      ///< wide bounds on both sides of zero
    Typed      ///< takes effect on Enter: each change loads something anew
};

NumberStyle number_style(const settings::SettingInfo& info);

/// Where an optional number begins when a person switches it on; within its bounds.
double start_value(const settings::SettingInfo& info);

/// What an optional setting is called while it is not set: "auto" or "none".
std::string_view unset_word(const settings::FieldInfo& info);

/// What the meaning says in brackets of a setting that is not set; may be empty.
std::string_view unset_meaning(const settings::FieldInfo& info);

/// Meaning with its unit, then the option with its form and bounds.
std::string tooltip_of(const settings::FieldInfo& info);

/// Names parted by commas, and back. Blanks around names and empty names are dropped.
std::string joined(std::span<const std::string> names);
std::vector<std::string> parted(std::string_view text);

} // namespace octant::ui::window
