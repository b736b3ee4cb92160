// The first part of a picture's truth: which triangle the middle of each pixel shows. The triangles are those that the
// picture was painted of (triangle_binner.cpp). Next: truth_surfaces.cpp.
#include "visuals/raster/truth_middles.h"

#include "visuals/raster/mesh_texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace octant::visuals::raster {

namespace {

/// Where an edge crosses the middles of rows.
struct EdgeCrossing {
    std::uint64_t x;
    std::uint64_t slope;

    EdgeCrossing(const Edge& edge, std::int32_t top, const glm::ivec2& first_px)
        : x(edge_x(edge, top, first_px)), slope(static_cast<std::uint64_t>(edge.slope)) {}

    /// The first column whose middle is not left of the edge.
    std::int64_t column() const { return ((static_cast<std::int64_t>(x) >> 16) + 0xffff) >> 16; }

    void next_row() { x += slope; }
};

/// The tile at hand.
struct Tile {
    const glm::ivec2& first_px;
    const glm::ivec2& size_px;
    std::span<const TileTriangle> triangles;
    const TruthSurfaces& surfaces;

    std::uint64_t full_row() const { return ~std::uint64_t{0} >> (tile_width - size_px.x); }

    std::uint32_t full_rows() const { return ~std::uint32_t{0} >> (tile_height - size_px.y); }
};

/// Columns from `first` to `end` - 1.
std::uint64_t bits_of(std::int64_t first, std::int64_t end) {
    if (first >= end) { return 0; }
    return (~std::uint64_t{0} << first) & (~std::uint64_t{0} >> (tile_width - end));
}

/// The columns of a row of the tile that lie on the inner side of all clip lines, as pixels_within() finds them.
std::uint64_t columns_within(const TriangleExtra& extra, const Tile& tile, int row) {
    std::int64_t first = 0;
    std::int64_t end = tile_width;
    for (int k = 0; k < extra.cut_count; ++k) {
        const ClipLine& line = extra.cuts[static_cast<std::size_t>(k)];
        const double here = line.c + line.a * tile.first_px.x + line.b * (tile.first_px.y + row);
        const double column = line.a == 0.0 ? 0.0 : std::clamp(-here / line.a, -1.0, 1.0 + tile_width);
        if (line.a > 0.0) {
            first = std::max(first, static_cast<std::int64_t>(std::ceil(column)));
        } else if (line.a < 0.0) {
            end = std::min(end, static_cast<std::int64_t>(std::floor(column)) + 1);
        } else if (here < 0.0) {
            return 0;
        }
    }
    return bits_of(first, end);
}

/// Calls visit(row of the tile, columns whose middles a triangle covers) for the rows that have any and of which `rows`
/// has the bit.
template <class Visit>
void for_each_row(const TileTriangle& one, const Tile& tile, std::uint32_t rows, const Visit& visit) {
    const Triangle& triangle = *one.triangle;
    const int top = first_row_of(triangle.top) - tile.first_px.y;
    const int bottom = ((triangle.bottom - 1) >> 8) - tile.first_px.y;
    const int first = std::max({triangle.first_row - tile.first_px.y, top, 0});
    const int last = std::min({triangle.last_row - tile.first_px.y, bottom, tile.size_px.y - 1});
    const std::int64_t left = std::max(triangle.left - tile.first_px.x, 0);
    const std::int64_t end = std::min(triangle.right - tile.first_px.x, tile.size_px.x - 1) + 1;
    if (first > last || left >= end) { return; }
    const bool is_cut = one.extra != nullptr && one.extra->cut_count > 0;
    const bool has_holes = one.surface != nullptr && one.surface->texture->has_holes;
    const glm::ivec2 from_px = tile.first_px + glm::ivec2(0, first);
    const int first_lower = first_row_of(triangle.middle) - tile.first_px.y;
    EdgeCrossing whole(triangle.whole, triangle.top, from_px);
    EdgeCrossing bent = first < first_lower ? EdgeCrossing(triangle.upper, triangle.top, from_px)
                                            : EdgeCrossing(triangle.lower, triangle.middle, from_px);
    for (int row = first; row <= last; ++row) {
        if (row == first_lower && row > first) {
            bent = EdgeCrossing(triangle.lower, triangle.middle, tile.first_px + glm::ivec2(0, row));
        }
        if ((rows >> row & 1U) != 0) {
            const std::int64_t through = whole.column();
            const std::int64_t bend = bent.column();
            std::uint64_t columns = bits_of(std::max(triangle.middle_is_left ? bend : through, left),
                std::min(triangle.middle_is_left ? through : bend, end));
            if (columns != 0 && is_cut) { columns &= columns_within(*one.extra, tile, row); }
            if (columns != 0 && has_holes) {
                columns = columns_without_holes(*one.surface, tile.first_px, row, columns);
            }
            if (columns != 0) { visit(row, columns); }
        }
        whole.next_row();
        bent.next_row();
    }
}

/// Makes columns of a row show triangles that show_at(column) names.
template <class ShowAt>
void take(const Tile& tile, int row, std::uint64_t columns, TileMiddles& middles, const ShowAt& show_at) {
    std::uint64_t& full = middles.full[static_cast<std::size_t>(row)];
    std::uint32_t* const shown = middles.shown.data() + static_cast<std::size_t>(row) * tile_width;
    for (std::uint64_t left = columns; left != 0; left &= left - 1) {
        const int column = std::countr_zero(left);
        shown[column] = show_at(column);
    }
    full |= columns;
    middles.full_rows |= std::uint32_t{full == tile.full_row()} << row;
}

/// A triangle that is painted without depth.
void take_triangle(const Tile& tile, std::size_t place, TileMiddles& middles) {
    if (tile.triangles[place].triangle->is_under_side) { return; }
    const auto name = static_cast<std::uint32_t>(place + 1);
    for_each_row(tile.triangles[place], tile, ~middles.full_rows, [&](int row, std::uint64_t columns) {
        const std::uint64_t fresh = columns & ~middles.full[static_cast<std::size_t>(row)];
        if (fresh != 0) {
            take(tile, row, fresh, middles, [&](int) { return name; });
        }
    });
}

void take_cloud(const Tile& tile, std::size_t place, TileMiddles& middles) {
    const Triangle& triangle = *tile.triangles[place].triangle;
    const auto name = static_cast<std::uint32_t>(place + 1);
    for_each_row(tile.triangles[place], tile, ~middles.full_rows, [&](int row, std::uint64_t columns) {
        std::uint64_t fresh = columns & ~middles.full[static_cast<std::size_t>(row)];
        for (std::uint64_t left = fresh; left != 0; left &= left - 1) {
            const int column = std::countr_zero(left);
            if (!is_cloud_at(triangle, tile.first_px + glm::ivec2(column, row))) {
                fresh &= ~(std::uint64_t{1} << column);
            }
        }
        if (fresh != 0) {
            take(tile, row, fresh, middles, [&](int) { return name; });
        }
    });
}

/// The plane of a triangle of the sky or of the land around the map, computed when it is first asked for.
class SkyPlane {
public:
    SkyPlane(const Tile& tile, std::size_t place) : tile_(tile), triangle_(*tile.triangles[place].triangle) {}

    /// Whether it is nearer than what a column and row of the tile show of sky and land, if anything; keeps its depth.
    bool is_nearer(int column, int row, bool shows_any, double& land) {
        if (!is_known_) { seen_ = tile_.surfaces.surface(triangle_.source); }
        is_known_ = true;
        const glm::dvec2 at(tile_.first_px + glm::ivec2(column, row));
        const double inverse = seen_.inverse_depth_at(at);
        if (shows_any && !(inverse > land)) { return false; }
        land = inverse;
        return true;
    }

private:
    const Tile& tile_;
    const Triangle& triangle_;
    bool is_known_ = false;
    SeenSurface seen_;
};

/// A triangle of the sky or of the land around the map. Its pixels stay free for others of these.
void take_sky(const Tile& tile, std::size_t place, TileMiddles& middles) {
    if (tile.triangles[place].triangle->is_under_side) { return; }
    const auto name = static_cast<std::uint32_t>(place + 1);
    SkyPlane plane(tile, place);
    for_each_row(tile.triangles[place], tile, ~middles.full_rows, [&](int row, std::uint64_t columns) {
        for (std::uint64_t left = columns & ~middles.full[static_cast<std::size_t>(row)]; left != 0; left &= left - 1) {
            const int column = std::countr_zero(left);
            const auto pixel = static_cast<std::size_t>(row * tile_width + column);
            if (plane.is_nearer(column, row, middles.shown[pixel] != 0, middles.land[pixel])) {
                middles.shown[pixel] = name;
            }
        }
    });
}

/// Draws a triangle of a group by depth, as draw_pixel() does; but pieces on ground are no nearer than they lie, so
/// that they hide nothing that stands close over it.
void draw_by_depth(const Tile& tile, std::size_t place, TileMiddles& middles) {
    using Use = scene::DepthUse;
    const TileTriangle& one = tile.triangles[place];
    if (one.triangle->is_under_side) { return; }
    const auto name = static_cast<std::uint32_t>(place + 1);
    const Use use = one.triangle->depth;
    double share = static_cast<double>(one.extra->depth_share);
    AttributePlane depth = one.extra->depth;
    if (use == Use::OnGround) {
        depth.base -= TriangleExtra::on_ground_offset_px * std::max(std::abs(depth.per_x), std::abs(depth.per_y));
        share = 1.0;
    }
    SkyPlane plane(tile, place);
    const AttributePlane middle{
        depth.at(tile.first_px.x, tile.first_px.y) * share, depth.per_x * share, depth.per_y * share};
    for_each_row(one, tile, ~middles.full_rows, [&](int row, std::uint64_t columns) {
        for (std::uint64_t left = columns; left != 0; left &= left - 1) {
            const int column = std::countr_zero(left);
            const auto pixel = static_cast<std::size_t>(row * tile_width + column);
            const auto here = static_cast<float>(middle.at(column, row));
            float& before = middles.depth[pixel];
            const bool may_be_equal = use == Use::OnGround || use == Use::InfinitelyFar;
            if (use != Use::None && !(here > before || (may_be_equal && here == before))) { continue; }
            if (one.triangle->is_sky &&
                !plane.is_nearer(column, row, middles.nearest[pixel] != 0, middles.land[pixel])) {
                continue;
            }
            if (use != Use::None && use != Use::InfinitelyFar) { before = here; }
            if (use != Use::DepthOnly) { middles.nearest[pixel] = name; }
        }
    });
}

/// Triangles `first` to `end` - 1 are a group.
void take_group(const Tile& tile, std::size_t first, std::size_t end, TileMiddles& middles) {
    int first_row = tile_height;
    int last_row = -1;
    for (std::size_t place = first; place < end; ++place) {
        const Triangle& triangle = *tile.triangles[place].triangle;
        first_row = std::min(first_row, triangle.first_row - tile.first_px.y);
        last_row = std::max(last_row, triangle.last_row - tile.first_px.y);
    }
    first_row = std::max(first_row, 0);
    last_row = std::min(last_row, tile.size_px.y - 1);
    if (first_row > last_row) { return; }
    const auto from = static_cast<std::size_t>(first_row) * tile_width;
    const auto count = static_cast<std::size_t>(last_row - first_row + 1) * tile_width;
    middles.depth.resize(TileMiddles::pixels);
    middles.nearest.resize(TileMiddles::pixels);
    std::fill_n(middles.depth.begin() + static_cast<std::ptrdiff_t>(from), count, 0.0F);
    std::fill_n(middles.nearest.begin() + static_cast<std::ptrdiff_t>(from), count, 0U);
    for (std::size_t place = first; place < end; ++place) {
        if (tile.triangles[place].triangle->fill != Fill::Transparent) { draw_by_depth(tile, place, middles); }
    }
    for (int row = first_row; row <= last_row; ++row) {
        const std::uint32_t* const nearest = middles.nearest.data() + static_cast<std::size_t>(row) * tile_width;
        std::uint64_t drawn = 0;
        for (int column = 0; column < tile.size_px.x; ++column) {
            drawn |= std::uint64_t{nearest[column] != 0} << column;
        }
        const std::uint64_t fresh = drawn & ~middles.full[static_cast<std::size_t>(row)];
        if (fresh != 0) {
            take(tile, row, fresh, middles, [&](int column) { return nearest[column]; });
        }
    }
}

} // namespace

bool is_cloud_at(const Triangle& triangle, const glm::ivec2& at) {
    constexpr int half = 16 * 255 / 2; // of the opacity's sixteenths
    return triangle.is_cloud && sixteenths_of(triangle.gradients.level(3, at)) >= half;
}

void find_middles(const glm::ivec2& first_px, const glm::ivec2& size_px, std::span<const TileTriangle> triangles,
    const TruthSurfaces& surfaces, TileMiddles& middles) {
    const Tile tile{first_px, size_px, triangles, surfaces};
    middles.land.assign(TileMiddles::pixels, 0.0);
    middles.shown.fill(0);
    middles.full.fill(0);
    middles.full_rows = 0;
    std::size_t end = triangles.size();
    while (end > 0 && middles.full_rows != tile.full_rows()) {
        const Triangle& triangle = *triangles[end - 1].triangle;
        std::size_t first = end - 1;
        if (triangle.fill == Fill::Transparent && triangle.depth == scene::DepthUse::None) {
            if (triangle.is_cloud) { take_cloud(tile, first, middles); }
        } else if (triangle.group == 0 && triangle.is_sky) {
            take_sky(tile, first, middles);
        } else if (triangle.group == 0) {
            take_triangle(tile, first, middles);
        } else {
            // Transparent triangles without depth between those of a group end it, as they do in the picture.
            const auto belongs = [&](const Triangle& other) {
                return other.group == triangle.group &&
                       (other.fill != Fill::Transparent || other.depth != scene::DepthUse::None);
            };
            while (first > 0 && belongs(*triangles[first - 1].triangle)) { --first; }
            take_group(tile, first, end, middles);
        }
        end = first;
    }
}

} // namespace octant::visuals::raster
