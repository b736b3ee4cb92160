#pragma once

#include "models/meshfile/baked_pictures.h"
#include "models/meshfile/mesh_limits.h"
#include "models/meshfile/mesh_parts.h"
#include "models/meshfile/read_options.h"
#include "models/triangle_mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

/// One corner of a polygon as a file names it.
struct CornerIndices {
    std::uint32_t vertex = invalid_index;
    std::uint32_t normal = invalid_index;
    std::uint32_t texture = invalid_index; ///< of add_texture_coordinates
};

/// What all mesh readers do alike: polygons into triangles, faulty normals, missing materials. Its readers have checked
/// what they add: finite numbers, indices in range, 3 to max_polygon_corners corners.
class MeshBuilder {
public:
    /// The mesh is called after the file.
    explicit MeshBuilder(const std::filesystem::path& path, const ReadOptions& options = {});

    bool uses_pictures() const { return options_.pictures; }

    bool adds_back_faces() const { return options_.backs; }

    /// Whether polygons from now on are two-sided.
    void set_two_sided(bool two_sided) { is_two_sided_ = two_sided; }

    BakedPictures& pictures() { return pictures_; }

    bool is_empty() const { return mesh_.triangles.empty(); }

    std::size_t vertex_count() const { return mesh_.vertices_m.size(); }

    const glm::dvec3& vertex_m(std::uint32_t vertex) const { return mesh_.vertices_m[vertex]; }

    std::size_t normal_count() const { return mesh_.normals.size(); }

    std::uint32_t add_vertex(const glm::dvec3& position_m);

    /// Vertices that get no colour are white once any other has one.
    void set_colour(std::uint32_t vertex, const glm::vec3& colour);

    /// Makes it a unit vector, unless it is one already; one without a length is replaced at each corner by the
    /// triangle's own normal.
    std::uint32_t add_normal(const glm::dvec3& normal);

    /// From a picture's lower left corner. A triangle with a corner that has none, or none that is finite, is read
    /// without.
    std::uint32_t add_texture_coordinates(const glm::vec2& coordinates);

    std::size_t texture_coordinates_count() const { return mesh_.texture_coordinates.size(); }

    /// `opacity`: how much it hides of what lies behind, 0..1.
    std::uint32_t add_material(Material material, float opacity = 1.0F);

    /// The group of the options that polygons from now on belong to; invalid_index: none.
    void set_group(std::uint32_t group) { group_ = group; }

    /// Adds a polygon, cut into triangles by polygons::triangulate_polygon. `picture`: a number of pictures().
    void add_polygon(std::span<const CornerIndices> corners, std::uint32_t material = invalid_index,
        std::uint32_t picture = BakedPictures::none);

    void add_note(std::string note) { mesh_.notes.push_back(std::move(note)); }

    /// The finished mesh. Throws Error when it has no triangle.
    TriangleMesh finish();

    /// The same with its parts apart.
    MeshParts finish_parts();

private:
    bool is_transparent(std::size_t triangle) const;
    float opacity_of(std::size_t triangle) const;
    void drop_invisible();
    void find_opacities();
    template <typename Kept>
    TriangleMesh part_of(const Kept& is_kept, std::vector<std::string>& notes) const;
    void finish_part();
    void take_out(const std::vector<bool>& gone);
    void add_triangle(const std::array<CornerIndices, 3>& corners, std::uint32_t material);
    void leave_out_transparent();
    void bake_pictures();
    void finish_backs();
    void finish_normals();
    void finish_texture_coordinates();
    glm::vec2 on_picture(const CornerIndices& corner) const;
    void finish_materials();

    std::filesystem::path path_;
    ReadOptions options_;
    BakedPictures pictures_;
    TriangleMesh mesh_;
    std::vector<bool> faulty_normals_;
    std::vector<glm::dvec3> places_m_;         ///< corners of the polygon at hand
    std::vector<float> opacities_;             ///< one a material
    std::vector<bool> two_sided_;              ///< one a triangle
    std::vector<std::uint32_t> groups_;        ///< one a triangle
    std::vector<BakedPictures::Cover> covers_; ///< one a triangle, once they are looked for
    std::uint32_t group_ = invalid_index;
    bool is_two_sided_ = false;
    bool is_part_ = false; ///< of a larger mesh
    bool has_normals_ = false;
    bool has_texture_coordinates_ = false;
    bool has_materials_ = false;
};

} // namespace octant::models::meshfile
