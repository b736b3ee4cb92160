// The detail texture of ground, added when all triangles of a tile are painted. In this order: inverse depth between
// the pixels that recorded it; positions in the pattern; the pattern looked up for a row; the change of each pixel's
// colour; the whole tile. Included once for each instruction set.
#if defined(OCTANT_RASTER_DETAIL_TEXTURE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_DETAIL_TEXTURE_INL
#undef OCTANT_RASTER_DETAIL_TEXTURE_INL
#else
#define OCTANT_RASTER_DETAIL_TEXTURE_INL
#endif

#include "visuals/raster/detail_rays.h"
#include "visuals/raster/strip_coverage-inl.h"
#include "visuals/raster/triangle.h"
#include "visuals/scene/detail_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// -- Inverse depth of the ground at every second pixel of every second row. The pixels of a row have two phases:
// positions in the pattern are computed for one pair of pixels in two, and for the pairs between them only where the
// ground bends.

/// A lane for two neighbouring pixels.
using PixelPairs = hn::CappedTag<float, 16>;
using PixelPairInts = hn::RebindToSigned<PixelPairs>;
using PixelPairBits = hn::RebindToUnsigned<PixelPairs>;
using PixelPairHalves = hn::Repartition<std::int16_t, PixelPairBits>;
constexpr std::size_t pairs_at_once = hn::MaxLanes(PixelPairs());
constexpr std::size_t pairs_per_row = tile_width / 2;
constexpr std::size_t phases = 2; ///< pairs 0, 2, 4 ..., then 1, 3, 5 ...
constexpr std::size_t pairs_per_phase = pairs_per_row / phases;

HWY_INLINE hn::Vec<PixelPairs> pair_floats(float value) { return hn::Set(PixelPairs(), value); }

HWY_INLINE hn::Vec<PixelPairBits> pair_bits(unsigned value) { return hn::Set(PixelPairBits(), value); }

/// Of two changes the smaller one: at a rim the larger one leads to other ground.
HWY_INLINE hn::Vec<PixelPairs> smaller_change(hn::Vec<PixelPairs> one, hn::Vec<PixelPairs> other) {
    return hn::IfThenElse(hn::Lt(hn::Abs(one), hn::Abs(other)), one, other);
}

/// Inverse depth of the ground at the first pixels of pairs, and its change to the pixels to the right and below.
struct InverseDepthQuad {
    hn::Vec<PixelPairs> here; ///< 1/m; 0: no ground
    hn::Vec<PixelPairs> across;
    hn::Vec<PixelPairs> down;
};

/// Pairs of pixels amid four others.
struct InterpolatedPairs {
    hn::Mask<PixelPairs> is_ground;
    hn::Mask<PixelPairs> is_linear; ///< as near as the mean of these
};

/// The inverse depth of a tile's pairs by phases, in rows that stand for two of the tile's each. Right of the tile and
/// below it the ground goes on as within it.
class TileInverseDepths {
public:
    HWY_INLINE TileInverseDepths(const TileJob& job, const TileBuffer& buffer) : rows_((job.size_px.y + 1) / 2) {
        for (int row = 0; row < rows_; ++row) { put_row(buffer.ground_of_row(2 * row), row); }
        if (any_ != 0) {
            extend(1, 0, -1, true);
            extend(rows_ - 2, rows_ - 1, rows_, false);
            std::fill_n(of_row(rows_ + 1), row_size, 0.0F);
        }
    }

    int rows() const { return rows_; }

    bool has_ground() const { return any_ != 0; }

    /// Whether a pair of a row sees ground; beyond the last row as in it.
    bool has_ground(int row) const { return (any_ >> std::min(row, rows_ - 1) & 1U) != 0; }

    /// Of pairs of a row and phase, from one of them on.
    HWY_INLINE InverseDepthQuad at(int row, std::size_t phase, std::size_t first) const {
        const float* const own = of_row(row) + first + (phase == 0 ? 0 : odd_pairs);
        const float* const before = phase == 0 ? own + odd_pairs - 1 : own - odd_pairs;
        const PixelPairs real;
        return between(hn::LoadU(real, own), {hn::LoadU(real, before), hn::LoadU(real, before + 1)},
            {hn::LoadU(real, own - row_size), hn::LoadU(real, own + row_size)});
    }

    /// Those of a phase amid the nearest ones of the first phase in rows of even number.
    HWY_INLINE InterpolatedPairs interpolated_at(int row, std::size_t phase, std::size_t first) const {
        const PixelPairs real;
        const float* const own = of_row(row) + first + (phase == 0 ? 0 : odd_pairs);
        const auto both = [&](const float* corner)
                              HWY_ATTR { return hn::Add(hn::LoadU(real, corner), hn::LoadU(real, corner + phase)); };
        const int away = row & 1;
        const auto around = hn::Add(both(of_row(row - away) + first), both(of_row(row + away) + first));
        const auto here = hn::LoadU(real, own);
        constexpr float max_off = 1.0F / 64.0F; // of four times itself: a pixel's height
        const auto off = hn::Sub(hn::Mul(here, pair_floats(4.0F)), around);
        return {hn::Gt(here, hn::Zero(real)), hn::Le(hn::Abs(off), hn::Mul(here, pair_floats(max_off)))};
    }

    /// Of what lies right of the tile, in rows from one on.
    HWY_INLINE InverseDepthQuad right_of_tile(int first_row) const {
        std::array<std::array<float, pairs_at_once>, 4> columns{};
        for (std::size_t i = 0; i < pairs_at_once; ++i) {
            const int row = first_row + static_cast<int>(i);
            if (row < rows_) {
                const float* const right = of_row(row) + pairs_per_phase;
                columns[0][i] = right[0];
                columns[1][i] = right[odd_pairs - 1];
                columns[2][i] = right[-static_cast<std::ptrdiff_t>(row_size)];
                columns[3][i] = right[row_size];
            }
        }
        const auto column = [&](std::size_t which) HWY_ATTR { return hn::LoadU(PixelPairs(), columns[which].data()); };
        return between(column(0), {column(1), hn::Zero(PixelPairs())}, {column(2), column(3)});
    }

private:
    static constexpr std::size_t odd_pairs = 32; ///< from those of the first phase to the others
    static constexpr std::size_t row_size = 2 * odd_pairs;
    static constexpr std::size_t max_rows = tile_height / 2;
    static_assert(pairs_per_phase + 1 < odd_pairs);

    static HWY_INLINE InverseDepthQuad between(hn::Vec<PixelPairs> own,
        const std::array<hn::Vec<PixelPairs>, 2>& right_of_tile,
        const std::array<hn::Vec<PixelPairs>, 2>& above_and_below) {
        const auto& [before, next] = right_of_tile;
        const auto& [above, below] = above_and_below;
        const auto half = pair_floats(0.5F);
        return {own, hn::Mul(smaller_change(hn::Sub(next, own), hn::Sub(own, before)), half),
            hn::Mul(smaller_change(hn::Sub(below, own), hn::Sub(own, above)), half)};
    }

    const float* of_row(int row) const { return near_.data() + static_cast<std::size_t>(row + 1) * row_size; }

    float* of_row(int row) { return const_cast<float*>(std::as_const(*this).of_row(row)); }

    HWY_INLINE void put_row(const std::uint32_t* ground, int row) {
        const PixelPairs real;
        const PixelPairBits bits;
        float* const to = of_row(row);
        const auto near_bits = pair_bits(~PackedGround::cover_bits);
        auto any = hn::Zero(bits);
        for (std::size_t i = 0; i < pairs_per_phase; i += pairs_at_once) {
            hn::Vec<PixelPairBits> even;
            hn::Vec<PixelPairBits> odd;
            hn::LoadInterleaved2(bits, ground + phases * i, even, odd);
            hn::StoreU(hn::BitCast(real, hn::And(even, near_bits)), real, to + i);
            hn::StoreU(hn::BitCast(real, hn::And(odd, near_bits)), real, to + odd_pairs + i);
            any = hn::Or(any, hn::Or(even, odd));
        }
        const float last = to[odd_pairs + pairs_per_phase - 1];
        const float before = to[pairs_per_phase - 1];
        to[pairs_per_phase] = std::min(last, before) > 0.0F ? std::max(2.0F * last - before, 0.0F) : 0;
        to[odd_pairs - 1] = 0.0F;
        const std::uint32_t bit = std::uint32_t{1} << row;
        any_ |= hn::AllTrue(bits, hn::Eq(any, hn::Zero(bits))) ? 0U : bit;
    }

    /// The row beyond one at the tile's border, by the one before it, which need not see ground.
    HWY_INLINE void extend(int from, int last, int beyond, bool alone) {
        const PixelPairs real;
        const bool has_from = from >= 0 && from < rows_;
        for (std::size_t i = 0; i < row_size; i += pairs_at_once) {
            const auto own = hn::LoadU(real, of_row(last) + i);
            const auto before = has_from ? hn::LoadU(real, of_row(from) + i) : own;
            const auto is_ground = hn::Gt(before, hn::Zero(real));
            const auto next = hn::Max(hn::Sub(hn::Add(own, own), before), hn::Mul(own, pair_floats(0.25F)));
            const auto otherwise = alone ? own : hn::Zero(real);
            hn::StoreU(hn::IfThenElse(is_ground, next, otherwise), real, of_row(beyond) + i);
        }
    }

    int rows_;
    std::uint32_t any_ = 0;
    alignas(64) std::array<float, (max_rows + 3) * row_size> near_; ///< set as far as at() reads
};

// -- Position in the pattern and level of every second pixel, from its inverse depth and the change of the inverse
// depth to the pixels right of it and below it.

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

/// The lines of sight of a tile along the pattern's axes.
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

/// Where pairs of pixels look in the pattern: at a scale at the level of their size, and at the next coarser scale,
/// whose place follows from it, at its finest level.
struct DetailPositions {
    /// Along the pattern's axes at a scale, 1/256 texel of the finest level, within the next scale's cube.
    using Place = std::array<hn::Vec<PixelPairInts>, 3>;

    Place fine;
    /// The level, counted through all scales, 2^-24; its lowest bit is `ground`.
    hn::Vec<PixelPairBits> level;
    /// What the haze leaves, 2^-15; 0: no ground, or nothing is left.
    hn::Vec<PixelPairBits> left;

    static constexpr unsigned ground = 1; ///< there is some
    static constexpr int scale_shift = 24 + 1;
    static_assert(scene::DetailPattern::levels_per_scale == 2);
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
        const auto across2 = dot(across, across);
        const auto down2 = dot(down, down);
        const auto skew = dot(across, down);
        const auto area2 = hn::Max(hn::Sub(hn::Mul(across2, down2), hn::Mul(skew, skew)), hn::Zero(PixelPairs()));
        const auto length2 = hn::Max(across2, down2);
        const auto width2 =
            hn::Max(hn::Sqrt(area2), hn::Mul(length2, pair_floats(scene::DetailPattern::min_share2_of_length)));
        constexpr float all = 32767.0F;
        const auto least = hn::Mul(area2, pair_floats(all * scene::DetailPattern::max_slant2));
        slant_share_ = hn::Min(hn::Div(least, hn::Mul(length2, length2)), pair_floats(all));
        const auto depth2 = hn::Mul(depth_, depth_);
        choose_level(hn::Mul(hn::Mul(width2, depth2), pair_floats(rays.texels2_per_m2)));
        look_at(rays);
    }

    /// `haze_per_depth`: by how much ground one unit deep dims.
    HWY_INLINE DetailPositions places(const DetailRays& rays, float haze_per_depth) const {
        const PixelPairBits bits;
        const auto is_ground = hn::RebindMask(bits, is_ground_);
        const auto flag = hn::IfThenElseZero(is_ground, pair_bits(DetailPositions::ground));
        const auto left = hn::IfThenElseZero(is_ground, left_of_haze(rays, haze_per_depth));
        return {fine_, hn::Or(hn::AndNot(pair_bits(DetailPositions::ground), level_), flag), left};
    }

private:
    static HWY_INLINE hn::Vec<PixelPairs> dot(const PairRays& a, const PairRays& b) {
        return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
    }

    /// As scene::Haze, by polynomials: the pattern need not fade to the bit.
    HWY_INLINE hn::Vec<PixelPairBits> left_of_haze(const DetailRays& rays, float haze_per_depth) const {
        auto up_m = hn::Zero(PixelPairs());
        for (std::size_t i = 0; i < 3; ++i) { up_m = hn::Add(up_m, hn::Mul(at_[i], pair_floats(rays.up[i]))); }
        const auto haze_density_exponent = hn::Mul(up_m, pair_floats(-rays.haze_falloff_per_m));
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
        return hn::BitCast(PixelPairBits(), hn::ConvertTo(PixelPairInts(), hn::Mul(share, slant_share_)));
    }

    /// By half the logarithm of the squared width of what is seen, in texels, straight between powers of two.
    HWY_INLINE void choose_level(hn::Vec<PixelPairs> texels2) {
        using scene::DetailPattern;
        constexpr std::int32_t of_one = 127 << 23; // the bits of 1.0
        constexpr int levels = DetailPattern::levels_per_scale * (DetailPattern::scales - 1);
        constexpr std::int32_t min = static_cast<std::int32_t>(DetailPattern::min_level * (1 << 24));
        constexpr std::int32_t max = (levels << 24) - 1;
        const auto exponent = hn::Sub(hn::BitCast(PixelPairInts(), texels2), hn::Set(PixelPairInts(), of_one));
        level_ = hn::BitCast(
            PixelPairBits(), hn::Min(hn::Max(exponent, hn::Set(PixelPairInts(), min)), hn::Set(PixelPairInts(), max)));
    }

    HWY_INLINE void look_at(const DetailRays& rays) {
        using scene::DetailPattern;
        fine_.fill(hn::Zero(PixelPairInts()));
        const auto scale_of_each = hn::ShiftRight<DetailPositions::scale_shift>(level_);
        // Adjacent pairs seldom have different scales.
        for (std::size_t scale = 0; scale + 1 < DetailPattern::scales; ++scale) {
            const auto is_it =
                hn::RebindMask(PixelPairInts(), hn::Eq(scale_of_each, pair_bits(static_cast<unsigned>(scale))));
            if (hn::AllFalse(PixelPairInts(), is_it)) { continue; }
            for (std::size_t axis = 0; axis < 3; ++axis) {
                fine_[axis] = hn::IfThenElse(is_it, place_of(rays, scale, axis), fine_[axis]);
            }
        }
    }

    HWY_INLINE hn::Vec<PixelPairInts> place_of(const DetailRays& rays, std::size_t scale, std::size_t axis) const {
        const DetailRays::Scale& of = rays.scales[scale];
        const auto place_m = at_[axis];
        const auto eye = pair_floats(of.eye[static_cast<glm::length_t>(axis)]);
        return hn::ConvertTo(PixelPairInts(), hn::Add(hn::Mul(place_m, pair_floats(of.parts_per_m)), eye));
    }

    hn::Mask<PixelPairs> is_ground_;
    hn::Vec<PixelPairs> depth_;
    PairRays at_;                     ///< metres from the eye, along the pattern's axes
    hn::Vec<PixelPairBits> level_;    ///< as DetailPositions, but for its flag
    hn::Vec<PixelPairs> slant_share_; ///< what is left of the pattern on ground seen at a very low angle, 2^-15
    DetailPositions::Place fine_;
};

// -- The pattern sampled for one row of a tile.

/// Where a level of each pixel's own lies in the pattern.
struct OwnLevel {
    hn::Vec<PixelPairBits> level;

    HWY_INLINE hn::Vec<PixelPairBits> last_texel() const {
        return hn::Shr(pair_bits(scene::DetailPattern::side_texels - 1), level);
    }

    /// A row of the first layer, counted through all levels.
    HWY_INLINE hn::Vec<PixelPairBits> row(hn::Vec<PixelPairBits> in_level) const {
        const auto all_rows = pair_bits(2 * scene::DetailPattern::rows);
        return hn::Add(hn::Sub(all_rows, hn::Shr(all_rows, level)), in_level);
    }

    HWY_INLINE hn::Vec<PixelPairBits> rows(hn::Vec<PixelPairBits> layers) const {
        return hn::Shl(layers, hn::Sub(pair_bits(6), level));
    }
};

/// The finest level for all pixels.
struct FinestLevel {
    HWY_INLINE hn::Vec<PixelPairBits> last_texel() const { return pair_bits(scene::DetailPattern::side_texels - 1); }

    HWY_INLINE hn::Vec<PixelPairBits> row(hn::Vec<PixelPairBits> in_level) const { return in_level; }

    HWY_INLINE hn::Vec<PixelPairBits> rows(hn::Vec<PixelPairBits> layers) const { return hn::ShiftLeft<6>(layers); }
};

/// The first row of the pattern of each pair's land, a scene::DetailPattern::Kind. `ground`: PackedGround.
HWY_INLINE hn::Vec<PixelPairBits> first_rows_of_kinds(hn::Vec<PixelPairBits> ground) {
    static_assert(scene::LandCoverContrast::first_open_mixture == 64 && 2 * scene::DetailPattern::rows == 64 << 7);
    return hn::ShiftLeft<7>(hn::AndNot(ground, pair_bits(64)));
}

/// The pattern at places of a level of each, mixed from eight texels: 2^-15, from -1 to 1. `first_row`:
/// first_rows_of_kinds(). Places are as DetailPositions::fine.
template <class Level>
HWY_INLINE hn::Vec<PixelPairInts> sample_detail_level(const std::uint16_t* texels, hn::Vec<PixelPairBits> first_row,
    const std::array<hn::Vec<PixelPairBits>, 3>& place, const Level& level) {
    const PixelPairBits bits;
    const hn::Repartition<std::uint16_t, PixelPairBits> halves;
    static_assert(scene::DetailPattern::side_texels == 1 << 6 &&
                  scene::DetailPattern::stride == scene::DetailPattern::side_texels + 1);
    const auto last = level.last_texel();
    const auto whole = [&](std::size_t axis) HWY_ATTR { return hn::ShiftRight<8>(place[axis]); };
    const auto column = hn::And(whole(0), last);
    const auto row = hn::Add(first_row, level.row(hn::And(whole(1), last)));
    const auto four_of = [&](hn::Vec<PixelPairBits> layer) HWY_ATTR {
        const auto row_of_layer = hn::Add(row, level.rows(hn::And(layer, last)));
        const auto texel = hn::Add(hn::Add(hn::ShiftLeft<6>(row_of_layer), row_of_layer), column);
        return hn::GatherOffset(
            bits, reinterpret_cast<const std::uint32_t*>(texels), hn::BitCast(PixelPairInts(), hn::Add(texel, texel)));
    };
    const auto near = four_of(whole(2));
    const auto far = four_of(hn::Add(whole(2), pair_bits(1)));
    const auto byte_of_each = pair_bits(0x00ff00ff);
    // Two texels at a time: by layers, then by rows, then both of them.
    const auto part_of = [&](std::size_t axis) HWY_ATTR {
        const auto part = hn::And(place[axis], pair_bits(0xff));
        return hn::BitCast(halves, hn::Or(part, hn::ShiftLeft<16>(part)));
    };
    const auto of_layers = part_of(2);
    const auto between_layers = [&](hn::Vec<PixelPairBits> of_near, hn::Vec<PixelPairBits> of_far) HWY_ATTR {
        const auto first = hn::BitCast(halves, hn::And(of_near, byte_of_each));
        const auto second = hn::BitCast(halves, hn::And(of_far, byte_of_each));
        return hn::Add(hn::ShiftLeft<8>(first), hn::Mul(hn::Sub(second, first), of_layers));
    };
    const auto own = between_layers(near, far);
    const auto beside = between_layers(hn::ShiftRight<8>(near), hn::ShiftRight<8>(far));
    const auto of_rows = hn::ShiftLeft<8>(part_of(1));
    const auto both = hn::BitCast(bits, hn::Add(hn::MulHigh(own, hn::Not(of_rows)), hn::MulHigh(beside, of_rows)));
    const auto left = hn::BitCast(PixelPairInts(), hn::And(both, pair_bits(0xffff)));
    const auto right = hn::BitCast(PixelPairInts(), hn::ShiftRight<16>(both));
    const auto rightwards = hn::BitCast(PixelPairInts(), hn::And(place[0], pair_bits(0xff)));
    const auto mean = hn::Add(left, hn::ShiftRight<8>(hn::Mul(hn::Sub(right, left), rightwards)));
    return hn::Sub(mean, hn::Set(PixelPairInts(), 128 * 256));
}

/// Places of every second pair of a row, and of the one right of the tile.
struct DetailPositionRow {
    using Each = std::array<std::uint32_t, pairs_per_phase + 16>;

    alignas(64) std::array<Each, 5> value; ///< as DetailPositions

    HWY_INLINE DetailPositions places(std::size_t at) const {
        const auto whole = [&](std::size_t which) HWY_ATTR {
            return hn::BitCast(PixelPairInts(), hn::LoadU(PixelPairBits(), &value[which][at]));
        };
        return {{whole(0), whole(1), whole(2)}, hn::LoadU(PixelPairBits(), &value[3][at]),
            hn::LoadU(PixelPairBits(), &value[4][at])};
    }

    HWY_INLINE void put(const DetailPositions& places, std::size_t at) {
        const auto put_one = [&](std::size_t which, auto values) HWY_ATTR {
            hn::StoreU(hn::BitCast(PixelPairBits(), values), PixelPairBits(), &value[which][at]);
        };
        for (std::size_t axis = 0; axis < 3; ++axis) { put_one(axis, places.fine[axis]); }
        put_one(3, places.level);
        put_one(4, places.left);
    }

    /// No ground.
    void clear() {
        for (Each& each : value) { each.fill(0); }
    }
};

/// What pairs of pixels see: in the upper half the pattern at the first one's place, 2^-15, in the lower half what the
/// haze leaves of it, likewise; 0: no ground. Of both scales together: the squares of their shares are about one, so
/// that the contrast stays while one gives way to the other while its levels are gone through. A level differs from the
/// next one by its smallest and faintest features alone: none are mixed. `ground`: PackedGround.
HWY_INLINE hn::Vec<PixelPairBits> sample_detail(
    const std::uint16_t* texels, hn::Vec<PixelPairBits> ground, const DetailPositions& places) {
    const PixelPairBits bits;
    const PixelPairInts whole;
    const auto none = hn::Zero(bits);
    const auto cover = hn::And(ground, pair_bits(PackedGround::cover_bits));
    // Sky, water and whatever the haze hides: their contrast is none.
    if (hn::AllTrue(bits, hn::Or(hn::Eq(places.left, none), hn::Eq(cover, none)))) { return none; }
    const auto share_of = [&](hn::Vec<PixelPairInts> value, hn::Vec<PixelPairInts> share)
                              HWY_ATTR { return hn::ShiftRight<8>(hn::Mul(value, share)); };
    const auto half_texel = pair_bits(128);
    const auto all = hn::Set(whole, 256);
    // Of two patterns, the first of which gives way to the second: the squares of their shares are about one together.
    const auto share_of_first = [&](hn::Vec<PixelPairInts> through)
                                    HWY_ATTR { return hn::Sub(all, share_of(through, through)); };
    static_assert(scene::DetailPattern::levels_per_scale == 2);
    // The nearer one of the levels above and below.
    const auto halves_through = hn::And(hn::ShiftRight<23>(places.level), pair_bits(3));
    const auto level = hn::ShiftRight<1>(hn::Add(halves_through, pair_bits(1)));
    const auto at_level = [&](hn::Vec<PixelPairBits> first_row, hn::Vec<PixelPairBits> of) HWY_ATTR {
        const auto along = [&](std::size_t axis) HWY_ATTR {
            return hn::Sub(hn::Shr(hn::BitCast(bits, places.fine[axis]), of), half_texel);
        };
        return sample_detail_level(texels, first_row, {along(0), along(1), along(2)}, OwnLevel{of});
    };
    const auto on_coarse = [&](std::size_t axis) HWY_ATTR {
        const auto coarse_place = hn::ShiftRight<scene::DetailPattern::levels_per_scale>(places.fine[axis]);
        return hn::Sub(hn::BitCast(bits, coarse_place), half_texel);
    };
    const auto through = hn::BitCast(whole, hn::And(hn::ShiftRight<17>(places.level), pair_bits(0xff)));
    const auto pattern_of = [&](hn::Vec<PixelPairBits> first_row) HWY_ATTR {
        const auto coarse =
            sample_detail_level(texels, first_row, {on_coarse(0), on_coarse(1), on_coarse(2)}, FinestLevel());
        return hn::Add(share_of(at_level(first_row, level), share_of_first(through)),
            share_of(coarse, share_of_first(hn::Sub(all, through))));
    };
    const auto first_rows = first_rows_of_kinds(ground);
    auto both = pattern_of(first_rows);
    static_assert(scene::LandCoverContrast::first_mixed_pattern == 60);
    const auto is_mixed = hn::Eq(hn::And(ground, pair_bits(0x7c)), pair_bits(60));
    if (!hn::AllFalse(bits, is_mixed)) {
        const auto past = hn::BitCast(whole, hn::ShiftLeft<6>(hn::And(ground, pair_bits(3))));
        // Pairs that are not mixed look where they looked before, which is in the caches.
        const auto open = pattern_of(hn::IfThenZeroElse(is_mixed, first_rows));
        const auto mixed =
            hn::Sub(share_of(both, share_of_first(past)), share_of(open, share_of_first(hn::Sub(all, past))));
        both = hn::IfThenElse(hn::RebindMask(whole, is_mixed), mixed, both);
    }
    const auto limited = hn::Min(hn::Max(both, hn::Set(whole, -32768)), hn::Set(whole, 32767));
    const auto seen = hn::Or(hn::ShiftLeft<16>(hn::BitCast(bits, limited)), places.left);
    return hn::IfThenZeroElse(hn::Eq(places.left, hn::Zero(bits)), seen);
}

/// Samples of the detail texture for the pairs of pixels of a row, and for the pair right of the tile.
struct DetailRow {
    alignas(64) std::array<std::uint32_t, pairs_per_row + 16> seen;
};

/// Finds what the pairs of every second row of a tile see, and those of the row below it. Where they look is found by
/// how near the ground is for one pair in four, the first phase of rows of even number; the others look in the middle
/// of these where the ground goes on evenly from one to the other.
class TileDetailSampler {
public:
    HWY_INLINE TileDetailSampler(const TileJob& job, const TileBuffer& buffer, const TileInverseDepths& inverse_depth)
        : job_(job), buffer_(buffer), inverse_depths_(inverse_depth), tile_rays_(*job.detail_texture, job.first_px),
          haze_per_depth_(job.detail_texture->haze_per_m * tile_rays_.length()) {
        for (std::size_t row = 0; row < right_edge_values_.size(); row += pairs_at_once) {
            const InverseDepthQuad near = inverse_depths_.right_of_tile(static_cast<int>(row));
            const DetailSampler look(*job_.detail_texture, tile_rays_, tile_rays_.right_of_tile(2 * row), near);
            const DetailPositions places = look.places(*job_.detail_texture, haze_per_depth_);
            right_edge_.put(places, row);
            std::array<std::uint32_t, pairs_at_once> ground{};
            for (std::size_t i = 0; i < pairs_at_once; ++i) {
                ground[i] = ground_of_row(static_cast<int>(row + i))[pairs_per_row - 1];
            }
            const auto of_pairs = hn::LoadU(PixelPairBits(), ground.data());
            hn::Store(sample_detail(job_.detail_texture->texels, of_pairs, places), PixelPairBits(),
                &right_edge_values_[row]);
        }
    }

    /// Places of a row of even number.
    HWY_NOINLINE void find(int in_tile, DetailPositionRow& detail_texture) const {
        const std::size_t row = right_edge_row(in_tile);
        for (std::size_t which = 0; which < detail_texture.value.size(); ++which) {
            detail_texture.value[which][pairs_per_phase] = right_edge_.value[which][row];
        }
        for (std::size_t i = 0; i < pairs_per_phase; i += pairs_at_once) {
            detail_texture.put(found(in_tile, 0, i), i);
        }
    }

    /// Looks up a row between two of even number; one of these is its own above and below.
    HWY_NOINLINE HWY_FLATTEN void look(
        int row, const DetailPositionRow& above, const DetailPositionRow& below, DetailRow& detail_texture) const {
        const PixelPairBits bits;
        const std::uint16_t* const texels = job_.detail_texture->texels;
        const std::uint32_t* const ground = ground_of_row(row);
        for (std::size_t i = 0; i < pairs_per_phase; i += pairs_at_once) {
            const DetailPositions a = above.places(i);
            const DetailPositions b = above.places(i + 1);
            const auto looked_up = [&](const DetailPositions& even, const DetailPositions& odd) HWY_ATTR {
                hn::Vec<PixelPairBits> even_ground;
                hn::Vec<PixelPairBits> odd_ground;
                hn::LoadInterleaved2(bits, ground + phases * i, even_ground, odd_ground);
                hn::StoreInterleaved2(sample_detail(texels, even_ground, even), sample_detail(texels, odd_ground, odd),
                    bits, &detail_texture.seen[phases * i]);
            };
            if (row % 2 == 0) {
                looked_up(a, interpolated_at({row, 1, i}, std::array{a, b}));
            } else {
                const DetailPositions c = below.places(i);
                looked_up(interpolated_at({row, 0, i}, std::array{a, c}),
                    interpolated_at({row, 1, i}, std::array{a, b, c, below.places(i + 1)}));
            }
        }
        detail_texture.seen[pairs_per_row] = right_edge_values_[right_edge_row(row)];
    }

private:
    /// Pairs from one on.
    struct PairStart {
        int row;
        std::size_t phase;
        std::size_t first;
    };

    std::size_t right_edge_row(int row) const {
        return static_cast<std::size_t>(std::min(row, inverse_depths_.rows() - 1));
    }

    /// PackedGround of the pairs of a row; beyond the last row as in it.
    const std::uint32_t* ground_of_row(int row) const {
        return buffer_.ground_of_row(2 * std::min(row, inverse_depths_.rows() - 1));
    }

    HWY_INLINE DetailPositions found(int row, std::size_t phase, std::size_t first) const {
        const auto direction = tile_rays_.in_row(static_cast<std::size_t>(2 * row), phases * first + phase);
        const DetailSampler look(*job_.detail_texture, tile_rays_, direction, inverse_depths_.at(row, phase, first));
        return look.places(*job_.detail_texture, haze_per_depth_);
    }

    /// Of pairs in the middle of two or four others that are found.
    template <std::size_t count>
    HWY_INLINE DetailPositions interpolated_at(
        const PairStart& from, const std::array<DetailPositions, count>& around) const {
        const PixelPairBits bits;
        const PixelPairInts whole;
        const InterpolatedPairs pairs = inverse_depths_.interpolated_at(from.row, from.phase, from.first);
        const auto is_ground = hn::RebindMask(bits, pairs.is_ground);
        const hn::Vec<PixelPairBits> first = around[0].level;
        auto differs = hn::Zero(bits);
        for (std::size_t i = 1; i < count; ++i) { differs = hn::Or(differs, hn::Xor(first, around[i].level)); }
        differs = hn::And(differs, pair_bits(~0U << DetailPositions::scale_shift | DetailPositions::ground));
        const auto has_none = hn::AndNot(first, pair_bits(DetailPositions::ground));
        const auto is_alike =
            hn::And(hn::RebindMask(bits, pairs.is_linear), hn::Eq(hn::Or(differs, has_none), hn::Zero(bits)));
        const auto mean = [&](auto part_of) HWY_ATTR {
            static_assert(count == 2 || count == 4);
            auto sum = hn::Add(part_of(around[0]), part_of(around[1]));
            if constexpr (count == 4) { sum = hn::Add(sum, hn::Add(part_of(around[2]), part_of(around[3]))); }
            return hn::ShiftRight<count / 2>(sum);
        };
        const auto flag = pair_bits(DetailPositions::ground);
        const auto level = hn::AndNot(flag, mean([](const DetailPositions& of) HWY_ATTR { return of.level; }));
        const auto left = mean([](const DetailPositions& of) HWY_ATTR { return of.left; });
        DetailPositions places{
            around[0].fine, hn::Or(level, hn::And(first, flag)), hn::IfThenElseZero(is_ground, left)};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            places.fine[axis] = mean([axis](const DetailPositions& of) HWY_ATTR { return of.fine[axis]; });
        }
        const auto is_other = hn::AndNot(is_alike, is_ground);
        if (!hn::AllFalse(bits, is_other)) {
            const DetailPositions own = found(from.row, from.phase, from.first);
            const auto is_own = hn::RebindMask(whole, is_other);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                places.fine[axis] = hn::IfThenElse(is_own, own.fine[axis], places.fine[axis]);
            }
            places.level = hn::IfThenElse(is_other, own.level, places.level);
            places.left = hn::IfThenElse(is_other, own.left, places.left);
        }
        return places;
    }

    const TileJob& job_;
    const TileBuffer& buffer_;
    const TileInverseDepths& inverse_depths_;
    TileRays tile_rays_;
    float haze_per_depth_;
    // Of what lies right of the tile, by rows.
    DetailPositionRow right_edge_;
    alignas(64) std::array<std::uint32_t, tile_height / 2> right_edge_values_;
};

// -- Change of colour of each pixel. What its land cover makes of the pattern is looked up where the pattern is
// sampled, at every second pixel of every second row; pixels between these change by the mean of those around them.

/// By how much the parts of the colours of a row of pixels change, 2^-15 of themselves; all 0: no land.
struct ChangeRow {
    alignas(64) std::array<std::array<std::int16_t, tile_width>, 3> part;
};

/// Those of every second pixel: red in the lower half, green in the upper half; blue in the lower half, with a bit
/// that says that land is seen, also where it does not change; without land all are 0.
struct ChangesOfPairs {
    static constexpr unsigned is_land = 2; ///< the mean of two that have it has it, too

    alignas(64) std::array<std::uint32_t, pairs_per_row + 16> red_green;
    alignas(64) std::array<std::uint32_t, pairs_per_row + 16> blue;

    /// `ground`: PackedGround of the row's pairs of pixels. Right of the tile the last pair's land goes on.
    HWY_INLINE ChangesOfPairs(const DetailRow& detail, const std::uint32_t* ground, const std::uint32_t* table) {
        for (std::size_t two = 0; two < pairs_per_row; two += pairs_at_once) {
            put(hn::Load(PixelPairBits(), &detail.seen[two]), hn::LoadU(PixelPairBits(), ground + two), table, two);
        }
        const hn::CappedTag<std::uint32_t, 1> one;
        put(hn::Load(one, &detail.seen[pairs_per_row]), hn::Load(one, ground + pairs_per_row - 1), table,
            pairs_per_row);
    }

private:
    /// `seen`: as sample_detail().
    template <class V>
    HWY_INLINE void put(V seen, V ground, const std::uint32_t* table, std::size_t to) {
        const hn::DFromV<V> bits;
        const hn::RebindToSigned<decltype(bits)> whole;
        const hn::Repartition<std::int16_t, decltype(bits)> halves;
        static_assert(
            scene::LandCoverContrast::pattern_step_count == 64 && scene::LandCoverContrast::mixture_count == 128);
        const auto set = [&](unsigned value) HWY_ATTR { return hn::Set(bits, value); };
        const auto pattern = hn::ShiftRight<26>(hn::Xor(seen, set(0x80000000U))); // from 0 to 63
        const auto kind = hn::ShiftLeft<6>(hn::And(ground, set(PackedGround::cover_bits)));
        const auto entry = hn::GatherIndex(bits, table, hn::BitCast(whole, hn::Or(kind, pattern)));
        const auto low = set(0xffc0);
        const auto red = hn::And(hn::ShiftRight<16>(entry), low);
        const auto green = hn::And(hn::ShiftLeft<10>(entry), set(0xffc00000U));
        // What the haze leaves; none where no ground is seen.
        const auto left = hn::And(seen, set(0x7fff));
        const auto of_both = hn::BitCast(halves, hn::Or(left, hn::ShiftLeft<16>(left)));
        const auto hazy = [&](V contrast) HWY_ATTR {
            return hn::BitCast(bits, hn::MulFixedPoint15(hn::BitCast(halves, contrast), of_both));
        };
        hn::Store(hazy(hn::Or(red, green)), bits, &red_green[to]);
        const auto own_blue = hn::And(hazy(hn::And(hn::ShiftLeft<4>(entry), low)), set(0xffff & ~is_land));
        const auto is_none = hn::Or(hn::Eq(seen, hn::Zero(bits)), hn::Eq(kind, hn::Zero(bits)));
        hn::Store(hn::IfThenZeroElse(is_none, hn::Or(own_blue, set(is_land))), bits, &blue[to]);
    }
};

/// The mean of both; where one of them is none, the other one: beside a tree the ground goes on. `is_one_none`: of each
/// lane.
template <class Tag>
HWY_INLINE hn::Vec<Tag> mean_of(Tag tag, hn::Vec<Tag> one, hn::Vec<Tag> other, hn::Mask<Tag> is_one_none) {
    const PixelPairHalves halves;
    const auto half = [&](hn::Vec<Tag> of) HWY_ATTR { return hn::ShiftRight<1>(hn::BitCast(halves, of)); };
    const auto mean = hn::Add(half(one), half(other));
    return hn::IfThenElse(is_one_none, hn::BitCast(tag, hn::Add(mean, mean)), hn::BitCast(tag, mean));
}

/// All pixels of a row of pairs.
HWY_INLINE void put_row(const ChangesOfPairs& pairs, ChangeRow& row) {
    const PixelPairBits bits;
    const PixelPairHalves halves;
    const auto low = pair_bits(0xffff);
    for (std::size_t two = 0; two < pairs_per_row; two += pairs_at_once) {
        const auto both = hn::Load(bits, &pairs.red_green[two]);
        const auto blue = hn::Load(bits, &pairs.blue[two]);
        const auto next_both = hn::LoadU(bits, &pairs.red_green[two + 1]);
        const auto next_blue = hn::LoadU(bits, &pairs.blue[two + 1]);
        const auto none = hn::Zero(bits);
        const auto is_one_none = hn::Or(hn::Eq(blue, none), hn::Eq(next_blue, none));
        const auto both_between = mean_of(bits, both, next_both, is_one_none);
        const auto blue_between = mean_of(bits, blue, next_blue, is_one_none);
        const auto put = [&](std::size_t k, hn::Vec<PixelPairBits> first, hn::Vec<PixelPairBits> second) HWY_ATTR {
            hn::Store(hn::BitCast(halves, hn::Or(first, second)), halves, &row.part[k][2 * two]);
        };
        put(0, hn::And(both, low), hn::ShiftLeft<16>(both_between));
        put(1, hn::ShiftRight<16>(both), hn::AndNot(low, both_between));
        put(2, blue, hn::ShiftLeft<16>(blue_between));
    }
}

// -- The whole tile.

/// Changes of the parts of pixels' colours.
using Changes = std::array<hn::Vec<PixelPairHalves>, 3>;

/// No land: the last part has ChangesOfPairs::is_land.
HWY_INLINE hn::Mask<PixelPairHalves> is_none(const Changes& of) { return hn::Eq(of[2], hn::Zero(PixelPairHalves())); }

/// Changes colours of a row of pixels of a tile. `changes_of(x)`: of the pixels from one on.
template <class ChangesOf>
HWY_INLINE void change_row(const ChangesOf& changes_of, int row, TileBuffer& buffer) {
    const PixelPairHalves halves;
    const hn::RebindToUnsigned<PixelPairHalves> values;
    const auto white = hn::Set(values, std::uint16_t{255 * 256});
    const auto middle = hn::Set(values, std::uint16_t{0x8000});
    const auto all = hn::Set(values, std::uint16_t{16});
    const bool is_full = (buffer.full_rows >> row & 1U) != 0;
    for (std::size_t x = 0; x < tile_width; x += 2 * pairs_at_once) {
        Changes change = changes_of(x);
        const auto is_kept = is_none(change);
        if (hn::AllTrue(halves, is_kept)) { continue; }
        change[2] = hn::AndNot(hn::Set(halves, std::int16_t{ChangesOfPairs::is_land}), change[2]);
        const std::size_t at = static_cast<std::size_t>(row) * tile_width + x;
        // Where other things than ground cover some samples, only the ground's share changes.
        const auto other_than_ground = hn::LoadU(values, buffer.sums[3].data() + at);
        if (!is_full || !hn::AllTrue(values, hn::Eq(other_than_ground, hn::Zero(values)))) {
            const auto covered = hn::LoadU(values, buffer.covered.data() + at);
            const auto count = hn::Sub(hn::PopulationCount(covered), other_than_ground);
            const auto share = hn::BitCast(halves, hn::Min(hn::ShiftLeft<11>(count), hn::Set(values, 0x7fff)));
            for (auto& part : change) {
                part =
                    hn::IfThenElse(hn::RebindMask(halves, hn::Eq(count, all)), part, hn::MulFixedPoint15(part, share));
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t* const sums = buffer.sums[k].data() + at;
            const auto factor = hn::Xor(hn::BitCast(values, change[k]), middle);
            const auto before = hn::LoadU(values, sums);
            const auto half = hn::MulHigh(before, factor);
            // Twice the half is a bit less exact: what is skipped alone is not changed beside others either.
            const auto after = hn::Min(hn::SaturatedAdd(half, half), white);
            hn::StoreU(hn::IfThenElse(hn::RebindMask(values, is_kept), before, after), values, sums);
        }
    }
}

/// Changes rows of pixels by what pairs in rows one after the other see.
class DetailApplier {
public:
    HWY_INLINE DetailApplier(const TileJob& job, const TileInverseDepths& inverse_depth, TileBuffer& buffer)
        : job_(job), inverse_depths_(inverse_depth), buffer_(buffer) {}

    /// The pixels between a row of pairs and the one above it, which the call before was for, and its own.
    HWY_NOINLINE void change(int row, const DetailRow& seen) {
        const bool is_seen = inverse_depths_.has_ground(row);
        const bool is_above_seen = row > 0 && inverse_depths_.has_ground(row - 1);
        const ChangeRow& above = rows_[static_cast<std::size_t>(row + 1) % 2];
        ChangeRow& own = rows_[static_cast<std::size_t>(row) % 2];
        if (is_seen) {
            // Below the tile the land of its last row goes on.
            const int of_ground = 2 * std::min(row, inverse_depths_.rows() - 1);
            put_row(ChangesOfPairs(seen, buffer_.ground_of_row(of_ground), job_.detail_texture->contrast), own);
        }
        const auto in_row = [](const ChangeRow& from) HWY_ATTR {
            return [&from](std::size_t x) HWY_ATTR {
                const auto part = [&](std::size_t k) HWY_ATTR { return hn::Load(PixelPairHalves(), &from.part[k][x]); };
                return Changes{part(0), part(1), part(2)};
            };
        };
        if (is_seen && is_above_seen) {
            const auto between = [&](std::size_t x) HWY_ATTR {
                const Changes one = in_row(above)(x);
                const Changes other = in_row(own)(x);
                const auto is_one_none = hn::Or(is_none(one), is_none(other));
                const auto part = [&](std::size_t k)
                                      HWY_ATTR { return mean_of(PixelPairHalves(), one[k], other[k], is_one_none); };
                return Changes{part(0), part(1), part(2)};
            };
            change_row(between, 2 * row - 1, buffer_);
        } else if (row > 0 && (is_seen || is_above_seen)) {
            change_row(in_row(is_seen ? own : above), 2 * row - 1, buffer_);
        }
        if (is_seen && 2 * row < job_.size_px.y) { change_row(in_row(own), 2 * row, buffer_); }
    }

private:
    const TileJob& job_;
    const TileInverseDepths& inverse_depths_;
    TileBuffer& buffer_;
    std::array<ChangeRow, 2> rows_;
};

/// Changes the summed colours of a tile by the detail texture, after its triangles are painted.
HWY_NOINLINE void add_detail_texture(const TileJob& job, TileBuffer& buffer) {
    const TileInverseDepths inverse_depth(job, buffer);
    if (!inverse_depth.has_ground()) { return; }
    const TileDetailSampler look(job, buffer, inverse_depth);
    std::array<DetailPositionRow, 2> places;
    std::array<DetailRow, tile_height / 2 + 1> seen;
    DetailPositionRow* above = &places[0];
    DetailPositionRow* below = &places[1];
    const int last = job.size_px.y / 2;
    const auto look_up = [&](int row) HWY_ATTR {
        if (inverse_depth.has_ground(row)) {
            look.look(row, *above, row % 2 == 0 ? *above : *below, seen[static_cast<std::size_t>(row)]);
        }
    };
    // Places are written a while before they are read.
    for (int row = 0; row < last + 2; row += 2) {
        if (row <= last && inverse_depth.has_ground(row)) {
            look.find(row, *below);
        } else {
            below->clear();
        }
        if (row > 0) {
            look_up(row - 2);
            look_up(row - 1);
        }
        std::swap(above, below);
    }
    if (last % 2 == 0) { look_up(last); }
    DetailApplier walk(job, inverse_depth, buffer);
    for (int row = 0; row <= last; ++row) { walk.change(row, seen[static_cast<std::size_t>(row)]); }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
