#pragma once

#include "ui/window/view_keys.h"

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::window {

/// Where a panel lies before a person moves it. Sizes are those at a font of 13 pixels.
struct PanelPlace {
    /// The corner of the panel that lies in the same corner of the window, from 0,0 (upper left) to
    /// 1,1 (lower right).
    ImVec2 corner;
    /// Distance of the panel from that corner, towards the middle of the window.
    ImVec2 inset;
    ImVec2 size;
};

/// A panel, whose widgets are made while this object lives. The cross in its title closes it and
/// sets `open` to false.
class Panel {
public:
    Panel(const char* title, const PanelPlace& place, bool& open);
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;
    Panel(Panel&&) = delete;
    Panel& operator=(Panel&&) = delete;

    /// Whether any part of the panel is on the screen, so that its widgets must be made.
    bool is_seen() const { return seen_; }

private:
    bool begun_ = false;
    bool seen_ = false;
};

/// Shares of a panel's width that the widget of a value takes; its name stands beside it.
inline constexpr float value_share = 0.55F;
inline constexpr float wide_share = 0.85F;

/// Returns how many times larger everything is than at a font of 13 pixels.
float gui_scale();

void show_tooltip(const std::string& text);

/// Shows a tooltip while the pointer is over the widget made last, which may be disabled.
void explain(std::string_view text);

/// Returns the name of the key that gives a command, as written on it, such as "Space".
std::string_view key_of(ViewCommand command);

/// Returns "text (key)" for labels of buttons.
std::string with_key(std::string_view text, ViewCommand command);

/// Makes a field of text. Returns what was typed when Enter is pressed, else nothing.
std::optional<std::string>
typed_text(const char* label, const std::string& text, std::string_view hint);

/// Makes a slider of how many aircraft fly, which takes effect when it is let go.
void count_slider(std::vector<std::string>& aircraft);

/// Makes a line "name: value" in two columns.
void show_value(const char* name, const std::string& value);

} // namespace octant::ui::window
