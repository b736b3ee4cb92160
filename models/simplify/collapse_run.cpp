// Edge collapses, the cheapest first. The new vertex always lies where quadrics are least
// (vertex_quadrics.cpp), but for Chooser::Volumes; the cost decides the order.
//
// - Chooser::Quadrics: the cost is the quadric itself, as in M. Garland, P. Heckbert, "Surface
//   Simplification Using Quadric Error Metrics", 1997.
// - Chooser::Distances: the cost is how much the sum of squared distances between points of the
//   original surface and the current surface would grow, looked at both ways. This is the distance
//   to triangles that Y. Kim and B. U. Lee propose ("Error measure for vertex simplification",
//   2005, section II.2), but against the original surface instead of the mesh before the collapse.
//   As it is expensive, it is evaluated lazily: a collapse only marks the edges around it as
//   unchecked, and an unchecked edge is evaluated anew when its old cost reaches the top of the
//   heap.
// - Chooser::Peaks: the same and more where a distance gets far larger than is usual: a sum of
//   squares hardly sees a single peak, and where most triangles stay, no later step lowers it.
// - Chooser::Volumes: place and cost without memory (volume_place.cpp), evaluated lazily too.
#include "models/simplify/collapse_run.h"

#include "models/simplify/volume_place.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::models::simplify {

namespace {

/// Triangles lower than this are never looked at again, and others each time that the error has
/// doubled: by then more of them are negligible. Working units.
constexpr double least_error = 1e-5;

/// The last collapse is one at a border, which takes a single triangle, unless that costs more than
/// so many times the cheapest one, which would take two and leave one too few: some ten times as
/// far off there.
constexpr float most_for_one_more = 100.0F;

double squared(double x) {
    return x * x;
}

} // namespace

Strictness
first_strictness(const WorkingSurface& surface, Chooser chooser, const SimplifyOptions& options) {
    if (chooser == Chooser::Peaks) {
        return surface.coloured() ? Strictness::Normal : Strictness::Strips;
    }
    const bool keeps_out_slivers =
        chooser == Chooser::Distances && (surface.coloured() || !options.slivers_too);
    return keeps_out_slivers || !options.low_may_turn ? strictness_for(surface) : Strictness::Loose;
}

CollapseRun::CollapseRun(
    CollapsingSurface& collapsing,
    Chooser chooser,
    TrackedPoints* points,
    const measure::TriangleBvh* tree,
    const SimplifyOptions& options)
    : collapsing_(collapsing)
    , surface_(collapsing.surface())
    , chooser_(chooser)
    , points_(points)
    , length_share_(options.length_share)
    , low_may_turn_(options.low_may_turn)
    , heap_(surface_.mesh.face_slots() * 3)
    , has_parked_(surface_.mesh.vertex_slots(), false)
    , checked_(surface_.mesh.face_slots() * 3, false)
    , looked_back_(surface_.mesh.face_slots() * 3, false)
    , tree_(tree)
    , back_samples_(sample_grid(3))
    , strictness_(first_strictness(surface_, chooser, options))
    , avoided2_(squared(options.avoided_m / collapsing.units().diagonal_m))
    , filled_at_(least_error) {
    assert(measures_distances(chooser) == (points != nullptr));
    for (std::uint32_t face = 0; face < surface_.mesh.face_slots(); ++face) {
        area_ += 0.5 * glm::length(area_vector(surface_.corner_places(face)));
    }
    if (!collapsing.collapses().empty()) {
        error_ = collapsing.collapses().back().error_m / collapsing.units().diagonal_m;
        filled_at_ = std::max(filled_at_, error_);
    }
}

/// Whether one of the goals is reached.
bool CollapseRun::is_met(const Goal& goal) const {
    const CollapsibleMesh& mesh = surface_.mesh;
    return (goal.vertices && mesh.vertex_count() <= *goal.vertices) ||
           (goal.faces && mesh.face_count() <= *goal.faces) ||
           (goal.error_m && error_ * collapsing_.units().diagonal_m > *goal.error_m);
}

/// Puts all edges into the heap.
void CollapseRun::fill() {
    const CollapsibleMesh& mesh = surface_.mesh;
    for (HalfEdge h = 0; h < mesh.face_slots() * 3; ++h) {
        if (mesh.face_is_there(face_of(h)) && mesh.edge_of(h) == h) {
            update_cost(h);
        }
    }
}

/// Puts edges into the heap that were taken out of it, once the error allows more.
void CollapseRun::fill_again() {
    if (!low_may_turn_ || error_ < 2.0 * filled_at_) {
        return;
    }
    filled_at_ = error_;
    const CollapsibleMesh& mesh = surface_.mesh;
    for (HalfEdge h = 0; h < mesh.face_slots() * 3; ++h) {
        if (mesh.face_is_there(face_of(h)) && mesh.edge_of(h) == h && !heap_.holds(h)) {
            update_cost(h);
        }
    }
}

void CollapseRun::run(const Goal& goal, const ShowProgress& show_progress) {
    const std::size_t start = collapsing_.first_faces();
    const std::size_t wanted = wanted_faces(goal);
    while (!is_met(goal)) {
        HalfEdge h = none;
        if (!next_edge(h)) {
            return;
        }
        if (goal.faces && surface_.mesh.face_count() == *goal.faces + 1) {
            h = taking_one(h);
        }
        collapse(h, placed(h));
        fill_again();
        const std::size_t done = start - surface_.mesh.face_count();
        if (show_progress && collapsing_.collapses().size() % 256 == 0 && start > wanted) {
            show_progress(
                std::min(1.0, static_cast<double>(done) / static_cast<double>(start - wanted)));
        }
    }
}

/// The cheapest edge of a border where `h`, the cheapest of all, is none and costs not far less: it
/// takes one triangle instead of two.
HalfEdge CollapseRun::taking_one(HalfEdge h) {
    const CollapsibleMesh& mesh = surface_.mesh;
    HalfEdge best = mesh.twin(h) == none ? h : none;
    for (HalfEdge side = 0; side < mesh.face_slots() * 3 && mesh.twin(h) != none; ++side) {
        if (!mesh.face_is_there(face_of(side)) || mesh.twin(side) != none) {
            continue;
        }
        update_cost(side);
        if (!heap_.holds(side) || !is_allowed(side, placed(side))) {
            continue;
        }
        if (measures_distances(chooser_)) {
            leads_too_far(side); // Its cost rises then.
        }
        best = best == none || heap_.cost(side) < heap_.cost(best) ? side : best;
    }
    return best != none && heap_.cost(best) <= most_for_one_more * heap_.cost(h) ? best : h;
}

/// Finds the edge to collapse next. When no edge is allowed any more, the strictness is relaxed and
/// all edges are tried again. Returns false at the end.
bool CollapseRun::next_edge(HalfEdge& h) {
    while (true) {
        if (heap_.empty()) {
            if (strictness_ == Strictness::None) {
                return false;
            }
            if (filled_) {
                strictness_ =
                    strictness_ == Strictness::Loose ? Strictness::None : Strictness::Loose;
            }
            filled_ = true;
            fill();
            if (heap_.empty()) {
                continue;
            }
        }
        h = heap_.top();
        if (!sums_planes(chooser_) && !checked_[h]) {
            update_cost(h);
            continue;
        }
        if (measures_distances(chooser_)) {
            if (leads_too_far(h)) {
                continue;
            }
            return true;
        }
        if (is_allowed(h, placed(h))) {
            return true;
        }
        heap_.remove(h);
        has_parked_[surface_.mesh.origin(h)] = true;
        has_parked_[surface_.mesh.target(h)] = true;
    }
}

/// Where the vertex goes that an edge collapses into.
Placement CollapseRun::placed(HalfEdge h) {
    if (chooser_ != Chooser::Volumes || surface_.locks_border()) {
        return collapsing_.quadrics().placement(surface_, h);
    }
    surface_.mesh.ring_of(h, ring_);
    return volume_placement(surface_, h, ring_);
}

/// Whether an edge may collapse: link condition first, then the guard against fold-overs and
/// slivers.
bool CollapseRun::is_allowed(HalfEdge h, const Placement& placement) {
    if (!surface_.may_collapse(h)) {
        return false;
    }
    surface_.mesh.ring_of(h, ring_);
    const double negligible = low_may_turn_ ? error_ : 0.0;
    return may_move(surface_, ring_, placement.place, strictness_, negligible);
}

/// Puts an edge into the heap with its present cost, or takes it out where it may not collapse.
void CollapseRun::update_cost(HalfEdge edge) {
    checked_[edge] = true;
    looked_back_[edge] = false;
    const Placement placement = placed(edge);
    if (!measures_distances(chooser_)) {
        heap_.set(edge, static_cast<float>(placement.cost + length_cost(edge, placement)));
        return;
    }
    if (!is_allowed(edge, placement)) {
        heap_.remove(edge);
        return;
    }
    heap_.set(edge, static_cast<float>(surface_cost(edge, placement)));
}

/// Collapses an edge, moves the tracked points to their new nearest triangles and updates the costs
/// around it.
void CollapseRun::collapse(HalfEdge h, const Placement& placement) {
    const CollapsibleMesh& mesh = surface_.mesh;
    const std::uint32_t kept = mesh.origin(h);
    mesh.ring_of(h, ring_);
    if (points_ != nullptr) {
        squares_ += surface_increase(h, placement);
        ring_faces_.clear();
        for (const RingFace& face : ring_) {
            ring_faces_.push_back(face.face);
        }
        const float most2 = points_->assign(cost_.block(), faces_, ring_faces_);
        error_ = std::max(error_, std::sqrt(static_cast<double>(most2)));
    } else if (placement.weight > 0.0) {
        error_ = std::max(error_, std::sqrt(placement.cost / placement.weight));
    }
    for (const HalfEdge side : {h, mesh.twin(h)}) {
        if (side != none) {
            heap_.remove(mesh.edge_of(side));
            heap_.remove(mesh.edge_of(next_of(side)));
            heap_.remove(mesh.edge_of(previous_of(side)));
        }
    }
    collapsing_.collapse(h, placement, error_);
    update_around(kept);
}

/// Updates the edges at a vertex, marks all edges one ring further as unchecked, and puts those of
/// them that are not there back into the heap.
void CollapseRun::update_around(std::uint32_t vertex) {
    const CollapsibleMesh& mesh = surface_.mesh;
    mesh.edges_around(vertex, [&](HalfEdge h) {
        const std::uint32_t other = mesh.origin(h) == vertex ? mesh.target(h) : mesh.origin(h);
        if (sums_planes(chooser_) && !has_parked_[other]) {
            return;
        }
        has_parked_[other] = false;
        mesh.edges_around(other, [&](HalfEdge far) {
            const HalfEdge edge = mesh.edge_of(far);
            checked_[edge] = false;
            if (!heap_.holds(edge)) {
                heap_.set(edge, heap_.cost(edge));
            }
        });
    });
    mesh.edges_around(vertex, [&](HalfEdge h) { update_cost(mesh.edge_of(h)); });
}

} // namespace octant::models::simplify
