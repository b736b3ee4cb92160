#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/face.h"
#include "visuals/draworder/hiding_graph.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// A model prepared for hiding tests: face i stands for polygon i. The unit of length is the
/// model's radius about `origin_m`, which is the origin; axes are the body's.
struct ModelFaces {
    std::vector<Face> faces;
    Tolerances tolerances;
    glm::dvec3 origin_m{0.0};
    double unit_m = 1.0;
    /// Edges within turning parts, whose polygons keep their places to each other, and from what
    /// lies under another polygon in one plane to that one, which is later in the file. They hold
    /// for every eye and have no cycles.
    HidingGraph rigid;
    /// Pairs that collide as they turn, in both directions; no order can be right for them.
    HidingGraph ignored;
    /// Messages about turning parts whose polygons no order paints correctly.
    std::vector<std::string> notes;

    /// Converts a plane of the faces' space to body axes, metres.
    Plane in_model(const Plane& plane) const;

    /// Converts a plane in body axes to the faces' space.
    Plane in_faces(const Plane& plane) const;
};

/// Prepares a model. Outlines are shrunk by 1e-6 of the radius or, in models whose polygons are
/// less flat than that, by twice the largest distance of a corner from its polygon's plane.
ModelFaces model_faces(const models::polygons::PolygonModel& model, const glm::dvec3& origin_m);

} // namespace octant::visuals::draworder
