// The half of the polish that looks from the simplified surface to the original (polish.cpp has the
// other half): iterated closest points with the distance to the tangent plane, where a sample must
// not be drawn to the wrong side of a thin part.
#include "models/simplify/aims.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace octant::models::simplify {

namespace {

/// How far a turned sample looks for a point that faces its way, in multiples of its own distance
/// and of the usual distance.
constexpr double turned_reach = 4.0;

/// The position of a sample on a triangle.
glm::dvec3 place_of(const std::array<glm::dvec3, 3>& corners, const TriangleSample& sample) {
    return sample.weights.x * corners[0] + sample.weights.y * corners[1] +
           sample.weights.z * corners[2];
}

} // namespace

void SampleAims::take(const WorkingSurface& surface, const PolishTarget& target, int threads) {
    const CollapsibleMesh& mesh = surface.mesh;
    aims_.resize(mesh.face_slots() * samples_.size());
    for_face_ranges(mesh, threads, [&](std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t face = first; face < end; ++face) {
            if (!mesh.face_is_there(face)) {
                continue;
            }
            const std::array<glm::dvec3, 3> corners = surface.corner_places(face);
            const glm::dvec3 area2 = area_vector(corners);
            NearestInTurn in_turn(target);
            for (std::size_t i = 0; i < samples_.size(); ++i) {
                const glm::dvec3 place = place_of(corners, samples_[i]);
                const measure::NearestOnMesh nearest = in_turn.nearest(place);
                Aim& aim = aims_[face * samples_.size() + i];
                aim = {nearest.point, 1.0};
                if (!is_against(target, place, nearest, area2)) {
                    continue;
                }
                const double within =
                    turned_reach * std::max(std::sqrt(nearest.distance2), usual_off_);
                if (const auto alike = nearest_alike(target, place, area2, within)) {
                    aim = {*alike, turned_pull};
                }
            }
        }
    });
    usual_off_ = std::sqrt(mean_square(surface));
}

/// The mean over the area of the squared distances from samples to aims.
double SampleAims::mean_square(const WorkingSurface& surface) const {
    double squares = 0.0;
    double area = 0.0;
    for (std::uint32_t face = 0; face < surface.mesh.face_slots(); ++face) {
        if (!surface.mesh.face_is_there(face)) {
            continue;
        }
        const std::array<glm::dvec3, 3> corners = surface.corner_places(face);
        const double size = glm::length(area_vector(corners));
        area += size;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const glm::dvec3 off =
                aims_[face * samples_.size() + i].place - place_of(corners, samples_[i]);
            squares += size * samples_[i].share * glm::dot(off, off);
        }
    }
    return area > 0.0 ? squares / area : 0.0;
}

double SampleAims::cost(std::uint32_t face, const std::array<glm::dvec3, 3>& corners) const {
    const glm::dvec3 area2 = area_vector(corners);
    const double size = glm::length(area2);
    if (!(size > 0.0)) {
        return 0.0;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Aim& aim = aims_[face * samples_.size() + i];
        const glm::dvec3 off = aim.place - place_of(corners, samples_[i]);
        const double across = glm::dot(off, area2) / size;
        sum += samples_[i].share * aim.pull * (across * across + sideways * glm::dot(off, off));
    }
    return 0.5 * size * sum;
}

double SampleAims::most2(std::uint32_t face, const std::array<glm::dvec3, 3>& corners) const {
    double most2 = 0.0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const glm::dvec3 off =
            aims_[face * samples_.size() + i].place - place_of(corners, samples_[i]);
        most2 = std::max(most2, glm::dot(off, off));
    }
    return most2;
}

void SampleAims::add_to(
    VertexFit& fit,
    std::uint32_t face,
    const std::array<glm::dvec3, 3>& corners,
    std::size_t corner) const {
    const glm::dvec3 area2 = area_vector(corners);
    const double size = glm::length(area2);
    if (!(size > 0.0)) {
        return;
    }
    const glm::dvec3 normal = area2 / size;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Aim& aim = aims_[face * samples_.size() + i];
        fit.add(
            aim.place - place_of(corners, samples_[i]),
            normal,
            samples_[i].weights[static_cast<int>(corner)],
            0.5 * size * samples_[i].share * aim.pull);
    }
}

double
SampleAims::true_cost(const PolishTarget& target, const std::array<glm::dvec3, 3>& corners) const {
    double sum = 0.0;
    for (const TriangleSample& sample : samples_) {
        sum += sample.share * target.bvh.nearest(place_of(corners, sample)).distance2;
    }
    return 0.5 * glm::length(area_vector(corners)) * sum;
}

} // namespace octant::models::simplify
