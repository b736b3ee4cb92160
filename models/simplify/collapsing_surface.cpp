// What every way to choose collapses has in common: carrying one out, in the surface, in the
// quadrics (M. Garland, P. Heckbert, 1997: the new vertex has the sum of both) and in the record.
#include "models/simplify/collapsing_surface.h"

#include <numeric>
#include <utility>

namespace octant::models::simplify {

namespace {

std::vector<std::uint32_t> counted(std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

} // namespace

CollapsingSurface::CollapsingSurface(
    WorkingSurface surface, const WorkingUnits& units, const EdgeWeights& weights)
    : surface_(std::move(surface))
    , units_(units)
    , quadrics_(surface_, weights)
    , vertex_numbers_(counted(surface_.mesh.vertex_slots()))
    , face_numbers_(counted(surface_.mesh.face_slots()))
    , first_vertices_(surface_.mesh.vertex_slots()) {}

CollapseEffect CollapsingSurface::collapse(HalfEdge h, const Placement& placement, double error) {
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
    if (effect.kind == CollapseEffect::Kind::ClosesHole) {
        ++holes_closed_;
    }
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

KeptSlots CollapsingSurface::compact() {
    KeptSlots kept = surface_.compact();
    quadrics_.keep(kept.vertices);
    keep_slots(vertex_numbers_, kept.vertices);
    keep_slots(face_numbers_, kept.faces);
    return kept;
}

} // namespace octant::models::simplify
