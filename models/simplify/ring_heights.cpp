// What a change of a few triangles does to the distance between two surfaces, measured locally. It
// is shared by peaks.cpp (largest distance) and turned_faces.cpp (faces that are folded over),
// which differ in what they call better.
#include "models/simplify/ring_heights.h"

#include "models/simplify/collapse_guard.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::models::simplify {

namespace {

/// The number of fields along a triangle's side so that there are as many samples as triangles of
/// the target for each one of the surface, within 4 and 8, and so many of all, up to 16.
int grid_fields(const WorkingSurface& surface, std::size_t target_faces, std::size_t of_all) {
    const auto faces = static_cast<double>(std::max<std::size_t>(surface.mesh.face_count(), 1));
    const int each = static_cast<int>(std::sqrt(static_cast<double>(target_faces) / faces));
    const int least = static_cast<int>(std::sqrt(2.0 * static_cast<double>(of_all) / faces));
    return std::clamp(std::clamp(each, 4, 8), std::min(least, 16), 16);
}

/// Bounds of the number of samples on a triangle when there is a spacing.
constexpr std::size_t least_samples = 12;
constexpr std::size_t most_ring_samples = 400;
/// Beside the samples by area there are this many for each spacing that fits into the longest edge,
/// so that long thin triangles get enough.
constexpr double along_edge = 2.0;

} // namespace

RingHeights::RingHeights(
    const WorkingSurface& surface,
    TrackedPoints& points,
    const PolishTarget& target,
    const SampleDensity& density)
    : surface_(surface)
    , points_(points)
    , target_(target)
    , in_turn_(target)
    , spacing_(density.spacing) {
    if (spacing_ > 0.0) {
        for (std::size_t i = 0; i < most_ring_samples; ++i) {
            samples_on_.push_back({spread_weights(i), 0.0});
        }
    } else {
        samples_on_ = sample_grid(grid_fields(surface, target.mesh.face_count(), density.of_all));
    }
}

/// How many samples a triangle gets.
std::size_t RingHeights::count_for(const std::array<glm::dvec3, 3>& corners) const {
    if (!(spacing_ > 0.0)) {
        return samples_on_.size();
    }
    const double longest = std::max(
        {glm::distance(corners[0], corners[1]),
         glm::distance(corners[1], corners[2]),
         glm::distance(corners[2], corners[0])});
    const double area = 0.5 * glm::length(area_vector(corners));
    const double wanted = area / (spacing_ * spacing_) + along_edge * longest / spacing_;
    return std::clamp(
        static_cast<std::size_t>(std::min(wanted, static_cast<double>(most_ring_samples))),
        least_samples,
        most_ring_samples);
}

void RingHeights::take_face(std::uint32_t face) {
    faces_.assign(1, face);
    cost_.gather(points_, faces_);
    set_faces();
}

void RingHeights::take_ring(std::uint32_t vertex) {
    surface_.mesh.ring_at(vertex, ring_, faces_);
    cost_.gather(points_, faces_);
}

void RingHeights::take_pair(HalfEdge h) {
    faces_.assign({face_of(h), face_of(surface_.mesh.twin(h))});
    cost_.gather(points_, faces_);
    set_faces();
}

void RingHeights::set_ring(const glm::dvec3& place, const glm::dvec3& colour) {
    cost_.set_triangles(surface_, ring_, place, colour);
    corners_.clear();
    for (const RingFace& face : ring_) {
        corners_.push_back(moved_corners(surface_, face, place));
    }
}

void RingHeights::set_faces() {
    cost_.triangles.clear();
    corners_.clear();
    for (const std::uint32_t face : faces_) {
        corners_.push_back(surface_.corner_places(face));
        cost_.triangles.push_back(flat(surface_, face));
    }
}

/// Measures the tracked points against the triangles that were set, and keeps the statistics of
/// each triangle in each_.
Heights RingHeights::points_heights() {
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

/// Measures the samples of triangle `i` as long as the limits allow.
void RingHeights::add_samples(std::size_t i, Heights& heights, const HeightLimits& limits) {
    const auto& corners = corners_[i];
    const glm::dvec3 area2 = area_vector(corners);
    const double size = glm::length(area2);
    SeenSample sample;
    sample.normal = size > 0.0 ? area2 / size : glm::dvec3(0.0);
    const std::size_t count = count_for(corners);
    for (const auto& [w, grid_share] : std::span(samples_on_).first(count)) {
        const double share = spacing_ > 0.0 ? 1.0 / static_cast<double>(count) : grid_share;
        sample.place = w.x * corners[0] + w.y * corners[1] + w.z * corners[2];
        const measure::NearestOnMesh nearest = in_turn_.nearest(sample.place);
        sample.off = nearest.point - sample.place;
        sample.share = w.x;
        sample.area = share * 0.5 * size;
        sample.turned = is_against(target_, sample.place, nearest, area2);
        samples_.push_back(sample);
        ++looks_;
        Heights one;
        one.add(nearest.distance2, sample.area);
        one.turned = sample.turned ? sample.area : 0.0;
        each_[i].add(one);
        heights.add(one);
        if (!limits.allow(heights)) {
            return;
        }
    }
}

Heights RingHeights::seen(const HeightLimits& limits) {
    Heights heights = points_heights();
    points_most2_ = heights.most2;
    samples_.clear();
    for (std::size_t i = 0; i < corners_.size() && limits.allow(heights); ++i) {
        add_samples(i, heights, limits);
    }
    return heights;
}

} // namespace octant::models::simplify
