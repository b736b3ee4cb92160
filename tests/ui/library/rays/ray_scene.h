#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <octant/octant.h>
#include <optional>
#include <string>
#include <vector>

namespace octant::tests {

/// A triangle that World::export_scene wrote.
struct SceneTriangle {
    std::array<Vec3, 3> corners_m;
    Vec3 normal; ///< of unit length, on the side from which the corners are counter-clockwise
    SurfaceClass surface = SurfaceClass::Sky;
    std::uint32_t object = 0;
};

/// Reads a file of World::export_scene. Throws std::runtime_error for one that has another form.
std::vector<SceneTriangle> read_scene(const std::string& file);

/// Finds by Embree what rays from an eye hit. Triangles are seen from the front only, as the renderer draws them.
class RayScene {
public:
    /// `nearest_m`: what is nearer along the ray's first unit is not hit.
    RayScene(std::vector<SceneTriangle> triangles, const Vec3& eye_m);

    struct Hit {
        std::size_t triangle = 0;
        double way = 0.0; ///< in lengths of the ray
    };

    /// The nearest triangle in this direction from the eye, beyond `from` lengths of the ray. The way is computed in
    /// double precision.
    std::optional<Hit> nearest(const Vec3& ray, double from = 0.0) const;

    const std::vector<SceneTriangle>& triangles() const;

    /// How far in this direction the plane of a triangle is.
    double way_to_plane(std::size_t triangle, const Vec3& ray) const;

private:
    struct Embree;
    std::shared_ptr<Embree> embree_;
};

} // namespace octant::tests
