// Paints a triangle of ground with its fine pattern: colours, and places in the pattern, are right
// in perspective at both ends of at most 32 pixels of a row and even in between.
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
#include <bit>
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

/// What a triangle with grain has along pixels of a row, from their first one on.
struct GrainRow {
    std::array<double, 2> place;
    std::array<double, 2> place_per_px;
    std::array<double, 4> value;
    std::array<double, 4> value_per_px;
    double across2; ///< how many texels a pixel is wide and high, squared
    double down2;

    HWY_INLINE GrainRow(const GrainPlanes& planes, const glm::ivec2& at, int px) {
        static constexpr auto one_over = [] {
            std::array<double, strip_px> shares{};
            for (int count = 1; count < strip_px; ++count) {
                shares[static_cast<std::size_t>(count)] = 1.0 / count;
            }
            return shares;
        }();
        const double share = one_over[static_cast<std::size_t>(px)];
        const GrainPoint here = planes.at(at.x, at.y);
        const GrainPoint end = planes.at(at.x + px, at.y);
        place = {here.x, here.y};
        place_per_px = {(end.x - here.x) * share, (end.y - here.y) * share};
        for (std::size_t i = 0; i < value.size(); ++i) {
            value[i] = here.value[i];
            value_per_px[i] = (end.value[i] - here.value[i]) * share;
        }
        across2 = place_per_px[0] * place_per_px[0] + place_per_px[1] * place_per_px[1];
        down2 = planes.down2(here);
    }
};

/// The pattern along a strip, 2^-15: from -1 to 1; and what is worked out beyond it.
using StripGrain = std::array<std::int16_t, 3 * strip_px>;

/// Places in a level of the pattern, 2^-16 texel, and their steps.
struct GrainLine {
    std::array<std::int32_t, 2> first;
    std::array<std::int32_t, 2> step;

    HWY_INLINE GrainLine(const GrainRow& along, std::size_t level, int px_a_step) {
        const double scale = texel_scale(level);
        for (std::size_t k = 0; k < 2; ++k) {
            first[k] = static_cast<std::int32_t>(along.place[k] * scale - 32768.0);
            step[k] = static_cast<std::int32_t>(along.place_per_px[k] * (scale * px_a_step));
        }
    }
};

using GrainTexels = hn::CappedTag<std::uint32_t, 8>;
using GrainValues = hn::RebindToSigned<GrainTexels>;
constexpr int grain_at_once = static_cast<int>(hn::MaxLanes(GrainTexels()));

/// A level's pattern at some places of a line, from one on, mixed from four texels; 2^-15.
HWY_INLINE hn::Vec<GrainValues>
grain_at(const GrainImage::Level& level, const GrainLine& line, int number) {
    const GrainValues sign;
    const auto* const from = reinterpret_cast<const std::uint32_t*>(level.texels.data());
    const auto side = hn::Set(sign, level.size - 1);
    const auto byte = hn::Set(sign, 0xff);
    const auto steps = hn::Iota(sign, number);
    const auto x =
        hn::Add(hn::Set(sign, line.first[0]), hn::Mul(steps, hn::Set(sign, line.step[0])));
    const auto y =
        hn::Add(hn::Set(sign, line.first[1]), hn::Mul(steps, hn::Set(sign, line.step[1])));
    const auto column = hn::And(hn::ShiftRight<16>(x), side);
    const auto row = hn::And(hn::ShiftRight<16>(y), side);
    const auto next_row = hn::And(hn::Add(row, hn::Set(sign, 1)), side);
    const auto right = hn::And(hn::ShiftRight<8>(x), byte);
    const auto up = hn::And(hn::ShiftRight<8>(y), byte);
    const auto along_row = [&](hn::Vec<GrainValues> in_row) HWY_ATTR {
        const auto offset = hn::Add(hn::Mul(in_row, hn::Set(sign, level.stride)), column);
        const auto both = hn::BitCast(sign, hn::GatherOffset(GrainTexels(), from, offset));
        const auto here = hn::And(both, byte);
        const auto beside = hn::And(hn::ShiftRight<8>(both), byte);
        return hn::Add(hn::ShiftLeft<8>(here), hn::Mul(hn::Sub(beside, here), right));
    };
    const auto low = along_row(row);
    const auto high = along_row(next_row);
    const auto mean = hn::Add(low, hn::ShiftRight<8>(hn::Mul(hn::Sub(high, low), up)));
    return hn::Sub(mean, hn::Set(sign, 128 * 256));
}

/// The pattern at each of `px` pixels.
HWY_INLINE void
sample_each(const GrainImage::Level& level, const GrainLine& line, int px, std::int16_t* to) {
    const hn::Rebind<std::int16_t, GrainValues> halves;
    for (int i = 0; i < px; i += grain_at_once) {
        hn::StoreU(hn::DemoteTo(halves, grain_at(level, line, i)), halves, to + i);
    }
}

/// The pattern at every second pixel, and the mean of both neighbours in between.
HWY_INLINE void sample_every_second(
    const GrainImage::Level& level, const GrainLine& line, int px, std::int16_t* to) {
    const GrainValues sign;
    const hn::Repartition<std::int16_t, GrainValues> halves;
    std::array<std::int32_t, strip_px / 2 + 2 * grain_at_once> each;
    for (int i = 0; 2 * i < px + 2; i += grain_at_once) {
        hn::StoreU(grain_at(level, line, i), sign, &each[static_cast<std::size_t>(i)]);
    }
    for (int i = 0; 2 * i < px; i += grain_at_once) {
        const auto here = hn::LoadU(sign, &each[static_cast<std::size_t>(i)]);
        const auto next = hn::LoadU(sign, &each[static_cast<std::size_t>(i) + 1]);
        const auto between = hn::ShiftLeft<15>(hn::Add(here, next));
        const auto upper = hn::AndNot(hn::Set(sign, 0xffff), between);
        const auto both = hn::Or(hn::And(here, hn::Set(sign, 0xffff)), upper);
        hn::StoreU(hn::BitCast(halves, both), halves, to + 2 * i);
    }
}

/// One level's pattern along a row. Where pixels look much farther down than across, the level is
/// so coarse that every second pixel tells enough.
HWY_INLINE void sample_grain(
    const GrainImage& image, std::size_t level, const GrainRow& along, int px, std::int16_t* to) {
    if (4.0 * along.across2 < along.down2) {
        sample_every_second(image.levels()[level], GrainLine(along, level, 2), px, to);
    } else {
        sample_each(image.levels()[level], GrainLine(along, level, 1), px, to);
    }
}

/// A product of 2^-15 with 2^-15.
HWY_INLINE hn::Vec<StripSigned> product(hn::Vec<StripSigned> a, hn::Vec<StripSigned> b) {
    return hn::ShiftLeft<1>(hn::MulHigh(a, b));
}

/// The pattern by the levels that a row looks at, from its first pixel on.
HWY_INLINE void
grain_along(const GrainImage& image, const GrainRow& along, int px, std::int16_t* grain) {
    // The pattern's finest features are two texels wide: half a level finer than usual will do.
    const double size2 = 0.5 * std::max(along.across2, along.down2);
    const TextureLevels chosen = levels_of(size2, image.levels().size());
    sample_grain(image, chosen.fine, along, px, grain);
    if (chosen.coarse_share == 0) {
        return;
    }
    StripGrain coarse;
    sample_grain(image, chosen.fine + 1, along, px, coarse.data());
    const StripSigned sign;
    const auto share = static_cast<std::int16_t>(chosen.coarse_share / 2);
    const auto to_coarse = hn::Set(sign, share);
    const auto to_fine = hn::Set(sign, static_cast<std::int16_t>(32767 - share));
    for (std::size_t i = 0; i < static_cast<std::size_t>(px); i += part_px) {
        const auto fine = hn::LoadU(sign, grain + i);
        const auto other = hn::LoadU(sign, &coarse[i]);
        hn::StoreU(hn::Add(product(fine, to_fine), product(other, to_coarse)), sign, grain + i);
    }
}

/// Numbers of 16 bits along a strip. What lies outside the triangle may be any number.
struct StripWalk {
    std::int16_t first;
    std::int16_t per_px;

    HWY_INLINE StripWalk(double at_first, double step)
        : first(static_cast<std::int16_t>(
              static_cast<std::int32_t>(std::clamp(at_first, -2147483648.0, 2147483647.0))))
        , per_px(static_cast<std::int16_t>(std::clamp(step, -2000.0, 2000.0))) {}

    HWY_INLINE hn::Vec<StripSigned> at(std::size_t pixel) const {
        const StripSigned sign;
        const auto steps = hn::Iota(sign, static_cast<std::int16_t>(pixel));
        return hn::Add(hn::Set(sign, first), hn::Mul(steps, hn::Set(sign, per_px)));
    }
};

/// What a triangle newly covers in a row of a strip.
struct NewPixels {
    glm::ivec2 at;            ///< the strip's first pixel in the picture ...
    std::size_t pixel;        ///< ... and in the tile
    const StripValues& fresh; ///< samples
    std::uint32_t pixels;     ///< those with any, a bit each; at least one
};

/// Adds the colours of new samples, each pixel's with its share of the pattern.
HWY_INLINE void add_grained_row(
    const GrainPlanes& planes,
    const Levels& levels,
    const GrainImage& image,
    const NewPixels& row,
    TileBuffer& buffer) {
    const int first = std::countr_zero(row.pixels);
    const int last = 31 - std::countl_zero(row.pixels);
    const GrainRow along(planes, row.at + glm::ivec2(first, 0), std::max(last - first, 1));
    alignas(64) StripGrain grain{};
    grain_along(image, along, last - first + 1, grain.data() + first);
    const auto walk = [&](std::size_t k, double middle, double unit) HWY_ATTR {
        const double per_px = along.value_per_px[k] * unit;
        return StripWalk((along.value[k] - middle) * unit - first * per_px, per_px);
    };
    constexpr double share_unit = 32767.0 * static_cast<double>(scene::GrainPattern::most_share);
    const StripWalk share = walk(3, 0.0, share_unit);
    const std::array walks{walk(0, 128.0, 128.0), walk(1, 128.0, 128.0), walk(2, 128.0, 128.0)};
    const StripSigned sign;
    for (std::size_t i = 0; i < strip_parts; ++i) {
        const std::size_t part = i * part_px;
        const auto within = hn::Max(share.at(part), hn::Zero(sign));
        const auto change = product(hn::Load(sign, &grain[part]), within);
        const auto counts = hn::PopulationCount(row.fresh[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto level = hn::Min(
                hn::Max(walks[k].at(part), hn::Set(sign, levels.least[k])),
                hn::Set(sign, levels.most[k]));
            const auto own = hn::BitCast(sign, from_level(level));
            const auto changed =
                hn::Add(own, hn::ShiftRight<2>(hn::MulHigh(hn::ShiftLeft<3>(own), change)));
            const auto colour = hn::BitCast(Strip(), hn::Min(changed, hn::Set(sign, 255 * 16)));
            std::uint16_t* const sums = buffer.sums[k].data() + row.pixel + part;
            hn::StoreU(hn::Add(hn::LoadU(Strip(), sums), hn::Mul(colour, counts)), Strip(), sums);
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
    const auto add_row = [&](const glm::ivec2& at,
                             const StripValues&,
                             const StripValues& fresh,
                             std::size_t pixel) HWY_ATTR {
        const std::uint32_t pixels = set_bits(fresh);
        if (pixels != 0) {
            add_grained_row(
                planes, one.triangle->levels, *job.grain, {at, pixel, fresh, pixels}, buffer);
        }
    };
    for (int left = box.left; left <= box.right; left += strip_px) {
        paint_strip_by_rows(*one.triangle, add_row, job, lanes, box, left, buffer);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
