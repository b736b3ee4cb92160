// The product's simplification: edge collapses (edge_collapse.cpp), as many as a wanted error
// allows (error_search.cpp), then an optimization (optimize.cpp), after which corner normals are
// taken over (attributes.cpp).
//
// It goes further than Y. Kim, B. U. Lee, "Error measure for vertex simplification", 2005, from
// which the distance to triangles in both directions comes: the reference is the original surface
// instead of the previous mesh, new vertices are placed by quadrics instead of at ends or
// midpoints, the link condition keeps a manifold, and a wanted error is certified by measuring, not
// estimated. The paper's own mode is paper_simplify.cpp.
#include "models/simplify/simplify.h"

#include "models/measure/triangle_bvh.h"
#include "models/simplify/attributes.h"
#include "models/simplify/edge_collapse.h"
#include "models/simplify/error_search.h"
#include "models/simplify/optimize.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace octant::models::simplify {

namespace {

/// Collapses are chosen by samples where at most so many times the wanted triangles are left.
constexpr std::size_t sampled_faces = 3;
constexpr std::size_t min_sampled_faces = 2000;
/// For a wanted error, once quadrics estimate this share of it.
constexpr double sampled_error = 0.1;
/// And so far beyond it collapses go by their own estimate: the optimization brings it back.
constexpr double beyond_goal = 2.0;

double cpu_s() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// How many samples stand for a surface: some dozens for each triangle that is to be left.
std::size_t wanted_samples(std::size_t original_faces, std::size_t faces_left) {
    constexpr std::size_t samples_a_face = 32;
    constexpr std::size_t samples_an_original_face = 4;
    constexpr std::size_t min_samples = 6'000;
    return std::max(
        std::min(samples_a_face * faces_left, samples_an_original_face * original_faces),
        min_samples);
}

/// How many steps an effort is. Where few triangles are left of many, each one is worth more steps.
std::size_t steps_of(const SimplifyOptions& options, std::size_t faces, std::size_t original) {
    if (options.steps) {
        return *options.steps;
    }
    if (options.effort <= 0) {
        return 0;
    }
    const double share = std::ldexp(1.0, options.effort - 2);
    return static_cast<std::size_t>(
        share * std::sqrt(static_cast<double>(faces) * static_cast<double>(original)));
}

OptimizeOptions optimize_options(
    const SimplifyOptions& options, std::size_t faces, std::size_t original) {
    OptimizeOptions how;
    how.max_steps = steps_of(options, faces, original);
    if (options.max_seconds) {
        using Clock = std::chrono::steady_clock;
        const auto end = Clock::now() + std::chrono::duration<double>(*options.max_seconds);
        how.max_steps = std::numeric_limits<std::size_t>::max();
        how.is_time_over = [end] { return Clock::now() > end; };
    }
    return how;
}

/// For each sample the corner of its triangle that is nearest to it.
std::vector<std::uint32_t>
anchors_of(const WorkingSurface& surface, const SurfaceSamples& samples) {
    std::vector<std::uint32_t> anchors(samples.size());
    for (std::uint32_t sample = 0; sample < samples.size(); ++sample) {
        const std::array<float, 3>& at = samples[sample].place;
        double least2 = std::numeric_limits<double>::infinity();
        for (const std::uint32_t corner : surface.mesh.corners(samples[sample].face)) {
            const glm::dvec3 off = surface.places[corner] - glm::dvec3(at[0], at[1], at[2]);
            if (glm::dot(off, off) < least2) {
                least2 = glm::dot(off, off);
                anchors[sample] = corner;
            }
        }
    }
    return anchors;
}

/// For each vertex slot before compact() the slot, after it, of the vertex that it became.
std::vector<std::uint32_t> compacted(CollapsingSurface& collapsing) {
    const std::vector<Collapse>& collapses = collapsing.collapses();
    const CollapsibleMesh& mesh = collapsing.surface().mesh;
    std::vector<std::uint32_t> slots(collapsing.first_vertices() + collapses.size(), none);
    std::uint32_t count = 0;
    for (std::uint32_t slot = 0; slot < mesh.vertex_slots(); ++slot) {
        if (mesh.vertex_is_there(slot)) {
            slots[collapsing.vertex_numbers()[slot]] = count++;
        }
    }
    for (std::size_t i = collapses.size(); i-- > 0;) {
        slots[collapses[i].first] = slots[collapsing.first_vertices() + i];
        slots[collapses[i].second] = slots[collapsing.first_vertices() + i];
    }
    collapsing.compact();
    slots.resize(collapsing.first_vertices());
    return slots;
}

/// Puts each sample into the list of the nearest triangle, found from one near it. All slots of the
/// surface must be taken.
void assign_from(
    const WorkingSurface& surface, SurfaceSamples& samples, std::span<std::uint32_t> faces) {
    std::vector<FlatTriangle> triangles;
    triangles.reserve(surface.mesh.face_slots());
    for (std::uint32_t face = 0; face < surface.mesh.face_slots(); ++face) {
        triangles.push_back(flat(surface.corner_places(face)));
    }
    std::vector<float> distances2(samples.size());
    for (std::uint32_t sample = 0; sample < samples.size(); ++sample) {
        faces[sample] = nearest_face_from(
            surface, faces[sample], samples[sample].place, distances2[sample], triangles);
    }
    samples.assign_all(faces, distances2, surface.mesh);
}

/// The mesh with corner normals taken from the original.
TriangleMesh with_normals(TriangleMesh mesh, const TriangleMesh& original) {
    if (!original.corner_normals.empty() && !mesh.triangles.empty()) {
        take_normals(mesh, original, measure::TriangleBvh(original));
    }
    return mesh;
}

/// Collapses of a mesh, with samples of what it was.
class Simplification {
public:
    Simplification(TriangleMesh original, const SimplifyOptions& options)
        : options_(options)
        , original_(std::move(original))
        , units_(WorkingUnits::of(original_, options.colour_weight))
        , surface_(original_, units_)
        , target_(surface_)
        , collapsing_(surface_, units_, EdgeWeights{}) {
        if (options.lock_border) {
            surface_.lock_border(original_, units_);
        }
    }

    /// Collapses to the goal: by quadrics as long as that is far, then by samples.
    void collapse(const Goal& goal) {
        const std::size_t before = surface_.mesh.face_count();
        const std::size_t faces = goal.error_m ? before / 4 : wanted_faces(goal);
        SurfaceSamples samples(surface_, wanted_samples(before, faces));
        std::vector<std::uint32_t> near = anchors_of(surface_, samples);
        Goal first{{}, std::max(sampled_faces * faces, min_sampled_faces), {}};
        if (goal.error_m) {
            first = {{}, {}, sampled_error * *goal.error_m};
        }
        collapse_by_quadrics(collapsing_, first, options_);
        const std::vector<std::uint32_t> slots = compacted(collapsing_);
        for (std::uint32_t& anchor : near) {
            anchor = surface_.mesh.face_at(slots[anchor]);
        }
        assign_from(surface_, samples, near);
        LocalError(surface_, samples, target_).measure_all_back();
        shells_gone_ = collapse_by_samples(collapsing_, samples, target_, goal, options_);
        samples_.emplace(std::move(samples));
    }

    std::size_t optimize() {
        return simplify::optimize(
            surface_,
            *samples_,
            target_,
            optimize_options(options_, surface_.mesh.face_count(), original_.triangles.size()));
    }

    TriangleMesh mesh() const {
        return with_normals(surface_.to_mesh(original_, units_), original_);
    }

    /// Adds what has changed in the topology.
    void tell(Simplified& result) const {
        result.shells_gone = shells_gone_;
        result.holes_closed = collapsing_.hole_closings().size();
        result.handles_cut = collapsing_.handles_cut();
    }

    const std::vector<std::size_t>& hole_closings() const { return collapsing_.hole_closings(); }

    CollapseSequence sequence() {
        if (shells_gone_ > 0 || collapsing_.handles_cut() > 0) {
            return {};
        }
        return {std::move(original_), std::move(collapsing_.collapses())};
    }

private:
    const SimplifyOptions& options_;
    TriangleMesh original_;
    WorkingUnits units_;
    WorkingSurface surface_;
    OriginalSurface target_;
    CollapsingSurface collapsing_;
    std::optional<SurfaceSamples> samples_;
    std::size_t shells_gone_ = 0;
};

/// Simplifies to a wanted error: one sequence of collapses beyond it, and then a search along the
/// sequence.
Simplified simplified_to_error(TriangleMesh original, const SimplifyOptions& options) {
    Simplified result;
    const double start_s = cpu_s();
    std::vector<std::size_t> hole_closings;
    {
        Goal goal = options.goal;
        goal.error_m = beyond_goal * *goal.error_m;
        Simplification work(std::move(original), options);
        work.collapse(goal);
        hole_closings = work.hole_closings();
        result.sequence = work.sequence();
    }
    const double collapsed_s = cpu_s();
    KeptError kept = max_collapses_within(result.sequence, options, [&](std::size_t collapses) {
        const TriangleMesh mesh = mesh_after(result.sequence, collapses);
        return collapses == 0 ? with_normals(mesh, result.sequence.original)
                              : optimized(mesh, result.sequence.original, options);
    });
    result.sequence.collapses.resize(kept.collapses);
    result.holes_closed = static_cast<std::size_t>(
        std::ranges::lower_bound(hole_closings, kept.collapses) - hole_closings.begin());
    result.mesh = std::move(kept.mesh);
    result.collapse_cpu_s = collapsed_s - start_s;
    result.optimize_cpu_s = cpu_s() - collapsed_s;
    return result;
}

} // namespace

Simplified simplified(TriangleMesh original, const SimplifyOptions& options) {
    const bool is_met = (options.goal.faces && original.triangles.size() <= *options.goal.faces) ||
                        (options.goal.vertices &&
                         original.vertices_m.size() <= *options.goal.vertices);
    if (original.triangles.empty() || is_met) {
        return {.mesh = original, .sequence = {std::move(original), {}}};
    }
    if (options.goal.error_m) {
        return simplified_to_error(std::move(original), options);
    }
    Simplified result;
    const double start_s = cpu_s();
    Simplification work(std::move(original), options);
    work.collapse(options.goal);
    const double collapsed_s = cpu_s();
    work.tell(result);
    result.steps = work.optimize();
    result.mesh = work.mesh();
    result.sequence = work.sequence();
    result.collapse_cpu_s = collapsed_s - start_s;
    result.optimize_cpu_s = cpu_s() - collapsed_s;
    return result;
}

CollapseSequence fast_sequence(TriangleMesh original, const SimplifyOptions& options) {
    assert(!options.goal.error_m);
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    WorkingSurface surface(original, units);
    if (options.lock_border) {
        surface.lock_border(original, units);
    }
    CollapsingSurface collapsing(surface, units, cost_weights);
    SimplifyOptions keeping = options;
    keeping.keep_topology = true;
    collapse_by_quadrics(collapsing, options.goal, keeping);
    return {std::move(original), std::move(collapsing.collapses())};
}

TriangleMesh
optimized(const TriangleMesh& mesh, const TriangleMesh& original, const SimplifyOptions& options) {
    if (mesh.triangles.empty() || original.triangles.empty()) {
        return mesh;
    }
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    const WorkingSurface fine(original, units);
    const OriginalSurface target(fine);
    SurfaceSamples samples(
        fine, wanted_samples(original.triangles.size(), mesh.triangles.size()));
    WorkingSurface surface(mesh, units);
    if (options.lock_border) {
        surface.lock_border(mesh, units);
    }
    const measure::TriangleBvh tree(surface.places, mesh.triangles);
    std::vector<std::uint32_t> faces(samples.size());
    for (std::uint32_t sample = 0; sample < samples.size(); ++sample) {
        const std::array<float, 3>& at = samples[sample].place;
        faces[sample] = tree.nearest({at[0], at[1], at[2]}).triangle;
    }
    assign_from(surface, samples, faces);
    optimize(
        surface,
        samples,
        target,
        optimize_options(options, mesh.triangles.size(), original.triangles.size()));
    return with_normals(surface.to_mesh(mesh, units), original);
}

} // namespace octant::models::simplify
