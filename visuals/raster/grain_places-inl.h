// Where every second pixel looks in the fine pattern of ground, and at which level: by how near the
// ground is there, and how that changes to the pixels beside and below.
// Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_PLACES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_PLACES_INL
#undef OCTANT_RASTER_GRAIN_PLACES_INL
#else
#define OCTANT_RASTER_GRAIN_PLACES_INL
#endif

#include "visuals/raster/grain_image.h"
#include "visuals/raster/grain_nearness-inl.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// A part of the lines of sight over a tile, from a row on.
struct GrainRay {
    float first; ///< of the row's first pixel
    float per_x; ///< from pixel to pixel
    float per_y;

    HWY_INLINE GrainRay(const RealPlane& ray, const glm::ivec2& first_px)
        : first(static_cast<float>(ray.at(first_px.x, first_px.y)))
        , per_x(static_cast<float>(ray.per_x))
        , per_y(static_cast<float>(ray.per_y)) {}

    /// Of the first pixels of every second pair of the row, from one on.
    HWY_INLINE hn::Vec<Twos> in_row(std::size_t first_two) const {
        const auto columns = hn::Add(
            hn::Mul(counting_from(Twos(), 0), twos(4.0F)), twos(static_cast<float>(2 * first_two)));
        return hn::Add(twos(first), hn::Mul(columns, twos(per_x)));
    }

    /// Of the pixels right of the tile, in every second row from one on.
    HWY_INLINE hn::Vec<Twos> beside(std::size_t first_row) const {
        const auto numbers = counting_from(Twos(), 0);
        const auto rows = hn::Add(twos(static_cast<float>(first_row)), hn::Add(numbers, numbers));
        const float right = first + static_cast<float>(tile_width) * per_x;
        return hn::Add(twos(right), hn::Mul(rows, twos(per_y)));
    }
};

/// The lines of sight of a row of a tile, or of all its rows: east, north and up.
struct GrainWays {
    std::array<GrainRay, 3> part;

    HWY_INLINE GrainWays(const GrainRays& rays, const glm::ivec2& first_px)
        : part{
              GrainRay(rays.way[0], first_px),
              GrainRay(rays.way[1], first_px),
              GrainRay(rays.way[2], first_px)} {}

    /// How far away ground one unit deep is in the middle of a tile.
    HWY_INLINE float length() const {
        float squares = 0.0F;
        for (const GrainRay& ray : part) {
            const float middle =
                ray.first + 0.5F * (tile_width * ray.per_x + tile_height * ray.per_y);
            squares += middle * middle;
        }
        return std::sqrt(squares);
    }
};

/// A part of the lines of sight at the first pixels of pairs.
using GrainWay = std::array<hn::Vec<Twos>, 3>;

/// A place in the pattern at one scale, 1/256 texel of its finest level.
struct GrainPlace {
    hn::Vec<TwosBits> x;
    hn::Vec<TwosBits> y;
};

/// What the first pixels of pairs see of the pattern: a scale at the level of their size, and the
/// next coarser scale at its finest level.
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
        is_ground_ = hn::Gt(near.here, hn::Zero(Twos()));
        depth_ = hn::Div(twos(1.0F), hn::Max(near.here, twos(1e-9F)));
        GrainWay across;
        GrainWay down;
        for (std::size_t i = 0; i < 3; ++i) {
            at_[i] = hn::Mul(way[i], depth_);
            const auto moves = [&](float per_px, hn::Vec<Twos> change) HWY_ATTR {
                return hn::Sub(twos(per_px), hn::Mul(at_[i], change));
            };
            across[i] = moves(ways.part[i].per_x, near.across);
            down[i] = moves(ways.part[i].per_y, near.down);
        }
        // The pattern's finest features are two texels wide: half a level finer than usual will do.
        const auto widest = hn::Max(square(across), hn::Mul(square(down), twos(0.5F)));
        const auto depth2 = hn::Mul(depth_, depth_);
        choose_levels(hn::Mul(widest, depth2));
        // Four pixels span less than a texel of the level.
        constexpr float texel2 =
            1.0F / (scene::GrainPattern::texels_per_m * scene::GrainPattern::texels_per_m);
        const auto wide2 = hn::Max(hn::Mul(widest, depth2), twos(texel2));
        is_even_ = hn::Le(hn::Mul(hn::Mul(square(across), depth2), twos(16.0F)), wide2);
        choose_sides(across, down);
        look_at(rays);
    }

    HWY_INLINE const GrainPlaces& places() const { return places_; }

    HWY_INLINE hn::Mask<Twos> is_ground() const { return is_ground_; }

    /// Whether what they see changes so slowly along the row that it is even to the next pair but
    /// one.
    HWY_INLINE hn::Mask<Twos> is_even() const { return is_even_; }

    /// What the haze leaves, 2^-15, where ground one unit deep dims by so much. As scene::Haze, by
    /// polynomials: the pattern need not fade to the bit.
    HWY_INLINE hn::Vec<TwosBits> left(const GrainRays& rays, float haze_per_depth) const {
        const auto fallen = hn::Mul(at_[2], twos(-rays.haze_falloff_per_m));
        const auto within = hn::Min(hn::Max(fallen, twos(-1.5F)), twos(6.0F));
        auto density = hn::Add(twos(1.0F / 24.0F), hn::Mul(within, twos(1.0F / 120.0F)));
        for (const float factor : {1.0F / 6.0F, 1.0F / 2.0F, 1.0F}) {
            density = hn::Add(twos(factor), hn::Mul(within, density));
        }
        const auto haze = hn::Mul(hn::Mul(depth_, twos(haze_per_depth)), density);
        // (1 - x / 16)^16
        const auto sixteenth = hn::Mul(haze, twos(1.0F / 16.0F));
        auto share = hn::Max(hn::Sub(twos(1.0F), sixteenth), hn::Zero(Twos()));
        for (int i = 0; i < 4; ++i) {
            share = hn::Mul(share, share);
        }
        return hn::BitCast(TwosBits(), hn::ConvertTo(TwosWhole(), hn::Mul(share, twos(32767.0F))));
    }

private:
    static HWY_INLINE hn::Vec<Twos> square(const GrainWay& way) {
        return hn::Add(
            hn::Add(hn::Mul(way[0], way[0]), hn::Mul(way[1], way[1])), hn::Mul(way[2], way[2]));
    }

    /// From which side the pattern is laid over steep ground: by the normal of what is seen, which
    /// lies across both changes.
    HWY_INLINE void choose_sides(const GrainWay& across, const GrainWay& down) {
        const auto normal2 = [&](std::size_t one, std::size_t other) HWY_ATTR {
            const auto part =
                hn::Sub(hn::Mul(across[one], down[other]), hn::Mul(across[other], down[one]));
            return hn::Mul(part, part);
        };
        const auto east2 = normal2(1, 2);
        const auto north2 = normal2(2, 0);
        constexpr float least2 =
            scene::GrainPattern::upright_from * scene::GrainPattern::upright_from;
        const auto is_steep = hn::Gt(hn::Add(east2, north2), hn::Mul(normal2(0, 1), twos(least2)));
        const auto is_east = hn::Ge(east2, north2);
        upright_in_x_ = hn::And(is_steep, is_east);
        upright_in_y_ = hn::AndNot(is_east, is_steep);
        any_upright_ = !hn::AllFalse(Twos(), is_steep);
    }

    /// Not negative: whole tiles are added.
    static HWY_INLINE hn::Vec<TwosBits> fixed(hn::Vec<Twos> parts_of_texels) {
        constexpr int tiles = 1 << 30;
        const auto parts = hn::ConvertTo(TwosWhole(), parts_of_texels);
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
        places_.fine = place_of(rays, scale_);
        places_.coarse = place_of(rays, hn::Add(scale_, twos_of(1)));
    }

    /// The eye's part `part` of its place at scales.
    static HWY_INLINE hn::Vec<Twos>
    at_eye(const GrainRays& rays, std::size_t part, hn::Vec<TwosBits> scale) {
        const Twos real;
        const auto which = hn::IndicesFromVec(real, hn::BitCast(TwosWhole(), scale));
        const float* const of_scales = rays.at_eye[part].data();
        return hn::TableLookupLanes(hn::LoadDup128(real, of_scales), which);
    }

    /// At odd scales the pattern is turned by a right angle, and leans the other way.
    HWY_INLINE GrainPlace place_of(const GrainRays& rays, hn::Vec<TwosBits> scale) const {
        using scene::GrainPattern;
        const Twos real;
        static_assert(GrainPattern::scales == 4 && GrainPattern::texels_per_m == 8.0F);
        static_assert(GrainPattern::scale_step == 16);
        const auto is_odd = hn::RebindMask(real, hn::Ne(hn::And(scale, twos_of(1)), twos_of(0)));
        const auto turned = hn::BitCast(real, hn::ShiftLeft<31>(scale)); // the sign of odd ones
        const auto lean = [&](float per_m)
                              HWY_ATTR { return hn::Xor(hn::Mul(at_[2], twos(per_m)), turned); };
        const auto east = hn::Add(at_[0], lean(GrainPattern::lean.x));
        const auto north = hn::Add(at_[1], lean(GrainPattern::lean.y));
        auto x_m = hn::IfThenElse(is_odd, north, east);
        auto y_m = hn::Xor(hn::IfThenElse(is_odd, east, north), turned);
        auto eye_x = at_eye(rays, 0, scale);
        auto eye_y = at_eye(rays, 1, scale);
        if (any_upright_) {
            const auto in_turn = [&](hn::Mask<Twos> odd, hn::Mask<Twos> even) HWY_ATTR {
                return hn::Or(hn::And(is_odd, odd), hn::AndNot(is_odd, even));
            };
            const auto in_x = in_turn(upright_in_y_, upright_in_x_);
            const auto in_y = in_turn(upright_in_x_, upright_in_y_);
            const auto eye_up = at_eye(rays, 2, scale);
            x_m = hn::IfThenElse(in_x, at_[2], x_m);
            y_m = hn::IfThenElse(in_y, hn::Xor(at_[2], turned), y_m);
            eye_x = hn::IfThenElse(in_x, eye_up, eye_x);
            eye_y = hn::IfThenElse(in_y, hn::Xor(eye_up, turned), eye_y);
        }
        const auto exponent = hn::Sub(twos_of(127 + 3 + 8), hn::ShiftLeft<2>(scale));
        const auto parts_per_m = hn::BitCast(real, hn::ShiftLeft<23>(exponent));
        return {
            fixed(hn::Add(hn::Mul(x_m, parts_per_m), eye_x)),
            fixed(hn::Add(hn::Mul(y_m, parts_per_m), eye_y))};
    }

    hn::Mask<Twos> is_ground_;
    hn::Vec<Twos> depth_;
    GrainWay at_; ///< metres from the eye
    hn::Vec<TwosBits> scale_;
    GrainPlaces places_;
    hn::Mask<Twos> upright_in_x_; ///< the pattern's east is up
    hn::Mask<Twos> upright_in_y_; ///< its north is
    bool any_upright_ = false;
    hn::Mask<Twos> is_even_;
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
