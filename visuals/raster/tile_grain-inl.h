// Paints a triangle of ground with its fine pattern: colours, and places in the pattern, are right
// in perspective at both ends of sixteen pixels and even in between.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_INL
#undef OCTANT_RASTER_GRAIN_INL
#else
#define OCTANT_RASTER_GRAIN_INL
#endif

#include "visuals/raster/grain_image.h"
#include "visuals/raster/tile_texture-inl.h"
#include "visuals/scene/grain_pattern.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// What a triangle has at a pixel: red, green, blue and its share of the pattern; its place there.
struct GrainPoint {
    double w;
    std::array<double, 4> value;
    double x;
    double y;
};

/// The planes of a triangle with grain.
class GrainPlanes {
public:
    HWY_INLINE GrainPlanes(const TriangleExtra& extra, const GrainRays& rays)
        : extra_(extra)
        , rays_(rays) {}

    HWY_INLINE GrainPoint at(int column, int row) const {
        GrainPoint point;
        point.w = 1.0 / std::max(extra_.by_w[4].at(column, row), 1e-30);
        for (std::size_t i = 0; i < point.value.size(); ++i) {
            point.value[i] = extra_.by_w[i].at(column, row) * point.w;
        }
        point.x = rays_.at_eye.x + within(rays_.x.at(column, row) * point.w);
        point.y = rays_.at_eye.y + within(rays_.y.at(column, row) * point.w);
        return point;
    }

    /// How far the place moves from a pixel to the one below, squared, in texels.
    HWY_INLINE double down2(const GrainPoint& here) const {
        const double bend = extra_.by_w[4].per_y;
        const double x = (rays_.x.per_y - (here.x - rays_.at_eye.x) * bend) * here.w;
        const double y = (rays_.y.per_y - (here.y - rays_.at_eye.y) * bend) * here.w;
        return x * x + y * y;
    }

private:
    static constexpr double most_texels = 30000.0; ///< what 32 bits hold, 2^-16, and some more

    static HWY_INLINE double within(double texels) {
        return std::clamp(texels, -most_texels, most_texels);
    }

    const TriangleExtra& extra_;
    const GrainRays& rays_;
};

/// The pattern along a block, 2^-15: from -1 to 1.
struct BlockGrain {
    alignas(32) std::array<std::int16_t, block_px> share;
};

/// A level's pattern along a line of places, mixed from four texels.
HWY_INLINE void
sample_grain(const GrainImage::Level& level, const TexelLine& line, BlockGrain& to) {
    const Texels texels;
    const hn::RebindToSigned<Texels> sign;
    const hn::Rebind<std::int16_t, Texels> halves;
    const auto* const from = reinterpret_cast<const std::uint32_t*>(level.texels.data());
    const auto side = hn::Set(sign, level.size - 1);
    for (std::size_t i = 0; i < block_px; i += hn::MaxLanes(texels)) {
        const auto steps = hn::Iota(sign, static_cast<std::int32_t>(i));
        const auto place = [&](std::size_t k) HWY_ATTR {
            return hn::Add(
                hn::Set(sign, line.first[k]), hn::Mul(steps, hn::Set(sign, line.per_px[k])));
        };
        const auto x = place(0);
        const auto y = place(1);
        const auto column = hn::And(hn::ShiftRight<16>(x), side);
        const auto row = hn::And(hn::ShiftRight<16>(y), side);
        const auto next_row = hn::And(hn::Add(row, hn::Set(sign, 1)), side);
        const auto part = [&](auto at) HWY_ATTR {
            return hn::And(hn::ShiftRight<8>(at), hn::Set(sign, 0xff));
        };
        const auto right = part(x);
        const auto along_row = [&](auto in_row) HWY_ATTR {
            const auto offset = hn::Add(hn::Mul(in_row, hn::Set(sign, level.stride)), column);
            const auto both = hn::BitCast(sign, hn::GatherOffset(texels, from, offset));
            const auto byte = hn::Set(sign, 0xff);
            const auto here = hn::And(both, byte);
            const auto beside = hn::And(hn::ShiftRight<8>(both), byte);
            return hn::Add(hn::ShiftLeft<8>(here), hn::Mul(hn::Sub(beside, here), right));
        };
        const auto low = along_row(row);
        const auto high = along_row(next_row);
        const auto mean =
            hn::Add(low, hn::ShiftRight<8>(hn::Mul(hn::Sub(high, low), part(y))));
        const auto from_middle = hn::Sub(mean, hn::Set(sign, 128 * 256));
        hn::StoreU(hn::DemoteTo(halves, from_middle), halves, &to.share[i]);
    }
}

/// Places along a block in one of the pattern's levels.
HWY_INLINE TexelLine
grain_line(const GrainPoint& here, double step_x, double step_y, std::size_t level) {
    const double scale = texel_scale(level);
    const auto place = [&](double at) HWY_ATTR {
        return static_cast<std::int32_t>(at * scale - 32768.0);
    };
    return {
        {place(here.x), place(here.y)},
        {static_cast<std::int32_t>(step_x * scale), static_cast<std::int32_t>(step_y * scale)}};
}

/// A product of 2^-15 with 2^-15.
HWY_INLINE hn::Vec<PixelsSigned> product(hn::Vec<PixelsSigned> a, hn::Vec<PixelsSigned> b) {
    return hn::ShiftLeft<1>(hn::MulHigh(a, b));
}

/// The pattern by the levels that a block looks at.
HWY_INLINE BlockGrain
grain_of(const GrainImage& image, const GrainPoint& here, double step_x, double step_y, double size2) {
    // What the level above leaves out the pattern hardly has: its finest features are two texels.
    const TextureLevels chosen = levels_of(0.5 * size2, image.levels().size());
    BlockGrain grain;
    sample_grain(
        image.levels()[chosen.fine], grain_line(here, step_x, step_y, chosen.fine), grain);
    if (chosen.coarse_share == 0) {
        return grain;
    }
    BlockGrain coarse;
    const std::size_t next = chosen.fine + 1;
    sample_grain(image.levels()[next], grain_line(here, step_x, step_y, next), coarse);
    const PixelsSigned sign;
    const auto share = static_cast<std::int16_t>(chosen.coarse_share / 2);
    const auto to_coarse = hn::Set(sign, share);
    const auto to_fine = hn::Set(sign, static_cast<std::int16_t>(32767 - share));
    for (std::size_t i = 0; i < block_px; i += hn::Lanes(sign)) {
        const auto fine = hn::LoadU(sign, &grain.share[i]);
        const auto other = hn::LoadU(sign, &coarse.share[i]);
        hn::StoreU(
            hn::Add(product(fine, to_fine), product(other, to_coarse)), sign, &grain.share[i]);
    }
    return grain;
}

/// Adds a block's colours, each with its share of the pattern, to the sums.
HWY_INLINE void add_grained(
    const GrainPlanes& planes,
    const Levels& levels,
    const TileJob& job,
    const TextureBlock& block,
    TileBuffer& buffer) {
    const double by_px = 1.0 / block.px();
    const GrainPoint here = planes.at(block.at.x, block.at.y);
    const GrainPoint end = planes.at(block.at.x + block.px(), block.at.y);
    const double step_x = (end.x - here.x) * by_px;
    const double step_y = (end.y - here.y) * by_px;
    const double size2 = std::max(step_x * step_x + step_y * step_y, planes.down2(here));
    const BlockGrain grain = grain_of(*job.grain, here, step_x, step_y, size2);
    const auto share_at = [](const GrainPoint& point) HWY_ATTR {
        constexpr double unit = 32767.0 * static_cast<double>(scene::GrainPattern::most_share);
        return std::clamp(point.value[3], 0.0, 1.0) * unit;
    };
    const double first_share = share_at(here);
    const auto share_per_px =
        static_cast<std::int16_t>((share_at(end) - first_share) * by_px);
    const PixelsSigned sign;
    const Pixels px;
    for (std::size_t i = 0; i < block_px; i += hn::Lanes(px)) {
        const auto steps = hn::Iota(sign, static_cast<std::int16_t>(i));
        const auto along = [&](double first, std::int16_t per_px) HWY_ATTR {
            return hn::Add(
                hn::Set(sign, static_cast<std::int16_t>(first)),
                hn::Mul(steps, hn::Set(sign, per_px)));
        };
        const auto change =
            product(hn::LoadU(sign, &grain.share[i]), along(first_share, share_per_px));
        const auto count = hn::LoadU(px, block.counts + i);
        for (std::size_t k = 0; k < 3; ++k) {
            const double first = std::clamp((here.value[k] - 128.0) * 128.0, -32000.0, 32000.0);
            const double per_px = (end.value[k] - here.value[k]) * by_px * 128.0;
            const auto raw =
                along(first, static_cast<std::int16_t>(std::clamp(per_px, -2000.0, 2000.0)));
            const auto level = hn::Min(
                hn::Max(raw, hn::Set(sign, levels.least[k])), hn::Set(sign, levels.most[k]));
            // To 1/16 level from 0, rounded.
            const auto from_zero = hn::Add(hn::BitCast(px, level), hn::Set(px, 128 * 128 + 4));
            const auto own = hn::BitCast(sign, hn::ShiftRight<3>(from_zero));
            const auto changed =
                hn::Add(own, hn::ShiftRight<2>(hn::MulHigh(hn::ShiftLeft<3>(own), change)));
            const auto colour = hn::BitCast(
                px, hn::Min(hn::Max(changed, hn::Zero(sign)), hn::Set(sign, 255 * 16)));
            std::uint16_t* const sums = buffer.sums[k].data() + block.pixel + i;
            hn::StoreU(hn::Add(hn::LoadU(px, sums), hn::Mul(colour, count)), px, sums);
        }
    }
}

/// Paints a triangle of Fill::Grain that no plane cuts.
HWY_NOINLINE void paint_grain(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const TileBox box(*one.triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) {
        return;
    }
    const GrainPlanes planes(*one.extra, *job.grain_rays);
    const auto add = [&](const TextureBlock& block) HWY_ATTR {
        add_grained(planes, one.triangle->levels, job, block, buffer);
    };
    for (int left = box.left; left <= box.right; left += strip_px) {
        paint_textured_strip(*one.triangle, add, job, lanes, box, left, buffer);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
