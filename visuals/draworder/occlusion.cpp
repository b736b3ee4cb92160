// From a model to the graph of what occludes what for the eyes of a region: faces of polygons and of turning parts, the
// exact test of a pair, then the test applied to all pairs or to those that may have changed.
#include "visuals/draworder/occlusion.h"

#include "models/polygons/polygon_outlines.h"
#include "sim/base/axes.h"
#include "sim/base/units.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/separation/convex_separation.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace octant::visuals::draworder {

// Outlines for the occlusion test. Polygons of a model share edges, and rounding would let them overlap a little and
// seem to hide one another; shrinking each outline by an inset that is larger than the rounding prevents that.

namespace {

/// At sharper corners the offset is limited, because they would move out of the polygon.
constexpr double sharpest = 0.01;

/// The unit normal of an edge that points into a counter-clockwise outline.
glm::dvec2 inward_of(const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 along = to - from;
    const double length = glm::length(along);
    return length > 0.0 ? glm::dvec2(-along.y, along.x) / length : glm::dvec2(0.0);
}

/// The outline with every edge moved inwards.
std::vector<glm::dvec2> drawn_in(const std::vector<glm::dvec2>& outline, double inset) {
    glm::dvec2 middle(0.0);
    for (const glm::dvec2& corner : outline) { middle += corner / static_cast<double>(outline.size()); }
    double nearest = std::numeric_limits<double>::max();
    for (const glm::dvec2& corner : outline) { nearest = std::min(nearest, glm::distance(corner, middle)); }
    const double step = std::min(inset, nearest / 5.0);
    std::vector<glm::dvec2> inner;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t count = outline.size();
        const glm::dvec2 before = inward_of(outline[(i + count - 1) % count], outline[i]);
        const glm::dvec2 after = inward_of(outline[i], outline[(i + 1) % count]);
        const double share = std::max(1.0 + glm::dot(before, after), sharpest);
        inner.push_back(outline[i] + (before + after) * (step / share));
    }
    return inner;
}

} // namespace

Face outline_face(std::span<const glm::dvec3> corners, const Plane& plane, double inset) {
    Face face;
    face.plane = plane;
    face.outline.assign(corners.begin(), corners.end());
    const bool along_x = std::abs(plane.normal.x) > 0.7;
    const glm::dvec3 aside = along_x ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    face.right = glm::normalize(glm::cross(aside, plane.normal));
    face.up = glm::cross(plane.normal, face.right);
    std::vector<glm::dvec2> outline;
    for (const glm::dvec3& corner : corners) {
        outline.emplace_back(glm::dot(corner, face.right), glm::dot(corner, face.up));
    }
    face.flat = drawn_in(outline, inset);
    for (const glm::dvec2& corner : face.flat) {
        face.corners.push_back(face.right * corner.x + face.up * corner.y - plane.normal * plane.offset_m);
    }
    for (std::size_t i = 0; i < face.flat.size(); ++i) {
        face.edge_directions.push_back(glm::normalize(face.flat[(i + 1) % face.flat.size()] - face.flat[i]));
    }
    return face;
}

namespace {

/// Whether all corners of a face lie behind a plane or on it.
bool behind_or_on(const Face& face, const Plane& plane, double on_plane) {
    return std::ranges::all_of(
        face.corners, [&](const glm::dvec3& corner) { return distance_m(plane, corner) <= on_plane; });
}

} // namespace

std::vector<glm::dvec3> front_part(const std::vector<glm::dvec3>& outline, const Plane& plane, double on_plane) {
    const auto height_of = [&](const glm::dvec3& corner) {
        const double height = distance_m(plane, corner);
        return std::abs(height) <= on_plane ? 0.0 : height;
    };
    std::vector<glm::dvec3> part;
    glm::dvec3 last = outline.back();
    double last_height = height_of(last);
    for (const glm::dvec3& corner : outline) {
        const double height = height_of(corner);
        if (height * last_height < 0.0) {
            part.push_back(last + (corner - last) * (last_height / (last_height - height)));
        }
        if (height >= 0.0) { part.push_back(corner); }
        last = corner;
        last_height = height;
    }
    return part;
}

bool overlap_in_plane(const Face& a, const Face& b, double on_plane) {
    const bool one_plane = a.plane && b.plane && !a.pivot && !b.pivot &&
                           glm::dot(a.plane->normal, b.plane->normal) > 0.0 && behind_or_on(a, *b.plane, on_plane) &&
                           behind_or_on(b, *a.plane, on_plane) &&
                           behind_or_on(a, {-b.plane->normal, -b.plane->offset_m}, on_plane);
    const auto parts = [](const Face& of, const Face& other) {
        return models::polygons::has_separating_edge(of.corners, of.plane->normal, other.corners, 0.0);
    };
    return one_plane && !parts(a, b) && !parts(b, a);
}

namespace {

constexpr int ring_corners = 24; ///< The corners of the regular polygon around a circle.
/// From this cosine on a normal counts as parallel to the axis.
constexpr double perpendicular = 1.0 - 1e-10;

/// Appends a regular polygon around a circle about an axis, counter-clockwise about it.
void append_ring(std::vector<glm::dvec3>& corners, const glm::dvec3& middle, const glm::dvec3& axis, double radius) {
    const glm::dvec3 aside = std::abs(axis.x) > 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(aside, axis));
    const glm::dvec3 up = glm::cross(axis, right);
    const double reach = radius / std::cos(pi / ring_corners);
    for (int i = 0; i < ring_corners; ++i) {
        const double angle_rad = 2.0 * pi * i / ring_corners;
        corners.push_back(middle + (right * std::cos(angle_rad) + up * std::sin(angle_rad)) * reach);
    }
}

/// The face that stands for a polygon of a turning part, chosen so that an order holds at every angle.
///
/// The face contains the polygon at every angle. The occlusion test is monotone in both faces: a polygon that occludes
/// another at some angle does so in the test. So an order that keeps the precedences of these faces is right at every
/// angle, though it may keep some that no angle needs.
///
/// A polygon whose plane is perpendicular to the axis sweeps a ring of that plane. Its face is a regular polygon of 24
/// corners around the ring's outer circle, seen from the same side. Any other polygon sweeps a solid of revolution. Its
/// face is the convex hull of regular polygons around the circles of its corners: a body, which is seen from all sides
/// because the polygon turns.
///
/// Polygons of one part keep their places relative to one another; in their frame the eye moves around them. They are
/// compared at the angle of the file, with eyes everywhere (ModelFaces::rigid).
///
/// `scale` converts metres about `origin_m` to the unit of the face; `inset` is that of Tolerances.
Face swept_face(const models::polygons::PolygonModel& model, std::size_t polygon, const models::polygons::Pivot& pivot,
    const glm::dvec3& origin_m, double scale, double inset) {
    const glm::dvec3 foot = (pivot.point_m - origin_m) * scale;
    const glm::dvec3 normal = models::polygons::normal_of(model, polygon);
    const double facing = glm::dot(normal, pivot.axis);
    double farthest = 0.0;
    double height_sum = 0.0;
    std::vector<glm::dvec3> rings;
    for (const std::uint32_t vertex : model.corners(polygon)) {
        const glm::dvec3 from_foot = (model.vertices_m[vertex] - origin_m) * scale - foot;
        const double height = glm::dot(from_foot, pivot.axis);
        const double radius = glm::length(from_foot - pivot.axis * height);
        farthest = std::max(farthest, radius);
        height_sum += height;
        append_ring(rings, foot + pivot.axis * height, pivot.axis, std::max(radius, inset));
    }
    if (std::abs(facing) < perpendicular) {
        Face body;
        body.corners = rings;
        body.outline = std::move(rings);
        return body;
    }
    const glm::dvec3 up = pivot.axis * (facing > 0.0 ? 1.0 : -1.0);
    const auto count = static_cast<double>(model.corners(polygon).size());
    const glm::dvec3 middle = foot + pivot.axis * (height_sum / count);
    std::vector<glm::dvec3> disc;
    append_ring(disc, middle, up, farthest);
    return outline_face(disc, {up, -glm::dot(up, middle)}, inset);
}

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
    BitSet part(out.faces.size());
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

// The exact occlusion test; OcclusionTest has its derivation. It replaces steps 2 to 4 of the 1989 paper
// (octant_order.cpp), which compare two polygons as seen from one viewpoint, by a test that is right for every eye of a
// region.

namespace {

constexpr double rounding = 1e-12;

/// Whether the sine of the angle from one vector to another, which make a negative cross product, is so by more than
/// rounding, given the square of the length of one of them; the other is a unit.
bool is_clear(double product, double square) {
    return square > rounding * rounding && product * product > rounding * rounding * square;
}

/// An angular sector of at most half a turn, counter-clockwise from `low` to `high`.
class Sector {
public:
    Sector(const glm::dvec2& low, const glm::dvec2& high) : low_(low), high_(high) {}

    /// Widens the sector to contain a direction; false when it would exceed half a turn.
    bool take(const glm::dvec2& direction) {
        const double past_low = cross(low_, direction);
        const double past_high = cross(direction, high_);
        if (past_low >= 0.0 && past_high >= 0.0) { return true; }
        const double square = glm::dot(direction, direction);
        const bool below = past_low < 0.0 && is_clear(past_low, square);
        const bool above = past_high < 0.0 && is_clear(past_high, square);
        if (below && above) { return false; }
        if (below) {
            low_ = direction / std::sqrt(square);
        } else if (above) {
            high_ = direction / std::sqrt(square);
        }
        return true;
    }

private:
    glm::dvec2 low_;
    glm::dvec2 high_;
};

} // namespace

bool OcclusionTest::possible(const Face& b, const Face& a) const {
    if (a.plane && behind_or_on(b, *a.plane, tolerances_.on_plane)) { return false; }
    if (!b.plane) { return true; }
    const Plane back{-b.plane->normal, -b.plane->offset_m};
    return !behind_or_on(a, back, tolerances_.on_plane);
}

bool OcclusionTest::occludes(const Face& b, const Face& a, std::span<const glm::dvec4> eyes) {
    if (!a.plane || !b.plane) { return !separation::separable(b.corners, a.corners, eyes); }
    find_crossings(b, a, eyes);
    if (crossings_.empty()) { return false; }
    for (std::size_t corner = 0; corner < b.flat.size(); ++corner) {
        if (is_separated_at(b, corner)) { return false; }
    }
    return true;
}

void OcclusionTest::find_crossings(const Face& b, const Face& a, std::span<const glm::dvec4> eyes) {
    behind_.clear();
    crossings_.clear();
    const auto flat_of = [&](const glm::dvec3& at) { return glm::dvec2(glm::dot(at, b.right), glm::dot(at, b.up)); };
    const double limit = -tolerances_.on_plane;
    glm::dvec3 last = a.corners.back();
    double last_height = distance_m(*b.plane, last);
    for (const glm::dvec3& corner : a.corners) {
        const double height = distance_m(*b.plane, corner);
        if ((height < limit) != (last_height < limit)) {
            const double share = (limit - last_height) / (height - last_height);
            behind_.emplace_back(flat_of(last + (corner - last) * share), -limit);
        }
        if (height < limit) { behind_.emplace_back(flat_of(corner), -height); }
        last = corner;
        last_height = height;
    }
    for (const glm::dvec4& eye : eyes) {
        const glm::dvec3 at(eye.x, eye.y, eye.z);
        const double raw = glm::dot(b.plane->normal, at) + b.plane->offset_m * eye.w;
        const double height = raw < 1e-10 ? 0.0 : raw;
        const glm::dvec2 flat = flat_of(at);
        for (const glm::dvec3& corner : behind_) {
            const double depth = corner.z;
            const double scale = 1.0 / (height + depth);
            crossings_.emplace_back(
                (glm::dvec2(corner) * height + flat * depth) * scale, (height + depth * eye.w) * scale);
        }
    }
}

bool OcclusionTest::is_separated_at(const Face& b, std::size_t corner) const {
    const glm::dvec2 at = b.flat[corner];
    const glm::dvec2 to_next = b.edge_directions[corner];
    const glm::dvec2 from_last = b.edge_directions[(corner == 0 ? b.edge_directions.size() : corner) - 1];
    if (cross(from_last, to_next) < 0.0) {
        return false; // dented by rounding: lines past its neighbours serve as well
    }
    Sector sector(-to_next, from_last);
    return std::ranges::all_of(
        crossings_, [&](const glm::dvec3& point) { return sector.take(glm::dvec2(point.x, point.y) - at * point.z); });
}

namespace {

/// The part of a region in front of a face; all of it for a body.
std::optional<ViewRegion> before(const ViewRegion& region, const Face& face) {
    return face.plane ? region.cut(*face.plane) : region;
}

} // namespace

bool OcclusionGraphBuilder::clip_to_front(const ViewRegion& region, const Face& a) {
    region_in_front_of_a_ = before(region, a);
    generators_of_a_.clear();
    if (region_in_front_of_a_) { region_in_front_of_a_->append_generators(generators_of_a_); }
    return region_in_front_of_a_.has_value();
}

// A region that is not known well enough counts as one from which B hides part of A: that costs cells and splits, and
// never makes an order wrong. Asks first with those generators of the region only that are in front of B. If B hides
// part of A for these, it does so for the region, which then need not be cut.
bool OcclusionGraphBuilder::occludes(std::size_t b, std::size_t a) {
    const Face& occluder = faces_.faces[b];
    const Face& occluded_polygon = faces_.faces[a];
    if (!region_in_front_of_a_->is_well_conditioned()) { return true; }
    if (!occluder.plane) { return test_.occludes(occluder, occluded_polygon, generators_of_a_); }
    const glm::dvec4 front(occluder.plane->normal, occluder.plane->offset_m);
    generators_.clear();
    double highest = 0.0;
    for (const glm::dvec4& generator : generators_of_a_) {
        const double height = glm::dot(front, generator);
        highest = std::max(highest, height);
        if (height >= 0.0) { generators_.push_back(generator); }
    }
    if (highest <= ViewRegion::on_plane) { return false; }
    if (test_.occludes(occluder, occluded_polygon, generators_)) { return true; }
    if (generators_.size() == generators_of_a_.size()) { return false; }
    const ViewRegion before_both = *region_in_front_of_a_->cut(*occluder.plane);
    if (!before_both.is_well_conditioned()) { return true; }
    generators_.clear();
    before_both.append_generators(generators_);
    return test_.occludes(occluder, occluded_polygon, generators_);
}

OcclusionGraph OcclusionGraphBuilder::all(const ViewRegion& region) {
    const std::vector<Face>& faces = faces_.faces;
    OcclusionGraph graph = faces_.rigid;
    for (std::size_t a = 0; a < faces.size(); ++a) {
        const bool seen = clip_to_front(region, faces[a]);
        for (std::size_t b = 0; b < faces.size() && seen; ++b) {
            const bool compared =
                b != a && !(faces[a].pivot && faces[a].pivot == faces[b].pivot) && !faces_.ignored.occludes(b, a);
            if (compared && test_.possible(faces[b], faces[a]) && occludes(b, a)) { graph.add(b, a); }
        }
    }
    return graph;
}

OcclusionGraph OcclusionGraphBuilder::surviving(
    const ViewRegion& region, const OcclusionGraph& parent, std::span<const std::uint32_t> among) {
    OcclusionGraph graph(parent.count());
    for (const std::uint32_t a : among) {
        if (!clip_to_front(region, faces_.faces[a])) { continue; }
        for_each_bit(parent.row(a), [&](std::size_t b) {
            if (faces_.rigid.occludes(b, a) || occludes(b, a)) { graph.add(b, a); }
        });
    }
    return graph;
}

OcclusionGraph OcclusionGraphBuilder::remaining_in_front(
    const OcclusionGraph& parent, std::span<const std::uint32_t> among, const PlaneSideSets& sides) const {
    OcclusionGraph graph(parent.count());
    for (const std::uint32_t a : among) {
        const auto from = parent.row(a);
        const auto rigid = faces_.rigid.row(a);
        const auto parted = sides.back_or_on.words();
        const std::uint64_t before = sides.front_or_on.has(a) ? ~std::uint64_t{0} : 0;
        const auto to = graph.row(a);
        for (std::size_t word = 0; word < to.size(); ++word) {
            to[word] = from[word] & (rigid[word] | ~(parted[word] & before));
        }
    }
    return graph;
}

OcclusionGraph OcclusionGraphBuilder::at_eye(
    const glm::dvec3& eye, const OcclusionGraph& parent, std::span<const std::uint32_t> among) {
    OcclusionGraph graph(parent.count());
    const std::vector<glm::dvec4> eyes{glm::dvec4(eye, 1.0)};
    const auto faces_eye = [&](std::size_t polygon) {
        const auto& plane = faces_.faces[polygon].plane;
        return !plane || distance_m(*plane, eye) > faces_.tolerances.on_plane;
    };
    for (const std::uint32_t a : among) {
        if (!faces_eye(a)) { continue; }
        for_each_bit(parent.row(a), [&](std::size_t b) {
            const bool occluded =
                faces_eye(b) && (faces_.rigid.occludes(b, a) || test_.occludes(faces_.faces[b], faces_.faces[a], eyes));
            if (occluded) { graph.add(b, a); }
        });
    }
    return graph;
}

BitSet OcclusionGraphBuilder::listed(const ViewRegion& region) const {
    BitSet set(faces_.faces.size());
    for (std::size_t i = 0; i < faces_.faces.size(); ++i) {
        const auto& plane = faces_.faces[i].plane;
        if (!plane || region.intersects_front_of(*plane)) { set.add(i); }
    }
    return set;
}

} // namespace octant::visuals::draworder
