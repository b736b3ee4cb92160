#pragma once

#include "models/heights/height_field.h"
#include "models/heights/runway_strip.h"

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace octant::models::heights {

/// Where a runway is wished for.
struct RunwayRequest {
    /// Places that are flown over. The first one, which there must be, is that of its aiming point, 300 m from its
    /// beginning.
    std::vector<glm::dvec2> path_m;
    double heading_rad = 0.0;
    /// It lies above this height.
    double water_m = 0.0;
};

/// A runway on the ground that it lies on.
struct RunwaySite {
    RunwayStrip strip;
    /// The farthest that ground is cut or heaped up for it, metres of height.
    double earthwork_m = 0.0;
    bool matches_request = false;
};

/// A wish is granted where no more earthwork than this is needed: cuttings and embankments as high as a house and 105 m
/// wide.
inline constexpr double max_earthwork_m = 15.0;

/// How far from the path another place is looked for.
inline constexpr double runway_search_radius_m = 6000.0;

/// As it is wished for, if max_earthwork_m are enough; else near the path where earthwork, way and turn are least in
/// all: a metre of earthwork counts as much as 200 m from the path to the runway's middle, 500 m from there to the
/// path's beginning or a turn by 15 degrees. The same site for the same field. Nothing where each one would leave the
/// field or touch water; whether the earthwork is too much is for the caller to say.
std::optional<RunwaySite> runway_site(const HeightField& field, const RunwayRequest& wish);

} // namespace octant::models::heights
