#pragma once

#include "visuals/draworder/model_faces.h"
#include "visuals/draworder/occlusion.h"
#include "visuals/draworder/occlusion_graph.h"
#include "visuals/draworder/view_region.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Where polygons lie to a plane that cuts a region, seen from one of its sides.
struct PlaneSideSets {
    PolygonSet front_or_on;
    PolygonSet back_or_on;
};

/// Builds the hiding graphs of a model's faces over regions of eye space. Keeps a reference to the faces; its memory is
/// reused.
class OcclusionGraphBuilder {
public:
    explicit OcclusionGraphBuilder(const ModelFaces& faces) : faces_(faces), test_(faces.tolerances) {}

    const ModelFaces& model() const { return faces_; }

    /// The graph of all pairs for all eyes of a region. Pairs that collide as they turn are left out.
    OcclusionGraph all(const ViewRegion& region);

    /// Those edges of `parent`, the graph of a larger region, that remain in this region, for the rows `among`. Nothing
    /// else needs a test, because a polygon that hides nothing of another for any eye of a region does not do so for a
    /// part of it.
    OcclusionGraph surviving(
        const ViewRegion& region, const OcclusionGraph& parent, std::span<const std::uint32_t> among);

    /// The edges of `parent` that remain in front of a plane, by where polygons lie to it alone: what is behind the
    /// plane or in it hides nothing that is in front of it or in it. For the rows `among`.
    OcclusionGraph remaining_in_front(
        const OcclusionGraph& parent, std::span<const std::uint32_t> among, const PlaneSideSets& sides) const;

    /// The edges of `parent` that remain for a single eye, for the rows `among`.
    OcclusionGraph at_eye(const glm::dvec3& eye, const OcclusionGraph& parent, std::span<const std::uint32_t> among);

    /// The polygons that face some eye of a region.
    PolygonSet listed(const ViewRegion& region) const;

private:
    /// Prepares occludes() for a region and a face `a`: cuts the region to the front of `a`. Returns false when nothing
    /// is left, so that no eye sees `a`.
    bool clip_to_front(const ViewRegion& region, const Face& a);
    /// Whether `b` hides part of `a` for some eye of the prepared region.
    bool occludes(std::size_t b, std::size_t a);

    const ModelFaces& faces_;
    OcclusionTest test_;
    /// The part of the region that sees face `a` from its front.
    std::optional<ViewRegion> region_in_front_of_a_;
    std::vector<glm::dvec4> generators_of_a_;
    std::vector<glm::dvec4> generators_;
};

} // namespace octant::visuals::draworder
