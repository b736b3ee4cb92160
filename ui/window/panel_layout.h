#pragma once

#include "ui/window/panel_columns.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace octant::ui::window {

/// Panels that a person moved, by their titles.
using PanelLayout = std::map<std::string, PanelRect, std::less<>>;

/// Returns the text of a layout file: one line a panel.
std::string text_of_layout(const PanelLayout& layout);

/// Reads the text of a layout file. Lines that are none of its own, with numbers that no window has, or of an older
/// program are left out: the panels then lie where they lie without them.
PanelLayout layout_from(std::string_view text);

} // namespace octant::ui::window
