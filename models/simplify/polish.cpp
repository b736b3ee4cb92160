// Fits a surface to another one by least squares, vertex after vertex: after H. Hoppe, T. DeRose,
// T. Duchamp, J. McDonald, W. Stuetzle, "Mesh Optimization", 1993, section 4.1. Each round finds
// the correspondences anew, then moves each vertex where that lessens the sum of squared distances
// of all points and samples on its triangles, then flips edges.
//
// Deviations: two-sided (points of the target to the surface, samples of the surface to the
// target); a Gauss-Newton step on distances instead of fixed correspondences; colours are fitted
// too; a vertex moves only if that lessens the sum and no triangle turns over.
#include "models/simplify/polish.h"

#include "models/simplify/aims.h"
#include "models/simplify/collapse_guard.h"
#include "models/simplify/point_lists.h"
#include "models/simplify/surface_cost.h"
#include "models/simplify/turned_faces.h"
#include "models/simplify/vertex_fit.h"

#include <algorithm>
#include <array>
#include <vector>

namespace octant::models::simplify {

namespace {

/// The state of one polish.
class Polishing {
public:
    Polishing(
        WorkingSurface& surface,
        TrackedPoints& points,
        const PolishTarget& target,
        const PolishOptions& options)
        : surface_(surface)
        , points_(points)
        , target_(target)
        , threads_(options.threads)
        , avoided2_(options.avoided2)
        , strictness_(
              options.slivers_too && !surface.coloured() ? Strictness::Loose : Strictness::Normal)
        , aims_(options.fields) {}

    void round() {
        list_again();
        aims_.take(surface_, target_, threads_);
        for (std::uint32_t vertex = 0; vertex < surface_.mesh.vertex_slots(); ++vertex) {
            if (surface_.mesh.vertex_is_there(vertex)) {
                fit(vertex);
            }
        }
    }

    std::size_t flip_edges();

    void list_again() { list_nearer(surface_, points_, threads_); }

private:
    void fit(std::uint32_t vertex);
    double cost_at(const glm::dvec3& place, const glm::dvec3& colour);
    void take_ring(std::uint32_t vertex);
    VertexFit fitted();
    bool try_flip(HalfEdge h);

    WorkingSurface& surface_;
    TrackedPoints& points_;
    PolishTarget target_;
    int threads_;
    double avoided2_;
    Strictness strictness_;
    SampleAims aims_;
    double most2_ = 0.0; ///< The largest squared distance that cost_at saw last.
    SurfaceCost cost_;
    std::vector<RingFace> ring_;
    std::vector<std::uint32_t> faces_;
};

/// Loads the triangles at a vertex and their tracked points.
void Polishing::take_ring(std::uint32_t vertex) {
    surface_.mesh.ring_at(vertex, ring_, faces_);
    cost_.gather(points_, faces_);
}

/// The least-squares fit of the vertex whose ring is loaded.
VertexFit Polishing::fitted() {
    VertexFit fit;
    const PointBlock& block = cost_.block();
    for (std::size_t i = 0; i < block.size(); ++i) {
        const FlatTriangle& nearest = cost_.triangles[static_cast<std::size_t>(block.nearest[i])];
        add_point(
            fit, block, i, nearest, static_cast<double>(block.weights[i]), points_.coloured());
    }
    for (const RingFace& face : ring_) {
        aims_.add_to(fit, face.face, surface_.corner_places(face.face), face.half_edge % 3);
    }
    return fit;
}

/// The cost of the loaded ring with its vertex at `place`: squared distances of the tracked points
/// to it, and of its samples to their aims.
double Polishing::cost_at(const glm::dvec3& place, const glm::dvec3& colour) {
    cost_.set_triangles(surface_, ring_, place, colour);
    double sum = cost_.total();
    most2_ = cost_.most2();
    for (const RingFace& face : ring_) {
        std::array<glm::dvec3, 3> corners = surface_.corner_places(face.face);
        corners[face.half_edge % 3] = place;
        sum += aims_.cost(face.face, corners);
        most2_ = std::max(most2_, aims_.most2(face.face, corners));
    }
    return sum;
}

/// Moves one vertex and changes its colour if a full or a shorter step of the fit lessens the cost.
void Polishing::fit(std::uint32_t vertex) {
    take_ring(vertex);
    const glm::dvec3 place = surface_.places[vertex];
    const glm::dvec3 colour = surface_.coloured() ? surface_.colours[vertex] : glm::dvec3(0.0);
    const double before = cost_at(place, colour);
    if (before <= cost_.negligible()) {
        return;
    }
    const double most2 = std::max(most2_, avoided2_);
    const VertexFit fit = fitted();
    const glm::dvec3 way = surface_.along_borders(vertex, fit.way());
    const glm::dvec3 colour_change = fit.colour_change();
    for (const double step : {1.0, 0.4}) {
        const glm::dvec3 there = place + step * way;
        const glm::dvec3 new_colour = colour + step * colour_change;
        if (!may_move(surface_, ring_, there, strictness_)) {
            continue;
        }
        if (cost_at(there, new_colour) < before && most2_ <= most2) {
            surface_.places[vertex] = there;
            if (surface_.coloured()) {
                surface_.colours[vertex] = new_colour;
            }
            points_.assign(cost_.block(), faces_, faces_);
            return;
        }
    }
}

/// Flips an edge if that lessens the cost by more than 2 %.
bool Polishing::try_flip(HalfEdge h) {
    CollapsibleMesh& mesh = surface_.mesh;
    if (surface_.is_material_border(h) || !mesh.may_flip(h)) {
        return false;
    }
    const HalfEdge o = mesh.twin(h);
    const std::uint32_t u = mesh.origin(h);
    const std::uint32_t w = mesh.target(h);
    const std::uint32_t x = mesh.origin(previous_of(h));
    const std::uint32_t y = mesh.origin(previous_of(o));
    const auto& p = surface_.places;
    const std::array<glm::dvec3, 3> first = {p[u], p[w], p[x]};
    const std::array<glm::dvec3, 3> second = {p[w], p[u], p[y]};
    const std::array<glm::dvec3, 3> new_first = {p[y], p[x], p[u]};
    const std::array<glm::dvec3, 3> new_second = {p[x], p[y], p[w]};
    if (!may_flip_to({first, second}, {new_first, new_second})) {
        return false;
    }
    faces_.assign({face_of(h), face_of(o)});
    cost_.gather(points_, faces_);
    const auto triangle = [&](const std::array<glm::dvec3, 3>& corners, const Triangle& v) {
        if (!surface_.coloured()) {
            return flat(corners);
        }
        const auto& c = surface_.colours;
        return flat(corners, {c[v[0]], c[v[1]], c[v[2]]});
    };
    cost_.triangles = {triangle(first, {u, w, x}), triangle(second, {w, u, y})};
    const double before = cost_.total();
    if (before <= cost_.negligible()) {
        return false;
    }
    const double most2 = std::max(cost_.most2(), avoided2_);
    cost_.triangles = {triangle(new_first, {y, x, u}), triangle(new_second, {x, y, w})};
    const double after = cost_.total();
    constexpr double enough = 0.98;
    if (!(after < enough * before) || cost_.most2() > most2) {
        return false;
    }
    const double aim_before = aims_.true_cost(target_, first) + aims_.true_cost(target_, second);
    const double aim_after =
        aims_.true_cost(target_, new_first) + aims_.true_cost(target_, new_second);
    if (!(after + aim_after < enough * (before + aim_before))) {
        return false;
    }
    mesh.flip(h);
    points_.assign(cost_.block(), faces_, faces_);
    return true;
}

/// Tries every edge once. Returns how many were flipped.
std::size_t Polishing::flip_edges() {
    std::size_t count = 0;
    const CollapsibleMesh& mesh = surface_.mesh;
    for (HalfEdge h = 0; h < mesh.face_slots() * 3; ++h) {
        if (mesh.face_is_there(face_of(h)) && mesh.edge_of(h) == h) {
            count += static_cast<std::size_t>(try_flip(h));
        }
    }
    return count;
}

} // namespace

void polish(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const PolishOptions& options) {
    Polishing polishing(surface, points, target, options);
    for (int round = 0; round < options.rounds; ++round) {
        polishing.round();
        polishing.flip_edges();
    }
    if (!options.extremes) {
        return;
    }
    polishing.list_again();
    lower_peaks(surface, points, target, options.peaks);
    polishing.list_again();
    turn_back(surface, points, target, {});
}

} // namespace octant::models::simplify
