#pragma once

#include <glm/vec2.hpp>

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

/// Lays out the panels. Open panels are stacked in two columns at the sides of the window. Each is as high as its
/// content, or less if they do not all fit. Help and questions are in the middle. A panel that the user moves or
/// resizes keeps that position.
class PanelColumns {
public:
    /// Computes the positions of all open panels for the next frame, without overlap.
    void lay_out(const OpenPanels& open, const PanelArea& area);

    /// Returns the part between the open columns; nothing before lay_out().
    std::optional<MiddleColumn> middle() const { return middle_; }

    /// Returns the rectangle to which the panel must be moved now; nothing if it is there already or the user placed
    /// it.
    std::optional<PanelRect> take_new_rect(std::string_view title);

    /// Records the rectangle of a panel in this frame.
    void report_rect(std::string_view title, const PanelRect& rect);

    /// Records the height that a panel needs to show all its content.
    void report_height(std::string_view title, float height);

    /// Moves all panels back into their columns.
    void reset_layout();

    /// Returns the positions of the panels that the user moved.
    PanelLayout user_placed() const;

    /// Moves panels to the positions of a saved layout. Unknown titles are ignored.
    void restore_user_placed(const PanelLayout& layout);

private:
    struct PanelPlacement {
        PanelRect rect;
        bool user_placed = false;
        /// The window does not have `rect` yet.
        bool is_new = true;
        float wanted_height = 0.0F;
    };

    PanelPlacement& placement_of(std::string_view title);

    std::map<std::string, PanelPlacement, std::less<>> placements_;
    std::optional<MiddleColumn> middle_;
};

} // namespace octant::ui::window
