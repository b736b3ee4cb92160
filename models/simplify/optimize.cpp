// Lowers the error of a simplified surface by local steps, after H. Hoppe, T. DeRose, T. Duchamp, J. McDonald, W.
// Stuetzle, "Mesh Optimization", 1993: a vertex moves to where a least-squares fit leads, an edge flips, or a vertex is
// relocated (the cheapest edge collapses, and one splits where that helps most).
//
// Deviations: the error is two-sided, and penalties rise faster than squares (Penalty), which lowers the largest
// distance too. Steps are not tried at random: a queue orders them by the expected reduction per unit of work. What a
// step achieved is what the next one nearby is expected to achieve, less a part. The number of triangles stays instead
// of being weighed against the error. At the end the same steps are made where the distance is largest, as long as that
// lowers it.
#include "models/simplify/optimize.h"

#include "models/simplify/edge_heap.h"
#include "models/simplify/local_error.h"
#include "models/simplify/working_surface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace octant::models::simplify {

namespace {

/// At so many root mean squares a distance has twice the penalty of its square.
constexpr double high = 1.5;
/// The shares of an error that a step is expected to take away before one was tried.
constexpr double expected_of_move = 0.1;
constexpr double expected_of_flip = 0.05;
constexpr double expected_of_split = 0.6;
/// The next move of the same vertex is expected to achieve this share of the last one, and the moves and flips around
/// it these.
constexpr double expected_again = 0.5;
constexpr double expected_nearby = 0.25;
/// At most so many distances count as one step; mostly there are some 2,000.
constexpr double work_of_step = 20'000.0;
/// A step is made only if it takes away this share of the error around it.
constexpr double min_share = 1e-3;
/// A step against the largest distance is made only if less than this share of its square is left, and all of them may
/// raise the error by a share of it, and of what other steps gained. They end when so many distances stay.
constexpr double lowered = 0.985;
constexpr double spare_share = 0.05;
constexpr double gain_share = 0.25;
constexpr int max_failed = 8;

class Optimizer {
public:
    Optimizer(WorkingSurface& surface, SurfaceSamples& samples, const OriginalSurface& original)
        : surface_(surface), samples_(samples), local_(surface, samples, original),
          vertices_(surface.mesh.vertex_slots()), edges_(surface.mesh.face_slots() * 3), queue_(vertices_ + 2 * edges_),
          collapses_(edges_), collapse_is_checked_(edges_, 0), split_is_checked_(edges_, 0) {}

    std::size_t run(const OptimizeOptions& options);

private:
    using Id = std::uint32_t;

    Id flip_of(HalfEdge edge) const { return static_cast<Id>(vertices_) + edge; }

    Id split_of(HalfEdge edge) const { return static_cast<Id>(vertices_ + edges_) + edge; }

    void measure_all();
    double max_distance2_of(std::uint32_t face, double trusted2);
    void lower_max(double mean2_before);
    bool lower_max_at(std::uint32_t face);
    void move_to_lower_max(std::uint32_t vertex);
    void fill();
    void expect(Id id, double gain, double work);
    void expect_split(HalfEdge edge);
    double error_at(HalfEdge edge) const;
    double work_at(HalfEdge edge) const;
    void try_step(Id id);
    void try_move(std::uint32_t vertex);
    void try_flip(HalfEdge h);
    void try_split(HalfEdge h);
    void relocate(HalfEdge split, HalfEdge collapsed);

    /// A vertex that a split or a collapse would make.
    struct MadeVertex {
        glm::dvec3 place{0.0};
        glm::dvec3 colour{0.0};
        double change = 0.0; ///< Of the error; infinite where it is not allowed.
    };

    void lower_max_by_corner(
        MadeVertex& made, double limit, std::uint32_t vertex, const std::function<bool(const glm::dvec3&)>& may_be_at);
    void fit_corner(glm::dvec3& place, glm::dvec3& colour);
    MadeVertex split_vertex(HalfEdge h);
    MadeVertex collapsed_vertex(HalfEdge h);
    HalfEdge cheapest_collapse();
    HalfEdge cheapest_collapse_away_from(HalfEdge split);
    bool touch(HalfEdge split, HalfEdge collapsed) const;
    void load_split(HalfEdge h);
    void load_collapse(HalfEdge h);
    void changed_around(std::uint32_t vertex, double gain, double work, bool connectivity);

    WorkingSurface& surface_;
    SurfaceSamples& samples_;
    LocalError local_;
    std::size_t vertices_;
    std::size_t edges_;
    EdgeHeap queue_;     ///< By the negative expected reduction per unit of work.
    EdgeHeap collapses_; ///< By the growth of the error.
    std::vector<std::uint8_t> collapse_is_checked_;
    std::vector<std::uint8_t> split_is_checked_;
    double max_distance2_ = 0.0; ///< No step leaves a larger one.
    bool is_lowering_max_ = false;
    double spare_ = 0.0; ///< By so much steps that lower the largest distance may raise the error.
    std::vector<RingFace> ring_;
    std::vector<std::uint32_t> faces_;
    std::vector<std::uint32_t> changed_; ///< The triangles of the last step that was made.
    std::vector<std::uint32_t> ring_faces_;
    std::vector<ColouredTriangle> fan_;
    std::vector<std::uint32_t> near_;
};

/// Measures the ways back and the largest distance.
void Optimizer::measure_all() {
    samples_.set_penalty({1.0 / std::max(high * high * samples_.mean2(), 1e-30)});
    max_distance2_ = local_.measure_all_back();
    for (std::uint32_t sample = 0; sample < samples_.size(); ++sample) {
        max_distance2_ = std::max(max_distance2_, static_cast<double>(samples_[sample].distance2));
    }
}

double Optimizer::error_at(HalfEdge edge) const {
    const HalfEdge twin = surface_.mesh.twin(edge);
    return samples_.error(face_of(edge)) + (twin == none ? 0.0 : samples_.error(face_of(twin)));
}

/// About how much work a step at the two triangles of an edge is, in distances.
double Optimizer::work_at(HalfEdge edge) const {
    constexpr double fixed = 100.0;
    const HalfEdge twin = surface_.mesh.twin(edge);
    const std::size_t count = samples_.count(face_of(edge)) + (twin == none ? 0 : samples_.count(face_of(twin)));
    return fixed + 8.0 * static_cast<double>(count);
}

/// Puts a step into the queue, or raises what is expected of it.
void Optimizer::expect(Id id, double gain, double work) {
    const auto key = static_cast<float>(-gain / work);
    if (gain > 0.0 && (!queue_.holds(id) || key < queue_.cost(id))) { queue_.set(id, key); }
}

void Optimizer::expect_split(HalfEdge edge) {
    split_is_checked_[edge] = 0;
    expect(split_of(edge), expected_of_split * error_at(edge), 2.0 * work_at(edge));
}

void Optimizer::fill() {
    const CollapsibleMesh& mesh = surface_.mesh;
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_slots(); ++vertex) {
        if (!mesh.has_vertex(vertex)) { continue; }
        double error = 0.0;
        double work = 0.0;
        mesh.around(vertex, [&](HalfEdge h) {
            error += samples_.error(face_of(h));
            work += work_at(h);
        });
        expect(vertex, expected_of_move * error, work);
    }
    for (HalfEdge h = 0; h < edges_; ++h) {
        if (mesh.has_face(face_of(h)) && mesh.edge_of(h) == h) {
            expect(flip_of(h), expected_of_flip * error_at(h), work_at(h));
            expect_split(h);
            collapses_.set(h, 0.0F);
        }
    }
}

std::size_t Optimizer::run(const OptimizeOptions& options) {
    measure_all();
    const double mean2_before = samples_.mean2();
    fill();
    std::size_t steps = 0;
    while (steps < options.max_steps && !queue_.empty()) {
        if (steps % 64 == 0 && options.deadline && std::chrono::steady_clock::now() > *options.deadline) { break; }
        try_step(queue_.top());
        // Steps among very many triangles or samples count several times.
        steps = std::max(steps + 1, static_cast<std::size_t>(local_.work_done() / work_of_step));
    }
    if (steps > 0) { lower_max(mean2_before); }
    return steps;
}

/// The largest squared distance, both ways, of a triangle. Squares above `trusted2` are exact.
double Optimizer::max_distance2_of(std::uint32_t face, double trusted2) {
    local_.set_trusted2(trusted2);
    faces_.assign(1, face);
    local_.gather(faces_);
    const ColouredTriangle present{surface_.mesh.corners(face), surface_.corner_places(face), {}};
    local_.set_triangles(std::span(&present, 1), faces_);
    local_.measured();
    return local_.max_distance2();
}

/// Lowers the largest distance where it is, again and again, until some of the largest ones stay. All steps together
/// raise the mean square by no more than a small share, and a share of what has been gained on `mean2_before`.
void Optimizer::lower_max(double mean2_before) {
    constexpr double untrusted = std::numeric_limits<double>::max();
    const CollapsibleMesh& mesh = surface_.mesh;
    samples_.set_penalty({}); // Now the error is the sum of squares.
    local_.measure_all_back();
    local_.measure_densely();
    EdgeHeap largest(mesh.face_slots());
    double error = 0.0;
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        if (mesh.has_face(face)) {
            error += samples_.error(face);
            largest.set(face, static_cast<float>(-max_distance2_of(face, untrusted)));
        }
    }
    is_lowering_max_ = true;
    const double gained = mean2_before / std::max(samples_.mean2(), 1e-30) - 1.0;
    spare_ = error * std::clamp(gain_share * gained, 0.0, spare_share);
    const std::size_t max_steps = 32 + mesh.face_count() / 4;
    int failed = 0;
    for (std::size_t step = 0; step < max_steps && failed < max_failed && !largest.empty(); ++step) {
        const std::uint32_t face = largest.top();
        const auto told2 = -static_cast<double>(largest.cost(face));
        const double max2 = max_distance2_of(face, 0.5 * told2);
        if (max2 < 0.998 * told2) {
            largest.set(face, static_cast<float>(-max2));
            continue;
        }
        max_distance2_ = lowered * max2;
        local_.set_trusted2(max_distance2_);
        if (!lower_max_at(face)) {
            largest.remove(face);
            ++failed;
            continue;
        }
        for (const std::uint32_t changed : changed_) {
            largest.set(changed, static_cast<float>(-max_distance2_of(changed, untrusted)));
        }
    }
}

/// Makes the first step at a triangle that leaves no distance around it above the largest one allowed: a vertex moves,
/// an edge flips, or an edge splits. False if there is none.
bool Optimizer::lower_max_at(std::uint32_t face) {
    changed_.clear();
    const CollapsibleMesh& mesh = surface_.mesh;
    for (const std::uint32_t vertex : Triangle(mesh.corners(face))) {
        move_to_lower_max(vertex);
        if (!changed_.empty()) { return true; }
    }
    for (std::uint32_t side = 0; side < 3 && changed_.empty(); ++side) { try_flip(mesh.edge_of(3 * face + side)); }
    for (std::uint32_t side = 0; side < 3 && changed_.empty(); ++side) {
        const HalfEdge edge = mesh.edge_of(3 * face + side);
        const HalfEdge collapse = surface_.is_border(edge) ? none : cheapest_collapse_away_from(edge);
        if (collapse != none) { relocate(edge, collapse); }
    }
    return !changed_.empty();
}

/// Looks for a place of corner 0 of the new triangles at which no distance is above the largest one allowed and the
/// error is at most `limit`, from `made.place` on. `vertex` is the one that moves, or none. The place is the one that
/// was measured last; `made.change` becomes the error there, or infinite where there is no such place.
void Optimizer::lower_max_by_corner(
    MadeVertex& made, double limit, std::uint32_t vertex, const std::function<bool(const glm::dvec3&)>& may_be_at) {
    constexpr int max_tries = 8;
    constexpr double min_length = 0.05;
    constexpr double shorter = 0.4;
    const auto way_from_here = [&] {
        const glm::dvec3 way = local_.max_error_step();
        return vertex == none ? way : surface_.along_borders(vertex, way);
    };
    const double start = local_.measured();
    double max2 = local_.max_distance2();
    made.change = std::numeric_limits<double>::infinity();
    if (max2 <= max_distance2_) {
        made.change = vertex == none && start < limit ? start : made.change;
        return;
    }
    glm::dvec3 way = way_from_here();
    double length = 1.0;
    for (int i = 0; i < max_tries && length > min_length; ++i) {
        const glm::dvec3 there = made.place + length * way;
        if (!may_be_at(there)) {
            length *= shorter;
            continue;
        }
        local_.move_corner(there, made.colour);
        const double after = local_.measured();
        if (!(after <= limit) || local_.max_distance2() >= max2) {
            length *= shorter;
            continue;
        }
        made.place = there;
        max2 = local_.max_distance2();
        if (max2 <= max_distance2_) {
            made.change = after;
            return;
        }
        way = way_from_here();
        length = std::min(1.0, 2.0 * length);
    }
}

/// Moves a vertex so that the largest distance around it falls below the largest one allowed.
void Optimizer::move_to_lower_max(std::uint32_t vertex) {
    surface_.mesh.ring_at(vertex, ring_, faces_);
    MadeVertex moved{surface_.places[vertex], surface_.colour_of(vertex), 0.0};
    local_.gather(faces_);
    local_.set_ring(ring_, moved.place, moved.colour);
    const double limit = local_.present() + spare_;
    lower_max_by_corner(
        moved, limit, vertex, [&](const glm::dvec3& place) { return may_move(surface_, ring_, place); });
    if (std::isfinite(moved.change)) {
        surface_.places[vertex] = moved.place;
        local_.keep(faces_, faces_, vertex);
        spare_ = limit - moved.change;
        changed_ = faces_;
    }
}

void Optimizer::try_step(Id id) {
    if (id < vertices_) {
        queue_.remove(id);
        try_move(id);
    } else if (id < vertices_ + edges_) {
        queue_.remove(id);
        try_flip(id - static_cast<Id>(vertices_));
    } else {
        try_split(id - static_cast<Id>(vertices_ + edges_));
    }
}

/// Moves a vertex, and changes its colour, if a full or a shorter step of the fit lessens the error.
void Optimizer::try_move(std::uint32_t vertex) {
    surface_.mesh.ring_at(vertex, ring_, faces_);
    const glm::dvec3 place = surface_.places[vertex];
    const glm::dvec3 colour = surface_.colour_of(vertex);
    local_.gather(faces_);
    const double before = local_.present();
    if (before <= local_.rounding()) { return; }
    local_.set_ring(ring_, place, colour);
    local_.forward_error();
    const VertexFit fit = local_.fit(true);
    const glm::dvec3 way = surface_.along_borders(vertex, fit.way());
    const double work = local_.work();
    for (const double step : {1.0, 0.4}) {
        const glm::dvec3 there = place + step * way;
        const glm::dvec3 new_colour = colour + step * fit.colour_change();
        if (!may_move(surface_, ring_, there)) { continue; }
        local_.move_corner(there, new_colour);
        const double limit = (1.0 - min_share) * before;
        const double after = local_.measured(limit);
        if (after < limit && local_.max_distance2() <= max_distance2_) {
            surface_.set_vertex(vertex, there, new_colour);
            local_.keep(faces_, faces_, vertex);
            expect(vertex, expected_again * (before - after), work);
            changed_around(vertex, before - after, work, false);
            return;
        }
    }
}

/// Renews what is expected of the steps around a vertex at which something changed.
void Optimizer::changed_around(std::uint32_t vertex, double gain, double work, bool connectivity) {
    const CollapsibleMesh& mesh = surface_.mesh;
    mesh.around(vertex, [&](HalfEdge h) {
        for (const HalfEdge side : {h, next_of(h)}) {
            const HalfEdge edge = mesh.edge_of(side);
            if (connectivity) {
                expect(flip_of(edge), expected_of_flip * error_at(edge), work_at(edge));
                expect_split(edge);
                collapses_.set(edge, 0.0F);
            } else {
                expect(flip_of(edge), 0.2 * expected_nearby * gain, work);
                split_is_checked_[edge] = 0;
            }
            collapse_is_checked_[edge] = 0;
        }
        if (connectivity) {
            expect(mesh.target(h), expected_of_move * samples_.error(face_of(h)), work_at(h));
        } else {
            expect(mesh.target(h), expected_nearby * gain, work);
        }
    });
    if (connectivity) { expect(vertex, expected_again * gain, work); }
}

void Optimizer::try_flip(HalfEdge h) {
    CollapsibleMesh& mesh = surface_.mesh;
    if (mesh.twin(h) == none || surface_.is_material_border(h) || !mesh.may_flip(h)) { return; }
    const std::uint32_t u = mesh.origin(h);
    const std::uint32_t w = mesh.target(h);
    const std::uint32_t x = mesh.origin(previous_of(h));
    const std::uint32_t y = mesh.origin(previous_of(mesh.twin(h)));
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return ColouredTriangle{{a, b, c}, {surface_.places[a], surface_.places[b], surface_.places[c]},
            {surface_.colour_of(a), surface_.colour_of(b), surface_.colour_of(c)}};
    };
    const std::array old = {triangle(u, w, x), triangle(w, u, y)};
    const std::array made = {triangle(y, x, u), triangle(x, y, w)};
    if (!may_flip_to({old[0].places, old[1].places}, {made[0].places, made[1].places})) { return; }
    faces_.assign({face_of(h), face_of(mesh.twin(h))});
    local_.gather(faces_);
    const double before = local_.present();
    if (before <= local_.rounding()) { return; }
    local_.set_triangles(made, faces_);
    const double limit = is_lowering_max_ ? before + spare_ : 0.99 * before;
    const double after = local_.measured(limit);
    if (!(after < limit) || local_.max_distance2() > max_distance2_) { return; }
    mesh.flip(h);
    local_.keep(faces_, faces_, none);
    changed_ = faces_;
    spare_ = is_lowering_max_ ? std::max(0.0, spare_ + before - after) : 0.0;
    const double work = local_.work();
    for (const std::uint32_t vertex : {u, w, x, y}) { expect(vertex, expected_nearby * (before - after), work); }
    for (const std::uint32_t face : faces_) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const HalfEdge edge = mesh.edge_of(3 * face + corner);
            expect(flip_of(edge), expected_nearby * (before - after), work);
            split_is_checked_[edge] = 0;
            collapse_is_checked_[edge] = 0;
            if (!collapses_.holds(edge)) { collapses_.set(edge, 0.0F); }
        }
    }
}

/// Loads the triangles around an edge that would split, no border, into a fan around the new vertex.
void Optimizer::load_split(HalfEdge h) {
    const CollapsibleMesh& mesh = surface_.mesh;
    faces_.clear();
    fan_.clear();
    const glm::dvec3 middle = 0.5 * (surface_.places[mesh.origin(h)] + surface_.places[mesh.target(h)]);
    const glm::dvec3 colour = 0.5 * (surface_.colour_of(mesh.origin(h)) + surface_.colour_of(mesh.target(h)));
    const auto add = [&](std::uint32_t b, std::uint32_t c) {
        fan_.push_back({{none, b, c}, {middle, surface_.places[b], surface_.places[c]},
            {colour, surface_.colour_of(b), surface_.colour_of(c)}});
    };
    // In the order of CollapsibleMesh::split.
    for (const HalfEdge side : {h, mesh.twin(h)}) {
        faces_.push_back(face_of(side));
        const std::uint32_t opposite = mesh.origin(previous_of(side));
        add(opposite, mesh.origin(side));
        add(mesh.target(side), opposite);
    }
    local_.gather(faces_);
    near_.clear();
    for (std::size_t i = 0; i < fan_.size(); ++i) { near_.push_back(faces_[i / 2]); }
    local_.set_triangles(fan_, near_);
}

/// Moves corner 0 of the new triangles to where two least-squares fits lead.
void Optimizer::fit_corner(glm::dvec3& place, glm::dvec3& colour) {
    for (int fit = 0; fit < 2; ++fit) {
        local_.forward_error();
        const VertexFit step = local_.fit(false);
        place += step.way();
        colour += step.colour_change();
        local_.move_corner(place, colour);
    }
}

/// The vertex that a split of an edge would make.
Optimizer::MadeVertex Optimizer::split_vertex(HalfEdge h) {
    load_split(h);
    MadeVertex made{fan_[0].places[0], fan_[0].colours[0], std::numeric_limits<double>::infinity()};
    const double present = local_.present();
    if (present <= local_.rounding()) { return made; }
    const auto is_allowed = [&](const glm::dvec3& place) {
        for (std::size_t i = 0; i < fan_.size(); ++i) {
            std::array<glm::dvec3, 3> corners = fan_[i].places;
            corners[0] = place;
            if (!is_valid_deformation(surface_.corner_places(faces_[i / 2]), corners)) { return false; }
        }
        return true;
    };
    if (is_lowering_max_) {
        if (is_allowed(made.place)) {
            lower_max_by_corner(made, present + spare_, none, is_allowed);
            made.change -= present;
        }
        return made;
    }
    glm::dvec3 place = made.place;
    glm::dvec3 colour = made.colour;
    fit_corner(place, colour);
    if (is_allowed(place)) {
        const double after = local_.measured(present);
        if (after < present && local_.max_distance2() <= max_distance2_) { made = {place, colour, after - present}; }
    }
    return made;
}

void Optimizer::load_collapse(HalfEdge h) {
    const CollapsibleMesh& mesh = surface_.mesh;
    mesh.ring_of(h, ring_);
    faces_ = {face_of(h), face_of(mesh.twin(h))};
    ring_faces_.clear();
    for (const RingFace& face : ring_) {
        faces_.push_back(face.face);
        ring_faces_.push_back(face.face);
    }
    local_.gather(faces_);
}

/// The vertex that a collapse of an edge would leave.
Optimizer::MadeVertex Optimizer::collapsed_vertex(HalfEdge h) {
    const CollapsibleMesh& mesh = surface_.mesh;
    MadeVertex made{glm::dvec3(0.0), glm::dvec3(0.0), std::numeric_limits<double>::infinity()};
    if (surface_.effect_of(h, TopologyChanges::None).kind == CollapseEffect::Kind::NotAllowed ||
        surface_.is_border_vertex(mesh.origin(h)) || surface_.is_border_vertex(mesh.target(h))) {
        return made;
    }
    load_collapse(h);
    const std::uint32_t u = mesh.origin(h);
    const std::uint32_t w = mesh.target(h);
    glm::dvec3 place = 0.5 * (surface_.places[u] + surface_.places[w]);
    glm::dvec3 colour = 0.5 * (surface_.colour_of(u) + surface_.colour_of(w));
    local_.set_ring(ring_, place, colour);
    fit_corner(place, colour);
    if (may_move(surface_, ring_, place)) {
        const double after = local_.measured();
        if (local_.max_distance2() <= max_distance2_) { made = {place, colour, after - local_.present()}; }
    }
    return made;
}

/// The edge whose collapse costs least; none where no edge may collapse.
HalfEdge Optimizer::cheapest_collapse() {
    while (!collapses_.empty()) {
        const HalfEdge edge = collapses_.top();
        if (collapse_is_checked_[edge] != 0) { return edge; }
        collapse_is_checked_[edge] = 1;
        const bool is_edge = surface_.mesh.has_face(face_of(edge)) && surface_.mesh.edge_of(edge) == edge;
        const double change = is_edge ? collapsed_vertex(edge).change : std::numeric_limits<double>::infinity();
        if (std::isinf(change)) {
            collapses_.remove(edge);
        } else {
            collapses_.set(edge, static_cast<float>(change));
        }
    }
    return none;
}

/// Whether triangles around both edges share a vertex.
bool Optimizer::touch(HalfEdge split, HalfEdge collapsed) const {
    const CollapsibleMesh& mesh = surface_.mesh;
    std::vector<std::uint32_t> near;
    for (const HalfEdge side : {split, mesh.twin(split)}) {
        const Triangle corners = mesh.corners(face_of(side));
        near.insert(near.end(), corners.begin(), corners.end());
    }
    bool found = false;
    for (const std::uint32_t end : {mesh.origin(collapsed), mesh.target(collapsed)}) {
        mesh.around(end, [&](HalfEdge h) {
            for (const std::uint32_t corner : mesh.corners(face_of(h))) {
                found = found || std::ranges::find(near, corner) != near.end();
            }
        });
    }
    return found;
}

/// The edge whose collapse costs least and does not touch the triangles of one that splits; none where several of the
/// cheapest ones touch them.
HalfEdge Optimizer::cheapest_collapse_away_from(HalfEdge split) {
    constexpr std::size_t max_tries = 8;
    std::vector<std::pair<HalfEdge, float>> touching;
    HalfEdge found = cheapest_collapse();
    while (found != none && touch(split, found)) {
        touching.emplace_back(found, collapses_.cost(found));
        collapses_.remove(found);
        found = touching.size() < max_tries ? cheapest_collapse() : none;
    }
    for (const auto& [edge, cost] : touching) { collapses_.set(edge, cost); }
    return found;
}

/// Splits an edge if that takes more away than the cheapest collapse elsewhere costs. The first time only finds out
/// what it is worth.
void Optimizer::try_split(HalfEdge h) {
    const Id id = split_of(h);
    const CollapsibleMesh& mesh = surface_.mesh;
    if (!mesh.has_face(face_of(h)) || mesh.edge_of(h) != h || surface_.is_border(h)) {
        queue_.remove(id);
        return;
    }
    const HalfEdge cheapest = cheapest_collapse();
    if (cheapest == none) {
        queue_.remove(id);
        return;
    }
    const auto cost = static_cast<double>(collapses_.cost(cheapest));
    if (split_is_checked_[h] == 0) {
        split_is_checked_[h] = 1;
        const double gain = -split_vertex(h).change - cost;
        if (gain > min_share * cost) {
            queue_.set(id, static_cast<float>(-gain / (4.0 * work_at(h))));
        } else {
            queue_.remove(id);
        }
        return;
    }
    queue_.remove(id);
    if (touch(h, cheapest)) { return; }
    relocate(h, cheapest);
}

/// Collapses one edge and splits another one, neither of them a border, with the triangles that are free then.
void Optimizer::relocate(HalfEdge split, HalfEdge collapsed) {
    CollapsibleMesh& mesh = surface_.mesh;
    const MadeVertex apart = split_vertex(split);
    const MadeVertex merged = collapsed_vertex(collapsed);
    const double gain = -apart.change - merged.change;
    if (!(gain + spare_ > 0.0)) {
        if (std::isinf(merged.change)) {
            collapse_is_checked_[collapsed] = 0; // Since then less has been allowed.
        }
        return;
    }
    // The collapse.
    load_collapse(collapsed);
    local_.set_ring(ring_, merged.place, merged.colour);
    local_.measured();
    const double work = local_.work();
    const std::uint32_t kept = mesh.origin(collapsed);
    const std::uint32_t gone = mesh.target(collapsed);
    const std::array free = {face_of(collapsed), face_of(mesh.twin(collapsed))};
    for (const HalfEdge side : {collapsed, mesh.twin(collapsed)}) {
        for (const HalfEdge at : {side, next_of(side), previous_of(side)}) {
            const HalfEdge edge = mesh.edge_of(at);
            collapses_.remove(edge);
            queue_.remove(flip_of(edge));
            queue_.remove(split_of(edge));
        }
    }
    mesh.collapse(collapsed);
    surface_.set_vertex(kept, merged.place, merged.colour);
    local_.keep(faces_, ring_faces_, kept);
    queue_.remove(gone);
    // The split.
    load_split(split);
    local_.move_corner(apart.place, apart.colour);
    local_.measured();
    const std::uint32_t left = face_of(split);
    const std::uint32_t right = face_of(mesh.twin(split));
    mesh.split(split, gone, free);
    if (!surface_.materials.empty()) {
        surface_.materials[free[0]] = surface_.materials[left];
        surface_.materials[free[1]] = surface_.materials[right];
    }
    surface_.set_vertex(gone, apart.place, apart.colour);
    changed_ = {left, free[0], free[1], right};
    local_.keep(faces_, changed_, gone);
    spare_ = is_lowering_max_ ? std::max(0.0, spare_ + gain) : 0.0;
    mesh.around(kept, [&](HalfEdge h) { changed_.push_back(face_of(h)); });
    changed_around(kept, gain, work, true);
    changed_around(gone, gain, work, true);
}

} // namespace

std::size_t optimize(
    WorkingSurface& surface, SurfaceSamples& samples, const OriginalSurface& original, const OptimizeOptions& options) {
    return Optimizer(surface, samples, original).run(options);
}

} // namespace octant::models::simplify
