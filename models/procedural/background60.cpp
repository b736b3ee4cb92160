// The 60-polygon background of E. K. Kim et al., "Hidden-Surface Removal in 3D Graphics for Real Time Animation", 1989,
// section IV and table 6. Deviations: the paper prints only the number of polygons; shapes and colours are made up
// here.

#include "models/procedural/background60.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string_view>
#include <utility>

namespace octant::models::procedural {

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

} // namespace octant::models::procedural
