#pragma once

#include "models/aircraft/painted_solid.h"
#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace octant::models::aircraft {

/// A model in the making.
class ModelBuilder {
public:
    explicit ModelBuilder(std::string name);

    void add_material(const std::string& name, const glm::vec3& colour);

    /// Materials must be known (asserted).
    void add(const std::string& part, const PaintedSolid& solid);

    /// A solid on the right, and its mirror image, as parts NAME_right and NAME_left.
    void add_mirrored(const std::string& part, const PaintedSolid& right_side);

    /// The part added under that name turns.
    void add_pivot(const std::string& part, const polygons::Pivot& pivot);

    /// Corners in one place become one vertex, and each polygon has the vertices that lie on its sides, so that no
    /// cracks show.
    polygons::PolygonModel finish();

private:
    std::uint32_t vertex_at(const glm::dvec3& at_m);
    std::uint32_t part_of(const std::string& name);

    polygons::PolygonModel model_;
    std::vector<std::vector<std::uint32_t>> outlines_; ///< vertices of each polygon
};

} // namespace octant::models::aircraft
