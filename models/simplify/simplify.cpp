// The product's simplification: edge collapses (edge_collapse.cpp), as many as a wanted error allows, then an
// optimization (optimize.cpp). Attributes are taken over by AttributeSeams.
//
// It goes further than Y. Kim, B. U. Lee, "Error measure for vertex simplification", 2005, from which the distance to
// triangles in both directions comes: the reference is the original surface instead of the previous mesh, new vertices
// are placed by quadrics instead of at ends or midpoints, the link condition keeps a manifold, and a wanted error is
// certified by measuring, not estimated. The paper's own mode is paper_simplify.cpp.

#include "models/simplify/simplify.h"

#include "models/measure/mesh_distance.h"
#include "models/measure/triangle_bvh.h"
#include "models/simplify/edge_collapse.h"
#include "models/simplify/optimize.h"
#include "sim/base/stopwatch.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace octant::models::simplify {

namespace {

/// Where a number of triangles is wanted, collapses are chosen by quadrics while more than so many times that number,
/// and more than `min_sampled_faces`, are left; then by samples.
constexpr std::size_t sampled_faces_per_wanted = 3;
constexpr std::size_t min_sampled_faces = 2000;

/// How many samples stand for a surface: some dozens for each triangle that is to be left.
std::size_t wanted_samples(int effort, std::size_t original_faces, std::size_t faces_left) {
    constexpr std::size_t samples_a_face = 32;
    constexpr std::size_t samples_an_original_face = 4;
    constexpr std::size_t min_samples = 6'000;
    // More steps than those of effort 4 would only fit the surface to the samples of effort 4.
    const std::size_t times = effort <= 4 ? 1 : effort == 5 ? 2 : 4;
    return times *
           std::max(std::min(samples_a_face * faces_left, samples_an_original_face * original_faces), min_samples);
}

/// How many steps an effort is. Where few triangles are left of many, each one is worth more steps.
std::size_t steps_of(int effort, std::size_t faces, std::size_t original) {
    if (effort <= 0) { return 0; }
    const double share = std::ldexp(1.0, effort - 2);
    return static_cast<std::size_t>(share * std::sqrt(static_cast<double>(faces) * static_cast<double>(original)));
}

OptimizeOptions optimize_options(const SimplifyOptions& options, std::size_t faces, std::size_t original) {
    constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
    OptimizeOptions how;
    how.max_steps = options.steps.value_or(unlimited);
    if (options.effort_limits_each || (!options.steps && !options.deadline)) {
        how.max_steps = std::min(how.max_steps, steps_of(options.effort, faces, original));
    }
    how.deadline = options.deadline;
    return how;
}

WorkingSurface working_surface(const TriangleMesh& mesh, const WorkingUnits& units, const SimplifyOptions& options) {
    WorkingSurface surface(mesh, units);
    if (options.lock_border) { surface.lock_border(mesh, units); }
    return surface;
}

/// For each sample the corner of its triangle that is nearest to it.
std::vector<std::uint32_t> anchors_of(const WorkingSurface& surface, const SurfaceSamples& samples) {
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
        if (mesh.has_vertex(slot)) { slots[collapsing.vertex_numbers()[slot]] = count++; }
    }
    for (std::size_t i = collapses.size(); i-- > 0;) {
        slots[collapses[i].first] = slots[collapsing.first_vertices() + i];
        slots[collapses[i].second] = slots[collapsing.first_vertices() + i];
    }
    collapsing.compact();
    slots.resize(collapsing.first_vertices());
    return slots;
}

/// Puts each sample into the list of the nearest triangle, found from one near it. All slots of the surface must be
/// taken.
void assign_from(const WorkingSurface& surface, SurfaceSamples& samples, std::span<std::uint32_t> faces) {
    std::vector<FlatTriangle> triangles;
    triangles.reserve(surface.mesh.face_slots());
    for (std::uint32_t face = 0; face < surface.mesh.face_slots(); ++face) {
        triangles.push_back(flat(surface.corner_places(face)));
    }
    std::vector<float> distances2(samples.size());
    for (std::uint32_t sample = 0; sample < samples.size(); ++sample) {
        faces[sample] = nearest_face_from(surface, faces[sample], samples[sample].place, distances2[sample], triangles);
    }
    samples.assign_all(faces, distances2, surface.mesh);
}

/// An optimized mesh, or the one before where that is nearer to the original by the quadratic mean. The points for that
/// are not those that the optimization has seen. Colours, where there are any, may have got better at the expense of
/// places, so that they have no such bound.
TriangleMesh better_of(
    const TriangleMesh& original, const OriginalSurface& surface, TriangleMesh before, TriangleMesh optimized) {
    if (!original.colours.empty()) { return optimized; }
    constexpr std::size_t samples = 4'000;
    const measure::TargetSurface target(original, surface.tree());
    const auto rms_m = [&](const TriangleMesh& mesh) {
        const measure::SampleOptions how{.samples = samples};
        const measure::TargetSurface made(mesh);
        return std::max(
            measure::sampled_distance(original, made, how).rms_m, measure::sampled_distance(mesh, target, how).rms_m);
    };
    return rms_m(before) < rms_m(optimized) ? std::move(before) : std::move(optimized);
}

CollapsingSurface collapsing_of(
    const TriangleMesh& original, const SimplifyOptions& options, const EdgeWeights& weights) {
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    return {working_surface(original, units, options), units, weights};
}

/// Collapses of a mesh, with samples of what it was. A copy goes on from the same state.
class Simplification {
public:
    /// The original and the options must outlive this.
    Simplification(const TriangleMesh& original, const SimplifyOptions& options)
        : options_(options), original_(original), collapsing_(collapsing_of(original, options, EdgeWeights{})),
          target_(std::make_shared<const OriginalSurface>(surface(), original, collapsing_.units())) {}

    /// Collapses by quadrics as long as the goal is far. `faces` is about how many triangles are left in the end.
    void approach(const Goal& near_goal, std::size_t faces) {
        SurfaceSamples samples(surface(), wanted_samples(options_.effort, surface().mesh.face_count(), faces));
        std::vector<std::uint32_t> near = anchors_of(surface(), samples);
        samples.drop_lists(); // There is one for each triangle of the original.
        collapse_by_quadrics(collapsing_, near_goal, options_);
        const std::vector<std::uint32_t> slots = compacted(collapsing_);
        for (std::uint32_t& anchor : near) { anchor = surface().mesh.face_at(slots[anchor]); }
        assign_from(surface(), samples, near);
        LocalError(surface(), samples, *target_).measure_all_back();
        samples_.emplace(std::move(samples));
    }

    /// Collapses by samples, after approach(), to the goal.
    void collapse(const Goal& goal) {
        shells_gone_ = collapse_by_samples(collapsing_, *samples_, *target_, goal, options_);
    }

    /// Optimizes the mesh where that makes it better. Returns the number of steps.
    std::size_t optimize(const SimplifyOptions& options, TriangleMesh& mesh) {
        mesh = surface().to_mesh(original_, collapsing_.units());
        samples_->sort();
        const std::size_t steps = simplify::optimize(
            surface(), *samples_, *target_, optimize_options(options, faces(), original_.triangles.size()));
        if (steps > 0) {
            TriangleMesh made = surface().to_mesh(original_, collapsing_.units());
            mesh = better_of(original_, *target_, std::move(mesh), std::move(made));
        }
        return steps;
    }

    /// Adds what has changed in the topology.
    void tell(Simplified& result) const {
        result.shells_removed = shells_gone_;
        result.holes_closed = collapsing_.holes_closed();
        result.handles_cut = collapsing_.handles_cut();
    }

    std::size_t faces() const { return collapsing_.surface().mesh.face_count(); }

    std::vector<Collapse>& collapses() { return collapsing_.collapses(); }

    /// A tree over the original's triangles; built where there was none so far.
    const std::shared_ptr<const measure::TriangleBvh>& original_tree() const { return target_->tree(); }

private:
    WorkingSurface& surface() { return collapsing_.surface(); }

    const SimplifyOptions& options_;
    const TriangleMesh& original_;
    CollapsingSurface collapsing_;
    std::shared_ptr<const OriginalSurface> target_;
    std::optional<SurfaceSamples> samples_;
    std::size_t shells_gone_ = 0;
};

/// Searches for the fewest triangles whose finished mesh keeps a wanted error by its certified distance, so that
/// whoever measures it again with the usual tightness finds it kept. Each try goes on from the last state that kept the
/// error, is optimized and measured. Tries after the last step or the deadline make no steps.
class ErrorSearch {
public:
    ErrorSearch(const TriangleMesh& original, const SimplifyOptions& options)
        : original_(original), options_(options), collapsing_(options), trying_(options),
          error_m_(*options.goal.error_m) {
        result_.mesh = original;
        trying_.effort_limits_each = true;
    }

    Simplified find() {
        // Quadrics may be far off, and shells be dropped too early; then both stop earlier.
        for (double share = 0.1; share > 1e-4 && !is_found_; share *= 0.1) {
            search_from(share * error_m_);
            collapsing_.shell_error_share *= 0.5;
            collapsing_.keep_shells = options_.keep_shells || share < 0.05;
        }
        return std::move(result_);
    }

private:
    static constexpr int max_tries = 7;
    /// Another try is made only while more than this share of the triangles is in question.
    static constexpr double close_enough = 0.03;
    /// Tries aim at this share of the wanted error.
    static constexpr double aim = 0.97;
    /// The error is assumed to fall with this power of the number of triangles.
    static constexpr double steepness = 1.0;
    /// The first try is where the estimate reaches this many times the wanted error, which the optimization lowers.
    static constexpr double first_try = 1.2;

    void search_from(double quadrics_m) {
        const double start_s = process_cpu_s();
        auto kept = std::make_unique<Simplification>(original_, collapsing_);
        kept->approach({.error_m = quadrics_m}, original_.triangles.size() / 4);
        if (kept->collapses().size() > 1) {
            kept->collapses().erase(kept->collapses().begin(), kept->collapses().end() - 1);
        }
        auto next = std::make_unique<Simplification>(*kept);
        next->collapse({.error_m = first_try * error_m_});
        result_.collapse_cpu_s += process_cpu_s() - start_s;
        double kept_m = quadrics_m;
        std::size_t too_few = 0;
        double too_far_m = 0.0;
        for (int tries = 0; tries < max_tries; ++tries) {
            const double tried_m = attempt(*next);
            if (is_kept_) {
                kept = std::move(next);
                kept_m = tried_m;
            } else if (next->faces() > too_few) {
                too_few = next->faces();
                too_far_m = tried_m;
            }
            const std::size_t wanted = next_faces(kept->faces(), kept_m, too_few, too_far_m);
            if (wanted >= kept->faces()) { break; }
            const double before_s = process_cpu_s();
            next = std::make_unique<Simplification>(*kept);
            next->collapse({{}, wanted, {}});
            result_.collapse_cpu_s += process_cpu_s() - before_s;
            if (next->faces() >= kept->faces()) {
                break; // No edge can collapse.
            }
        }
        if (!is_found_) {
            attempt(*kept); // It was not tried so far.
        }
    }

    /// Finishes a copy of a state and takes it for the result if it keeps the error. Returns about how large its error
    /// is.
    double attempt(const Simplification& state) {
        const double start_s = process_cpu_s();
        Simplification copy(state);
        TriangleMesh mesh;
        const std::size_t steps = copy.optimize(trying_, mesh);
        result_.optimize_cpu_s += process_cpu_s() - start_s;
        result_.steps += steps;
        if (trying_.steps) { *trying_.steps -= std::min(*trying_.steps, steps); }
        const measure::MeshDistance distance = measure::distance(original_, mesh,
            {.tightness = 1.03,
                .negligible_m = 0.9 * error_m_,
                .samples = 100,
                .threads = options_.threads,
                .maximum_only = true,
                .tree_of_a = state.original_tree()});
        is_kept_ = distance.max_hausdorff_m() * measure::DistanceOptions().tightness <= error_m_;
        if (is_kept_) {
            is_found_ = true;
            result_.mesh = std::move(mesh);
            result_.original_tree = state.original_tree();
            state.tell(result_);
        }
        return distance.min_hausdorff_m();
    }

    /// The number of triangles to try next, where the error lies between those of two numbers in the logarithms. The
    /// kept number where that is near enough.
    std::size_t next_faces(std::size_t kept, double kept_m, std::size_t too_few, double too_far_m) const {
        const auto max = static_cast<double>(kept);
        const auto min = static_cast<double>(too_few);
        if (too_few == 0) {
            const double share = std::pow(kept_m / (aim * error_m_), 1.0 / steepness);
            return static_cast<std::size_t>(max * std::clamp(share, 0.3, 1.0 / (1.0 + close_enough)));
        }
        if (max <= min * (1.0 + close_enough) || kept <= too_few + 1) { return kept; }
        const double between =
            kept_m < too_far_m ? std::log(aim * error_m_ / kept_m) / std::log(too_far_m / kept_m) : 0.5;
        const double wanted = max * std::pow(min / max, std::clamp(between, 0.2, 0.8));
        return std::clamp(static_cast<std::size_t>(wanted), too_few + 1, kept - 1);
    }

    const TriangleMesh& original_;
    const SimplifyOptions& options_;
    SimplifyOptions collapsing_; ///< The same with what shells may cost.
    SimplifyOptions trying_;     ///< The same with the steps that are left.
    double error_m_;
    bool is_kept_ = false;  ///< by the last try
    bool is_found_ = false; ///< Some try has kept the error.
    Simplified result_;
};

/// Where the wanted number of triangles cannot be met, this share of a result's area may be turned against the
/// original; so many larger numbers, a quarter larger each, are tried until it is less.
constexpr double max_folded_share = 0.003;
constexpr int max_unfolding_tries = 4;

bool is_folded(const TriangleMesh& mesh, const TriangleMesh& original) {
    constexpr std::size_t samples = 20'000;
    const double rms_m = measure::sampled_distance(mesh, measure::TargetSurface(original), {.samples = samples}).rms_m;
    return measure::flipped_area_share(mesh, original, rms_m, {.samples = samples}) > max_folded_share;
}

/// Simplifies a mesh to a number of triangles or vertices, or as far as edges can collapse.
Simplified simplify_to_count(const TriangleMesh& original, const SimplifyOptions& options) {
    Simplified result;
    const double start_s = process_cpu_s();
    Simplification work(original, options);
    const std::size_t faces = target_faces(options.goal);
    work.approach({{}, std::max(sampled_faces_per_wanted * faces, min_sampled_faces), {}}, faces);
    work.collapse(options.goal);
    const double collapsed_s = process_cpu_s();
    work.tell(result);
    result.steps = work.optimize(options, result.mesh);
    result.collapse_cpu_s = collapsed_s - start_s;
    result.optimize_cpu_s = process_cpu_s() - collapsed_s;
    result.original_tree = result.steps > 0 ? work.original_tree() : nullptr;
    if (result.shells_removed == 0 && result.handles_cut == 0) {
        result.sequence.collapses = std::move(work.collapses());
        result.sequence.original = original;
    }
    return result;
}

} // namespace

Simplified simplified(const TriangleMesh& original, const SimplifyOptions& options) {
    const bool is_met = (options.goal.faces && original.triangles.size() <= *options.goal.faces) ||
                        (options.goal.vertices && original.vertices_m.size() <= *options.goal.vertices);
    if (original.triangles.empty() || is_met) { return {.mesh = original, .sequence = {original, {}}}; }
    if (options.goal.error_m) { return ErrorSearch(original, options).find(); }
    Simplified result = simplify_to_count(original, options);
    // Where no edge can collapse any more, the last collapses have mostly folded the surface.
    SimplifyOptions fewer = options;
    fewer.goal = {.faces = result.mesh.triangles.size()};
    const bool is_stuck = (options.goal.faces && result.mesh.triangles.size() > *options.goal.faces) ||
                          (options.goal.vertices && result.mesh.vertices_m.size() > *options.goal.vertices);
    for (int tries = 0; is_stuck && tries < max_unfolding_tries && is_folded(result.mesh, original); ++tries) {
        *fewer.goal.faces += *fewer.goal.faces / 4 + 2;
        if (*fewer.goal.faces >= original.triangles.size()) { break; }
        result = simplify_to_count(original, fewer);
    }
    return result;
}

CollapseSequence fast_sequence(TriangleMesh original, const SimplifyOptions& options) {
    assert(!options.goal.error_m);
    CollapsingSurface collapsing = collapsing_of(original, options, cost_weights);
    SimplifyOptions keeping = options;
    keeping.keep_topology = true;
    collapse_by_quadrics(collapsing, options.goal, keeping);
    return {std::move(original), std::move(collapsing.collapses())};
}

TriangleMesh optimized(const TriangleMesh& mesh, const TriangleMesh& original, const SimplifyOptions& options) {
    if (mesh.triangles.empty() || original.triangles.empty()) { return mesh; }
    const WorkingUnits units = WorkingUnits::of(original, options.colour_weight);
    const WorkingSurface fine(original, units);
    const OriginalSurface target(fine, original, units);
    SurfaceSamples samples(fine, wanted_samples(options.effort, original.triangles.size(), mesh.triangles.size()));
    WorkingSurface surface = working_surface(mesh, units, options);
    const measure::TriangleBvh tree(surface.places, mesh.triangles);
    std::vector<std::uint32_t> faces(samples.size());
    for (std::uint32_t sample = 0; sample < samples.size(); ++sample) {
        const std::array<float, 3>& at = samples[sample].place;
        faces[sample] = tree.nearest({at[0], at[1], at[2]}).triangle;
    }
    assign_from(surface, samples, faces);
    optimize(surface, samples, target, optimize_options(options, mesh.triangles.size(), original.triangles.size()));
    return better_of(original, target, mesh, surface.to_mesh(mesh, units));
}

} // namespace octant::models::simplify
