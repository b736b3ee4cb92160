#pragma once

#include "ui/report/table.h"
#include "visuals/terrain/frustum.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/mesh_measurement.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::terrain {

/// A point whose ground height is asked for: world axes, metres.
struct QueryPoint {
    double x_m = 0.0;
    double y_m = 0.0;
    std::optional<double> z_m;
};

/// "X,Y" or "X,Y,Z"; nothing for anything else.
std::optional<QueryPoint> point_from_text(std::string_view text);

/// Reads a point from each line. Skips lines that begin with # and a header line. Throws Error with the line of an
/// invalid point.
std::vector<QueryPoint> read_points(const std::filesystem::path& file);

struct QueryPointResult {
    double x_m = 0.0; ///< as QueryPoint
    double y_m = 0.0;
    std::optional<double> z_m;
    std::optional<double> ground_m;       ///< nothing outside the map or the mesh
    std::optional<double> above_ground_m; ///< of z_m
};

/// The result for a point whose ground has that height.
QueryPointResult answer_of(const QueryPoint& point, const std::optional<double>& ground_m);

/// The columns of a result.
std::span<const report::Column<QueryPointResult>> query_columns();

struct LineOfSightAnswer {
    bool visible = true;
    std::optional<glm::dvec3> blocked_at_m;       ///< the first ground that the line meets
    std::optional<double> clearance_m;            ///< least height of the line above the ground
    std::optional<glm::dvec3> min_clearance_at_m; ///< the ground there
};

struct QueryResults {
    std::vector<QueryPointResult> points;
    std::optional<LineOfSightAnswer> sight;
};

std::vector<QueryPointResult> ground_heights_at(
    const visuals::terrain::GroundSamples& ground, std::span<const QueryPoint> points);

/// Ground as it is drawn for an eye point.
struct DrawnMesh {
    visuals::terrain::MeshSurface surface;
    glm::dvec3 eye_m{0.0};       ///< world
    double earth_radius_m = 0.0; ///< the mesh is lowered with distance by this radius; 0 = flat

    /// How far the mesh is lowered at a point, metres.
    double drop_m(const glm::dvec2& at_m) const {
        const glm::dvec2 away_m = at_m - glm::dvec2(eye_m);
        return visuals::terrain::curvature_drop_m(glm::dot(away_m, away_m), earth_radius_m);
    }
};

/// Heights of the drawn mesh at the points, above datum.
std::vector<QueryPointResult> drawn_heights_at(const DrawnMesh& drawn, std::span<const QueryPoint> points);

/// Over a sphere of that radius; 0 = flat.
LineOfSightAnswer line_of_sight_answer(
    const visuals::terrain::GroundSamples& ground, const glm::dvec3& from_m, const glm::dvec3& to_m, double radius_m);

/// Over the drawn mesh, with both ends lowered as the mesh is.
LineOfSightAnswer drawn_line_of_sight(const DrawnMesh& drawn, const glm::dvec3& from_m, const glm::dvec3& to_m);

/// CSV, or one JSON object with "points" and "sight".
std::string query_text(const QueryResults& answers, bool json);

} // namespace octant::ui::terrain
