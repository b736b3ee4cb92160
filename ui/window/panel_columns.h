#pragma once

#include "ui/window/open_panels.h"

#include <glm/vec2.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace octant::ui::window {

/// Where a panel lies, in the window's units, y down.
struct PanelRect {
    glm::vec2 at{0.0F};
    glm::vec2 size{0.0F};

    friend bool operator==(const PanelRect&, const PanelRect&) = default;
};

/// The window that panels are laid out in.
struct PanelArea {
    glm::vec2 size{0.0F};
    /// How many times larger everything is than at a font of 13 pixels.
    float scale = 1.0F;
    /// What the status line takes of the middle, from the top.
    float status_height = 0.0F;
    /// What a second view takes of the lower right corner, with its margin.
    glm::vec2 inset{0.0F};
};

/// The part of the window between the columns at its sides.
struct MiddleColumn {
    float left = 0.0F;
    float width = 0.0F;
};

/// The places of panels. Open panels stand one below the other in two columns at the sides, which leave the picture
/// between them free, and each is as high as what it shows, or less where they do not all fit; the help and questions
/// are in the middle. A panel that a person moves or sizes stays where it was put.
class PanelColumns {
public:
    /// Finds the places of all open panels, none over another, for the next frame.
    void lay_out(const OpenPanels& open, const PanelArea& area);

    /// Returns the part that open columns leave free; nothing before lay_out().
    std::optional<MiddleColumn> middle() const { return middle_; }

    /// Returns where the panel is to be put at once; nothing where it already lies right, or where a person puts it.
    std::optional<PanelRect> take_new_rect(std::string_view title);

    /// Takes note of where a panel lies in this frame.
    void report_rect(std::string_view title, const PanelRect& rect);

    /// Takes note of how high a panel is that shows all it has.
    void report_height(std::string_view title, float height);

    /// Puts all panels back into their columns.
    void reset_layout();

    /// Returns the places that a person chose, by the panels' titles.
    std::map<std::string, PanelRect, std::less<>> user_placed() const;

    /// Puts panels where a person chose to have them; titles of no panel are ignored.
    void restore_user_placed(const std::map<std::string, PanelRect, std::less<>>& placements);

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
