#pragma once

#include "ui/window/panel_columns.h"

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::window {

/// Of text that warns: light enough to be read over a panel's ground.
inline const ImVec4 warning_colour{1.0F, 0.55F, 0.45F, 1.0F};

/// How much of the picture below a panel its ground covers.
constexpr float background_alpha = 0.82F;

/// A panel, whose widgets are made while this object lives. The cross in its title closes it and sets `open` to false.
/// It lies where the columns have it, which are told how high it would be.
class Panel {
public:
    Panel(const char* title, PanelColumns& columns, bool& open);
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;
    Panel(Panel&&) = delete;
    Panel& operator=(Panel&&) = delete;

    /// Whether any part of the panel is on the screen, so that its widgets must be made.
    bool is_seen() const { return seen_; }

private:
    const char* title_;
    PanelColumns& columns_;
    bool begun_ = false;
    bool seen_ = false;
};

/// Returns the width of the widget of a value whose name stands beside it.
float value_width();

/// Makes what comes next stand in the same line, where `width` more fits there.
void same_line_for(float width);

/// Returns the width of a check box or radio button with its name.
float checkbox_width(const char* label);

/// Makes a button in the same line as what stands before it, or in the next one where it does not fit. Returns whether
/// it was pressed.
bool next_button(const char* label);

/// Returns how many times larger everything is than at a font of 13 pixels.
float gui_scale();

void show_tooltip(const std::string& text);

/// Shows a tooltip while the pointer is over the widget made last, which may be disabled.
void show_tooltip_on_hover(std::string_view text);

/// Makes a field of text. Returns what was typed when Enter is pressed, else nothing.
std::optional<std::string> typed_text(const char* label, const std::string& text, std::string_view hint);

/// Makes a slider of how many aircraft fly, which takes effect when it is let go.
void count_slider(std::vector<std::string>& aircraft);

/// Makes a line "name: value" in two columns.
void show_value(const char* name, const std::string& value);

} // namespace octant::ui::window
