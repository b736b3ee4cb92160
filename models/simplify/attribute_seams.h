#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/triangle_mesh.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::models::simplify {

/// How far texture coordinates of a mesh are from those of its original at the nearest points, as
/// lengths in a picture whose sides are 1.
struct TextureError {
    double max = 0.0;
    double rms = 0.0; ///< over the area of the triangles that have texture coordinates
};

/// Seams along which a mesh's colours or texture coordinates break, kept through its
/// simplification. Seams part the surface into charts. The simplifier sees them as borders of
/// materials, which it keeps where they are; its result then takes the attributes of each side of a
/// seam from the chart on that side.
class AttributeSeams {
public:
    /// `corner_colours` has one entry a triangle, or none where no colours break. The mesh must be
    /// a manifold with colours where there are corner colours.
    AttributeSeams(TriangleMesh mesh, std::vector<CornerColours> corner_colours);

    /// The mesh to be simplified: its materials tell charts apart as well, and it has no texture
    /// coordinates.
    const TriangleMesh& marked() const { return marked_; }

    bool has_texture_coordinates() const { return !corner_textures_.empty(); }

    /// A result of simplifying marked() with the materials and texture coordinates of the mesh.
    /// Where charts meet and colours break, it has a vertex for each chart, at the same place to
    /// the bit and in the colour of its side.
    TriangleMesh with_attributes(TriangleMesh made) const;

    /// The error of the texture coordinates that with_attributes gives to a result of simplifying
    /// marked(). Samples of at least 1,000 triangles are looked at, of all where there are fewer.
    TextureError texture_error(const TriangleMesh& made) const;

    /// Divides triangles of a result of simplifying marked() at the midpoints of edges, which moves
    /// no point of its surface, until no sample of the texture coordinates is farther off than
    /// `max_error` or there are `max_faces` triangles.
    TriangleMesh divided(TriangleMesh made, double max_error, std::size_t max_faces) const;

private:
    /// The triangles of one material of marked().
    struct Chart {
        std::vector<std::uint32_t> triangles; ///< of marked()
        measure::TriangleBvh bvh;
    };

    void mark(const std::vector<std::uint32_t>& charts);
    void take_colours(TriangleMesh& made) const;
    void take_texture_coordinates(TriangleMesh& made) const;
    void take_materials(TriangleMesh& made) const;
    bool is_textured(std::uint32_t chart) const;
    glm::vec3 colour_at(const Chart& chart, const glm::dvec3& place_m) const;
    glm::vec2 texture_at(const Chart& chart, const glm::dvec3& place_m) const;
    Chart chart_of(std::vector<std::uint32_t> triangles) const;
    /// The part of its chart that a triangle of a result lies on, where nearest points in the chart
    /// jump from one end of it to another.
    std::optional<Chart> jumping_part(const TriangleMesh& made, std::size_t triangle) const;

    /// The squared error at samples of a triangle, the largest one and their mean.
    struct Squares {
        double max = 0.0;
        double mean = 0.0;
    };

    Squares texture_squares(const TriangleMesh& made, std::size_t triangle) const;

    TriangleMesh marked_;
    std::vector<CornerColours> corner_colours_;
    std::vector<glm::vec2> textures_;               ///< the mesh's texture coordinates
    std::vector<Triangle> corner_textures_;         ///< one a triangle of marked(), or none
    std::vector<Material> materials_;               ///< the mesh's own
    std::vector<std::uint32_t> materials_of_marks_; ///< for each material of marked()
    std::vector<Chart> charts_;                     ///< likewise; empty without attributes
    /// For each triangle of marked() those of its chart across its sides, no_index where there are
    /// fewer; empty without texture coordinates.
    std::vector<Triangle> next_to_;
};

} // namespace octant::models::simplify
