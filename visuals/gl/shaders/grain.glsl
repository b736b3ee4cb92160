// The fine pattern of ground, once for each pixel: scene::Grain. What follows from the pattern's
// shape is written as numbers: scene::GrainPattern, scene::CoverContrast.
#include "picture.glsl"

layout(binding = 2) uniform sampler2D pattern;
layout(binding = 3) uniform sampler2D contrast;

const float texels_per_m = 8.0;
const float texels_a_side = 1024.0;
const vec2 lean = vec2(0.22, -0.27);

vec2 place_in_pattern(vec3 place_m, int scale) {
    bool is_even = scale % 2 == 0;
    vec2 level_m = place_m.xy + (is_even ? lean : -lean) * place_m.z;
    vec2 turned_m = is_even ? level_m : vec2(level_m.y, -level_m.x);
    vec2 at_eye = vec2(grain_x[scale], grain_y[scale]);
    return at_eye + turned_m * exp2(-4.0 * float(scale)) * texels_per_m / texels_a_side;
}

// By what share of itself each part of a colour changes. A place is in world axes with the eye at
// the origin; `across` and `down` are its changes to the pixels beside and below, `covers` the
// number of the covers, 0..1.
vec3 grain_at(vec3 place_m, vec3 across, vec3 down, float covers) {
    if (covers <= 0.0 || grain_x[0] < 0.0) {
        return vec3(0.0);
    }
    // Half a level finer than usual: the pattern's finest features are two texels wide.
    float width2 = max(dot(across, across), 0.5 * dot(down, down)) * texels_per_m * texels_per_m;
    float level = clamp(0.5 * log2(max(width2, 1.0)), 0.0, 11.99);
    int scale = int(level / 4.0);
    float through = level / 4.0 - float(scale);
    float fine = textureLod(pattern, place_in_pattern(place_m, scale), 4.0 * through).r;
    float coarse = textureLod(pattern, place_in_pattern(place_m, scale + 1), 0.0).r;
    vec2 sought = (vec2(fine, coarse) * (255.0 / 128.0) - 1.0) *
                  (1.0 - vec2(through * through, (1.0 - through) * (1.0 - through)));
    ivec2 entry = ivec2(
        clamp((sought.x + sought.y) * 32.0 + 32.0, 0.0, 63.0), clamp(covers * 127.5 + 0.02, 0.0, 127.0));
    return texelFetch(contrast, entry, 0).rgb;
}
