// Levels of a strip of 32 pixels, and the part of a tile that a triangle's strips lie in. Included once for each
// instruction set.
#if defined(OCTANT_RASTER_STRIP_LEVEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_STRIP_LEVEL_INL
#undef OCTANT_RASTER_STRIP_LEVEL_INL
#else
#define OCTANT_RASTER_STRIP_LEVEL_INL
#endif

#include "visuals/raster/tile_strip-inl.h"

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

using StripSigned = hn::RebindToSigned<Strip>;
constexpr std::size_t part_px = hn::MaxLanes(Strip());

/// A bit for each pixel of so many parts of a strip.
template <std::size_t parts>
constexpr std::uint32_t bits_of_parts = ~0U >> (strip_px - parts * part_px);

/// The part of a tile in which a triangle may cover something.
struct TileBox {
    int left;
    int right;
    int first_row;
    int last_row;

    HWY_INLINE TileBox(const Triangle& triangle, const TileJob& job)
        : left(std::max(triangle.left - job.first_px.x, 0)),
          right(std::min(triangle.right - job.first_px.x, job.size_px.x - 1)),
          first_row(std::max(triangle.first_row - job.first_px.y, 0)),
          last_row(std::min(triangle.last_row - job.first_px.y, job.size_px.y - 1)) {}

    /// A bit for each column from `left_column` on that belongs to it.
    std::uint32_t columns_of_strip(int left_column) const {
        const int width = right - left_column + 1;
        return width >= strip_px ? ~0U : (1U << width) - 1U;
    }

    std::uint32_t rows() const {
        return static_cast<std::uint32_t>((std::uint64_t{2} << last_row) - (std::uint64_t{1} << first_row));
    }
};

/// A plane's level at a column and row of the picture, 2^-16 level, with what rounds it to 1/128.
HWY_INLINE std::uint32_t first_level(const ColourGradients& gradients, std::size_t k, const glm::ivec2& at) {
    return static_cast<std::uint32_t>(gradients.base[k]) + 256U +
           static_cast<std::uint32_t>(gradients.per_x[k]) * static_cast<std::uint32_t>(at.x) +
           static_cast<std::uint32_t>(gradients.per_y[k]) * static_cast<std::uint32_t>(at.y);
}

/// From 1/128 level, counted from the level 128, to 1/16 level from 0.
HWY_INLINE hn::Vec<Strip> from_level(hn::Vec<StripSigned> level) {
    return hn::ShiftRight<3>(hn::Add(hn::BitCast(Strip(), level), hn::Set(Strip(), 128 * 128 + 4)));
}

/// A level over a strip, row by row: 1/128 level from the level 128, wrapping.
struct StripGradient {
    std::uint32_t at; ///< where columns are counted from, 2^-16 level
    std::uint32_t per_row;
    hn::Vec<StripSigned> least;
    hn::Vec<StripSigned> most;
    std::array<hn::Vec<StripSigned>, strip_parts> steps;

    /// The strip begins some columns right of a pixel from which columns are counted.
    HWY_INLINE
    StripGradient(const ColourGradients& gradients, std::size_t k, const glm::ivec2& from_px, int columns_right)
        : at(first_level(gradients, k, from_px)), per_row(static_cast<std::uint32_t>(gradients.per_y[k])),
          least(hn::Set(StripSigned(), gradients.least[k])), most(hn::Set(StripSigned(), gradients.most[k])) {
        const StripSigned sign;
        const auto per_column = hn::Set(sign, gradients.per_column[k]);
        for (std::size_t i = 0; i < strip_parts; ++i) {
            const std::size_t first = static_cast<std::size_t>(columns_right) + i * part_px;
            steps[i] = hn::Mul(lane_indices_from(sign, first), per_column);
        }
    }

    /// 1/128 level from the level 128.
    HWY_INLINE hn::Vec<StripSigned> level(std::size_t part) const {
        const auto first = static_cast<std::int16_t>(static_cast<std::int32_t>(at) >> 9);
        const auto raw = hn::Add(hn::Set(StripSigned(), first), steps[part]);
        return hn::Min(hn::Max(raw, least), most);
    }

    /// In 1/16 level from 0.
    HWY_INLINE hn::Vec<Strip> colour(std::size_t part) const { return from_level(level(part)); }
};

/// Red, green and blue of a triangle over a strip.
HWY_INLINE std::array<StripGradient, 3> strip_gradients(
    const ColourGradients& gradients, const glm::ivec2& from_px, int columns_right) {
    const auto level = [&](std::size_t k) HWY_ATTR { return StripGradient(gradients, k, from_px, columns_right); };
    return {level(0), level(1), level(2)};
}

/// A bit for each pixel of so many parts of a strip that has a value.
template <std::size_t parts>
HWY_INLINE std::uint32_t bits_equal_to(const std::array<hn::Vec<Strip>, parts>& values, std::uint16_t value) {
    const auto is_equal = [&](std::size_t part) HWY_ATTR { return hn::Eq(values[part], hn::Set(Strip(), value)); };
#if HWY_TARGET == HWY_AVX2
    // Written to memory part by part and read as one, they would come late.
    const __m256i bytes = _mm256_packs_epi16(
        hn::VecFromMask(Strip(), is_equal(0)).raw, hn::VecFromMask(Strip(), is_equal(parts - 1)).raw);
    constexpr int in_order = 0xd8; // of four times eight
    const auto bits = static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_permute4x64_epi64(bytes, in_order)));
    return bits & bits_of_parts<parts>;
#else
    alignas(8) std::array<std::uint8_t, 16> bytes;
    constexpr std::size_t bytes_a_part = part_px / 8;
    for (std::size_t i = 0; i < parts; ++i) {
        hn::StoreMaskBits(Strip(), is_equal(i), bytes.data() + i * bytes_a_part);
    }
    std::uint32_t bits = 0;
    std::memcpy(&bits, bytes.data(), parts * bytes_a_part);
    return bits;
#endif
}

/// A bit for each pixel of so many parts of a strip whose value has all bits set.
template <std::size_t parts>
HWY_INLINE std::uint32_t full_bits(const std::array<hn::Vec<Strip>, parts>& values) {
    return bits_equal_to(values, 0xffff);
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
