#include "visuals/planning/mesh_levels.h"

#include "models/collapse_sequence.h"
#include "models/colour_vertex.h"
#include "visuals/shading/vertex_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace octant::visuals::planning {

namespace {

/// A coarser level must be better than asked for by this factor before it replaces a finer one.
constexpr double coarsening_margin = 0.7;

std::vector<glm::vec3> given_or_computed_normals(const models::TriangleMesh& mesh) {
    if (mesh.normals.empty()) { return shading::corner_normals(mesh); }
    std::vector<glm::vec3> normals;
    normals.reserve(3 * mesh.triangles.size());
    for (const models::Triangle& corners : mesh.corner_normals) {
        for (const std::uint32_t normal : corners) { normals.push_back(mesh.normals[normal]); }
    }
    return normals;
}

/// Gives the corners of a mesh their places in a vertex buffer.
class MipLevelBuilder {
public:
    MipLevelBuilder(scene::ModelBuffers& buffers, const models::TriangleMesh& mesh)
        : buffers_(buffers), mesh_(mesh), newest_(mesh.vertices_m.size(), models::none) {}

    void add(std::uint32_t triangle, std::span<const glm::vec3> normals) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = vertex_of(triangle, k, normals[std::size_t{3} * triangle + k]);
        }
        const std::size_t first = unclaimed_corner(corners);
        set_provoking_vertex(corners[first], triangle);
        for (std::size_t k = 0; k < 3; ++k) { buffers_.indices.push_back(corners[(first + k) % 3]); }
    }

private:
    std::uint32_t colour_of(std::uint32_t triangle, std::uint32_t vertex) const {
        return models::packed_colour(
            mesh_.colours.empty() ? models::material_colour(mesh_, triangle) : mesh_.colours[vertex]);
    }

    /// A drawn vertex that looks like this corner, made where there is none.
    std::uint32_t vertex_of(std::uint32_t triangle, std::size_t corner, const glm::vec3& normal) {
        const std::uint32_t vertex = mesh_.triangles[triangle][corner];
        const std::uint32_t colour = colour_of(triangle, vertex);
        for (std::uint32_t at = newest_[vertex]; at != models::none; at = older_[at - first_]) {
            const scene::ModelVertex& drawn = buffers_.vertices[at];
            if (drawn.normal == normal && drawn.colour == colour) { return at; }
        }
        scene::ModelVertex made;
        made.position_m = glm::vec3(mesh_.vertices_m[vertex]);
        made.normal = normal;
        made.colour = colour;
        const std::uint32_t at = add_vertex(made);
        older_.back() = newest_[vertex];
        newest_[vertex] = at;
        return at;
    }

    std::uint32_t add_vertex(const scene::ModelVertex& vertex) {
        buffers_.vertices.push_back(vertex);
        older_.push_back(models::none);
        is_first_.push_back(0);
        return static_cast<std::uint32_t>(buffers_.vertices.size() - 1);
    }

    /// A corner with which no triangle begins yet; its vertex is doubled where all three are taken.
    std::size_t unclaimed_corner(std::array<std::uint32_t, 3>& corners) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (is_first_[corners[k] - first_] == 0) { return k; }
        }
        corners[0] = add_vertex(scene::ModelVertex(buffers_.vertices[corners[0]]));
        return 0;
    }

    void set_provoking_vertex(std::uint32_t vertex, std::uint32_t triangle) {
        is_first_[vertex - first_] = 1;
        buffers_.vertices[vertex].polygon = triangle;
        buffers_.vertices[vertex].face_normal = models::normal_of(mesh_, mesh_.triangles[triangle], {0.0, 0.0, -1.0});
        buffers_.vertices[vertex].face_colour = models::packed_colour(models::mean_colour(mesh_, triangle));
    }

    scene::ModelBuffers& buffers_;
    const models::TriangleMesh& mesh_;
    std::uint32_t first_ = static_cast<std::uint32_t>(buffers_.vertices.size());
    /// The drawn vertex of each of the mesh's.
    std::vector<std::uint32_t> newest_;
    /// Another drawn vertex of the same one, by drawn vertex.
    std::vector<std::uint32_t> older_;
    std::vector<std::uint8_t> is_first_;
};

} // namespace

MeshLevel append_level(scene::ModelBuffers& buffers, const MeshSource& source) {
    const models::TriangleMesh& mesh = *source.mesh;
    const std::vector<glm::vec3> normals = given_or_computed_normals(mesh);
    MeshLevel level;
    level.error_m = source.error_m;
    level.shaded = shading::shaded_polygons(mesh, normals);
    level.range.first_index = static_cast<std::uint32_t>(buffers.indices.size());
    level.range.index_count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
    level.range.polygons = static_cast<int>(mesh.triangles.size());
    MipLevelBuilder maker(buffers, mesh);
    for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) { maker.add(triangle, normals); }
    buffers.has_depth_drawn_meshes = true;
    return level;
}

int select_level(std::span<const double> errors_m, double max_m, int before) {
    assert(!errors_m.empty());
    const auto coarsest_level_within = [&](double limit_m) {
        int level = static_cast<int>(errors_m.size()) - 1;
        while (level > 0 && errors_m[static_cast<std::size_t>(level)] > limit_m) { --level; }
        return level;
    };
    const int coarsest_sufficient = coarsest_level_within(max_m);
    if (before < 0 || coarsest_sufficient < before) { return coarsest_sufficient; }
    return std::max(before, coarsest_level_within(coarsening_margin * max_m));
}

} // namespace octant::visuals::planning
