// Hiding graphs over regions: applies the exact test of hiding.h to all pairs or to those that may have changed, and
// avoids cutting the region where a cheaper question decides.
#include "visuals/draworder/occlusion_graph_builder.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace octant::visuals::draworder {

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

PolygonSet OcclusionGraphBuilder::listed(const ViewRegion& region) const {
    PolygonSet set(faces_.faces.size());
    for (std::size_t i = 0; i < faces_.faces.size(); ++i) {
        const auto& plane = faces_.faces[i].plane;
        if (!plane || region.intersects_front_of(*plane)) { set.add(i); }
    }
    return set;
}

} // namespace octant::visuals::draworder
