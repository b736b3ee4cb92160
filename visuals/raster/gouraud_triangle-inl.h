// Gouraud-shaded triangles, nearly all of a picture: masks and colours of whole strips are added straight to the sums
// of the tile. In this order: inverse depth and land cover for the detail texture; two rows of a narrow triangle in
// one register, with the same result as row by row; strips of one row; specks. Included once for each instruction set.
#if defined(OCTANT_RASTER_GOURAUD_TRIANGLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_GOURAUD_TRIANGLE_INL
#undef OCTANT_RASTER_GOURAUD_TRIANGLE_INL
#else
#define OCTANT_RASTER_GOURAUD_TRIANGLE_INL
#endif

#include "visuals/raster/strip_coverage-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// -- What a triangle of ground leaves for the detail texture: at every second pixel of every second row that it newly
// covers, inverse depth and land cover.

/// How a Gouraud triangle is painted.
enum class PaintAs : std::uint8_t {
    Plain,          ///< a picture without a detail texture
    Ground,         ///< ground that shows it
    OtherThanGround ///< other triangles of a picture with a detail texture: their samples are counted
};

/// The ground of a triangle at pixels from a column of the tile on, as many as a register of `Tag` has:
/// TileBuffer::ground.
template <class Tag>
class GroundOfColumns {
public:
    HWY_INLINE GroundOfColumns(const Triangle& triangle, const TileJob& job, int column)
        : plane_(triangle.inverse_depth), first_row_(job.first_px.y - triangle.first_row), column_(column),
          is_even_(hn::Set(Bits(), 0xffffU << (16 * (column & 1)))) {
        const int first = job.first_px.x + column + (column & 1);
        const auto two_each = hn::Add(lane_indices_from(Real(), 0), lane_indices_from(Real(), 0));
        const auto columns = hn::Add(hn::Set(Real(), static_cast<float>(first - triangle.left)), two_each);
        steps_ = hn::Mul(columns, hn::Set(Real(), plane_.per_x));
        const auto twice = hn::Add(lane_indices_from(Whole(), 0), lane_indices_from(Whole(), 0));
        cover_steps_ = hn::Mul(twice, hn::Set(Whole(), triangle.gradients.per_x[3]));
        const glm::ivec2 at(first, job.first_px.y);
        first_cover_ = PackedGround::first_cover(triangle.gradients, at);
        cover_per_row_ = static_cast<std::uint32_t>(triangle.gradients.per_y[3]);
        min_cover_ = hn::Set(Whole(), PackedGround::limit(triangle.gradients.min[3]));
        max_cover_ = hn::Set(Whole(), PackedGround::limit(triangle.gradients.max[3]));
    }

    /// Writes it for those in even columns of an even row of the tile where PackedGround::sample is fresh, or any
    /// sample and none is written yet.
    HWY_INLINE void put(int row, hn::Vec<Tag> fresh, TileBuffer& buffer) const {
        const Real real;
        const Bits bits;
        const float in_row = plane_.first + plane_.per_y * static_cast<float>(first_row_ + row);
        const auto raw = hn::Add(hn::Set(real, in_row), steps_);
        const auto near = hn::Min(hn::Max(raw, hn::Set(real, plane_.min)), hn::Set(real, plane_.max));
        const auto cover_in_row =
            static_cast<std::int32_t>(first_cover_ + cover_per_row_ * static_cast<std::uint32_t>(row));
        const auto raw_cover = hn::Add(hn::Set(Whole(), cover_in_row), cover_steps_);
        const auto cover = hn::BitCast(bits, hn::Min(hn::Max(raw_cover, min_cover_), max_cover_));
        const auto both = hn::Or(hn::AndNot(hn::Set(bits, PackedGround::cover_bits), hn::BitCast(bits, near)),
            hn::ShiftRight<PackedGround::cover_shift>(cover));
        std::uint32_t* const to = buffer.ground_of_row(row) + (column_ + 1) / 2;
        const auto before = hn::LoadU(bits, to);
        const auto any_if_none = hn::VecFromMask(bits, hn::Eq(before, hn::Zero(bits)));
        const auto wanted = hn::And(is_even_, hn::Or(any_if_none, hn::Set(bits, PackedGround::sample * 0x10001U)));
        const auto is_kept = hn::Eq(hn::And(hn::BitCast(bits, fresh), wanted), hn::Zero(bits));
        hn::StoreU(hn::IfThenElse(is_kept, before, both), bits, to);
    }

private:
    using Bits = hn::Repartition<std::uint32_t, Tag>;
    using Real = hn::RebindToFloat<Bits>;
    using Whole = hn::RebindToSigned<Bits>;

    const InverseDepthPlane& plane_;
    int first_row_; ///< of the tile, counted from the triangle's
    int column_;
    hn::Vec<Bits> is_even_;      ///< the columns, in pairs of pixels
    hn::Vec<Real> steps_;        ///< from the triangle's first column
    hn::Vec<Whole> cover_steps_; ///< from the first even column
    hn::Vec<Whole> min_cover_;
    hn::Vec<Whole> max_cover_;
    std::uint32_t first_cover_; ///< of the first even column, in the tile's first row
    std::uint32_t cover_per_row_;
};

/// Writes it for those of a row's pixels that lie in even columns and rows of the tile, as GroundOfColumns::put(). The
/// row begins at a column and row of the tile.
template <class Tag>
HWY_INLINE void put_ground(Tag /*pixels*/, const Triangle& triangle, const TileJob& job, const glm::ivec2& at,
    hn::Vec<Tag> fresh, TileBuffer& buffer) {
    if (at.y % 2 == 0) { GroundOfColumns<Tag>(triangle, job, at.x).put(at.y, fresh, buffer); }
}

/// Counts samples that show no ground with a detail texture.
template <class Tag>
HWY_INLINE void count_other_than_ground(Tag pixels, std::size_t pixel, hn::Vec<Tag> counts, TileBuffer& buffer) {
    std::uint16_t* const other_than_ground = buffer.sums[3].data() + pixel;
    hn::StoreU(hn::Add(hn::LoadU(pixels, other_than_ground), counts), pixels, other_than_ground);
}

// -- A window of 32 pixels: sixteen columns of a row and the same number of the next row.

constexpr int window_px = strip_px / 2;
constexpr bool has_pairs_of_rows = strip_parts == 1;

/// For each sample of two rows, in turn: sixteen bits.
using PairLanes = hn::Repartition<std::int16_t, Lanes>;
using PairBits = hn::RebindToUnsigned<PairLanes>;
using RowLanes = hn::Half<Strip>;

/// Sixteen columns of a row and of the next one.
struct PairWindow {
    int left;              ///< column of the tile
    int row;               ///< of the tile, the first one
    std::uint32_t columns; ///< which of them count, those of the next row in the upper half

    /// From the first column of a box that has no more of them.
    HWY_INLINE PairWindow(const TileBox& box, int upper_row) : left(box.left), row(upper_row) {
        const std::uint32_t of_row = box.columns_of_strip(left);
        columns = upper_row < box.last_row ? of_row * 0x10001U : of_row;
    }

    std::size_t pixel(int which) const { return static_cast<std::size_t>((row + which) * tile_width + left); }

    /// Whether a pixel of it is not covered whole.
    bool has_free(const std::uint64_t* full) const {
        return (((columns & 0xffffU) & ~(full[0] >> left)) | ((columns >> 16U) & ~(full[1] >> left))) != 0;
    }

    HWY_INLINE hn::Vec<Strip> load(const std::uint16_t* from) const {
        return hn::Combine(Strip(), hn::LoadU(RowLanes(), from + pixel(1)), hn::LoadU(RowLanes(), from + pixel(0)));
    }

    /// The first row's before the next one's: what lies beyond the end of a row is as it was.
    HWY_INLINE void store(hn::Vec<Strip> values, std::uint16_t* to) const {
        hn::StoreU(hn::LowerHalf(RowLanes(), values), RowLanes(), to + pixel(0));
        hn::StoreU(hn::UpperHalf(RowLanes(), values), RowLanes(), to + pixel(1));
    }
};

// -- Two rows of a triangle at once, where a register holds 32 pixels. Each row's window begins at the triangle's left
// edge. The result is the same as row by row.

/// The samples of a triangle, two rows at a time; as StripCoverage.
class PairCoverage {
public:
    HWY_INLINE PairCoverage(const Triangle& triangle, const TileJob& job, const TileBox& box, const SampleLanes& lanes)
        : PairCoverage(triangle, job.first_px + glm::ivec2(box.left, box.first_row), lanes) {}

    HWY_INLINE hn::Vec<Strip> samples(const PairWindow& window) const {
        const PairBits bits;
        const auto is_before = [&](hn::Vec<PairLanes> y) HWY_ATTR { return hn::Lt(y_, y); };
        const auto columns = [&](const StripEdge& edge) HWY_ATTR { return columns_of(edge); };
        const auto bent = pixels_from(hn::IfThenElse(is_before(middle_), columns(upper_), columns(lower_)));
        const auto whole = pixels_from(columns(whole_));
        const auto bends_left = hn::Set(bits, bends_left_ ? std::uint16_t{0xffff} : std::uint16_t{0});
        const auto between = hn::And(hn::Xor(bent, whole), hn::Xor(whole, hn::And(bends_left, hn::Xor(bent, whole))));
        const auto in_height = hn::RebindMask(bits, hn::AndNot(is_before(top_), is_before(bottom_)));
        const auto counting = hn::BitCast(bits, hn::Set(LaneBits(), window.columns));
        const auto masks = hn::IfThenElseZero(in_height, hn::And(between, counting));
        return samples_of_pixels(LaneMasks{hn::BitCast(LaneBits(), masks)})[0];
    }

    HWY_INLINE void next_rows() {
        for (StripEdge* edge : {&whole_, &upper_, &lower_}) { edge->x += 2 * edge->slope; }
        y_ = hn::Add(y_, hn::Set(PairLanes(), 512));
    }

private:
    HWY_INLINE
    PairCoverage(const Triangle& triangle, const glm::ivec2& first_px, const SampleLanes& lanes)
        : down_(load_lanes(lanes.down.data())), round_up_(load_lanes(lanes.round_up.data())),
          whole_(triangle.whole, triangle.top, first_px, down_, round_up_),
          upper_(triangle.upper, triangle.top, first_px, down_, round_up_),
          lower_(triangle.lower, triangle.middle, first_px, down_, round_up_), bends_left_(triangle.middle_is_left),
          top_(place(triangle.top - first_px.y * 256)), middle_(place(triangle.middle - first_px.y * 256)),
          bottom_(place(triangle.bottom - first_px.y * 256)) {
        const auto first = hn::BitCast(LaneBits(), hn::ShiftLeft<3>(down_[0]));
        const auto second = hn::Add(first, hn::Set(LaneBits(), 256U));
        y_ = hn::BitCast(PairLanes(), in_turn(first, hn::ShiftLeft<16>(second)));
    }

    /// A row's place from the first, 1/256 pixel; what is far away stays beyond a tile.
    static HWY_INLINE hn::Vec<PairLanes> place(std::int32_t y) {
        return hn::Set(PairLanes(), static_cast<std::int16_t>(std::clamp(y, -16000, 16000)));
    }

    /// The lower halves of the first and the upper ones of the second.
    static HWY_INLINE hn::Vec<LaneBits> in_turn(hn::Vec<LaneBits> low, hn::Vec<LaneBits> high) {
        const auto lower_half = hn::Set(LaneBits(), 0xffffU);
        return hn::Or(hn::And(low, lower_half), hn::AndNot(lower_half, high));
    }

    /// StripEdge::column() of both rows.
    static HWY_INLINE hn::Vec<PairLanes> columns_of(const StripEdge& edge) {
        const auto at = [&](std::uint64_t x) HWY_ATTR {
            const auto middle = hn::Set(Lanes(), static_cast<std::int32_t>(x >> 16));
            return hn::BitCast(LaneBits(), hn::Add(middle, edge.offsets[0]));
        };
        return hn::BitCast(PairLanes(), in_turn(hn::ShiftRight<16>(at(edge.x)), at(edge.x + edge.slope)));
    }

    /// The row's pixels from a column on.
    static HWY_INLINE hn::Vec<PairBits> pixels_from(hn::Vec<PairLanes> column) {
        const PairBits bits;
        const auto from = hn::BitCast(bits, hn::Max(column, hn::Zero(PairLanes())));
        return hn::Shl(hn::Set(bits, 0xffff), from); // nothing is left where it is 16 or more
    }

    LaneValues down_;
    LaneValues round_up_;
    hn::Vec<PairLanes> y_; ///< of the samples, from the first row's middle, 1/256 pixel
    StripEdge whole_;      ///< from the tile's first column
    StripEdge upper_;
    StripEdge lower_;
    bool bends_left_;
    hn::Vec<PairLanes> top_; ///< as y_
    hn::Vec<PairLanes> middle_;
    hn::Vec<PairLanes> bottom_;
};

/// A level over two rows, as StripGradient.
struct PairGradient {
    std::uint32_t at; ///< of the upper row's first column in the box, 2^-16 level
    std::uint32_t per_row;
    hn::Vec<StripSigned> min;
    hn::Vec<StripSigned> max;
    hn::Vec<StripSigned> steps;

    HWY_INLINE
    PairGradient(const ColourGradients& gradients, std::size_t k, const TileJob& job, const TileBox& box)
        : at(first_level(gradients, k, job.first_px + glm::ivec2(box.left, box.first_row))),
          per_row(static_cast<std::uint32_t>(gradients.per_y[k])), min(hn::Set(StripSigned(), gradients.min[k])),
          max(hn::Set(StripSigned(), gradients.max[k])) {
        const StripSigned sign;
        const auto columns = hn::And(lane_indices_from(sign, 0), hn::Set(sign, window_px - 1));
        steps = hn::Mul(columns, hn::Set(sign, gradients.per_column[k]));
    }

    /// 1/128 level from the level 128.
    HWY_INLINE hn::Vec<StripSigned> level() const {
        const hn::Half<StripSigned> row;
        const auto first = [&](std::uint32_t of_row) HWY_ATTR {
            return hn::Set(row, static_cast<std::int16_t>(static_cast<std::int32_t>(of_row) >> 9));
        };
        const auto both = hn::Combine(StripSigned(), first(at + per_row), first(at));
        return hn::Min(hn::Max(hn::Add(both, steps), min), max);
    }

    HWY_INLINE void next_rows() { at += 2 * per_row; }
};

/// The levels of a triangle over two rows.
HWY_INLINE std::array<PairGradient, 3> pair_gradients(
    const ColourGradients& gradients, const TileJob& job, const TileBox& box) {
    const auto level = [&](std::size_t k) HWY_ATTR { return PairGradient(gradients, k, job, box); };
    return {level(0), level(1), level(2)};
}

/// The ground in the columns of a box that is as narrow as a window.
template <PaintAs kind>
HWY_INLINE auto ground_of_box(const Triangle& triangle, const TileJob& job, const TileBox& box) {
    if constexpr (kind == PaintAs::Ground) {
        return GroundOfColumns<RowLanes>(triangle, job, box.left);
    } else {
        return 0;
    }
}

/// Covers what is free of a triangle whose box is as narrow as a window, and calls paint(window, fresh samples of its
/// pixels) for all its windows and next_rows() after two rows.
template <class Paint, class NextRows>
HWY_INLINE void paint_in_pairs(PairCoverage& coverage, const TileJob& job, const TileBox& box, TileBuffer& buffer,
    const Paint& paint, const NextRows& next_rows) {
    const std::uint64_t full_row = job.full_row();
    for (int row = box.first_row; row <= box.last_row; row += 2) {
        std::uint64_t* const full = buffer.full.data() + row;
        const PairWindow window(box, row);
        if (window.has_free(full)) {
            const auto masks = coverage.samples(window);
            const auto before = window.load(buffer.covered.data());
            const auto after = hn::Or(before, masks);
            window.store(after, buffer.covered.data());
            paint(window, hn::AndNot(before, masks));
            const std::uint32_t bits = full_bits(StripValues{after});
            full[0] |= std::uint64_t{bits & 0xffffU} << window.left;
            full[1] |= std::uint64_t{bits >> 16U} << window.left;
        }
        const std::uint64_t is_full =
            std::uint64_t{(full[0] & full_row) == full_row} | std::uint64_t{(full[1] & full_row) == full_row} << 1U;
        buffer.full_rows |= static_cast<std::uint32_t>(is_full << row);
        coverage.next_rows();
        next_rows();
    }
}

/// Paints a Gouraud triangle that is as narrow as a window; of ground its box begins in an even row and column.
template <PaintAs kind>
HWY_INLINE void paint_gouraud_in_pairs(
    const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, const TileBox& box, TileBuffer& buffer) {
    PairCoverage coverage(triangle, job, box, lanes);
    auto gradients = pair_gradients(triangle.gradients, job, box);
    [[maybe_unused]] const auto ground = ground_of_box<kind>(triangle, job, box);
    const auto paint = [&](const PairWindow& window, hn::Vec<Strip> fresh) HWY_ATTR {
        const auto counts = hn::PopulationCount(fresh);
        for (std::size_t k = 0; k < gradients.size(); ++k) {
            std::uint16_t* const sums = buffer.sums[k].data();
            const auto colour = from_level(gradients[k].level());
            window.store(hn::Add(window.load(sums), hn::Mul(colour, counts)), sums);
        }
        if constexpr (kind == PaintAs::Ground) {
            ground.put(window.row, hn::LowerHalf(RowLanes(), fresh), buffer);
        } else if constexpr (kind == PaintAs::OtherThanGround) {
            std::uint16_t* const other_than_ground = buffer.sums[3].data();
            window.store(hn::Add(window.load(other_than_ground), counts), other_than_ground);
        }
    };
    paint_in_pairs(coverage, job, box, buffer, paint, [&]() HWY_ATTR {
        for (PairGradient& level : gradients) { level.next_rows(); }
    });
}

// -- One row at once: masks and colours of 32 pixels, with as few branches as possible, because most triangles are
// small and a mispredicted branch costs more than the arithmetic.

/// The ground in the parts of a strip that begins at a column of the tile.
template <PaintAs kind, std::size_t parts>
HWY_INLINE auto ground_of_parts(const Triangle& triangle, const TileJob& job, int left) {
    if constexpr (kind == PaintAs::Ground) {
        return [&]<std::size_t... part>(std::index_sequence<part...>) HWY_ATTR {
            return std::array{GroundOfColumns<Strip>(triangle, job, left + static_cast<int>(part * part_px))...};
        }
        (std::make_index_sequence<parts>());
    } else {
        return 0;
    }
}

/// Paints the strip of a triangle that begins at a column of the tile, or as many parts of it as have columns.
template <PaintAs kind, std::size_t parts>
HWY_INLINE void paint_strip(const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, const TileBox& box,
    int left, TileBuffer& buffer) {
    const glm::ivec2 box_px = job.first_px + glm::ivec2(box.left, box.first_row);
    auto gradients = strip_gradients(triangle.gradients, box_px, left - box.left);
    [[maybe_unused]] const auto ground = ground_of_parts<kind, parts>(triangle, job, left);
    using Values = PartValues<parts>;
    const auto paint = [&](int row, const Values& fresh) HWY_ATTR __attribute__((always_inline)) {
        for (std::size_t i = 0; i < parts; ++i) {
            const auto at = static_cast<std::size_t>(row * tile_width + left) + i * part_px;
            const auto counts = hn::PopulationCount(fresh[i]);
            for (std::size_t k = 0; k < gradients.size(); ++k) {
                std::uint16_t* const sums = buffer.sums[k].data() + at;
                const auto colour = gradients[k].colour(i);
                const auto sum = hn::Add(hn::LoadU(Strip(), sums), hn::Mul(colour, counts));
                hn::StoreU(sum, Strip(), sums);
            }
            if constexpr (kind == PaintAs::Ground) {
                if (row % 2 == 0) { ground[i].put(row, fresh[i], buffer); }
            } else if constexpr (kind == PaintAs::OtherThanGround) {
                count_other_than_ground(Strip(), at, counts, buffer);
            }
        }
    };
    walk_strip<parts>(triangle, job, lanes, box, left, buffer, paint, [&]() HWY_ATTR {
        for (StripGradient& level : gradients) { level.at += level.per_row; }
    });
}

// -- Specks: triangles that are no wider than two pixels, pixel by pixel, with the same result as by strips.

constexpr int speck_px = 2;

/// The colours of a triangle's pixels, as StripGradient.
class SpeckColours {
public:
    HWY_INLINE SpeckColours(const ColourGradients& gradients, const glm::ivec2& first_px) {
        const auto across = hn::Mul(hn::Load(Four(), gradients.per_x.data()), hn::Set(Four(), first_px.x));
        per_row_ = hn::Load(Four(), gradients.per_y.data());
        const auto base = hn::Add(hn::Load(Four(), gradients.base.data()), hn::Set(Four(), 256));
        at_ = hn::Add(hn::Add(base, across), hn::Mul(per_row_, hn::Set(Four(), first_px.y)));
        const auto widened = [](const std::array<std::int16_t, 4>& of)
                                 HWY_ATTR { return hn::PromoteTo(Four(), hn::LoadU(Short(), of.data())); };
        per_column_ = widened(gradients.per_column);
        min_ = widened(gradients.min);
        max_ = widened(gradients.max);
    }

    /// Adds the colour of a pixel of the row at hand for so many samples.
    template <int column>
    HWY_INLINE void add(int samples, std::size_t pixel, TileBuffer& buffer) const {
        const auto steps = hn::Mul(per_column_, hn::Set(Four(), column));
        const auto wrapped = hn::ShiftRight<16>(hn::ShiftLeft<16>(hn::Add(hn::ShiftRight<9>(at_), steps)));
        const auto level = hn::Min(hn::Max(wrapped, min_), max_);
        const auto colour = hn::ShiftRight<3>(hn::Add(level, hn::Set(Four(), 128 * 128 + 4)));
        alignas(16) std::array<std::int32_t, 4> sums;
        hn::Store(hn::Mul(colour, hn::Set(Four(), samples)), Four(), sums.data());
        for (std::size_t k = 0; k < 3; ++k) {
            buffer.sums[k][pixel] = static_cast<std::uint16_t>(buffer.sums[k][pixel] + sums[k]);
        }
    }

    HWY_INLINE void next_row() { at_ = hn::Add(at_, per_row_); }

private:
    using Four = hn::FixedTag<std::int32_t, 4>;
    using Short = hn::FixedTag<std::int16_t, 4>;

    hn::Vec<Four> at_; ///< in the row's first pixel, 2^-16 level
    hn::Vec<Four> per_row_;
    hn::Vec<Four> per_column_; ///< 1/128 level
    hn::Vec<Four> min_;
    hn::Vec<Four> max_;
};

/// Covers what is free of a triangle whose box is no wider than a speck. Calls paint(column of the box, a constant;
/// row, number of the pixel, fresh samples, perhaps none) and next_row() after each row.
template <class Paint, class NextRow>
HWY_INLINE void walk_speck(const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, const TileBox& box,
    TileBuffer& buffer, const Paint& paint, const NextRow& next_row) {
    const glm::ivec2 first_px = job.first_px + glm::ivec2(box.left, box.first_row);
    const std::uint64_t full_row = job.full_row();
    StripCoverage coverage(triangle, first_px, box.columns_of_strip(box.left), lanes);
    for (int row = box.first_row; row <= box.last_row; ++row) {
        std::uint64_t& full = buffer.full[static_cast<std::size_t>(row)];
        const LaneMasks masks = coverage.lanes();
        const auto cover_pixel = [&](auto column) HWY_ATTR {
            constexpr int right = decltype(column)::value;
            const auto pixel = static_cast<std::size_t>(row * tile_width + box.left + right);
            const std::uint32_t before = buffer.covered[pixel];
            const std::uint32_t fresh = StripCoverage::samples_of<right>(masks) & ~before;
            buffer.covered[pixel] = static_cast<std::uint16_t>(before | fresh);
            full |= std::uint64_t{(before | fresh) == 0xffffU} << (box.left + right);
            paint(column, row, pixel, fresh);
        };
        cover_pixel(std::integral_constant<int, 0>());
        if (box.right > box.left) { cover_pixel(std::integral_constant<int, 1>()); }
        buffer.full_rows |= std::uint32_t{(full & full_row) == full_row} << row;
        coverage.next_row();
        next_row();
    }
}

/// Paints a triangle whose box is no wider than a speck.
template <PaintAs kind>
HWY_INLINE void paint_speck(
    const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, const TileBox& box, TileBuffer& buffer) {
    SpeckColours colours(triangle.gradients, job.first_px + glm::ivec2(box.left, box.first_row));
    const auto paint = [&](auto column, int row, std::size_t pixel, std::uint32_t fresh) HWY_ATTR {
        constexpr int right = decltype(column)::value;
        colours.template add<right>(std::popcount(fresh), pixel, buffer);
        if constexpr (kind == PaintAs::OtherThanGround) {
            std::uint16_t& other = buffer.sums[3][pixel];
            other = static_cast<std::uint16_t>(other + std::popcount(fresh));
        } else if constexpr (kind == PaintAs::Ground && right == 0) { // which is even
            if (row % 2 == 0 && fresh != 0) {
                const glm::ivec2 at = job.first_px + glm::ivec2(box.left, row);
                std::uint32_t& ground = buffer.ground_of_row(row)[box.left / 2];
                if (ground == 0 || (fresh & PackedGround::sample) != 0) { ground = ground_at(triangle, at.x, at.y); }
            }
        }
    };
    walk_speck(triangle, job, lanes, box, buffer, paint, [&]() HWY_ATTR { colours.next_row(); });
}

/// An edge in a strip where a pixel's only sample is its middle.
struct MiddleEdge {
    std::uint64_t x; ///< as StripEdge
    std::uint64_t slope;

    HWY_INLINE MiddleEdge(const Edge& edge, std::int32_t top, const glm::ivec2& first_px)
        : x(edge_x(edge, top, first_px)), slope(static_cast<std::uint64_t>(edge.slope)) {}

    /// The strip's pixels from the first on whose middle is not left of the edge.
    HWY_INLINE std::uint32_t pixels_from() const {
        const auto column = (static_cast<std::int32_t>(x >> 16) + 0xffff) >> 16;
        return static_cast<std::uint32_t>(~std::uint64_t{0} << std::clamp(column, 0, strip_px));
    }
};

/// paint_strip() where all lanes of a pixel share its middle: a triangle covers a pixel or does not.
template <PaintAs kind>
HWY_INLINE void paint_strip_of_middles(
    const Triangle& triangle, const TileJob& job, const TileBox& box, int left, TileBuffer& buffer) {
    const std::uint32_t columns = box.columns_of_strip(left);
    const std::uint64_t full_row = job.full_row();
    const glm::ivec2 first_px = job.first_px + glm::ivec2(left, box.first_row);
    const glm::ivec2 box_px = job.first_px + glm::ivec2(box.left, box.first_row);
    MiddleEdge whole(triangle.whole, triangle.top, first_px);
    MiddleEdge upper(triangle.upper, triangle.top, first_px);
    MiddleEdge lower(triangle.lower, triangle.middle, first_px);
    const std::uint32_t bends_left = triangle.middle_is_left ? ~0U : 0U;
    const int first_lower = first_row_of(triangle.middle) - job.first_px.y;
    auto gradients = strip_gradients(triangle.gradients, box_px, left - box.left);
    auto pixel = static_cast<std::size_t>(box.first_row * tile_width + left);
    for (int row = box.first_row; row <= box.last_row; ++row, pixel += tile_width) {
        std::uint64_t& full = buffer.full[static_cast<std::size_t>(row)];
        const std::uint32_t bent = (row < first_lower ? upper : lower).pixels_from();
        const std::uint32_t through = whole.pixels_from();
        const std::uint32_t between = (bent ^ through) & (through ^ (bends_left & (bent ^ through)));
        const std::uint32_t fresh = between & columns & ~static_cast<std::uint32_t>(full >> left);
        if (fresh != 0) {
            full |= std::uint64_t{fresh} << left;
            buffer.full_rows |= std::uint32_t{(full & full_row) == full_row} << row;
            alignas(8) std::array<std::uint8_t, 8> bits{};
            std::memcpy(bits.data(), &fresh, sizeof fresh);
            for (std::size_t i = 0; i < strip_parts; ++i) {
                const std::size_t at = pixel + i * part_px;
                const auto is_fresh = hn::LoadMaskBits(Strip(), bits.data() + i * part_px / 8);
                std::uint16_t* const covered = buffer.covered.data() + at;
                const auto all = hn::Set(Strip(), 0xffff);
                hn::StoreU(hn::IfThenElse(is_fresh, all, hn::LoadU(Strip(), covered)), Strip(), covered);
                for (std::size_t k = 0; k < gradients.size(); ++k) {
                    std::uint16_t* const sums = buffer.sums[k].data() + at;
                    const auto sixteen = hn::ShiftLeft<4>(gradients[k].colour(i));
                    hn::StoreU(hn::IfThenElse(is_fresh, sixteen, hn::LoadU(Strip(), sums)), Strip(), sums);
                }
                if constexpr (kind == PaintAs::OtherThanGround) {
                    const auto sixteen = hn::Set(Strip(), std::uint16_t{16});
                    count_other_than_ground(Strip(), at, hn::IfThenElseZero(is_fresh, sixteen), buffer);
                } else if constexpr (kind == PaintAs::Ground) {
                    const auto columns_right = static_cast<int>(i * part_px);
                    put_ground(Strip(), triangle, job, {left + columns_right, row}, hn::VecFromMask(Strip(), is_fresh),
                        buffer);
                }
            }
        }
        whole.x += whole.slope;
        upper.x += upper.slope;
        lower.x += lower.slope;
        for (StripGradient& level : gradients) { level.at += level.per_row; }
    }
}

/// Paints a triangle of Fill::Gouraud that no clip plane cuts: a triangle of the ground, of a flat or of a
/// Gouraud-shaded polygon.
template <PaintAs kind>
HWY_NOINLINE HWY_FLATTEN void paint_gouraud(
    const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    TileBox box(triangle, job);
    if (!box.keep_free_rows(buffer)) { return; }
    if constexpr (kind == PaintAs::Ground) {
        box.left &= ~1; // where the ground is recorded
    }
    if (!lanes.is_single_sample && box.right - box.left < speck_px) {
        paint_speck<kind>(triangle, job, lanes, box, buffer);
        return;
    }
    if constexpr (has_pairs_of_rows) {
        if (!lanes.is_single_sample && box.right - box.left < window_px) {
            if constexpr (kind == PaintAs::Ground) { box.first_row &= ~1; }
            paint_gouraud_in_pairs<kind>(triangle, job, lanes, box, buffer);
            return;
        }
    }
    for (int left = box.left; left <= box.right; left += strip_px) {
        if (lanes.is_single_sample) {
            paint_strip_of_middles<kind>(triangle, job, box, left, buffer);
            continue;
        }
        with_parts_of_strip(
            box, left, [&](auto parts) HWY_ATTR { paint_strip<kind, parts>(triangle, job, lanes, box, left, buffer); });
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
