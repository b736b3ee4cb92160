// Step 3 of a picture (renderer.cpp), called by triangle_setup.cpp: edges, colour gradients and texture planes of one
// triangle: both edges at once, then all its values. Compiled once for each instruction set; all give the same bits,
// because real numbers are summed and multiplied one by one.
#include "visuals/raster/triangle_planes.h"

// SVE's vectors have no size that the compiler knows: they can be no members.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#define HWY_BROKEN_EMU128 0 // compiled so that it is right, see CMakeLists.txt
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visuals/raster/triangle_planes.cpp"
// clang-format off: foreach_target.h must come before all that includes highway.h
#include <hwy/foreach_target.h>
// clang-format on

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Pair = hn::FixedTag<double, 2>;
using Reals = hn::CappedTag<double, 4>; ///< as many values of a corner as fit
using Floats = hn::Rebind<float, Reals>;
using Whole = hn::Rebind<std::int32_t, Reals>;
using Short = hn::Rebind<std::int16_t, Reals>;

constexpr double level_fraction = 65536.0; ///< of Levels::base
constexpr float level_middle = 128.0F;     ///< level that Levels count from

/// What rounds to the nearest whole number where it is cut off towards zero.
template <class Tag>
HWY_INLINE hn::Vec<Tag> to_cut(hn::Vec<Tag> value) {
    return hn::Add(value, hn::CopySign(hn::Set(Tag(), 0.5), value));
}

HWY_INLINE hn::Vec<Whole> rounded(hn::Vec<Reals> value) { return hn::DemoteTo(Whole(), to_cut<Reals>(value)); }

/// Two corners' distance, x and y.
HWY_INLINE hn::Vec<Pair> distance(const ScreenVertex& from, const ScreenVertex& to) {
    const hn::Rebind<std::int32_t, Pair> whole;
    return hn::PromoteTo(Pair(), hn::Sub(hn::LoadU(whole, &to.x), hn::LoadU(whole, &from.x)));
}

/// Two edges that begin at the same corner: where they cross its first row, and how they go on.
struct EdgePair {
    hn::Vec<hn::Rebind<std::int64_t, Pair>> x;
    hn::Vec<hn::Rebind<std::int64_t, Pair>> slope;

    HWY_INLINE
    EdgePair(hn::Vec<Pair> slopes, hn::Vec<Pair> heights, const ScreenVertex& top) {
        const Pair real;
        const hn::Rebind<std::int64_t, Pair> whole;
        constexpr double one = 4294967296.0; // 2^32
        const std::int32_t down = first_row_of(top.y) * ScreenVertex::per_px - top.y;
        const auto at_row = hn::Add(
            hn::Set(real, static_cast<double>(top.x)), hn::Mul(slopes, hn::Set(real, static_cast<double>(down))));
        const auto has_none = hn::Eq(heights, hn::Zero(real));
        const auto fixed = [&](hn::Vec<Pair> value) HWY_ATTR {
            return hn::ConvertTo(whole, hn::IfThenZeroElse(has_none, to_cut<Pair>(value)));
        };
        x = fixed(hn::Mul(at_row, hn::Set(real, one / ScreenVertex::per_px)));
        slope = fixed(hn::Mul(slopes, hn::Set(real, one)));
    }

    HWY_INLINE void store_first(Edge& edge) const {
        const hn::Rebind<std::int64_t, Pair> whole;
        hn::StoreU(hn::InterleaveLower(whole, x, slope), whole, &edge.x);
    }

    HWY_INLINE void store_second(Edge& edge) const {
        const hn::Rebind<std::int64_t, Pair> whole;
        hn::StoreU(hn::InterleaveUpper(whole, x, slope), whole, &edge.x);
    }
};

/// From the top corner to the others, pixels over the doubled area: what planes are made with.
struct PlaneBase {
    double middle_x;
    double middle_y;
    double bottom_x;
    double bottom_y;
};

HWY_INLINE PlaneBase edges_of(const TopDownVertices& vertices, Triangle& triangle) {
    const Pair real;
    const auto whole = distance(vertices.top, vertices.bottom);
    const auto upper = distance(vertices.top, vertices.middle);
    const auto lower = distance(vertices.middle, vertices.bottom);
    const auto area = hn::Set(real, static_cast<double>(vertices.doubled_area));
    const auto one_px = hn::Set(real, static_cast<double>(ScreenVertex::per_px));
    const auto from_top_heights = hn::InterleaveUpper(real, whole, upper);
    const EdgePair from_top(
        hn::Div(hn::InterleaveLower(real, whole, upper), from_top_heights), from_top_heights, vertices.top);
    from_top.store_first(triangle.whole);
    from_top.store_second(triangle.upper);
    // For the lower edge's slope: one pixel over the doubled area.
    const auto divisors = hn::InterleaveUpper(real, lower, area);
    const auto quotients = hn::Div(hn::InterleaveLower(real, lower, one_px), divisors);
    const EdgePair from_middle(quotients, divisors, vertices.middle);
    from_middle.store_first(triangle.lower);
    const auto to_px = hn::InterleaveUpper(real, quotients, quotients);
    alignas(16) std::array<double, 2> to_middle;
    alignas(16) std::array<double, 2> to_bottom;
    hn::Store(hn::Mul(upper, to_px), real, to_middle.data());
    hn::Store(hn::Mul(whole, to_px), real, to_bottom.data());
    return {to_middle[0], to_middle[1], to_bottom[0], to_bottom[1]};
}

/// (x * at.x + y * at.y) / 256, cut down, its lower 32 bits.
HWY_INLINE hn::Vec<Whole> from_origin(hn::Vec<Whole> x, hn::Vec<Whole> y, const ScreenVertex& at) {
    const Whole whole;
    const hn::Repartition<std::uint64_t, Whole> wide;
    const auto at_x = hn::Set(whole, at.x);
    const auto at_y = hn::Set(whole, at.y);
    const auto even = [&](hn::Vec<Whole> a, hn::Vec<Whole> b) HWY_ATTR {
        const auto sum = hn::Add(hn::MulEven(a, at_x), hn::MulEven(b, at_y));
        return hn::ShiftRight<8>(hn::BitCast(wide, sum));
    };
    const auto odd_to_even = [&](hn::Vec<Whole> a)
                                 HWY_ATTR { return hn::BitCast(whole, hn::ShiftRight<32>(hn::BitCast(wide, a))); };
    const auto low = hn::And(even(x, y), hn::Set(wide, std::uint64_t{0xffffffff}));
    const auto high = hn::ShiftLeft<32>(even(odd_to_even(x), odd_to_even(y)));
    return hn::BitCast(whole, hn::Or(low, high));
}

HWY_INLINE void store_short(hn::Vec<Whole> value, std::int16_t* to) {
    const auto wrapped = hn::ShiftRight<16>(hn::ShiftLeft<16>(value));
    hn::StoreU(hn::DemoteTo(Short(), wrapped), Short(), to);
}

/// Values i, i + 1 ... of the corners as planes.
HWY_INLINE void set_gradients(const TopDownVertices& vertices, const PlaneBase& base, double max_per_px, std::size_t i,
    ColourGradients& gradients) {
    const Reals real;
    const Floats floats;
    const Whole whole;
    const auto a = hn::LoadU(floats, vertices.top.value.data() + i);
    const auto b = hn::LoadU(floats, vertices.middle.value.data() + i);
    const auto c = hn::LoadU(floats, vertices.bottom.value.data() + i);
    const auto middle = hn::Set(floats, level_middle);
    const auto limit = [&](hn::Vec<Floats> level) HWY_ATTR {
        const auto parts = hn::Mul(hn::Sub(level, middle), hn::Set(floats, 128.0F));
        return rounded(hn::PromoteTo(real, parts));
    };
    store_short(limit(hn::Min(hn::Min(a, b), c)), gradients.min.data() + i);
    store_short(limit(hn::Max(hn::Max(a, b), c)), gradients.max.data() + i);
    const auto to_b = hn::PromoteTo(real, hn::Sub(b, a));
    const auto to_c = hn::PromoteTo(real, hn::Sub(c, a));
    const auto times = [&](hn::Vec<Reals> value, double factor)
                           HWY_ATTR { return hn::Mul(value, hn::Set(real, factor)); };
    const auto real_x = hn::Sub(times(to_b, base.bottom_y), times(to_c, base.middle_y));
    const auto real_y = hn::Sub(times(to_c, base.middle_x), times(to_b, base.bottom_x));
    const auto max = hn::Set(real, max_per_px);
    const auto is_sliver = hn::Or(hn::Gt(hn::Abs(real_x), max), hn::Gt(hn::Abs(real_y), max));
    const auto per_x = rounded(hn::IfThenZeroElse(is_sliver, times(real_x, level_fraction)));
    const auto per_y = rounded(hn::IfThenZeroElse(is_sliver, times(real_y, level_fraction)));
    hn::StoreU(per_x, whole, gradients.per_x.data() + i);
    hn::StoreU(per_y, whole, gradients.per_y.data() + i);
    store_short(hn::ShiftRight<9>(hn::Add(per_x, hn::Set(whole, 256))), gradients.per_column.data() + i);
    const auto mean = hn::Sub(hn::Div(hn::Add(hn::Add(a, b), c), hn::Set(floats, 3.0F)), middle);
    const auto at_base = hn::IfThenElse(is_sliver, hn::PromoteTo(real, mean), hn::PromoteTo(real, hn::Sub(a, middle)));
    hn::StoreU(hn::Sub(rounded(times(at_base, level_fraction)), from_origin(per_x, per_y, vertices.top)), whole,
        gradients.base.data() + i);
}

/// One over the depth in a triangle of ground. A sliver has the corners' mean.
HWY_INLINE void set_inverse_depth(const TopDownVertices& vertices, const PlaneBase& base, Triangle& triangle) {
    const ScreenVertex& top = vertices.top;
    const auto at_top = static_cast<double>(top.inverse_w);
    const double to_middle = static_cast<double>(vertices.middle.inverse_w) - at_top;
    const double to_bottom = static_cast<double>(vertices.bottom.inverse_w) - at_top;
    const double per_x = to_middle * base.bottom_y - to_bottom * base.middle_y;
    const double per_y = to_bottom * base.middle_x - to_middle * base.bottom_x;
    InverseDepthPlane& plane = triangle.inverse_depth;
    plane.min = std::min(std::min(top.inverse_w, vertices.middle.inverse_w), vertices.bottom.inverse_w);
    plane.max = std::max(std::max(top.inverse_w, vertices.middle.inverse_w), vertices.bottom.inverse_w);
    const double range = static_cast<double>(plane.max) - static_cast<double>(plane.min);
    if (std::max(std::abs(per_x), std::abs(per_y)) > range) {
        plane.first = static_cast<float>(at_top + (to_middle + to_bottom) / 3.0);
        plane.per_x = 0.0F;
        plane.per_y = 0.0F;
        return;
    }
    constexpr double px_a_step = 1.0 / ScreenVertex::per_px;
    plane.first = static_cast<float>(
        at_top + per_x * (triangle.left - top.x * px_a_step) + per_y * (triangle.first_row - top.y * px_a_step));
    plane.per_x = static_cast<float>(per_x);
    plane.per_y = static_cast<float>(per_y);
}

void SetEdges(const TopDownVertices& vertices, Triangle& triangle) {
    const PlaneBase base = edges_of(vertices, triangle);
    if (triangle.has_detail_texture) { set_inverse_depth(vertices, base, triangle); }
}

void SetEdgesAndGradients(const TopDownVertices& vertices, double max_per_px, Triangle& triangle) {
    const PlaneBase base = edges_of(vertices, triangle);
    for (std::size_t i = 0; i < vertices.top.value.size(); i += hn::Lanes(Reals())) {
        set_gradients(vertices, base, max_per_px, i, triangle.gradients);
    }
    if (triangle.has_detail_texture) { set_inverse_depth(vertices, base, triangle); }
}

// -- Triangles of meshes with textures.

void SetSurfacePlanes(
    const std::array<const ScreenVertex*, 3>& corners, const SurfaceCorners& values, SurfacePlanes& planes) {
    const Reals real;
    const Floats floats;
    const auto& [a, b, c] = corners;
    constexpr double px_a_step = 1.0 / ScreenVertex::per_px;
    const auto way = [&](std::int32_t from, std::int32_t to) { return static_cast<double>(to - from); };
    const double area = way(a->x, b->x) * way(a->y, c->y) - way(a->x, c->x) * way(a->y, b->y);
    const double to_px = static_cast<double>(ScreenVertex::per_px) / area;
    const auto set = [&](double value) HWY_ATTR { return hn::Set(real, value); };
    const auto b_x = set(way(a->x, b->x) * to_px);
    const auto b_y = set(way(a->y, b->y) * to_px);
    const auto c_x = set(way(a->x, c->x) * to_px);
    const auto c_y = set(way(a->y, c->y) * to_px);
    const auto a_x = set(a->x * px_a_step - planes.first_px.x);
    const auto a_y = set(a->y * px_a_step - planes.first_px.y);
    for (std::size_t i = 0; i < SurfacePlanes::count; i += hn::Lanes(real)) {
        const auto load = [&](std::size_t k) HWY_ATTR { return hn::LoadU(floats, values[k].data() + i); };
        const auto over_w = [&](std::size_t k) HWY_ATTR {
            return hn::Mul(hn::PromoteTo(real, load(k)), set(static_cast<double>(corners[k]->inverse_w)));
        };
        const auto at_a = over_w(0);
        const auto to_b = hn::Sub(over_w(1), at_a);
        const auto to_c = hn::Sub(over_w(2), at_a);
        const auto per_x = hn::Sub(hn::Mul(to_b, c_y), hn::Mul(to_c, b_y));
        const auto per_y = hn::Sub(hn::Mul(to_c, b_x), hn::Mul(to_b, c_x));
        const auto base = hn::Sub(hn::Sub(at_a, hn::Mul(per_x, a_x)), hn::Mul(per_y, a_y));
        const auto store = [&](hn::Vec<Reals> from, std::array<float, SurfacePlanes::count>& to)
                               HWY_ATTR { hn::StoreU(hn::DemoteTo(floats, from), floats, to.data() + i); };
        store(base, planes.base);
        store(per_x, planes.per_x);
        store(per_y, planes.per_y);
        hn::StoreU(hn::Min(hn::Min(load(0), load(1)), load(2)), floats, planes.min.data() + i);
        hn::StoreU(hn::Max(hn::Max(load(0), load(1)), load(2)), floats, planes.max.data() + i);
    }
    planes.min[0] = std::min(std::min(a->inverse_w, b->inverse_w), c->inverse_w);
    planes.max[0] = std::max(std::max(a->inverse_w, b->inverse_w), c->inverse_w);
}

// -- Triangles that no sample lies in.

/// For each sample the only row, and the columns, where the triangle may cover it.
bool IsBetweenSamples(const TopDownVertices& vertices, const SamplePattern& samples) {
    using Lanes = hn::CappedTag<float, SamplePattern::lanes>;
    const Lanes lanes;
    const hn::RebindToSigned<Lanes> whole;
    constexpr std::int32_t per_px = ScreenVertex::per_px;
    constexpr float rounding = 0.25F; ///< more than the crossings of a painted triangle are rounded by
    const ScreenVertex& top = vertices.top;
    const ScreenVertex& middle = vertices.middle;
    const ScreenVertex& bottom = vertices.bottom;
    const auto set = [&](std::int32_t value) HWY_ATTR { return hn::Set(lanes, static_cast<float>(value)); };
    const auto slope = [&](const ScreenVertex& from, const ScreenVertex& to)
                           HWY_ATTR { return hn::Div(set(to.x - from.x), set(to.y - from.y)); };
    const auto of_whole = slope(top, bottom);
    const auto of_upper = slope(top, middle);
    const auto of_lower = slope(middle, bottom);
    const auto fraction = [&](std::int32_t value) HWY_ATTR { return value & (per_px - 1); };
    for (std::size_t i = 0; i < samples.x.size(); i += hn::Lanes(lanes)) {
        constexpr int scale = 3; // from 1/32 to 1/256 pixel
        const auto x = hn::ConvertTo(lanes, hn::ShiftLeft<scale>(hn::LoadU(whole, samples.x.data() + i)));
        const auto y = hn::ShiftLeft<scale>(hn::LoadU(whole, samples.y.data() + i));
        const auto below_top = hn::And(hn::Sub(y, hn::Set(whole, top.y)), hn::Set(whole, per_px - 1));
        const auto down = hn::ConvertTo(lanes, below_top);
        const auto below_middle = hn::Sub(down, set(middle.y - top.y));
        const auto through = hn::Mul(down, of_whole);
        const auto bent = hn::IfThenElse(hn::Lt(below_middle, hn::Zero(lanes)), hn::Mul(down, of_upper),
            hn::Add(set(middle.x - top.x), hn::Mul(below_middle, of_lower)));
        const auto column = [&](hn::Vec<Lanes> from_top) HWY_ATTR {
            const auto from_sample = hn::Add(hn::Sub(from_top, x), set(fraction(top.x)));
            return hn::Ceil(hn::Mul(from_sample, hn::Set(lanes, 1.0F / per_px)));
        };
        const auto margin = hn::Set(lanes, rounding);
        const auto first = column(hn::Sub(hn::Min(through, bent), margin));
        const auto end = column(hn::Add(hn::Max(through, bent), margin));
        if (!hn::AllFalse(lanes, hn::And(hn::Lt(down, set(bottom.y - top.y)), hn::Lt(first, end)))) { return false; }
    }
    return true;
}

// -- Planes of textured triangles: whether they hold for a whole triangle, and the values at its vertices then.

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
    hn::Vec<Four> min;
    hn::Vec<Four> max;

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
        min = hn::Min(hn::Min(first, second), hn::Min(third, none));
        max = hn::Max(hn::Max(first, second), hn::Max(third, none));
    }

    HWY_INLINE hn::Vec<Four> size() const { return hn::Sub(max, min); }

    HWY_INLINE hn::Vec<Four> doubled_middle() const { return hn::Add(max, min); }
};

/// How many texels a pixel is wide in a thin triangle.
double thin_footprint(const Vertices& vertices, double reach) {
    double range = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto [min, max] = std::minmax({vertices[0]->value[i], vertices[1]->value[i], vertices[2]->value[i]});
        range = std::max(range, static_cast<double>(max - min));
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
    const auto max = two_of_each(set(2.0F * max_texels_wrong / scale), set(max_share_wrong));
    if (!hn::AllTrue(four, hn::Le(bend.size(), max))) { return false; }
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

HWY_EXPORT(IsBetweenSamples);
HWY_EXPORT(SetEdges);
HWY_EXPORT(SetEdgesAndGradients);

bool is_between_samples(const TopDownVertices& vertices, const SamplePattern& samples) {
    constexpr std::int32_t per_px = ScreenVertex::per_px;
    constexpr std::int32_t max_width = 256 * per_px; // for which single precision is enough
    const auto& [top, middle, bottom, area] = vertices;
    const std::int32_t height = bottom.y - top.y;
    const std::int32_t left = std::min(std::min(top.x, middle.x), bottom.x);
    const std::int32_t width = std::max(std::max(top.x, middle.x), bottom.x) - left;
    if (height >= per_px || width >= max_width) { return false; }
    const auto to_next_middle = [](std::int32_t from) { return -from & (per_px - 1); };
    if (to_next_middle(top.y) < height && to_next_middle(left) <= width) { return false; }
    return HWY_DYNAMIC_DISPATCH(IsBetweenSamples)(vertices, samples);
}

void set_edges(const TopDownVertices& vertices, Triangle& triangle) {
    HWY_DYNAMIC_DISPATCH(SetEdges)(vertices, triangle);
}

void set_edges_and_gradients(const TopDownVertices& vertices, double max_per_px, Triangle& triangle) {
    HWY_DYNAMIC_DISPATCH(SetEdgesAndGradients)(vertices, max_per_px, triangle);
}

ColourGradients constant_gradients(const std::array<float, 3>& rgb) {
    ColourGradients gradients;
    const auto rounded = [](double value) { return static_cast<std::int32_t>(value + (value < 0.0 ? -0.5 : 0.5)); };
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const auto level = static_cast<double>(rgb[i] - 128.0F);
        gradients.base[i] = rounded(level * 65536.0);
        gradients.min[i] = static_cast<std::int16_t>(rounded(level * 128.0));
        gradients.max[i] = gradients.min[i];
    }
    return gradients;
}

HWY_EXPORT(SetSurfacePlanes);

void set_surface_planes(
    const std::array<const ScreenVertex*, 3>& corners, const SurfaceCorners& values, SurfacePlanes& planes) {
    HWY_DYNAMIC_DISPATCH(SetSurfacePlanes)(corners, values, planes);
}

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
    gradients.min[i] = -128 * 128;
    gradients.max[i] = static_cast<std::int16_t>((TexturePlanes::whole_share - 128.0F) * 128.0F);
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
