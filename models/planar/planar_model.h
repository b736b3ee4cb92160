#pragma once

#include "models/planar/incidences.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::planar {

/// Polygons flatter than this are not changed. No corner of a polygon that planarize() made planar is farther from its
/// plane. In the unit of the points.
inline constexpr double planar_noise = 1e-10;

/// Moves points, each by at most `max_move`, until the corners of each polygon and the points that touch it lie in one
/// plane. A polygon for which this fails first loses its touching points, then its plane. The result is true for the
/// polygons that are not planar.
std::vector<bool> planarize(std::vector<glm::dvec3>& points, std::span<const Incidence> incidences, double max_move);

/// The largest power of ten of which all coordinates are multiples, up to rounding; 0 where there is none.
double decimal_grid(std::span<const glm::dvec3> points);

/// Points nearer to a plane than this lie on it, in radii of the model. Planar models have ten times less noise.
inline constexpr double planar_tolerance = 1e-9;

/// Points nearer than this touch, in radii of the model. Files with six decimals or in single precision have no better
/// resolution, and the resolution of a model that was rotated cannot be found.
inline constexpr double touching_reach = 1e-6;

/// A model of planar convex polygons around the centre of its bounding box, in units of its radius.
struct PlanarModel {
    /// Lengths are in radii, axes are the columns of `axes`. Vertices keep their indices. Polygons that could not
    /// become planar are cut; PolygonModel::parents names their originals. Polygons without an area are missing. May be
    /// empty.
    polygons::PolygonModel model;
    glm::dmat3 axes{1.0};
    double radius_m = 1.0;

    /// The power of ten of which all coordinates of the given model are multiples, metres; 0 where there is none.
    double grid_m = 0.0;
    /// In units of grid_m, or metres where it is 0: a point near the model, the centre relative to it in own axes, and
    /// the radius. They are separate so that a model far from the origin loses no digits.
    glm::dvec3 base_steps{0.0};
    glm::dvec3 centre_steps{0.0};
    double radius_steps = 1.0;

    double step_m() const { return grid_m > 0.0 ? grid_m : 1.0; }

    /// Converts from radii to the frame and unit of the given model.
    glm::dvec3 to_model_frame(const glm::dvec3& point) const {
        return (base_steps + axes * (centre_steps + point * radius_steps)) * step_m();
    }

    Plane to_model_frame(const Plane& plane) const {
        const glm::dvec3 normal = axes * plane.normal;
        return {normal, plane.offset_m * radius_m - glm::dot(normal, to_model_frame(glm::dvec3(0.0)))};
    }

    /// Number of polygons that were bent or concave by more than touching_reach and were cut into pieces. Smaller
    /// faults come from the decimals of a file; their polygons are cut too, but not counted.
    int triangulated_polygons = 0;
    int dropped_polygons = 0; ///< without an area, left out
};

/// The axes of a planar model: Own are computed from its shape, so that a rotated model gives the same result; Given
/// are those of the given model.
enum class Attitude { Own, Given };

/// Makes a model planar by the rules in README.md. The model must have finite coordinates.
PlanarModel planar_model(const polygons::PolygonModel& model, Attitude attitude = Attitude::Own);

/// Converts a model to the frame and unit of the given model. Vertices that planar_model() did not move have the same
/// bits as in `given`. `changed` is planar.model, perhaps with more vertices and polygons.
polygons::PolygonModel in_model_frame(
    polygons::PolygonModel changed, const PlanarModel& planar, const polygons::PolygonModel& given);

/// A T-junction: a corner of one polygon that lies on a side of another polygon, between the ends of the side.
struct TJunction {
    std::size_t corner = 0; ///< index into PolygonModel::corner_vertices of the side's first corner
    std::uint32_t vertex = 0;
    double share = 0.0; ///< position along the side, 0 to 1
};

/// Finds all corners within twice the touching_reach of a side of a polygon with the same pivot. The result is ordered
/// by polygon, then along its sides; of several corners at one position it contains one.
std::vector<TJunction> t_junctions(const polygons::PolygonModel& model);

} // namespace octant::models::planar
