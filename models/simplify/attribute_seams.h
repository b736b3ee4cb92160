#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/triangle_mesh.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// How far one kind of attributes of a mesh is from that of its original at the nearest points.
struct AttributeError {
    double max = 0.0;
    double rms = 0.0; ///< over the area of the triangles that have the attribute
};

/// The errors of all kinds of attributes.
struct AttributeErrors {
    AttributeError texture;    ///< lengths in a picture whose sides are 1
    AttributeError normal_deg; ///< angles
    AttributeError colour;     ///< lengths in red, green and blue, each 0..1
};

/// Upper limits of attribute errors.
struct AttributeBounds {
    double texture = std::numeric_limits<double>::infinity();
    double normal_deg = std::numeric_limits<double>::infinity();
    double colour = std::numeric_limits<double>::infinity();
};

/// A point of a mesh: a triangle, and the shares of its corners.
struct MeshPoint {
    std::uint32_t triangle = 0;
    glm::dvec3 shares{1.0, 0.0, 0.0};
};

/// The triangles whose attribute errors are measured: at least 8,000 (all if there are fewer), which is faster on large
/// meshes, or all, which certifies a bound.
enum class LookAt : std::uint8_t { SomeTriangles, AllTriangles };

/// Preserves the attributes of a mesh, and the seams along which its colours or texture coordinates are discontinuous,
/// through simplification. Seams divide the surface into charts. The simplifier treats them as borders of materials,
/// which it does not move; each side of a seam in its result takes its attributes from the chart on that side.
class AttributeSeams {
public:
    /// `corner_colours` has one entry a triangle, or none if colours are continuous. The mesh must be a manifold, with
    /// colours if there are corner colours.
    AttributeSeams(TriangleMesh mesh, std::vector<CornerColours> corner_colours);

    /// The mesh to be simplified: its materials tell charts apart as well, and it has neither texture coordinates nor
    /// normals.
    const TriangleMesh& marked() const { return marked_; }

    bool has_texture_coordinates() const { return !corner_textures_.empty(); }

    bool has_normals() const { return !corner_normals_.empty(); }

    bool has_colours() const { return !marked_.colours.empty(); }

    /// For each material of marked() the mesh's own material; invalid_index for none.
    const std::vector<std::uint32_t>& materials_of_charts() const { return material_of_mark_; }

    /// A point of a chart near to a place: on the way from triangles of that chart, at least one, across its edges to
    /// nearer ones. Other parts of the chart that lie as near, such as the lower side of a thin wing, are not met.
    MeshPoint near_point(const glm::dvec3& at_m, std::span<const std::uint32_t> from) const;

    /// Whether a point has texture coordinates.
    bool has_coordinates(const MeshPoint& point) const {
        return has_texture_coordinates() && corner_textures_[point.triangle][0] != invalid_index;
    }

    /// The texture coordinates of a point; it must have some (asserted).
    glm::vec2 texture_coordinates(const MeshPoint& point) const;

    /// A result of simplifying marked() with the materials and colours of the mesh. Where charts meet and colours
    /// break, it has a vertex for each chart, at the same place to the bit and in the colour of its side.
    TriangleMesh with_colours(TriangleMesh made) const;

    /// The result of with_colours() with texture coordinates and normals. Normals come from triangles with a similar
    /// orientation, which keeps sharp edges sharp.
    TriangleMesh with_attributes(TriangleMesh made) const;

    /// The errors of the attributes that with_attributes gives to a result of simplifying marked().
    AttributeErrors errors(const TriangleMesh& made, LookAt which = LookAt::SomeTriangles) const;

    /// Divides triangles of a result of simplifying marked() at the midpoints of edges, which moves no point of its
    /// surface, until no sample of an attribute is farther off than its bound, or they are much smaller than those of
    /// the mesh, or there are `max_faces`. With a bound of colours all vertices get the colours of the mesh at the
    /// nearest points.
    TriangleMesh divided(TriangleMesh made, const AttributeBounds& bounds, std::size_t max_faces) const;

private:
    /// The triangles of one material of marked().
    struct Chart {
        std::vector<std::uint32_t> triangles; ///< of marked()
        measure::TriangleBvh bvh;
    };

    /// A triangle of a result, and the part of the mesh that its attributes come from.
    struct Lookup {
        const Chart* chart = nullptr;
        std::optional<Chart> part; ///< used instead of the chart, if present
        bool is_textured = false;
        glm::dvec3 facing{0.0}; ///< the triangle's normal
        glm::dvec3 middle_m{0.0};

        const Chart& own() const { return part ? *part : *chart; }
    };

    struct Values {
        glm::dvec2 texture{0.0};
        glm::dvec3 normal{0.0};
        glm::dvec3 colour{0.0};
    };

    /// The squared error at samples of a triangle, the largest one and their mean.
    struct SquaredErrors {
        double max = 0.0;
        double mean = 0.0;
    };

    void mark(const std::vector<std::uint32_t>& charts);
    void take_colours(TriangleMesh& made) const;
    void take_corners(TriangleMesh& made) const;
    void take_materials(TriangleMesh& made) const;
    bool is_marked(const TriangleMesh& made) const;
    static std::uint32_t chart_at(const TriangleMesh& made, std::size_t triangle);
    bool is_textured(const Chart& chart) const;
    Lookup lookup(const TriangleMesh& made, std::size_t triangle) const;
    glm::dvec2 texture_at(const Chart& chart, const measure::NearestOnMesh& nearest) const;
    glm::dvec3 colour_at(const Chart& chart, const measure::NearestOnMesh& nearest) const;
    glm::dvec3 normal_at(const Lookup& lookup, const glm::dvec3& at_m, const measure::NearestOnMesh* known) const;
    Values values_at(const Lookup& lookup, const glm::dvec3& at_m) const;
    Chart chart_of(std::vector<std::uint32_t> triangles) const;
    /// The part of its chart that a triangle of a result lies on, where nearest points in the chart jump from one end
    /// of it to another.
    std::optional<Chart> discontinuous_part(const TriangleMesh& made, std::size_t triangle) const;

    /// Of texture coordinates, normals and colours. Corners take the colours of vertices in `vertex_colours`, or of the
    /// mesh where it is empty.
    std::array<SquaredErrors, 3> squares(const TriangleMesh& made, std::size_t triangle,
        const std::vector<std::optional<glm::dvec3>>& vertex_colours) const;

    TriangleMesh marked_;
    std::vector<CornerColours> corner_colours_;
    std::vector<glm::vec2> textures_;             ///< the mesh's texture coordinates
    std::vector<Triangle> corner_textures_;       ///< one a triangle of marked(), or none
    std::vector<glm::vec3> normals_;              ///< the mesh's
    std::vector<Triangle> corner_normals_;        ///< one a triangle of marked(), or none
    std::vector<Material> materials_;             ///< the mesh's own
    std::vector<std::uint32_t> material_of_mark_; ///< for each material of marked()
    std::vector<Chart> charts_;                   ///< likewise; empty without attributes
    /// For each triangle of marked() those of its chart across its sides, invalid_index where there are fewer; empty
    /// without texture coordinates.
    std::vector<Triangle> next_to_;
};

} // namespace octant::models::simplify
