#include "models/planar/incidences.h"

#include "models/planar/near_vertices.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::models::planar {

namespace {

/// The different places of a polygon's corners, without those that repeat the one before.
std::vector<std::uint32_t>
corner_places(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> places) {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t vertex : corners) {
        if (out.empty() || out.back() != places[vertex]) {
            out.push_back(places[vertex]);
        }
    }
    while (out.size() > 1 && out.back() == out.front()) {
        out.pop_back();
    }
    return out;
}

/// An outline with its plane, to ask what touches it.
class Outline {
public:
    Outline(std::span<const glm::dvec3> vertices, std::span<const std::uint32_t> corners)
        : vertices_(vertices)
        , corners_(corners) {
        for (const std::uint32_t corner : corners) {
            least_ = glm::min(least_, vertices[corner]);
            most_ = glm::max(most_, vertices[corner]);
        }
        glm::dvec3 sum(0.0);
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
            sum += glm::cross(at(i) - at(0), at(i + 1) - at(0));
        }
        const double area = glm::length(sum);
        has_plane_ = area > 0.0;
        normal_ = has_plane_ ? sum / area : sum;
    }

    const glm::dvec3& least() const { return least_; }

    const glm::dvec3& most() const { return most_; }

    bool touches(const glm::dvec3& point, double reach) const {
        if (!has_plane_ || std::abs(glm::dot(point - at(0), normal_)) > reach) {
            return false;
        }
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const glm::dvec3& from = at(i);
            const glm::dvec3 along = at((i + 1) % corners_.size()) - from;
            const glm::dvec3 inward = glm::cross(normal_, along);
            if (glm::dot(point - from, inward) < -reach * glm::length(along)) {
                return false;
            }
        }
        return true;
    }

private:
    const glm::dvec3& at(std::size_t corner) const { return vertices_[corners_[corner]]; }

    std::span<const glm::dvec3> vertices_;
    std::span<const std::uint32_t> corners_;
    glm::dvec3 least_{std::numeric_limits<double>::max()};
    glm::dvec3 most_{std::numeric_limits<double>::lowest()};
    glm::dvec3 normal_{0.0};
    bool has_plane_ = false;
};

} // namespace

std::vector<Incidence> incidences_of(
    const polygons::PolygonModel& model,
    std::span<const glm::dvec3> vertices,
    std::span<const std::uint32_t> places,
    std::span<const std::uint32_t> kind,
    double reach) {
    const NearVertices near(vertices);
    std::vector<bool> used(vertices.size());
    for (const std::uint32_t vertex : model.corner_vertices) {
        used[places[vertex]] = true;
    }
    std::vector<Incidence> out(model.polygons.size());
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].corners = corner_places(model.corners(i), places);
        if (out[i].corners.size() < 3) {
            continue;
        }
        const Outline outline(vertices, out[i].corners);
        found.clear();
        near.append_in_box(outline.least() - reach, outline.most() + reach, found);
        std::ranges::sort(found);
        for (const std::uint32_t vertex : found) {
            const bool other = places[vertex] == vertex && used[vertex] &&
                               kind[vertex] == kind[out[i].corners[0]] &&
                               std::ranges::find(out[i].corners, vertex) == out[i].corners.end();
            if (other && outline.touches(vertices[vertex], reach)) {
                out[i].touching.push_back(vertex);
            }
        }
    }
    return out;
}

} // namespace octant::models::planar
