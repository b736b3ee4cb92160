#pragma once

#include "sim/base/earth_frame.h"

#include <glm/vec3.hpp>

#include <optional>

namespace octant::visuals::nature {

/// What grows where, and from where snow stays, by height above the water level.
struct Climate {
    float tree_line_m = 1500.0F;
    float snow_line_m = 2350.0F;
    float dryness = 0.0F;     ///< 1 in deserts, about a half in steppes, 0 where woods and fields grow
    float shaded_side = 0.0F; ///< 1 where north is the shaded side, -1 where south is; 0 = no side
    /// Display colour of the dust on another planet or moon, where there is nothing else: no water, plants, snow or
    /// people. Nothing on the earth.
    std::optional<glm::vec3> dust = {};
    bool has_dusty_air = false; ///< as Mars has

    bool is_arid() const { return dryness > 0.75F; }
};

/// Of a place on the earth, degrees.
Climate climate_of(double latitude_deg, double longitude_deg);

/// Of a planet or moon that is not the earth: rust on Mars, grey elsewhere.
Climate extraterrestrial_climate(const Ellipsoid& ellipsoid);

} // namespace octant::visuals::nature
