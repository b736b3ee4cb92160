#include "tests/models/aircraft/aircraft_builder.h"

#include "sim/base/plane.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace octant::models::aircraft::test {

namespace {

constexpr double min_area_m2 = 1e-7;

} // namespace

glm::dvec3 area_vector(const Outline& corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return 0.5 * sum;
}

Outline without_duplicates(const Outline& corners) {
    Outline out;
    for (const glm::dvec3& corner : corners) {
        if (out.empty() || glm::distance(out.back(), corner) > coincident_distance_m) { out.push_back(corner); }
    }
    while (out.size() > 1 && glm::distance(out.front(), out.back()) <= coincident_distance_m) { out.pop_back(); }
    return out;
}

bool has_area(const Outline& corners) { return corners.size() >= 3 && glm::length(area_vector(corners)) > min_area_m2; }

Outline in_front(const Outline& corners, const Plane& plane) {
    Outline out;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& from = corners[i];
        const glm::dvec3& to = corners[(i + 1) % corners.size()];
        const double at_from = distance_m(plane, from);
        const double at_to = distance_m(plane, to);
        if (at_from >= -coincident_distance_m) { out.push_back(from); }
        if ((at_from > coincident_distance_m && at_to < -coincident_distance_m) ||
            (at_from < -coincident_distance_m && at_to > coincident_distance_m)) {
            out.push_back(from + (to - from) * (at_from / (at_from - at_to)));
        }
    }
    return without_duplicates(out);
}

namespace {

void add_face(PaintedSolid& solid, Outline corners, const std::string& material) {
    corners = without_duplicates(corners);
    if (has_area(corners)) { solid.push_back({std::move(corners), material}); }
}

/// Turns a face so that it is seen from the side away from a point inside.
void face_away_from(PaintedFace& face, const glm::dvec3& inside_m) {
    if (glm::dot(area_vector(face.corners_m), face.corners_m[0] - inside_m) < 0.0) {
        std::ranges::reverse(face.corners_m);
    }
}

/// Outline of a section. Its sides have fixed directions: where two lines that touch it meet.
Outline corners_of(const Section& section, int sides) {
    struct Touch {
        glm::dvec2 normal{0.0};
        double reach_m = 0.0;
    };

    std::vector<Touch> touches;
    for (int i = 0; i < sides; ++i) {
        const double angle_rad = 2.0 * pi * i / sides;
        const glm::dvec2 normal(std::sin(angle_rad), -std::cos(angle_rad)); // i = 0 looks up: -z
        const double height_m = normal.y < 0.0 ? section.up_m : section.down_m;
        const double flat_m = section.flat_m;
        const double side_m = std::min(section.side_m, height_m);
        const double round = std::hypot((section.half_width_m - flat_m) * normal.x, (height_m - side_m) * normal.y);
        touches.push_back({normal, round + flat_m * std::abs(normal.x) + side_m * std::abs(normal.y)});
    }
    Outline corners;
    for (std::size_t i = 0; i < touches.size(); ++i) {
        const Touch& a = touches[i];
        const Touch& b = touches[(i + 1) % touches.size()];
        const double det = a.normal.x * b.normal.y - a.normal.y * b.normal.x;
        const glm::dvec2 at((a.reach_m * b.normal.y - b.reach_m * a.normal.y) / det,
            (a.normal.x * b.reach_m - b.normal.x * a.reach_m) / det);
        corners.emplace_back(section.x_m, section.y_m + at.x, section.z_m + at.y);
    }
    return corners;
}

glm::dvec3 middle_of(const Section& section) { return {section.x_m, section.y_m, section.z_m}; }

} // namespace

PaintedSolid lofted(std::span<const Section> sections, int sides, const std::string& material) {
    assert(sides % 4 == 0);
    PaintedSolid solid;
    for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
        const Outline ahead = corners_of(sections[i], sides);
        const Outline astern = corners_of(sections[i + 1], sides);
        const glm::dvec3 inside_m = 0.5 * (middle_of(sections[i]) + middle_of(sections[i + 1]));
        for (std::size_t k = 0; k < ahead.size(); ++k) {
            const std::size_t next = (k + 1) % ahead.size();
            const std::size_t before = solid.size();
            add_face(solid, {ahead[k], ahead[next], astern[next], astern[k]}, material);
            if (solid.size() > before) { face_away_from(solid.back(), inside_m); }
        }
    }
    return solid;
}

PaintedFace section_cap(const Section& section, int sides, bool ahead, const std::string& material) {
    PaintedFace face{without_duplicates(corners_of(section, sides)), material};
    face_away_from(face, middle_of(section) + glm::dvec3(ahead ? -1.0 : 1.0, 0.0, 0.0));
    return face;
}

PaintedSolid box_between(const glm::dvec3& a_m, const glm::dvec3& b_m, const std::string& material) {
    const glm::dvec3 least = glm::min(a_m, b_m);
    const glm::dvec3 most = glm::max(a_m, b_m);
    PaintedSolid solid;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (const double at : {least[axis], most[axis]}) {
            Outline corners(4, least);
            for (glm::dvec3& corner : corners) { corner[axis] = at; }
            corners[1][u] = corners[2][u] = most[u];
            corners[2][v] = corners[3][v] = most[v];
            add_face(solid, corners, material);
            face_away_from(solid.back(), 0.5 * (least + most));
        }
    }
    return solid;
}

PaintedSolid wing_solid(const Aerofoil& shape, const std::string& material, const std::string& other) {
    // Shares of the chord and of half the thickness: leading edge, front and rear of the thickest part, trailing edge,
    // which is a little blunt.
    constexpr std::array<glm::dvec2, 8> section{
        {{0.0, 0.04}, {0.14, 0.72}, {0.42, 1.0}, {1.0, 0.06}, {1.0, -0.06}, {0.42, -1.0}, {0.14, -0.72}, {0.0, -0.04}}};
    const double taper = shape.tip_chord_m / shape.root_chord_m;
    const auto place = [&](std::size_t corner, bool tip) {
        const glm::dvec2& share = section[corner % section.size()];
        const double size = tip ? taper : 1.0;
        return (tip ? shape.tip_m : shape.root_m) - glm::dvec3(share.x * shape.root_chord_m * size, 0.0, 0.0) +
               share.y * size * shape.half_thickness_m;
    };
    const glm::dvec3 inside_m =
        0.5 * (shape.root_m + shape.tip_m) - glm::dvec3(0.25 * (shape.root_chord_m + shape.tip_chord_m), 0.0, 0.0);
    PaintedSolid solid;
    Outline end;
    for (std::size_t i = 0; i < section.size(); ++i) {
        const bool is_first_side = i < 3;
        add_face(solid, {place(i, false), place(i + 1, false), place(i + 1, true), place(i, true)},
            is_first_side ? material : other);
        face_away_from(solid.back(), inside_m);
        end.push_back(place(i, true));
    }
    add_face(solid, end, other);
    face_away_from(solid.back(), inside_m);
    return solid;
}

void cut_off(PaintedSolid& solid, const Plane& plane, const std::string& material) {
    PaintedSolid out;
    Outline rim;
    for (const PaintedFace& face : solid) {
        const Outline kept = in_front(face.corners_m, plane);
        for (const glm::dvec3& corner : kept) {
            if (std::abs(distance_m(plane, corner)) <= 2.0 * coincident_distance_m &&
                std::ranges::none_of(rim,
                    [&](const glm::dvec3& other) { return glm::distance(other, corner) <= coincident_distance_m; })) {
                rim.push_back(corner);
            }
        }
        add_face(out, kept, face.material);
    }
    if (rim.size() >= 3) {
        glm::dvec3 middle(0.0);
        for (const glm::dvec3& corner : rim) { middle += corner / static_cast<double>(rim.size()); }
        const glm::dvec3 first = glm::normalize(rim[0] - middle);
        const glm::dvec3 second = glm::cross(plane.normal, first);
        const auto angle = [&](const glm::dvec3& corner) {
            return std::atan2(glm::dot(corner - middle, second), glm::dot(corner - middle, first));
        };
        std::ranges::sort(rim, {}, angle);
        add_face(out, rim, material);
        face_away_from(out.back(), middle + plane.normal);
    }
    solid = std::move(out);
}

PaintedSolid mirrored(const PaintedSolid& solid) {
    PaintedSolid out = solid;
    for (PaintedFace& face : out) {
        for (glm::dvec3& corner : face.corners_m) { corner.y = -corner.y; }
        std::ranges::reverse(face.corners_m);
    }
    return out;
}

namespace {

Plane plane_at(const glm::dvec3& point_m, const glm::dvec3& normal) {
    const glm::dvec3 unit = glm::normalize(normal);
    return {unit, -glm::dot(unit, point_m)};
}

void add_piece(PaintedSolid& pieces, Outline corners, const std::string& material) {
    if (has_area(corners)) { pieces.push_back({std::move(corners), material}); }
}

} // namespace

void paint(PaintedSolid& solid, const Stencil& stencil, const std::string& material) {
    PaintedSolid out;
    for (PaintedFace& face : solid) {
        const glm::dvec3 normal = glm::normalize(area_vector(face.corners_m));
        if (stencil.facing != glm::dvec3(0.0) &&
            glm::dot(normal, glm::normalize(stencil.facing)) < stencil.min_cosine) {
            out.push_back(std::move(face));
            continue;
        }
        PaintedSolid outside;
        Outline inside = face.corners_m;
        for (const Plane& plane : stencil.planes) {
            add_piece(outside, in_front(inside, turned_over(plane)), face.material);
            inside = in_front(inside, plane);
            if (!has_area(inside)) { break; }
        }
        if (!has_area(inside)) {
            out.push_back(std::move(face));
            continue;
        }
        out.insert(out.end(), outside.begin(), outside.end());
        out.push_back({std::move(inside), material});
    }
    solid = std::move(out);
}

Stencil stripe(const glm::dvec3& point_m, const glm::dvec3& across, double width_m) {
    const glm::dvec3 half_m = 0.5 * width_m * glm::normalize(across);
    return {{plane_at(point_m - half_m, across), plane_at(point_m + half_m, -across)}};
}

Stencil outline(std::span<const glm::dvec2> corners_m, int axis) {
    const auto placed = [&](const glm::dvec2& at) {
        return axis == 0   ? glm::dvec3(0.0, at.x, at.y)
               : axis == 1 ? glm::dvec3(at.x, 0.0, at.y)
                           : glm::dvec3(at.x, at.y, 0.0);
    };
    glm::dvec2 middle(0.0);
    for (const glm::dvec2& corner : corners_m) { middle += corner / static_cast<double>(corners_m.size()); }
    Stencil stencil;
    for (std::size_t i = 0; i < corners_m.size(); ++i) {
        const glm::dvec2& from = corners_m[i];
        const glm::dvec2 along = corners_m[(i + 1) % corners_m.size()] - from;
        glm::dvec2 inward(-along.y, along.x);
        if (glm::dot(inward, middle - from) < 0.0) { inward = -inward; }
        stencil.planes.push_back(plane_at(placed(from), placed(inward)));
    }
    return stencil;
}

void paint_roundel(PaintedSolid& solid, const Roundel& roundel, const std::string& disc, const std::string& star) {
    const glm::dvec2 across(-roundel.to_top.y, roundel.to_top.x);
    const auto at = [&](double radius_share, double angle_rad) {
        return roundel.middle_m +
               roundel.radius_m * radius_share * (std::cos(angle_rad) * roundel.to_top + std::sin(angle_rad) * across);
    };
    const auto paint_shape = [&](std::span<const glm::dvec2> corners, const std::string& material) {
        Stencil stencil = outline(corners, roundel.axis);
        stencil.facing = roundel.facing;
        paint(solid, stencil, material);
    };
    std::array<glm::dvec2, 10> rim;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        rim[i] = at(1.0, 2.0 * pi * static_cast<double>(i) / double{rim.size()});
    }
    paint_shape(rim, disc);
    constexpr double inner = 0.381966; // of a star whose edges run on straight
    std::array<glm::dvec2, 5> core;
    for (int i = 0; i < 5; ++i) { core[static_cast<std::size_t>(i)] = at(inner * 0.92, 2.0 * pi * (i + 0.5) / 5.0); }
    paint_shape(core, star);
    for (int i = 0; i < 5; ++i) {
        const std::array<glm::dvec2, 3> point{at(0.92, 2.0 * pi * i / 5.0), core[static_cast<std::size_t>(i)],
            core[static_cast<std::size_t>((i + 4) % 5)]};
        paint_shape(point, star);
    }
}

Section Stations::section(double s, double half, double top_u, double bottom_u, double flat, double side) const {
    const glm::dvec3 middle_m = at(s, 0.0, 0.5 * (top_u + bottom_u));
    const double tall = 0.5 * (top_u - bottom_u);
    return {middle_m.x, 0.0, middle_m.z, half, tall, tall, flat, side};
}

void Stations::ring_line(PaintedSolid& solid, double s) const {
    paint(solid, stripe(at(s, 0.0, 0.0), {1.0, 0.0, 0.0}, panel_line_m), "line");
}

ModelBuilder::ModelBuilder(std::string name) { model_.name = std::move(name); }

void ModelBuilder::add_material(const std::string& name, const glm::vec3& colour) {
    model_.materials.push_back({.name = name, .colour = colour, .is_mirror = name == "glass"});
}

std::uint32_t ModelBuilder::vertex_at(const glm::dvec3& at_m) {
    constexpr double grid_m = 1e-10; // what the file keeps
    const glm::dvec3 kept = glm::round(at_m / grid_m) * grid_m + glm::dvec3(0.0);
    const auto found = std::ranges::find_if(
        model_.vertices_m, [&](const glm::dvec3& other) { return glm::distance(other, kept) < coincident_distance_m; });
    if (found != model_.vertices_m.end()) { return static_cast<std::uint32_t>(found - model_.vertices_m.begin()); }
    model_.vertices_m.push_back(kept);
    return static_cast<std::uint32_t>(model_.vertices_m.size() - 1);
}

std::uint32_t ModelBuilder::part_of(const std::string& name) {
    const auto found = std::ranges::find(model_.parts, name);
    if (found != model_.parts.end()) { return static_cast<std::uint32_t>(found - model_.parts.begin()); }
    model_.parts.push_back(name);
    return static_cast<std::uint32_t>(model_.parts.size() - 1);
}

void ModelBuilder::add(const std::string& part, const PaintedSolid& solid) {
    for (const PaintedFace& face : solid) {
        const auto material = std::ranges::find(model_.materials, face.material, &Material::name);
        assert(material != model_.materials.end());
        std::vector<std::uint32_t> corners;
        for (const glm::dvec3& corner : face.corners_m) {
            const std::uint32_t vertex = vertex_at(corner);
            if (std::ranges::find(corners, vertex) == corners.end()) { corners.push_back(vertex); }
        }
        if (corners.size() < 3) { continue; }
        outlines_.push_back(std::move(corners));
        polygons::Polygon polygon;
        polygon.material = static_cast<std::uint32_t>(material - model_.materials.begin());
        polygon.part = part_of(part);
        model_.polygons.push_back(polygon);
    }
}

void ModelBuilder::add_mirrored(const std::string& part, const PaintedSolid& right_side) {
    add(part + "_right", right_side);
    add(part + "_left", mirrored(right_side));
}

void ModelBuilder::add_pivot(const std::string& part, const polygons::Pivot& pivot) {
    model_.pivots.push_back(pivot);
    model_.pivots.back().part = part_of(part);
}

polygons::PolygonModel ModelBuilder::finish() {
    constexpr double beside_m = 1e-6;
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
        std::vector<std::uint32_t> whole;
        const std::vector<std::uint32_t>& outline = outlines_[i];
        for (std::size_t k = 0; k < outline.size(); ++k) {
            const glm::dvec3 from = model_.vertices_m[outline[k]];
            const glm::dvec3 to = model_.vertices_m[outline[(k + 1) % outline.size()]];
            const double length = glm::distance(from, to);
            const glm::dvec3 along = (to - from) / length;
            std::vector<std::pair<double, std::uint32_t>> between;
            for (std::uint32_t vertex = 0; vertex < model_.vertices_m.size(); ++vertex) {
                const glm::dvec3 offset = model_.vertices_m[vertex] - from;
                const double share = glm::dot(offset, along);
                if (share > 2.0 * beside_m && share < length - 2.0 * beside_m &&
                    glm::length(offset - share * along) < beside_m) {
                    between.emplace_back(share, vertex);
                }
            }
            std::ranges::sort(between);
            whole.push_back(outline[k]);
            for (const auto& [share, vertex] : between) { whole.push_back(vertex); }
        }
        model_.polygons[i].first_corner = static_cast<std::uint32_t>(model_.corner_vertices.size());
        model_.polygons[i].corner_count = static_cast<std::uint32_t>(whole.size());
        model_.corner_vertices.insert(model_.corner_vertices.end(), whole.begin(), whole.end());
    }
    return std::move(model_);
}

} // namespace octant::models::aircraft::test
