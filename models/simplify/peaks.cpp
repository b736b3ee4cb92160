// Lowers the largest distance between two surfaces. A least-squares fit, vertex after vertex, in
// which each squared distance has the sixth power of the distance as a weight, approximates a
// minimum of the maximum (iteratively reweighted least squares for a high norm). Only vertices and
// edges of triangles with a distance near the largest are touched.
//
// Our own addition to the polish after H. Hoppe et al. (1993): the 2005 paper and least squares
// lessen sums, while the Hausdorff distance, which is what is certified, is a maximum.
#include "models/simplify/peaks.h"

#include "models/simplify/collapse_guard.h"
#include "models/simplify/ring_heights.h"
#include "models/simplify/vertex_fit.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace octant::models::simplify {

namespace {

using Corners = std::array<glm::dvec3, 3>;

/// Triangles whose largest distance exceeds this share of the largest of all are worked on.
constexpr double hot_share = 0.85;
/// A round that lowers the largest distance by less than this share is the last one.
constexpr double least_gain = 0.003;

/// A distance of more than `tall` times the root mean square is an isolated peak, as where sharp
/// edges meet. A step that lowers it by more than `tall_gain` may fold triangles over and
/// add more to the squares.
constexpr double tall = 12.0;
constexpr double tall_gain = 0.1;
/// By this share of the root mean square such steps may make it grow, all together and beside the
/// others.
constexpr double tall_growth = 0.05;

constexpr double everything = std::numeric_limits<double>::infinity();

/// The state of one run of lower_peaks.
class PeakLowering {
public:
    PeakLowering(
        WorkingSurface& surface,
        TrackedPoints& points,
        const PolishTarget& target,
        const PeakOptions& options)
        : surface_(surface)
        , is_plain_(!surface.coloured() && surface.materials.empty())
        , around_(surface, points, target, {.of_all = options.samples})
        , heights_(surface.mesh.face_slots())
        , tried_vertices_(surface.mesh.vertex_slots(), false)
        , tried_edges_(surface.mesh.face_slots() * 3, false) {
        double squares = 0.0;
        double area = 0.0;
        for (std::uint32_t face = 0; face < heights_.size(); ++face) {
            if (surface.mesh.face_is_there(face)) {
                measure(face);
                area += 0.5 * glm::length(area_vector(surface.corner_places(face)));
            }
            squares += heights_[face].squares;
        }
        most_looks_ =
            around_.looks() +
            std::max(options.least_looks, options.looks_a_face * target.mesh.face_count());
        const auto allowance = [&](double growth) { return (2.0 + growth) * growth * squares; };
        allowance_ = allowance(options.most_growth);
        tall_allowance_ = allowance(tall_growth) - allowance_;
        // The sum of squares counts both directions, each over the area, hence the factor 2.
        tall2_ = area > 0.0 ? tall * tall * squares / (2.0 * area) : everything;
    }

    /// Whether there are peaks more than twice as high as isolated ones have to be.
    bool is_very_tall() const { return most2() > 4.0 * tall2_; }

    double most2() const { return std::ranges::max(heights_, {}, &Heights::most2).most2; }

    void round();

private:
    void measure(std::uint32_t face);
    VertexFit fitted() const;
    glm::dvec3 way_of_worst_sample() const;
    bool is_better(const Heights& before, const Heights& after, Strictness strictness) const;
    bool step_to(
        const glm::dvec3& place,
        std::uint32_t vertex,
        const Heights& before,
        Strictness strictness);
    void keep(const Heights& before, const Heights& after);
    void lower_at(std::uint32_t vertex);
    void try_flip(HalfEdge h);

    WorkingSurface& surface_;
    /// There are no borders of colours and materials, which are not looked at here.
    bool is_plain_;
    RingHeights around_;
    std::vector<Heights> heights_; ///< For each triangle.
    /// Vertices that were tried in vain and around which nothing has changed since.
    std::vector<bool> tried_vertices_;
    std::vector<bool> tried_edges_; ///< Edges of the same kind.
    std::size_t most_looks_ = 0;
    double allowance_ = 0.0;      ///< By how much the sum of squares may still grow.
    double tall2_ = everything;   ///< The squared distance beyond which a peak counts as isolated.
    double tall_allowance_ = 0.0; ///< By how much more it may grow for isolated peaks.
};

void PeakLowering::measure(std::uint32_t face) {
    around_.take_face(face);
    heights_[face] = around_.seen({});
}

/// The step that lessens the sum of high powers most: a fit in which each weight is multiplied by
/// the sixth power of the distance.
VertexFit PeakLowering::fitted() const {
    VertexFit fit;
    const PointBlock& block = around_.cost().block();
    const auto cubed = [](double distance2) { return distance2 * distance2 * distance2; };
    for (std::size_t i = 0; i < block.size(); ++i) {
        const double weight =
            static_cast<double>(block.weights[i]) * cubed(static_cast<double>(block.distances2[i]));
        add_point(
            fit,
            block,
            i,
            around_.cost().triangles[static_cast<std::size_t>(block.nearest[i])],
            weight,
            false);
    }
    for (const SeenSample& sample : around_.samples()) {
        if (sample.share > 0.0) {
            fit.add(
                sample.off,
                sample.normal,
                sample.share,
                sample.area * cubed(glm::dot(sample.off, sample.off)));
        }
    }
    return fit;
}

/// Whether a change lowers peaks and costs no more than is allowed.
bool PeakLowering::is_better(
    const Heights& before, const Heights& after, Strictness strictness) const {
    if (!(after.powers < before.powers) || after.most2 > before.most2) {
        return false;
    }
    const double growth = after.squares - before.squares;
    const bool is_tall =
        before.most2 > tall2_ && after.most2 < (1.0 - tall_gain) * (1.0 - tall_gain) * before.most2;
    return is_tall ? growth <= allowance_ + tall_allowance_
                   : growth <= allowance_ && (strictness == Strictness::Normal ||
                                              (is_plain_ && after.turned <= before.turned));
}

/// Accepts a change that was just measured: books its cost and updates the points' lists and the
/// statistics.
void PeakLowering::keep(const Heights& before, const Heights& after) {
    allowance_ -= after.squares - before.squares;
    if (allowance_ < 0.0) {
        tall_allowance_ += allowance_;
        allowance_ = 0.0;
    }
    around_.keep();
    for (std::size_t i = 0; i < around_.faces().size(); ++i) {
        const std::uint32_t face = around_.faces()[i];
        heights_[face] = around_.each()[i];
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            tried_vertices_[surface_.mesh.origin(3 * face + corner)] = false;
            tried_edges_[surface_.mesh.edge_of(3 * face + corner)] = false;
        }
    }
}

/// Moves a vertex if that is allowed and better. around_ must hold the vertex's ring, and `before`
/// its present statistics.
bool PeakLowering::step_to(
    const glm::dvec3& place, std::uint32_t vertex, const Heights& before, Strictness strictness) {
    if (!may_move(surface_, around_.ring(), place, strictness)) {
        return false;
    }
    around_.set_ring(place, surface_.coloured() ? surface_.colours[vertex] : glm::dvec3(0.0));
    const Heights after = around_.seen({.most2 = before.most2});
    if (!is_better(before, after, strictness)) {
        return false;
    }
    surface_.places[vertex] = place;
    keep(before, after);
    return true;
}

/// The step that takes the farthest of the samples that were seen last to its nearest point.
glm::dvec3 PeakLowering::way_of_worst_sample() const {
    constexpr double least_share = 0.1; // Others hardly follow the vertex.
    double most2 = 0.0;
    glm::dvec3 way(0.0);
    for (const SeenSample& sample : around_.samples()) {
        const double off2 = glm::dot(sample.off, sample.off);
        if (off2 > most2 && sample.share > least_share) {
            most2 = off2;
            way = sample.off / sample.share;
        }
    }
    return way;
}

/// Tries to move a vertex along the fitted direction or towards what its farthest sample misses,
/// with shorter and shorter steps.
void PeakLowering::lower_at(std::uint32_t vertex) {
    if (surface_.is_locked(vertex)) {
        return;
    }
    around_.take_ring(vertex);
    const glm::dvec3 place = surface_.places[vertex];
    const glm::dvec3 colour = surface_.coloured() ? surface_.colours[vertex] : glm::dvec3(0.0);
    around_.set_ring(place, colour);
    const Heights before = around_.seen({});
    const glm::dvec3 way = surface_.along_borders(vertex, fitted().way());
    const glm::dvec3 way_of_worst = is_plain_ ? way_of_worst_sample() : way;
    for (const Strictness strictness : {Strictness::Normal, Strictness::Loose}) {
        for (const double step : {1.0, 0.5, 0.2, 0.1}) {
            if (step_to(place + step * way, vertex, before, strictness) ||
                step_to(place + step * way_of_worst, vertex, before, strictness)) {
                return;
            }
        }
    }
    tried_vertices_[vertex] = true;
}

/// Flips an edge if that is allowed and better.
void PeakLowering::try_flip(HalfEdge h) {
    CollapsibleMesh& mesh = surface_.mesh;
    if (surface_.is_material_border(h) || !mesh.may_flip(h)) {
        return;
    }
    around_.take_pair(h);
    const std::vector<Corners> old = around_.corners();
    const Heights before = around_.seen({});
    mesh.flip(h);
    around_.set_faces();
    const std::vector<Corners>& now = around_.corners();
    if (may_flip_to({old[0], old[1]}, {now[0], now[1]})) {
        const Heights after = around_.seen({.most2 = before.most2});
        if (is_better(before, after, Strictness::Normal)) {
            keep(before, after);
            return;
        }
    }
    for (int turn = 0; turn < 3; ++turn) { // Four flips of an edge restore it.
        mesh.flip(h);
    }
    tried_edges_[mesh.edge_of(h)] = true;
}

void PeakLowering::round() {
    const double hot2 = hot_share * hot_share * most2();
    const CollapsibleMesh& mesh = surface_.mesh;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t face = 0; face < heights_.size(); ++face) {
        if (heights_[face].most2 > hot2) {
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                const HalfEdge h = 3 * face + corner;
                if (!tried_edges_[mesh.edge_of(h)] && around_.looks() < most_looks_) {
                    try_flip(h);
                }
            }
            const Triangle corners = mesh.corners(face);
            vertices.insert(vertices.end(), corners.begin(), corners.end());
        }
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t vertex : vertices) {
        if (!tried_vertices_[vertex] && around_.looks() < most_looks_) {
            lower_at(vertex);
        }
    }
}

} // namespace

void lower_peaks(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const PeakOptions& options) {
    PeakOptions how = options;
    how.samples = 0;
    // High peaks are lowered at a price, and closer looks find more of them to pay for.
    if (!PeakLowering(surface, points, target, how).is_very_tall()) {
        how.samples = options.samples;
    }
    PeakLowering lowering(surface, points, target, how);
    for (int round = 0; round < options.rounds && lowering.most2() > peak_rounding2; ++round) {
        const double before2 = lowering.most2();
        lowering.round();
        const double least2 = (1.0 - least_gain) * (1.0 - least_gain) * before2;
        if (!(lowering.most2() < least2)) {
            return;
        }
    }
}

} // namespace octant::models::simplify
