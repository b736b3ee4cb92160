#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace octant::ui::window {

/// Which panels are open.
struct OpenPanels {
    /// While this is false, no panel is shown.
    bool shown = true;
    bool flight = true;
    bool timing = false;
    bool terrain = false;
    bool draw_order = false;
    bool aircraft = false;
    bool scene = false;
    bool settings = false;
    bool help = false;
    /// The panel with three lines on the first steps.
    bool first_steps = false;
    /// The question whether to quit during a recording. Shown even while `shown` is false.
    bool leave_question = false;
};

/// The rectangle of a panel in window units, y down.
struct PanelRect {
    glm::vec2 at{0.0F};
    glm::vec2 size{0.0F};

    friend bool operator==(const PanelRect&, const PanelRect&) = default;
};

/// Positions of panels that the user moved, by title.
using PanelLayout = std::map<std::string, PanelRect, std::less<>>;

/// Returns the text of a layout file: one line a panel.
std::string text_of_layout(const PanelLayout& layout);

/// Reads the text of a layout file. Ignores invalid lines, positions outside any window and files of older versions;
/// their panels get the default positions.
PanelLayout layout_from(std::string_view text);

/// The window that panels are laid out in.
struct PanelArea {
    glm::vec2 size{0.0F};
    /// Scale of the user interface; 1 for a font of 13 pixels.
    float scale = 1.0F;
    /// Height of the status line at the top of the middle column.
    float status_height = 0.0F;
    /// Size of the second view in the lower right corner, margin included.
    glm::vec2 inset{0.0F};
};

/// The part of the window between the two columns of panels.
struct MiddleColumn {
    float left = 0.0F;
    float width = 0.0F;
};

/// Places the panels. Open panels are stacked in two columns at the sides of the window; Dear ImGui makes each as high
/// as its content, or less if they do not all fit. Help and questions are at the bottom of the middle. A panel that the
/// user moves keeps its position and can then be resized.
class PanelColumns {
public:
    /// Begins a frame: computes the columns and how many panels share each.
    void lay_out(const OpenPanels& open, const PanelArea& area);

    /// Returns the part between the open columns; nothing before lay_out().
    std::optional<MiddleColumn> middle() const { return middle_; }

    /// Begins the ImGui window of a panel at its place; ImGui::End() must follow. The cross in its title sets `open` to
    /// false. Returns whether any part of it is visible. Panels of a column are placed in the order of the calls.
    bool begin_panel(const char* title, bool& open);

    /// Moves all panels back into their columns.
    void reset_layout();

    /// Returns the positions of the panels that the user moved.
    PanelLayout user_placed() const;

    /// Moves panels to the positions of a saved layout. Unknown titles are ignored.
    void restore_user_placed(const PanelLayout& layout);

private:
    struct PanelPlacement {
        PanelRect rect; ///< as the last frame showed it
        bool user_placed = false;
        bool is_new = true; ///< the window does not have `rect` yet
    };

    /// What is left of a column for panels that are not placed yet.
    struct FreeColumn {
        float left = 0.0F;
        float width = 0.0F;
        float top = 0.0F;
        float bottom = 0.0F;
        int panels = 0;
    };

    FreeColumn column_of(std::size_t column, bool left_open, bool right_open) const;
    void place_in_column(std::size_t column, PanelPlacement& place);

    PanelArea area_;
    std::array<FreeColumn, 3> columns_;
    std::map<std::string, PanelPlacement, std::less<>> placements_;
    std::optional<MiddleColumn> middle_;
};

} // namespace octant::ui::window
