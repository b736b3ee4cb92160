// The air between the eye and a place: scene::Haze. A place is in world axes, the eye at the origin.
#include "picture.glsl"

// Red, green and blue of the haze, and its share of the colour.
vec4 haze_before(vec3 place_m) {
    float distance_m = max(length(place_m), 1e-6);
    float fallen = place_m.z * haze_sunward.w;
    float left = exp(-abs(fallen));
    float mean = (1.0 - left) / max(abs(fallen), 4e-3);
    float density = abs(fallen) < 4e-3 ? 1.0 - 0.5 * fallen : fallen > 0.0 ? mean : mean / left;
    float towards = max(dot(place_m, haze_to_sun.xyz) / distance_m, 0.0);
    return vec4(
        mix(haze.rgb, haze_sunward.rgb, towards * towards), 1.0 - exp(-distance_m * haze.w * density));
}
