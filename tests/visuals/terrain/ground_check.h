#pragma once

#include "models/colour_vertex.h"
#include "models/heights/height_field.h"
#include "visuals/terrain/bisection_ground_builder.h"
#include "visuals/terrain/bisection_mesher.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

// What tests of meshes by resolution and of meshes by screen-space error share.
namespace octant::visuals::terrain::test {

/// Samples of a field.
struct FieldSize {
    int columns;
    int rows;
};

/// Small generator of numbers that are the same everywhere.
class Numbers {
public:
    explicit Numbers(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL + 1) {}

    std::uint32_t next() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::uint32_t>(state_ >> 33U);
    }

    /// From `low` up to `high`.
    double between(double low, double high) { return low + (high - low) * next() / 2147483648.0; }

    bool coin() { return (next() >> 7U & 1U) != 0; }

private:
    std::uint64_t state_;
};

/// Level ground at 0 m with 1 m between samples.
models::heights::HeightField level_field(int columns, int rows);

/// Level ground with one sample at `height_m`.
models::heights::HeightField bump_field(int size, int column, int row, float height_m);

/// Hills and noise, 1 m between samples; differently rough in different places.
models::heights::HeightField rough_field(int columns, int rows, std::uint64_t seed);

/// The same eye without a frustum: all ground is in view.
MeshView everywhere_from(const MeshView& view);

/// Level ground with single high samples here and there, 1 m between samples.
models::heights::HeightField spiky_field(int columns, int rows, std::uint64_t seed);

/// As many colours as the field has samples, all different.
std::vector<std::uint32_t> numbered_colours(const models::heights::HeightField& field);

/// A tree and a mesher over a field that stays where it is.
struct Ground {
    explicit Ground(models::heights::HeightField made, const QuadtreeOptions& options = {})
        : field(std::move(made)), colours(numbered_colours(field)), tree(field, options), mesher(tree, colours) {}

    models::heights::HeightField field;
    std::vector<std::uint32_t> colours;
    Quadtree tree;
    QuadtreeMesher mesher;
};

/// A triangle by the samples at its corners (row * columns + column), the smallest first.
struct SampleTriangle {
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t c;
    auto operator<=>(const SampleTriangle&) const = default;
};

/// A triangle with its corners turned round.
SampleTriangle smallest_first(std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// The mesh in whole samples, in drawing order. Finds the sample of a vertex by its position and fails the test where
/// there is none.
std::vector<SampleTriangle> sample_triangles(
    const GroundMesh& mesh, const models::heights::HeightField& field, const glm::dvec3& eye_m);

struct GroundCheck {
    bool counter_clockwise = true; ///< every triangle, seen from above, with an area
    long signed_area2 = 0;         ///< sum over the triangles in plan, spacings^2
    long unmatched_edges = 0;      ///< inside the field, not between exactly two triangles
};

GroundCheck checked_ground(const std::vector<SampleTriangle>& triangles, const models::heights::HeightField& field);

/// The triangles cover the whole field once, without a corner on another's edge.
bool ground_triangles_conform(const std::vector<SampleTriangle>& triangles, const models::heights::HeightField& field);

/// Any of the options under which trees are built.
QuadtreeOptions random_options(Numbers& numbers);

/// An eye in, beside, above or below the field; every fourth view is not culled.
MeshView random_view(Numbers& numbers, const models::heights::HeightField& field);

/// How many plan rays from the eye pass two of the triangles, given in drawing order, in the wrong one: the earlier
/// nearer to the eye. One ray between each two neighbouring corners as seen from the eye, so that every triangle that
/// can be seen through another in plan is.
long wrongly_ordered_rays(
    const std::vector<SampleTriangle>& triangles, const models::heights::HeightField& field, const glm::dvec3& eye_m);

/// Frustum of a camera: yaw counter-clockwise from east, pitch upward.
MeshView camera_view(const glm::dvec3& eye_m, double yaw_rad, double pitch_rad, double fov_rad);

/// On a circle low over a ground of 257 by 257 samples, 1 m apart.
MeshView circling(int frame);

MeshView into_the_sky();

/// A triangle's corners, eye subtracted.
using Corners = std::array<glm::dvec3, 3>;

Corners corners_of(const GroundMesh& mesh, std::size_t triangle);

/// Any of 21 points spread over a triangle is inside the frustum.
bool reaches_into(const Corners& corners, const MeshView& view);

/// A box, world axes, in which triangles are looked for.
struct SearchBox {
    glm::dvec3 middle_m;
    glm::dvec3 half_m;

    /// Whether it meets another.
    bool meets(const glm::dvec3& min_m, const glm::dvec3& max_m) const;
};

/// How many triangles of a mesh meet the box. Fails the test unless `found` are numbers of the mesh's triangles,
/// ascending, and those are among them.
long checked_count_in(
    const SearchBox& box, const GroundMesh& mesh, const glm::dvec3& eye_m, std::span<const std::uint32_t> found);

/// What a copy of a mesh is compared by.
struct MeshCopy {
    explicit MeshCopy(const GroundMesh& mesh);
    bool operator==(const MeshCopy& other) const;

    std::vector<models::ColourVertex> vertices;
    std::vector<VertexMorph> morphs;
    std::vector<std::uint32_t> indices;
    int triangles;
    int fans;
    double resolution;
    double error_px;
};

/// A ground with errors, the field of its stored heights and a mesher.
struct ErrorGround {
    explicit ErrorGround(const models::heights::HeightField& made)
        : tiles(make_ground_tiles(made)), field(stored_field(tiles)), mesher(tiles) {}

    static models::heights::HeightField stored_field(const GroundTiles& tiles);

    GroundTiles tiles;
    models::heights::HeightField field;
    BisectionMesher mesher;
};

/// Level, rough or spiky ground of any size.
models::heights::HeightField any_field(const FieldSize& size, Numbers& numbers);

/// A view as random_view; half of them over a small curved earth.
MeshView any_view(Numbers& numbers, const models::heights::HeightField& field);

/// An error that such grounds are meshed at.
double any_error_px(Numbers& numbers);

/// The mesh in whole samples by its origins, in drawing order. Fails the test where vertices of triangles are not in
/// plan where their samples are, or two at the same one.
std::vector<SampleTriangle> origin_triangles(
    const GroundMesh& mesh, const models::heights::HeightField& field, const glm::dvec3& eye_m);

/// Height of the mesh as drawn above datum at every sample of the field, row after row; not a number where there is no
/// triangle.
std::vector<double> drawn_heights_m(
    const GroundMesh& mesh, const models::heights::HeightField& field, const glm::dvec3& eye_m);

} // namespace octant::visuals::terrain::test
