#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/daylight.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::nature {

/// One thin layer of clouds: a level sheet of triangles around the eye, finer near it, with density and light at its
/// corners. Where clouds are follows from the place alone, so that they stand still over the ground.
class CloudLayer {
public:
    /// `cover`: the share of the sky that has clouds, 0..1. Computes the periodic pattern of densities.
    explicit CloudLayer(double cover);

    /// Sets the colours of the clouds.
    void set_daylight(const Daylight& day);

    /// Transparent triangles, world axes with the eye subtracted; alpha is the density. No triangle hides another.
    struct Triangles {
        std::span<const models::ColourVertex> vertices;
        std::span<const std::uint32_t> indices;
    };

    /// The layer at `height_m` as seen from an eye, lowered by the earth's curvature (radius 0: flat). It becomes
    /// transparent if the eye is near its height, so that the eye can pass through. Valid until the next call.
    Triangles seen_from(const glm::dvec3& eye_m, double height_m, double earth_radius_m);

    /// The distance beyond which there are no clouds.
    static constexpr double reach_m = 32000.0;

private:
    static constexpr int levels = 6; ///< each with cells of twice the size
    static constexpr int side = 32;  ///< cells of each level along one side of its square
    static constexpr int nodes_per_side = side + 1;

    struct Node {
        float density = 0.0F;
        float light = 0.0F; ///< of the slope towards the sun, -1..1
    };

    Node node(int level, std::int64_t column, std::int64_t row) const;
    Node blended_node(int level, std::int64_t column, std::int64_t row, float coarser) const;
    models::ColourVertex vertex(const Node& node, const glm::dvec3& at_m, bool from_above, float thinning) const;
    void add_level(int level, const glm::dvec3& eye_m, double height_m, double earth_radius_m);

    std::array<std::vector<float>, levels + 1> density_; ///< periodic; 0 = none, 1 = full
    glm::vec2 horizontal_to_sun_{0.0F};
    glm::vec3 bright_{1.0F};
    glm::vec3 dark_{0.6F};
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

} // namespace octant::visuals::nature
