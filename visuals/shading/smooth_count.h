#pragma once

namespace octant::visuals::shading {

/// How far from the eye polygons turn flat.
struct ShadingRange {
    double near_m = 0.0;   ///< all smooth to here
    double far_m = 1000.0; ///< all flat from here; above near_m
    int levels = 0;        ///< distance counts in so many steps, at least 2; 0 = without steps
};

/// g, the smooth ones of n polygons at a distance from the eye (the paper's meaning, section 3):
/// g = round((1 - d) n), d = clamp((distance - near) / (far - near)) from 0 to 1. The nearest step
/// is all smooth, the farthest all flat.
int smooth_count(double distance_m, const ShadingRange& range, int polygons);

/// g for a device of relative speed 0 to 1 (1 = the desktop that can have all smooth): so many
/// smooth polygons as have the operations of the share r of a frame with the share r smooth,
/// g = round(r n (10 + 3 r) / 13). Gives the paper's 9 of 415 for 0.028.
int device_smooth_count(double device_ratio, int polygons);

} // namespace octant::visuals::shading
