#pragma once

#include "ui/window/view_keys.h"

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::window {

/// Where a panel lies before a person moves it. Sizes at a font of 13 pixels.
struct PanelPlace {
    ImVec2 corner; ///< of the panel and of the window alike: 0,0 upper left .. 1,1 lower right
    ImVec2 inset;  ///< from that corner of the window towards its middle
    ImVec2 size;
};

/// A panel while it lives. Closed by its own cross too, which `open` then tells.
class Panel {
public:
    Panel(const char* title, const PanelPlace& place, bool& open);
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;
    Panel(Panel&&) = delete;
    Panel& operator=(Panel&&) = delete;

    /// Something of it is to be seen: make its widgets.
    bool is_seen() const { return seen_; }

private:
    bool begun_ = false;
    bool seen_ = false;
};

/// Shares of a panel's width that the widget of a value takes beside its name.
inline constexpr float value_share = 0.55F;
inline constexpr float wide_share = 0.85F;

/// How many times larger than at a font of 13 pixels everything is.
float gui_scale();

void show_tooltip(const std::string& text);

/// For the widget made last, enabled or not.
void explain(std::string_view text);

/// As on the key of a command, such as "Space".
std::string_view key_of(ViewCommand command);

/// "text (key)", as labels of buttons.
std::string with_key(std::string_view text, ViewCommand command);

/// A field of text; what was typed when Enter is pressed.
std::optional<std::string>
typed_text(const char* label, const std::string& text, std::string_view hint);

/// How many aircraft fly: takes effect when the slider is let go.
void count_slider(std::vector<std::string>& aircraft);

/// A line "name: value" in two columns.
void show_value(const char* name, const std::string& value);

} // namespace octant::ui::window
