// Rotors of the detailed 500MD: blades are two faces in one plane, so that no plane need part them.

#include "models/aircraft/detailed_500md_frame.h"
#include "models/aircraft/model_builder.h"
#include "models/aircraft/painted_solid.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/units.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace octant::models::aircraft {

namespace {

using namespace md500;

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

} // namespace

void md500::add_rotors(ModelBuilder& model) {
    add_main_rotor(model);
    add_tail_rotor(model);
}

} // namespace octant::models::aircraft
