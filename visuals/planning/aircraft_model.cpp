#include "visuals/planning/aircraft_model.h"

#include "models/colour_vertex.h"
#include "models/polygons/repeated_polygons.h"
#include "visuals/shading/vertex_normals.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace octant::visuals::planning {

namespace {

class BufferMaker {
public:
    BufferMaker(const models::polygons::PolygonModel& model, std::span<const glm::vec3> normals)
        : model_(model)
        , normals_(normals) {
        for (std::size_t i = 0; i < model.polygons.size(); ++i) {
            add_corners(i);
        }
    }

    /// Appends polygons as triangle fans in the order given.
    template <class Polygons>
    scene::IndexRange append(const Polygons& polygons) {
        scene::IndexRange range;
        range.first_index = static_cast<std::uint32_t>(buffers_.indices.size());
        for (const std::uint32_t polygon : polygons) {
            const std::uint32_t first = model_.polygons[polygon].first_corner;
            for (std::uint32_t corner = 2; corner < model_.polygons[polygon].corner_count;
                 ++corner) {
                buffers_.indices.insert(
                    buffers_.indices.end(), {first, first + corner - 1, first + corner});
            }
            ++range.polygons;
        }
        range.index_count = static_cast<std::uint32_t>(buffers_.indices.size()) - range.first_index;
        return range;
    }

    scene::ModelBuffers take() { return std::move(buffers_); }

private:
    void add_corners(std::size_t polygon) {
        const glm::vec3 normal(models::polygons::normal_of(model_, polygon));
        const std::uint32_t colour =
            models::packed_colour(model_.materials[model_.polygons[polygon].material].colour);
        const std::optional<std::uint32_t> pivot = models::polygons::pivot_of(model_, polygon);
        const std::uint32_t part = pivot ? *pivot + 1 : 0;
        for (const std::uint32_t vertex : model_.corners(polygon)) {
            buffers_.vertices.push_back(
                {glm::vec3(model_.vertices_m[vertex]),
                 normals_[buffers_.vertices.size()],
                 normal,
                 colour,
                 colour,
                 part,
                 static_cast<std::uint32_t>(polygon)});
        }
    }

    const models::polygons::PolygonModel& model_;
    std::span<const glm::vec3> normals_;
    scene::ModelBuffers buffers_;
};

/// Where the triangles of each polygon of a list begin, and where those of the last one end.
std::vector<std::uint32_t>
first_indices_of(const models::polygons::PolygonModel& model, std::span<const std::uint32_t> list) {
    std::vector<std::uint32_t> first{0};
    first.reserve(list.size() + 1);
    for (const std::uint32_t polygon : list) {
        first.push_back(first.back() + 3 * (model.polygons[polygon].corner_count - 2));
    }
    return first;
}

} // namespace

scene::IndexRange
index_range(const AircraftModel& model, const draworder::DrawOrder::Range& range) {
    const std::uint32_t first = model.first_indices[range.first];
    return {
        first,
        model.first_indices[range.first + range.count] - first,
        static_cast<int>(range.count),
        static_cast<std::uint32_t>(range.first)};
}

AircraftModel aircraft_model(
    models::polygons::PolygonModel polygons,
    draworder::DrawOrder order,
    const glm::dvec3& eye_m,
    std::vector<glm::vec3> normals) {
    if (normals.empty()) {
        normals = shading::corner_normals(polygons);
    }
    assert(normals.size() == polygons.corner_vertices.size());
    shading::ShadedPolygons shaded = shading::shaded_polygons(polygons, normals);
    BufferMaker maker(polygons, normals);
    std::vector<std::uint32_t> first_indices = first_indices_of(polygons, order.polygons());
    maker.append(order.polygons());
    std::vector<std::uint32_t> file_list = models::polygons::polygons_without_repeats(polygons);
    const scene::IndexRange all = maker.append(file_list);
    const double radius_m = models::polygons::radius_m(polygons);
    const HullExtent hull = hull_extent(polygons);
    scene::ModelBuffers buffers = maker.take();
    return {
        std::move(polygons),
        std::move(order),
        std::move(buffers),
        std::move(first_indices),
        all,
        std::move(file_list),
        hull,
        {radius_m, eye_m},
        std::move(shaded),
        {},
        nullptr,
        {0.0},
        {}};
}

namespace {

/// Makes hull and radius of a model hold a point of its mesh too.
void include(AircraftModel& model, const glm::dvec3& point_m) {
    model.hull.least_m = glm::min(model.hull.least_m, point_m);
    model.hull.most_m = glm::max(model.hull.most_m, point_m);
    model.subject.radius_m = std::max(model.subject.radius_m, glm::length(point_m));
}

} // namespace

void add_levels(
    AircraftModel& model, std::span<const MeshSource> sources, double polygons_error_m) {
    model.errors_m.clear();
    for (const MeshSource& source : sources) {
        model.levels.push_back(append_level(model.buffers, source));
        model.errors_m.push_back(source.error_m);
        for (const glm::dvec3& vertex_m : source.mesh->vertices_m) {
            include(model, vertex_m);
        }
    }
    model.errors_m.push_back(polygons_error_m);
    assert(std::ranges::is_sorted(model.errors_m));
}

void add_progressive(
    AircraftModel& model,
    std::shared_ptr<const refine::ProgressiveMesh> mesh,
    double polygons_error_m) {
    const glm::dvec3& origin_m = mesh->parts().origin_m;
    for (std::uint32_t node = 0; node < mesh->node_count(); ++node) {
        include(model, origin_m + glm::dvec3(mesh->position_m(node)));
    }
    model.progressive = std::move(mesh);
    model.errors_m = {0.0, polygons_error_m};
    model.buffers.has_meshes = true;
}

void add_turning(AircraftModel& model, std::span<const TurningMesh> parts) {
    assert(model.progressive != nullptr && model.turning.index_count == 0);
    model.turning.first_index = static_cast<std::uint32_t>(model.buffers.indices.size());
    for (const TurningMesh& part : parts) {
        const models::polygons::Pivot& pivot = model.polygons.pivots[part.pivot];
        const std::size_t first = model.buffers.vertices.size();
        const MeshLevel level = append_level(model.buffers, {part.mesh, 0.0});
        model.turning.index_count += level.range.index_count;
        model.turning.polygons += level.range.polygons;
        for (scene::ModelVertex& vertex : std::span(model.buffers.vertices).subspan(first)) {
            vertex.part = part.pivot + 1;
            vertex.polygon = 0;
            const HullExtent circle = circle_of(pivot, glm::dvec3(vertex.position_m));
            include(model, circle.least_m);
            include(model, circle.most_m);
        }
    }
}

glm::dvec3 pilot_eye_m(const models::polygons::PolygonModel& model) {
    glm::dvec3 least(std::numeric_limits<double>::max());
    glm::dvec3 most(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& vertex : model.vertices_m) {
        least = glm::min(least, vertex);
        most = glm::max(most, vertex);
    }
    return {most.x - 0.25 * (most.x - least.x), 0.5 * (least.y + most.y), least.z};
}

} // namespace octant::visuals::planning
