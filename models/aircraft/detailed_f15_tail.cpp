#include "models/aircraft/detailed_f15_frame.h"
#include "models/aircraft/stencil.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace octant::models::aircraft::f15 {

namespace {

Section pipe(double s, double r, double radius) {
    const glm::dvec3 middle_m = at(s, r, -0.22);
    return {middle_m.x, middle_m.y, middle_m.z, radius, radius, radius, 0.0, 0.0};
}

} // namespace

void add_tail(ModelBuilder& model) {
    PaintedSolid boom = box_between(at(14.45, side_r, -0.20), at(18.6, 2.13, 0.32), "grey");
    const glm::dvec3 taper = glm::normalize(glm::dvec3(1.0, -0.45, 0.0));
    cut_off(boom, {taper, -glm::dot(taper, at(18.6, 1.86, 0.0))}, "grey");
    const glm::dvec3 nose = glm::normalize(glm::dvec3(-1.0, -0.9, 0.0));
    cut_off(boom, {nose, -glm::dot(nose, at(14.45, 1.80, 0.0))}, "grey");
    stations.ring_line(boom, 16.0);
    model.add_mirrored("boom", boom);

    Aerofoil stabilator;
    stabilator.root_m = at(15.75, 2.15, -0.02);
    stabilator.root_chord_m = 2.95;
    stabilator.tip_m = at(18.20, 4.30, -0.06);
    stabilator.tip_chord_m = 1.15;
    stabilator.half_thickness_m = 0.075 * up;
    PaintedSolid plane = wing_solid(stabilator, "wing", "under");
    Stencil rib = stripe(at(0.0, 2.7, 0.0), right, stations.panel_line_m);
    paint(plane, rib, "line");
    model.add_mirrored("stabilator", plane);

    Aerofoil fin;
    fin.root_m = at(14.75, 1.86, deck_u + 0.002);
    fin.root_chord_m = 3.15;
    fin.tip_m = at(17.35, 1.97, 3.40);
    fin.tip_chord_m = 1.15;
    fin.half_thickness_m = 0.09 * right;
    PaintedSolid upright = wing_solid(fin, "fin", "fin");
    paint(upright, {{{up, 0.11 - 3.18}, {down, -(0.11 - 3.36)}}}, "band");
    paint(upright, stripe(at(0.0, 0.0, 2.2), up, stations.panel_line_m), "line");
    const glm::dvec3 hinge = (fin.tip_m - glm::dvec3(0.72 * fin.tip_chord_m, 0.0, 0.0)) -
                             (fin.root_m - glm::dvec3(0.72 * fin.root_chord_m, 0.0, 0.0));
    Stencil rudder = stripe(
        fin.root_m - glm::dvec3(0.72 * fin.root_chord_m, 0.0, 0.0), {hinge.z, 0.0, -hinge.x}, stations.panel_line_m);
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

PaintedSolid nozzle() {
    constexpr int sides = 16;
    constexpr double r = 0.76;
    const std::array<Section, 3> outer{pipe(17.2, r, 0.60), pipe(18.0, r, 0.60), pipe(18.8, r, 0.48)};
    PaintedSolid solid = lofted(outer, sides, "metal");
    paint(solid, stripe(at(18.0, 0.0, 0.0), {1.0, 0.0, 0.0}, 0.05), "dark");
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

} // namespace octant::models::aircraft::f15
