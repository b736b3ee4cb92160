#include "models/procedural/procedural_models.h"

#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::procedural {

// The 60-polygon background of E. K. Kim et al., "Hidden-Surface Removal in 3D Graphics for Real Time Animation", 1989,
// section IV and table 6. Deviations: the paper prints only the number of polygons; shapes and colours are made up
// here.

namespace {

constexpr int ring_sides = 24;
constexpr double ring_radius_m = 14'000.0;
constexpr double same_place_m = 1e-3;

/// A point of the map: x east, y north, metres.
using MapPoint = glm::dvec2;
using Piece = std::vector<MapPoint>;

/// One mountain: its top on the left and on the right end of its side (seen from the middle), and a peak between them,
/// `peak_at` of the way from left to right; no peak where peak_m is 0.
struct Mountain {
    double left_m = 0.0;
    double peak_m = 0.0;
    double peak_at = 0.0;
    char colour = 'p';
};

// The right end of a mountain is the left end of the next one.
constexpr std::array<Mountain, ring_sides> mountains{{{180, 760, 0.45, 'p'}, {0, 430, 0.60, 'q'}, {240, 980, 0.55, 'r'},
    {420, 1240, 0.40, 's'}, {520, 0, 0.0, 'q'}, {380, 690, 0.35, 'p'}, {0, 350, 0.50, 'q'}, {150, 560, 0.62, 'r'},
    {350, 1120, 0.58, 's'}, {610, 1480, 0.48, 't'}, {700, 1210, 0.36, 's'}, {410, 640, 0.30, 'p'}, {0, 310, 0.55, 'q'},
    {160, 0, 0.0, 'p'}, {330, 820, 0.44, 'r'}, {0, 540, 0.64, 'p'}, {290, 900, 0.52, 'r'}, {480, 1330, 0.57, 't'},
    {640, 1050, 0.33, 's'}, {360, 0, 0.0, 'r'}, {310, 590, 0.66, 'q'}, {0, 470, 0.41, 'p'}, {220, 730, 0.53, 'r'},
    {340, 610, 0.38, 'q'}}};

/// Cuts a piece along the line from -> to (kilometres east, north): what lies left of it stays, what lies right becomes
/// the next new piece.
struct Cut {
    std::size_t piece;
    MapPoint from_km;
    MapPoint to_km;
};

const std::array<Cut, 35> cuts{{
    {0, {-1, 5}, {1, 5}},           // 0 north, 1 the rest
    {1, {-1, -4}, {1, -4}},         // 1 middle, 2 south
    {0, {-6, 14}, {-3, 5}},         // 3 north-west, left of the river
    {0, {-5.65, 14}, {-2.65, 5}},   // 4 river
    {1, {-3, 5}, {-4.2, -4}},       // 5 west
    {1, {-2.65, 5}, {-3.85, -4}},   // 6 river
    {2, {-4.2, -4}, {-1, -14}},     // 7 south-west
    {2, {-3.85, -4}, {-0.65, -14}}, // 8 river
    {1, {0, 1.5}, {1, 1.5}},        // 9 level with the runway
    {9, {0, -1.5}, {1, -1.5}},      // 10 south of it
    {9, {1.2, 1.5}, {1.2, -1.5}},   // 11 west of the runway
    {9, {1.26, 1.5}, {1.26, -1.5}}, // 12 runway
    {0, {3, 5}, {4, 14}},           // from here on fields
    {0, {-4, 9}, {3, 8.5}},
    {13, {3, 9.5}, {12, 8}},
    {15, {8, 5}, {8.6, 10}},
    {3, {-14, 8}, {-4, 9}},
    {17, {-8, 5}, {-8.5, 10}},
    {5, {-14, 0.5}, {-3, 1.2}},
    {5, {-8.5, 1}, {-8, 5}},
    {19, {-7, -4}, {-7.6, 1}},
    {1, {3.5, 1.5}, {3, 5}},
    {22, {8.5, 1.5}, {9, 5}},
    {10, {2, -4}, {2.2, -1.5}},
    {24, {7.5, -4}, {7, -1.5}},
    {11, {-4, 0.2}, {1.2, -0.1}},
    {9, {4.5, -1.5}, {4.6, 1.5}},
    {27, {4.5, 0.2}, {14, 0}},
    {27, {9.5, 0}, {9.2, 1.5}},
    {7, {-14, -8}, {-2, -8.6}},
    {7, {-8, -8.5}, {-7.5, -4}},
    {30, {-6, -14}, {-5.4, -8}},
    {2, {-3, -8.2}, {14, -7.6}},
    {2, {5, -8}, {5.4, -4}},
    {33, {4, -14}, {3.6, -8}},
}};

/// Colour letter of each piece of ground.
constexpr std::string_view ground_colours = "abcdWeWfWgahRdgfcbeaghedecffahcgdeba";

struct Colour {
    char letter;
    std::string_view name;
    glm::vec3 rgb;
};

const std::array<Colour, 15> colours{{
    {'p', "mountain-wood", {0.20F, 0.29F, 0.20F}},
    {'q', "mountain-meadow", {0.31F, 0.38F, 0.25F}},
    {'r', "mountain-heath", {0.35F, 0.33F, 0.28F}},
    {'s', "mountain-rock", {0.42F, 0.42F, 0.44F}},
    {'t', "mountain-snow", {0.72F, 0.75F, 0.80F}},
    {'a', "field-grass", {0.30F, 0.45F, 0.20F}},
    {'b', "field-barley", {0.55F, 0.52F, 0.28F}},
    {'c', "field-wood", {0.17F, 0.31F, 0.16F}},
    {'d', "field-plough", {0.40F, 0.30F, 0.20F}},
    {'e', "field-clover", {0.38F, 0.52F, 0.26F}},
    {'f', "field-stubble", {0.61F, 0.54F, 0.36F}},
    {'g', "field-meadow", {0.25F, 0.40F, 0.22F}},
    {'h', "field-earth", {0.47F, 0.37F, 0.25F}},
    {'W', "river", {0.20F, 0.33F, 0.45F}},
    {'R', "runway", {0.45F, 0.45F, 0.46F}},
}};

/// Corner of the ring, clockwise from north, on whole metres.
MapPoint ring_corner(int index) {
    const double azimuth_rad = 2.0 * pi * (index % ring_sides) / ring_sides;
    return {std::round(ring_radius_m * std::sin(azimuth_rad)), std::round(ring_radius_m * std::cos(azimuth_rad))};
}

double side_of(const MapPoint& from, const MapPoint& to, const MapPoint& point) {
    const MapPoint along = to - from;
    const MapPoint across = point - from;
    return along.x * across.y - along.y * across.x;
}

/// The part of a convex piece left of the line from -> to.
Piece left_part(const Piece& piece, const MapPoint& from, const MapPoint& to) {
    Piece kept;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const MapPoint& here = piece[i];
        const MapPoint& next = piece[(i + 1) % piece.size()];
        const double side_here = side_of(from, to, here);
        const double side_next = side_of(from, to, next);
        if (side_here >= 0.0) { kept.push_back(here); }
        if ((side_here > 0.0 && side_next < 0.0) || (side_here < 0.0 && side_next > 0.0)) {
            kept.push_back(here + (next - here) * (side_here / (side_here - side_next)));
        }
    }
    return kept;
}

std::vector<Piece> ground_pieces() {
    Piece ring;
    for (int i = 0; i < ring_sides; ++i) {
        ring.push_back(ring_corner(ring_sides - i)); // counter-clockwise seen from above
    }
    std::vector<Piece> pieces{ring};
    for (const Cut& cut : cuts) {
        const Piece whole = pieces[cut.piece];
        const MapPoint from = cut.from_km * 1000.0;
        const MapPoint to = cut.to_km * 1000.0;
        pieces[cut.piece] = left_part(whole, from, to);
        pieces.push_back(left_part(whole, to, from));
    }
    return pieces;
}

class Builder {
public:
    void add_part(std::string_view name) { model_.parts.emplace_back(name); }

    /// Adds a polygon to the newest part; corners that fall together become one.
    void add(const std::vector<glm::dvec3>& corners_m, char colour) {
        Outline outline;
        for (const glm::dvec3& corner_m : corners_m) {
            const std::uint32_t vertex = vertex_at(corner_m);
            if (outline.empty() || (outline.back() != vertex && outline.front() != vertex)) {
                outline.push_back(vertex);
            }
        }
        outlines_.push_back(outline);
        polygons::Polygon polygon;
        polygon.material = material_of(colour);
        polygon.part = static_cast<std::uint32_t>(model_.parts.size() - 1);
        model_.polygons.push_back(polygon);
    }

    polygons::PolygonModel finished(std::string_view name) {
        for (std::size_t i = 0; i < outlines_.size(); ++i) {
            const Outline outline = with_neighbours_corners(outlines_[i]);
            model_.polygons[i].first_corner = static_cast<std::uint32_t>(model_.corner_vertices.size());
            model_.polygons[i].corner_count = static_cast<std::uint32_t>(outline.size());
            model_.corner_vertices.insert(model_.corner_vertices.end(), outline.begin(), outline.end());
        }
        model_.name = name;
        return std::move(model_);
    }

private:
    using Outline = std::vector<std::uint32_t>;

    std::uint32_t vertex_at(const glm::dvec3& place_m) {
        for (std::size_t i = 0; i < model_.vertices_m.size(); ++i) {
            if (glm::distance(model_.vertices_m[i], place_m) < same_place_m) { return static_cast<std::uint32_t>(i); }
        }
        model_.vertices_m.push_back(place_m);
        return static_cast<std::uint32_t>(model_.vertices_m.size() - 1);
    }

    std::uint32_t material_of(char letter) {
        const auto* const colour = std::ranges::find(colours, letter, &Colour::letter);
        assert(colour != colours.end());
        const auto known = std::ranges::find(model_.materials, colour->name, &Material::name);
        const auto index = known - model_.materials.begin();
        if (known == model_.materials.end()) {
            model_.materials.push_back({.name = std::string(colour->name), .colour = colour->rgb});
        }
        return static_cast<std::uint32_t>(index);
    }

    /// The outline with all vertices that lie on its sides.
    Outline with_neighbours_corners(const Outline& outline) const {
        Outline out;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            out.push_back(outline[i]);
            for (const std::uint32_t vertex : vertices_between(outline[i], outline[(i + 1) % outline.size()])) {
                out.push_back(vertex);
            }
        }
        return out;
    }

    /// Vertices inside the straight line between two others, in order.
    Outline vertices_between(std::uint32_t from, std::uint32_t to) const {
        const glm::dvec3& start_m = model_.vertices_m[from];
        const double length_m = glm::distance(start_m, model_.vertices_m[to]);
        const glm::dvec3 along = (model_.vertices_m[to] - start_m) / length_m;
        std::vector<std::pair<double, std::uint32_t>> found;
        for (std::size_t i = 0; i < model_.vertices_m.size(); ++i) {
            const glm::dvec3 offset_m = model_.vertices_m[i] - start_m;
            const double at_m = glm::dot(offset_m, along);
            const bool inside = at_m > same_place_m && at_m < length_m - same_place_m;
            if (inside && glm::distance(offset_m, along * at_m) < same_place_m) {
                found.emplace_back(at_m, static_cast<std::uint32_t>(i));
            }
        }
        std::ranges::sort(found);
        Outline vertices;
        for (const auto& [at_m, vertex] : found) { vertices.push_back(vertex); }
        return vertices;
    }

    polygons::PolygonModel model_;
    std::vector<Outline> outlines_;
};

glm::dvec3 body_from_map(const MapPoint& point, double height_m) { return {point.y, point.x, 0.0 - height_m}; }

void add_mountain(Builder& builder, int index) {
    const Mountain& mountain = mountains[static_cast<std::size_t>(index)];
    const double right_m = mountains[static_cast<std::size_t>((index + 1) % ring_sides)].left_m;
    const MapPoint left = ring_corner(index);
    const MapPoint right = ring_corner(index + 1);
    std::vector<glm::dvec3> corners{body_from_map(left, 0.0), body_from_map(right, 0.0), body_from_map(right, right_m)};
    if (mountain.peak_m > 0.0) {
        corners.push_back(body_from_map(left + (right - left) * mountain.peak_at, mountain.peak_m));
    }
    corners.push_back(body_from_map(left, mountain.left_m));
    builder.add(corners, mountain.colour);
}

} // namespace

polygons::PolygonModel background60() {
    Builder builder;
    builder.add_part("mountains");
    for (int i = 0; i < ring_sides; ++i) { add_mountain(builder, i); }
    builder.add_part("ground");
    const std::vector<Piece> pieces = ground_pieces();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        std::vector<glm::dvec3> corners;
        for (const MapPoint& point : pieces[i]) { corners.push_back(body_from_map(point, 0.0)); }
        builder.add(corners, ground_colours[i]);
    }
    return builder.finished("background60");
}

// The torus of the 2008 hybrid-shading paper. Deviations: the paper prints the numbers of quads and vertices only;
// radii and colour are made up. Vertices on the seams are shared here (416 of them), not doubled.

namespace {

constexpr double torus_radius_m = 1.0;
constexpr double tube_radius_m = 0.4;

glm::dvec3 torus_point(double around_rad, double across_rad) {
    const double from_axis_m = torus_radius_m + tube_radius_m * std::cos(across_rad);
    return {
        from_axis_m * std::cos(around_rad), from_axis_m * std::sin(around_rad), tube_radius_m * std::sin(across_rad)};
}

} // namespace

polygons::PolygonModel torus(int around, int across) {
    assert(around >= 3 && across >= 3);
    polygons::PolygonModel model;
    model.name = "torus";
    model.materials.push_back({.name = "torus", .colour = glm::vec3(0.80F, 0.55F, 0.25F)});
    model.parts.emplace_back("torus");
    const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>((j % across) * around + i % around); };
    for (int j = 0; j < across; ++j) {
        for (int i = 0; i < around; ++i) {
            model.vertices_m.push_back(torus_point(2.0 * pi * i / around, 2.0 * pi * j / across));
            model.polygons.push_back(
                {.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size()), .corner_count = 4});
            const std::array<std::uint32_t, 4> corners{
                vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
            model.corner_vertices.insert(model.corner_vertices.end(), corners.begin(), corners.end());
        }
    }
    return model;
}

// The coloured globe of the 2005 simplification paper, whose own file is not to be had: its numbers of vertices and
// faces are those of a sphere of 192 meridians, 192 rings and two poles.
//
// Land and sea: Natural Earth, 1:50m countries (public domain, naturalearthdata.com), as packed in
// r-cran-rnaturalearthdata 0.1.0. Made once: a bit is 1 where the vertex lies inside a country's outline (even-odd,
// longitude by longitude along the ring). The colours by latitude are made up.

namespace {

constexpr std::uint32_t meridians = 192;
constexpr std::uint32_t globe_rings = 192;

/// A line a ring from north to south, four meridians a digit from 180 degrees west on eastward, the westernmost in the
/// highest bit.
constexpr std::array<std::string_view, globe_rings> land_bits = {"000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000", "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000", "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000", "0000000000000000000f8000000000000000000000000000",
    "00000000000007fe017ff800000000000000000000000000", "0000000000007ff8fffff8c0000000000000000000000000",
    "0000000000073bf7ffffff0000000052c000380000000000", "000000000007df83fffffe00034e000000001c0000000000",
    "000000000061bf9ffffffc0001f000000000038000000000", "000000001c101e3ffffffc00008800000000000000000000",
    "00000000e0047c1ffffffe0000400000080003c000000000", "00000000ba710000fffffc0000000000700037f800200000",
    "000000000717fc003ffffa00000000038001fff800398000", "00000003c00000003ffffc00000000030009ffe800100000",
    "00000003d1937b001fffd00000000006021fffbf38000000", "00000003ff185b001ffff80000000004062ffffffc1f0000",
    "c00000003f827fe00ffff8000000000c0ebffffffdff8000", "001f800807c67dd00fffc000000780000efffffffffffc00",
    "003ffc193fcd10f00ffff000003fc00066ffffffffffffce", "80fffffff98158f00fffc000007ff883ffffffffffffffff",
    "e07ffffffdfbf93c0ffe0000007ffcbffedfffffffffffff", "e83ffffffffff87f0ffc000000ffdcfffbffffffffffffff",
    "fdffffffffffc0720ff80b8001f3e3ffffffffffffffffff", "10dffffffffff1f803e00f8001f3ebffffffffffffffffff",
    "001fffffffff343c07e00f0003f7f7ffffffffffffffffff", "007fffffffff001c03c000000fcfffffffffffffffffffff",
    "00fffffffffe01c003c000001fcffffffffffffffffffefc", "007f7ffffffc01e001c000000fcffffffffffffffffff2f0",
    "017e8ffffffc01e0008000000fccffffffffffffffffe180", "003c03fffffc01e2000000000fc7fffffffffffffffa2300",
    "000c007ffffe01f600000002098bfffffffffffffff00600", "000800fffffe00ff0000000601abffffffffffffffe00e00",
    "0010003fffffc2fe00000002058fffffffffffffffc00f00", "0020003fffffe1ff00000007070fffffffffffffff801e00",
    "0000001ffffffbffc000000d045fffffffffffffff800e00", "0100001ffffffbff400000190ffffffffffffffffff00c00",
    "0000000ffffffbffe000001b9ffffffffffffffffff80800", "0000000ffffffbffc00000139ffffffffffffffffff80800",
    "00000007ffffffffa0000003ffffffffffffffffffe81000", "00000007fffffff8200000007fffffffffffffffffe80000",
    "00000001fffffff470000000ffffffffffffffffffe80000", "00000003ffffffe870000003ffffffffffffffffffe80000",
    "00000003fffffffc00000001ffffffffffffffffffc80000", "00000003fffffffc80000000ffffa7e7ffffffffffc00000",
    "00000003fffffffb00000000feff3fcfffffffffffc10000", "00000003fffffff400000000fe7f07dfffffffffff8a0000",
    "00000003ffffffe00000000fd33e03cfffffffffff0c0000", "00000003ffffffe00000000fc73e01c7fffffffffc080000",
    "00000003ffffffe00000000fc19f31e7fffffffffc000000", "00000003ffffff800000000f84d8ffe7ffffffffb8100000",
    "00000003ffffff800000000f041bffe7ffffffff58100000", "00000001ffffff000000001f8019ffe7fffffffe18100000",
    "00000001ffffff000000000f0189ffe7ffffffff08100000", "00000000ffffff00000000062c89fff7ffffffff8c700000",
    "00000000ffffff00000000007c000fffffffffff8c700000", "00000000fffffe0000000007fc002fffffffffff09c00000",
    "000000007ffffe0000000007fc001fffffffffff82000000", "000000003ffffc000000000ffe001fffffffffff83000000",
    "000000003ffff8000000000fff981fffffffffff82000000", "000000002ffff8000000001fff9edfffffffffff80000000",
    "000000000fff98000000001fffffffffffffffff80000000", "0000000017fc08000000001fffffffcfffffffffc0000000",
    "0000000007f808000000003fffffffcfffffffff80000000", "000000001bf80c000000007fffffdfe7ffffffff80000000",
    "000000000bf806000000007fffffefe1ffffffff00000000", "0000000003f804000000007fffffefe3ffffffff00000000",
    "0000000001f000000000007fffffeff20fffffff00000000", "0000000004f00000000000ffffffe7fe07fffffe00000000",
    "0000000000f00c00000000fffffff7ff07fffffc00000000", "0000000000f01200000001fffffff7ff07fe3ff800000000",
    "0000000000f8c100000000fffffff7ff03fe3fc000000000", "0004000000f8c180000000fffffff3fe01fc3f9000000000",
    "000400000078c020000000fffffff3fe01fc3fa000000000", "00000000003fc120000000fffffff9fe01f81f8040000000",
    "00000000001f8000000000fffffff9fc00f81fc040000000", "00000000000f8000000000fffffff9f000f01fc040000000",
    "000000000001f000000000fffffffdf000e007e080000000", "000000000001f000000001ffffffffe000e007e000000000",
    "0000000000007000000000fffffffec000e007e040000000", "0000000000003000000000ffffffff0400e005e000000000",
    "0000000000003000000000fffffffe10006005e000000000", "00000000000010f00000007fffffff70006004c000000000",
    "00000000000010df0000007ffffffff00060008000000000", "0000000000000eff0000003fffffffe00050048010000000",
    "00000000000004ff8000003fffffffe00010040030000000", "00000000000001ff8000003fffffffe00010200000000000",
    "00000000000001ffc000001f9fffffe00010020210000000", "00000000000001fff000000d1fffffc000001b0300000000",
    "00000000000001fff800000007ffffc000000b0600000000", "00000000000001fff800000003ffff8000000d0600000000",
    "00000000000001fff800000003ffff800000050e00000000", "00000000000003fffc00000003ffff0000000e1f08000000",
    "00000000000003fffc00000003ffff000000061ee0000000", "00000000000003fffe00000007fffe000000031ec8000000",
    "00000000000007fffd00000007fffe000000031ec3000000", "00000000000007ffff80000003fffc000000031e80600000",
    "00000000000003fffff0000003fffc000000018ec5784000", "00000000000007fffff0000001fffc0000000180c0fc0000",
    "00000000000007fffffc000001fff80000000080c03c4000", "00000000000007fffffc000001fffc0000000000003e8000",
    "00000000000003fffffc000001fffc0000000078003e0000", "00000000000003fffffc000000fffc000000001c023a0000",
    "00000000000001fffffc000000fffc000000000210090000", "00000000000001fffff8000000fffc0000000000a0010000",
    "00000000000001fffff8000000fffc000000000000080000", "00000000000001fffff8000000fffc000000000003080040",
    "00000000000000fffff0000000fffc000000000003880000", "08000000000000fffff0000001fffc200000000003880000",
    "00000000000000fffff0000001fffc20000000001b8c0000", "00000000000000fffff0000001fffc60000000001f8c0040",
    "000000000000007ffff0000001fffce0000000003fcc0000", "000000000000003ffff0000001fff8e0000000003fec0000",
    "000000000000001fffe0000001fff0e0000000003ffc0001", "000000000000001fffe0000001fff0e0000000007ffe0001",
    "000000000000001fffe0000001ffe0e000000000ffff0000", "000000000000001fffe0000000ffe0c000000003ffff0080",
    "000000000000001fffe0000000ffe0c000000003ffff0000", "000000000000001fff80000000ffe0c000000007ffff8000",
    "000000000000001fff00000000ffe0c000000007ffff8000", "000000000000001ffe00000000ffe0c000000007ffffc000",
    "000000000000001ffe00000000ffc00000000007ffffc000", "000000000000001ffe000000007fc00000000007ffffc000",
    "000000000000001ffe000000007fc00000000007ffffc000", "000000000000001ffc000000007fc00000000003ffffc000",
    "000000000000003ffc000000003f800000000003ffffc000", "000000000000003ff8000000003f800000000003ffffc000",
    "000000000000003ff8000000003f800000000003ffffc000", "000000000000003ff8000000003f000000000003f8ffc000",
    "000000000000003ff0000000003e000000000003e0ff8000", "000000000000003ff00000000034000000000003003f8000",
    "000000000000003fc00000000000000000000001003f8000", "000000000000003fc00000000000000000000000005f8004",
    "000000000000007fc00000000000000000000000001f0000", "000000000000007fc00000000000000000000000001f0003",
    "000000000000007f80000000000000000000000000020002", "000000000000007e00000000000000000000000000000006",
    "000000000000007e00000000000000000000000000000002", "000000000000007c00000000000000000000000000030008",
    "000000000000003e00000000000000000000000000020008", "000000000000003c00000000000000000000000000020018",
    "000000000000003c00000000000000000000000000000030", "000000000000007800000000000000000000000000000030",
    "000000000000007000000000000000000000000000000060", "000000000000007800000000000000000000000000000000",
    "00000000000000f800000000000000000000000000000000", "000000000000007800000000000000000400000000000000",
    "000000000000007000000000000000000000000000000000", "00000000000000f000000000000000000000000000000000",
    "00000000000000f080000000000000000000000000000000", "000000000000007000000000000000000000000000000000",
    "000000000000007000000000000000000000000000000000", "000000000000003800000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000", "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000", "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000", "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000", "000000000000000040000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000", "000000000000000040000000000000000000000000000000",
    "000000000000000300000000000000000000000000000000", "000000000000000200000000000000000000000000000000",
    "0000000000000004000000000000001c00007fdc33e00000", "000000000000000c000000000000007fe007fffffff80000",
    "000000000000000600000000000003fffc3fffffffff8000", "000000000000002f00000000000023fff87ffffffffffc00",
    "000000000000001e0000000005a2fffff9fffffffffffc00", "000000000000003f0000001c7ffffffff9ffffffffffffe0",
    "00000000001c00170000003ffffffffff3ffffffffffffe0", "000000000038809e000000fffffffffff7ffffffffffff80",
    "00000001103fffff000000ffffffffffffffffffffffff00", "000000fff80ffffe000001fffffffffffffffffffffffe00",
    "00003ffffffffff800003ffffffffffffffffffffffffe00", "0000bffffffffe000000fffffffffffffffffffffffffe00",
    "000ffffffffffb800103ffffffffffffffffffffffffff00", "0047fffffffff0100307ffffffffffffffffffffffffff00",
    "00307fffffffff0007c11ffffffffffffffffffffffffc00", "00007fffffffff218c03fffffffffffffffffffffffffc00",
    "0003fffffffffffe003ffffffffffffffffffffffffffe00", "0001fffffffffffe1fffffffffffffffffffffffffffff80",
    "03cffffffffffffffffffffffffffffffffffffffffffff0", "c0ffffffffffffffffffffffffffffffffffffffffffffff",
    "ffffffffffffffffffffffffffffffffffffffffffffffff", "ffffffffffffffffffffffffffffffffffffffffffffffff",
    "ffffffffffffffffffffffffffffffffffffffffffffffff", "ffffffffffffffffffffffffffffffffffffffffffffffff",
    "ffffffffffffffffffffffffffffffffffffffffffffffff"};

constexpr glm::vec3 sea(0.05F, 0.16F, 0.42F);
constexpr glm::vec3 ice(0.90F, 0.93F, 0.96F);
constexpr glm::vec3 tundra(0.45F, 0.42F, 0.30F);
constexpr glm::vec3 forest(0.10F, 0.35F, 0.08F);
constexpr glm::vec3 desert(0.72F, 0.58F, 0.30F);

double latitude_rad(std::uint32_t ring) { return 0.5 * pi - pi * (ring + 1) / (globe_rings + 1); }

double longitude_rad(std::uint32_t meridian) { return -pi + 2.0 * pi * meridian / meridians; }

bool is_land(std::uint32_t ring, std::uint32_t meridian) {
    const char digit = land_bits[ring][meridian / 4];
    const int four = digit <= '9' ? digit - '0' : digit - 'a' + 10;
    return (four >> (3 - meridian % 4) & 1) != 0;
}

glm::vec3 land_colour(double latitude_deg) {
    const double away_deg = std::abs(latitude_deg);
    if (latitude_deg < -60.0 || away_deg > 74.0) { return ice; }
    if (away_deg > 60.0) { return tundra; }
    return away_deg > 15.0 && away_deg < 33.0 ? desert : forest;
}

void add_vertex(TriangleMesh& mesh, double north_rad, double east_rad, const glm::vec3& colour) {
    mesh.vertices_m.emplace_back(
        std::cos(north_rad) * std::cos(east_rad), std::cos(north_rad) * std::sin(east_rad), std::sin(north_rad));
    mesh.colours.push_back(colour);
}

void add_vertices(TriangleMesh& mesh) {
    mesh.vertices_m.emplace_back(0.0, 0.0, 1.0);
    mesh.colours.push_back(sea);
    for (std::uint32_t ring = 0; ring < globe_rings; ++ring) {
        const double north_rad = latitude_rad(ring);
        const glm::vec3 land = land_colour(deg_from_rad(north_rad));
        for (std::uint32_t meridian = 0; meridian < meridians; ++meridian) {
            add_vertex(mesh, north_rad, longitude_rad(meridian), is_land(ring, meridian) ? land : sea);
        }
    }
    mesh.vertices_m.emplace_back(0.0, 0.0, -1.0);
    mesh.colours.push_back(ice);
}

void add_triangles(TriangleMesh& mesh) {
    constexpr std::uint32_t south_pole = globe_rings * meridians + 1;
    const auto vertex = [](std::uint32_t ring, std::uint32_t meridian) {
        return 1 + ring * meridians + meridian % meridians;
    };
    for (std::uint32_t i = 0; i < meridians; ++i) { mesh.triangles.push_back({0, vertex(0, i), vertex(0, i + 1)}); }
    for (std::uint32_t ring = 0; ring + 1 < globe_rings; ++ring) {
        for (std::uint32_t i = 0; i < meridians; ++i) {
            const std::uint32_t north_west = vertex(ring, i);
            const std::uint32_t south_east = vertex(ring + 1, i + 1);
            mesh.triangles.push_back({north_west, vertex(ring + 1, i), south_east});
            mesh.triangles.push_back({north_west, south_east, vertex(ring, i + 1)});
        }
    }
    for (std::uint32_t i = 0; i < meridians; ++i) {
        mesh.triangles.push_back({south_pole, vertex(globe_rings - 1, i + 1), vertex(globe_rings - 1, i)});
    }
}

} // namespace

TriangleMesh globe() {
    TriangleMesh mesh;
    mesh.name = "globe";
    add_vertices(mesh);
    add_triangles(mesh);
    return mesh;
}

// A machined part, made for comparisons of simplifiers on shapes with sharp edges: rings of as many points each, from
// one pole to the other, so that the mesh is closed.

namespace {

using Outline = std::vector<glm::dvec2>; ///< counter-clockwise; seen from the origin all of it

constexpr double step_m = 0.00125; ///< along the outline, about

std::size_t steps_along(double length_m) { return static_cast<std::size_t>(std::lround(length_m / step_m)); }

/// Adds the points of a line but for its end.
void add_line(Outline& outline, const glm::dvec2& start, const glm::dvec2& end) {
    const std::size_t steps = steps_along(glm::distance(start, end));
    for (std::size_t i = 0; i < steps; ++i) {
        outline.push_back(glm::mix(start, end, static_cast<double>(i) / static_cast<double>(steps)));
    }
}

/// Points of a part of a circle without its end.
void add_arc(Outline& outline, const glm::dvec2& middle, double radius_m, double from_rad, double to_rad) {
    const std::size_t steps = steps_along(std::abs(to_rad - from_rad) * radius_m);
    for (std::size_t i = 0; i < steps; ++i) {
        const double angle = from_rad + (to_rad - from_rad) * static_cast<double>(i) / static_cast<double>(steps);
        outline.push_back(middle + radius_m * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
}

/// The outline of the block: a rounded corner, a step and a hollow.
Outline block_outline() {
    constexpr double quarter = std::numbers::pi / 2.0;
    Outline outline;
    add_line(outline, {0.040, -0.025}, {0.040, 0.010});
    add_arc(outline, {0.025, 0.010}, 0.015, 0.0, quarter);
    add_line(outline, {0.025, 0.025}, {-0.005, 0.025});
    add_line(outline, {-0.005, 0.025}, {-0.010, 0.017});
    add_line(outline, {-0.010, 0.017}, {-0.028, 0.017});
    add_arc(outline, {-0.040, 0.017}, 0.012, 0.0, -quarter);
    add_line(outline, {-0.040, 0.005}, {-0.040, -0.025});
    add_line(outline, {-0.040, -0.025}, {0.040, -0.025});
    return outline;
}

Outline scaled(const Outline& outline, double factor) {
    Outline made;
    for (const glm::dvec2& point : outline) { made.push_back(factor * point); }
    return made;
}

/// The same directions from the origin, all at one distance.
Outline circle(const Outline& outline, double radius_m) {
    Outline made;
    for (const glm::dvec2& point : outline) { made.push_back(radius_m * glm::normalize(point)); }
    return made;
}

/// The frame of a ring, which lies in its x-y plane.
struct Frame {
    glm::dvec3 origin{0.0};
    glm::dvec3 x{1.0, 0.0, 0.0};
    glm::dvec3 y{0.0, 1.0, 0.0};
    glm::dvec3 z{0.0, 0.0, 1.0};
};

class Rings {
public:
    explicit Rings(Outline outline) : outline_(std::move(outline)) {
        mesh_.name = "machined part";
        mesh_.vertices_m.push_back(frame_.origin);
    }

    /// In so many steps to another outline, so far on.
    void go(int steps, const Outline& to, double way_m) {
        const Outline from = outline_;
        const glm::dvec3 start = frame_.origin;
        for (int step = 1; step <= steps; ++step) {
            const double share = static_cast<double>(step) / steps;
            frame_.origin = start + share * way_m * frame_.z;
            for (std::size_t i = 0; i < from.size(); ++i) { outline_[i] = glm::mix(from[i], to[i], share); }
            add_ring();
        }
    }

    /// Around an axis along y that lies so far off along x.
    void bend(int steps, double radius_m, double angle_rad) {
        const Frame start = frame_;
        const glm::dvec3 axis = start.origin + radius_m * start.x;
        for (int step = 1; step <= steps; ++step) {
            const double angle = angle_rad * step / steps;
            frame_.x = std::cos(angle) * start.x - std::sin(angle) * start.z;
            frame_.z = std::sin(angle) * start.x + std::cos(angle) * start.z;
            frame_.origin = axis - radius_m * frame_.x;
            add_ring();
        }
    }

    /// Ends the mesh in a point so far ahead and returns it.
    TriangleMesh end(double way_m) {
        mesh_.vertices_m.push_back(frame_.origin + way_m * frame_.z);
        join_to_pole(mesh_.vertices_m.size() - 1);
        return std::move(mesh_);
    }

    const Outline& outline() const { return outline_; }

private:
    std::uint32_t number(std::size_t ring, std::size_t i) const {
        return static_cast<std::uint32_t>(1 + ring * outline_.size() + i % outline_.size());
    }

    void add_ring() {
        for (const glm::dvec2& point : outline_) {
            mesh_.vertices_m.push_back(frame_.origin + point.x * frame_.x + point.y * frame_.y);
        }
        const std::size_t ring = rings_++;
        for (std::size_t i = 0; i < outline_.size(); ++i) {
            if (ring == 0) {
                mesh_.triangles.push_back({0, number(0, i + 1), number(0, i)});
                continue;
            }
            const std::uint32_t a = number(ring - 1, i);
            const std::uint32_t b = number(ring - 1, i + 1);
            const std::uint32_t c = number(ring, i + 1);
            const std::uint32_t d = number(ring, i);
            if ((ring + i) % 2 == 0) {
                mesh_.triangles.insert(mesh_.triangles.end(), {{a, b, c}, {a, c, d}});
            } else {
                mesh_.triangles.insert(mesh_.triangles.end(), {{a, b, d}, {b, c, d}});
            }
        }
    }

    void join_to_pole(std::size_t pole) {
        for (std::size_t i = 0; i < outline_.size(); ++i) {
            mesh_.triangles.push_back(
                {number(rings_ - 1, i), number(rings_ - 1, i + 1), static_cast<std::uint32_t>(pole)});
        }
    }

    Outline outline_;
    Frame frame_;
    TriangleMesh mesh_;
    std::size_t rings_ = 0;
};

} // namespace

TriangleMesh machined_part() {
    const Outline block = block_outline();
    const Outline narrow = scaled(block, 0.9);
    Rings rings(scaled(block, 0.0));
    rings.go(9, block, 0.0);
    rings.go(20, narrow, 0.030);
    rings.bend(24, 0.060, rad_from_deg(50.0));
    rings.go(8, narrow, 0.012);
    rings.go(8, circle(block, 0.012), 0.0);    // the end around the boss
    rings.go(6, circle(block, 0.012), 0.006);  // the boss
    rings.go(2, circle(block, 0.010), 0.0015); // its chamfer
    rings.go(2, circle(block, 0.006), 0.0);
    rings.go(9, circle(block, 0.006), -0.012); // the bore
    rings.go(3, circle(block, 0.0015), -0.002);
    return rings.end(-0.0005);
}

} // namespace octant::models::procedural
