// The points by which the error against the original surface is kept up to date. Every original
// vertex and at least one point on each original triangle, weighted by area, approximate the
// integral of the squared distance over the original. Lists of points at triangles make a collapse
// cost what its neighbourhood holds, however large the mesh.
#include "models/simplify/tracked_points.h"

#include "models/simplify/triangle_samples.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>

namespace octant::models::simplify {

namespace {

/// The share of a triangle's area that its three corners stand for. Together with one point in the
/// middle, the sum is then exact for squares of linear functions.
constexpr double corner_share = 0.25;

} // namespace

TrackedPoints::TrackedPoints(const TargetMesh& original, std::size_t wanted) {
    std::vector<double> areas(original.face_count(), 0.0);
    std::vector<double> vertex_areas(original.places.size(), 0.0);
    std::vector<std::uint32_t> faces_at(original.places.size(), none);
    double total = 0.0;
    for (std::uint32_t face = 0; face < original.face_count(); ++face) {
        areas[face] = 0.5 * glm::length(area_vector(original.corner_places(face)));
        total += areas[face];
        for (const std::uint32_t vertex : original.triangles[face]) {
            vertex_areas[vertex] += areas[face] / 3.0;
            faces_at[vertex] = std::min(face, faces_at[vertex]);
        }
    }
    make_face_room(original.face_count());
    const std::size_t vertices = original.places.size();
    if (wanted <= vertices) {
        add_vertices(original, vertex_areas, faces_at, vertices / std::max<std::size_t>(wanted, 1));
        return;
    }
    const std::size_t least = vertices + original.face_count();
    make_room(std::max(wanted, least));
    for (double& area : vertex_areas) {
        area *= corner_share;
    }
    add_vertices(original, vertex_areas, faces_at, 1);
    const double more = wanted > least ? static_cast<double>(wanted - least) : 0.0;
    for (std::uint32_t face = 0; face < original.face_count(); ++face) {
        const double share = total > 0.0 ? areas[face] / total : 0.0;
        add_on(original, face, 1 + static_cast<std::size_t>(share * more), areas[face]);
    }
}

/// Adds every stride-th vertex, which stands for those before it too: neighbours mostly follow each
/// other.
void TrackedPoints::add_vertices(
    const TargetMesh& original,
    const std::vector<double>& areas,
    const std::vector<std::uint32_t>& faces,
    std::size_t stride) {
    double area = 0.0;
    for (std::uint32_t vertex = 0; vertex < areas.size(); ++vertex) {
        assert(faces[vertex] != none);
        area += areas[vertex];
        if ((vertex + 1) % stride == 0 || vertex + 1 == areas.size()) {
            add(original.places[vertex],
                original.coloured() ? &original.colours[vertex] : nullptr,
                area,
                faces[vertex]);
            area = 0.0;
        }
    }
}

/// Adds points on a triangle.
void TrackedPoints::add_on(
    const TargetMesh& original, std::uint32_t face, std::size_t count, double area) {
    const std::array<glm::dvec3, 3> corners = original.corner_places(face);
    const Triangle& vertices = original.triangles[face];
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 w = count == 1 ? glm::dvec3(1.0 / 3.0) : spread_weights(i);
        glm::dvec3 colour(0.0);
        if (original.coloured()) {
            colour = w.x * original.colours[vertices[0]] + w.y * original.colours[vertices[1]] +
                     w.z * original.colours[vertices[2]];
        }
        add(w.x * corners[0] + w.y * corners[1] + w.z * corners[2],
            original.coloured() ? &colour : nullptr,
            (1.0 - corner_share) * area / static_cast<double>(count),
            face);
    }
}

void TrackedPoints::make_room(std::size_t points) {
    places_.reserve(points);
    weights_.reserve(points);
    distances2_.reserve(points);
    faces_.reserve(points);
    next_.reserve(points);
}

void TrackedPoints::add(
    const glm::dvec3& place, const glm::dvec3* colour, double weight, std::uint32_t face) {
    const auto point = static_cast<std::uint32_t>(places_.size());
    places_.push_back(measure::narrow(place));
    if (colour != nullptr) {
        colours_.push_back(measure::narrow(*colour));
    }
    weights_.push_back(static_cast<float>(weight));
    distances2_.push_back(0.0F);
    faces_.push_back(face);
    next_.push_back(first_[face]);
    first_[face] = point;
    ++counts_[face];
}

void TrackedPoints::gather(std::uint32_t face, PointBlock& points) const {
    points.make_room(points.size() + counts_[face]);
    for (std::uint32_t point = first_[face]; point != none; point = next_[point]) {
        if (!colours_.empty()) {
            const std::array<float, 3>& colour = colours_[point];
            points.red[points.size()] = colour[0];
            points.green[points.size()] = colour[1];
            points.blue[points.size()] = colour[2];
        }
        points.add(point, places_[point], weights_[point]);
    }
}

float TrackedPoints::assign(
    const PointBlock& points,
    std::span<const std::uint32_t> emptied,
    std::span<const std::uint32_t> faces) {
    for (const std::uint32_t face : emptied) {
        first_[face] = none;
        counts_[face] = 0;
        costs_[face] = 0.0;
    }
    float most = 0.0F;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t point = points.numbers[i];
        const std::uint32_t face = faces[static_cast<std::size_t>(points.nearest[i])];
        next_[point] = first_[face];
        first_[face] = point;
        faces_[point] = face;
        distances2_[point] = points.distances2[i];
        ++counts_[face];
        const double colour_error2 =
            coloured() ? static_cast<double>(points.colour_errors2[i]) : 0.0;
        costs_[face] += static_cast<double>(points.weights[i]) *
                        (static_cast<double>(points.distances2[i]) + colour_error2);
        most = std::max(most, points.distances2[i]);
    }
    return most;
}

void TrackedPoints::make_face_room(std::size_t count) {
    first_.resize(std::max(count, first_.size()), none);
    counts_.resize(first_.size(), 0);
    costs_.resize(first_.size(), 0.0);
}

void TrackedPoints::assign_all(std::span<const std::uint32_t> faces, std::size_t face_slots) {
    // Fresh ones: there may have been far more triangles.
    first_ = std::vector<std::uint32_t>(face_slots, none);
    counts_ = std::vector<std::uint32_t>(face_slots, 0);
    costs_ = std::vector<double>(face_slots, 0.0);
    for (std::uint32_t point = 0; point < size(); ++point) {
        const std::uint32_t face = faces[point];
        faces_[point] = face;
        next_[point] = first_[face];
        first_[face] = point;
        ++counts_[face];
    }
}

double cost_sum(const PointBlock& points, std::size_t first, std::size_t end, bool coloured) {
    double sum = 0.0;
    for (std::size_t i = first; i < end; ++i) {
        sum += static_cast<double>(points.weights[i]) * static_cast<double>(points.distances2[i]);
    }
    if (coloured) {
        for (std::size_t i = first; i < end; ++i) {
            sum += static_cast<double>(points.weights[i]) *
                   static_cast<double>(points.colour_errors2[i]);
        }
    }
    return sum;
}

} // namespace octant::models::simplify
