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
    const std::uint16_t* counts; ///< of new samples of each of its sixteen pixels
    std::size_t pixel;           ///< of the tile

    int px() const { return std::clamp(last_column - at.x, 1, block_px); }
};

using Reals = hn::CappedTag<double, 4>;
constexpr std::size_t four_parts = 4 / hn::MaxLanes(Reals());

/// Four values of a corner or a pixel.
using Four = std::array<hn::Vec<Reals>, four_parts>;

template <class Of>
HWY_INLINE Four four(const Of& of) {
    Four result;
    for (std::size_t i = 0; i < four_parts; ++i) {
        result[i] = of(i);
    }
    return result;
}

HWY_INLINE hn::Vec<Reals> real(double value) {
    return hn::Set(Reals(), value);
}

/// What a textured triangle has at a pixel: its place in texels, light left and share of haze.
struct TexturePoint {
    double w;
    Four value;
};

/// The planes of a textured triangle, its four values next to each other.
struct TexturePlanes {
    RealPlane by_w;
    Four base;
    Four per_x;
    Four per_y;

    HWY_INLINE explicit TexturePlanes(const TriangleExtra& extra)
        : by_w(extra.by_w[4])
        , base(values_of(extra, &RealPlane::base))
        , per_x(values_of(extra, &RealPlane::per_x))
        , per_y(values_of(extra, &RealPlane::per_y)) {}

    HWY_INLINE TexturePoint at(int column, int row) const {
        const double w = 1.0 / std::max(by_w.at(column, row), 1e-30);
        const auto x = real(column);
        const auto y = real(row);
        return {w, four([&](std::size_t i) HWY_ATTR {
                    const auto across = hn::Add(base[i], hn::Mul(per_x[i], x));
                    return hn::Mul(hn::Add(across, hn::Mul(per_y[i], y)), real(w));
                })};
    }

private:
    static HWY_INLINE Four values_of(const TriangleExtra& extra, double RealPlane::*part) {
        alignas(32) std::array<double, 4> values;
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = extra.by_w[i].*part;
        }
        return four([&](std::size_t i)
                        HWY_ATTR { return hn::Load(Reals(), &values[i * hn::MaxLanes(Reals())]); });
    }
};

/// Values of 32 bits along a block.
struct BlockWalk {
    alignas(16) std::array<std::int32_t, 4> first;
    alignas(16) std::array<std::int32_t, 4> per_px;

    /// `share`: one over the pixels between both.
    HWY_INLINE BlockWalk(const Four& from, const Four& to, double share) {
        const hn::Rebind<std::int32_t, Reals> whole;
        for (std::size_t i = 0; i < four_parts; ++i) {
            const std::size_t at = i * hn::MaxLanes(Reals());
            const auto step = hn::Mul(hn::Sub(to[i], from[i]), real(share));
            hn::StoreU(hn::DemoteTo(whole, from[i]), whole, &first[at]);
            hn::StoreU(hn::DemoteTo(whole, step), whole, &per_px[at]);
        }
    }
};

/// How many texels of the finest level a pixel is wide, squared.
HWY_INLINE double
footprint2(const TexturePlanes& planes, const std::array<TexturePoint, 2>& ends, double share) {
    const auto& [here, end] = ends;
    const Reals reals;
    // The first two values are the place.
    const auto squared = [&](hn::Vec<Reals> step) HWY_ATTR {
        const auto squares = hn::Mul(step, step);
        return hn::GetLane(hn::Add(squares, hn::Reverse2(reals, squares)));
    };
    const auto across = hn::Mul(hn::Sub(end.value[0], here.value[0]), real(share));
    const auto down = hn::Mul(
        hn::Sub(planes.per_y[0], hn::Mul(here.value[0], real(planes.by_w.per_y))), real(here.w));
    return std::max(squared(across), squared(down));
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

/// Red, green and blue of a block's pixels, 1/128 level, 32,640 at most.
struct BlockColours {
    alignas(32) std::array<std::array<std::uint16_t, block_px>, 3> level;
};

using Texels = hn::CappedTag<std::uint32_t, block_px>;
using TexelHalves = hn::Repartition<std::uint16_t, Texels>;

/// Two bytes of each texel, those that lie `shift` bits up and sixteen further.
template <int shift>
HWY_INLINE hn::Vec<TexelHalves> two_bytes(hn::Vec<Texels> texels) {
    const auto low = shift == 0 ? texels : hn::ShiftRight<shift>(texels);
    return hn::BitCast(TexelHalves(), hn::And(low, hn::Set(Texels(), 0x00ff00ffU)));
}

/// The same sixteen bits in both halves.
HWY_INLINE hn::Vec<TexelHalves> in_both_halves(hn::Vec<Texels> value) {
    return hn::BitCast(TexelHalves(), hn::Or(value, hn::ShiftLeft<16>(value)));
}

/// Texels around places: those left below, right below, left above and right above.
struct TexelSquares {
    std::array<hn::Vec<Texels>, 4> corner;
    hn::Vec<TexelHalves> right; ///< share of the right ones, 2^-16
    hn::Vec<TexelHalves> up;    ///< share of the upper ones, 1/128

    /// `x`, `y`: places in 2^-16 texel, at least a texel within the rim above and right.
    HWY_INLINE TexelSquares(
        const GroundImage::Level& level,
        hn::Vec<hn::RebindToSigned<Texels>> x,
        hn::Vec<hn::RebindToSigned<Texels>> y) {
        const Texels texels;
        const hn::RebindToSigned<Texels> sign;
        const auto first = hn::Add(
            hn::Mul(hn::ShiftRight<16>(y), hn::Set(sign, level.width)), hn::ShiftRight<16>(x));
        const std::uint32_t* const from = level.texels.data();
        corner = {
            hn::GatherIndex(texels, from, first),
            hn::GatherIndex(texels, from + 1, first),
            hn::GatherIndex(texels, from + level.width, first),
            hn::GatherIndex(texels, from + level.width + 1, first)};
        const auto part = [&](auto place) HWY_ATTR {
            return hn::And(hn::BitCast(texels, place), hn::Set(texels, 0xffffU));
        };
        right = in_both_halves(part(x));
        up = in_both_halves(hn::ShiftRight<9>(part(y)));
    }

    /// Two of their colours, mixed.
    template <int shift>
    HWY_INLINE hn::Vec<Texels> mixed() const {
        const TexelHalves halves;
        const auto column = [&](std::size_t side) HWY_ATTR {
            return hn::Add(
                hn::Mul(two_bytes<shift>(corner[side]), hn::Sub(hn::Set(halves, 128), up)),
                hn::Mul(two_bytes<shift>(corner[side + 2]), up));
        };
        // The left texel has what the right one leaves of 65,535.
        return hn::BitCast(
            Texels(),
            hn::Add(hn::MulHigh(column(0), hn::Not(right)), hn::MulHigh(column(1), right)));
    }
};

/// The texture's colours along a block, from one of its levels.
HWY_INLINE void sample_texture(
    const GroundImage& image,
    std::size_t number,
    const std::array<TexturePoint, 2>& ends,
    double share,
    BlockColours& to) {
    const GroundImage::Level& level = image.levels()[number];
    const double scale = 65536.0 / static_cast<double>(std::uint64_t{1} << number);
    const auto places = [&](const TexturePoint& end) HWY_ATTR {
        return four([&](std::size_t i) HWY_ATTR {
            const auto place =
                hn::Sub(hn::Mul(hn::Add(end.value[i], real(0.5)), real(scale)), real(32768.0));
            const auto limit = hn::Load(Reals(), &level.last_place[i * hn::MaxLanes(Reals())]);
            return hn::Min(hn::Max(place, real(0.0)), limit);
        });
    };
    const BlockWalk walk(places(ends[0]), places(ends[1]), share);
    const hn::RebindToSigned<Texels> sign;
    const hn::Rebind<std::uint16_t, Texels> halves;
    for (std::size_t i = 0; i < block_px; i += hn::MaxLanes(Texels())) {
        const auto steps = hn::Iota(sign, static_cast<std::int32_t>(i));
        const auto place = [&](std::size_t k, int size) HWY_ATTR {
            const auto at = hn::Add(
                hn::Set(sign, walk.first[k]), hn::Mul(steps, hn::Set(sign, walk.per_px[k])));
            return hn::Min(hn::Max(at, hn::Zero(sign)), hn::Set(sign, (size - 1) * 65536 - 1));
        };
        const TexelSquares around(level, place(0, level.width), place(1, level.height));
        const auto store = [&](std::size_t k, hn::Vec<Texels> values) HWY_ATTR {
            hn::StoreU(hn::DemoteTo(halves, hn::BitCast(sign, values)), halves, &to.level[k][i]);
        };
        const auto red_blue = around.mixed<0>();
        const auto green = around.mixed<8>();
        const auto lower_half = hn::Set(Texels(), 0xffffU);
        store(0, hn::And(red_blue, lower_half));
        store(1, hn::And(green, lower_half));
        store(2, hn::ShiftRight<16>(red_blue));
    }
}

/// Colours a block.
HWY_INLINE void add_texture(
    const TexturePlanes& planes,
    const TileJob& job,
    const TextureBlock& block,
    TileBuffer& buffer) {
    static constexpr auto one_over = [] {
        std::array<double, block_px + 1> shares{};
        for (int px = 1; px <= block_px; ++px) {
            shares[static_cast<std::size_t>(px)] = 1.0 / px;
        }
        return shares;
    }();
    const double by_px = one_over[static_cast<std::size_t>(block.px())];
    const std::array ends{
        planes.at(block.at.x, block.at.y), planes.at(block.at.x + block.px(), block.at.y)};
    const TextureLevels chosen =
        levels_of(footprint2(planes, ends, by_px), job.ground->levels().size());
    BlockColours own;
    BlockColours coarse;
    sample_texture(*job.ground, chosen.fine, ends, by_px, own);
    if (chosen.coarse_share > 0) {
        sample_texture(*job.ground, chosen.fine + 1, ends, by_px, coarse);
    }
    const Pixels values;
    const auto shares = [&](const TexturePoint& end) HWY_ATTR {
        return four([&](std::size_t i) HWY_ATTR {
            const auto within = hn::Min(hn::Max(end.value[i], real(0.0)), real(1.0));
            return hn::Mul(within, real(65535.0));
        });
    };
    const BlockWalk share(shares(ends[0]), shares(ends[1]), by_px);
    const auto along = [&](std::size_t which, std::size_t i) HWY_ATTR {
        const auto steps = hn::Iota(values, static_cast<std::uint16_t>(i));
        return hn::Add(
            hn::Set(values, static_cast<std::uint16_t>(share.first[which])),
            hn::Mul(steps, hn::Set(values, static_cast<std::uint16_t>(share.per_px[which]))));
    };
    const auto coarse_share = hn::Set(values, chosen.coarse_share);
    const auto part_of =
        [&](hn::Vec<Pixels> from, hn::Vec<Pixels> to, hn::Vec<Pixels> how_much) HWY_ATTR {
            return hn::Add(hn::Sub(from, hn::MulHigh(from, how_much)), hn::MulHigh(to, how_much));
        };
    for (std::size_t i = 0; i < block_px; i += hn::Lanes(values)) {
        const auto light_left = along(2, i);
        const auto haze_share = along(3, i);
        const auto count = hn::LoadU(values, block.counts + i);
        for (std::size_t k = 0; k < 3; ++k) {
            auto mine = hn::LoadU(values, &own.level[k][i]);
            if (chosen.coarse_share > 0) {
                mine = part_of(mine, hn::LoadU(values, &coarse.level[k][i]), coarse_share);
            }
            const auto haze_level = hn::Set(
                values,
                static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F));
            const auto seen = part_of(hn::MulHigh(mine, light_left), haze_level, haze_share);
            const auto colour = hn::ShiftRight<3>(hn::Add(seen, hn::Set(values, 4)));
            std::uint16_t* const sums = buffer.sums[k].data() + block.pixel + i;
            hn::StoreU(hn::Add(hn::LoadU(values, sums), hn::Mul(colour, count)), values, sums);
        }
    }
}

/// Colours what is new in a row of a strip.
HWY_INLINE void add_textured_row(
    const TexturePlanes& planes,
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
                counts.data() + first,
                pixel + static_cast<std::size_t>(first)};
            add_texture(planes, job, block, buffer);
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
    const TexturePlanes planes(*one.extra);
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
            add_textured_row(planes, job, at, masks, fresh, pixel, buffer);
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
