// Hashes of lattice points, several at once: SplitMix64's finalizer (Steele, Lea and Flood 2014). Included once for
// each instruction set.
#if defined(OCTANT_MADE_LATTICE_HASH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_MADE_LATTICE_HASH_INL
#undef OCTANT_MADE_LATTICE_HASH_INL
#else
#define OCTANT_MADE_LATTICE_HASH_INL
#endif

#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::models::procedural {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Reals = hn::CappedTag<double, 8>;
using Words = hn::RebindToUnsigned<Reals>;
using Real = hn::Vec<Reals>;
using Word = hn::Vec<Words>;
constexpr std::size_t lane_count = hn::MaxLanes(Reals());

HWY_INLINE Real real(double value) { return hn::Set(Reals(), value); }

HWY_INLINE Word word(std::uint64_t value) { return hn::Set(Words(), value); }

/// Products of 64 bits, wrapping.
HWY_INLINE Word times(Word value, std::uint64_t factor) {
    using Halves = hn::Repartition<std::uint32_t, Words>;
    const auto halves = [](Word whole) HWY_ATTR { return hn::BitCast(Halves(), whole); };
    const auto low = halves(value);
    const auto high = halves(hn::ShiftRight<32>(value));
    const auto factor_low = halves(word(factor & 0xffffffffU));
    const auto factor_high = halves(word(factor >> 32U));
    const Word across = hn::Add(hn::MulEven(low, factor_high), hn::MulEven(high, factor_low));
    return hn::Add(hn::MulEven(low, factor_low), hn::ShiftLeft<32>(across));
}

/// Whole numbers below 2^52.
HWY_INLINE Real real_of_word(Word value) {
    constexpr double offset = 0x1p52;
    return hn::Sub(hn::BitCast(Reals(), hn::Or(value, hn::BitCast(Words(), real(offset)))), real(offset));
}

/// Whole numbers between -2^51 and 2^51, as signed ones of 64 bits.
HWY_INLINE Word word_of_real(Real value) {
    const Real offset = real(0x1.8p52);
    return hn::Sub(hn::BitCast(Words(), hn::Add(value, offset)), hn::BitCast(Words(), offset));
}

/// A lattice point's share of its hash: by its column and by its row.
HWY_INLINE Word column_part(Word column) { return times(column, 0xd6e8feb86659fd93ULL); }

HWY_INLINE Word row_part(Word row) {
    const Word b = times(row, 0xa0761d6478bd642fULL);
    return hn::Add(b, hn::ShiftRight<29>(b));
}

HWY_INLINE Word hashed(std::uint64_t seed, Word column_part, Word row_part) {
    Word value = hn::Xor(hn::Xor(word(seed * 0x9fb21c651e98df25ULL), column_part), row_part);
    value = hn::Add(value, word(0x9e3779b97f4a7c15ULL));
    value = times(hn::Xor(value, hn::ShiftRight<30>(value)), 0xbf58476d1ce4e5b9ULL);
    value = times(hn::Xor(value, hn::ShiftRight<27>(value)), 0x94d049bb133111ebULL);
    return hn::Xor(value, hn::ShiftRight<31>(value));
}

} // namespace HWY_NAMESPACE
} // namespace octant::models::procedural

HWY_AFTER_NAMESPACE();

#endif
