#pragma once

namespace octant::visuals::nature {

/// What grows where, and from where snow stays, by height above the water level.
struct Climate {
    float tree_line_m = 1500.0F;
    float snow_line_m = 2350.0F;
    bool arid = false;
    float poleward = 0.0F; ///< 1 where north is the shaded side, -1 where south is; 0 = no side
};

/// Of a place on the earth, degrees.
Climate climate_of(double latitude_deg, double longitude_deg);

} // namespace octant::visuals::nature
