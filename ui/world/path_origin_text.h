#pragma once

#include "sim/base/earth_frame.h"
#include "ui/settings/settings.h"

#include <glm/vec2.hpp>

#include <string>

namespace octant::ui::world {

/// Where --place puts the path's origin, metres east and north of the map centre. Two numbers are
/// degrees when they carry letters (49.3N,123.1W) or when the map has a place on the earth and they
/// lie on it as latitude,longitude; otherwise metres. `map_frame` is null for a map without one.
/// Throws Error for other text and for degrees on a map without a place.
glm::dvec2 path_origin_from_text(
    const std::string& text, const EarthFrame* map_frame, const glm::dvec2& half_extent_m);

/// Before anything is loaded: throws Error where path_origin_from_text would for this ground whatever its
/// extent. Reads no more of a map than where it lies.
void check_path_origin(const settings::PathSettings& settings);

} // namespace octant::ui::world
