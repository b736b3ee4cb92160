// F-15C Eagle by stations: s = metres aft of the nose tip, r = to the right, u = above the wing-level reference
// line. The origin lies at s = 10.40, u = 0.11, as in f15.obj, which names the sources of the main dimensions
// (length 19.43, span 13.05, fin tips 3.40 up, sweep, chords, canopy, intake lips, nozzles, stabilators). From
// photographs: 2-degree cant of the fins, nozzle exit of about 1 m, boundary layer gap of the intakes (general
// knowledge of the type).
//
// Planes that separate its parts: the deck u = 0.36 (canopy, spine and fins above), r = 1.73 (wings, booms and
// stabilators outside), s = 8.2 (forebody and intakes ahead), s = 17.2 (nozzles behind), r = 0.74 between forebody and
// intakes.

#include "tests/models/aircraft/aircraft_builder.h"
#include "tests/models/aircraft/detailed_aircraft.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace octant::models::aircraft::test {

namespace {

constexpr double deck_u = 0.36;
constexpr double side_r = 1.73;
constexpr Stations f15_stations{10.40, 0.11, 0.03};

glm::dvec3 f15_at(double s, double r, double u) { return f15_stations.at(s, r, u); }

Section pipe(double s, double r, double radius) {
    const glm::dvec3 middle_m = f15_at(s, r, -0.22);
    return {middle_m.x, middle_m.y, middle_m.z, radius, radius, radius, 0.0, 0.0};
}

/// Booms, stabilators and fins.
void add_f15_tail(ModelBuilder& model) {
    PaintedSolid boom = box_between(f15_at(14.45, side_r, -0.20), f15_at(18.6, 2.13, 0.32), "grey");
    const glm::dvec3 taper = glm::normalize(glm::dvec3(1.0, -0.45, 0.0));
    cut_off(boom, {taper, -glm::dot(taper, f15_at(18.6, 1.86, 0.0))}, "grey");
    const glm::dvec3 nose = glm::normalize(glm::dvec3(-1.0, -0.9, 0.0));
    cut_off(boom, {nose, -glm::dot(nose, f15_at(14.45, 1.80, 0.0))}, "grey");
    f15_stations.ring_line(boom, 16.0);
    model.add_mirrored("boom", boom);

    Aerofoil stabilator;
    stabilator.root_m = f15_at(15.75, 2.15, -0.02);
    stabilator.root_chord_m = 2.95;
    stabilator.tip_m = f15_at(18.20, 4.30, -0.06);
    stabilator.tip_chord_m = 1.15;
    stabilator.half_thickness_m = 0.075 * up;
    PaintedSolid plane = wing_solid(stabilator, "wing", "under");
    Stencil rib = stripe(f15_at(0.0, 2.7, 0.0), right, f15_stations.panel_line_m);
    paint(plane, rib, "line");
    model.add_mirrored("stabilator", plane);

    Aerofoil fin;
    fin.root_m = f15_at(14.75, 1.86, deck_u + 0.002);
    fin.root_chord_m = 3.15;
    fin.tip_m = f15_at(17.35, 1.97, 3.40);
    fin.tip_chord_m = 1.15;
    fin.half_thickness_m = 0.09 * right;
    PaintedSolid upright = wing_solid(fin, "fin", "fin");
    paint(upright, {{{up, 0.11 - 3.18}, {down, -(0.11 - 3.36)}}}, "band");
    paint(upright, stripe(f15_at(0.0, 0.0, 2.2), up, f15_stations.panel_line_m), "line");
    const glm::dvec3 hinge = (fin.tip_m - glm::dvec3(0.72 * fin.tip_chord_m, 0.0, 0.0)) -
                             (fin.root_m - glm::dvec3(0.72 * fin.root_chord_m, 0.0, 0.0));
    Stencil rudder = stripe(fin.root_m - glm::dvec3(0.72 * fin.root_chord_m, 0.0, 0.0), {hinge.z, 0.0, -hinge.x},
        f15_stations.panel_line_m);
    paint(upright, rudder, "line");
    for (int letter = 0; letter < 2; ++letter) { // the wing's code, two letters F
        const double s = 16.45 + 0.34 * letter;
        const auto bar = [&](double s0, double s1, double u0, double u1) {
            const std::array<glm::dvec2, 4> corners{
                {{10.4 - s0, 0.11 - u0}, {10.4 - s1, 0.11 - u0}, {10.4 - s1, 0.11 - u1}, {10.4 - s0, 0.11 - u1}}};
            Stencil stencil = outline(corners, 1);
            stencil.facing = right;
            paint(upright, stencil, "code");
        };
        bar(s, s + 0.07, 1.55, 2.0);
        bar(s + 0.07, s + 0.26, 1.93, 2.0);
        bar(s + 0.07, s + 0.2, 1.76, 1.83);
    }
    model.add_mirrored("fin", upright);
}

/// The right engine's nozzle: outside, rim and the hot inside, whose faces look at the axis.
PaintedSolid nozzle() {
    constexpr int sides = 16;
    constexpr double r = 0.76;
    const std::array<Section, 3> outer{pipe(17.2, r, 0.60), pipe(18.0, r, 0.60), pipe(18.8, r, 0.48)};
    PaintedSolid solid = lofted(outer, sides, "metal");
    paint(solid, stripe(f15_at(18.0, 0.0, 0.0), {1.0, 0.0, 0.0}, 0.05), "dark");
    const std::array<Section, 2> inner{pipe(17.75, r, 0.40), pipe(18.8, r, 0.45)};
    for (PaintedFace face : lofted(inner, sides, "hot")) {
        std::ranges::reverse(face.corners_m);
        solid.push_back(face);
    }
    solid.push_back(section_cap(inner[0], sides, false, "burner"));
    const PaintedFace wide = section_cap(outer[2], sides, false, "metal");
    const PaintedFace narrow = section_cap(inner[1], sides, false, "metal");
    for (std::size_t i = 0; i < wide.corners_m.size(); ++i) {
        const std::size_t next = (i + 1) % wide.corners_m.size();
        solid.push_back(
            {{wide.corners_m[i], wide.corners_m[next], narrow.corners_m[next], narrow.corners_m[i]}, "metal"});
    }
    return solid;
}

constexpr int f15_body_sides = 12;

/// A section above the deck: half an ellipse.
Section hood(double s, double half, double rise, double flat = 0.0) {
    const glm::dvec3 middle_m = f15_at(s, 0.0, deck_u);
    return {middle_m.x, 0.0, middle_m.z, half, rise, 0.0, flat, 0.0};
}

PaintedSolid forebody() {
    const std::array<Section, 6> sections{f15_stations.section(0.0, 0.0, -0.43, -0.43),
        f15_stations.section(0.55, 0.2, -0.24, -0.60, 0.02, 0.02),
        f15_stations.section(1.6, 0.44, 0.02, -0.79, 0.08, 0.06),
        f15_stations.section(3.2, 0.62, deck_u, -0.92, 0.34, 0.14),
        f15_stations.section(4.9, 0.69, deck_u, -0.95, 0.57, 0.2),
        f15_stations.section(8.2, 0.72, deck_u, -0.95, 0.60, 0.3)};
    PaintedSolid solid = lofted(sections, f15_body_sides, "grey");
    paint(solid, {{{{1.0, 0.0, 0.0}, -(10.40 - 1.55)}}}, "radome");
    for (const double s : {1.55, 2.5, 3.15, 4.9, 6.4}) { f15_stations.ring_line(solid, s); }
    // The tub under the canopy, the gun's and the nose gear's panels, the national marking.
    const std::array<glm::dvec2, 6> tub{{{10.4 - 3.8, -0.2}, {10.4 - 3.8, 0.2}, {10.4 - 4.5, 0.4}, {10.4 - 7.2, 0.4},
        {10.4 - 7.2, -0.4}, {10.4 - 4.5, -0.4}}};
    Stencil inside = outline(tub, 2);
    inside.facing = up;
    inside.min_cosine = 0.9;
    paint(solid, inside, "tub");
    const std::array<glm::dvec2, 4> door{
        {{10.4 - 4.3, -0.28}, {10.4 - 4.3, 0.28}, {10.4 - 6.1, 0.28}, {10.4 - 6.1, -0.28}}};
    Stencil gear = outline(door, 2);
    gear.facing = down;
    gear.min_cosine = 0.9;
    paint(solid, gear, "panel");
    for (const double side : {1.0, -1.0}) {
        paint_roundel(solid, {{10.4 - 3.95, 0.25}, 0.24, {0.0, -1.0}, 1, side * right}, "insignia", "white");
    }
    return solid;
}

PaintedSolid canopy() {
    const std::array<Section, 5> sections{hood(3.35, 0.10, 0.02), hood(4.35, 0.46, 0.62, 0.06),
        hood(5.2, 0.53, 0.84, 0.06), hood(6.3, 0.53, 0.80, 0.06), hood(7.3, 0.47, 0.56, 0.06)};
    PaintedSolid solid = lofted(sections, f15_body_sides, "glass");
    std::erase_if(solid, [](const PaintedFace& face) { // the underside lies on the deck
        return std::ranges::all_of(
            face.corners_m, [](const glm::dvec3& corner) { return corner.z > 0.11 - deck_u - 1e-6; });
    });
    paint(solid, stripe(f15_at(4.35, 0.0, 0.0), {1.0, 0.0, 0.12}, 0.09), "frame");
    paint(solid, stripe(f15_at(7.24, 0.0, 0.0), {1.0, 0.0, 0.0}, 0.12), "frame");
    paint(solid, {{{{0.0, 0.0, 1.0}, -(0.11 - deck_u - 0.07)}}}, "frame"); // the sill
    return solid;
}

/// Seat, pilot and the hood over the panel: boxes under the glass.
void add_cockpit(ModelBuilder& model) {
    PaintedSolid hood_box = box_between(f15_at(4.0, -0.3, deck_u), f15_at(4.62, 0.3, 0.72), "tub");
    const glm::dvec3 slope = glm::normalize(glm::dvec3(-0.5, 0.0, 1.0));
    cut_off(hood_box, {slope, -glm::dot(slope, f15_at(4.62, 0.0, 0.72))}, "tub");
    model.add("cockpit", hood_box);
    model.add("cockpit", box_between(f15_at(4.86, -0.21, deck_u), f15_at(5.2, 0.21, 0.80), "suit"));
    const std::array<Section, 4> helmet{f15_stations.section(4.90, 0.06, 0.99, 0.88),
        f15_stations.section(4.96, 0.12, 1.07, 0.82), f15_stations.section(5.10, 0.13, 1.09, 0.82),
        f15_stations.section(5.18, 0.09, 1.05, 0.84)};
    PaintedSolid head = lofted(helmet, 8, "helmet");
    head.push_back(section_cap(helmet.front(), 8, true, "tub"));
    head.push_back(section_cap(helmet.back(), 8, false, "helmet"));
    model.add("cockpit", head);
    model.add("cockpit", box_between(f15_at(5.22, -0.25, deck_u), f15_at(5.55, 0.25, 1.02), "seat"));
    model.add("cockpit", box_between(f15_at(6.1, -0.35, deck_u), f15_at(7.1, 0.35, 0.62), "tub"));
}

void add_spine(ModelBuilder& model) {
    const std::array<std::array<Section, 2>, 2> pieces{{{hood(7.3, 0.47, 0.56, 0.06), hood(9.6, 0.42, 0.26, 0.06)},
        {hood(9.6, 0.42, 0.26, 0.06), hood(14.0, 0.22, 0.03, 0.03)}}};
    for (const auto& piece : pieces) {
        PaintedSolid solid = lofted(piece, f15_body_sides, "grey");
        std::erase_if(solid, [](const PaintedFace& face) {
            return std::ranges::all_of(
                face.corners_m, [](const glm::dvec3& corner) { return corner.z > 0.11 - deck_u - 1e-6; });
        });
        for (const double s : {8.4, 10.8}) { f15_stations.ring_line(solid, s); }
        model.add("spine", solid);
    }
}

PaintedSolid f15_body() {
    const std::array<Section, 5> sections{f15_stations.section(8.2, 1.50, deck_u, -0.95, 1.2, 0.4),
        f15_stations.section(9.6, side_r - 0.01, deck_u, -0.95, 1.4, 0.42),
        f15_stations.section(14.4, side_r - 0.01, deck_u, -0.95, 1.4, 0.42),
        f15_stations.section(16.2, 1.66, deck_u, -0.86, 1.2, 0.3),
        f15_stations.section(17.2, 1.50, 0.30, -0.74, 0.9, 0.2)};
    PaintedSolid solid = lofted(sections, f15_body_sides, "grey");
    solid.push_back(section_cap(sections.front(), f15_body_sides, true, "panel"));
    solid.push_back(section_cap(sections.back(), f15_body_sides, false, "metal"));
    for (const double s : {10.1, 12.2, 14.4, 16.2}) { f15_stations.ring_line(solid, s); }
    paint(solid, {{{{-1.0, 0.0, 0.0}, 10.40 - 16.2 - 0.02}}}, "metal"); // bare around the engines
    for (const double side : {1.0, -1.0}) {
        Stencil seam = stripe(f15_at(0.0, side * 0.72, 0.0), right, f15_stations.panel_line_m);
        seam.facing = up;
        seam.min_cosine = 0.7;
        paint(solid, seam, "line");
        const std::array<glm::dvec2, 4> bay{{{10.4 - 10.4, side * 0.85}, {10.4 - 10.4, side * 1.35},
            {10.4 - 12.0, side * 1.35}, {10.4 - 12.0, side * 0.85}}};
        Stencil gear = outline(bay, 2);
        gear.facing = down;
        gear.min_cosine = 0.9;
        paint(solid, gear, "panel");
    }
    return solid;
}

PaintedSolid intake() {
    PaintedSolid solid = box_between(f15_at(5.2, 0.80, -0.95), f15_at(8.2, 1.48, deck_u), "grey");
    // Chamfered lower and upper outer edges, then the raked mouth.
    for (const double sign : {1.0, -1.0}) {
        const glm::dvec3 across = glm::normalize(glm::dvec3(0.0, -1.0, sign));
        const double u = sign > 0.0 ? deck_u : -0.95;
        cut_off(solid, {across, -glm::dot(across, f15_at(0.0, 1.34, u))}, "grey");
    }
    const glm::dvec3 rake = glm::normalize(f15_at(6.75, 0.0, -0.95) - f15_at(5.5, 0.0, deck_u));
    const glm::dvec3 aft = glm::normalize(glm::dvec3(rake.z, 0.0, -rake.x));
    const glm::dvec3 inward = aft.x < 0.0 ? aft : -aft;
    cut_off(solid, {inward, -glm::dot(inward, f15_at(5.5, 0.0, deck_u))}, "lip");
    const std::array<glm::dvec2, 4> mouth{
        {{0.86, 0.11 - 0.28}, {1.30, 0.11 - 0.28}, {1.40, 0.11 + 0.80}, {0.86, 0.11 + 0.88}}};
    Stencil dark = outline(mouth, 0);
    dark.facing = -inward;
    dark.min_cosine = 0.9;
    paint(solid, dark, "dark");
    std::erase_if(solid, [](const PaintedFace& face) { // its rear lies on the body
        return std::ranges::all_of(
            face.corners_m, [](const glm::dvec3& corner) { return corner.x < 10.40 - 8.2 + 1e-6; });
    });
    f15_stations.ring_line(solid, 7.3);
    Stencil ramp = stripe(f15_at(6.3, 0.0, 0.0), {1.0, 0.0, 0.0}, f15_stations.panel_line_m);
    ramp.facing = up;
    ramp.min_cosine = 0.9;
    paint(solid, ramp, "line");
    return solid;
}

PaintedSolid wing() {
    Aerofoil shape;
    shape.root_m = f15_at(8.40, side_r, 0.12);
    shape.root_chord_m = 5.58;
    shape.tip_m = f15_at(13.19, 6.525, 0.04);
    shape.tip_chord_m = 1.74;
    shape.half_thickness_m = 0.14 * up;
    PaintedSolid solid = wing_solid(shape, "wing", "under");
    const glm::dvec3 tip_edge = f15_at(13.75, 6.525, 0.0) - f15_at(12.71, 6.05, 0.0);
    const glm::dvec3 inward = glm::normalize(glm::dvec3(tip_edge.y, -tip_edge.x, 0.0));
    const glm::dvec3 kept = inward.y < 0.0 ? inward : -inward;
    cut_off(solid, {kept, -glm::dot(kept, f15_at(12.71, 6.05, 0.0))}, "under");
    // Flap and aileron hinges at 0.78 of the chord, spars, ribs.
    const auto along = [&](double share) {
        const glm::dvec3 root = shape.root_m - glm::dvec3(share * shape.root_chord_m, 0.0, 0.0);
        const glm::dvec3 tip = shape.tip_m - glm::dvec3(share * shape.tip_chord_m, 0.0, 0.0);
        const glm::dvec3 line = tip - root;
        return stripe(root, {line.y, -line.x, 0.0}, f15_stations.panel_line_m);
    };
    paint(solid, along(0.78), "line");
    paint(solid, along(0.1), "line");
    for (const double r : {3.05, 4.75}) {
        Stencil rib = stripe(f15_at(0.0, r, 0.0), right, f15_stations.panel_line_m);
        paint(solid, rib, "line");
    }
    return solid;
}

void add_wings(ModelBuilder& model) {
    PaintedSolid right_wing = wing();
    PaintedSolid left_wing = right_wing;
    const glm::dvec2 place(10.4 - 12.35, 4.05);
    // On the upper left and the lower right, as the regulations have it; mirrored, r is positive.
    paint_roundel(left_wing, {place, 0.5, {1.0, 0.0}, 2, up}, "insignia", "white");
    paint_roundel(right_wing, {place, 0.5, {1.0, 0.0}, 2, down}, "insignia", "white");
    model.add("wing_right", right_wing);
    model.add("wing_left", mirrored(left_wing));
}

void add_f15_materials(ModelBuilder& model) {
    const std::vector<std::pair<std::string, glm::vec3>> materials{{"radome", {0.45F, 0.47F, 0.50F}},
        {"grey", {0.55F, 0.58F, 0.62F}}, {"line", {0.42F, 0.44F, 0.48F}}, {"panel", {0.50F, 0.53F, 0.57F}},
        {"tub", {0.09F, 0.10F, 0.11F}}, {"suit", {0.30F, 0.33F, 0.26F}}, {"helmet", {0.62F, 0.63F, 0.62F}},
        {"seat", {0.16F, 0.16F, 0.17F}}, {"glass", {0.34F, 0.46F, 0.56F}}, {"frame", {0.47F, 0.50F, 0.54F}},
        {"lip", {0.50F, 0.53F, 0.57F}}, {"dark", {0.06F, 0.06F, 0.07F}}, {"metal", {0.30F, 0.29F, 0.28F}},
        {"hot", {0.15F, 0.13F, 0.12F}}, {"burner", {0.10F, 0.08F, 0.08F}}, {"wing", {0.60F, 0.63F, 0.67F}},
        {"under", {0.54F, 0.57F, 0.61F}}, {"fin", {0.57F, 0.60F, 0.65F}}, {"band", {0.20F, 0.30F, 0.52F}},
        {"code", {0.25F, 0.27F, 0.30F}}, {"insignia", {0.17F, 0.22F, 0.36F}}, {"white", {0.82F, 0.84F, 0.86F}}};
    for (const auto& [name, colour] : materials) { model.add_material(name, colour); }
}

} // namespace

polygons::PolygonModel detailed_f15() {
    ModelBuilder model("f15-detailed");
    add_f15_materials(model);
    model.add("forebody", forebody());
    model.add_mirrored("intake", intake());
    model.add("body", f15_body());
    add_wings(model);
    add_f15_tail(model);
    model.add_mirrored("nozzle", nozzle());
    add_cockpit(model);
    add_spine(model);
    model.add("canopy", canopy());
    return model.finish();
}

} // namespace octant::models::aircraft::test
