// By how much the fine pattern changes colours: what a pixel's ground is covered by, and what the pattern says at its
// place. Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_CONTRAST_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_CONTRAST_INL
#undef OCTANT_RASTER_GRAIN_CONTRAST_INL
#else
#define OCTANT_RASTER_GRAIN_CONTRAST_INL
#endif

#include "visuals/raster/detail_row-inl.h"
#include "visuals/scene/detail_pattern.h"

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// By how much each part of the colours of pairs of pixels changes, 2^-15 of itself.
struct PairContrast {
    std::array<hn::Vec<PixelPairHalves>, 3> part;

    /// `seen`: as sample_detail(), of the pairs and of those after them. `ground`: PackedGround.
    HWY_INLINE PairContrast(hn::Vec<PixelPairBits> seen, hn::Vec<PixelPairBits> seen_beside,
        hn::Vec<PixelPairBits> ground, const std::uint32_t* table) {
        const PixelPairBits bits;
        const PixelPairInts whole;
        static_assert(
            scene::LandCoverContrast::pattern_step_count == 64 && scene::LandCoverContrast::mixture_count == 128);
        // From 0 to 2^16.
        const auto pattern_of = [&](hn::Vec<PixelPairBits> from)
                                    HWY_ATTR { return hn::Xor(hn::ShiftRight<16>(from), pair_bits(0x8000)); };
        const auto here = pattern_of(seen);
        const auto is_none = hn::Eq(seen_beside, hn::Zero(bits));
        const auto next = hn::IfThenElse(is_none, here, pattern_of(seen_beside));
        const auto kind = hn::ShiftLeft<6>(hn::And(ground, pair_bits(PackedGround::cover_bits)));
        const auto entry = [&](hn::Vec<PixelPairBits> pattern) HWY_ATTR {
            return hn::GatherIndex(bits, table, hn::BitCast(whole, hn::Or(kind, pattern)));
        };
        const auto first = entry(hn::ShiftRight<10>(here));
        const auto second = entry(hn::ShiftRight<11>(hn::Add(here, next)));
        const auto low = pair_bits(0xffc0);
        const auto high = pair_bits(0xffc00000U);
        const auto both = [&](hn::Vec<PixelPairBits> of_first, hn::Vec<PixelPairBits> of_second) HWY_ATTR {
            return hn::BitCast(PixelPairHalves(), hn::Or(hn::And(of_first, low), hn::And(of_second, high)));
        };
        part[0] = both(hn::ShiftRight<16>(first), second);
        part[1] = both(hn::ShiftRight<6>(first), hn::ShiftLeft<10>(second));
        part[2] = both(hn::ShiftLeft<4>(first), hn::ShiftLeft<20>(second));
    }
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
