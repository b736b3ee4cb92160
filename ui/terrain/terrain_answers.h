#pragma once

#include "visuals/terrain/earth_drop.h"
#include "visuals/terrain/ground_samples.h"
#include "visuals/terrain/mesh_surface.h"

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

/// A place that is asked about, world axes, metres.
struct AskedPoint {
    double x_m = 0.0;
    double y_m = 0.0;
    std::optional<double> z_m;
};

/// "X,Y" or "X,Y,Z"; nothing for anything else.
std::optional<AskedPoint> point_from_text(std::string_view text);

/// One point a line; lines that begin with # are passed over, so is a first line of names. Throws
/// Error with the line of a wrong one.
std::vector<AskedPoint> read_points(const std::filesystem::path& file);

struct PointAnswer {
    AskedPoint asked;
    std::optional<double> ground_m; ///< nothing outside the map or the mesh
};

struct SightAnswer {
    bool visible = true;
    std::optional<glm::dvec3> hidden_at_m; ///< the first ground that hides
    std::optional<double> clearance_m;     ///< least height of the line above the ground
    std::optional<glm::dvec3> lowest_at_m; ///< the ground there
};

struct Answers {
    std::vector<PointAnswer> points;
    std::optional<SightAnswer> sight;
};

std::vector<PointAnswer>
answers_of(const visuals::terrain::GroundSamples& ground, std::span<const AskedPoint> points);

/// Ground as it is drawn for an eye point.
struct DrawnGround {
    visuals::terrain::MeshSurface surface;
    glm::dvec3 eye_m{0.0};       ///< world
    double earth_radius_m = 0.0; ///< by which it sinks away from the eye; 0 = flat

    /// How far it is drawn below its height above datum.
    double drop_m(const glm::dvec2& at_m) const {
        const glm::dvec2 away_m = at_m - glm::dvec2(eye_m);
        return visuals::terrain::earth_drop_m(glm::dot(away_m, away_m), earth_radius_m);
    }
};

/// Where the asked points lie over the ground as its mesh is drawn; heights are above datum.
std::vector<PointAnswer>
answers_as_drawn(const DrawnGround& drawn, std::span<const AskedPoint> points);

/// `radius_m`: of the earth, 0 = flat.
SightAnswer sight_over(
    const visuals::terrain::GroundSamples& ground,
    const glm::dvec3& from_m,
    const glm::dvec3& to_m,
    double radius_m);

/// Straight between the ends where they are drawn.
SightAnswer
sight_as_drawn(const DrawnGround& drawn, const glm::dvec3& from_m, const glm::dvec3& to_m);

/// CSV, or one JSON object with "points" and "sight".
std::string text_of_answers(const Answers& answers, bool json);

} // namespace octant::ui::terrain
