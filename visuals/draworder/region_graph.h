#pragma once

#include "visuals/draworder/eye_region.h"
#include "visuals/draworder/hiding.h"
#include "visuals/draworder/hiding_graph.h"
#include "visuals/draworder/model_faces.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::draworder {

/// Where polygons lie to a plane that cuts a region, seen from one of its sides.
struct SideSets {
    PolygonSet front_or_on;
    PolygonSet back_or_on;
};

/// Builds the hiding graphs of a model's faces over regions of eye space. Keeps a reference to the
/// faces; its memory is reused.
class RegionGraphs {
public:
    explicit RegionGraphs(const ModelFaces& faces)
        : faces_(faces)
        , test_(faces.tolerances) {}

    const ModelFaces& model() const { return faces_; }

    /// The graph of all pairs for all eyes of a region. Pairs that collide as they turn are left
    /// out.
    HidingGraph all(const EyeRegion& region);

    /// Those edges of `parent`, the graph of a larger region, that remain in this region, for the
    /// rows `among`. Nothing else needs a test, because a polygon that hides nothing of another for
    /// any eye of a region does not do so for a part of it.
    HidingGraph surviving(
        const EyeRegion& region, const HidingGraph& parent, std::span<const std::uint32_t> among);

    /// The edges of `parent` that remain in front of a plane, by where polygons lie to it alone:
    /// what is behind the plane or in it hides nothing that is in front of it or in it. For the
    /// rows `among`.
    HidingGraph not_parted(
        const HidingGraph& parent,
        std::span<const std::uint32_t> among,
        const SideSets& sides) const;

    /// The edges of `parent` that remain for a single eye, for the rows `among`.
    HidingGraph
    at_eye(const glm::dvec3& eye, const HidingGraph& parent, std::span<const std::uint32_t> among);

    /// The polygons that face some eye of a region.
    PolygonSet listed(const EyeRegion& region) const;

private:
    /// Prepares hides() for a region and a face `a`: cuts the region to the front of `a`. Returns
    /// false when nothing is left, so that no eye sees `a`.
    bool go_before(const EyeRegion& region, const Face& a);
    /// Whether `b` hides part of `a` for some eye of the prepared region.
    bool hides(std::size_t b, std::size_t a);

    const ModelFaces& faces_;
    HidingTest test_;
    /// The part of the region that sees face `a` from its front.
    std::optional<EyeRegion> before_a_;
    std::vector<glm::dvec4> generators_of_a_;
    std::vector<glm::dvec4> generators_;
};

} // namespace octant::visuals::draworder
