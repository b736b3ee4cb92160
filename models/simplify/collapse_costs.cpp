// What a collapse costs: how much farther off the surface gets by it, both ways, and more where it
// leads farther away than is wanted.
#include "models/simplify/collapse_run.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace octant::models::simplify {

namespace {

/// For Chooser::Peaks: a distance beyond so many root mean squares is a peak.
constexpr double peak_height = 2.0;

} // namespace

/// How much squared distances grow by a collapse, both ways, whose ring must be in ring_.
double CollapseRun::surface_cost(HalfEdge h, const Placement& placement) {
    const double there = surface_increase(h, placement);
    return there + peak_cost() + avoided_cost() + cost_.way_back(surface_, ring_, placement.place);
}

/// What the largest distance of the collapse that was measured last adds to its cost: as if all
/// around it were as far off.
double CollapseRun::peak_cost() const {
    if (chooser_ != Chooser::Peaks || !(area_ > 0.0)) {
        return 0.0;
    }
    const double usual2 = peak_height * peak_height * squares_ / area_;
    return std::max(0.0, cost_.most2() - usual2) * cost_.area();
}

/// What a collapse that was measured last costs more because it leads too far away: more than any
/// other one could, the least far first.
double CollapseRun::avoided_cost() const {
    return cost_.most2() > avoided2_ ? area_ * cost_.most2() : 0.0;
}

/// Looks back from the triangles that a collapse would leave to the original, once for each time
/// that its cost was found. Where one of them is too far away, the cost rises; true then.
bool CollapseRun::leads_too_far(HalfEdge h) {
    if (std::isinf(avoided2_) || looked_back_[h]) {
        return false;
    }
    looked_back_[h] = true;
    const glm::dvec3 place = placed(h).place;
    surface_.mesh.ring_of(h, ring_);
    double most2 = 0.0;
    for (const RingFace& face : ring_) {
        const std::array<glm::dvec3, 3> corners = moved_corners(surface_, face, place);
        for (const TriangleSample& sample : back_samples_) {
            if (sample.weights.x > 0.0) { // The others do not move.
                const glm::dvec3 at = sample.weights.x * corners[0] +
                                      sample.weights.y * corners[1] + sample.weights.z * corners[2];
                most2 = std::max(most2, tree_->nearest(at).distance2);
            }
        }
    }
    if (!(most2 > avoided2_) || heap_.cost(h) >= static_cast<float>(area_ * most2)) {
        return false;
    }
    heap_.set(h, static_cast<float>(area_ * most2));
    return true;
}

/// The cost that length_share adds, so that short edges go first and regions stay round.
double CollapseRun::length_cost(HalfEdge edge, const Placement& placement) const {
    const CollapsibleMesh& mesh = surface_.mesh;
    const double length =
        glm::distance(surface_.places[mesh.origin(edge)], surface_.places[mesh.target(edge)]);
    const double off = length_share_ * length;
    return placement.weight * off * off;
}

/// How much the squared distances of the tracked points grow by a collapse. The ring of the edge
/// must be in ring_.
double CollapseRun::surface_increase(HalfEdge h, const Placement& placement) {
    faces_.clear();
    faces_.push_back(face_of(h));
    if (surface_.mesh.twin(h) != none) {
        faces_.push_back(face_of(surface_.mesh.twin(h)));
    }
    for (const RingFace& face : ring_) {
        faces_.push_back(face.face);
    }
    cost_.gather(*points_, faces_);
    cost_.set_triangles(surface_, ring_, placement.place, placement.colour);
    return cost_.increase();
}

} // namespace octant::models::simplify
