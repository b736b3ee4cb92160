// By how much the fine pattern changes colours: what a pixel's ground is covered by, and what the
// pattern says at its place. Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_CONTRAST_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_CONTRAST_INL
#undef OCTANT_RASTER_GRAIN_CONTRAST_INL
#else
#define OCTANT_RASTER_GRAIN_CONTRAST_INL
#endif

#include "visuals/raster/grain_row-inl.h"
#include "visuals/scene/grain_pattern.h"

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// A byte of 2048 over 1 to 16, rounded up.
constexpr std::array<std::uint8_t, 16> bytes_of_shares(unsigned shift) {
    std::array<std::uint8_t, 16> bytes{};
    for (unsigned i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<std::uint8_t>((2048 + i) / (i + 1) >> shift);
    }
    return bytes;
}

alignas(16) inline constexpr std::array<std::uint8_t, 16> lower_bytes_of_shares =
    bytes_of_shares(0);
alignas(16) inline constexpr std::array<std::uint8_t, 16> upper_bytes_of_shares =
    bytes_of_shares(8);

/// The ground in pixels: how many of their samples show it, and the mean number of its covers.
struct GroundOfPixels {
    using Values = hn::RebindToUnsigned<TwosHalves>;

    hn::Vec<Values> samples;
    hn::Vec<Values> kind; ///< as scene::CoverContrast

    HWY_INLINE explicit GroundOfPixels(hn::Vec<Values> sums) {
        const Values values;
        const hn::Repartition<std::uint8_t, Values> bytes;
        samples = hn::And(sums, hn::Set(values, std::uint16_t{31}));
        const auto less = hn::SaturatedSub(samples, hn::Set(values, std::uint16_t{1}));
        const auto which = hn::BitCast(bytes, hn::Or(less, hn::ShiftLeft<8>(less)));
        const auto part = [&](const std::array<std::uint8_t, 16>& table) HWY_ATTR {
            const auto all = hn::LoadDup128(bytes, table.data());
            return hn::BitCast(values, hn::TableLookupBytes(all, which));
        };
        const auto upper = hn::Set(values, std::uint16_t{0xff00});
        const auto share = hn::Or(
            hn::And(part(upper_bytes_of_shares), upper),
            hn::AndNot(upper, part(lower_bytes_of_shares)));
        kind = hn::MulHigh(hn::AndNot(hn::Set(values, std::uint16_t{31}), sums), share);
    }
};

/// By how much each part of the colours of pairs of pixels changes, 2^-15 of itself.
struct ContrastOfTwos {
    std::array<hn::Vec<TwosHalves>, 3> part;

    /// `kinds`: of the pixels' covers.
    HWY_INLINE ContrastOfTwos(
        const GrainRow& grain,
        std::size_t two,
        hn::Vec<TwosBits> kinds,
        const std::uint32_t* table) {
        const TwosBits bits;
        const TwosWhole whole;
        const auto here = hn::ShiftRight<16>(grain.at(two));
        const auto seen_beside = grain.at(two + 1);
        const auto is_ground = hn::Ne(seen_beside, hn::Zero(whole));
        const auto next = hn::IfThenElse(is_ground, hn::ShiftRight<16>(seen_beside), here);
        const auto between = hn::ShiftRight<1>(hn::Add(here, next));
        static_assert(scene::CoverContrast::patterns == 64 && scene::CoverContrast::kinds == 128);
        const auto entry = [&](hn::Vec<TwosBits> kind, hn::Vec<TwosWhole> pattern) HWY_ATTR {
            const auto column = hn::ShiftRight<10>(hn::Add(pattern, hn::Set(whole, 32768)));
            const auto at = hn::Or(hn::ShiftLeft<6>(kind), hn::BitCast(bits, column));
            return hn::GatherIndex(bits, table, hn::BitCast(whole, at));
        };
        const auto first = entry(hn::And(kinds, twos_of(0x7f)), here);
        const auto second = entry(hn::ShiftRight<16>(kinds), between);
        const auto low = twos_of(0xffc0);
        const auto high = twos_of(0xffc00000U);
        const auto both = [&](hn::Vec<TwosBits> of_first, hn::Vec<TwosBits> of_second) HWY_ATTR {
            return hn::BitCast(
                TwosHalves(), hn::Or(hn::And(of_first, low), hn::And(of_second, high)));
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
