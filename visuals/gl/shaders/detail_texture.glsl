// The detail texture of ground, once for each pixel: scene::DetailTexture. What follows from the pattern's
// shape is written as numbers: scene::DetailPattern, scene::LandCoverContrast.
#include "picture.glsl"

layout(binding = 2) uniform sampler2D pattern;
layout(binding = 3) uniform sampler2D contrast;

const float texels_per_m = 8.0;
const float texels_a_side = 512.0;
const vec2 lean = vec2(0.22, -0.27);

const float upright_from = 0.8;

// In which of the pattern's directions, east and north, steep ground shows it upright.
bvec2 upright_of(vec3 across, vec3 down) {
    vec3 normal = cross(across, down);
    vec3 normal2 = normal * normal;
    bool is_steep = normal2.x + normal2.y > upright_from * upright_from * normal2.z;
    bool is_east = normal2.x >= normal2.y;
    return bvec2(is_steep && is_east, is_steep && !is_east);
}

// At odd scales the pattern is turned by a right angle, and leans the other way.
vec2 place_in_pattern(vec3 place_m, bvec2 upright, int scale) {
    bool is_even = scale % 2 == 0;
    vec2 level_m = place_m.xy + (is_even ? lean : -lean) * place_m.z;
    vec2 turned_m = is_even ? level_m : vec2(level_m.y, -level_m.x);
    vec2 up = is_even ? vec2(1.0) : vec2(1.0, -1.0);
    bvec2 is_upright = is_even ? upright : upright.yx;
    turned_m = mix(turned_m, place_m.z * up, is_upright);
    vec2 at_eye = mix(vec2(detail_x[scale], detail_y[scale]), detail_up[scale] * up, is_upright);
    return at_eye + turned_m * exp2(-4.0 * float(scale)) * texels_per_m / texels_a_side;
}

// By what share of itself each part of a colour changes. A place is in world axes with the eye at
// the origin; `across` and `down` are its changes to the pixels beside and below, `covers` the
// number of the covers, 0..1.
vec3 detail_at(vec3 place_m, vec3 across, vec3 down, float covers) {
    if (covers <= 0.0 || detail_x[0] < 0.0) {
        return vec3(0.0);
    }
    // Half a level finer than usual: the pattern's finest features are two texels wide.
    float width2 = max(dot(across, across), 0.5 * dot(down, down)) * texels_per_m * texels_per_m;
    float level = clamp(0.5 * log2(max(width2, 1.0)), 0.0, 11.99);
    int scale = int(level / 4.0);
    float through = level / 4.0 - float(scale);
    // Most pixels take one level: the next one comes in over a third of the way only.
    float in_scale = 4.0 * through;
    float whole = floor(in_scale);
    in_scale = whole + clamp(3.0 * (in_scale - whole) - 1.0, 0.0, 1.0);
    bvec2 upright = upright_of(across, down);
    float fine = textureLod(pattern, place_in_pattern(place_m, upright, scale), in_scale).r;
    float coarse = textureLod(pattern, place_in_pattern(place_m, upright, scale + 1), 0.0).r;
    vec2 sought = (vec2(fine, coarse) * (255.0 / 128.0) - 1.0) *
                  (1.0 - vec2(through * through, (1.0 - through) * (1.0 - through)));
    ivec2 entry = ivec2(
        clamp((sought.x + sought.y) * 32.0 + 32.0, 0.0, 63.0), clamp(covers * 127.5 + 0.02, 0.0, 127.0));
    return texelFetch(contrast, entry, 0).rgb * (1023.0 / 512.0) - 1.0;
}
