#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/face.h"
#include "visuals/draworder/occlusion_graph.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// A model prepared for hiding tests: face i stands for polygon i. The unit of length is the model's radius about
/// `origin_m`, which is the origin; axes are the body's.
struct ModelFaces {
    std::vector<Face> faces;
    Tolerances tolerances;
    glm::dvec3 origin_m{0.0};
    double unit_m = 1.0;
    /// Edges within turning parts, whose polygons keep their places to each other, and from each polygon to later ones
    /// that overlap it in its plane. They hold for every eye and have no cycles.
    OcclusionGraph rigid;
    /// Pairs that collide as they turn, in both directions; no order can be right for them.
    OcclusionGraph ignored;
    /// Messages about turning parts whose polygons no order paints correctly.
    std::vector<std::string> notes;

    /// Converts a plane of the faces' space to body axes, metres.
    Plane in_model(const Plane& plane) const;

    /// Converts a plane in body axes to the faces' space.
    Plane to_face_space(const Plane& plane) const;
};

/// Prepares a planar model (models/planar/planar_model.h). Outlines are shrunk by planar_tolerance times the radius.
ModelFaces model_faces(const models::polygons::PolygonModel& model, const glm::dvec3& origin_m);

} // namespace octant::visuals::draworder
