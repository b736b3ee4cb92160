// Hughes 500MD Defender by stations: s = metres aft of the nose, r = to the right, u = above the skids' base. The
// origin, on the mast axis, lies at s = 1.95, u = 1.20, as in 500md.obj, which names the sources of the main dimensions
// (length 7.1, hub 2.7 up, rotor 8.05 with five blades of 0.171, tail rotor 1.4, body by stations, skids, T-tail).
// Doors, windows and the rotor's fairing by photographs (general knowledge of the type).
//
// Planes that separate its parts: s = 3.7 (boom behind the body), s = 6.45 (tail behind the boom), u = 2.10 (fairing
// and rotor above the body), the body's own lower sides (legs outside). Rotor blades are two faces in one plane, thus
// they need no plane between them.

#include "models/polygons/polygon_model.h"
#include "sim/base/units.h"
#include "tests/models/aircraft/aircraft_builder.h"
#include "tests/models/aircraft/detailed_aircraft.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace octant::models::aircraft::test {

namespace {

constexpr double roof_u = 2.10;
constexpr double rotor_u = 2.70;
constexpr Stations stations{1.95, 1.20, 0.02};

glm::dvec3 at(double s, double r, double u) { return stations.at(s, r, u); }

/// Two opposite faces in one plane.
void add_plate(
    PaintedSolid& solid, std::vector<glm::dvec3> corners, const std::string& top, const std::string& bottom) {
    solid.push_back({corners, top});
    std::ranges::reverse(corners);
    solid.push_back({std::move(corners), bottom});
}

void add_main_rotor(ModelBuilder& model) {
    constexpr int blades = 5;
    constexpr double hub_m = 0.2;
    constexpr double half_chord_m = 0.0855;
    const glm::dvec3 middle = at(1.95, 0.0, rotor_u);
    PaintedSolid rotor;
    std::vector<glm::dvec3> hub;
    for (int blade = 0; blade < blades; ++blade) {
        const double angle_rad = 2.0 * pi * blade / blades;
        const glm::dvec3 out(std::cos(angle_rad), std::sin(angle_rad), 0.0);
        const glm::dvec3 side(-out.y, out.x, 0.0);
        const auto strip = [&](double from_m, double to_m, double half_from_m, double half_to_m, const std::string& top,
                               const std::string& bottom) {
            add_plate(rotor,
                {middle + from_m * out + half_from_m * side, middle + from_m * out - half_from_m * side,
                    middle + to_m * out - half_to_m * side, middle + to_m * out + half_to_m * side},
                top, bottom);
        };
        strip(hub_m, 0.7, 0.04, half_chord_m, "black", "black");
        strip(0.7, 3.72, half_chord_m, half_chord_m, "blade", "black");
        strip(3.72, 3.92, half_chord_m, half_chord_m, "yellow", "yellow");
        strip(3.92, 4.02, half_chord_m, half_chord_m, "blade", "black");
        hub.push_back(middle + hub_m * out - 0.04 * side);
        hub.push_back(middle + hub_m * out + 0.04 * side);
    }
    add_plate(rotor, hub, "black", "black");
    model.add("rotor", rotor);
    polygons::Pivot pivot;
    pivot.point_m = middle;
    pivot.axis = up;
    pivot.turns_per_s = 492.0 / 60.0;
    model.add_pivot("rotor", pivot);
}

/// Both blades lie in one plane, turned 20 degrees about their length, clear of boom and fin.
void add_tail_rotor(ModelBuilder& model) {
    const double pitch_rad = rad_from_deg(20.0);
    const glm::dvec3 tail = at(6.40, -0.24, 1.62);
    const glm::dvec3 chord(std::cos(pitch_rad), std::sin(pitch_rad), 0.0);
    PaintedSolid tail_rotor;
    for (const double side : {1.0, -1.0}) {
        const glm::dvec3 out = side * up;
        const auto strip = [&](double from_m, double to_m, const std::string& material) {
            add_plate(tail_rotor,
                {tail + from_m * out + 0.06 * chord, tail + from_m * out - 0.06 * chord,
                    tail + to_m * out - 0.06 * chord, tail + to_m * out + 0.06 * chord},
                material, material);
        };
        strip(0.06, 0.58, "blade");
        strip(0.58, 0.70, "yellow");
    }
    model.add("tail_rotor", tail_rotor);
    polygons::Pivot turning;
    turning.point_m = tail;
    turning.axis = right;
    turning.turns_per_s = 3018.0 / 60.0;
    model.add_pivot("tail_rotor", turning);
}

/// The main rotor and the tail rotor, which turn.
void add_rotors(ModelBuilder& model) {
    add_main_rotor(model);
    add_tail_rotor(model);
}

constexpr int body_sides = 16;

/// A window or a mark on the right side, by stations and heights.
Stencil on_side(const std::vector<glm::dvec2>& corners_su, double side) {
    std::vector<glm::dvec2> corners;
    for (const glm::dvec2& corner : corners_su) {
        const glm::dvec3 place_m = at(corner.x, 0.0, corner.y);
        corners.emplace_back(place_m.x, place_m.z);
    }
    Stencil stencil = outline(corners, 1);
    stencil.facing = side * right;
    stencil.min_cosine = 0.3;
    return stencil;
}

PaintedSolid body() {
    const std::array<Section, 9> sections{stations.section(0.0, 0.10, 1.10, 0.86),
        stations.section(0.22, 0.38, 1.44, 0.60), stations.section(0.75, 0.66, 1.88, 0.38, 0.1, 0.05),
        stations.section(1.35, 0.76, roof_u, 0.29, 0.25, 0.12), stations.section(2.0, 0.78, roof_u, 0.27, 0.26, 0.15),
        stations.section(2.7, 0.72, roof_u, 0.33, 0.24, 0.12), stations.section(3.15, 0.56, 2.02, 0.62, 0.14, 0.06),
        stations.section(3.45, 0.38, 1.94, 0.98, 0.05, 0.02), stations.section(3.7, 0.20, 1.84, 1.42)};
    PaintedSolid solid = lofted(sections, body_sides, "olive");
    solid.push_back(section_cap(sections.front(), body_sides, true, "olive"));
    solid.push_back(section_cap(sections.back(), body_sides, false, "olive"));
    // The bubble, then its posts; windows of the doors.
    paint(
        solid, {{{{1.0, 0.0, 0.0}, -(1.95 - 1.22)}, {{-0.45, 0.0, -0.893}, -(0.893 * -0.48 + 0.45 * -1.2)}}}, "glass");
    for (const double side : {1.0, -1.0}) {
        paint(solid, on_side({{1.34, 1.06}, {1.34, 1.86}, {1.98, 1.90}, {1.98, 1.06}}, side), "glass");
        paint(solid, on_side({{2.10, 1.16}, {2.10, 1.90}, {2.62, 1.86}, {2.62, 1.20}}, side), "glass");
        for (const double s : {1.28, 2.04, 2.70}) { // edges of the doors
            paint(solid,
                on_side(
                    {{s, 0.52}, {s + stations.panel_line_m, 0.52}, {s + stations.panel_line_m, 1.98}, {s, 1.98}}, side),
                "line");
        }
        paint_roundel(solid, {{1.95 - 3.08, 1.20 - 1.28}, 0.17, {0.0, -1.0}, 1, side * right}, "insignia", "star");
    }
    paint(solid, {{{{1.0, 0.0, 0.0}, -(1.95 - 1.22)}, {right, 0.02}, {-right, 0.02}}}, "olive");
    stations.ring_line(solid, 3.15);
    return solid;
}

/// Floor, seats and two people behind the glass; the rear of the cabin.
void add_cabin(ModelBuilder& model) {
    model.add("cabin", box_between(at(0.55, -0.36, 0.62), at(2.6, 0.36, 0.86), "cabin"));
    model.add("cabin", box_between(at(1.62, -0.5, 0.87), at(2.55, 0.5, 1.72), "cabin"));
    for (const double side : {1.0, -1.0}) {
        const double r = 0.26 * side;
        model.add("cabin", box_between(at(1.2, r - 0.16, 0.87), at(1.52, r + 0.16, 1.46), "suit"));
        model.add("cabin", box_between(at(1.24, r - 0.1, 1.47), at(1.48, r + 0.1, 1.72), "helmet"));
    }
    model.add("cabin", box_between(at(0.66, -0.14, 0.87), at(0.78, 0.14, 1.16), "black"));
}

void add_fairing(ModelBuilder& model) {
    PaintedSolid solid = box_between(at(1.45, -0.24, roof_u), at(2.68, 0.24, 2.44), "olive");
    const auto bevel = [&](const glm::dvec3& normal, const glm::dvec3& through) {
        const glm::dvec3 unit = glm::normalize(normal);
        cut_off(solid, {unit, -glm::dot(unit, through)}, "olive");
    };
    bevel({-0.6, 0.0, 1.0}, at(1.75, 0.0, 2.44));
    bevel({0.45, 0.0, 1.0}, at(2.2, 0.0, 2.44));
    bevel({0.0, -1.0, 0.55}, at(0.0, 0.13, 2.44));
    bevel({0.0, 1.0, 0.55}, at(0.0, -0.13, 2.44));
    std::erase_if(solid, [](const PaintedFace& face) { // it stands on the roof
        return std::ranges::all_of(
            face.corners_m, [](const glm::dvec3& corner) { return corner.z > 1.20 - roof_u - 1e-6; });
    });
    stations.ring_line(solid, 2.1);
    model.add("fairing", solid);
    PaintedSolid mast = box_between(at(1.89, -0.06, 2.44), at(2.01, 0.06, rotor_u - 0.03), "black");
    model.add("mast", mast);
}

void add_tail(ModelBuilder& model) {
    const std::array<Section, 2> boom{
        stations.section(3.7, 0.17, 1.82, 1.46, 0.0, 0.0), stations.section(6.45, 0.09, 1.72, 1.52, 0.0, 0.0)};
    PaintedSolid tube = lofted(boom, 12, "olive");
    tube.push_back(section_cap(boom[1], 12, false, "olive"));
    for (const double s : {4.4, 5.4, 6.1}) { stations.ring_line(tube, s); }
    paint(tube, stripe(at(5.85, 0.0, 0.0), {1.0, 0.0, 0.0}, 0.12), "yellow");
    model.add("boom", tube);
    model.add("tail_gear", box_between(at(6.34, -0.20, 1.56), at(6.44, -0.11, 1.68), "black"));

    Aerofoil upper;
    upper.root_m = at(6.47, 0.0, 1.62);
    upper.root_chord_m = 0.62;
    upper.tip_m = at(6.62, 0.0, 2.40);
    upper.tip_chord_m = 0.46;
    upper.half_thickness_m = 0.04 * right;
    PaintedSolid fin = wing_solid(upper, "olive", "olive");
    const std::array<glm::dvec2, 4> panel{{{1.95 - 6.60, 1.20 - 2.06}, {1.95 - 6.95, 1.20 - 2.06},
        {1.95 - 6.95, 1.20 - 2.14}, {1.95 - 6.60, 1.20 - 2.14}}};
    for (const double side : {1.0, -1.0}) {
        Stencil number = outline(panel, 1);
        number.facing = side * right;
        paint(fin, number, "yellow");
    }
    model.add("fin", fin);
    Aerofoil lower = upper;
    lower.tip_m = at(6.55, 0.0, 0.88);
    lower.tip_chord_m = 0.36;
    model.add("fin", wing_solid(lower, "olive", "olive"));

    Aerofoil half;
    half.root_m = at(6.56, 0.0, 2.44);
    half.root_chord_m = 0.56;
    half.tip_m = at(6.66, 0.78, 2.44);
    half.tip_chord_m = 0.46;
    half.half_thickness_m = 0.025 * up;
    model.add_mirrored("stabiliser", wing_solid(half, "olive", "olive"));
    Aerofoil plate;
    plate.root_m = at(6.60, 0.81, 2.22);
    plate.root_chord_m = 0.40;
    plate.tip_m = at(6.78, 0.84, 2.72);
    plate.tip_chord_m = 0.26;
    plate.half_thickness_m = 0.015 * right;
    PaintedSolid end = wing_solid(plate, "olive", "olive");
    cut_off(end, {up, 1.20 - 2.23}, "olive");
    model.add_mirrored("end_plate", end);
}

/// A bar with four sides between two places; `wide` and `tall` reach from its middle to its sides.
PaintedSolid bar(const glm::dvec3& from_m, const glm::dvec3& to_m, const glm::dvec3& wide, const glm::dvec3& tall,
    const std::string& material) {
    const std::array<glm::dvec3, 4> offsets{wide + tall, wide - tall, -wide - tall, -wide + tall};
    PaintedSolid solid;
    const glm::dvec3 middle = 0.5 * (from_m + to_m);
    const auto add = [&](std::vector<glm::dvec3> corners) {
        glm::dvec3 centre(0.0);
        for (const glm::dvec3& corner : corners) { centre += corner / static_cast<double>(corners.size()); }
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (glm::dot(normal, centre - middle) < 0.0) { std::ranges::reverse(corners); }
        solid.push_back({std::move(corners), material});
    };
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const glm::dvec3& a = offsets[i];
        const glm::dvec3& b = offsets[(i + 1) % offsets.size()];
        add({from_m + a, from_m + b, to_m + b, to_m + a});
    }
    add({from_m + offsets[0], from_m + offsets[1], from_m + offsets[2], from_m + offsets[3]});
    add({to_m + offsets[0], to_m + offsets[1], to_m + offsets[2], to_m + offsets[3]});
    return solid;
}

void add_skids(ModelBuilder& model) {
    PaintedSolid skid = bar(at(0.25, 1.06, 0.05), at(2.72, 1.06, 0.05), 0.04 * right, 0.04 * up, "black");
    model.add_mirrored("skid", skid);
    const glm::dvec3 across = glm::normalize(glm::dvec3(-0.5, 0.0, -1.0));
    PaintedSolid toe = bar(at(0.02, 1.06, 0.19), at(0.25, 1.06, 0.05), 0.04 * right, 0.04 * across, "black");
    cut_off(toe, {{1.0, 0.0, 0.0}, -(1.95 - 0.25)}, "black");
    model.add_mirrored("skid", toe);
    for (const double s : {1.05, 2.25}) {
        PaintedSolid leg = bar(at(s, 0.40, 0.46), at(s, 1.06, 0.05), glm::dvec3(0.08, 0.0, 0.0),
            0.035 * glm::normalize(glm::dvec3(0.0, 0.41, -0.66)), "olive");
        cut_off(leg, {up, 1.20 - 0.092}, "olive");
        // Outside the body's lower side: its plane at 45 degrees.
        const glm::dvec3 out = glm::normalize(glm::dvec3(0.0, 1.0, 1.0));
        cut_off(leg, {out, -glm::dot(out, at(s, 0.62, 0.40))}, "olive");
        model.add_mirrored("leg", leg);
    }
}

void add_materials(ModelBuilder& model) {
    const std::vector<std::pair<std::string, glm::vec3>> materials{{"olive", {0.33F, 0.36F, 0.22F}},
        {"line", {0.22F, 0.24F, 0.15F}}, {"glass", {0.32F, 0.42F, 0.47F}}, {"cabin", {0.13F, 0.14F, 0.13F}},
        {"suit", {0.27F, 0.30F, 0.20F}}, {"helmet", {0.58F, 0.59F, 0.55F}}, {"black", {0.14F, 0.14F, 0.15F}},
        {"blade", {0.22F, 0.22F, 0.23F}}, {"yellow", {0.78F, 0.62F, 0.15F}}, {"insignia", {0.14F, 0.16F, 0.20F}},
        {"star", {0.70F, 0.71F, 0.66F}}};
    for (const auto& [name, colour] : materials) { model.add_material(name, colour); }
}

} // namespace

polygons::PolygonModel detailed_500md() {
    ModelBuilder model("500md-detailed");
    add_materials(model);
    add_cabin(model);
    model.add("body", body());
    add_fairing(model);
    add_tail(model);
    add_skids(model);
    add_rotors(model);
    return model.finish();
}

} // namespace octant::models::aircraft::test
