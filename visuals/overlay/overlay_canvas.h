#pragma once

#include "visuals/scene/frame_plan.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace octant::visuals::overlay {

/// An upright rectangle.
struct OverlayBox {
    glm::vec2 min{0.0F};
    glm::vec2 max{0.0F};

    bool contains(const glm::vec2& at) const {
        return at.x >= min.x && at.y >= min.y && at.x <= max.x && at.y <= max.y;
    }
};

/// What lines are drawn with: a core with soft edges over a wider shade that sets it off from what is behind it.
struct OverlayPen {
    float width_px = 1.5F;
    float halo_px = 1.5F; ///< how much farther than the core the shade reaches
    std::uint32_t colour = 0;
    std::uint32_t halo_colour = 0; ///< of alpha 0: none is drawn
};

/// Where a text goes. `height` is that of a capital.
struct TextLayout {
    glm::vec2 at{0.0F};
    float height = 10.0F;
    float alignment = 0.0F;      ///< of the text's width that lies before `at`: 0.5 = centred
    glm::vec2 along{1.0F, 0.0F}; ///< unit vector to the right of the text
};

/// Collects areas, lines and letters as the triangles of an OverlayDraw: areas, then shades, then lines, then letters.
/// One draws on a plane, x to the right and y down, that is then seen in the picture.
class OverlayCanvas {
public:
    /// Empties the canvas. (x, y, 1) of the plane times `to_picture`, divided by its last part, which must be positive
    /// wherever something is drawn, is a place in the picture in pixels.
    void begin(const glm::mat3& to_picture, const OverlayPen& pen);

    /// Cuts what is drawn from here on at the edges of a box of the plane.
    void clip_to(const OverlayBox& box) { clip_ = box; }

    /// Lines from each point to the next, joined.
    void polyline(std::span<const glm::vec2> points);

    void line(const glm::vec2& from, const glm::vec2& to) { polyline(std::array{from, to}); }

    /// A convex area, whole: the clip box does not cut it. Its edges are not softened.
    void fill(std::span<const glm::vec2> corners, std::uint32_t colour);

    void box(const OverlayBox& box);
    void circle(const glm::vec2& centre, float radius);

    /// Nothing unless all of it lies in the clip box: half a letter cannot be read.
    void text(const TextLayout& place, std::string_view text);

    /// Valid until the next begin(). No allocation once warmed up.
    scene::OverlayDraw finish();

private:
    /// What a line is across, at most four points from left to right, and all strips of that kind.
    struct Strips {
        struct Point {
            float at_px = 0.0F;
            std::uint32_t colour = 0;
        };

        std::array<Point, 4> points{};
        std::size_t count = 0;
        float extension_px = 0.0F; ///< of a line
        std::vector<std::uint32_t> indices;
    };

    glm::vec2 to_picture_at(const glm::vec2& at) const;
    void clip_line(const glm::vec2& from, const glm::vec2& to);
    void add_to_run(const glm::vec2& at);
    void end_run();
    void stroke(Strips& strips);
    void add_row(const Strips& strips, const glm::vec2& at, const glm::vec2& side);
    void join_last_rows(Strips& strips);

    glm::mat3 to_picture_{1.0F};
    std::vector<std::uint32_t> areas_; ///< indices
    Strips halo_;
    Strips lines_;
    Strips letters_;
    bool draws_text_ = false; ///< what is drawn is letters
    OverlayBox clip_;
    std::vector<glm::vec2> run_; ///< of the plane's lines within the clip box, in the picture
    std::vector<scene::OverlayVertex> vertices_;
};

/// Draws that lie over one another, as one. Keeps its memory.
class OverlayLayers {
public:
    void clear();

    /// Lays a draw over those before it; it is copied.
    void add(const scene::OverlayDraw& draw);

    /// Valid until the next call of another member.
    scene::OverlayDraw all() const { return {vertices_, indices_}; }

private:
    std::vector<scene::OverlayVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

} // namespace octant::visuals::overlay
