// Pictures on aircraft: scene::ModelBuffers::textures. They lie in buffers, because a draw shows any number of them, of
// any sizes, in painting order.

struct Texture {
    uint first_level;
    uint level_count;
    uint modes; // wrap of u and of v, two bits each (repeat, clamp, mirror), then alpha (opaque, mask, blend)
    float threshold; // of a mask
};

struct TextureLevel {
    uint first_texel;
    uint width;
    uint height;
    uint unused;
};

layout(std430, binding = 2) readonly buffer Textures {
    Texture textures[];
};

layout(std430, binding = 3) readonly buffer TextureLevels {
    TextureLevel texture_levels[];
};

layout(std430, binding = 4) readonly buffer Texels {
    uint texels[]; // red in the lowest byte, then green, blue, alpha
};

const uint wrap_clamp = 1u;
const uint wrap_mirror = 2u;
const uint alpha_mask = 1u;
const uint alpha_blend = 2u;

// A coordinate brought near 0..1 without a change of what it shows.
float near_picture(float place, uint mode) {
    return mode == wrap_clamp ? clamp(place, -1.0, 2.0)
           : mode == wrap_mirror ? place - 2.0 * floor(0.5 * place) : fract(place);
}

int wrapped(int at, int count, uint mode) {
    if (mode == wrap_clamp) {
        return clamp(at, 0, count - 1);
    }
    int period = mode == wrap_mirror ? 2 * count : count;
    int inside = at % period;
    inside = inside < 0 ? inside + period : inside;
    return inside < count ? inside : period - 1 - inside;
}

// The mean of four texels by distance, of their colours also by alpha.
vec4 on_level(Texture shown, uint number, vec2 place) {
    TextureLevel level = texture_levels[shown.first_level + number];
    ivec2 size = ivec2(level.width, level.height);
    vec2 at = place * vec2(size) - 0.5;
    ivec2 first = ivec2(floor(at));
    vec2 share = at - vec2(first);
    vec4 sum = vec4(0.0);
    vec3 plain = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 off = ivec2(i & 1, i >> 1);
        int x = wrapped(first.x + off.x, size.x, shown.modes & 3u);
        int y = wrapped(first.y + off.y, size.y, shown.modes >> 2 & 3u);
        vec4 texel = unpackUnorm4x8(texels[level.first_texel + uint(y * size.x + x)]);
        float weight = (off.x == 1 ? share.x : 1.0 - share.x) * (off.y == 1 ? share.y : 1.0 - share.y);
        sum += weight * vec4(texel.rgb * texel.a, texel.a);
        plain += weight * texel.rgb;
    }
    return vec4(sum.a > 0.0 ? sum.rgb / sum.a : plain, sum.a);
}

// Half the logarithm to base 2, linear between powers of two.
float half_log2(float number) {
    return float(floatBitsToInt(number) - (127 << 23)) * exp2(-24.0);
}

// The colour of a picture and how much of it is there. `across` and `down`: the change of its place by a pixel. What is
// taken of the picture is that of the raster renderer (MeshFootprint): of a footprint that is longer than wide, a few
// places along its length at the level of its width; else one place, between two levels the mixture of both.
vec4 shown_by(Texture shown, vec2 place, vec2 across, vec2 down) {
    const float longer = 1.5; // than wide, where two places begin
    TextureLevel finest = texture_levels[shown.first_level];
    vec2 size = vec2(finest.width, finest.height);
    vec2 right = across * size;
    vec2 below = down * size;
    float right2 = dot(right, right);
    float below2 = dot(below, below);
    float length2 = max(right2, below2);
    float area = abs(right.x * below.y - right.y * below.x);
    bool is_long = length2 > 1.0 && longer * area < length2;
    float width = max(area / max(length2, 1.0), 1.0 / 3.0); // of a place, in lengths
    width = width * width * length2 < 1.0 ? inversesqrt(max(length2, 1.0)) : width; // no finer than the finest level
    width = is_long ? width : 1.0;
    float last = float(shown.level_count - 1u);
    float level = min(half_log2(max(width * width * length2, 1.0)), last);
    float coarse_share = clamp(3.0 * (fract(level) - 0.5) + 0.5, 0.0, 1.0);
    bool is_next = coarse_share >= (is_long ? 0.5 : 1.0);
    float taken = min(floor(level) + (is_next ? 1.0 : 0.0), last);
    bool has_next = taken < last;
    bool has_several = is_long && has_next && longer * width < 1.0;
    int places = has_several ? ((longer + 1.0) * width < 1.0 ? 3 : 2) : 1;
    vec2 reach = has_several ? 0.5 * (1.0 - width) * (right2 > below2 ? across : down) : vec2(0.0);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < places; ++i) {
        float far = places == 1 ? 0.0 : 2.0 * float(i) / float(places - 1) - 1.0;
        vec2 at = place + far * reach;
        vec2 near = vec2(near_picture(at.x, shown.modes & 3u), near_picture(at.y, shown.modes >> 2 & 3u));
        vec4 colour = on_level(shown, uint(taken), near);
        if (!is_long && !is_next && has_next && coarse_share > 0.0) {
            colour = mix(colour, on_level(shown, uint(taken) + 1u, near), coarse_share);
        }
        sum += colour;
    }
    return sum / float(places);
}
