// Step 2 of a picture (renderer.cpp): the vertices of ground, shadows and sky are projected to the screen and hazed,
// several at once. Compiled once for each instruction set; all give the same bits, because real numbers are summed and
// multiplied one by one. Next: triangle_setup.cpp.
#include "visuals/raster/vertex_stage.h"

// SVE's vectors have no size that the compiler knows: they can be no members.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#define HWY_BROKEN_EMU128 0 // compiled so that it is right, see CMakeLists.txt
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visuals/raster/ground_vertices.cpp"
// clang-format off: foreach_target.h must come before all that includes highway.h
#include <hwy/foreach_target.h>
// clang-format on

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Reals = hn::CappedTag<float, 16>;
using Whole = hn::RebindToSigned<Reals>;
using Bits = hn::RebindToUnsigned<Reals>;
using Real = hn::Vec<Reals>;
constexpr std::size_t at_once = hn::MaxLanes(Reals());
constexpr float max_level = 255.0F;

HWY_INLINE Real set(float value) { return hn::Set(Reals(), value); }

/// The value between `from` and `to` at `share`, as mix() of GLSL gives it.
HWY_INLINE Real mixed(Real from, Real to, Real share) {
    return hn::Add(hn::Mul(from, hn::Sub(set(1.0F), share)), hn::Mul(to, share));
}

/// e to the power -x for several numbers at once, with the same results as exp_of_minus().
HWY_INLINE Real exp_of_minus_each(Real x) {
    const Whole whole;
    const auto power = hn::Min(hn::Mul(x, set(1.44269504F)), set(126.0F));
    const auto down = hn::ConvertTo(whole, power);
    const auto part = hn::Sub(power, hn::ConvertTo(Reals(), down));
    const auto t = hn::Mul(hn::Sub(set(0.5F), part), set(0.693147181F));
    auto series = set(1.0F);
    for (const float order : {7.0F, 6.0F, 5.0F, 4.0F, 3.0F, 2.0F, 1.0F}) {
        series = hn::Add(set(1.0F), hn::Mul(hn::Div(t, set(order)), series));
    }
    const auto power_of_two = hn::ShiftLeft<23>(hn::Sub(hn::Set(whole, 127), down));
    return hn::Mul(hn::Mul(set(0.707106781F), series), hn::BitCast(Reals(), power_of_two));
}

/// Corners before the eye.
struct Positions {
    Real x, y, z; ///< world axes with the eye subtracted, metres
    hn::Vec<Bits> colour;

    HWY_INLINE explicit Positions(const models::ColourVertex* from) {
        const Reals reals;
        Real packed;
        static_assert(sizeof(models::ColourVertex) == 4 * sizeof(float));
        hn::LoadInterleaved4(reals, &from->position_m.x, x, y, z, packed);
        colour = hn::BitCast(Bits(), packed);
    }

    /// One of the colour's bytes.
    template <int shift>
    HWY_INLINE Real level() const {
        const auto byte = hn::And(hn::ShiftRight<shift>(colour), hn::Set(Bits(), 0xffU));
        return hn::ConvertTo(Reals(), hn::BitCast(Whole(), byte));
    }
};

/// Haze before places, as air_before().
struct Haze {
    Real share;
    std::array<Real, 3> rgb_255;

    HWY_INLINE Haze(const Positions& at, const Light& light) {
        const Reals reals;
        const auto squares = hn::Add(hn::Add(hn::Mul(at.x, at.x), hn::Mul(at.y, at.y)), hn::Mul(at.z, at.z));
        const auto distance_m = hn::Sqrt(squares);
        const auto haze_density_exponent = hn::Mul(at.z, set(light.falloff_per_m));
        const auto size = hn::Abs(haze_density_exponent);
        const auto left = exp_of_minus_each(hn::Min(size, set(max_haze_fall)));
        const auto over = hn::IfThenElse(hn::Gt(haze_density_exponent, hn::Zero(reals)), size, hn::Mul(size, left));
        const auto density = hn::IfThenElse(hn::Ge(size, set(min_haze_fall)), hn::Div(hn::Sub(set(1.0F), left), over),
            hn::Sub(set(1.0F), hn::Mul(set(0.5F), haze_density_exponent)));
        const auto depth = hn::Mul(hn::Mul(distance_m, set(light.per_m)), density);
        share = hn::Sub(set(1.0F), exp_of_minus_each(depth));
        const auto level_m =
            hn::Add(hn::Mul(at.x, set(light.horizontal_to_sun.x)), hn::Mul(at.y, set(light.horizontal_to_sun.y)));
        const auto towards = hn::Max(hn::Div(level_m, hn::Max(distance_m, set(1e-6F))), hn::Zero(reals));
        const auto sunward_colour = hn::Mul(towards, towards);
        for (glm::length_t i = 0; i < 3; ++i) {
            rgb_255[static_cast<std::size_t>(i)] =
                hn::Mul(mixed(set(light.haze[i]), set(light.sunward_colour[i]), sunward_colour), set(max_level));
        }
    }
};

/// A block of corners on their way to the lists.
struct VertexStore {
    alignas(64) std::array<float, 4 * at_once> place;
    alignas(64) std::array<float, 4 * at_once> value;
    alignas(64) std::array<float, 3 * at_once> clip;

    /// As clip_position() and place().
    HWY_INLINE void put(const Positions& at, const Projection& projection) {
        const Reals reals;
        const Whole whole;
        const auto row = [&](glm::length_t i) HWY_ATTR {
            const auto& m = projection.world_to_clip;
            const auto sum = hn::Add(hn::Mul(set(m[0][i]), at.x), hn::Mul(set(m[1][i]), at.y));
            return hn::Add(hn::Add(sum, hn::Mul(set(m[2][i]), at.z)), set(m[3][i]));
        };
        const auto x = row(0);
        const auto y = row(1);
        const auto w = row(3);
        hn::StoreInterleaved3(x, y, w, reals, clip.data());
        const auto minus_w = hn::Neg(w);
        const auto bit_where = [&](hn::Mask<Reals> mask, std::uint32_t bit) HWY_ATTR {
            return hn::IfThenElseZero(hn::RebindMask(Bits(), mask), hn::Set(Bits(), bit));
        };
        const auto is_placed = hn::And(
            hn::Ge(w, set(projection.near_m)), hn::And(hn::Le(hn::Abs(x), hn::Mul(set(projection.max_over_w.x), w)),
                                                   hn::Le(hn::Abs(y), hn::Mul(set(projection.max_over_w.y), w))));
        const auto off_sides =
            hn::Or(bit_where(hn::Lt(x, minus_w), left_of_view), bit_where(hn::Gt(x, w), right_of_view));
        const auto over = hn::Or(bit_where(hn::Gt(y, w), above_view), bit_where(hn::Lt(y, minus_w), below_view));
        const auto outcode = hn::Or(hn::Or(off_sides, over), bit_where(hn::Not(is_placed), beyond_range));
        const auto inverse_w = hn::Div(set(1.0F), w);
        const auto steps = [&](hn::Vec<Reals> px) HWY_ATTR {
            const auto from_middle = hn::Mul(hn::Sub(px, set(0.5F)), set(static_cast<float>(ScreenVertex::per_px)));
            const auto half = hn::IfThenElse(hn::Lt(from_middle, hn::Zero(reals)), set(-0.5F), set(0.5F));
            const auto placed = hn::IfThenElseZero(is_placed, hn::Add(from_middle, half));
            return hn::BitCast(reals, hn::ConvertTo(whole, placed));
        };
        const auto half_x = set(projection.half_px.x);
        const auto half_y = set(projection.half_px.y);
        const auto x_px = hn::Add(hn::Mul(hn::Mul(x, inverse_w), half_x), half_x);
        const auto y_px = hn::Sub(half_y, hn::Mul(hn::Mul(y, inverse_w), half_y));
        hn::StoreInterleaved4(steps(x_px), steps(y_px), inverse_w, hn::BitCast(reals, outcode), reals, place.data());
    }

    HWY_INLINE void put_values(Real a, Real b, Real c, Real d) {
        hn::StoreInterleaved4(a, b, c, d, Reals(), value.data());
    }

    HWY_INLINE void copy(std::size_t count, std::size_t first, const VertexOutputs& to) const {
        static_assert(sizeof(ScreenVertex) == 8 * sizeof(float));
        static_assert(sizeof(ClipPosition) == 3 * sizeof(float));
        std::memcpy(&to.clip[first].x, clip.data(), count * sizeof(ClipPosition));
        for (std::size_t i = 0; i < count; ++i) {
            ScreenVertex& vertex = to.vertices[first + i];
            std::memcpy(&vertex.x, place.data() + 4 * i, 4 * sizeof(float));
            std::memcpy(vertex.value.data(), value.data() + 4 * i, 4 * sizeof(float));
        }
    }
};

/// Calls values_of(places, store) for each block of corners, then writes it.
template <class ValuesOf>
HWY_INLINE void project_each(std::span<const models::ColourVertex> from, const Projection& projection,
    const VertexOutputs& to, const ValuesOf& values_of) {
    VertexStore store;
    std::array<models::ColourVertex, at_once> last{};
    for (std::size_t first = 0; first < from.size(); first += at_once) {
        const std::size_t count = std::min(at_once, from.size() - first);
        const models::ColourVertex* block = from.data() + first;
        if (count < at_once) {
            std::copy_n(block, count, last.begin());
            block = last.data();
        }
        const Positions at(block);
        store.put(at, projection);
        values_of(at, store);
        store.copy(count, first, to);
    }
}

void ProjectColoured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const VertexOutputs& to) {
    const auto own = [&](const Positions& at, VertexStore& store)
                         HWY_ATTR { store.put_values(at.level<0>(), at.level<8>(), at.level<16>(), at.level<24>()); };
    const auto in_haze = [&](const Positions& at, VertexStore& store) HWY_ATTR {
        const Haze haze(at, light);
        store.put_values(mixed(at.level<0>(), haze.rgb_255[0], haze.share),
            mixed(at.level<8>(), haze.rgb_255[1], haze.share), mixed(at.level<16>(), haze.rgb_255[2], haze.share),
            at.level<24>());
    };
    if (light.per_m > 0.0F) {
        project_each(from, projection, to, in_haze);
    } else {
        project_each(from, projection, to, own);
    }
}

void ProjectTextured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const TexelTransform& to_texels, const VertexOutputs& to) {
    project_each(from, projection, to, [&](const Positions& at, VertexStore& store) HWY_ATTR {
        const auto x = hn::Add(set(to_texels.at_eye.x), hn::Mul(at.x, set(to_texels.per_m.x)));
        const auto y = hn::Add(set(to_texels.at_eye.y), hn::Mul(at.y, set(to_texels.per_m.y)));
        const auto light_left = hn::Div(at.level<24>(), set(max_level));
        store.put_values(x, y, light_left, Haze(at, light).share);
    });
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octant::visuals::raster {

HWY_EXPORT(ProjectColoured);
HWY_EXPORT(ProjectTextured);

void project_coloured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const VertexOutputs& to) {
    assert(to.vertices.size() == from.size() && to.clip.size() == from.size());
    HWY_DYNAMIC_DISPATCH(ProjectColoured)(from, projection, light, to);
}

void project_textured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const TexelTransform& to_texels, const VertexOutputs& to) {
    assert(to.vertices.size() == from.size() && to.clip.size() == from.size());
    HWY_DYNAMIC_DISPATCH(ProjectTextured)(from, projection, light, to_texels, to);
}

} // namespace octant::visuals::raster
#endif
