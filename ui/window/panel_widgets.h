#pragma once

#include "ui/report/frame_record.h"
#include "ui/window/panel_columns.h"

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace octant::ui::window {

/// A plot of the last frames over the panel's width, with the newest at its right edge. It clips values to `min_value`
/// and `max_value`.
class FramePlot {
public:
    FramePlot(float height_px, double min_value, double max_value);

    using Record = report::FrameRecord;

    /// Draws a line with one point for each frame.
    template <class Value>
    void line(std::span<const Record> records, Value value, ImU32 colour) const {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.PathClear();
        for (std::size_t i = 0; i < records.size(); ++i) {
            list.PathLineTo({x_of(records.size() - i), y_of(value(records[i]))});
        }
        list.PathStroke(colour, ImDrawFlags_None, 1.0F);
    }

    /// Draws a tick at the upper edge for each frame for which `is_marked` is true.
    template <class IsMarked>
    void marks(std::span<const Record> records, IsMarked is_marked, ImU32 colour) const {
        for (std::size_t i = 0; i < records.size(); ++i) {
            if (is_marked(records[i])) { mark(records.size() - i, colour); }
        }
    }

    /// Draws a horizontal line at `value` with its name.
    void level(double value, const char* name, ImU32 colour) const;

    /// Returns the index in `records`, the last frames, of the frame under the pointer; `none` if there is none.
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::size_t pointed_at(std::span<const Record> records) const;

private:
    float x_of(std::size_t frames_ago) const;
    float y_of(double value) const;
    void mark(std::size_t frames_ago, ImU32 colour) const;

    ImVec2 from_;
    ImVec2 to_;
    double min_value_;
    double max_value_;
};

/// One part of a stacked bar.
struct BarPart {
    const char* name;
    double value;
    ImU32 colour;
};

/// Draws the parts side by side. The panel's width stands for the larger of `whole` and their sum. A legend below the
/// bar lists the values in `unit`.
void stacked_bar(std::span<const BarPart> parts, double whole, const char* unit);

/// Colour of warnings, readable on a panel's background.
inline const ImVec4 warning_colour{1.0F, 0.55F, 0.45F, 1.0F};

/// Opacity of a panel's background.
constexpr float background_alpha = 0.82F;

/// A panel. Its widgets are made while this object lives. The cross in its title closes it and sets `open` to false.
/// `columns` place it.
class Panel {
public:
    Panel(const char* title, PanelColumns& columns, bool& open);
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;
    Panel(Panel&&) = delete;
    Panel& operator=(Panel&&) = delete;

    /// Whether any part of the panel is visible, so that its widgets must be made.
    bool is_seen() const { return seen_; }

private:
    bool begun_ = false;
    bool seen_ = false;
};

/// Returns the width of a value's widget with its name to the right.
float value_width();

/// Places the next widget on the same line if `width` still fits there.
void same_line_for(float width);

/// Returns the width of a check box or radio button with its label.
float checkbox_width(const char* label);

/// Makes a button on the same line as the previous widget, or on the next line if it does not fit. Returns whether it
/// was pressed.
bool next_button(const char* label);

/// Returns the scale of the user interface; 1 for a font of 13 pixels.
float gui_scale();

void show_tooltip(const std::string& text);

/// Shows a tooltip while the pointer is over the previous widget, which may be disabled.
void show_tooltip_on_hover(std::string_view text);

/// Makes a text field. Returns its text when Enter is pressed, else nothing.
std::optional<std::string> typed_text(const char* label, const std::string& text, std::string_view hint);

/// Makes a line "name: value" in two columns.
void show_value(const char* name, const std::string& value);

} // namespace octant::ui::window
