#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace octant::visuals::nature {

/// What make_backdrop() must know of a map. World axes, metres.
struct BackdropSource {
    glm::dvec2 half_extent_m{0.0};
    double mean_height_m = 0.0;
    glm::vec3 mean_colour{0.5F};         ///< display values
    std::optional<double> water_level_m; ///< ground at it or below is water; nothing: there is none
    /// Height and colour of a position on the map; the colour is a mean over about `footprint_m`.
    std::function<double(const glm::dvec2& at_m)> height_m;
    std::function<glm::vec3(const glm::dvec2& at_m, double footprint_m)> colour;
    /// The code of the land covers there, 0..255; null: 0 everywhere.
    std::function<float(const glm::dvec2& at_m, double footprint_m)> cover_code = nullptr;
};

/// Land around a map that goes on as the map's own mirror image and flattens towards the mean height and colour, so
/// that no edge shows from above. Where the map ends in water, water goes on.
struct Backdrop {
    struct BackdropVertex {
        glm::dvec3 at_m{0.0}; ///< world axes
        glm::vec3 colour{0.0F};
        float cover_code = 0.0F; ///< their number, 0..255
        bool is_water = false;   ///< the colour lacks what water mirrors
    };

    std::vector<BackdropVertex> vertices;
    /// Triangles counter-clockwise seen from above, in rings from the outermost to the innermost. A ring has one cell
    /// for each of its vertices. A cell has two triangles: (outer corner, next outer corner, next inner corner) and
    /// (outer corner, next inner corner, inner corner). The sides between cells lie on lines through the map's middle.
    std::vector<std::uint32_t> indices;
    std::size_t outer_vertices = 0; ///< the first so many are those of the outermost ring; all rings have as many
};

Backdrop make_backdrop(const BackdropSource& map);

} // namespace octant::visuals::nature
