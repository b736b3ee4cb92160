#pragma once

#include "models/heights/height_field.h"
#include "tests/visuals/terrain/both_meshes.h"
#include "tests/visuals/terrain/ground_check.h"
#include "visuals/terrain/bisection_mesher.h"
#include "visuals/terrain/ground_builder.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace octant::visuals::terrain::test {

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
models::heights::HeightField any_field(int columns, int rows, Numbers& numbers);

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
