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

/// Where the polygons lie to a plane that cuts a region, seen from one of its sides.
struct SideSets {
    PolygonSet front_or_on;
    PolygonSet back_or_on;
};

/// Builds the hiding graphs of a model's faces over regions of eye space. Keeps a reference to the
/// faces. Reuses its storage.
class RegionGraphs {
public:
    explicit RegionGraphs(const ModelFaces& faces)
        : faces_(faces)
        , test_(faces.tolerances) {}

    const ModelFaces& model() const { return faces_; }

    /// All pairs, for all eyes of a region. Between polygons that meet as they turn there are none.
    HidingGraph all(const EyeRegion& region);

    /// Of the pairs of `parent`, a graph of a region that holds this one, those of this region: a
    /// pair that hides nothing in a region hides nothing in a part of it. Rows of `among` only.
    HidingGraph surviving(
        const EyeRegion& region, const HidingGraph& parent, std::span<const std::uint32_t> among);

    /// What the place of polygons alone leaves of them before a plane: what lies behind or on it
    /// hides nothing that lies before or on it. Rows of `among` only.
    HidingGraph not_parted(
        const HidingGraph& parent,
        std::span<const std::uint32_t> among,
        const SideSets& sides) const;

    /// The surviving pairs for one eye.
    HidingGraph
    at_eye(const glm::dvec3& eye, const HidingGraph& parent, std::span<const std::uint32_t> among);

    /// Polygons that face some eye of a region.
    PolygonSet listed(const EyeRegion& region) const;

private:
    bool go_before(const EyeRegion& region, const Face& a);
    bool hides(std::size_t b, std::size_t a);

    const ModelFaces& faces_;
    HidingTest test_;
    std::optional<EyeRegion> before_a_; ///< what of a region sees A from its front
    std::vector<glm::dvec4> generators_of_a_;
    std::vector<glm::dvec4> generators_;
};

} // namespace octant::visuals::draworder
