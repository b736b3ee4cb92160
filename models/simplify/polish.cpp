// Fits a surface to another one by least squares, vertex after vertex: after H. Hoppe et al., "Mesh
// Optimization", 1993, section 4.1.
// Deviations: two-sided (points of the target on the surface, samples of the surface on the
// target); a Gauss-Newton step on distances; colours; a vertex moves only where that lessens the
// sum and no triangle turns over.
#include "models/simplify/polish.h"

#include "models/simplify/collapse_guard.h"
#include "models/simplify/peaks.h"
#include "models/simplify/surface_cost.h"
#include "models/simplify/turned_faces.h"
#include "models/simplify/vertex_fit.h"
#include "sim/base/worker_team.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace octant::models::simplify {

namespace {

/// Where samples lie on a triangle: weights of its corners.
constexpr std::array<std::array<double, 3>, 4> sample_weights = {
    {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0.7, 0.15, 0.15}, {0.15, 0.7, 0.15}, {0.15, 0.15, 0.7}}};

class Polishing {
public:
    Polishing(
        WorkingSurface& surface, TrackedPoints& points, const PolishTarget& target, int threads)
        : surface_(surface)
        , points_(points)
        , target_(target)
        , threads_(threads) {}

    void round() {
        list_again();
        aim();
        for (std::uint32_t vertex = 0; vertex < surface_.mesh.vertex_slots(); ++vertex) {
            if (surface_.mesh.vertex_is_there(vertex)) {
                fit(vertex);
            }
        }
    }

    std::size_t flip_edges();
    void list_again();

private:
    template <typename Work>
    void for_each_face(const Work& work) const;
    void aim();
    void fit(std::uint32_t vertex);
    double cost_at(const glm::dvec3& place, const glm::dvec3& colour);
    void take_ring(std::uint32_t vertex);
    VertexFit fitted();
    bool try_flip(HalfEdge h);
    double aim_cost(const std::array<glm::dvec3, 3>& corners) const;

    WorkingSurface& surface_;
    TrackedPoints& points_;
    PolishTarget target_;
    int threads_;
    /// Of each triangle's samples: the nearest places of the target.
    std::vector<std::array<glm::dvec3, sample_weights.size()>> aims_;
    SurfaceCost cost_;
    std::vector<RingFace> ring_;
    std::vector<std::uint32_t> faces_;
};

/// Calls `work(first, end)` for ranges of all triangles, on several threads.
template <typename Work>
void Polishing::for_each_face(const Work& work) const {
    constexpr std::size_t chunk = 256;
    const std::size_t slots = surface_.mesh.face_slots();
    share_out((slots + chunk - 1) / chunk, threads_, [&](std::size_t part, std::size_t) {
        const std::size_t end = std::min((part + 1) * chunk, slots);
        work(static_cast<std::uint32_t>(part * chunk), static_cast<std::uint32_t>(end));
    });
}

/// Puts points into the lists of nearer triangles, among those that share a vertex with theirs.
void Polishing::list_again() {
    const CollapsibleMesh& mesh = surface_.mesh;
    std::vector<std::uint32_t> chosen(points_.size(), none);
    for_each_face([&](std::uint32_t first, std::uint32_t end) {
        PointBlock block;
        std::vector<FlatTriangle> triangles;
        std::vector<std::uint32_t> near;
        for (std::uint32_t face = first; face < end; ++face) {
            if (!mesh.face_is_there(face)) {
                continue;
            }
            block.clear();
            points_.gather(face, block);
            near.assign(1, face);
            for (const std::uint32_t vertex : mesh.corners(face)) {
                mesh.around(vertex, [&](HalfEdge h) {
                    if (std::ranges::find(near, face_of(h)) == near.end()) {
                        near.push_back(face_of(h));
                    }
                });
            }
            triangles.clear();
            for (const std::uint32_t other : near) {
                triangles.push_back(flat(surface_.corner_places(other)));
            }
            find_nearest(block, 0, block.size(), triangles, false);
            for (std::size_t i = 0; i < block.size(); ++i) {
                chosen[block.numbers[i]] = near[static_cast<std::size_t>(block.nearest[i])];
            }
        }
    });
    points_.assign_all(chosen, mesh.face_slots());
}

void Polishing::aim() {
    const CollapsibleMesh& mesh = surface_.mesh;
    aims_.resize(mesh.face_slots());
    for_each_face([&](std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t face = first; face < end; ++face) {
            if (!mesh.face_is_there(face)) {
                continue;
            }
            const std::array<glm::dvec3, 3> corners = surface_.corner_places(face);
            for (std::size_t i = 0; i < sample_weights.size(); ++i) {
                const auto& w = sample_weights[i];
                const glm::dvec3 place = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
                aims_[face][i] = target_.bvh.nearest(place).point;
            }
        }
    });
}

void Polishing::take_ring(std::uint32_t vertex) {
    ring_.clear();
    faces_.clear();
    surface_.mesh.around(vertex, [this](HalfEdge h) {
        ring_.push_back({face_of(h), h});
        faces_.push_back(face_of(h));
    });
    cost_.gather(points_, faces_);
}

VertexFit Polishing::fitted() {
    VertexFit fit;
    const PointBlock& block = cost_.block();
    for (std::size_t i = 0; i < block.size(); ++i) {
        const FlatTriangle& nearest = cost_.triangles[static_cast<std::size_t>(block.nearest[i])];
        add_point(
            fit, block, i, nearest, static_cast<double>(block.weights[i]), points_.coloured());
    }
    for (const RingFace& face : ring_) {
        const std::array<glm::dvec3, 3> corners = surface_.corner_places(face.face);
        const glm::dvec3 area2 = area_vector(corners);
        const double size = glm::length(area2);
        const std::size_t corner = face.half_edge % 3;
        for (std::size_t i = 0; i < sample_weights.size() && size > 0.0; ++i) {
            const auto& w = sample_weights[i];
            const glm::dvec3 place = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
            fit.add(
                aims_[face.face][i] - place,
                area2 / size,
                w[corner],
                0.5 * size / static_cast<double>(sample_weights.size()));
        }
    }
    return fit;
}

/// Distances of the points to the ring with its vertex there, and of samples to where they aim.
double Polishing::cost_at(const glm::dvec3& place, const glm::dvec3& colour) {
    cost_.set_triangles(surface_, ring_, place, colour);
    double sum = cost_.total();
    for (const RingFace& face : ring_) {
        std::array<glm::dvec3, 3> corners = surface_.corner_places(face.face);
        corners[face.half_edge % 3] = place;
        const glm::dvec3 area2 = area_vector(corners);
        const double size = glm::length(area2);
        if (!(size > 0.0)) {
            continue;
        }
        for (std::size_t i = 0; i < sample_weights.size(); ++i) {
            const auto& w = sample_weights[i];
            const glm::dvec3 off =
                aims_[face.face][i] - w[0] * corners[0] - w[1] * corners[1] - w[2] * corners[2];
            const double along = glm::dot(off, area2) / size;
            sum += 0.5 * size / static_cast<double>(sample_weights.size()) *
                   (along * along + 0.1 * glm::dot(off, off));
        }
    }
    return sum;
}

void Polishing::fit(std::uint32_t vertex) {
    take_ring(vertex);
    const glm::dvec3 place = surface_.places[vertex];
    const glm::dvec3 colour = surface_.coloured() ? surface_.colours[vertex] : glm::dvec3(0.0);
    const double before = cost_at(place, colour);
    const VertexFit fit = fitted();
    const glm::dvec3 way = fit.way();
    const glm::dvec3 colour_change = fit.colour_change();
    for (const double step : {1.0, 0.4}) {
        const glm::dvec3 there = place + step * way;
        const glm::dvec3 new_colour = colour + step * colour_change;
        if (!may_move(surface_, ring_, there, Strictness::Normal)) {
            continue;
        }
        if (cost_at(there, new_colour) < before) {
            surface_.places[vertex] = there;
            if (surface_.coloured()) {
                surface_.colours[vertex] = new_colour;
            }
            points_.assign(cost_.block(), faces_, faces_);
            return;
        }
    }
}

double Polishing::aim_cost(const std::array<glm::dvec3, 3>& corners) const {
    double sum = 0.0;
    for (const auto& w : sample_weights) {
        sum += target_.bvh.nearest(w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2])
                   .distance2;
    }
    return sum * 0.5 * glm::length(area_vector(corners)) /
           static_cast<double>(sample_weights.size());
}

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
    cost_.triangles = {triangle(new_first, {y, x, u}), triangle(new_second, {x, y, w})};
    const double after = cost_.total();
    constexpr double enough = 0.98;
    if (!(after < enough * before)) {
        return false;
    }
    const double aim_before = aim_cost(first) + aim_cost(second);
    const double aim_after = aim_cost(new_first) + aim_cost(new_second);
    if (!(after + aim_after < enough * (before + aim_before))) {
        return false;
    }
    mesh.flip(h);
    points_.assign(cost_.block(), faces_, faces_);
    return true;
}

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
    Polishing polishing(surface, points, target, options.threads);
    for (int round = 0; round < options.rounds; ++round) {
        polishing.round();
        polishing.flip_edges();
    }
    polishing.list_again();
    lower_peaks(surface, points, target, {});
    polishing.list_again();
    turn_back(surface, points, target, {});
}

} // namespace octant::models::simplify
