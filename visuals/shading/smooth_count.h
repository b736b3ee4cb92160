#pragma once

namespace octant::visuals::shading {

/// The distances from the eye between which polygons turn from smooth to flat.
struct ShadingRange {
    double near_m = 0.0;   ///< Up to this distance all polygons are smooth.
    double far_m = 1000.0; ///< From this distance on all polygons are flat; above near_m.
    int levels = 0;        ///< The distance is rounded to so many steps, at least 2; 0 = not rounded.
};

/// g, how many of n polygons are smooth at a distance from the eye (section 3 of the paper): g = round((1 - d) n) with
/// d = clamp((distance - near) / (far - near), 0, 1). With levels, the nearest step is all smooth and the farthest all
/// flat.
int smooth_count(double distance_m, const ShadingRange& range, int polygons);

/// g for a device of relative speed r = `device_ratio`, 0 to 1, where 1 is the desktop that can shade everything
/// smoothly: as many smooth polygons as use up the operations that r of a frame with a share r of smooth polygons has,
/// g = round(r n (10 + 3 r) / 13). For r = 0.028 this gives the paper's 9 of 415.
int device_smooth_count(double device_ratio, int polygons);

} // namespace octant::visuals::shading
