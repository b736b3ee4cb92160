// Turns triangles back that face against the target. They occur in parts thinner than the error,
// where distances alone do not tell one side from the other. Vertices move to where least squares
// lead when turned samples aim at the side that faces their way, or else by trial along the axes.
// Our own addition: the 2005 paper does not look at normals.
#include "models/simplify/turned_faces.h"

#include "models/simplify/collapse_guard.h"
#include "models/simplify/ring_heights.h"
#include "models/simplify/vertex_fit.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace octant::models::simplify {

namespace {

using Corners = std::array<glm::dvec3, 3>;

/// The price of turned area, in multiples of the mean squared distance.
constexpr double price = 200.0;
/// Steps may lead to distances up to this share of the largest squared distance.
constexpr double most2_share = 0.85;
/// The same for distances from the tracked points, which may lie far apart.
constexpr double points_most2_share = 0.85;
/// A round that leaves more than this share of the turned area is the last one.
constexpr double most_left = 0.98;

double area_of(const WorkingSurface& surface, std::uint32_t face) {
    return 0.5 * glm::length(area_vector(surface.corner_places(face)));
}

double area_of(const WorkingSurface& surface) {
    double area = 0.0;
    for (std::uint32_t face = 0; face < surface.mesh.face_slots(); ++face) {
        area += surface.mesh.face_is_there(face) ? area_of(surface, face) : 0.0;
    }
    return area;
}

/// The state of one run of turn_back.
class TurningBack {
public:
    TurningBack(
        WorkingSurface& surface,
        TrackedPoints& points,
        const PolishTarget& target,
        const TurnOptions& options)
        : surface_(surface)
        , target_(target)
        , around_(
              surface,
              points,
              target,
              {.spacing = std::sqrt(area_of(surface) / static_cast<double>(options.samples))})
        , heights_(surface.mesh.face_slots())
        , tried_vertices_(surface.mesh.vertex_slots(), false) {
        Heights all;
        for (std::uint32_t face = 0; face < heights_.size(); ++face) {
            if (surface.mesh.face_is_there(face)) {
                around_.take_face(face);
                heights_[face] = around_.seen({});
                all.add(heights_[face]);
                for (const SeenSample& sample : around_.samples()) {
                    most2_ = std::max(most2_, glm::dot(sample.off, sample.off));
                }
            }
        }
        const double area = area_of(surface);
        // The sum of squares counts both directions.
        mean2_ = area > 0.0 ? all.squares / (2.0 * area) : 0.0;
        allowance_ = (2.0 + options.most_growth) * options.most_growth * all.squares;
        most_looks_ = around_.looks() + options.looks;
    }

    double turned() const {
        double sum = 0.0;
        for (const Heights& heights : heights_) {
            sum += heights.turned;
        }
        return sum;
    }

    /// Whether all distances are nothing but rounding.
    bool is_exact() const { return most2_ <= peak_rounding2; }

    void round();

private:
    bool may_become_here(std::uint32_t face, const Corners& before, const Corners& after) const;
    HeightLimits limits(const Heights& before) const;
    bool is_better(const Heights& before, const Heights& after) const;
    void keep(const Heights& before, const Heights& after);
    glm::dvec3 way() const;
    bool may_step_to(const glm::dvec3& place, std::uint32_t vertex) const;
    bool step_to(const glm::dvec3& place, std::uint32_t vertex, const Heights& before);
    bool step_along_axes(std::uint32_t vertex, const Heights& before);
    void move(std::uint32_t vertex);

    glm::dvec3 colour(std::uint32_t vertex) const {
        return surface_.coloured() ? surface_.colours[vertex] : glm::dvec3(0.0);
    }

    WorkingSurface& surface_;
    PolishTarget target_;
    RingHeights around_;
    std::vector<Heights> heights_; ///< For each triangle.
    /// Vertices that were tried in vain and around which nothing has changed since.
    std::vector<bool> tried_vertices_;
    /// The largest squared distance of the ring's points before a step.
    double points_before2_ = 0.0;
    std::size_t most_looks_ = 0;
    double mean2_ = 0.0;     ///< The mean squared distance.
    double allowance_ = 0.0; ///< By how much the sum of squares may still grow.
    double most2_ = 0.0;     ///< The largest squared distance of a sample at the start.
};

/// As may_become, but a triangle that is turned itself may also turn over.
bool TurningBack::may_become_here(
    std::uint32_t face, const Corners& before, const Corners& after) const {
    if (may_become(before, after, Strictness::Normal)) {
        return true;
    }
    const bool is_turned = heights_[face].turned > 0.25 * glm::length(area_vector(before));
    return is_turned && may_become({before[0], before[2], before[1]}, after, Strictness::Normal);
}

/// The limits at which a candidate step is given up.
HeightLimits TurningBack::limits(const Heights& before) const {
    const double turned_price = price * mean2_;
    return {
        std::max(most2_share * most2_, std::min(before.most2, most2_)),
        before.squares + turned_price * before.turned,
        turned_price,
        before.turned};
}

/// Whether a step leaves less turned area and costs no more than is allowed.
bool TurningBack::is_better(const Heights& before, const Heights& after) const {
    const double points_limit2 = std::max(points_before2_, points_most2_share * most2_);
    return after.turned < before.turned && limits(before).allow(after) &&
           around_.points_most2() <= points_limit2 && after.squares - before.squares <= allowance_;
}

/// Accepts the step that was seen last.
void TurningBack::keep(const Heights& before, const Heights& after) {
    allowance_ -= after.squares - before.squares;
    around_.keep();
    for (std::size_t i = 0; i < around_.faces().size(); ++i) {
        const std::uint32_t face = around_.faces()[i];
        heights_[face] = around_.each()[i];
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            tried_vertices_[surface_.mesh.origin(3 * face + corner)] = false;
        }
    }
}

/// The least-squares step of the loaded vertex, where turned samples aim at the side that faces
/// their way.
glm::dvec3 TurningBack::way() const {
    VertexFit fit;
    const PointBlock& block = around_.cost().block();
    for (std::size_t i = 0; i < block.size(); ++i) {
        const auto nearest = static_cast<std::size_t>(block.nearest[i]);
        add_point(
            fit,
            block,
            i,
            around_.cost().triangles[nearest],
            static_cast<double>(block.weights[i]),
            false);
    }
    for (const SeenSample& sample : around_.samples()) {
        if (!sample.turned) {
            fit.add(sample.off, sample.normal, sample.share, sample.area);
            continue;
        }
        const double within = std::max(6.0 * glm::length(sample.off), 4.0 * std::sqrt(mean2_));
        if (const auto alike = nearest_alike(target_, sample.place, sample.normal, within)) {
            fit.add(*alike - sample.place, sample.normal, sample.share, turned_pull * sample.area);
        }
    }
    return fit.way();
}

/// Whether the loaded ring may have its vertex at `place`.
bool TurningBack::may_step_to(const glm::dvec3& place, std::uint32_t vertex) const {
    return std::ranges::all_of(around_.ring(), [&](const RingFace& face) {
        return may_become_here(
            face.face,
            moved_corners(surface_, face, surface_.places[vertex]),
            moved_corners(surface_, face, place));
    });
}

/// Moves a vertex if that is allowed and better. around_ must hold the vertex's ring, and `before`
/// its present statistics.
bool TurningBack::step_to(const glm::dvec3& place, std::uint32_t vertex, const Heights& before) {
    if (!may_step_to(place, vertex)) {
        return false;
    }
    around_.set_ring(place, colour(vertex));
    const Heights after = around_.seen(limits(before));
    if (!is_better(before, after)) {
        return false;
    }
    surface_.places[vertex] = place;
    keep(before, after);
    return true;
}

/// Tries steps of 2, 1 and 1/2 root mean squares along each axis.
bool TurningBack::step_along_axes(std::uint32_t vertex, const Heights& before) {
    const glm::dvec3 place = surface_.places[vertex];
    for (const double length : {2.0, 1.0, 0.5}) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {1.0, -1.0}) {
                glm::dvec3 there = place;
                there[axis] += sign * length * std::sqrt(mean2_);
                if (step_to(there, vertex, before)) {
                    return true;
                }
            }
        }
    }
    return false;
}

/// Tries to move one vertex so that there is less turned area at it.
void TurningBack::move(std::uint32_t vertex) {
    if (surface_.is_locked(vertex)) {
        return;
    }
    around_.take_ring(vertex);
    const glm::dvec3 place = surface_.places[vertex];
    around_.set_ring(place, colour(vertex));
    const Heights before = around_.seen({});
    points_before2_ = around_.points_most2();
    if (!(before.turned > 0.0)) {
        return;
    }
    const glm::dvec3 along = way();
    for (const double step : {1.0, 0.5, 0.25}) {
        if (step_to(place + step * along, vertex, before)) {
            return;
        }
    }
    tried_vertices_[vertex] = !step_along_axes(vertex, before);
}

void TurningBack::round() {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t face = 0; face < heights_.size(); ++face) {
        if (heights_[face].turned > 0.0) {
            const Triangle corners = surface_.mesh.corners(face);
            vertices.insert(vertices.end(), corners.begin(), corners.end());
        }
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t vertex : vertices) {
        if (!tried_vertices_[vertex] && around_.looks() < most_looks_) {
            move(vertex);
        }
    }
}

} // namespace

void turn_back(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const TurnOptions& options) {
    TurningBack turning(surface, points, target, options);
    for (int round = 0; round < options.rounds && !turning.is_exact(); ++round) {
        const double before = turning.turned();
        turning.round();
        if (!(turning.turned() < most_left * before)) {
            return;
        }
    }
}

} // namespace octant::models::simplify
