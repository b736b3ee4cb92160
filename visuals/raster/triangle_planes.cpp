// Edges and levels of one triangle: both edges at once, then all its values. Compiled once for each instruction set;
// all give the same bits, because real numbers are summed and multiplied one by one.
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
#include <cmath>
#include <cstddef>
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
    store_short(limit(hn::Min(hn::Min(a, b), c)), gradients.least.data() + i);
    store_short(limit(hn::Max(hn::Max(a, b), c)), gradients.most.data() + i);
    const auto to_b = hn::PromoteTo(real, hn::Sub(b, a));
    const auto to_c = hn::PromoteTo(real, hn::Sub(c, a));
    const auto times = [&](hn::Vec<Reals> value, double factor)
                           HWY_ATTR { return hn::Mul(value, hn::Set(real, factor)); };
    const auto real_x = hn::Sub(times(to_b, base.bottom_y), times(to_c, base.middle_y));
    const auto real_y = hn::Sub(times(to_c, base.middle_x), times(to_b, base.bottom_x));
    const auto most = hn::Set(real, max_per_px);
    const auto is_sliver = hn::Or(hn::Gt(hn::Abs(real_x), most), hn::Gt(hn::Abs(real_y), most));
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
    plane.least = std::min(std::min(top.inverse_w, vertices.middle.inverse_w), vertices.bottom.inverse_w);
    plane.most = std::max(std::max(top.inverse_w, vertices.middle.inverse_w), vertices.bottom.inverse_w);
    const double range = static_cast<double>(plane.most) - static_cast<double>(plane.least);
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

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octant::visuals::raster {

HWY_EXPORT(SetEdges);
HWY_EXPORT(SetEdgesAndGradients);

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
        gradients.least[i] = static_cast<std::int16_t>(rounded(level * 128.0));
        gradients.most[i] = gradients.least[i];
    }
    return gradients;
}

} // namespace octant::visuals::raster
#endif
