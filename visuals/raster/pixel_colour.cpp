#include "visuals/raster/pixel_colour.h"

#include "visuals/raster/triangle.h"
#include "visuals/raster/triangle_planes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::visuals::raster {

namespace {

constexpr double per_level = 16.0;
constexpr double max_colour_level = 255.0;
constexpr double min_inverse_w = 1e-30;

std::uint16_t packed(double level) {
    return static_cast<std::uint16_t>(std::clamp(level, 0.0, max_colour_level) * per_level + 0.5);
}

PixelColour gouraud_colour(const Triangle& triangle, int column, int row) {
    const auto part = [&](std::size_t i) { return sixteenths_of(triangle.gradients.level(i, {column, row})); };
    return {part(0), part(1), part(2)};
}

double depth_of(const TriangleExtra& extra, int column, int row) {
    return 1.0 / std::max(extra.over_w[4].at(column, row), min_inverse_w);
}

PixelColour perspective_colour(const TileTriangle& one, int column, int row) {
    const double w = depth_of(*one.extra, column, row);
    PixelColour colour;
    for (std::size_t i = 0; i < 3; ++i) {
        const ColourGradients& levels = one.triangle->gradients;
        const double level = one.extra->over_w[i].at(column, row) * w;
        colour[i] = packed(std::clamp(level, levels.min[i] / 128.0 + 128.0, levels.max[i] / 128.0 + 128.0));
    }
    return colour;
}

/// The texture's colour between the four texels around a place of one level.
std::array<double, 3> texel_at(const LitGroundTexture::MipLevel& level, double x, double y) {
    const double within_x = std::clamp(x, 0.0, level.width - 1.0);
    const double within_y = std::clamp(y, 0.0, level.height - 1.0);
    const int x0 = std::min(static_cast<int>(within_x), std::max(level.width - 2, 0));
    const int y0 = std::min(static_cast<int>(within_y), std::max(level.height - 2, 0));
    const int x1 = std::min(x0 + 1, level.width - 1);
    const int y1 = std::min(y0 + 1, level.height - 1);
    const double right = within_x - x0;
    const double up = within_y - y0;
    const auto texel = [&](int column, int row) { return level.texels[level.number(column, row)]; };
    const std::array corners{texel(x0, y0), texel(x1, y0), texel(x0, y1), texel(x1, y1)};
    const std::array weights{(1.0 - right) * (1.0 - up), right * (1.0 - up), (1.0 - right) * up, right * up};
    std::array<double, 3> sum{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        for (std::size_t i = 0; i < 3; ++i) { sum[i] += weights[k] * (corners[k] >> (8 * i) & 0xffU); }
    }
    return sum;
}

/// The colour of textured ground at a pixel: the mean over its places in the texture, under light and behind haze.
PixelColour textured_colour(
    const ColourGradients& planes, const MipSelection& chosen, const TileJob& job, const glm::ivec2& at) {
    const auto& levels = job.ground->levels();
    const double fine_scale = static_cast<double>(std::uint64_t{1} << chosen.fine);
    const auto place = [&](std::size_t i) { // texels of the finest level
        return (static_cast<std::int32_t>(planes.wrapped(i, at)) / 65536.0 + 128.5) * fine_scale - 0.5;
    };
    const auto share = [&](std::size_t i) {
        return (planes.level(i, at) / 128.0 + 128.0) / static_cast<double>(TexturePlanes::whole_share);
    };
    const auto at_level = [&](std::size_t k, double x, double y) {
        const double scale = 1.0 / static_cast<double>(std::uint64_t{1} << k);
        return texel_at(levels[k], (x + 0.5) * scale - 0.5, (y + 0.5) * scale - 0.5);
    };
    std::array<double, 3> own{};
    for (int probe = 0; probe < chosen.probes; ++probe) {
        const double far = chosen.probes > 1 ? 2.0 * probe / (chosen.probes - 1) - 1.0 : 0.0;
        const double x = place(0) + far * static_cast<double>(chosen.reach[0]);
        const double y = place(1) + far * static_cast<double>(chosen.reach[1]);
        const std::array<double, 3> fine = at_level(chosen.fine, x, y);
        std::array<double, 3> coarse = fine;
        if (chosen.coarse_share > 0) { coarse = at_level(std::size_t{chosen.fine} + 1, x, y); }
        for (std::size_t i = 0; i < 3; ++i) {
            const double one = fine[i] + chosen.coarse_share / 65536.0 * (coarse[i] - fine[i]);
            own[i] += one / chosen.probes;
        }
    }
    PixelColour colour;
    for (std::size_t i = 0; i < 3; ++i) {
        const double lit = own[i] * std::clamp(share(2), 0.0, 1.0);
        const auto haze = static_cast<double>(job.haze[static_cast<glm::length_t>(i)]);
        colour[i] = packed(lit + std::clamp(share(3), 0.0, 1.0) * (haze - lit));
    }
    return colour;
}

/// Six hues around the wheel, one a level, so that neighbours are far apart; 0..1.
std::array<double, 3> hue_of(float level) {
    const double turn = std::floor(static_cast<double>(level) + 0.25) * 5.0 / 12.0;
    const double sixths = (turn - std::floor(turn)) * 6.0;
    std::array<double, 3> hue;
    for (std::size_t i = 0; i < 3; ++i) {
        const double from = std::fmod(sixths + std::array{0.0, 4.0, 2.0}[i], 6.0);
        hue[i] = std::clamp(std::abs(from - 3.0) - 1.0, 0.0, 1.0);
    }
    return hue;
}

double smoothstep(double end, double x) {
    const double t = std::clamp(x / end, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Levels, darkened towards the triangle's edges over about a pixel.
PixelColour wireframe_colour(const TileTriangle& one, const TileJob& job, int column, int row) {
    const TriangleExtra& extra = *one.extra;
    const double w = depth_of(extra, column, row);
    double inside = 1.0;
    for (const AttributePlane& edge : extra.from_edges) {
        const double from = edge.at(column, row) * w;
        const double across = std::abs(edge.per_x - from * extra.over_w[4].per_x) * w;
        const double down = std::abs(edge.per_y - from * extra.over_w[4].per_y) * w;
        inside = std::min(inside, smoothstep(std::max(1.2 * (across + down), 1e-12), from));
    }
    const std::array<double, 3> hue = hue_of(extra.mesh_level);
    const double hue_share = job.tints_mesh_levels ? 0.45 : 0.0;
    PixelColour colour = perspective_colour(one, column, row);
    for (std::size_t i = 0; i < 3; ++i) {
        const double own = colour[i] / per_level;
        const double filled = own + hue_share * (hue[i] * max_colour_level - own);
        colour[i] = packed(filled * (0.25 + 0.75 * inside));
    }
    return colour;
}

float dot(const std::array<float, 3>& a, const std::array<float, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A value of three corners, each times its weight.
template <class Part>
std::array<float, 3> mixed(const TriangleExtra& extra, const std::array<float, 3>& weights, Part part) {
    std::array<float, 3> sum{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::array<float, 3>& own = extra.lit[k]->*part;
        for (std::size_t i = 0; i < 3; ++i) { sum[i] += weights[k] * own[i]; }
    }
    return sum;
}

/// The cosine between the mirrored light and the way to the eye to the power of the highlight. `normal` and `to_eye` of
/// any length, `towards_sun` their dot product with the light.
float highlight(const std::array<float, 3>& normal, const std::array<float, 3>& to_eye,
    const std::array<float, 3>& to_sun, float towards_sun) {
    const float mirrored = 2.0F * towards_sun * dot(normal, to_eye) / dot(normal, normal) - dot(to_sun, to_eye);
    if (!(mirrored > 0.0F)) { return 0.0F; }
    float base = std::min(mirrored / std::sqrt(dot(to_eye, to_eye)), 1.0F);
    float power = 1.0F;
    for (int exponent = scene::Highlight::power; exponent > 0; exponent /= 2) {
        power *= exponent % 2 == 1 ? base : 1.0F;
        base *= base;
    }
    return power;
}

} // namespace

/// Phong's shading: normals between the corners, light in the pixel.
PixelColour lit_colour_of(
    const TileTriangle& one, const TileJob& job, const glm::ivec2& at, const std::array<float, 3>& texel) {
    const TriangleExtra& extra = *one.extra;
    // Beyond an edge, where only a pixel's samples are covered, the edge's colour.
    std::array<float, 3> weights;
    float sum = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
        weights[k] = static_cast<float>(std::max(extra.from_edges[k].at(at.x, at.y), 0.0));
        sum += weights[k];
    }
    float transmittance = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
        weights[k] = sum > 0.0F ? weights[k] / sum : 1.0F / 3.0F;
        transmittance += weights[k] * extra.lit[k]->transmittance;
    }
    const Light& light = *job.light;
    const std::array to_sun{light.to_sun.x, light.to_sun.y, light.to_sun.z};
    const auto normal = mixed(extra, weights, &LitVertex::normal);
    const float length = std::sqrt(dot(normal, normal));
    const float towards_sun = dot(normal, to_sun);
    float diffuse = 0.0F;
    float specular = 0.0F;
    if (towards_sun > 0.0F && length > 0.0F) {
        diffuse = towards_sun / length;
        specular = scene::Highlight::share * static_cast<float>(max_colour_level) *
                   highlight(normal, mixed(extra, weights, &LitVertex::to_eye), to_sun, towards_sun);
    }
    const auto own = mixed(extra, weights, &LitVertex::rgb);
    const auto haze = mixed(extra, weights, &LitVertex::haze);
    PixelColour colour;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto part = static_cast<glm::length_t>(i);
        const float lit = own[i] * texel[i] * (light.ambient[part] + light.sunlight[part] * diffuse) +
                          light.sunlight[part] * specular;
        const float seen = std::min(lit, static_cast<float>(max_colour_level)) * transmittance + haze[i];
        colour[i] = packed(static_cast<double>(seen));
    }
    return colour;
}

PixelColour colour_of(const TileTriangle& one, const TileJob& job, int column, int row) {
    switch (one.triangle->fill) {
    case Fill::Perspective:
        return perspective_colour(one, column, row);
    case Fill::Texture:
        return textured_colour(one.triangle->gradients, one.triangle->texture, job, {column, row});
    case Fill::TextureInPerspective: {
        const TexturePlanes planes = fit_texture_planes(*one.extra, {column, row, 1, 1}, job.ground->levels().size());
        return textured_colour(planes.gradients, planes.mip_selection, job, {column, row});
    }
    case Fill::MeshEdges:
        return wireframe_colour(one, job, column, row);
    case Fill::Lit:
        return lit_colour_of(one, job, {column, row}, {1.0F, 1.0F, 1.0F});
    case Fill::Gouraud:
    case Fill::Transparent:
        break;
    }
    return gouraud_colour(*one.triangle, column, row);
}

std::uint32_t overlay_colour_of(const TileTriangle& one, int column, int row) {
    std::uint32_t colour = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::int32_t level = one.triangle->gradients.level(i, {column, row});
        colour |= static_cast<std::uint32_t>((level + 128 * 128 + 64) >> 7) << (8 * i);
    }
    return colour;
}

} // namespace octant::visuals::raster
