// The detail texture of ground, once for each pixel: scene::DetailTexture. What follows from the pattern's
// shape is written as numbers: scene::DetailPattern, scene::LandCoverContrast.
#include "picture.glsl"

layout(binding = 2) uniform sampler3D pattern;
layout(binding = 3) uniform sampler2D contrast;

const float texels_per_m = 16.0;
const float texels_a_side = 64.0;
const float min_share2_of_length = 0.125;
const float max_slant2 = 300.0;
const int first_open_mixture = 64; // those before it show crowns
const int first_mixed_pattern = 60;
const mat3 pattern_from_world = mat3( // its columns are what the world's axes are in the pattern's
    0.649782467, -0.739147362, 0.177324346,
    0.618047243, 0.377951710, -0.689325837,
    0.442493334, 0.557506666, 0.702414384);

vec3 place_in_pattern(vec3 place_m, int scale) {
    vec3 along_m = pattern_from_world * place_m;
    return detail_at_eye[scale].xyz + along_m * exp2(-2.0 * float(scale)) * texels_per_m / texels_a_side;
}

// By what share of itself each part of a colour changes. A place is in world axes with the eye at
// the origin; `across` and `down` are its changes to the pixels beside and below, `covers` the
// number of the covers, 0..1.
vec3 detail_at(vec3 place_m, vec3 across, vec3 down, float covers) {
    if (covers <= 0.0 || detail_at_eye[0].w == 0.0) {
        return vec3(0.0);
    }
    float texels_at_level_0 = detail_at_eye[0].w;
    float length2 = max(dot(across, across), dot(down, down));
    vec3 normal = cross(across, down); // as long as the area is large
    float area2 = dot(normal, normal);
    float width2 = max(sqrt(area2), min_share2_of_length * length2) * texels_at_level_0 * texels_at_level_0;
    float level = clamp(0.5 * log2(max(width2, 1.0)), 0.45, 13.99);
    int scale = int(level / 2.0);
    float through = level / 2.0 - float(scale);
    float in_scale = floor(2.0 * through + 0.5);
    int mixture = int(clamp(covers * 127.5 + 0.02, 0.0, 127.0));
    vec2 fine_of_both = textureLod(pattern, place_in_pattern(place_m, scale), in_scale).rg;
    vec2 coarse_of_both = textureLod(pattern, place_in_pattern(place_m, scale + 1), 0.0).rg;
    vec2 share = 1.0 - vec2(through * through, (1.0 - through) * (1.0 - through));
    vec2 open_and_crowns = (fine_of_both * (255.0 / 128.0) - 1.0) * share.x +
                           (coarse_of_both * (255.0 / 128.0) - 1.0) * share.y;
    // Crowns give way to the inverse of open ground.
    float past = clamp(float(mixture - first_mixed_pattern) / float(first_open_mixture - first_mixed_pattern), 0.0, 1.0);
    float sought = mixture < first_open_mixture
                       ? open_and_crowns.y * (1.0 - past * past) - open_and_crowns.x * (past * (2.0 - past))
                       : open_and_crowns.x;
    int pattern_step = int(clamp(sought * 32.0 + 32.0, 0.0, 63.0));
    float left = min(max_slant2 * area2 / (length2 * length2), 1.0);
    return left * (texelFetch(contrast, ivec2(pattern_step, mixture), 0).rgb * (1023.0 / 512.0) - 1.0);
}
