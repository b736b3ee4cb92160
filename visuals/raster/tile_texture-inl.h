// Paints a textured triangle: places in the texture are corrected for perspective
// at both ends of sixteen pixels and even in between, and so are light and haze.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_TEXTURE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXTURE_INL
#undef OCTANT_RASTER_TEXTURE_INL
#else
#define OCTANT_RASTER_TEXTURE_INL
#endif

#include "visuals/raster/tile_fill-inl.h"
#include "visuals/raster/tile_levels-inl.h"

#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// Pixels of a strip whose value is not zero, a bit each.
HWY_INLINE std::uint32_t set_bits(const StripValues& values) {
    StripValues is_set;
    for (std::size_t i = 0; i < strip_parts; ++i) {
        is_set[i] = hn::VecFromMask(Strip(), hn::Ne(values[i], hn::Zero(Strip())));
    }
    return full_bits(is_set);
}

/// Pixels of a strip that are coloured from one place on.
struct TextureBlock {
    glm::ivec2 at;               ///< column and row of the picture
    int last_column;             ///< of the strip's pixels that the triangle covers
    std::uint32_t fresh;         ///< a bit for each of sixteen pixels that has new samples
    const std::uint16_t* counts; ///< how many, for each pixel
    std::size_t pixel;           ///< of the tile

    int px() const { return std::clamp(last_column - at.x, 1, block_px); }
};

/// What a textured triangle has at a pixel: its place in texels, light left and share of haze.
struct TexturePoint {
    double w;
    std::array<double, 4> value;

    HWY_INLINE TexturePoint(const TriangleExtra& extra, int column, int row)
        : w(1.0 / std::max(extra.by_w[4].at(column, row), 1e-30)) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            value[i] = extra.by_w[i].at(column, row) * w;
        }
    }
};

/// Values of 32 bits along a block.
struct BlockWalk {
    std::int32_t first;
    std::int32_t per_px;
};

/// `share`: one over the pixels between both.
HWY_INLINE BlockWalk walk_between(double from, double to, double share) {
    return {static_cast<std::int32_t>(from), static_cast<std::int32_t>((to - from) * share)};
}

/// How many texels of the finest level a pixel is wide, squared.
HWY_INLINE double
footprint2(const TriangleExtra& extra, const std::array<TexturePoint, 2>& ends, double share) {
    const auto& [here, end] = ends;
    const auto down = [&](std::size_t i) HWY_ATTR {
        return (extra.by_w[i].per_y - here.value[i] * extra.by_w[4].per_y) * here.w;
    };
    const double across_x = (end.value[0] - here.value[0]) * share;
    const double across_y = (end.value[1] - here.value[1]) * share;
    const double down_x = down(0);
    const double down_y = down(1);
    return std::max(across_x * across_x + across_y * across_y, down_x * down_x + down_y * down_y);
}

/// Which levels of the texture a block is coloured by.
struct TextureLevels {
    std::size_t fine = 0;
    std::uint16_t coarse_share = 0; ///< of the next level, 2^-16
};

/// Most blocks take one level: the next one comes in over a third of the way only.
HWY_INLINE TextureLevels levels_of(double size2, std::size_t count) {
    constexpr double band = 1.0 / 3.0;
    if (!(size2 > 1.0)) {
        return {};
    }
    // The logarithm to base 2, straight between whole numbers: wrong by less than 0.09.
    const auto bits = std::bit_cast<std::uint64_t>(size2);
    const double log2 =
        static_cast<double>(static_cast<std::int64_t>(bits >> 20U)) * 0x1p-32 - 1023.0;
    const double level = 0.5 * log2;
    const auto whole = static_cast<std::size_t>(level);
    if (whole + 1 >= count) {
        return {count - 1, 0};
    }
    const double part = level - static_cast<double>(whole);
    const double share = std::clamp((part - 0.5) / band + 0.5, 0.0, 1.0);
    if (share >= 1.0) {
        return {whole + 1, 0};
    }
    return {whole, static_cast<std::uint16_t>(share * 65535.0)};
}

/// Four texels around a place, mixed: red, green, blue and nothing in 1/128 level, 32,640 at most.
HWY_INLINE void mix_texels(
    const std::uint32_t* low, int width, std::uint16_t right, std::uint16_t up, std::uint16_t* to) {
    const hn::FixedTag<std::uint8_t, 8> bytes;
    const hn::FixedTag<std::uint16_t, 8> two;
    const hn::FixedTag<std::uint64_t, 2> halves;
    const auto texels = [&](const std::uint32_t* from) HWY_ATTR {
        return hn::PromoteTo(two, hn::LoadU(bytes, reinterpret_cast<const std::uint8_t*>(from)));
    };
    const auto up_share = hn::Set(two, up);
    const auto column = hn::Add(
        hn::Mul(texels(low), hn::Sub(hn::Set(two, 128), up_share)),
        hn::Mul(texels(low + width), up_share));
    // The left texel has what the right one leaves of 65,535.
    alignas(16) static constexpr std::array<std::uint16_t, 8> left{
        0xffff, 0xffff, 0xffff, 0xffff, 0, 0, 0, 0};
    const auto weighed =
        hn::MulHigh(column, hn::Xor(hn::Set(two, right), hn::Load(two, left.data())));
    const auto swapped = hn::BitCast(two, hn::Shuffle01(hn::BitCast(halves, weighed)));
    hn::StoreU(hn::LowerHalf(hn::Add(weighed, swapped)), hn::Half<decltype(two)>(), to);
}

/// The texture's colours along a block, from one of its levels: 1/128 level, four values a pixel.
HWY_INLINE void sample_texture(
    const GroundImage& image,
    std::size_t number,
    const std::array<TexturePoint, 2>& ends,
    double share,
    std::uint32_t pixels,
    std::uint16_t* to) {
    const GroundImage::Level& level = image.levels()[number];
    const double scale = 65536.0 / static_cast<double>(std::uint64_t{1} << number);
    const auto walk = [&](std::size_t i, int size) HWY_ATTR {
        const auto at = [&](const TexturePoint& end) HWY_ATTR {
            const double place = (end.value[i] + 0.5) * scale - 32768.0;
            return std::clamp(place, 0.0, (size - 1) * 65536.0 - 1.0);
        };
        return walk_between(at(ends[0]), at(ends[1]), share);
    };
    const BlockWalk x = walk(0, level.width);
    const BlockWalk y = walk(1, level.height);
    const std::int32_t most_x = (level.width - 1) * 65536 - 1;
    const std::int32_t most_y = (level.height - 1) * 65536 - 1;
    const int last = 31 - std::countl_zero(pixels);
    for (int i = std::countr_zero(pixels); i <= last; ++i) {
        const std::int32_t at_x = std::clamp(x.first + i * x.per_px, 0, most_x);
        const std::int32_t at_y = std::clamp(y.first + i * y.per_px, 0, most_y);
        const std::ptrdiff_t first = std::ptrdiff_t{at_y >> 16} * level.width + (at_x >> 16);
        mix_texels(
            level.texels.data() + first,
            level.width,
            static_cast<std::uint16_t>(at_x),
            static_cast<std::uint16_t>((at_y & 0xffff) >> 9),
            to + 4 * i);
    }
}

/// Colours a block.
HWY_INLINE void add_texture(
    const TriangleExtra& extra, const TileJob& job, const TextureBlock& block, TileBuffer& buffer) {
    static constexpr auto one_over = [] {
        std::array<double, block_px + 1> shares{};
        for (int px = 1; px <= block_px; ++px) {
            shares[static_cast<std::size_t>(px)] = 1.0 / px;
        }
        return shares;
    }();
    const double by_px = one_over[static_cast<std::size_t>(block.px())];
    const std::array ends{
        TexturePoint(extra, block.at.x, block.at.y),
        TexturePoint(extra, block.at.x + block.px(), block.at.y)};
    const TextureLevels chosen =
        levels_of(footprint2(extra, ends, by_px), job.ground->levels().size());
    alignas(64) std::array<std::uint16_t, std::size_t{4} * block_px> own{};
    alignas(64) std::array<std::uint16_t, std::size_t{4} * block_px> coarse;
    sample_texture(*job.ground, chosen.fine, ends, by_px, block.fresh, own.data());
    if (chosen.coarse_share > 0) {
        coarse.fill(0);
        sample_texture(*job.ground, chosen.fine + 1, ends, by_px, block.fresh, coarse.data());
    }
    const Pixels values;
    const auto share = [&](std::size_t i) HWY_ATTR {
        const auto at_end = [&](std::size_t end) HWY_ATTR {
            return std::clamp(ends[end].value[i], 0.0, 1.0) * 65535.0;
        };
        return walk_between(at_end(0), at_end(1), by_px);
    };
    const BlockWalk light = share(2);
    const BlockWalk haze = share(3);
    const auto along = [&](const BlockWalk& walk, std::size_t i) HWY_ATTR {
        const auto steps = hn::Iota(values, static_cast<std::uint16_t>(i));
        return hn::Add(
            hn::Set(values, static_cast<std::uint16_t>(walk.first)),
            hn::Mul(steps, hn::Set(values, static_cast<std::uint16_t>(walk.per_px))));
    };
    const auto coarse_share = hn::Set(values, chosen.coarse_share);
    const auto part_of =
        [&](hn::Vec<Pixels> from, hn::Vec<Pixels> to, hn::Vec<Pixels> how_much) HWY_ATTR {
            return hn::Add(hn::Sub(from, hn::MulHigh(from, how_much)), hn::MulHigh(to, how_much));
        };
    for (std::size_t i = 0; i < block_px; i += hn::Lanes(values)) {
        std::array<hn::Vec<Pixels>, 4> mine;
        hn::LoadInterleaved4(values, own.data() + 4 * i, mine[0], mine[1], mine[2], mine[3]);
        if (chosen.coarse_share > 0) {
            std::array<hn::Vec<Pixels>, 4> next;
            hn::LoadInterleaved4(values, coarse.data() + 4 * i, next[0], next[1], next[2], next[3]);
            for (std::size_t k = 0; k < 3; ++k) {
                mine[k] = part_of(mine[k], next[k], coarse_share);
            }
        }
        const auto light_left = along(light, i);
        const auto haze_share = along(haze, i);
        const auto count = hn::LoadU(values, block.counts + i);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto haze_level = hn::Set(
                values,
                static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F));
            const auto seen = part_of(hn::MulHigh(mine[k], light_left), haze_level, haze_share);
            const auto colour = hn::ShiftRight<3>(hn::Add(seen, hn::Set(values, 4)));
            std::uint16_t* const sums = buffer.sums[k].data() + block.pixel + i;
            hn::StoreU(hn::Add(hn::LoadU(values, sums), hn::Mul(colour, count)), values, sums);
        }
    }
}

/// Colours what is new in a row of a strip.
HWY_INLINE void add_textured_row(
    const TriangleExtra& extra,
    const TileJob& job,
    const glm::ivec2& at,
    const StripValues& masks,
    const StripValues& fresh,
    std::size_t pixel,
    TileBuffer& buffer) {
    const std::uint32_t fresh_bits = set_bits(fresh);
    if (fresh_bits == 0) {
        return;
    }
    alignas(64) std::array<std::uint16_t, strip_px + block_px> counts;
    for (std::size_t i = 0; i < strip_parts; ++i) {
        hn::Store(hn::PopulationCount(fresh[i]), Strip(), counts.data() + i * part_px);
    }
    std::fill(counts.begin() + strip_px, counts.end(), std::uint16_t{0});
    const std::uint32_t covered_bits = set_bits(masks);
    const int last = 31 - std::countl_zero(covered_bits);
    for (int first = std::countr_zero(covered_bits); first <= last; first += block_px) {
        const std::uint32_t in_block = fresh_bits >> first & 0xffffU;
        if (in_block != 0) {
            const TextureBlock block{
                at + glm::ivec2(first, 0),
                at.x + last,
                in_block,
                counts.data() + first,
                pixel + static_cast<std::size_t>(first)};
            add_texture(extra, job, block, buffer);
        }
    }
}

/// Paints the strip of a textured triangle that begins at a column of the tile.
HWY_INLINE void paint_textured_strip(
    const TileTriangle& one,
    const TileJob& job,
    const SampleLanes& lanes,
    const TileBox& box,
    int left,
    TileBuffer& buffer) {
    const std::uint32_t columns = box.columns_of_strip(left);
    const std::uint64_t wide_columns = std::uint64_t{columns} << left;
    const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
    StripCoverage coverage(*one.triangle, first_px, columns, lanes);
    for (int row = box.first_row; row <= box.last_row; ++row) {
        std::uint64_t& full = buffer.full[static_cast<std::size_t>(row)];
        if ((wide_columns & ~full) != 0) {
            const auto pixel = static_cast<std::size_t>(row * tile_width + left);
            const StripValues masks = coverage.samples();
            StripValues fresh;
            StripValues after;
            for (std::size_t i = 0; i < strip_parts; ++i) {
                std::uint16_t* const covered = buffer.covered.data() + pixel + i * part_px;
                const auto before = hn::LoadU(Strip(), covered);
                fresh[i] = hn::AndNot(before, masks[i]);
                after[i] = hn::Or(before, masks[i]);
                hn::StoreU(after[i], Strip(), covered);
            }
            full |= std::uint64_t{full_bits(after)} << left;
            buffer.full_rows |= std::uint32_t{(full & job.full_row()) == job.full_row()} << row;
            const glm::ivec2 at = job.first_px + glm::ivec2(left, row);
            add_textured_row(*one.extra, job, at, masks, fresh, pixel, buffer);
        }
        coverage.next_row();
    }
}

/// Paints a triangle of Fill::Texture that no plane cuts.
HWY_NOINLINE void paint_texture(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const TileBox box(*one.triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) {
        return;
    }
    for (int left = box.left; left <= box.right; left += strip_px) {
        paint_textured_strip(one, job, lanes, box, left, buffer);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
