// Paints a triangle whose texture lies even on it: places in the texture, light and haze as planes. Included once for
// each instruction set.
#if defined(OCTANT_RASTER_EVEN_TEXTURE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTANT_RASTER_EVEN_TEXTURE_INL
#undef OCTANT_RASTER_EVEN_TEXTURE_INL
#else
#define OCTANT_RASTER_EVEN_TEXTURE_INL
#endif

#include "visuals/raster/strip_gradient-inl.h"
#include "visuals/raster/strip_walk-inl.h"
#include "visuals/raster/texel_fetch-inl.h"
#include "visuals/raster/texture_windows-inl.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {

using Texels = hn::Repartition<std::uint32_t, Strip>;
using TexelCoords = hn::Vec<hn::RebindToSigned<Texels>>; ///< 2^-16 texel
using Colours = FilteredColours<Strip>;

/// Places of a register's pixels in the fine level: of those in even lanes, then in odd ones.
struct TextureCoords {
    std::array<TexelCoords, 2> x;
    std::array<TexelCoords, 2> y;
};

/// Two rows' places, from those of a register's first pixel in each: of its even lanes, then of its odd ones. `px`:
/// after how many a row begins.
struct TextureCoordSteps {
    TexelCoords of_even;
    TexelCoords to_odd;

    HWY_INLINE TextureCoordSteps(std::int32_t per_x, int px) {
        const hn::RebindToSigned<Texels> whole;
        const auto pairs = hn::And(lane_indices_from(whole, 0), hn::Set(whole, px / 2 - 1));
        to_odd = hn::Set(whole, per_x);
        of_even = hn::Mul(hn::ShiftLeft<1>(pairs), to_odd);
    }

    HWY_INLINE std::array<TexelCoords, 2> from(TexelCoords first) const {
        const auto even = hn::Add(first, of_even);
        return {even, hn::Add(even, to_odd)};
    }
};

/// `weight`: of the other one, 2^-16.
HWY_INLINE hn::Vec<Strip> interpolated(hn::Vec<Strip> from, hn::Vec<Strip> to, hn::Vec<Strip> weight) {
    return hn::Add(hn::Sub(from, hn::MulHigh(from, weight)), hn::MulHigh(to, weight));
}

HWY_INLINE Colours colours_at(const TexelGrid<Texels>& level, const TextureCoords& places) {
    return filter_bilinear<Strip>(level, places.x[0], places.y[0], places.x[1], places.y[1]);
}

/// Places in the next coarser level.
HWY_INLINE TextureCoords coarser(const TextureCoords& places) {
    const auto of = [](TexelCoords place) HWY_ATTR {
        const auto quarter = hn::Set(hn::RebindToSigned<Texels>(), 16384); // of a texel
        return hn::Sub(hn::ShiftRight<1>(place), quarter);
    };
    return {{of(places.x[0]), of(places.x[1])}, {of(places.y[0]), of(places.y[1])}};
}

/// What all of a triangle's pixels have in common.
struct TextureSampler {
    TexelGrid<Texels> fine;
    TexelGrid<Texels> coarse;
    bool has_coarse; ///< else the fine one is all
    hn::Vec<Strip> coarse_share;
    Probes probes;
    std::array<std::uint16_t, 3> haze;

    HWY_INLINE TextureSampler(const MipSelection& levels, const TileJob& job)
        : fine(job.ground->levels()[levels.fine]),
          coarse(job.ground->levels()[levels.fine + (levels.coarse_share > 0 ? 1U : 0U)]),
          has_coarse(levels.coarse_share > 0), coarse_share(hn::Set(Strip(), levels.coarse_share)),
          probes(levels, levels.fine) {
        for (std::size_t k = 0; k < haze.size(); ++k) {
            haze[k] = static_cast<std::uint16_t>(job.haze[static_cast<glm::length_t>(k)] * 128.0F);
        }
    }

    /// The texture's, 1/128 level.
    HWY_INLINE Colours at(const TextureCoords& places) const {
        Colours colours = colours_at(fine, places);
        if (has_coarse) {
            const Colours next = colours_at(coarse, coarser(places));
            for (std::size_t k = 0; k < 3; ++k) { colours[k] = interpolated(colours[k], next[k], coarse_share); }
        }
        return colours;
    }

    static HWY_INLINE TextureCoords moved(const TextureCoords& places, std::int32_t dx, std::int32_t dy) {
        const hn::RebindToSigned<Texels> whole;
        const auto x = hn::Set(whole, dx);
        const auto y = hn::Set(whole, dy);
        return {{hn::Add(places.x[0], x), hn::Add(places.x[1], x)}, {hn::Add(places.y[0], y), hn::Add(places.y[1], y)}};
    }

    /// Whether a pixel takes one place of one level, as most do.
    bool is_single() const { return probes.count == 1 && !has_coarse; }

    /// The mean of a pixel's places, 1/128 level.
    HWY_INLINE Colours around(const TextureCoords& places) const {
        return probes.mean<Strip>([&](std::int32_t dx, std::int32_t dy) HWY_ATTR { return at(moved(places, dx, dy)); });
    }

    /// The same, of a pixel that is_single() says takes one place where it is.
    template <bool is_single>
    HWY_INLINE Colours texture(const TextureCoords& places) const {
        if constexpr (is_single) {
            return colours_at(fine, places);
        } else {
            return around(places);
        }
    }

    /// Under light and behind haze, 1/16 level.
    HWY_INLINE Colours seen(const Colours& colours, hn::Vec<Strip> light_left, hn::Vec<Strip> haze_share) const {
        const auto seen_share = hn::MulHigh(light_left, hn::Not(haze_share));
        const auto of = [&](std::size_t k) HWY_ATTR {
            const auto own = hn::MulHigh(colours[k], seen_share);
            const auto of_haze = hn::MulHigh(hn::Set(Strip(), haze[k]), haze_share);
            const auto sum = hn::Add(own, of_haze);
            return hn::ShiftRight<3>(hn::Add(sum, hn::Set(Strip(), 4)));
        };
        return {of(0), of(1), of(2)};
    }
};

/// Covers what is free of a triangle in a strip; what is new waits for its colours.
template <std::size_t parts>
HWY_INLINE void cover_texture_strip(const Triangle& triangle, const TileJob& job, const SampleLanes& lanes,
    const TileBox& box, int left, TileBuffer& buffer, TextureQueue& queue) {
    using Values = PartValues<parts>;
    const auto wait = [&](int row, const Values& /*masks*/, const Values& fresh)
                          HWY_ATTR { queue.add_row(static_cast<std::size_t>(row - box.first_row), fresh); };
    walk_strip<parts>(triangle, job, lanes, box, left, buffer, wait, []() HWY_ATTR {});
    queue.finish(static_cast<std::size_t>(box.last_row - box.first_row + 1));
}

/// Colours what waits of a strip that begins at a column of the tile.
template <bool is_single>
HWY_INLINE void colour_windows(const Triangle& triangle, const TileJob& job, const TextureSampler& look,
    const TileBox& box, int left, const TextureQueue& queue, TileBuffer& buffer) {
    const ColourGradients& levels = triangle.gradients;
    const WindowPlanes planes(levels, job, box, left);
    const TextureCoordSteps x(levels.per_x[0], texture_window_px);
    const TextureCoordSteps y(levels.per_x[1], texture_window_px);
    const ShareSteps light(levels, 2);
    const ShareSteps haze(levels, 3);
    const auto strip_begin = static_cast<std::size_t>(box.first_row * tile_width + left);
    for (std::size_t i = 0; i < queue.count(); i += windows_at_once) {
        const TextureWindows windows = queue.windows(i);
        const auto first = planes.at(windows);
        const auto halves = hn::BitCast(StripSigned(), first);
        const TextureCoords places{x.from(hn::Broadcast<0>(first)), y.from(hn::Broadcast<1>(first))};
        const Colours colours = look.seen(look.template texture<is_single>(places),
            light.share(hn::Broadcast<4>(halves)), haze.share(hn::Broadcast<6>(halves)));
        const auto counts = hn::PopulationCount(queue.fresh(windows));
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t* const sums = buffer.sums[k].data() + strip_begin;
            windows.store(hn::Add(windows.load(sums), hn::Mul(colours[k], counts)), sums);
        }
    }
}

/// Colours what waits of a strip.
HWY_INLINE void colour_pending(const Triangle& triangle, const TileJob& job, const TileBox& box, int left,
    const TextureQueue& queue, TileBuffer& buffer) {
    if (queue.count() == 0) { return; }
    const TextureSampler look(triangle.texture, job);
    if (look.is_single()) {
        colour_windows<true>(triangle, job, look, box, left, queue, buffer);
    } else {
        colour_windows<false>(triangle, job, look, box, left, queue, buffer);
    }
}

/// Paints a triangle of Fill::Texture.
HWY_NOINLINE void paint_affine_triangle(
    const Triangle& triangle, const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer) {
    const TileBox box(triangle, job);
    if ((box.rows() & ~buffer.full_rows) == 0) { return; }
    for (int left = box.left; left <= box.right; left += strip_px) {
        TextureQueue queue;
        with_parts_of_strip(box, left,
            [&](auto parts) HWY_ATTR { cover_texture_strip<parts>(triangle, job, lanes, box, left, buffer, queue); });
        colour_pending(triangle, job, box, left, queue, buffer);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#endif
