// The colours of a texture along sixteen pixels of a triangle. Included once for each instruction set.
#if defined(OCTANT_RASTER_TEXELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXELS_INL
#undef OCTANT_RASTER_TEXELS_INL
#else
#define OCTANT_RASTER_TEXELS_INL
#endif

#include "visuals/raster/bilinear_filter-inl.h"
#include "visuals/raster/tile_fill-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

using Reals = hn::CappedTag<double, 4>;
constexpr std::size_t four_parts = 4 / hn::MaxLanes(Reals());

/// Four values of a corner or a pixel.
using Four = std::array<hn::Vec<Reals>, four_parts>;

template <class Of>
HWY_INLINE Four four(const Of& of) {
    Four result;
    for (std::size_t i = 0; i < four_parts; ++i) { result[i] = of(i); }
    return result;
}

HWY_INLINE hn::Vec<Reals> real(double value) { return hn::Set(Reals(), value); }

/// What a textured triangle has at a pixel: its place in texels, light left and share of haze.
struct TexturePoint {
    double w;
    Four value;
};

/// The planes of a textured triangle, its four values next to each other.
struct TexturePlanes {
    AttributePlane over_w;
    Four base;
    Four per_x;
    Four per_y;

    HWY_INLINE explicit TexturePlanes(const TriangleExtra& extra)
        : over_w(extra.over_w[4]), base(values_of(extra, &AttributePlane::base)),
          per_x(values_of(extra, &AttributePlane::per_x)), per_y(values_of(extra, &AttributePlane::per_y)) {}

    HWY_INLINE TexturePoint at(double column, double row) const {
        const double w = 1.0 / std::max(over_w.at(column, row), 1e-30);
        const auto x = real(column);
        const auto y = real(row);
        return {w, four([&](std::size_t i) HWY_ATTR {
                    const auto across = hn::Add(base[i], hn::Mul(per_x[i], x));
                    return hn::Mul(hn::Add(across, hn::Mul(per_y[i], y)), real(w));
                })};
    }

private:
    static HWY_INLINE Four values_of(const TriangleExtra& extra, double AttributePlane::*part) {
        alignas(32) std::array<double, 4> values;
        for (std::size_t i = 0; i < values.size(); ++i) { values[i] = extra.over_w[i].*part; }
        return four([&](std::size_t i) HWY_ATTR { return hn::Load(Reals(), &values[i * hn::MaxLanes(Reals())]); });
    }
};

/// Values of 32 bits along a block.
struct BlockStepper {
    alignas(16) std::array<std::int32_t, 4> first;
    alignas(16) std::array<std::int32_t, 4> per_px;

    /// `share`: one over the pixels between both.
    HWY_INLINE BlockStepper(const Four& from, const Four& to, double share) {
        const hn::Rebind<std::int32_t, Reals> whole;
        for (std::size_t i = 0; i < four_parts; ++i) {
            const std::size_t at = i * hn::MaxLanes(Reals());
            const auto step = hn::Mul(hn::Sub(to[i], from[i]), real(share));
            hn::StoreU(hn::DemoteTo(whole, from[i]), whole, &first[at]);
            hn::StoreU(hn::DemoteTo(whole, step), whole, &per_px[at]);
        }
    }
};

HWY_INLINE TexelDerivatives texel_derivatives(
    const TexturePlanes& planes, const std::array<TexturePoint, 2>& ends, double share) {
    const auto& [here, end] = ends;
    // The first two values are the place.
    const auto place = [](hn::Vec<Reals> step) HWY_ATTR {
        alignas(32) std::array<double, 4> values;
        hn::Store(step, Reals(), values.data());
        return std::array{values[0], values[1]};
    };
    const auto turned = hn::Mul(here.value[0], real(planes.over_w.per_y));
    return {place(hn::Mul(hn::Sub(end.value[0], here.value[0]), real(share))),
        place(hn::Mul(hn::Sub(planes.per_y[0], turned), real(here.w)))};
}

/// Red, green and blue of a block's pixels, 1/128 level, 32,640 at most.
struct BlockColours {
    alignas(32) std::array<std::array<std::uint16_t, block_px>, 3> level;
};

/// Places of a level along a block, 2^-16 texel: at its first pixel and from each to the next.
struct TexelSpan {
    std::array<std::int32_t, 2> first;
    std::array<std::int32_t, 2> per_px;
};

/// Steps of a level's places, 2^-16 texel, in a texel of the finest level.
HWY_INLINE double texel_scale(std::size_t level) { return 65536.0 / static_cast<double>(std::uint64_t{1} << level); }

/// The places of a level that a pixel's colour is the mean of, 2^-16 texel.
struct Probes {
    int count;
    std::uint16_t share;              ///< 2^-16
    std::array<std::int32_t, 2> last; ///< from the pixel's middle
    std::array<std::int32_t, 2> step; ///< to the next one

    HWY_INLINE Probes(const MipSelection& levels, std::size_t level)
        : count(levels.probes), share(static_cast<std::uint16_t>(65535 / levels.probes)) {
        const double scale = texel_scale(level);
        for (std::size_t k = 0; k < 2; ++k) {
            last[k] = static_cast<std::int32_t>(static_cast<double>(levels.reach[k]) * scale);
            step[k] = count > 1 ? 2 * last[k] / (count - 1) : 0;
        }
    }

    /// The mean of colours_at(how far from the pixel's middle).
    template <class Halves, class ColoursAt>
    HWY_INLINE FilteredColours<Halves> mean(const ColoursAt& colours_at) const {
        FilteredColours<Halves> sum = colours_at(-last[0], -last[1]);
        if (count == 1) { return sum; }
        const auto part = hn::Set(Halves(), share);
        for (auto& colour : sum) { colour = hn::MulHigh(colour, part); }
        for (int k = 1; k < count; ++k) {
            const FilteredColours<Halves> one = colours_at(k * step[0] - last[0], k * step[1] - last[1]);
            for (std::size_t i = 0; i < sum.size(); ++i) { sum[i] = hn::Add(sum[i], hn::MulHigh(one[i], part)); }
        }
        return sum;
    }
};

/// A level's colours along a block.
HWY_INLINE void sample_line(
    const LitGroundTexture::MipLevel& level, const TexelSpan& line, const Probes& probes, BlockColours& to) {
    const Pixels pixels;
    const hn::RebindToSigned<hn::Repartition<std::uint32_t, Pixels>> sign;
    const TexelGrid<TexelsOf<Pixels>> grid(level);
    for (std::size_t i = 0; i < block_px; i += hn::MaxLanes(pixels)) {
        const auto even_px = hn::ShiftLeft<1>(lane_indices_from(sign, i / 2));
        const auto even = [&](std::size_t k) HWY_ATTR {
            return hn::Add(hn::Set(sign, line.first[k]), hn::Mul(even_px, hn::Set(sign, line.per_px[k])));
        };
        const auto next = [&](std::size_t k) HWY_ATTR { return hn::Add(even(k), hn::Set(sign, line.per_px[k])); };
        const std::array x{even(0), next(0)};
        const std::array y{even(1), next(1)};
        const auto colours = probes.mean<Pixels>([&](std::int32_t dx, std::int32_t dy) HWY_ATTR {
            const auto off_x = hn::Set(sign, dx);
            const auto off_y = hn::Set(sign, dy);
            return filter_bilinear<Pixels>(
                grid, hn::Add(x[0], off_x), hn::Add(y[0], off_y), hn::Add(x[1], off_x), hn::Add(y[1], off_y));
        });
        for (std::size_t k = 0; k < colours.size(); ++k) { hn::StoreU(colours[k], pixels, &to.level[k][i]); }
    }
}

/// The texture's colours along a block, from one of its levels.
HWY_INLINE void sample_texture(const LitGroundTexture& image, std::size_t number, const MipSelection& chosen,
    const std::array<TexturePoint, 2>& ends, double share, BlockColours& to) {
    const LitGroundTexture::MipLevel& level = image.levels()[number];
    const double scale = texel_scale(number);
    const auto places = [&](const TexturePoint& end) HWY_ATTR {
        return four([&](std::size_t i) HWY_ATTR {
            const auto place = hn::Sub(hn::Mul(hn::Add(end.value[i], real(0.5)), real(scale)), real(32768.0));
            const auto limit = hn::Load(Reals(), &level.last_place[i * hn::MaxLanes(Reals())]);
            return hn::Min(hn::Max(place, real(0.0)), limit);
        });
    };
    const BlockStepper walk(places(ends[0]), places(ends[1]), share);
    sample_line(level, {{walk.first[0], walk.first[1]}, {walk.per_px[0], walk.per_px[1]}}, Probes(chosen, number), to);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
