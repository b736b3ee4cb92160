// Where every second pixel looks in the fine pattern of ground, and at which level: by how near the ground is there,
// and how that changes to the pixels beside and below. Included once for each instruction set.
#if defined(OCTANT_RASTER_GRAIN_PLACES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GRAIN_PLACES_INL
#undef OCTANT_RASTER_GRAIN_PLACES_INL
#else
#define OCTANT_RASTER_GRAIN_PLACES_INL
#endif

#include "visuals/raster/detail_image.h"
#include "visuals/raster/detail_inverse_depth-inl.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

/// A part of the lines of sight over a tile.
struct TileRayComponent {
    float first; ///< of the tile's first pixel
    float per_x; ///< from pixel to pixel
    float per_y;

    HWY_INLINE TileRayComponent(const AttributePlane& ray, const glm::ivec2& first_px)
        : first(static_cast<float>(ray.at(first_px.x, first_px.y))), per_x(static_cast<float>(ray.per_x)),
          per_y(static_cast<float>(ray.per_y)) {}

    /// Of the first pixels of every second pair of a row of the tile, from one on.
    HWY_INLINE hn::Vec<PixelPairs> in_row(std::size_t row, std::size_t first_two) const {
        const auto columns = hn::Add(hn::Mul(lane_indices_from(PixelPairs(), 0), pair_floats(4.0F)),
            pair_floats(static_cast<float>(2 * first_two)));
        const float of_row = first + static_cast<float>(row) * per_y;
        return hn::Add(pair_floats(of_row), hn::Mul(columns, pair_floats(per_x)));
    }

    /// Of the pixels right of the tile, in every second row from one on.
    HWY_INLINE hn::Vec<PixelPairs> right_of_tile(std::size_t first_row) const {
        const auto numbers = lane_indices_from(PixelPairs(), 0);
        const auto rows = hn::Add(pair_floats(static_cast<float>(first_row)), hn::Add(numbers, numbers));
        const float right = first + static_cast<float>(tile_width) * per_x;
        return hn::Add(pair_floats(right), hn::Mul(rows, pair_floats(per_y)));
    }
};

/// A part of the lines of sight at the first pixels of pairs.
using PairRays = std::array<hn::Vec<PixelPairs>, 3>;

/// The lines of sight of a tile: east, north and up.
struct TileRays {
    std::array<TileRayComponent, 3> part;

    HWY_INLINE TileRays(const DetailRays& rays, const glm::ivec2& first_px)
        : part{TileRayComponent(rays.direction[0], first_px), TileRayComponent(rays.direction[1], first_px),
              TileRayComponent(rays.direction[2], first_px)} {}

    HWY_INLINE PairRays in_row(std::size_t row, std::size_t first_two) const {
        return {part[0].in_row(row, first_two), part[1].in_row(row, first_two), part[2].in_row(row, first_two)};
    }

    HWY_INLINE PairRays right_of_tile(std::size_t first_row) const {
        return {part[0].right_of_tile(first_row), part[1].right_of_tile(first_row), part[2].right_of_tile(first_row)};
    }

    /// How far away ground one unit deep is in the middle of a tile.
    HWY_INLINE float length() const {
        float squares = 0.0F;
        for (const TileRayComponent& ray : part) {
            const float middle = ray.first + 0.5F * (tile_width * ray.per_x + tile_height * ray.per_y);
            squares += middle * middle;
        }
        return std::sqrt(squares);
    }
};

/// Where pairs of pixels look in the pattern: at a scale at the level of their size, and at the next coarser scale at
/// its finest level.
struct DetailPositions {
    // 1/256 texel of the finest level.
    hn::Vec<PixelPairInts> fine_x;
    hn::Vec<PixelPairInts> fine_y;
    hn::Vec<PixelPairInts> coarse_x;
    hn::Vec<PixelPairInts> coarse_y;
    /// The level, counted through all scales, 2^-24; its lowest bits are `ground` and `sides`.
    hn::Vec<PixelPairBits> level;
    /// What the haze leaves, 2^-15; 0: no ground, or nothing is left.
    hn::Vec<PixelPairBits> left;

    static constexpr unsigned ground = 4; ///< there is some
    static constexpr unsigned sides = 3;  ///< from which the pattern is laid over it
    static constexpr int scale_shift = 26;
};

/// Finds them.
class DetailSampler {
public:
    HWY_INLINE DetailSampler(
        const DetailRays& rays, const TileRays& tile_rays, const PairRays& direction, const InverseDepthQuad& near)
        : is_ground_(hn::Gt(near.here, hn::Zero(PixelPairs()))),
          depth_(hn::Div(pair_floats(1.0F), hn::Max(near.here, pair_floats(1e-9F)))) {
        PairRays across;
        PairRays down;
        for (std::size_t i = 0; i < 3; ++i) {
            at_[i] = hn::Mul(direction[i], depth_);
            const auto moves = [&](float per_px, hn::Vec<PixelPairs> change)
                                   HWY_ATTR { return hn::Sub(pair_floats(per_px), hn::Mul(at_[i], change)); };
            across[i] = moves(tile_rays.part[i].per_x, near.across);
            down[i] = moves(tile_rays.part[i].per_y, near.down);
        }
        // The pattern's finest features are two texels wide: half a level finer than usual will do.
        const auto widest = hn::Max(square(across), hn::Mul(square(down), pair_floats(0.5F)));
        const auto depth2 = hn::Mul(depth_, depth_);
        choose_level(hn::Mul(widest, depth2));
        choose_sides(across, down);
        look_at(rays);
    }

    /// `haze_per_depth`: by how much ground one unit deep dims.
    HWY_INLINE DetailPositions places(const DetailRays& rays, float haze_per_depth) const {
        const PixelPairBits bits;
        const auto of = [&](hn::Mask<PixelPairs> which, unsigned bit)
                            HWY_ATTR { return hn::IfThenElseZero(hn::RebindMask(bits, which), pair_bits(bit)); };
        const auto flags =
            hn::Or(of(is_ground_, DetailPositions::ground), hn::Or(of(upright_in_x_, 1), of(upright_in_y_, 2)));
        const auto left = hn::IfThenElseZero(hn::RebindMask(bits, is_ground_), left_of_haze(rays, haze_per_depth));
        return {fine_.x, fine_.y, coarse_.x, coarse_.y, hn::Or(hn::AndNot(pair_bits(7), level_), flags), left};
    }

private:
    /// As DetailPositions has it.
    struct Place {
        hn::Vec<PixelPairInts> x;
        hn::Vec<PixelPairInts> y;
    };

    struct PlaceM {
        hn::Vec<PixelPairs> x;
        hn::Vec<PixelPairs> y;
    };

    static HWY_INLINE hn::Vec<PixelPairs> square(const PairRays& direction) {
        return hn::Add(hn::Add(hn::Mul(direction[0], direction[0]), hn::Mul(direction[1], direction[1])),
            hn::Mul(direction[2], direction[2]));
    }

    /// As scene::Haze, by polynomials: the pattern need not fade to the bit.
    HWY_INLINE hn::Vec<PixelPairBits> left_of_haze(const DetailRays& rays, float haze_per_depth) const {
        const auto haze_density_exponent = hn::Mul(at_[2], pair_floats(-rays.haze_falloff_per_m));
        const auto within = hn::Min(hn::Max(haze_density_exponent, pair_floats(-1.5F)), pair_floats(6.0F));
        auto density = hn::Add(pair_floats(1.0F / 24.0F), hn::Mul(within, pair_floats(1.0F / 120.0F)));
        for (const float factor : {1.0F / 6.0F, 1.0F / 2.0F, 1.0F}) {
            density = hn::Add(pair_floats(factor), hn::Mul(within, density));
        }
        const auto haze = hn::Mul(hn::Mul(depth_, pair_floats(haze_per_depth)), density);
        // (1 - x / 16)^16
        const auto sixteenth = hn::Mul(haze, pair_floats(1.0F / 16.0F));
        auto share = hn::Max(hn::Sub(pair_floats(1.0F), sixteenth), hn::Zero(PixelPairs()));
        for (int i = 0; i < 4; ++i) { share = hn::Mul(share, share); }
        return hn::BitCast(PixelPairBits(), hn::ConvertTo(PixelPairInts(), hn::Mul(share, pair_floats(32767.0F))));
    }

    /// From which side the pattern is laid over steep ground: by the normal of what is seen, which lies across both
    /// changes.
    HWY_INLINE void choose_sides(const PairRays& across, const PairRays& down) {
        const auto normal2 = [&](std::size_t one, std::size_t other) HWY_ATTR {
            const auto part = hn::Sub(hn::Mul(across[one], down[other]), hn::Mul(across[other], down[one]));
            return hn::Mul(part, part);
        };
        const auto east2 = normal2(1, 2);
        const auto north2 = normal2(2, 0);
        constexpr float least2 = scene::DetailPattern::min_upright_slope * scene::DetailPattern::min_upright_slope;
        const auto is_steep = hn::Gt(hn::Add(east2, north2), hn::Mul(normal2(0, 1), pair_floats(least2)));
        const auto is_east = hn::Ge(east2, north2);
        upright_in_x_ = hn::And(is_steep, is_east);
        upright_in_y_ = hn::AndNot(is_east, is_steep);
        any_upright_ = !hn::AllFalse(PixelPairs(), is_steep);
    }

    /// By half the logarithm of the squared width of what is seen, straight between powers of two.
    HWY_INLINE void choose_level(hn::Vec<PixelPairs> width2_m) {
        using scene::DetailPattern;
        constexpr std::int32_t of_one = 127 << 23; // the bits of 1.0
        constexpr int levels = DetailPattern::levels_per_scale * (DetailPattern::scales - 1);
        constexpr std::int32_t most = (levels << 24) - 1;
        constexpr float texels2_per_m2 = DetailPattern::texels_per_m * DetailPattern::texels_per_m;
        const auto texels2 = hn::Mul(width2_m, pair_floats(texels2_per_m2));
        const auto exponent = hn::Sub(hn::BitCast(PixelPairInts(), texels2), hn::Set(PixelPairInts(), of_one));
        level_ = hn::BitCast(
            PixelPairBits(), hn::Min(hn::Max(exponent, hn::Zero(PixelPairInts())), hn::Set(PixelPairInts(), most)));
    }

    /// At odd scales the pattern is turned by a right angle, and leans the other way.
    HWY_INLINE void look_at(const DetailRays& rays) {
        using scene::DetailPattern;
        const auto lean_east = hn::Mul(at_[2], pair_floats(DetailPattern::shift_per_height.x));
        const auto lean_north = hn::Mul(at_[2], pair_floats(DetailPattern::shift_per_height.y));
        PlaceM even{hn::Add(at_[0], lean_east), hn::Add(at_[1], lean_north)};
        PlaceM odd{hn::Sub(at_[1], lean_north), hn::Sub(lean_east, at_[0])};
        if (any_upright_) {
            even.x = hn::IfThenElse(upright_in_x_, at_[2], even.x);
            even.y = hn::IfThenElse(upright_in_y_, at_[2], even.y);
            odd.x = hn::IfThenElse(upright_in_y_, at_[2], odd.x);
            odd.y = hn::IfThenElse(upright_in_x_, hn::Neg(at_[2]), odd.y);
        }
        fine_ = {hn::Zero(PixelPairInts()), hn::Zero(PixelPairInts())};
        coarse_ = fine_;
        const auto scale_of_each = hn::ShiftRight<DetailPositions::scale_shift>(level_);
        // Pairs beside each other seldom see different scales.
        for (std::size_t scale = 0; scale + 1 < DetailPattern::scales; ++scale) {
            const auto is_it =
                hn::RebindMask(PixelPairInts(), hn::Eq(scale_of_each, pair_bits(static_cast<unsigned>(scale))));
            if (hn::AllFalse(PixelPairInts(), is_it)) { continue; }
            const bool is_odd = scale % 2 != 0;
            const Place fine = place_of(rays, scale, is_odd ? odd : even);
            const Place coarse = place_of(rays, scale + 1, is_odd ? even : odd);
            fine_.x = hn::IfThenElse(is_it, fine.x, fine_.x);
            fine_.y = hn::IfThenElse(is_it, fine.y, fine_.y);
            coarse_.x = hn::IfThenElse(is_it, coarse.x, coarse_.x);
            coarse_.y = hn::IfThenElse(is_it, coarse.y, coarse_.y);
        }
    }

    HWY_INLINE Place place_of(const DetailRays& rays, std::size_t scale, const PlaceM& at_m) const {
        const DetailRays::Scale& of = rays.scales[scale];
        const auto fixed = [&](hn::Vec<PixelPairs> place_m, hn::Vec<PixelPairs> eye) HWY_ATTR {
            const auto parts = hn::Add(hn::Mul(place_m, pair_floats(of.parts_per_m)), eye);
            return hn::ConvertTo(PixelPairInts(), parts);
        };
        auto eye_x = pair_floats(of.eye.x);
        auto eye_y = pair_floats(of.eye.y);
        if (any_upright_) {
            const bool is_odd = scale % 2 != 0;
            const auto in_x = is_odd ? upright_in_y_ : upright_in_x_;
            const auto in_y = is_odd ? upright_in_x_ : upright_in_y_;
            eye_x = hn::IfThenElse(in_x, pair_floats(of.eye_up), eye_x);
            eye_y = hn::IfThenElse(in_y, pair_floats(is_odd ? -of.eye_up : of.eye_up), eye_y);
        }
        return {fixed(at_m.x, eye_x), fixed(at_m.y, eye_y)};
    }

    hn::Mask<PixelPairs> is_ground_;
    hn::Vec<PixelPairs> depth_;
    PairRays at_;                  ///< metres from the eye
    hn::Vec<PixelPairBits> level_; ///< as DetailPositions, but for its flags
    Place fine_;
    Place coarse_;
    hn::Mask<PixelPairs> upright_in_x_; ///< at even scales the pattern's east is up
    hn::Mask<PixelPairs> upright_in_y_; ///< its north is
    bool any_upright_ = false;
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
