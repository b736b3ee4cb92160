#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/face.h"
#include "visuals/draworder/hiding_graph.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// A model made ready for hiding tests: face i stands in for polygon i. Lengths are in units of the
/// model's radius about `origin_m`, from there.
struct ModelFaces {
    std::vector<Face> faces;
    Tolerances tolerances;
    glm::dvec3 origin_m{0.0};
    double unit_m = 1.0;
    HidingGraph rigid; ///< pairs within turning parts, which hold for every eye; without cycles
    HidingGraph
        ignored; ///< pairs that meet as they turn, both ways; no order can be right for them
    std::vector<std::string> notes; ///< turning parts whose polygons no order paints rightly

    /// A plane of the faces' space in the model's.
    Plane in_model(const Plane& plane) const;

    /// A plane of the model in the faces' space.
    Plane in_faces(const Plane& plane) const;
};

/// Outlines are drawn in by 1e-6 of the radius or, in models whose polygons are less flat than
/// that, by twice the largest distance of a corner from its polygon's plane.
ModelFaces model_faces(const models::polygons::PolygonModel& model, const glm::dvec3& origin_m);

} // namespace octant::visuals::draworder
