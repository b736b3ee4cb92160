// Pixels of a textured triangle that wait for their colours, in windows of eight: a register is filled with windows of
// whichever rows. Included once for each instruction set.
#if defined(OCTANT_RASTER_TEXTURE_WINDOWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_TEXTURE_WINDOWS_INL
#undef OCTANT_RASTER_TEXTURE_WINDOWS_INL
#else
#define OCTANT_RASTER_TEXTURE_WINDOWS_INL
#endif

#include "visuals/raster/strip_gradient-inl.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

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

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
