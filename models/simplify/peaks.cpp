// Lowers the largest distance between two surfaces: least squares, vertex after vertex, where the
// weight of a distance grows with its sixth power, so that the sum is close to a maximum. Only
// what touches the largest distances is moved or flipped.
#include "models/simplify/peaks.h"

#include "models/simplify/collapse_guard.h"
#include "models/simplify/peak_heights.h"
#include "models/simplify/surface_cost.h"
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

/// Triangles whose largest distance is above that part of the largest of all are worked on.
constexpr double hot_share = 0.85;
/// A round that lowers the largest distance by less than that part is the last one.
constexpr double least_gain = 0.003;

/// A distance of more than so many times the root of the mean square stands alone, as where sharp
/// edges meet: a step that lowers it by more than the second part is let turn triangles further,
/// make slivers, and add to the squares.
constexpr double tall = 12.0;
constexpr double tall_gain = 0.1;
/// Of the root of the mean square, that such steps may cost together beside the others.
constexpr double tall_growth = 0.05;

constexpr double everything = std::numeric_limits<double>::infinity();

/// As many samples as triangles of the target come on one of the surface, within bounds.
int grid_fields(std::size_t target_faces, std::size_t faces) {
    const double ratio =
        static_cast<double>(target_faces) / static_cast<double>(std::max<std::size_t>(faces, 1));
    return std::clamp(static_cast<int>(std::sqrt(ratio)), 4, 8);
}

class PeakLowering {
public:
    PeakLowering(
        WorkingSurface& surface,
        TrackedPoints& points,
        const PolishTarget& target,
        double most_growth)
        : surface_(surface)
        , points_(points)
        , target_(target)
        , grid_(
              sample_grid(grid_fields(target.surface.mesh.face_count(), surface.mesh.face_count())))
        , heights_(surface.mesh.face_slots()) {
        double squares = 0.0;
        double area = 0.0;
        for (std::uint32_t face = 0; face < heights_.size(); ++face) {
            if (surface.mesh.face_is_there(face)) {
                measure(face);
                area += 0.5 * glm::length(area_vector(surface.corner_places(face)));
            }
            squares += heights_[face].squares;
        }
        const auto allowance = [&](double growth) { return (2.0 + growth) * growth * squares; };
        allowance_ = allowance(most_growth);
        tall_allowance_ = allowance(tall_growth) - allowance_;
        // Both ways are in the sum, each over the area.
        tall2_ = area > 0.0 ? tall * tall * squares / (2.0 * area) : everything;
    }

    double most2() const { return std::ranges::max(heights_, {}, &Heights::most2).most2; }

    void round();

private:
    void measure(std::uint32_t face);
    Heights points_heights();
    Heights samples_heights(double most2);
    Heights seen(double most2);
    void take_ring(std::uint32_t vertex);
    void set_ring(const glm::dvec3& place, const glm::dvec3& colour);
    VertexFit fitted() const;
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
    TrackedPoints& points_;
    PolishTarget target_;
    std::vector<GridSample> grid_;
    std::vector<Heights> heights_; ///< of each triangle
    double allowance_ = 0.0;       ///< by which the sum of squares may still grow
    double tall2_ = everything;    ///< squares of distances beyond that stand alone
    double tall_allowance_ = 0.0;  ///< the same beyond that, for peaks that stand alone
    SurfaceCost cost_;
    std::vector<RingFace> ring_;
    std::vector<std::uint32_t> faces_; ///< whose points are in cost_
    std::vector<Corners> corners_;     ///< of the triangles in cost_
    std::vector<Heights> each_;        ///< around each of these triangles
    std::vector<glm::dvec3> aims_;     ///< from their samples to the target
};

/// Distances of the points in cost_ to its triangles; keeps them by triangle in each_.
Heights PeakLowering::points_heights() {
    Heights heights;
    each_.assign(corners_.size(), {});
    cost_.total();
    const PointBlock& block = cost_.block();
    for (std::size_t i = 0; i < block.size(); ++i) {
        each_[static_cast<std::size_t>(block.nearest[i])].add(
            static_cast<double>(block.distances2[i]), static_cast<double>(block.weights[i]));
    }
    for (const Heights& one : each_) {
        heights.add(one);
    }
    return heights;
}

/// Distances of samples of corners_ to the target, added to each_; what they aim at goes to aims_.
/// Not all of them where one is above `most2`.
Heights PeakLowering::samples_heights(double most2) {
    Heights heights;
    aims_.clear();
    for (std::size_t i = 0; i < corners_.size() && heights.most2 <= most2; ++i) {
        const Corners& corners = corners_[i];
        const double area = 0.5 * glm::length(area_vector(corners));
        Heights one;
        for (const auto& [w, share] : grid_) {
            const glm::dvec3 place = w.x * corners[0] + w.y * corners[1] + w.z * corners[2];
            const measure::NearestOnMesh nearest = target_.bvh.nearest(place);
            one.add(nearest.distance2, share * area);
            aims_.push_back(nearest.point - place);
        }
        each_[i].add(one);
        heights.add(one);
    }
    return heights;
}

/// Both ways around what cost_ and corners_ hold; not all of it where that is above `most2`.
Heights PeakLowering::seen(double most2) {
    Heights heights = points_heights();
    if (heights.most2 <= most2) {
        heights.add(samples_heights(most2));
    }
    return heights;
}

void PeakLowering::measure(std::uint32_t face) {
    faces_.assign(1, face);
    corners_.assign(1, surface_.corner_places(face));
    cost_.gather(points_, faces_);
    cost_.triangles.assign(1, flat(corners_[0]));
    heights_[face] = seen(everything);
}

void PeakLowering::take_ring(std::uint32_t vertex) {
    ring_.clear();
    faces_.clear();
    surface_.mesh.around(vertex, [this](HalfEdge h) {
        ring_.push_back({face_of(h), h});
        faces_.push_back(face_of(h));
    });
    cost_.gather(points_, faces_);
}

void PeakLowering::set_ring(const glm::dvec3& place, const glm::dvec3& colour) {
    cost_.set_triangles(surface_, ring_, place, colour);
    corners_.clear();
    for (const RingFace& face : ring_) {
        corners_.push_back(moved_corners(surface_, face, place));
    }
}

/// The way that lessens the sum of powers: each weight times distance to the sixth.
VertexFit PeakLowering::fitted() const {
    VertexFit fit;
    const PointBlock& block = cost_.block();
    const auto cubed = [](double distance2) { return distance2 * distance2 * distance2; };
    for (std::size_t i = 0; i < block.size(); ++i) {
        const double weight =
            static_cast<double>(block.weights[i]) * cubed(static_cast<double>(block.distances2[i]));
        add_point(
            fit,
            block,
            i,
            cost_.triangles[static_cast<std::size_t>(block.nearest[i])],
            weight,
            false);
    }
    std::size_t sample = 0;
    for (const Corners& corners : corners_) {
        const glm::dvec3 area2 = area_vector(corners);
        const double size = glm::length(area2);
        for (const auto& [w, share] : grid_) {
            const glm::dvec3& off = aims_[sample++];
            if (w.x > 0.0 && size > 0.0) {
                fit.add(off, area2 / size, w.x, 0.5 * size * share * cubed(glm::dot(off, off)));
            }
        }
    }
    return fit;
}

bool PeakLowering::is_better(
    const Heights& before, const Heights& after, Strictness strictness) const {
    if (!(after.powers < before.powers) || after.most2 > before.most2) {
        return false;
    }
    const double growth = after.squares - before.squares;
    const bool is_tall =
        before.most2 > tall2_ && after.most2 < (1.0 - tall_gain) * (1.0 - tall_gain) * before.most2;
    return is_tall ? growth <= allowance_ + tall_allowance_
                   : growth <= allowance_ && strictness == Strictness::Normal;
}

/// Takes over the points' lists after a change of faces_.
void PeakLowering::keep(const Heights& before, const Heights& after) {
    allowance_ -= after.squares - before.squares;
    if (allowance_ < 0.0) {
        tall_allowance_ += allowance_;
        allowance_ = 0.0;
    }
    points_.assign(cost_.block(), faces_, faces_);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        heights_[faces_[i]] = each_[i];
    }
}

/// Expects the ring and its heights of now.
bool PeakLowering::step_to(
    const glm::dvec3& place, std::uint32_t vertex, const Heights& before, Strictness strictness) {
    if (!may_move(surface_, ring_, place, strictness)) {
        return false;
    }
    set_ring(place, surface_.coloured() ? surface_.colours[vertex] : glm::dvec3(0.0));
    const Heights after = seen(before.most2);
    if (!is_better(before, after, strictness)) {
        return false;
    }
    surface_.places[vertex] = place;
    keep(before, after);
    return true;
}

void PeakLowering::lower_at(std::uint32_t vertex) {
    take_ring(vertex);
    const glm::dvec3 place = surface_.places[vertex];
    const glm::dvec3 colour = surface_.coloured() ? surface_.colours[vertex] : glm::dvec3(0.0);
    set_ring(place, colour);
    const Heights before = seen(everything);
    const glm::dvec3 way = fitted().way();
    for (const Strictness strictness : {Strictness::Normal, Strictness::Loose}) {
        if (strictness == Strictness::Loose && !(before.most2 > tall2_)) {
            return;
        }
        for (const double step : {1.0, 0.5, 0.2, 0.1}) {
            if (step_to(place + step * way, vertex, before, strictness)) {
                return;
            }
        }
    }
}

void PeakLowering::try_flip(HalfEdge h) {
    CollapsibleMesh& mesh = surface_.mesh;
    if (surface_.is_material_border(h) || !mesh.may_flip(h)) {
        return;
    }
    const std::array<std::uint32_t, 2> pair = {face_of(h), face_of(mesh.twin(h))};
    faces_.assign(pair.begin(), pair.end());
    const auto set = [&] {
        cost_.triangles.clear();
        corners_.clear();
        for (const std::uint32_t face : pair) {
            corners_.push_back(surface_.corner_places(face));
            const Triangle v = mesh.corners(face);
            const auto& c = surface_.colours;
            cost_.triangles.push_back(
                c.empty() ? flat(corners_.back())
                          : flat(corners_.back(), {c[v[0]], c[v[1]], c[v[2]]}));
        }
    };
    cost_.gather(points_, faces_);
    set();
    const std::vector<Corners> old = corners_;
    const Heights before = seen(everything);
    mesh.flip(h);
    set();
    if (may_flip_to({old[0], old[1]}, {corners_[0], corners_[1]})) {
        const Heights after = seen(before.most2);
        if (is_better(before, after, Strictness::Normal)) {
            keep(before, after);
            return;
        }
    }
    for (int turn = 0; turn < 3; ++turn) { // back to the same edge
        mesh.flip(h);
    }
}

void PeakLowering::round() {
    const double hot2 = hot_share * hot_share * most2();
    const CollapsibleMesh& mesh = surface_.mesh;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t face = 0; face < heights_.size(); ++face) {
        if (heights_[face].most2 > hot2) {
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                try_flip(3 * face + corner);
            }
            const Triangle corners = mesh.corners(face);
            vertices.insert(vertices.end(), corners.begin(), corners.end());
        }
    }
    std::ranges::sort(vertices);
    const auto repeated = std::ranges::unique(vertices);
    vertices.erase(repeated.begin(), repeated.end());
    for (const std::uint32_t vertex : vertices) {
        lower_at(vertex);
    }
}

} // namespace

void lower_peaks(
    WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const PeakOptions& options) {
    PeakLowering lowering(surface, points, target, options.most_growth);
    for (int round = 0; round < options.rounds; ++round) {
        const double before2 = lowering.most2();
        lowering.round();
        const double least2 = (1.0 - least_gain) * (1.0 - least_gain) * before2;
        if (!(lowering.most2() < least2)) {
            return;
        }
    }
}

} // namespace octant::models::simplify
