// From a model in metres to faces in units of its radius, with what is known about turning parts before any eye is
// looked at: which polygons of one part hide which, and which parts collide; and with what is known about polygons that
// overlap in one plane.
#include "visuals/draworder/model_faces.h"

#include "visuals/draworder/components.h"
#include "visuals/draworder/occlusion.h"
#include "visuals/draworder/swept_face.h"
#include "visuals/separation/convex_separation.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::visuals::draworder {

namespace {

/// The radius of the model about a point; 1 for a model without extent.
double farthest_m(const models::polygons::PolygonModel& model, const glm::dvec3& origin_m) {
    double farthest = 0.0;
    for (const std::uint32_t vertex : model.corner_vertices) {
        farthest = std::max(farthest, glm::distance(model.vertices_m[vertex], origin_m));
    }
    return farthest > 0.0 ? farthest : 1.0;
}

/// The face of a polygon as it stands in the file.
Face outline_of(const models::polygons::PolygonModel& model, std::size_t polygon, const ModelFaces& faces) {
    std::vector<glm::dvec3> corners;
    for (const std::uint32_t vertex : model.corners(polygon)) {
        corners.push_back((model.vertices_m[vertex] - faces.origin_m) / faces.unit_m);
    }
    const Plane plane = faces.to_face_space(models::polygons::plane_of(model, polygon));
    return outline_face(corners, plane, faces.tolerances.inset);
}

/// Finds the edges within one turning part for eyes everywhere. Where they form cycles, those edges are left out that
/// an order by polygon number breaks, and a note says so.
void add_rigid_pairs(const models::polygons::PolygonModel& model, std::uint32_t pivot, ModelFaces& out) {
    OcclusionTest test(out.tolerances);
    PolygonSet part(out.faces.size());
    std::vector<Face> still(out.faces.size());
    for (std::size_t i = 0; i < out.faces.size(); ++i) {
        if (out.faces[i].pivot == pivot) {
            part.add(i);
            still[i] = outline_of(model, i, out);
        }
    }
    const ViewRegion all = ViewRegion::all_space();
    OcclusionGraph graph(out.faces.size());
    for_each_bit(part.words(), [&](std::size_t a) {
        const ViewRegion before_a = *all.cut(*still[a].plane);
        for_each_bit(part.words(), [&](std::size_t b) {
            const bool possible = a != b && test.possible(still[b], still[a]);
            const auto eyes = possible ? before_a.cut(*still[b].plane) : std::nullopt;
            std::vector<glm::dvec4> generators;
            if (eyes) {
                eyes->append_generators(generators);
                if (test.occludes(still[b], still[a], generators)) { graph.add(b, a); }
            }
        });
    });
    const TopologicalOrder sequence = topological_order(out.faces.size(), graph.precedences(part));
    if (sequence.broken_cycles > 0) {
        out.notes.push_back(fmt::format("{}: its polygons hide one another as it turns; no one order is right for all",
            model.parts[model.pivots[pivot].part]));
    }
    std::vector<std::size_t> place(out.faces.size(), 0);
    for (std::size_t i = 0; i < sequence.order.size(); ++i) { place[sequence.order[i]] = i; }
    for (const Precedence& pair : graph.precedences(part)) {
        if (place[pair.first] < place[pair.later]) { out.rigid.add(pair.later, pair.first); }
    }
}

/// Marks the pairs of a turning polygon with others that it collides with at some angle.
void find_meetings(const models::polygons::PolygonModel& model, std::size_t polygon, ModelFaces& out) {
    const OcclusionTest test(out.tolerances);
    const Face& face = out.faces[polygon];
    for (std::size_t other = 0; other < out.faces.size(); ++other) {
        const Face& met = out.faces[other];
        const bool known = met.pivot && other < polygon;
        const bool apart = known || met.pivot == face.pivot || !test.possible(face, met) || !test.possible(met, face) ||
                           separation::separable(face.corners, met.corners, {});
        if (apart) { continue; }
        out.ignored.add(polygon, other);
        out.ignored.add(other, polygon);
        const std::string note = fmt::format("{} and {} meet as they turn; no order is right for them",
            model.parts[model.polygons[polygon].part], model.parts[model.polygons[other].part]);
        if (std::ranges::find(out.notes, note) == out.notes.end()) { out.notes.push_back(note); }
    }
}

/// Of polygons that overlap in one plane the later one of the file hides the earlier one. The numbers of pieces say
/// nothing about that, their parents do.
void add_decals(const models::polygons::PolygonModel& model, ModelFaces& out) {
    for (std::size_t later = 0; later < out.faces.size(); ++later) {
        for (std::size_t first = 0; first < out.faces.size(); ++first) {
            if (model.parent_of(first) < model.parent_of(later) &&
                overlap_in_plane(out.faces[first], out.faces[later], out.tolerances.inset)) {
                out.rigid.add(later, first);
            }
        }
    }
}

} // namespace

Plane ModelFaces::in_model(const Plane& plane) const {
    return {plane.normal, plane.offset_m * unit_m - glm::dot(plane.normal, origin_m)};
}

Plane ModelFaces::to_face_space(const Plane& plane) const {
    return {plane.normal, distance_m(plane, origin_m) / unit_m};
}

ModelFaces model_faces(const models::polygons::PolygonModel& model, const glm::dvec3& origin_m) {
    const std::size_t count = model.polygons.size();
    ModelFaces out{.faces = {},
        .tolerances = {},
        .origin_m = origin_m,
        .unit_m = farthest_m(model, origin_m),
        .rigid = OcclusionGraph(count),
        .ignored = OcclusionGraph(count),
        .notes = {}};
    for (std::size_t i = 0; i < count; ++i) {
        const auto pivot = models::polygons::pivot_of(model, i);
        out.faces.push_back(
            pivot ? swept_face(model, i, model.pivots[*pivot], origin_m, 1.0 / out.unit_m, out.tolerances.inset)
                  : outline_of(model, i, out));
        out.faces.back().pivot = pivot;
    }
    for (std::uint32_t pivot = 0; pivot < model.pivots.size(); ++pivot) { add_rigid_pairs(model, pivot, out); }
    add_decals(model, out);
    for (std::size_t i = 0; i < count; ++i) {
        if (out.faces[i].pivot) { find_meetings(model, i, out); }
    }
    return out;
}

} // namespace octant::visuals::draworder
