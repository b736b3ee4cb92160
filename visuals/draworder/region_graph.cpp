#include "visuals/draworder/region_graph.h"

#include <optional>

namespace octant::visuals::draworder {

namespace {

std::optional<EyeRegion> before(const EyeRegion& region, const Face& face) {
    return face.plane ? region.cut(*face.plane) : region;
}

} // namespace

bool RegionGraphs::hides(std::size_t b, std::size_t a, const EyeRegion& before_a) {
    ++tests_;
    const auto before_both = before(before_a, faces_.faces[b]);
    if (!before_both) {
        return false;
    }
    generators_.clear();
    before_both->append_generators(generators_);
    return test_.hides(faces_.faces[b], faces_.faces[a], generators_);
}

HidingGraph RegionGraphs::all(const EyeRegion& region) {
    const std::vector<Face>& faces = faces_.faces;
    HidingGraph graph = faces_.rigid;
    for (std::size_t a = 0; a < faces.size(); ++a) {
        const auto before_a = before(region, faces[a]);
        for (std::size_t b = 0; b < faces.size() && before_a; ++b) {
            const bool compared = b != a && !(faces[a].pivot && faces[a].pivot == faces[b].pivot) &&
                                  !faces_.ignored.hides(b, a);
            if (compared && test_.possible(faces[b], faces[a]) && hides(b, a, *before_a)) {
                graph.add(b, a);
            }
        }
    }
    return graph;
}

HidingGraph RegionGraphs::surviving(
    const EyeRegion& region,
    const HidingGraph& parent,
    std::span<const std::uint32_t> among,
    const SideSets* sides) {
    HidingGraph graph(parent.count());
    for (const std::uint32_t a : among) {
        const auto before_a = before(region, faces_.faces[a]);
        if (!before_a) {
            continue;
        }
        const bool a_before = sides != nullptr && sides->front_or_on.has(a);
        for_each_bit(parent.row(a), [&](std::size_t b) {
            const bool parted = a_before && sides->back_or_on.has(b);
            if (faces_.rigid.hides(b, a) || (!parted && hides(b, a, *before_a))) {
                graph.add(b, a);
            }
        });
    }
    return graph;
}

HidingGraph RegionGraphs::at_eye(
    const glm::dvec3& eye, const HidingGraph& parent, std::span<const std::uint32_t> among) {
    HidingGraph graph(parent.count());
    const std::vector<glm::dvec4> eyes{glm::dvec4(eye, 1.0)};
    const auto faces_eye = [&](std::size_t polygon) {
        const auto& plane = faces_.faces[polygon].plane;
        return !plane || distance_m(*plane, eye) > faces_.tolerances.on_plane;
    };
    for (const std::uint32_t a : among) {
        if (!faces_eye(a)) {
            continue;
        }
        for_each_bit(parent.row(a), [&](std::size_t b) {
            ++tests_;
            const bool hidden =
                faces_eye(b) &&
                (faces_.rigid.hides(b, a) || test_.hides(faces_.faces[b], faces_.faces[a], eyes));
            if (hidden) {
                graph.add(b, a);
            }
        });
    }
    return graph;
}

PolygonSet RegionGraphs::listed(const EyeRegion& region) const {
    PolygonSet set(faces_.faces.size());
    for (std::size_t i = 0; i < faces_.faces.size(); ++i) {
        const auto& plane = faces_.faces[i].plane;
        if (!plane || region.reaches_front_of(*plane)) {
            set.add(i);
        }
    }
    return set;
}

} // namespace octant::visuals::draworder
