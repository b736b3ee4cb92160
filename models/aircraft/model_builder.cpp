#include "models/aircraft/model_builder.h"

#include "models/aircraft/convex_outline.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

namespace octant::models::aircraft {

ModelBuilder::ModelBuilder(std::string name) { model_.name = std::move(name); }

void ModelBuilder::add_material(const std::string& name, const glm::vec3& colour) {
    model_.materials.push_back({name, colour});
}

std::uint32_t ModelBuilder::vertex_at(const glm::dvec3& at_m) {
    constexpr double grid_m = 1e-10; // what the file keeps
    const glm::dvec3 kept = glm::round(at_m / grid_m) * grid_m + glm::dvec3(0.0);
    const auto found = std::ranges::find_if(
        model_.vertices_m, [&](const glm::dvec3& other) { return glm::distance(other, kept) < coincident_distance_m; });
    if (found != model_.vertices_m.end()) { return static_cast<std::uint32_t>(found - model_.vertices_m.begin()); }
    model_.vertices_m.push_back(kept);
    return static_cast<std::uint32_t>(model_.vertices_m.size() - 1);
}

std::uint32_t ModelBuilder::part_of(const std::string& name) {
    const auto found = std::ranges::find(model_.parts, name);
    if (found != model_.parts.end()) { return static_cast<std::uint32_t>(found - model_.parts.begin()); }
    model_.parts.push_back(name);
    return static_cast<std::uint32_t>(model_.parts.size() - 1);
}

void ModelBuilder::add(const std::string& part, const PaintedSolid& solid) {
    for (const PaintedFace& face : solid) {
        const auto material = std::ranges::find(model_.materials, face.material, &Material::name);
        assert(material != model_.materials.end());
        std::vector<std::uint32_t> corners;
        for (const glm::dvec3& corner : face.corners_m) {
            const std::uint32_t vertex = vertex_at(corner);
            if (std::ranges::find(corners, vertex) == corners.end()) { corners.push_back(vertex); }
        }
        if (corners.size() < 3) { continue; }
        outlines_.push_back(std::move(corners));
        polygons::Polygon polygon;
        polygon.material = static_cast<std::uint32_t>(material - model_.materials.begin());
        polygon.part = part_of(part);
        model_.polygons.push_back(polygon);
    }
}

void ModelBuilder::add_mirrored(const std::string& part, const PaintedSolid& right_side) {
    add(part + "_right", right_side);
    add(part + "_left", mirrored(right_side));
}

void ModelBuilder::add_pivot(const std::string& part, const polygons::Pivot& pivot) {
    model_.pivots.push_back(pivot);
    model_.pivots.back().part = part_of(part);
}

polygons::PolygonModel ModelBuilder::finish() {
    constexpr double beside_m = 1e-6;
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
        std::vector<std::uint32_t> whole;
        const std::vector<std::uint32_t>& outline = outlines_[i];
        for (std::size_t k = 0; k < outline.size(); ++k) {
            const glm::dvec3 from = model_.vertices_m[outline[k]];
            const glm::dvec3 to = model_.vertices_m[outline[(k + 1) % outline.size()]];
            const double length = glm::distance(from, to);
            const glm::dvec3 along = (to - from) / length;
            std::vector<std::pair<double, std::uint32_t>> between;
            for (std::uint32_t vertex = 0; vertex < model_.vertices_m.size(); ++vertex) {
                const glm::dvec3 offset = model_.vertices_m[vertex] - from;
                const double share = glm::dot(offset, along);
                if (share > 2.0 * beside_m && share < length - 2.0 * beside_m &&
                    glm::length(offset - share * along) < beside_m) {
                    between.emplace_back(share, vertex);
                }
            }
            std::ranges::sort(between);
            whole.push_back(outline[k]);
            for (const auto& [share, vertex] : between) { whole.push_back(vertex); }
        }
        model_.polygons[i].first_corner = static_cast<std::uint32_t>(model_.corner_vertices.size());
        model_.polygons[i].corner_count = static_cast<std::uint32_t>(whole.size());
        model_.corner_vertices.insert(model_.corner_vertices.end(), whole.begin(), whole.end());
    }
    return std::move(model_);
}

} // namespace octant::models::aircraft
