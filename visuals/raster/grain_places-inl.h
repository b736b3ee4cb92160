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

/// A part of the lines of sight over a tile.
struct GrainRay {
    float first; ///< of the tile's first pixel
    float per_x; ///< from pixel to pixel
    float per_y;

    HWY_INLINE GrainRay(const RealPlane& ray, const glm::ivec2& first_px)
        : first(static_cast<float>(ray.at(first_px.x, first_px.y)))
        , per_x(static_cast<float>(ray.per_x))
        , per_y(static_cast<float>(ray.per_y)) {}

    /// Of the first pixels of every second pair of a row of the tile, from one on.
    HWY_INLINE hn::Vec<Twos> in_row(std::size_t row, std::size_t first_two) const {
        const auto columns = hn::Add(
            hn::Mul(counting_from(Twos(), 0), twos(4.0F)), twos(static_cast<float>(2 * first_two)));
        const float of_row = first + static_cast<float>(row) * per_y;
        return hn::Add(twos(of_row), hn::Mul(columns, twos(per_x)));
    }

    /// Of the pixels right of the tile, in every second row from one on.
    HWY_INLINE hn::Vec<Twos> beside(std::size_t first_row) const {
        const auto numbers = counting_from(Twos(), 0);
        const auto rows = hn::Add(twos(static_cast<float>(first_row)), hn::Add(numbers, numbers));
        const float right = first + static_cast<float>(tile_width) * per_x;
        return hn::Add(twos(right), hn::Mul(rows, twos(per_y)));
    }
};

/// A part of the lines of sight at the first pixels of pairs.
using GrainWay = std::array<hn::Vec<Twos>, 3>;

/// The lines of sight of a tile: east, north and up.
struct GrainWays {
    std::array<GrainRay, 3> part;

    HWY_INLINE GrainWays(const GrainRays& rays, const glm::ivec2& first_px)
        : part{
              GrainRay(rays.way[0], first_px),
              GrainRay(rays.way[1], first_px),
              GrainRay(rays.way[2], first_px)} {}

    HWY_INLINE GrainWay in_row(std::size_t row, std::size_t first_two) const {
        return {
            part[0].in_row(row, first_two),
            part[1].in_row(row, first_two),
            part[2].in_row(row, first_two)};
    }

    HWY_INLINE GrainWay beside(std::size_t first_row) const {
        return {part[0].beside(first_row), part[1].beside(first_row), part[2].beside(first_row)};
    }

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

/// Where pairs of pixels look in the pattern: at a scale at the level of their size, and at the
/// next coarser scale at its finest level.
struct GrainPlaces {
    // 1/256 texel of the finest level.
    hn::Vec<TwosWhole> fine_x;
    hn::Vec<TwosWhole> fine_y;
    hn::Vec<TwosWhole> coarse_x;
    hn::Vec<TwosWhole> coarse_y;
    /// The level, counted through all scales, 2^-24; its lowest bits are `ground` and `sides`.
    hn::Vec<TwosBits> level;
    /// What the haze leaves, 2^-15; 0: no ground, or nothing is left.
    hn::Vec<TwosBits> left;

    static constexpr unsigned ground = 4; ///< there is some
    static constexpr unsigned sides = 3;  ///< from which the pattern is laid over it
    static constexpr int scale_shift = 26;
};

/// Finds them.
class GrainLook {
public:
    HWY_INLINE GrainLook(
        const GrainRays& rays, const GrainWays& ways, const GrainWay& way, const Nearness& near)
        : is_ground_(hn::Gt(near.here, hn::Zero(Twos())))
        , depth_(hn::Div(twos(1.0F), hn::Max(near.here, twos(1e-9F)))) {
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
        choose_level(hn::Mul(widest, depth2));
        choose_sides(across, down);
        look_at(rays);
    }

    /// `haze_per_depth`: by how much ground one unit deep dims.
    HWY_INLINE GrainPlaces places(const GrainRays& rays, float haze_per_depth) const {
        const TwosBits bits;
        const auto of = [&](hn::Mask<Twos> which, unsigned bit) HWY_ATTR {
            return hn::IfThenElseZero(hn::RebindMask(bits, which), twos_of(bit));
        };
        const auto flags = hn::Or(
            of(is_ground_, GrainPlaces::ground),
            hn::Or(of(upright_in_x_, 1), of(upright_in_y_, 2)));
        const auto left = hn::IfThenElseZero(
            hn::RebindMask(bits, is_ground_), left_of_haze(rays, haze_per_depth));
        return {
            fine_.x,
            fine_.y,
            coarse_.x,
            coarse_.y,
            hn::Or(hn::AndNot(twos_of(7), level_), flags),
            left};
    }

private:
    /// As GrainPlaces has it.
    struct Place {
        hn::Vec<TwosWhole> x;
        hn::Vec<TwosWhole> y;
    };

    struct PlaceM {
        hn::Vec<Twos> x;
        hn::Vec<Twos> y;
    };

    static HWY_INLINE hn::Vec<Twos> square(const GrainWay& way) {
        return hn::Add(
            hn::Add(hn::Mul(way[0], way[0]), hn::Mul(way[1], way[1])), hn::Mul(way[2], way[2]));
    }

    /// As scene::Haze, by polynomials: the pattern need not fade to the bit.
    HWY_INLINE hn::Vec<TwosBits> left_of_haze(const GrainRays& rays, float haze_per_depth) const {
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

    /// By half the logarithm of the squared width of what is seen, straight between powers of two.
    HWY_INLINE void choose_level(hn::Vec<Twos> width2_m) {
        using scene::GrainPattern;
        constexpr std::int32_t of_one = 127 << 23; // the bits of 1.0
        constexpr int levels = GrainPattern::levels_a_scale * (GrainPattern::scales - 1);
        constexpr std::int32_t most = (levels << 24) - 1;
        constexpr float texels2_per_m2 = GrainPattern::texels_per_m * GrainPattern::texels_per_m;
        const auto texels2 = hn::Mul(width2_m, twos(texels2_per_m2));
        const auto exponent =
            hn::Sub(hn::BitCast(TwosWhole(), texels2), hn::Set(TwosWhole(), of_one));
        level_ = hn::BitCast(
            TwosBits(),
            hn::Min(hn::Max(exponent, hn::Zero(TwosWhole())), hn::Set(TwosWhole(), most)));
    }

    /// At odd scales the pattern is turned by a right angle, and leans the other way.
    HWY_INLINE void look_at(const GrainRays& rays) {
        using scene::GrainPattern;
        const auto lean_east = hn::Mul(at_[2], twos(GrainPattern::lean.x));
        const auto lean_north = hn::Mul(at_[2], twos(GrainPattern::lean.y));
        PlaceM even{hn::Add(at_[0], lean_east), hn::Add(at_[1], lean_north)};
        PlaceM odd{hn::Sub(at_[1], lean_north), hn::Sub(lean_east, at_[0])};
        if (any_upright_) {
            even.x = hn::IfThenElse(upright_in_x_, at_[2], even.x);
            even.y = hn::IfThenElse(upright_in_y_, at_[2], even.y);
            odd.x = hn::IfThenElse(upright_in_y_, at_[2], odd.x);
            odd.y = hn::IfThenElse(upright_in_x_, hn::Neg(at_[2]), odd.y);
        }
        fine_ = {hn::Zero(TwosWhole()), hn::Zero(TwosWhole())};
        coarse_ = fine_;
        const auto scale_of_each = hn::ShiftRight<GrainPlaces::scale_shift>(level_);
        // Pairs beside each other seldom see different scales.
        for (std::size_t scale = 0; scale + 1 < GrainPattern::scales; ++scale) {
            const auto is_it = hn::RebindMask(
                TwosWhole(), hn::Eq(scale_of_each, twos_of(static_cast<unsigned>(scale))));
            if (hn::AllFalse(TwosWhole(), is_it)) {
                continue;
            }
            const bool is_odd = scale % 2 != 0;
            const Place fine = place_of(rays, scale, is_odd ? odd : even);
            const Place coarse = place_of(rays, scale + 1, is_odd ? even : odd);
            fine_.x = hn::IfThenElse(is_it, fine.x, fine_.x);
            fine_.y = hn::IfThenElse(is_it, fine.y, fine_.y);
            coarse_.x = hn::IfThenElse(is_it, coarse.x, coarse_.x);
            coarse_.y = hn::IfThenElse(is_it, coarse.y, coarse_.y);
        }
    }

    HWY_INLINE Place place_of(const GrainRays& rays, std::size_t scale, const PlaceM& at_m) const {
        const GrainRays::Scale& of = rays.scales[scale];
        const auto fixed = [&](hn::Vec<Twos> place_m, hn::Vec<Twos> eye) HWY_ATTR {
            const auto parts = hn::Add(hn::Mul(place_m, twos(of.parts_per_m)), eye);
            return hn::ConvertTo(TwosWhole(), parts);
        };
        auto eye_x = twos(of.eye.x);
        auto eye_y = twos(of.eye.y);
        if (any_upright_) {
            const bool is_odd = scale % 2 != 0;
            const auto in_x = is_odd ? upright_in_y_ : upright_in_x_;
            const auto in_y = is_odd ? upright_in_x_ : upright_in_y_;
            eye_x = hn::IfThenElse(in_x, twos(of.eye_up), eye_x);
            eye_y = hn::IfThenElse(in_y, twos(is_odd ? -of.eye_up : of.eye_up), eye_y);
        }
        return {fixed(at_m.x, eye_x), fixed(at_m.y, eye_y)};
    }

    hn::Mask<Twos> is_ground_;
    hn::Vec<Twos> depth_;
    GrainWay at_;             ///< metres from the eye
    hn::Vec<TwosBits> level_; ///< as GrainPlaces, but for its flags
    Place fine_;
    Place coarse_;
    hn::Mask<Twos> upright_in_x_; ///< at even scales the pattern's east is up
    hn::Mask<Twos> upright_in_y_; ///< its north is
    bool any_upright_ = false;
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
