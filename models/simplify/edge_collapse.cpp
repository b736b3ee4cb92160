// Edge collapses, the cheapest first: EdgeCollapse orders them, CollapsingSurface records them, CollapsibleMesh changes
// the connectivity. Quadrics determine the position of the new vertex (quadrics.cpp), the cost determines the order.
//
// - By quadrics: the cost is the quadric itself, as in M. Garland, P. Heckbert, "Surface Simplification Using Quadric
//   Error Metrics", 1997, weighted by area. It is cheap and serves while errors are far below those at the goal.
// - By samples: the cost is how much the error against samples of the original grows, both ways (local_error.cpp). As
//   it is expensive, it is evaluated lazily: a collapse makes the costs of the edges around it old (Known::Old), and an
//   old cost is measured anew when it reaches the top of the heap.
#include "models/simplify/edge_collapse.h"

#include "models/measure/triangle_bvh.h"
#include "models/simplify/edge_heap.h"
#include "models/simplify/local_error.h"
#include "models/simplify/shells.h"
#include "models/simplify/surface_samples.h"
#include "models/simplify/working_surface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::simplify {

namespace {

std::vector<std::uint32_t> counted(std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

} // namespace

CollapsingSurface::CollapsingSurface(WorkingSurface surface, const WorkingUnits& units, const EdgeWeights& weights)
    : surface_(std::move(surface)), units_(units), quadrics_(surface_, weights),
      vertex_numbers_(counted(surface_.mesh.vertex_slots())), face_numbers_(counted(surface_.mesh.face_slots())),
      first_vertices_(surface_.mesh.vertex_slots()) {}

CollapseEffect CollapsingSurface::collapse(HalfEdge h, const VertexPlacement& placement, double error) {
    CollapsibleMesh& mesh = surface_.mesh;
    const std::uint32_t kept = mesh.origin(h);
    const std::uint32_t gone = mesh.target(h);
    const HalfEdge twin = mesh.twin(h);
    Collapse made;
    made.first = vertex_numbers_[kept];
    made.second = vertex_numbers_[gone];
    made.position_m = surface_.to_file(placement.place, units_);
    made.left = face_numbers_[face_of(h)];
    made.right = twin == none ? none : face_numbers_[face_of(twin)];
    made.error_m = error * units_.diagonal_m;
    const CollapseEffect effect = mesh.collapse(h);
    quadrics_.merge(kept, gone);
    surface_.places[kept] = placement.place;
    if (surface_.coloured()) {
        surface_.colours[kept] = placement.colour;
        made.colour = units_.colour_to_file(placement.colour);
    }
    vertex_numbers_[kept] = static_cast<std::uint32_t>(first_vertices_ + collapses_.size());
    if (effect.kind == CollapseEffect::Kind::ClosesHole) { ++holes_closed_; }
    collapses_.push_back(made);
    if (effect.kind == CollapseEffect::Kind::CutsHandle) {
        ++handles_cut_;
        copy_vertex(kept, gone);
        copy_vertex(mesh.origin(effect.third), effect.made);
    }
    return effect;
}

/// Gives a vertex the place, the colour and the quadric of another one.
void CollapsingSurface::copy_vertex(std::uint32_t from, std::uint32_t to) {
    surface_.set_vertex(to, surface_.places[from], surface_.colour_of(from));
    quadrics_.copy(from, to);
}

SlotMap CollapsingSurface::compact() {
    SlotMap kept = surface_.compact();
    quadrics_.keep(kept.vertices);
    compact_slots(vertex_numbers_, kept.vertices);
    compact_slots(face_numbers_, kept.faces);
    return kept;
}

namespace {

/// Of collapses at the same cost, as in a plane, short edges go first: this share of an edge's squared length counts as
/// a squared distance.
constexpr double min_length_share2 = 1e-7;

/// An edge is first put into the heap with this share of its quadric, which mostly is less than its cost by samples:
/// only what comes to the top is measured.
constexpr double guessed_share = 0.1;

class EdgeCollapse {
public:
    EdgeCollapse(CollapsingSurface& collapsing, LocalError* local, Shells* shells, const SimplifyOptions& options)
        : collapsing_(collapsing), surface_(collapsing.surface()), local_(local), shells_(shells),
          length_share2_(
              std::max(local == nullptr ? options.length_share * options.length_share : 0.0, min_length_share2)),
          costs_only_grow_(local == nullptr && length_share2_ == min_length_share2),
          show_progress_(options.show_progress), changes_(allowed_changes(local, options)),
          edges_(static_cast<HalfEdge>(surface_.mesh.face_slots() * 3)),
          heap_(edges_ + (shells == nullptr ? 0 : shells->count())), known_(edges_, Known::Old),
          first_known_(local == nullptr ? Known::Forward : Known::Old), has_refused_(surface_.mesh.vertex_slots(), 0) {
        if (!collapsing.collapses().empty()) {
            error_ = collapsing.collapses().back().error_m / collapsing.units().diagonal_m;
        }
    }

    void run(const Goal& goal);

    /// Drops every shell that may be dropped.
    void drop_shells();

private:
    /// Handles are cut only where samples tell what that costs.
    static TopologyChanges allowed_changes(const LocalError* local, const SimplifyOptions& options) {
        if (options.keep_topology) { return TopologyChanges::None; }
        return local == nullptr ? TopologyChanges::Holes : TopologyChanges::HolesAndHandles;
    }

    /// How the cost of an edge in the heap was found.
    enum class Known : std::uint8_t {
        Old,     ///< A guess, or what was found before something changed nearby.
        Forward, ///< By quadrics: the present cost. By samples: measured from the samples to the triangles.
        Both     ///< By samples only: measured also from the triangles to the original.
    };

    bool is_met(const Goal& goal) const;
    void fill();
    HalfEdge next_edge();
    HalfEdge edge_for_last_triangle(HalfEdge h);
    bool is_allowed(HalfEdge h, const VertexPlacement& placement);
    void update(HalfEdge edge, Known known);
    void measure(HalfEdge h, const VertexPlacement& placement, Known known);
    void load(HalfEdge h, const VertexPlacement& placement);
    double length_cost(HalfEdge edge, const VertexPlacement& placement) const;
    void collapse(HalfEdge h);
    void separate_cut_vertex(std::uint32_t vertex);
    void update_around(std::uint32_t vertex);
    void update_shell(std::uint32_t shell);
    void drop(std::uint32_t shell);

    CollapsingSurface& collapsing_;
    WorkingSurface& surface_;
    LocalError* local_; ///< Null: quadrics are the costs.
    Shells* shells_;    ///< Null: none may be dropped.
    std::vector<double> shell_costs_;
    std::size_t wanted_faces_ = 0;
    double length_share2_;
    /// Sums of quadrics only grow, so that a cost found before is a lower bound of the present one: an edge is
    /// evaluated anew when that is the least of all.
    bool costs_only_grow_;
    const ShowProgress& show_progress_;
    TopologyChanges changes_; ///< Those that are allowed.
    CollapseEffect effect_;   ///< Of the collapse that was looked at last.
    HalfEdge edges_;          ///< Greater numbers in the heap are those of shells.
    EdgeHeap heap_;
    std::vector<Known> known_; ///< For each edge.
    Known first_known_;        ///< What is found out about an edge at first.
    /// By quadrics: for each vertex whether next_edge() took an edge at it out of the heap, as it may not collapse.
    std::vector<std::uint8_t> has_refused_;
    HalfEdge measured_ = none; ///< The edge whose collapse local_ measured last; none = it changed.
    Known measured_known_ = Known::Old;
    double forward_error_ = 0.0; ///< The error that it measured, from the samples and back to the original.
    double backward_error_ = 0.0;
    double error_ = 0.0; ///< The estimated error so far, in working units.
    std::vector<RingFace> ring_;
    std::vector<std::uint32_t> faces_;
    std::vector<std::uint32_t> ring_faces_;
};

bool EdgeCollapse::is_met(const Goal& goal) const {
    const CollapsibleMesh& mesh = surface_.mesh;
    return (goal.vertices && mesh.vertex_count() <= *goal.vertices) ||
           (goal.faces && mesh.face_count() <= *goal.faces) ||
           (goal.error_m && error_ * collapsing_.units().diagonal_m > *goal.error_m);
}

/// Puts all edges into the heap.
void EdgeCollapse::fill() {
    const CollapsibleMesh& mesh = surface_.mesh;
    for (HalfEdge h = 0; h < mesh.face_slots() * 3; ++h) {
        if (mesh.has_face(face_of(h)) && mesh.edge_of(h) == h && !heap_.holds(h)) { update(h, first_known_); }
    }
}

void EdgeCollapse::run(const Goal& goal) {
    const std::size_t start = surface_.mesh.face_count();
    wanted_faces_ = target_faces(goal);
    std::size_t done = 0;
    fill();
    for (std::uint32_t shell = 0; shells_ != nullptr && shell < shells_->count(); ++shell) {
        shell_costs_.push_back(0.0);
        update_shell(shell);
    }
    while (!is_met(goal)) {
        const HalfEdge h = next_edge();
        if (h != none && h >= edges_) {
            drop(h - edges_);
            continue;
        }
        if (h == none) { return; }
        if (goal.error_m && local_ == nullptr) {
            const VertexPlacement next = collapsing_.quadrics().placement(surface_, h);
            const double limit = *goal.error_m / collapsing_.units().diagonal_m;
            if (next.cost > limit * limit * next.weight) {
                return; // The collapse would exceed the error.
            }
        }
        if (goal.faces && surface_.mesh.face_count() == *goal.faces + 1) {
            collapse(edge_for_last_triangle(h));
            continue;
        }
        collapse(h);
        if (++done % 256 == 0 && show_progress_ && start > wanted_faces_) {
            show_progress_(std::min(1.0,
                static_cast<double>(start - surface_.mesh.face_count()) / static_cast<double>(start - wanted_faces_)));
        }
    }
}

/// The cheapest edge that may collapse; none = there is no one left.
HalfEdge EdgeCollapse::next_edge() {
    while (!heap_.empty()) {
        const HalfEdge h = heap_.top();
        if (h >= edges_) { return h; }
        if (known_[h] == Known::Old) {
            update(h, Known::Forward);
        } else if (local_ != nullptr && known_[h] == Known::Forward) {
            update(h, Known::Both);
        } else if (local_ != nullptr || is_allowed(h, collapsing_.quadrics().placement(surface_, h))) {
            return h;
        } else {
            heap_.remove(h);
            has_refused_[surface_.mesh.origin(h)] = 1;
            has_refused_[surface_.mesh.target(h)] = 1;
        }
    }
    return none;
}

/// The edge to collapse where one triangle is to go: `h`, the cheapest edge, if it is on a boundary, else the cheapest
/// boundary edge, unless that costs more than `max_factor` times as much as `h`.
HalfEdge EdgeCollapse::edge_for_last_triangle(HalfEdge h) {
    constexpr float max_factor = 100.0F; // Some ten times as far off there.
    const CollapsibleMesh& mesh = surface_.mesh;
    if (mesh.twin(h) == none) { return h; }
    const float limit = max_factor * heap_.cost(h);
    HalfEdge best = none;
    for (HalfEdge side = 0; side < edges_; ++side) {
        if (mesh.has_face(face_of(side)) && mesh.twin(side) == none) {
            update(side, local_ == nullptr ? Known::Forward : Known::Both);
            if (heap_.holds(side) && (best == none || heap_.cost(side) < heap_.cost(best)) &&
                is_allowed(side, collapsing_.quadrics().placement(surface_, side))) {
                best = side;
            }
        }
    }
    return best != none && heap_.cost(best) <= limit ? best : h;
}

/// Whether an edge may collapse: the topology first, then the guard against fold-overs.
bool EdgeCollapse::is_allowed(HalfEdge h, const VertexPlacement& placement) {
    effect_ = surface_.effect_of(h, changes_);
    if (effect_.kind == CollapseEffect::Kind::NotAllowed) { return false; }
    surface_.mesh.ring_of(h, ring_);
    return may_move(surface_, ring_, placement.place);
}

/// Puts an edge into the heap with its present cost, or takes it out where it may not collapse.
void EdgeCollapse::update(HalfEdge edge, Known known) {
    known_[edge] = known;
    const VertexPlacement placement = collapsing_.quadrics().placement(surface_, edge);
    double cost = length_cost(edge, placement);
    if (local_ == nullptr) {
        cost += placement.cost;
    } else if (known == Known::Old) {
        cost += guessed_share * placement.cost;
    } else if (is_allowed(edge, placement)) {
        measure(edge, placement, known);
        cost += known == Known::Forward ? forward_error_ - local_->current_forward_error()
                                        : forward_error_ + backward_error_ - local_->present();
        if (effect_.kind != CollapseEffect::Kind::ClosesHole &&
            (surface_.is_border_vertex(surface_.mesh.origin(edge)) ||
                surface_.is_border_vertex(surface_.mesh.target(edge)))) {
            cost = std::max(cost, placement.cost); // Samples hardly see where borders are.
        }
    } else {
        heap_.remove(edge);
        return;
    }
    if (surface_.mesh.twin(edge) == none) {
        cost *= 2.0; // It takes one triangle instead of two.
    }
    heap_.set(edge, static_cast<float>(cost));
}

/// Measures what the collapse of an edge, whose ring must be in ring_, would leave. What was measured last stays valid
/// until the mesh changes.
void EdgeCollapse::measure(HalfEdge h, const VertexPlacement& placement, Known known) {
    if (measured_ != h) {
        load(h, placement);
        forward_error_ = local_->forward_error();
        measured_ = h;
        measured_known_ = Known::Forward;
    }
    if (known == Known::Both && measured_known_ == Known::Forward) {
        backward_error_ = local_->backward_error();
        measured_known_ = Known::Both;
    }
}

/// Loads the samples around an edge, whose ring must be in ring_, and the triangles that its collapse would leave.
void EdgeCollapse::load(HalfEdge h, const VertexPlacement& placement) {
    faces_.clear();
    faces_.push_back(face_of(h));
    if (surface_.mesh.twin(h) != none) { faces_.push_back(face_of(surface_.mesh.twin(h))); }
    ring_faces_.clear();
    for (const RingFace& face : ring_) {
        faces_.push_back(face.face);
        ring_faces_.push_back(face.face);
    }
    local_->gather(faces_);
    local_->set_ring(ring_, placement.place, placement.colour);
}

double EdgeCollapse::length_cost(HalfEdge edge, const VertexPlacement& placement) const {
    const CollapsibleMesh& mesh = surface_.mesh;
    const glm::dvec3 along = surface_.places[mesh.target(edge)] - surface_.places[mesh.origin(edge)];
    return length_share2_ * placement.weight * glm::dot(along, along);
}

/// Collapses an edge, moves the samples to their new nearest triangles and updates the costs around it.
void EdgeCollapse::collapse(HalfEdge h) {
    const CollapsibleMesh& mesh = surface_.mesh;
    const std::uint32_t kept = mesh.origin(h);
    const std::uint32_t gone = mesh.target(h);
    const VertexPlacement placement = collapsing_.quadrics().placement(surface_, h);
    effect_ = surface_.effect_of(h, changes_);
    if (effect_.kind == CollapseEffect::Kind::NotAllowed) {
        // This edge would cut a handle. Since it was measured, another cut has taken the free vertex slot, or has
        // changed the surface so that this one would divide it in two.
        heap_.remove(h);
        return;
    }
    mesh.ring_of(h, ring_);
    if (local_ != nullptr) {
        measure(h, placement, Known::Both);
        measured_ = none;
        error_ = std::max(error_, std::sqrt(local_->max_distance2()));
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
    for (const HalfEdge joined : {effect_.second, effect_.third}) {
        if (joined != none) { heap_.remove(mesh.edge_of(joined)); }
    }
    const std::size_t before = mesh.face_count();
    const std::uint32_t shell = shells_ == nullptr ? none : shells_->shell_of(face_of(h));
    effect_ = collapsing_.collapse(h, placement, error_);
    if (shell != none) {
        shells_->lose(shell, before - mesh.face_count());
        update_shell(shell);
    }
    if (local_ != nullptr) { local_->keep(faces_, ring_faces_, kept); }
    if (effect_.kind == CollapseEffect::Kind::CutsHandle) {
        const std::uint32_t c = mesh.origin(effect_.third);
        const std::uint32_t made = effect_.made;
        local_->copy_vertex(kept, gone);
        local_->copy_vertex(c, made);
        for (const std::uint32_t vertex : {kept, gone, c, made}) { separate_cut_vertex(vertex); }
        for (const std::uint32_t vertex : {gone, c, made}) { update_around(vertex); }
    }
    update_around(kept);
}

/// Moves a vertex of a cut, where both sides lie at the same place, a little towards its neighbours, so that the sides
/// do not touch.
void EdgeCollapse::separate_cut_vertex(std::uint32_t vertex) {
    constexpr double share = 0.01;
    if (surface_.is_border_vertex(vertex)) { return; }
    surface_.mesh.ring_at(vertex, ring_, ring_faces_);
    glm::dvec3 sum(0.0);
    for (const RingFace& face : ring_) {
        sum += surface_.places[surface_.mesh.target(face.half_edge)] - surface_.places[vertex];
    }
    const glm::dvec3 place = surface_.places[vertex] + share / static_cast<double>(ring_.size()) * sum;
    if (may_move(surface_, ring_, place)) {
        local_->gather(ring_faces_);
        local_->set_ring(ring_, place, surface_.coloured() ? surface_.colours[vertex] : glm::dvec3(0.0));
        local_->measured();
        surface_.places[vertex] = place;
        local_->keep(ring_faces_, ring_faces_, vertex);
    }
}

/// Updates the edges at a vertex. The costs of the edges at its neighbours become old: by samples at all of them, by
/// quadrics at those with a refused edge (has_refused_). Refused edges come back into the heap, as they may collapse
/// now.
void EdgeCollapse::update_around(std::uint32_t vertex) {
    const CollapsibleMesh& mesh = surface_.mesh;
    mesh.edges_around(vertex, [&](HalfEdge h) {
        const std::uint32_t other = mesh.origin(h) == vertex ? mesh.target(h) : mesh.origin(h);
        if (local_ == nullptr && has_refused_[other] == 0) { return; }
        has_refused_[other] = 0;
        mesh.edges_around(other, [&](HalfEdge far) {
            const HalfEdge edge = mesh.edge_of(far);
            known_[edge] = Known::Old;
            if (!heap_.holds(edge)) { heap_.set(edge, heap_.cost(edge)); }
        });
    });
    mesh.edges_around(vertex, [&](HalfEdge h) {
        const HalfEdge edge = mesh.edge_of(h);
        if (costs_only_grow_ && heap_.holds(edge)) {
            known_[edge] = Known::Old;
        } else {
            update(edge, first_known_);
        }
    });
}

/// Puts a shell into the heap, with its cost for each two of its triangles that are too many.
void EdgeCollapse::update_shell(std::uint32_t shell) {
    // Others have not got so small that they may be dropped soon.
    constexpr std::size_t max_faces = 200;
    const std::size_t faces = shells_->face_count(shell);
    if (faces == 0 || faces > max_faces || shells_->count_left() < 2) {
        heap_.remove(edges_ + shell);
        return;
    }
    if (!(shell_costs_[shell] > 0.0)) { shell_costs_[shell] = std::max(shells_->cost(shell), 1e-30); }
    if (!std::isfinite(shell_costs_[shell])) {
        heap_.remove(edges_ + shell);
        return;
    }
    const std::size_t too_many = surface_.mesh.face_count() - std::min(surface_.mesh.face_count() - 1, wanted_faces_);
    heap_.set(
        edges_ + shell, static_cast<float>(shell_costs_[shell] * 2.0 / static_cast<double>(std::min(faces, too_many))));
}

/// Drops a shell if that still costs as little as was found before.
void EdgeCollapse::drop(std::uint32_t shell) {
    const float before = heap_.cost(edges_ + shell);
    shell_costs_[shell] = 0.0;
    update_shell(shell);
    if (!heap_.holds(edges_ + shell) || heap_.cost(edges_ + shell) > 1.01F * before) { return; }
    heap_.remove(edges_ + shell);
    measured_ = none;
    shells_->drop(shell, [&](std::uint32_t face) {
        for (HalfEdge h = 3 * face; h < 3 * face + 3; ++h) { heap_.remove(h); }
    });
}

void EdgeCollapse::drop_shells() {
    for (std::uint32_t shell = 0; shell < shell_costs_.size(); ++shell) {
        if (shells_->face_count(shell) > 0) {
            shell_costs_[shell] = shells_->cost(shell);
            if (std::isfinite(shell_costs_[shell])) { drop(shell); }
        }
    }
}

} // namespace

void collapse_by_quadrics(CollapsingSurface& collapsing, const Goal& goal, const SimplifyOptions& options) {
    EdgeCollapse(collapsing, nullptr, nullptr, options).run(goal);
}

std::size_t collapse_by_samples(CollapsingSurface& collapsing, SurfaceSamples& samples, const OriginalSurface& original,
    const Goal& goal, const SimplifyOptions& options) {
    LocalError local(collapsing.surface(), samples, original);
    std::optional<Shells> shells;
    if (!options.keep_shells && !options.keep_topology) {
        // A shell that is dropped must keep a wanted error with what is left of it for other steps.
        const double error = options.goal.error_m.value_or(1e30) / collapsing.units().diagonal_m;
        shells.emplace(collapsing.surface(), collapsing.face_numbers(), samples, original,
            std::min(max_shell_distance, options.shell_error_share * error));
    }
    EdgeCollapse collapse(collapsing, &local, shells && shells->count() > 1 ? &*shells : nullptr, options);
    collapse.run(goal);
    if (shells && options.goal.error_m) { collapse.drop_shells(); }
    return shells ? shells->count() - shells->count_left() : 0;
}

} // namespace octant::models::simplify
