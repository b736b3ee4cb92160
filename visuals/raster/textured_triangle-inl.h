// Textured triangles. In this order: planes for a span in which they are as good as perspective; triangles in
// perspective; windows of eight pixels that wait for texels; triangles that perspective bends by less than a
// thirty-second of a texel (most of them). Included once for each instruction set.
#if defined(OCTANT_RASTER_TEXTURED_TRIANGLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXTURED_TRIANGLE_INL
#undef OCTANT_RASTER_TEXTURED_TRIANGLE_INL
#else
#define OCTANT_RASTER_TEXTURED_TRIANGLE_INL
#endif

#include "visuals/raster/coverage-inl.h"
#include "visuals/raster/gouraud-inl.h"
#include "visuals/raster/strip-inl.h"
#include "visuals/raster/texture_sampling-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// -- Texture coordinates as planes over a part of the tile, where the error against perspective is small.

/// A textured triangle's values in a part of a tile, as planes that are right in the part's middle. A value there is v0
/// + (s dx + t dy) / (1 + e), where e is how much 1 / w differs from the middle's, as a share of it: without e it is
/// wrong by no more than |s dx + t dy| |e| / (1 - |e|).
class AffineSpan {
public:
    static constexpr double max_texels_wrong = 1.0 / 16.0; ///< of the level that is looked at
    static constexpr double max_share_wrong = 1.0 / 512.0; ///< of light and haze

    HWY_INLINE AffineSpan(
        const TexturePlanes& planes, const LitGroundTexture& image, const glm::ivec2& tile_px, const TileBox& part)
        : first_px_(tile_px + glm::ivec2(part.left, part.first_row)) {
        const glm::dvec2 half_px(0.5 * (part.right - part.left), 0.5 * (part.last_row - part.first_row));
        const TexturePoint middle = planes.at(first_px_.x + half_px.x, first_px_.y + half_px.y);
        const auto slope = [&](const Four& per_px, double over_w) HWY_ATTR {
            return stored(four([&](std::size_t i) HWY_ATTR {
                const auto turned = hn::Mul(middle.value[i], real(over_w));
                return hn::Mul(hn::Sub(per_px[i], turned), real(middle.w));
            }));
        };
        const Values value = stored(middle.value);
        const Values per_x = slope(planes.per_x, planes.over_w.per_x);
        const Values per_y = slope(planes.per_y, planes.over_w.per_y);
        chosen = select_mip_levels(TexelDerivatives{{per_x[0], per_x[1]}, {per_y[0], per_y[1]}}, image.levels().size());
        // Pixels that begin beyond the part keep numbers in their range.
        const glm::dvec2 reach_px = half_px + 1.0;
        const double bent =
            (std::abs(planes.over_w.per_x) * reach_px.x + std::abs(planes.over_w.per_y) * reach_px.y) * middle.w;
        is_accurate = bent < 0.5;
        const double texel = 65536.0 / texel_scale(chosen.fine);
        Values first;
        for (std::size_t i = 0; i < value.size(); ++i) {
            const double reach = std::abs(per_x[i]) * reach_px.x + std::abs(per_y[i]) * reach_px.y;
            const double limit = i < 2 ? max_texels_wrong * texel : max_share_wrong;
            const double range = i < 2 ? max_texels * texel : max_share;
            is_accurate = is_accurate && reach * bent <= limit * (1.0 - bent) && std::abs(value[i]) + reach < range;
            first[i] = value[i] - per_x[i] * half_px.x - per_y[i] * half_px.y;
        }
        if (is_accurate) { set_planes(first, per_x, per_y); }
    }

    /// Of the chosen level or the next coarser one, from a pixel of the picture on.
    HWY_INLINE TexelSpan line(std::size_t coarser, const glm::ivec2& at) const {
        const glm::ivec2 off = at - first_px_;
        const auto& [x, y] = places_[coarser];
        return {{x.at(off), y.at(off)}, {x.per_x, y.per_x}};
    }

    /// Light left or haze, 2^-16, of a block from a pixel of the picture on.
    HWY_INLINE void share(std::size_t which, const glm::ivec2& at, std::array<std::uint16_t, block_px>& to) const {
        using Signed = hn::RebindToSigned<Pixels>;
        constexpr int coarser = 12; ///< from share_unit to 2^-14
        const Plane& plane = shares_[which];
        const auto first = hn::Set(Signed(), static_cast<std::int16_t>(plane.at(at - first_px_) >> coarser));
        const auto per_px = hn::Set(Signed(), static_cast<std::int16_t>(plane.per_x >> coarser));
        for (std::size_t i = 0; i < block_px; i += hn::Lanes(Pixels())) {
            const auto steps = lane_indices_from(Signed(), i);
            const auto value = hn::Add(first, hn::Mul(steps, per_px));
            const auto within = hn::Min(hn::Max(value, hn::Zero(Signed())), hn::Set(Signed(), 16383));
            hn::StoreU(hn::ShiftLeft<2>(hn::BitCast(Pixels(), within)), Pixels(), &to[i]);
        }
    }

    bool is_accurate; ///< as said above; if not, nothing else is to be used
    MipSelection chosen;

private:
    using Values = std::array<double, 4>;
    static constexpr double share_unit = 0x1p26;
    static constexpr double max_texels = 16384.0; ///< what 32 bits hold, 2^-16, and half of it
    static constexpr double max_share = 1.9;      ///< what 16 bits hold, 2^-14

    /// Whole numbers that wrap.
    struct Plane {
        std::int32_t base;
        std::int32_t per_x;
        std::int32_t per_y;

        Plane() = default;

        HWY_INLINE Plane(double at_first, double step_x, double step_y)
            : base(static_cast<std::int32_t>(at_first)), per_x(static_cast<std::int32_t>(step_x)),
              per_y(static_cast<std::int32_t>(step_y)) {}

        HWY_INLINE std::int32_t at(const glm::ivec2& off) const {
            return static_cast<std::int32_t>(static_cast<std::uint32_t>(base) +
                                             static_cast<std::uint32_t>(per_x) * static_cast<std::uint32_t>(off.x) +
                                             static_cast<std::uint32_t>(per_y) * static_cast<std::uint32_t>(off.y));
        }
    };

    static HWY_INLINE Values stored(const Four& values) {
        alignas(32) Values result;
        for (std::size_t i = 0; i < four_parts; ++i) {
            hn::Store(values[i], Reals(), &result[i * hn::MaxLanes(Reals())]);
        }
        return result;
    }

    HWY_INLINE void set_planes(const Values& first, const Values& per_x, const Values& per_y) {
        for (std::size_t k = 0; k < 2; ++k) {
            const double scale = texel_scale(chosen.fine + k);
            for (std::size_t i = 0; i < 2; ++i) {
                places_[k][i] = Plane((first[i] + 0.5) * scale - 32768.0, per_x[i] * scale, per_y[i] * scale);
            }
            const std::size_t i = 2 + k;
            shares_[k] = Plane(first[i] * share_unit, per_x[i] * share_unit, per_y[i] * share_unit);
        }
    }

    glm::ivec2 first_px_;
    std::array<std::array<Plane, 2>, 2> places_; ///< of the chosen level and the next coarser one
    std::array<Plane, 2> shares_;                ///< light left and haze, share_unit
};

/// A textured triangle's planes in its part of a tile: for all of it where they are near enough, else for a few rows at
/// a time.
class AffineRows {
public:
    HWY_INLINE AffineRows(
        const TexturePlanes& planes, const LitGroundTexture& image, const glm::ivec2& tile_px, const TileBox& box)
        : planes_(planes), image_(image), tile_px_(tile_px), box_(box), current_box_(box),
          texture_(planes, image, tile_px, box) {
        if (!texture_.is_accurate) {
            current_box_.last_row = current_box_.first_row - 1; // none
        }
    }

    /// Of a row of the tile, which lies in the triangle's part.
    HWY_INLINE const AffineSpan& of(int row) {
        if (row < current_box_.first_row || row > current_box_.last_row) {
            constexpr int few = 4;
            current_box_.first_row = row;
            current_box_.last_row = std::min(row + few - 1, box_.last_row);
            texture_ = AffineSpan(planes_, image_, tile_px_, current_box_);
        }
        return texture_;
    }

private:
    const TexturePlanes& planes_;
    const LitGroundTexture& image_;
    glm::ivec2 tile_px_;
    TileBox box_;
    TileBox current_box_;
    AffineSpan texture_;
};

// -- Triangles in perspective. Texture coordinates, light and haze are planes where AffineSpan allows it. Elsewhere
// they are exact at both ends of sixteen pixels and linear between them.

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

/// Light and haze of a block's pixels.
struct BlockShares {
    alignas(32) std::array<std::uint16_t, block_px> light_left; ///< 2^-16
    alignas(32) std::array<std::uint16_t, block_px> haze;
};

/// A block's colours by the texture's levels: the second one's share is none if it is not there.
struct BlockTexels {
    BlockColours fine;
    BlockColours coarse;
    std::uint16_t coarse_share; ///< 2^-16
};

/// Adds a block's colours to the sums.
HWY_INLINE void add_colours(const BlockTexels& texels, const BlockShares& shares, const TileJob& job,
    const TextureBlock& block, TileBuffer& buffer) {
    const Pixels values;
    const auto coarse_share = hn::Set(values, texels.coarse_share);
    const auto part_of = [&](hn::Vec<Pixels> from, hn::Vec<Pixels> to, hn::Vec<Pixels> weight) HWY_ATTR {
        return hn::Add(hn::Sub(from, hn::MulHigh(from, weight)), hn::MulHigh(to, weight));
    };
    for (std::size_t i = 0; i < block_px; i += hn::Lanes(values)) {
        const auto light_left = hn::LoadU(values, &shares.light_left[i]);
        const auto haze_share = hn::LoadU(values, &shares.haze[i]);
        const auto seen_share = hn::MulHigh(light_left, hn::Not(haze_share));
        const auto count = hn::LoadU(values, block.counts + i);
        for (std::size_t k = 0; k < 3; ++k) {
            auto mine = hn::LoadU(values, &texels.fine.level[k][i]);
            if (texels.coarse_share > 0) {
                mine = part_of(mine, hn::LoadU(values, &texels.coarse.level[k][i]), coarse_share);
            }
            const auto haze_level =
                hn::Set(values, static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F));
            const auto seen = hn::Add(hn::MulHigh(mine, seen_share), hn::MulHigh(haze_level, haze_share));
            const auto colour = hn::ShiftRight<3>(hn::Add(seen, hn::Set(values, 4)));
            std::uint16_t* const sums = buffer.sums[k].data() + block.pixel + i;
            hn::StoreU(hn::Add(hn::LoadU(values, sums), hn::Mul(colour, count)), values, sums);
        }
    }
}

/// Light and haze, even between both ends of a block.
HWY_INLINE BlockShares shares_between(const std::array<TexturePoint, 2>& ends, double share_of_px) {
    const auto sixteen_bits = [&](const TexturePoint& end) HWY_ATTR {
        return four([&](std::size_t i) HWY_ATTR {
            const auto within = hn::Min(hn::Max(end.value[i], real(0.0)), real(1.0));
            return hn::Mul(within, real(65535.0));
        });
    };
    const BlockStepper walk(sixteen_bits(ends[0]), sixteen_bits(ends[1]), share_of_px);
    const Pixels values;
    BlockShares shares;
    const auto along = [&](std::size_t which, std::array<std::uint16_t, block_px>& to) HWY_ATTR {
        for (std::size_t i = 0; i < block_px; i += hn::Lanes(values)) {
            const auto steps = lane_indices_from(values, i);
            const auto at = hn::Add(hn::Set(values, static_cast<std::uint16_t>(walk.first[which])),
                hn::Mul(steps, hn::Set(values, static_cast<std::uint16_t>(walk.per_px[which]))));
            hn::StoreU(at, values, &to[i]);
        }
    };
    along(2, shares.light_left);
    along(3, shares.haze);
    return shares;
}

/// Colours a block, right in perspective at both of its ends.
HWY_INLINE void add_texture(
    const TexturePlanes& planes, const TileJob& job, const TextureBlock& block, TileBuffer& buffer) {
    static constexpr auto one_over = [] {
        std::array<double, block_px + 1> shares{};
        for (int px = 1; px <= block_px; ++px) { shares[static_cast<std::size_t>(px)] = 1.0 / px; }
        return shares;
    }();
    const double by_px = one_over[static_cast<std::size_t>(block.px())];
    const std::array ends{planes.at(block.at.x, block.at.y), planes.at(block.at.x + block.px(), block.at.y)};
    const MipSelection chosen = select_mip_levels(texel_derivatives(planes, ends, by_px), job.ground->levels().size());
    BlockTexels texels;
    texels.coarse_share = chosen.coarse_share;
    sample_texture(*job.ground, chosen.fine, chosen, ends, by_px, texels.fine);
    if (chosen.coarse_share > 0) { sample_texture(*job.ground, chosen.fine + 1, chosen, ends, by_px, texels.coarse); }
    add_colours(texels, shares_between(ends, by_px), job, block, buffer);
}

/// Colours a block of a triangle whose places are planes.
HWY_INLINE void add_affine_texture(
    const AffineSpan& affine, const TileJob& job, const TextureBlock& block, TileBuffer& buffer) {
    BlockTexels texels;
    texels.coarse_share = affine.chosen.coarse_share;
    const std::vector<LitGroundTexture::MipLevel>& levels = job.ground->levels();
    const std::size_t fine = affine.chosen.fine;
    sample_line(levels[fine], affine.line(0, block.at), Probes(affine.chosen, fine), texels.fine);
    if (affine.chosen.coarse_share > 0) {
        sample_line(levels[fine + 1], affine.line(1, block.at), Probes(affine.chosen, fine + 1), texels.coarse);
    }
    BlockShares shares;
    affine.share(0, block.at, shares.light_left);
    affine.share(1, block.at, shares.haze);
    add_colours(texels, shares, job, block, buffer);
}

/// Colours what is new in a row of a strip, each block by add_block().
template <class AddBlock>
HWY_INLINE void add_textured_row(const AddBlock& add_block, const glm::ivec2& at, const StripValues& masks,
    const StripValues& fresh, std::size_t pixel) {
    const std::uint32_t fresh_bits = set_bits(fresh);
    if (fresh_bits == 0) { return; }
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
                at + glm::ivec2(first, 0), at.x + last, counts.data() + first, pixel + static_cast<std::size_t>(first)};
            add_block(block);
        }
    }
}

/// Paints a triangle of Fill::TextureInPerspective that no plane cuts.
HWY_NOINLINE void paint_texture(
    const TileTriangle& one, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const TileBox box(*one.triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) { return; }
    const TexturePlanes planes(*one.extra);
    AffineRows affine_rows(planes, *job.ground, job.first_px, box);
    const auto add = [&](const TextureBlock& block) HWY_ATTR {
        const AffineSpan& affine = affine_rows.of(block.at.y - job.first_px.y);
        if (affine.is_accurate) {
            add_affine_texture(affine, job, block, buffer);
        } else {
            add_texture(planes, job, block, buffer);
        }
    };
    for (int left = box.left; left <= box.right; left += strip_px) {
        const auto paint = [&](int row, const StripValues& masks, const StripValues& fresh) HWY_ATTR {
            const glm::ivec2 at = job.first_px + glm::ivec2(left, row);
            const auto pixel = static_cast<std::size_t>(row * tile_width + left);
            add_textured_row(add, at, masks, fresh, pixel);
        };
        walk_strip<strip_parts>(*one.triangle, job, lanes, box, left, buffer, paint, []() HWY_ATTR {});
    }
}

// -- Windows of eight pixels that wait for their colours: a register is filled with windows of any rows.

constexpr std::size_t texture_window_px = 8;
constexpr std::size_t windows_at_once = part_px / texture_window_px;
using TextureWindow = hn::CappedTag<std::uint16_t, texture_window_px>;

/// The next windows of a queue, as many as a register holds.
struct TextureWindows {
    const std::uint16_t* begin; ///< each one's first pixel, from the strip's first one

    HWY_INLINE hn::Vec<Strip> load(const std::uint16_t* from) const { return load(Strip(), from, begin); }

    /// In painting order: what lies beyond the end of a row is as it was.
    HWY_INLINE void store(hn::Vec<Strip> values, std::uint16_t* to) const { store(Strip(), values, to, begin); }

private:
    template <class Tag>
    static HWY_INLINE hn::Vec<Tag> load(Tag tag, const std::uint16_t* from, const std::uint16_t* windows) {
        if constexpr (hn::MaxLanes(tag) == texture_window_px) {
            return hn::LoadU(tag, from + *windows);
        } else {
            const hn::Half<Tag> half;
            return hn::Combine(tag, load(half, from, windows + windows_of(half)), load(half, from, windows));
        }
    }

    template <class Tag>
    static HWY_INLINE void store(Tag tag, hn::Vec<Tag> values, std::uint16_t* to, const std::uint16_t* windows) {
        if constexpr (hn::MaxLanes(tag) == texture_window_px) {
            hn::StoreU(values, tag, to + *windows);
        } else {
            const hn::Half<Tag> half;
            store(half, hn::LowerHalf(half, values), to, windows);
            store(half, hn::UpperHalf(half, values), to, windows + windows_of(half));
        }
    }

    template <class Tag>
    static constexpr std::size_t windows_of(Tag tag) {
        return hn::MaxLanes(tag) / texture_window_px;
    }
};

/// The windows of a strip of a triangle that have new samples.
class TextureQueue {
public:
    /// A row's new samples in parts of the strip; a window may reach beyond them. `row`: from the triangle's first.
    template <std::size_t parts>
    HWY_INLINE void add_row(std::size_t row, const std::array<hn::Vec<Strip>, parts>& fresh) {
        const std::size_t row_begin = row * tile_width;
        for (std::size_t i = 0; i < parts; ++i) {
            hn::StoreU(fresh[i], Strip(), fresh_.data() + row_begin + i * part_px);
        }
        put_none(row_begin + parts * part_px);
        std::uint32_t pixels = ~bits_equal_to(fresh, 0) & bits_of_parts<parts>;
        for (std::size_t i = 0; i < parts * part_px / texture_window_px; ++i) {
            const auto column = static_cast<std::uint32_t>(std::countr_zero(pixels)) % strip_px;
            windows_[count_] = static_cast<std::uint16_t>(row_begin + column);
            count_ += pixels != 0 ? 1 : 0;
            pixels &= ~(0xffU << column);
        }
    }

    /// Fills the last register with windows of a row in which nothing is new. `rows`: how many the triangle has.
    HWY_INLINE void finish(std::size_t rows) {
        const std::size_t row_begin = rows * tile_width;
        put_none(row_begin);
        for (std::size_t i = 0; i + 1 < windows_at_once; ++i) {
            windows_[count_ + i] = static_cast<std::uint16_t>(row_begin);
        }
    }

    std::size_t count() const { return count_; }

    TextureWindows windows(std::size_t first) const { return {windows_.data() + first}; }

    HWY_INLINE hn::Vec<Strip> fresh(const TextureWindows& windows) const { return windows.load(fresh_.data()); }

private:
    static constexpr std::size_t max_of_row = strip_px / texture_window_px;

    HWY_INLINE void put_none(std::size_t at) {
        hn::StoreU(hn::Zero(TextureWindow()), TextureWindow(), fresh_.data() + at);
    }

    /// New samples of pixels; rows lie as a tile's do.
    alignas(64) std::array<std::uint16_t, (tile_height + 1) * tile_width> fresh_;
    /// As TextureWindows::begin; eight are read at once.
    std::array<std::uint16_t, tile_height * max_of_row + 8> windows_;
    std::size_t count_ = 0;
};

/// Four planes of a triangle over the windows of a strip, four lanes for a window: two of places in the texture, then
/// light and haze.
class WindowPlanes {
public:
    using Blocks = hn::Repartition<std::int32_t, Strip>;

    HWY_INLINE
    WindowPlanes(const ColourGradients& gradients, const TileJob& job, const TileBox& box, int left) {
        alignas(16) static constexpr std::array<std::int32_t, 4> share_lanes{0, 0, -1, -1};
        // To the middle level, and what rounds levels to 1/128.
        alignas(16) static constexpr std::array<std::int32_t, 4> more{128 * 65536, 128 * 65536, 256, 256};
        const Blocks blocks;
        const auto set = [&](int value) HWY_ATTR { return hn::Set(blocks, value); };
        is_share_ = hn::LoadDup128(blocks, share_lanes.data());
        // Columns of shares are counted from the box.
        right_ = hn::And(set(left - box.left), is_share_);
        const auto per_x = hn::LoadDup128(blocks, gradients.per_x.data());
        per_row_ = hn::LoadDup128(blocks, gradients.per_y.data());
        const auto base = hn::Add(hn::LoadDup128(blocks, gradients.base.data()), hn::LoadDup128(blocks, more.data()));
        const auto first_column = hn::Sub(set(job.first_px.x + left), right_);
        const auto first_row = set(job.first_px.y + box.first_row);
        at_ = hn::Add(hn::Add(base, hn::Mul(per_x, first_column)), hn::Mul(per_row_, first_row));
        const auto steps = hn::LoadDup128(StripSigned(), gradients.per_column.data());
        per_column_ =
            hn::IfVecThenElse(is_share_, hn::BitCast(blocks, hn::InterleaveLower(StripSigned(), steps, steps)), per_x);
    }

    /// At the windows' first pixels: 2^-16 texel, and in the lower halves of lanes 1/128 level from the level 128,
    /// wrapping.
    HWY_INLINE hn::Vec<Blocks> at(const TextureWindows& windows) const {
        constexpr std::uint8_t none = 0x80;
        alignas(64) static constexpr auto to_blocks = [] {
            std::array<std::uint8_t, 64> from{};
            for (std::size_t i = 0; i < from.size(); ++i) {
                from[i] = i % 4 < 2 ? static_cast<std::uint8_t>(i / 16 * 2 + i % 4) : none;
            }
            return from;
        }();
        const Blocks blocks;
        const hn::Repartition<std::uint8_t, Blocks> bytes;
        const auto eight = hn::BitCast(bytes, hn::LoadDup128(Strip(), windows.begin));
        const auto window = hn::BitCast(blocks, hn::TableLookupBytesOr0(eight, hn::Load(bytes, to_blocks.data())));
        static_assert(tile_width == 64);
        const auto row = hn::ShiftRight<6>(window);
        const auto column = hn::Add(hn::And(window, hn::Set(blocks, tile_width - 1)), right_);
        const auto of_row = hn::Add(at_, hn::Mul(row, per_row_));
        const auto of_column = hn::Mul(column, per_column_);
        return hn::Add(hn::IfVecThenElse(is_share_, hn::ShiftRight<9>(of_row), of_row), of_column);
    }

private:
    hn::Vec<Blocks> is_share_; ///< all bits of the lanes of light and haze
    hn::Vec<Blocks> right_;
    hn::Vec<Blocks> at_; ///< where columns are counted from, in the triangle's first row
    hn::Vec<Blocks> per_row_;
    hn::Vec<Blocks> per_column_;
};

/// A share of light or haze, 2^-16, from its level.
HWY_INLINE hn::Vec<Strip> share_of(hn::Vec<StripSigned> level) {
    return hn::ShiftLeft<1>(hn::Add(hn::BitCast(Strip(), level), hn::Set(Strip(), 128 * 128)));
}

/// Light or haze along windows, as StripGradient.
struct ShareSteps {
    hn::Vec<StripSigned> steps;
    hn::Vec<StripSigned> least;
    hn::Vec<StripSigned> most;

    HWY_INLINE ShareSteps(const ColourGradients& gradients, std::size_t k)
        : least(hn::Set(StripSigned(), gradients.least[k])), most(hn::Set(StripSigned(), gradients.most[k])) {
        const StripSigned sign;
        const auto px = hn::Set(sign, static_cast<std::int16_t>(texture_window_px - 1));
        steps = hn::Mul(hn::And(lane_indices_from(sign, 0), px), hn::Set(sign, gradients.per_column[k]));
    }

    HWY_INLINE hn::Vec<Strip> share(hn::Vec<StripSigned> first) const {
        return share_of(hn::Min(hn::Max(hn::Add(first, steps), least), most));
    }
};

// -- Affine triangles: texture coordinates, light and haze are planes over the whole triangle.

using Texels = hn::Repartition<std::uint32_t, Strip>;
using TexelCoords = hn::Vec<hn::RebindToSigned<Texels>>; ///< 2^-16 texel
using Colours = FilteredColours<Strip>;

/// Places of a register's pixels in the fine level: of those in even lanes, then in odd ones.
struct TextureCoords {
    std::array<TexelCoords, 2> x;
    std::array<TexelCoords, 2> y;
};

/// Two rows' places, from those of a register's first pixel in each: of its even lanes, then of its odd ones. `px`:
/// after how many a row begins.
struct TextureCoordSteps {
    TexelCoords of_even;
    TexelCoords to_odd;

    HWY_INLINE TextureCoordSteps(std::int32_t per_x, int px) {
        const hn::RebindToSigned<Texels> whole;
        const auto pairs = hn::And(lane_indices_from(whole, 0), hn::Set(whole, px / 2 - 1));
        to_odd = hn::Set(whole, per_x);
        of_even = hn::Mul(hn::ShiftLeft<1>(pairs), to_odd);
    }

    HWY_INLINE std::array<TexelCoords, 2> from(TexelCoords first) const {
        const auto even = hn::Add(first, of_even);
        return {even, hn::Add(even, to_odd)};
    }
};

/// `weight`: of the other one, 2^-16.
HWY_INLINE hn::Vec<Strip> interpolated(hn::Vec<Strip> from, hn::Vec<Strip> to, hn::Vec<Strip> weight) {
    return hn::Add(hn::Sub(from, hn::MulHigh(from, weight)), hn::MulHigh(to, weight));
}

HWY_INLINE Colours colours_at(const TexelGrid<Texels>& level, const TextureCoords& places) {
    return filter_bilinear<Strip>(level, places.x[0], places.y[0], places.x[1], places.y[1]);
}

/// Places in the next coarser level.
HWY_INLINE TextureCoords coarser(const TextureCoords& places) {
    const auto of = [](TexelCoords place) HWY_ATTR {
        const auto quarter = hn::Set(hn::RebindToSigned<Texels>(), 16384); // of a texel
        return hn::Sub(hn::ShiftRight<1>(place), quarter);
    };
    return {{of(places.x[0]), of(places.x[1])}, {of(places.y[0]), of(places.y[1])}};
}

/// What all of a triangle's pixels have in common.
struct TextureSampler {
    TexelGrid<Texels> fine;
    TexelGrid<Texels> coarse;
    bool has_coarse; ///< else the fine one is all
    hn::Vec<Strip> coarse_share;
    Probes probes;
    std::array<std::uint16_t, 3> haze;

    HWY_INLINE TextureSampler(const MipSelection& levels, const TileJob& job)
        : fine(job.ground->levels()[levels.fine]),
          coarse(job.ground->levels()[levels.fine + (levels.coarse_share > 0 ? 1U : 0U)]),
          has_coarse(levels.coarse_share > 0), coarse_share(hn::Set(Strip(), levels.coarse_share)),
          probes(levels, levels.fine) {
        for (std::size_t k = 0; k < haze.size(); ++k) {
            haze[k] = static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F);
        }
    }

    /// The texture's, 1/128 level.
    HWY_INLINE Colours at(const TextureCoords& places) const {
        Colours colours = colours_at(fine, places);
        if (has_coarse) {
            const Colours next = colours_at(coarse, coarser(places));
            for (std::size_t k = 0; k < 3; ++k) { colours[k] = interpolated(colours[k], next[k], coarse_share); }
        }
        return colours;
    }

    static HWY_INLINE TextureCoords moved(const TextureCoords& places, std::int32_t dx, std::int32_t dy) {
        const hn::RebindToSigned<Texels> whole;
        const auto x = hn::Set(whole, dx);
        const auto y = hn::Set(whole, dy);
        return {{hn::Add(places.x[0], x), hn::Add(places.x[1], x)}, {hn::Add(places.y[0], y), hn::Add(places.y[1], y)}};
    }

    /// Whether a pixel takes one place of one level, as most do.
    bool is_single() const { return probes.count == 1 && !has_coarse; }

    /// The mean of a pixel's places, 1/128 level.
    HWY_INLINE Colours around(const TextureCoords& places) const {
        return probes.mean<Strip>([&](std::int32_t dx, std::int32_t dy) HWY_ATTR { return at(moved(places, dx, dy)); });
    }

    /// The same, of a pixel that is_single() says takes one place where it is.
    template <bool is_single>
    HWY_INLINE Colours texture(const TextureCoords& places) const {
        if constexpr (is_single) {
            return colours_at(fine, places);
        } else {
            return around(places);
        }
    }

    /// Under light and behind haze, 1/16 level.
    HWY_INLINE Colours seen(const Colours& colours, hn::Vec<Strip> light_left, hn::Vec<Strip> haze_share) const {
        const auto seen_share = hn::MulHigh(light_left, hn::Not(haze_share));
        const auto of = [&](std::size_t k) HWY_ATTR {
            const auto own = hn::MulHigh(colours[k], seen_share);
            const auto of_haze = hn::MulHigh(hn::Set(Strip(), haze[k]), haze_share);
            const auto sum = hn::Add(own, of_haze);
            return hn::ShiftRight<3>(hn::Add(sum, hn::Set(Strip(), 4)));
        };
        return {of(0), of(1), of(2)};
    }
};

/// Covers what is free of a triangle in a strip; what is new waits for its colours.
template <std::size_t parts>
HWY_INLINE void cover_texture_strip(const Triangle& triangle, const TileJob& job, const SampleLanes& lanes,
    const TileBox& box, int left, TileBuffer& buffer, TextureQueue& queue) {
    using Values = PartValues<parts>;
    const auto wait = [&](int row, const Values& /*masks*/, const Values& fresh)
                          HWY_ATTR { queue.add_row(static_cast<std::size_t>(row - box.first_row), fresh); };
    walk_strip<parts>(triangle, job, lanes, box, left, buffer, wait, []() HWY_ATTR {});
    queue.finish(static_cast<std::size_t>(box.last_row - box.first_row + 1));
}

/// Colours what waits of a strip that begins at a column of the tile.
template <bool is_single>
HWY_INLINE void colour_windows(const Triangle& triangle, const TileJob& job, const TextureSampler& look,
    const TileBox& box, int left, const TextureQueue& queue, TileBuffer& buffer) {
    const ColourGradients& levels = triangle.gradients;
    const WindowPlanes planes(levels, job, box, left);
    const TextureCoordSteps x(levels.per_x[0], texture_window_px);
    const TextureCoordSteps y(levels.per_x[1], texture_window_px);
    const ShareSteps light(levels, 2);
    const ShareSteps haze(levels, 3);
    const auto strip_begin = static_cast<std::size_t>(box.first_row * tile_width + left);
    for (std::size_t i = 0; i < queue.count(); i += windows_at_once) {
        const TextureWindows windows = queue.windows(i);
        const auto first = planes.at(windows);
        const auto halves = hn::BitCast(StripSigned(), first);
        const TextureCoords places{x.from(hn::Broadcast<0>(first)), y.from(hn::Broadcast<1>(first))};
        const Colours colours = look.seen(look.template texture<is_single>(places),
            light.share(hn::Broadcast<4>(halves)), haze.share(hn::Broadcast<6>(halves)));
        const auto counts = hn::PopulationCount(queue.fresh(windows));
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t* const sums = buffer.sums[k].data() + strip_begin;
            windows.store(hn::Add(windows.load(sums), hn::Mul(colours[k], counts)), sums);
        }
    }
}

/// Colours what waits of a strip.
HWY_INLINE void colour_pending(const Triangle& triangle, const TileJob& job, const TileBox& box, int left,
    const TextureQueue& queue, TileBuffer& buffer) {
    if (queue.count() == 0) { return; }
    const TextureSampler look(triangle.texture, job);
    if (look.is_single()) {
        colour_windows<true>(triangle, job, look, box, left, queue, buffer);
    } else {
        colour_windows<false>(triangle, job, look, box, left, queue, buffer);
    }
}

/// Paints a triangle of Fill::Texture.
HWY_NOINLINE void paint_affine_triangle(
    const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const TileBox box(triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) { return; }
    for (int left = box.left; left <= box.right; left += strip_px) {
        TextureQueue queue;
        with_parts_of_strip(box, left,
            [&](auto parts) HWY_ATTR { cover_texture_strip<parts>(triangle, job, lanes, box, left, buffer, queue); });
        colour_pending(triangle, job, box, left, queue, buffer);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
