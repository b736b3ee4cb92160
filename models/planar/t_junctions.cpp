#include "models/planar/t_junctions.h"

#include "models/planar/planar_model.h"
#include "models/planar/vertex_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace octant::models::planar {

namespace {

using polygons::PolygonModel;

/// A corner within the reach of a side and the side itself may both have been moved since, when their polygons were
/// made planar.
constexpr double in_reaches = 2.0;

/// The corners of one turning part, or of all that stands still.
struct PartCorners {
    std::vector<std::uint32_t> vertices; ///< each once
    std::vector<glm::dvec3> places_m;
};

std::vector<PartCorners> corners_of_parts(const PolygonModel& model) {
    std::vector<PartCorners> parts(model.pivots.size() + 1);
    std::vector<std::size_t> last_part(model.vertices_m.size(), parts.size());
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto pivot = polygons::pivot_of(model, i);
        const std::size_t part = pivot ? *pivot + 1 : 0;
        for (const std::uint32_t vertex : model.corners(i)) {
            if (std::exchange(last_part[vertex], part) != part) {
                parts[part].vertices.push_back(vertex);
                parts[part].places_m.push_back(model.vertices_m[vertex]);
            }
        }
    }
    return parts;
}

/// Half the diagonal of the box around all corners.
double radius_m_of(const PolygonModel& model) {
    glm::dvec3 min_m(std::numeric_limits<double>::max());
    glm::dvec3 max_m(std::numeric_limits<double>::lowest());
    for (const std::uint32_t vertex : model.corner_vertices) {
        min_m = glm::min(min_m, model.vertices_m[vertex]);
        max_m = glm::max(max_m, model.vertices_m[vertex]);
    }
    return model.corner_vertices.empty() ? 0.0 : glm::distance(min_m, max_m) / 2.0;
}

/// Finds what lies on sides, side after side.
class Search {
public:
    explicit Search(const PolygonModel& model)
        : model_(model), reach_m_(in_reaches * touching_reach * radius_m_of(model)), parts_(corners_of_parts(model)) {
        for (const PartCorners& part : parts_) { near_.emplace_back(part.places_m); }
    }

    std::vector<TJunction> all() {
        for (std::size_t i = 0; i < model_.polygons.size(); ++i) {
            const auto pivot = polygons::pivot_of(model_, i);
            const polygons::Polygon& polygon = model_.polygons[i];
            for (std::uint32_t k = 0; k < polygon.corner_count; ++k) {
                const std::uint32_t next = k + 1 < polygon.corner_count ? k + 1 : 0;
                add_on_side(
                    pivot ? *pivot + 1 : 0, model_.corners(i), polygon.first_corner + k, polygon.first_corner + next);
            }
        }
        return std::move(found_);
    }

private:
    const glm::dvec3& place_m(std::uint32_t vertex) const { return model_.vertices_m[vertex]; }

    /// Whether a place is as good as that of one of a polygon's own corners.
    bool is_own(std::span<const std::uint32_t> corners, const glm::dvec3& at_m) const {
        return std::ranges::any_of(
            corners, [&](std::uint32_t vertex) { return glm::distance(place_m(vertex), at_m) <= reach_m_; });
    }

    void add_on_side(std::size_t part, std::span<const std::uint32_t> own, std::size_t from, std::size_t to) {
        const glm::dvec3& from_m = place_m(model_.corner_vertices[from]);
        const glm::dvec3& to_m = place_m(model_.corner_vertices[to]);
        const glm::dvec3 along_m = to_m - from_m;
        const double length2 = glm::dot(along_m, along_m);
        if (length2 == 0.0) { return; }
        boxed_.clear();
        near_[part].append_near_segment(from_m, to_m, reach_m_, boxed_);
        const std::size_t first = found_.size();
        for (const std::uint32_t number : boxed_) {
            const std::uint32_t vertex = parts_[part].vertices[number];
            const glm::dvec3& at_m = place_m(vertex);
            const double share = glm::dot(at_m - from_m, along_m) / length2;
            if (share > 0.0 && share < 1.0 && glm::distance(at_m, from_m + along_m * share) <= reach_m_ &&
                !is_own(own, at_m)) {
                found_.push_back({from, vertex, share});
            }
        }
        const auto begin = found_.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(begin, found_.end(), [](const TJunction& a, const TJunction& b) {
            return std::pair(a.share, a.vertex) < std::pair(b.share, b.vertex);
        });
        const auto in_one_place = [&](const TJunction& a, const TJunction& b) {
            return place_m(a.vertex) == place_m(b.vertex);
        };
        found_.erase(std::unique(begin, found_.end(), in_one_place), found_.end());
    }

    const PolygonModel& model_;
    double reach_m_;
    std::vector<PartCorners> parts_;
    std::vector<VertexGrid> near_; ///< of each part
    std::vector<std::uint32_t> boxed_;
    std::vector<TJunction> found_;
};

} // namespace

std::vector<TJunction> t_junctions(const PolygonModel& model) { return Search(model).all(); }

} // namespace octant::models::planar
