#pragma once

#include "visuals/terrain/bisection_tiles.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

namespace octant::visuals::terrain::test {

/// A picture of 1280 x 720 pixels over 45 degrees.
struct TestPicture {
    static constexpr double focal_px = 869.117;
    static constexpr double half_width_px = 640.0;
    static constexpr double half_height_px = 360.0;

    glm::dvec3 eye_m;
    glm::dvec3 ahead;
    glm::dvec3 right;
    glm::dvec3 up;

    TestPicture(const glm::dvec3& eye, const glm::dvec3& look);

    MeshView view(double earth_radius_m = 0.0) const;

    /// Where a point relative to the eye is drawn, and how deep it lies.
    glm::dvec3 seen(const glm::dvec3& at_m) const;

    bool shows(const glm::dvec3& seen_px) const;
};

struct PixelErrors {
    double worst_px = 0.0;
    double p999_px = 0.0; ///< the 99.9th percentile
    int samples = 0;
};

/// How far the triangles of a mesh lie from the samples of a ground in a picture, by brute force: every sample that the
/// picture shows against the triangle above or below it, rim included. It shares nothing with the meshers but the mesh
/// and the numbers.
PixelErrors pixel_errors(
    const GroundMesh& mesh, const GroundTiles& ground, const TestPicture& picture, double earth_radius_m = 0.0);

} // namespace octant::visuals::terrain::test
