#pragma once

#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <span>
#include <string>
#include <vector>

namespace octant::models::aircraft {

/// One polygon of a solid: convex, planar, counter-clockwise seen from outside. Body axes.
struct PaintedFace {
    std::vector<glm::dvec3> corners_m;
    std::string material;
};

/// A closed or open surface that is put together from convex solids; its faces are painted by cutting them along
/// planes, so that no two polygons lie over one another.
using PaintedSolid = std::vector<PaintedFace>;

/// A cross-section square to the body's x axis: half an ellipse above and half an ellipse below its middle, both
/// widened by a flat part. Sections with the same number of sides have parallel sides, so that what joins two of them
/// is planar.
struct Section {
    double x_m = 0.0;
    double y_m = 0.0;          ///< middle
    double z_m = 0.0;          ///< middle
    double half_width_m = 0.0; ///< 0 with the rest: a point
    double up_m = 0.0;
    double down_m = 0.0;
    double flat_m = 0.0; ///< of half_width_m: as far as the top and the bottom are flat
    double side_m = 0.0; ///< of up_m and of down_m: as far as the sides are upright
};

/// The sides of a body through sections, front first, without its ends. `sides`: a multiple of 4.
PaintedSolid lofted(std::span<const Section> sections, int sides, const std::string& material);

/// The end of such a body: the polygon of a section, seen from ahead or from astern.
PaintedFace section_cap(const Section& section, int sides, bool ahead, const std::string& material);

/// A box between two corners, body axes.
PaintedSolid box_between(const glm::dvec3& a_m, const glm::dvec3& b_m, const std::string& material);

/// Wing, fin or stabilator: `root` and `tip` are its leading edges, `chord_m` reaches aft from them. `root_side` and
/// `tip_side`: half of the thickness, a vector square to the chord. The section has six sides; taper and thickness
/// shrink alike, so that all faces are planar: `tip` ones follow from the root's by tip chord over root chord.
struct Aerofoil {
    glm::dvec3 root_m{0.0};
    double root_chord_m = 1.0;
    glm::dvec3 tip_m{0.0};
    double tip_chord_m = 1.0;
    glm::dvec3 half_thickness_m{0.0}; ///< at the root
};

/// All faces but the root's. Two materials: of the side that half_thickness_m points to, and of the other side and the
/// edges.
PaintedSolid wing_solid(const Aerofoil& shape, const std::string& material, const std::string& other);

/// Cuts a convex solid off behind a plane and closes it there.
void cut_off(PaintedSolid& solid, const Plane& plane, const std::string& material);

/// The same seen in the mirror y = 0.
PaintedSolid mirrored(const PaintedSolid& solid);

} // namespace octant::models::aircraft
