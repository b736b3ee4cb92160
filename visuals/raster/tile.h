#pragma once

#include "visuals/raster/detail_rays.h"
#include "visuals/raster/lit_ground_texture.h"
#include "visuals/raster/sample_pattern.h"
#include "visuals/raster/triangle.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::raster {

class TruthSurfaces;

constexpr int tile_width = 64;
constexpr int tile_height = 32;

/// A triangle that may cover a part of a tile.
struct TileTriangle {
    const Triangle* triangle = nullptr;
    const TriangleExtra* extra = nullptr;   ///< none if it needs none
    const SurfacePlanes* surface = nullptr; ///< none if it has no texture of its own
};

/// The input of paint_tile(), and where it writes.
struct TileJob {
    glm::ivec2 first_px{0};                  ///< its upper left pixel
    glm::ivec2 size_px{0};                   ///< at most a tile's
    std::span<const TileTriangle> triangles; ///< in painting order
    std::span<const TileTriangle> overlay;   ///< in painting order, over all others
    std::array<std::uint8_t, 3> background{};
    const LitGroundTexture* ground = nullptr;   ///< for textures
    glm::vec3 haze{0.0F};                       ///< levels, for textures
    const DetailRays* detail_texture = nullptr; ///< none in a picture without
    const Light* light = nullptr;               ///< for Fill::Lit
    bool tints_mesh_levels = false;             ///< for Fill::MeshEdges
    bool far_to_near = false;                   ///< each triangle over what is there; one sample a pixel
    bool blue_first = false;                    ///< in each pixel; else red
    std::uint8_t* rgba = nullptr;               ///< of its upper left pixel
    std::size_t row_bytes = 0;
    /// The same with 16 bits, 65535 = full, red, green, blue of its upper left pixel; null = not wanted.
    std::uint16_t* deep = nullptr;
    std::size_t row_deep = 0; ///< values from row to row

    /// TileBuffer::full of a row that is covered whole.
    std::uint64_t full_row() const { return ~std::uint64_t{0} >> (tile_width - size_px.x); }

    /// TileBuffer::full_rows of a tile that is covered whole.
    std::uint32_t full_rows() const { return ~std::uint32_t{0} >> (tile_height - size_px.y); }
};

/// Positions of the samples in a pixel, prepared for registers.
struct SampleLanes {
    explicit SampleLanes(const SamplePattern& pattern);

    alignas(64) std::array<std::int32_t, SamplePattern::lanes> down{}; ///< 1/32 pixel
    /// What makes a crossing, in 2^-16 pixel, the first column whose sample is not left of it, when it is added and the
    /// fraction is dropped.
    alignas(64) std::array<std::int32_t, SamplePattern::lanes> round_up{};
    alignas(64) std::array<float, SamplePattern::lanes> x_px{};
    alignas(64) std::array<float, SamplePattern::lanes> y_px{};
    bool is_single_sample = false; ///< all lanes are in the middle of the pixel
};

/// Pixels that TileBuffer::masks holds masks of: blocks of sixteen from the first column of each row on.
struct Coverage {
    struct Row {
        int first; ///< column
        int last;
        int blocks;
    };

    int first_row;
    int last_row;
    std::array<Row, tile_height> rows;
};

/// The colour of a transparent triangle in a pixel of a tile, to be blended later.
struct TransparentPixel {
    std::uint16_t pixel = 0;
    std::uint16_t mask = 0;                ///< samples where it is seen
    std::array<std::uint16_t, 3> colour{}; ///< as PixelColour
    std::uint16_t share = whole;           ///< of the pixel that it hides

    static constexpr std::uint16_t whole = 4096;

    /// The share that `samples` of sixteen samples hide, each with this opacity.
    static std::uint16_t share_of(float opacity, int samples) {
        return static_cast<std::uint16_t>(static_cast<int>(opacity * 256.0F + 0.5F) * samples);
    }
};

/// Pixels of a tile that show new samples of a textured triangle.
struct TileFragments {
    static constexpr std::size_t room = 32; ///< for registers

    std::array<std::uint16_t, std::size_t{tile_width} * tile_height + room> pixels; ///< numbers in the tile
    std::array<std::uint16_t, std::size_t{tile_width} * tile_height + room> samples;
    std::size_t count = 0;

    void add(std::size_t pixel, std::uint32_t fresh) {
        pixels[count] = static_cast<std::uint16_t>(pixel);
        samples[count] = static_cast<std::uint16_t>(fresh);
        ++count;
    }
};

/// Up to eight fragments of a triangle, with all that their colours need but texels.
struct PlacedFragments {
    static constexpr std::size_t at_once = 8;
    template <class Value>
    using Each = std::array<Value, at_once>;

    const TileTriangle* triangle = nullptr;
    std::size_t count = 0;
    Each<std::uint16_t> pixels{};
    Each<std::uint16_t> samples{};
    // Places in the texture, and the footprints there: MeshFootprint.
    alignas(32) Each<float> u{};
    alignas(32) Each<float> v{};
    alignas(32) Each<std::int32_t> level{};
    alignas(32) Each<float> coarse_share{};
    alignas(32) Each<float> places{};
    alignas(32) Each<float> reach_u{};
    alignas(32) Each<float> reach_v{};
    // Of a white texel: red and, in the upper half, blue; green; 1/128 level. And what haze hides, 65,535 = all.
    alignas(32) Each<std::uint32_t> red_and_blue{};
    alignas(32) Each<std::uint32_t> green{};
    alignas(32) Each<std::int32_t> haze_share{};
};

/// What a thread works on: sums of colours and masks of covered samples for the pixels of a tile. Rows of sums follow
/// each other without gaps: a block of sixteen pixels may begin anywhere, and what it reads of the next row it writes
/// back unchanged.
struct TileBuffer {
    static constexpr std::size_t pixels = std::size_t{tile_width} * tile_height;
    static constexpr std::size_t padding = 2 * tile_width; ///< two rows may be at hand at once

    alignas(64) std::array<std::uint16_t, pixels + padding> covered{};
    /// Red, green, blue, 1/256 level; and, where the picture has a detail texture, how many samples show anything but
    /// ground that has it.
    std::array<std::array<std::uint16_t, pixels + padding>, 4> sums{};
    /// Where the picture has a detail texture: of the first pixel, third, and so on of the first row, third, and so on,
    /// the PackedGround at PackedGround::sample, or where that shows none, of the nearest ground in the pixel; 0: none.
    /// Rows follow each other without gaps; there is room before the first one and behind the last.
    static constexpr std::size_t ground_room = 16;
    alignas(64) std::array<std::uint32_t, pixels / 4 + 2 * ground_room> ground{};
    /// A bit for each column that is covered whole; one row more than there are.
    std::array<std::uint64_t, tile_height + 1> full{};
    std::uint32_t full_rows = 0; ///< a bit for each row that is covered whole
    /// Of the triangle at hand, what it covers; its rows leave room for blocks that end beyond.
    static constexpr std::size_t mask_row = tile_width + 48;
    alignas(64) std::array<std::uint16_t, mask_row * tile_height + padding> masks{};
    Coverage coverage{};
    TileFragments fragments; ///< of the textured triangle at hand
    /// Fragments whose texels are being prefetched, of any triangle (`waiting`; its count is 0 where none are), and
    /// room for the next ones.
    std::array<PlacedFragments, 2> placed;
    std::size_t waiting = 0;
    // Of groups that are drawn by depth: a value for each sample.
    std::vector<float> depth;
    std::vector<std::uint32_t> seen; ///< place in the group's list, from 1; 0: nothing
    /// Samples of a pixel that show one triangle of a group.
    struct SeenPixel {
        std::uint32_t name = 0; ///< as in `seen`
        std::uint16_t pixel = 0;
        std::uint16_t samples = 0;
    };
    std::vector<SeenPixel> found;       ///< pixel after pixel
    std::vector<SeenPixel> seen_pixels; ///< the same, triangle after triangle
    std::vector<std::uint32_t>
        first_seen; ///< for each name the first of its seen_pixels, and the end of the last one's
    /// What is seen of transparent triangles: those of the nearest group first, in a group in painting order.
    std::vector<TransparentPixel> transparent_pixels;
    std::vector<std::size_t> group_first_transparent; ///< of each group that has any
    std::vector<std::uint32_t> last_transparent;      ///< of each pixel: place in transparent_pixels, from 1; 0: none
    /// Of each pixel: the place, from 1, of the only one that was recorded of it if that is of a surface; 0: none.
    std::vector<std::uint32_t> only_transparent;
    static constexpr std::uint32_t several = ~std::uint32_t{0};
    // Of the overlay: what waits to be blended.
    std::vector<std::uint16_t> pending;
    std::vector<std::uint32_t> pending_colours;

    /// Of a row of even number.
    std::uint32_t* ground_of_row(int row) {
        return ground.data() + ground_room + static_cast<std::size_t>(row) * (tile_width / 4);
    }

    const std::uint32_t* ground_of_row(int row) const { return const_cast<TileBuffer*>(this)->ground_of_row(row); }
};

/// The input of count_samples(): what the pixels of a tile belong to.
struct SampleOwners {
    /// TruthSurfaces::key() of each of them, the first that of nothing.
    std::span<const std::uint32_t> keys;
    /// For each pixel, row after row, the place in `keys`; TileBuffer::padding more follow.
    std::span<const std::uint16_t> of_pixels;
    const TruthSurfaces* surfaces = nullptr;
};

/// Counts the samples of each pixel that show what the pixel belongs to. Writes the counts to TileBuffer::sums[0].
/// Clouds and glass count as in find_middles().
void count_samples(const TileJob& job, const SampleLanes& lanes, const SampleOwners& owners, TileBuffer& buffer);

/// Those of a row's columns in whose middle the texture of a triangle has no hole; a bit for each column of the tile
/// that begins at `tile_px`. `row`: of the tile.
std::uint64_t columns_without_holes(
    const SurfacePlanes& surface, const glm::ivec2& tile_px, int row, std::uint64_t columns);

/// Makes a tile's picture: from the nearest triangle to the farthest, each colouring the samples that nothing nearer
/// covers.
void paint_tile(const TileJob& job, const SampleLanes& lanes, TileBuffer& buffer);

} // namespace octant::visuals::raster
