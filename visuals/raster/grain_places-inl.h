// Where pairs of pixels look in the fine pattern of ground, and at which level: by how near the
// ground is there, and how that changes to the pixels beside and below.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_PLACES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_PLACES_INL
#undef OCTANT_RASTER_GRAIN_PLACES_INL
#else
#define OCTANT_RASTER_GRAIN_PLACES_INL
#endif

#include "visuals/raster/grain_image.h"
#include "visuals/raster/tile_counting-inl.h"

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// A lane for two neighbouring pixels.
using Twos = hn::CappedTag<float, 16>;
using TwosWhole = hn::RebindToSigned<Twos>;
using TwosBits = hn::RebindToUnsigned<Twos>;
constexpr std::size_t twos_at_once = hn::MaxLanes(Twos());
constexpr std::size_t twos_a_row = tile_width / 2;

HWY_INLINE hn::Vec<Twos> twos(float value) {
    return hn::Set(Twos(), value);
}

HWY_INLINE hn::Vec<TwosBits> twos_of(unsigned value) {
    return hn::Set(TwosBits(), value);
}

/// A part of the lines of sight over a tile, from a row on.
struct GrainRay {
    float first; ///< between the row's first two pixels
    float per_x; ///< from pixel to pixel
    float per_y;

    HWY_INLINE GrainRay(const RealPlane& ray, const glm::ivec2& first_px)
        : first(static_cast<float>(ray.at(first_px.x + 0.5, first_px.y)))
        , per_x(static_cast<float>(ray.per_x))
        , per_y(static_cast<float>(ray.per_y)) {}

    /// Between pairs of pixels of the row, from one on.
    HWY_INLINE hn::Vec<Twos> in_row(std::size_t first_two) const {
        const auto numbers = hn::Add(twos(static_cast<float>(first_two)), counting_from(Twos(), 0));
        return hn::Add(twos(first), hn::Mul(hn::Add(numbers, numbers), twos(per_x)));
    }

    /// Between the pixels right of the tile, in rows from one on.
    HWY_INLINE hn::Vec<Twos> beside(std::size_t first_row) const {
        const auto rows = hn::Add(twos(static_cast<float>(first_row)), counting_from(Twos(), 0));
        const float right = first + static_cast<float>(tile_width) * per_x;
        return hn::Add(twos(right), hn::Mul(rows, twos(per_y)));
    }
};

/// How near the ground is at pairs of pixels, and how that changes to the pixels beside and below.
struct Nearness {
    hn::Vec<Twos> here; ///< 1/m
    hn::Vec<Twos> across;
    hn::Vec<Twos> down;
};

/// Of pairs of a row. Above the first row and below the last one is the row itself. None where what
/// lies beside is no ground: a pixel at the rim may be half sky.
HWY_INLINE Nearness nearness_of_row(const float* row, const float* above, const float* below) {
    const Twos real;
    using Pair = std::array<hn::Vec<Twos>, 2>;
    const auto load = [&](const float* from) HWY_ATTR {
        Pair pair;
        hn::LoadInterleaved2(real, from, pair[0], pair[1]);
        return pair;
    };
    const Pair own = load(row);
    const Pair upper = load(above);
    const Pair lower = load(below);
    const auto least = [](const Pair& pair) HWY_ATTR { return hn::Min(pair[0], pair[1]); };
    const auto is_ground =
        hn::Gt(hn::Min(least(own), hn::Min(least(upper), least(lower))), hn::Zero(real));
    const auto down = below == row ? hn::Sub(own[0], upper[0]) : hn::Sub(lower[0], own[0]);
    return {
        hn::IfThenElseZero(is_ground, hn::Max(own[0], own[1])),
        hn::IfThenElseZero(is_ground, hn::Sub(own[1], own[0])),
        hn::IfThenElseZero(is_ground, down)};
}

/// The lines of sight of a row of a tile, or of all its rows: east, north and up.
struct GrainWays {
    std::array<GrainRay, 3> part;

    HWY_INLINE GrainWays(const GrainRays& rays, const glm::ivec2& first_px)
        : part{
              GrainRay(rays.way[0], first_px),
              GrainRay(rays.way[1], first_px),
              GrainRay(rays.way[2], first_px)} {}
};

/// A part of the lines of sight at pairs of pixels.
using GrainWay = std::array<hn::Vec<Twos>, 3>;

/// A place in the pattern at one scale, 1/256 texel of its finest level.
struct GrainPlace {
    hn::Vec<TwosBits> x;
    hn::Vec<TwosBits> y;
};

/// What pairs of pixels see of the pattern: a scale at the level of their size, and the next
/// coarser scale at its finest level.
struct GrainPlaces {
    GrainPlace fine;
    GrainPlace coarse;
    hn::Vec<TwosBits> level;
    hn::Vec<TwosBits> next_level; ///< share of the next level, 1/256
    hn::Vec<TwosBits> through;    ///< how far the scale's levels are gone through, 1/256
};

/// Finds them.
class GrainLook {
public:
    HWY_INLINE GrainLook(
        const GrainRays& rays, const GrainWays& ways, const GrainWay& way, const Nearness& near) {
        const auto depth = hn::Div(twos(1.0F), hn::Max(near.here, twos(1e-9F)));
        auto across2 = hn::Zero(Twos());
        auto down2 = hn::Zero(Twos());
        for (std::size_t i = 0; i < 3; ++i) {
            at_[i] = hn::Mul(way[i], depth);
            const auto moves = [&](float per_px, hn::Vec<Twos> change) HWY_ATTR {
                return hn::Mul(hn::Sub(twos(per_px), hn::Mul(at_[i], change)), depth);
            };
            const auto across = moves(ways.part[i].per_x, near.across);
            const auto down = moves(ways.part[i].per_y, near.down);
            across2 = hn::Add(across2, hn::Mul(across, across));
            down2 = hn::Add(down2, hn::Mul(down, down));
        }
        // The pattern's finest features are two texels wide: half a level finer than usual will do.
        choose_levels(hn::Max(across2, hn::Mul(down2, twos(0.5F))));
        look_at(rays);
    }

    HWY_INLINE const GrainPlaces& places() const { return places_; }

    /// What the haze leaves, 2^-15. As scene::Haze, by polynomials: the pattern need not fade to
    /// the bit.
    HWY_INLINE hn::Vec<TwosBits> left(const GrainRays& rays) const {
        const auto squares = hn::Add(
            hn::Add(hn::Mul(at_[0], at_[0]), hn::Mul(at_[1], at_[1])), hn::Mul(at_[2], at_[2]));
        const auto fallen = hn::Mul(at_[2], twos(-rays.haze_falloff_per_m));
        const auto one = twos(1.0F);
        const auto series = [&](hn::Vec<Twos> x, float a, float b, float c, float d) HWY_ATTR {
            auto sum = hn::Add(twos(c), hn::Mul(x, twos(d)));
            sum = hn::Add(twos(b), hn::Mul(x, sum));
            sum = hn::Add(twos(a), hn::Mul(x, sum));
            return hn::Add(one, hn::Mul(x, sum));
        };
        const auto within = hn::Min(hn::Max(fallen, twos(-1.5F)), twos(6.0F));
        const auto density = series(within, 1.0F / 2.0F, 1.0F / 6.0F, 1.0F / 24.0F, 1.0F / 120.0F);
        const auto distance = hn::Mul(hn::Sqrt(squares), twos(rays.haze_per_m));
        const auto depth = hn::Mul(distance, density);
        const auto share =
            hn::Div(one, series(depth, 1.0F, 1.0F / 2.0F, 1.0F / 6.0F, 1.0F / 24.0F));
        return hn::BitCast(TwosBits(), hn::ConvertTo(TwosWhole(), hn::Mul(share, twos(32767.0F))));
    }

private:
    /// Not negative: whole tiles are added.
    static HWY_INLINE hn::Vec<TwosBits> fixed(hn::Vec<Twos> texels) {
        constexpr float most_texels = 4194304.0F;
        constexpr int tiles = 1 << 30;
        const auto within = hn::Min(hn::Max(texels, twos(-most_texels)), twos(most_texels));
        const auto parts = hn::ConvertTo(TwosWhole(), hn::Mul(within, twos(256.0F)));
        return hn::BitCast(TwosBits(), hn::Add(parts, hn::Set(TwosWhole(), tiles)));
    }

    /// By half the logarithm of the squared width of what is seen, straight between powers of two.
    /// Most pixels take one level: the next one comes in over a third of the way only. A scale
    /// gives way to the next one while its levels are gone through.
    HWY_INLINE void choose_levels(hn::Vec<Twos> width2_m) {
        using scene::GrainPattern;
        constexpr std::int32_t of_one = 127 << 23; // the bits of 1.0
        constexpr int levels = GrainPattern::levels_a_scale * (GrainPattern::scales - 1);
        constexpr std::int32_t most = (levels << 24) - 1;
        constexpr float texels2_per_m2 = GrainPattern::texels_per_m * GrainPattern::texels_per_m;
        const auto texels2 = hn::Mul(width2_m, twos(texels2_per_m2));
        const auto exponent =
            hn::Sub(hn::BitCast(TwosWhole(), texels2), hn::Set(TwosWhole(), of_one));
        const auto within =
            hn::Min(hn::Max(exponent, hn::Zero(TwosWhole())), hn::Set(TwosWhole(), most));
        const auto bits = hn::BitCast(TwosBits(), within);
        const auto part =
            hn::BitCast(TwosWhole(), hn::And(hn::ShiftRight<16>(bits), twos_of(0xff)));
        const auto from_band = hn::Sub(part, hn::Set(TwosWhole(), 85));
        const auto thrice = hn::Add(hn::Add(from_band, from_band), from_band);
        const auto share =
            hn::Min(hn::Max(thrice, hn::Zero(TwosWhole())), hn::Set(TwosWhole(), 256));
        // What has the next level whole has it alone.
        const auto next = hn::ShiftRight<8>(hn::BitCast(TwosBits(), share));
        static_assert(GrainPattern::levels_a_scale == 4);
        scale_ = hn::ShiftRight<26>(bits);
        places_.level = hn::Add(hn::And(hn::ShiftRight<24>(bits), twos_of(3)), next);
        places_.next_level = hn::And(hn::BitCast(TwosBits(), share), twos_of(0xff));
        places_.through = hn::And(hn::ShiftRight<18>(bits), twos_of(0xff));
    }

    HWY_INLINE void look_at(const GrainRays& rays) {
        using scene::GrainPattern;
        const auto lean_x = hn::Mul(at_[2], twos(GrainPattern::lean.x));
        const auto lean_y = hn::Mul(at_[2], twos(GrainPattern::lean.y));
        // As it lies at even scales, then at odd ones.
        const auto even_x = hn::Add(at_[0], lean_x);
        const auto even_y = hn::Add(at_[1], lean_y);
        const auto odd_x = hn::Sub(at_[1], lean_y);
        const auto odd_y = hn::Sub(lean_x, at_[0]);
        const auto is_odd = hn::RebindMask(Twos(), hn::Ne(hn::And(scale_, twos_of(1)), twos_of(0)));
        places_.fine = place_of(
            rays,
            scale_,
            hn::IfThenElse(is_odd, odd_x, even_x),
            hn::IfThenElse(is_odd, odd_y, even_y));
        places_.coarse = place_of(
            rays,
            hn::Add(scale_, twos_of(1)),
            hn::IfThenElse(is_odd, even_x, odd_x),
            hn::IfThenElse(is_odd, even_y, odd_y));
    }

    static HWY_INLINE GrainPlace
    place_of(const GrainRays& rays, hn::Vec<TwosBits> scale, hn::Vec<Twos> x_m, hn::Vec<Twos> y_m) {
        using scene::GrainPattern;
        const Twos real;
        static_assert(GrainPattern::scales == 4 && GrainPattern::texels_per_m == 8.0F);
        static_assert(GrainPattern::scale_step == 16);
        const auto exponent = hn::Sub(twos_of(127 + 3), hn::ShiftLeft<2>(scale));
        const auto texels_per_m = hn::BitCast(real, hn::ShiftLeft<23>(exponent));
        const auto at_eye = [&](const float* of_scales) HWY_ATTR {
            const auto which = hn::IndicesFromVec(real, hn::BitCast(TwosWhole(), scale));
            return hn::TableLookupLanes(hn::LoadDup128(real, of_scales), which);
        };
        return {
            fixed(hn::Add(hn::Mul(x_m, texels_per_m), at_eye(rays.at_eye.data()))),
            fixed(hn::Add(
                hn::Mul(y_m, texels_per_m), at_eye(rays.at_eye.data() + GrainPattern::scales)))};
    }

    GrainWay at_; ///< metres from the eye
    hn::Vec<TwosBits> scale_;
    GrainPlaces places_;
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
