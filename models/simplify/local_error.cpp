// The cost that orders all steps: Y. Kim, B. U. Lee, "Error measure for vertex simplification",
// 2005, section II.2, distance to triangles in both directions, but against the original surface
// instead of the mesh before: from samples of it, and back to it by a tree. The way back counts
// more where the original faces against the triangle, so that no triangle folds over.
#include "models/simplify/local_error.h"

#include "models/simplify/collapse_guard.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace octant::models::simplify {

namespace {

/// The points of a triangle whose mean is exact for quadratic functions.
constexpr std::array<glm::dvec3, 3> back_weights = {
    glm::dvec3(2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0),
    glm::dvec3(1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0),
    glm::dvec3(1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0)};

glm::dvec3 mixed(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& weights) {
    return weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
}

} // namespace

void LocalError::gather(std::span<const std::uint32_t> faces) {
    block_.clear();
    present_there_ = 0.0;
    present_back_ = 0.0;
    for (const std::uint32_t face : faces) {
        samples_.gather(face, block_);
        present_there_ += samples_.error(face) - samples_.back_error(face);
        present_back_ += samples_.back_error(face);
    }
    area_ = 0.0;
    for (std::size_t i = 0; i < block_.size(); ++i) {
        area_ += static_cast<double>(block_.weights[i]);
    }
}

void LocalError::set_ring(
    std::span<const RingFace> ring, const glm::dvec3& place, const glm::dvec3& colour) {
    triangles_.clear();
    near_.clear();
    for (const RingFace& face : ring) {
        ColouredTriangle made{moved_corners(surface_, face, place), {}};
        if (surface_.coloured()) {
            made.colours = {
                colour,
                surface_.colours[surface_.mesh.target(face.half_edge)],
                surface_.colours[surface_.mesh.origin(previous_of(face.half_edge))]};
        }
        triangles_.push_back(made);
        const std::uint32_t turn = face.half_edge % 3;
        const Feet& feet = samples_.feet(face.face);
        near_.push_back({feet[turn], feet[(turn + 1) % 3], feet[(turn + 2) % 3]});
    }
    flatten();
}

void LocalError::move_corner(const glm::dvec3& place, const glm::dvec3& colour) {
    for (ColouredTriangle& triangle : triangles_) {
        triangle.places[0] = place;
        triangle.colours[0] = colour;
    }
    flatten();
}

void LocalError::set_triangles(
    std::span<const ColouredTriangle> triangles, std::span<const std::uint32_t> near) {
    triangles_.assign(triangles.begin(), triangles.end());
    near_.clear();
    for (const std::uint32_t face : near) {
        near_.push_back(samples_.feet(face));
    }
    flatten();
}

void LocalError::flatten() {
    flat_.clear();
    for (const ColouredTriangle& triangle : triangles_) {
        flat_.push_back(
            surface_.coloured() ? flat(triangle.places, triangle.colours)
                                : flat(triangle.places));
    }
}

double LocalError::measured_there() {
    if (block_.size() == 0) {
        return 0.0;
    }
    find_nearest(block_, flat_, samples_.coloured());
    const Penalty& penalty = samples_.penalty();
    double sum = 0.0;
    for (std::size_t i = 0; i < block_.size(); ++i) {
        sum += static_cast<double>(block_.weights[i]) *
               penalty.of(static_cast<double>(block_.distances2[i]));
    }
    if (samples_.coloured()) {
        for (std::size_t i = 0; i < block_.size(); ++i) {
            sum += static_cast<double>(block_.weights[i]) *
                   static_cast<double>(block_.colour_errors2[i]);
        }
    }
    return sum;
}

double LocalError::measured_back(double limit) {
    const Penalty& penalty = samples_.penalty();
    back_errors_.assign(triangles_.size(), 0.0);
    feet_.resize(triangles_.size());
    max_back2_ = 0.0;
    double sum = 0.0;
    for (std::size_t t = 0; t < triangles_.size() && sum <= limit; ++t) {
        const std::array<glm::dvec3, 3>& corners = triangles_[t].places;
        const glm::dvec3 normal = area_vector(corners);
        const double area = 0.5 * glm::length(normal);
        const Feet& near = near_[t];
        for (std::size_t i = 0; i < back_weights.size(); ++i) {
            const glm::dvec3 place = mixed(corners, back_weights[i]);
            double distance2 = 0.0;
            feet_[t][i] = original_.nearest_from(near[i].triangle, place, distance2);
            if (glm::dot(original_.normal(feet_[t][i].triangle), normal) < 0.0) {
                distance2 += area;
            }
            max_back2_ = std::max(max_back2_, distance2);
            back_errors_[t] += area / 3.0 * penalty.of(distance2);
        }
        sum += back_errors_[t];
    }
    return sum;
}

/// Triangles of the original from which to look for the feet of a present triangle: those of the
/// nearest samples in the lists around it that face its way.
Feet LocalError::starts_near(std::uint32_t face) {
    const CollapsibleMesh& mesh = surface_.mesh;
    const std::array<glm::dvec3, 3> corners = surface_.corner_places(face);
    const glm::dvec3 normal = area_vector(corners);
    Feet starts;
    starts.fill({{}, 0});
    std::array<double, back_weights.size()> least2;
    least2.fill(std::numeric_limits<double>::infinity());
    constexpr double against = 100.0; // A factor of the squared distance.
    std::vector<std::uint32_t> looked(1, face);
    for (std::size_t i = 0; i < looked.size(); ++i) {
        samples_.for_each(looked[i], [&](std::uint32_t number) {
            const SurfaceSample& sample = samples_[number];
            const bool faces_it = glm::dot(original_.normal(sample.triangle), normal) > 0.0;
            for (std::size_t k = 0; k < back_weights.size(); ++k) {
                const glm::dvec3 off = widen(sample.place) - mixed(corners, back_weights[k]);
                const double away2 = glm::dot(off, off) * (faces_it ? 1.0 : against);
                if (away2 < least2[k]) {
                    least2[k] = away2;
                    starts[k].triangle = sample.triangle;
                }
            }
        });
        const bool is_found = std::isfinite(least2[0]);
        for (const std::uint32_t corner : mesh.corners(looked[i])) {
            mesh.around(corner, [&](HalfEdge h) {
                if ((i == 0 || !is_found) &&
                    std::ranges::find(looked, face_of(h)) == looked.end()) {
                    looked.push_back(face_of(h));
                }
            });
        }
    }
    return starts;
}

double LocalError::measure_all_back() {
    const CollapsibleMesh& mesh = surface_.mesh;
    double most2 = 0.0;
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        if (mesh.face_is_there(face)) {
            const ColouredTriangle here{surface_.corner_places(face), {}};
            triangles_.assign(1, here);
            near_.assign(1, samples_.feet(face));
            if (near_[0][0].triangle == none) {
                near_[0] = starts_near(face);
            }
            measured_back();
            samples_.set_back(face, back_errors_[0], feet_[0]);
            most2 = std::max(most2, max_back2_);
        }
    }
    return most2;
}

double LocalError::measured(double limit) {
    const double there = measured_there();
    return there > limit ? there : there + measured_back(limit - there);
}

double LocalError::max_there2() const {
    float most = 0.0F;
    for (std::size_t i = 0; i < block_.size(); ++i) {
        most = std::max(most, block_.distances2[i]);
    }
    return static_cast<double>(most);
}

double LocalError::work() const {
    constexpr double work_of_foot = 40.0; // In distances to triangles.
    const auto triangles = static_cast<double>(triangles_.size());
    return triangles * (static_cast<double>(block_.size()) + 3.0 * work_of_foot);
}

VertexFit LocalError::fit(bool with_back) const {
    VertexFit fit;
    const Penalty& penalty = samples_.penalty();
    for (std::size_t i = 0; i < block_.size(); ++i) {
        const double weight = static_cast<double>(block_.weights[i]) *
                              penalty.weight(static_cast<double>(block_.distances2[i]));
        add_sample(
            fit,
            block_,
            i,
            flat_[static_cast<std::size_t>(block_.nearest[i])],
            weight,
            samples_.coloured());
    }
    for (std::size_t t = 0; with_back && t < triangles_.size(); ++t) {
        const std::array<glm::dvec3, 3>& corners = triangles_[t].places;
        const glm::dvec3 normal = area_vector(corners);
        const double length = glm::length(normal);
        const Feet& feet = near_[t];
        for (std::size_t i = 0; i < back_weights.size() && length > 0.0; ++i) {
            const glm::dvec3 off = widen(feet[i].place) - mixed(corners, back_weights[i]);
            const double weight = length / 6.0 * penalty.weight(glm::dot(off, off));
            fit.add(off, normal / length, back_weights[i].x, weight);
        }
    }
    return fit;
}

void LocalError::keep(
    std::span<const std::uint32_t> emptied, std::span<const std::uint32_t> faces) {
    samples_.assign(block_, emptied, faces);
    for (std::size_t t = 0; t < faces.size(); ++t) {
        // Feet are kept by the corners of the triangle as the mesh numbers them.
        std::size_t turn = 0;
        while (turn < 2 && surface_.corner_places(faces[t])[turn] != triangles_[t].places[0]) {
            ++turn;
        }
        Feet feet;
        for (std::size_t i = 0; i < feet.size(); ++i) {
            feet[(turn + i) % 3] = feet_[t][i];
        }
        samples_.set_back(faces[t], back_errors_[t], feet);
    }
}

} // namespace octant::models::simplify
