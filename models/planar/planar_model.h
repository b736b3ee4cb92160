#pragma once

#include "models/planar/incidences.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace octant::models::planar {

/// Polygons flatter than this are left as they are; of others that become planar no corner is farther from the plane.
/// In the unit of the points.
inline constexpr double planar_noise = 1e-10;

/// Moves points, none farther than `max_move`, until the corners of each polygon lie in one plane and what touches it
/// lies there, too. Polygons for which that fails give up first what touches them, then their own plane; they are told
/// by `true` in the result.
std::vector<bool> planarize(std::vector<glm::dvec3>& points, std::span<const Incidence> incidences, double max_move);

/// The largest power of ten of which all coordinates are multiples but for rounding; 0 where there is none.
double decimal_grid(std::span<const glm::dvec3> points);

/// What lies nearer to a plane than this lies on it, in radii of the model. Planar models keep it with ten times less
/// noise.
inline constexpr double planar_tolerance = 1e-9;

/// What lies nearer than this is meant to touch, in radii of the model. Files with six decimals or in single precision
/// are no finer, and of a model that was turned nobody can tell how finely it was written.
inline constexpr double touching_reach = 1e-6;

/// A polygon model about the middle of its bounding box, in units of its radius there, with planar convex polygons.
struct PlanarModel {
    /// Its lengths are in radii, its axes are the columns of `axes`. Vertices keep their numbers; polygons that could
    /// not become planar are cut, which its parents tell; those without an area are missing. It may be empty.
    polygons::PolygonModel model;
    glm::dmat3 axes{1.0};
    double radius_m = 1.0;

    /// The step of the decimals of the model as given, of which all coordinates are multiples; 0 where there is none.
    double grid_m = 0.0;
    /// A point near the model in these steps, in metres where there is none; from there the centre in own axes, and the
    /// radius. Kept apart, so that far away no digits are lost.
    glm::dvec3 base_steps{0.0};
    glm::dvec3 centre_steps{0.0};
    double radius_steps = 1.0;

    double step_m() const { return grid_m > 0.0 ? grid_m : 1.0; }

    /// From radii to the place, size, attitude and unit of the model as given.
    glm::dvec3 to_model_frame(const glm::dvec3& point) const {
        return (base_steps + axes * (centre_steps + point * radius_steps)) * step_m();
    }

    Plane to_model_frame(const Plane& plane) const {
        const glm::dvec3 normal = axes * plane.normal;
        return {normal, plane.offset_m * radius_m - glm::dot(normal, to_model_frame(glm::dvec3(0.0)))};
    }

    /// How many polygons were bent or dented by more than touching_reach and are cut into pieces. Smaller faults come
    /// from the decimals of a file; their polygons are cut, but not counted.
    int triangulated_polygons = 0;
    int dropped_polygons = 0; ///< How many had no area and are left out.
};

/// Which axes a planar model has: its own (own_axes.h), so that a model that is turned becomes the same, or those of
/// the model as given.
enum class Attitude { Own, Given };

/// Makes a model planar (README.md has the rules). The model has finite coordinates.
PlanarModel planar_model(const polygons::PolygonModel& model, Attitude attitude = Attitude::Own);

/// Back to the place, size, attitude and unit of the model as given: vertices that planar_model() did not move have the
/// same bits as there. `changed` is the model of `planar`, or what was made of it by adding vertices and polygons.
polygons::PolygonModel in_model_frame(
    polygons::PolygonModel changed, const PlanarModel& planar, const polygons::PolygonModel& given);

} // namespace octant::models::planar
