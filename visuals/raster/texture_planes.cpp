// Planes of textured triangles: for a whole triangle, from its vertices, and for some of its pixels. The first is
// compiled once for each instruction set; all give the same bits, because real numbers are summed and multiplied one by
// one.
#include "visuals/raster/texture_planes.h"

// SVE's vectors have no size that the compiler knows: they can be no members.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#define HWY_BROKEN_EMU128 0 // compiled so that it is right, see CMakeLists.txt
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visuals/raster/texture_planes.cpp"
// clang-format off: foreach_target.h must come before all that includes highway.h
#include <hwy/foreach_target.h>
// clang-format on

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Pair = hn::FixedTag<double, 2>;
using Four = hn::FixedTag<float, 4>; ///< the values of a corner
using Vertices = std::array<const ScreenVertex*, 3>;

constexpr float max_texels_wrong = 1.0F / 32.0F; ///< of the fine level
constexpr float max_share_wrong = 1.0F / 512.0F; ///< of light and haze

constexpr double steps_per_px = ScreenVertex::per_px;

/// Thinner triangles have gradients of rounding alone, 1/256 pixel.
constexpr double min_thickness = 16.0;

/// From a corner to each of the next: its values' differences.
struct Steps {
    hn::Vec<Four> to_second;
    hn::Vec<Four> to_third; ///< from the second
    hn::Vec<Four> to_first; ///< from the third

    HWY_INLINE explicit Steps(const Vertices& vertices) {
        const auto first = values(*vertices[0]);
        const auto second = values(*vertices[1]);
        const auto third = values(*vertices[2]);
        to_second = hn::Sub(second, first);
        to_third = hn::Sub(third, second);
        to_first = hn::Sub(first, third);
    }

    static HWY_INLINE hn::Vec<Four> values(const ScreenVertex& vertex) {
        return hn::LoadU(Four(), vertex.value.data());
    }
};

/// How far exact values lie beyond affine ones: from the least to the most, at the corners (0) and at the edges'
/// middles, where they differ most.
struct Bend {
    hn::Vec<Four> least;
    hn::Vec<Four> most;

    HWY_INLINE Bend(const Vertices& vertices, const Steps& steps) {
        const Four four;
        const float a = vertices[0]->inverse_w;
        const float b = vertices[1]->inverse_w;
        const float c = vertices[2]->inverse_w;
        alignas(16) const std::array from{a, b, c, a};
        alignas(16) const std::array to{b, c, a, b};
        const auto at_from = hn::Load(four, from.data());
        const auto at_to = hn::Load(four, to.data());
        const auto sum = hn::Add(at_to, at_from);
        const auto share = hn::Div(hn::Sub(at_to, at_from), hn::Add(sum, sum));
        const auto second = hn::Mul(steps.to_second, hn::Broadcast<0>(share));
        const auto third = hn::Mul(steps.to_third, hn::Broadcast<1>(share));
        const auto first = hn::Mul(steps.to_first, hn::Broadcast<2>(share));
        const auto none = hn::Zero(four);
        least = hn::Min(hn::Min(first, second), hn::Min(third, none));
        most = hn::Max(hn::Max(first, second), hn::Max(third, none));
    }

    HWY_INLINE hn::Vec<Four> size() const { return hn::Sub(most, least); }

    HWY_INLINE hn::Vec<Four> doubled_middle() const { return hn::Add(most, least); }
};

/// How many texels a pixel is wide in a thin triangle.
double thin_footprint(const Vertices& vertices, double reach) {
    double range = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto [least, most] = std::minmax({vertices[0]->value[i], vertices[1]->value[i], vertices[2]->value[i]});
        range = std::max(range, static_cast<double>(most - least));
    }
    return range * steps_per_px / reach;
}

HWY_INLINE TexelDerivatives texel_derivatives(const Vertices& vertices, const Steps& steps) {
    const auto way = [&](std::size_t to) {
        return std::array{static_cast<double>(vertices[to]->x - vertices[0]->x),
            static_cast<double>(vertices[to]->y - vertices[0]->y)};
    };
    const auto b = way(1);
    const auto c = way(2);
    const double area = b[0] * c[1] - b[1] * c[0];
    const double reach = std::max(std::max(std::abs(b[0]), std::abs(c[0])), std::max(std::abs(b[1]), std::abs(c[1])));
    if (std::abs(area) < min_thickness * reach) {
        const double texels = thin_footprint(vertices, reach);
        return {{texels, 0.0}, {0.0, texels}};
    }
    const Pair pair;
    const hn::Half<Four> places; // the first two values
    const auto by_area = hn::Set(pair, steps_per_px / area);
    const auto to_b = hn::Mul(hn::PromoteTo(pair, hn::LowerHalf(places, steps.to_second)), by_area);
    const auto to_c = hn::Neg(hn::Mul(hn::PromoteTo(pair, hn::LowerHalf(places, steps.to_first)), by_area));
    const auto times = [&](hn::Vec<Pair> value, double factor)
                           HWY_ATTR { return hn::Mul(value, hn::Set(pair, factor)); };
    TexelDerivatives result;
    hn::StoreU(hn::Sub(times(to_b, c[1]), times(to_c, b[1])), pair, result.across.data());
    hn::StoreU(hn::Sub(times(to_c, b[0]), times(to_b, c[0])), pair, result.down.data());
    return result;
}

/// The first two lanes from one, the others from another.
HWY_INLINE hn::Vec<Four> two_of_each(hn::Vec<Four> first, hn::Vec<Four> others) {
    return hn::ConcatUpperLower(Four(), others, first);
}

bool FitAffineTexture(const Vertices& vertices, std::size_t level_count, AffineTexturedTriangle& affine) {
    const Four four;
    const auto set = [&](float value) HWY_ATTR { return hn::Set(four, value); };
    const Steps steps(vertices);
    const Bend bend(vertices, steps);
    affine.mip_selection = select_mip_levels(texel_derivatives(vertices, steps), level_count);
    const auto scale = std::bit_cast<float>((127U - affine.mip_selection.fine) << 23U); // 2^-fine
    const auto most = two_of_each(set(2.0F * max_texels_wrong / scale), set(max_share_wrong));
    if (!hn::AllTrue(four, hn::Le(bend.size(), most))) { return false; }
    const auto half = set(0.5F);
    const auto moved = hn::Add(hn::Mul(bend.doubled_middle(), half), half);
    const auto none = hn::Zero(four);
    const auto before = two_of_each(moved, none);
    const auto times = two_of_each(set(scale), set(TexturePlanes::whole_share));
    const auto behind = two_of_each(half, none);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        ScreenVertex& vertex = affine.vertices[k];
        vertex = *vertices[k];
        const auto value = hn::Mul(hn::Add(Steps::values(vertex), before), times);
        hn::StoreU(hn::Sub(value, behind), four, vertex.value.data());
    }
    return true;
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octant::visuals::raster {

HWY_EXPORT(FitAffineTexture);

std::optional<AffineTexturedTriangle> fit_affine_texture(
    const std::array<const ScreenVertex*, 3>& vertices, std::size_t level_count) {
    AffineTexturedTriangle affine;
    if (!HWY_DYNAMIC_DISPATCH(FitAffineTexture)(vertices, level_count, affine)) { return std::nullopt; }
    return affine;
}

namespace {

/// A whole number in the range whose sums with a column's or row's share fit 32 bits.
std::int32_t whole(double value) { return static_cast<std::int32_t>(std::clamp(value, -0x1p30, 0x1p30)); }

std::uint32_t product(std::int32_t a, int b) { return static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b); }

/// Fills in value i of planes that have `at_first` at the first of the pixels.
void set_plane(ColourGradients& gradients, std::size_t i, const scene::PixelRect& pixels, double at_first,
    const std::array<double, 2>& steps) {
    gradients.per_x[i] = whole(steps[0]);
    gradients.per_y[i] = whole(steps[1]);
    gradients.base[i] =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(whole(at_first)) - product(gradients.per_x[i], pixels.x) -
                                  product(gradients.per_y[i], pixels.y));
    gradients.per_column[i] = static_cast<std::int16_t>(std::clamp((gradients.per_x[i] + 256) >> 9, -32768, 32767));
    gradients.least[i] = -128 * 128;
    gradients.most[i] = static_cast<std::int16_t>((TexturePlanes::whole_share - 128.0F) * 128.0F);
}

} // namespace

// A value at a pixel is v0 + (s dx + t dy) / (1 + e), where dx and dy lead from the middle of the pixels, v0, s and t
// are the value and its slopes there, and e is how much 1 / w differs from the middle's, as a share of it. Planes leave
// out e: they are wrong by no more than |s dx + t dy| |e| / (1 - |e|).
TexturePlanes fit_texture_planes(const TriangleExtra& extra, const scene::PixelRect& pixels, std::size_t level_count) {
    constexpr double max_texels = 1.0 / 16.0;
    constexpr double max_share = 1.0 / 512.0;
    constexpr double middle = 128.0 * 65536.0; // value that ColourGradients count from
    constexpr double range = 0x1.fp29;         // of coordinates and of their steps over the pixels
    const std::array half_px{0.5 * (pixels.width - 1), 0.5 * (pixels.height - 1)};
    const AttributePlane& inverse_w = extra.over_w[4];
    const double column = pixels.x + half_px[0];
    const double row = pixels.y + half_px[1];
    const double w = 1.0 / std::max(inverse_w.at(column, row), 1e-30);
    std::array<double, 4> value;
    std::array<std::array<double, 2>, 4> slope;
    for (std::size_t i = 0; i < 4; ++i) {
        const AttributePlane& over_w = extra.over_w[i];
        value[i] = over_w.at(column, row) * w;
        slope[i] = {(over_w.per_x - value[i] * inverse_w.per_x) * w, (over_w.per_y - value[i] * inverse_w.per_y) * w};
    }
    const auto reach = [&](const std::array<double, 2>& steps) {
        return std::abs(steps[0]) * half_px[0] + std::abs(steps[1]) * half_px[1];
    };
    TexturePlanes planes;
    planes.mip_selection =
        select_mip_levels(TexelDerivatives{{slope[0][0], slope[1][0]}, {slope[0][1], slope[1][1]}}, level_count);
    const double bend = reach({inverse_w.per_x * w, inverse_w.per_y * w});
    planes.is_accurate = bend < 0.5;
    const double scale = texel_scale(planes.mip_selection.fine);
    for (std::size_t i = 0; i < 4; ++i) {
        const bool is_coordinate = i < 2;
        const double unit = is_coordinate ? scale : static_cast<double>(TexturePlanes::whole_share) * 65536.0;
        const double limit = is_coordinate ? max_texels * 65536.0 : max_share * unit;
        const std::array steps{slope[i][0] * unit, slope[i][1] * unit};
        const double from_middle = (is_coordinate ? (value[i] + 0.5) * scale - 32768.0 : value[i] * unit) - middle;
        planes.is_accurate = planes.is_accurate && reach(steps) * bend <= limit * (1.0 - bend) &&
                             std::abs(from_middle) + reach(steps) < range;
        set_plane(planes.gradients, i, pixels, from_middle - steps[0] * half_px[0] - steps[1] * half_px[1], steps);
    }
    return planes;
}

} // namespace octant::visuals::raster
#endif
