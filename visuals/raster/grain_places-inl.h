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

/// A coordinate of rays over a tile, from a row on.
struct GrainRay {
    float first; ///< between the row's first two pixels
    float per_x; ///< from pixel to pixel
    float per_y;
    float at_eye;

    HWY_INLINE GrainRay(const RealPlane& ray, double from_eye, const glm::ivec2& first_px)
        : first(static_cast<float>(ray.at(first_px.x + 0.5, first_px.y)))
        , per_x(static_cast<float>(ray.per_x))
        , per_y(static_cast<float>(ray.per_y))
        , at_eye(static_cast<float>(from_eye)) {}

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

    HWY_INLINE Nearness(const float* from_here, const float* from_across, const float* from_down)
        : here(hn::LoadU(Twos(), from_here))
        , across(hn::LoadU(Twos(), from_across))
        , down(hn::LoadU(Twos(), from_down)) {}

    /// `other_row`: the row below, or, where `up`, the one above.
    HWY_INLINE Nearness(const float* row, const float* other_row, bool up) {
        const Twos real;
        hn::Vec<Twos> left;
        hn::Vec<Twos> right;
        hn::Vec<Twos> other_left;
        hn::Vec<Twos> other_right;
        hn::LoadInterleaved2(real, row, left, right);
        hn::LoadInterleaved2(real, other_row, other_left, other_right);
        const auto step = [&](hn::Vec<Twos> from, hn::Vec<Twos> to) HWY_ATTR {
            const auto are_ground = hn::Gt(hn::Min(from, to), hn::Zero(real));
            return hn::IfThenElseZero(are_ground, hn::Sub(to, from));
        };
        here = hn::Max(left, right);
        across = step(left, right);
        down = step(left, other_left);
        down = up ? hn::Neg(down) : down;
    }
};

/// Where pairs of pixels look in the pattern.
struct GrainPlaces {
    hn::Vec<TwosBits> x; ///< 1/256 texel of the finest level
    hn::Vec<TwosBits> y;
    hn::Vec<TwosBits> level;
    hn::Vec<TwosBits> coarse; ///< share of the next level, 1/256
    hn::Vec<TwosBits> ground; ///< all bits where there is any, else none
};

/// The rays of a row of a tile, or of all its rows.
struct GrainRayPair {
    GrainRay x;
    GrainRay y;

    HWY_INLINE GrainRayPair(const GrainRays& rays, const glm::ivec2& first_px)
        : x(rays.x, rays.at_eye.x, first_px)
        , y(rays.y, rays.at_eye.y, first_px) {}
};

/// Finds them where rays of both coordinates go.
class GrainLook {
public:
    HWY_INLINE GrainLook(
        const GrainRayPair& rays, hn::Vec<Twos> ray_x, hn::Vec<Twos> ray_y, const Nearness& near) {
        const auto depth = hn::Div(twos(1.0F), hn::Max(near.here, twos(1e-9F)));
        auto across2 = hn::Zero(Twos());
        auto down2 = hn::Zero(Twos());
        const auto along = [&](const GrainRay& ray, hn::Vec<Twos> way) HWY_ATTR {
            const auto at = hn::Mul(way, depth);
            const auto moves = [&](float per_px, hn::Vec<Twos> change) HWY_ATTR {
                return hn::Mul(hn::Sub(twos(per_px), hn::Mul(at, change)), depth);
            };
            const auto across = moves(ray.per_x, near.across);
            const auto down = moves(ray.per_y, near.down);
            across2 = hn::Add(across2, hn::Mul(across, across));
            down2 = hn::Add(down2, hn::Mul(down, down));
            return fixed(hn::Add(at, twos(ray.at_eye)));
        };
        places_.ground =
            hn::BitCast(TwosBits(), hn::VecFromMask(Twos(), hn::Gt(near.here, hn::Zero(Twos()))));
        places_.x = along(rays.x, ray_x);
        places_.y = along(rays.y, ray_y);
        // The pattern's finest features are two texels wide: half a level finer than usual will do.
        choose_levels(hn::Max(across2, hn::Mul(down2, twos(0.5F))));
    }

    HWY_INLINE const GrainPlaces& places() const { return places_; }

private:
    /// Not negative: whole tiles are added.
    static HWY_INLINE hn::Vec<TwosBits> fixed(hn::Vec<Twos> texels) {
        constexpr float most_texels = 30000.0F;
        constexpr int tiles = 32768 * 256;
        const auto within = hn::Min(hn::Max(texels, twos(-most_texels)), twos(most_texels));
        const auto parts = hn::ConvertTo(TwosWhole(), hn::Mul(within, twos(256.0F)));
        return hn::BitCast(TwosBits(), hn::Add(parts, hn::Set(TwosWhole(), tiles)));
    }

    /// By half the logarithm of the squared width of what is seen, straight between powers of two.
    /// Most pixels take one level: the next one comes in over a third of the way only.
    HWY_INLINE void choose_levels(hn::Vec<Twos> texels2) {
        constexpr std::int32_t of_one = 127 << 23; // the bits of 1.0
        constexpr std::int32_t most = ((GrainImage::levels - 1) << 24) - 1;
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
        places_.level = hn::Add(hn::ShiftRight<24>(bits), next);
        places_.coarse = hn::And(hn::BitCast(TwosBits(), share), twos_of(0xff));
    }

    GrainPlaces places_;
};

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
