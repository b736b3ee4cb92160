#include "models/aircraft/painted_solid.h"

#include "models/aircraft/convex_outline.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace octant::models::aircraft {

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

} // namespace octant::models::aircraft
