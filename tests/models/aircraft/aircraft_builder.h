#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace octant::models::aircraft::test {

/// The corners of a convex polygon, in order. Body axes: x forward, y right, z down; metres.
using Outline = std::vector<glm::dvec3>;

/// Corners that are closer together are one corner.
inline constexpr double coincident_distance_m = 1e-6;

/// The normal of the side from which the corners run counter-clockwise. Its length is the area in square metres.
glm::dvec3 area_vector(const Outline& corners);

/// Whether the outline is more than a line or a point.
bool has_area(const Outline& corners);

/// Removes each corner at the place of the corner before it.
Outline without_duplicates(const Outline& corners);

/// The part of an outline in front of a plane; fewer than three corners if there is no such part.
Outline in_front(const Outline& corners, const Plane& plane);

/// One polygon of a solid: convex, planar, counter-clockwise seen from outside. Body axes.
struct PaintedFace {
    std::vector<glm::dvec3> corners_m;
    std::string material;
};

/// The faces of convex solids. A face is painted by cuts along planes, thus no two polygons overlap.
using PaintedSolid = std::vector<PaintedFace>;

/// A cross-section perpendicular to the body's x axis: half an ellipse above and half an ellipse below its middle, both
/// widened by a flat part. Sections with the same number of sides have parallel sides, thus faces between two sections
/// are planar.
struct Section {
    double x_m = 0.0;
    double y_m = 0.0;          ///< y of the middle
    double z_m = 0.0;          ///< z of the middle
    double half_width_m = 0.0; ///< 0, like all other sizes: a point
    double up_m = 0.0;
    double down_m = 0.0;
    double flat_m = 0.0; ///< half width of the flat top and bottom, part of half_width_m
    double side_m = 0.0; ///< height of the vertical sides, part of up_m and of down_m
};

/// The sides of a body through sections, front first, without its ends. `sides`: a multiple of 4.
PaintedSolid lofted(std::span<const Section> sections, int sides, const std::string& material);

/// The end of a lofted body: the polygon of a section, seen from ahead or from astern.
PaintedFace section_cap(const Section& section, int sides, bool ahead, const std::string& material);

/// A box between two corners, body axes.
PaintedSolid box_between(const glm::dvec3& a_m, const glm::dvec3& b_m, const std::string& material);

/// A wing, fin or stabilator. `root_m` and `tip_m` are points of its leading edge; the chords run aft from them. The
/// thickness shrinks with the chord, thus all faces are planar.
struct Aerofoil {
    glm::dvec3 root_m{0.0};
    double root_chord_m = 1.0;
    glm::dvec3 tip_m{0.0};
    double tip_chord_m = 1.0;
    glm::dvec3 half_thickness_m{0.0}; ///< at the root, perpendicular to the chord
};

/// All faces except the root's. `material` is for the side that half_thickness_m points to, `other` for the other side
/// and the edges.
PaintedSolid wing_solid(const Aerofoil& shape, const std::string& material, const std::string& other);

/// Removes the part of a convex solid behind a plane and closes the cut with a face.
void cut_off(PaintedSolid& solid, const Plane& plane, const std::string& material);

/// The mirror image at the plane y = 0.
PaintedSolid mirrored(const PaintedSolid& solid);

/// Where to paint: the region in front of all planes, on faces whose normal has at least the cosine `min_cosine` to
/// `facing`; on all faces if `facing` is zero.
struct Stencil {
    std::vector<Plane> planes;
    glm::dvec3 facing{0.0};
    double min_cosine = 0.2;
};

/// Cuts faces along the stencil and gives the pieces inside it a material.
void paint(PaintedSolid& solid, const Stencil& stencil, const std::string& material);

/// A line of a given width along the plane through a point with the normal `across`.
Stencil stripe(const glm::dvec3& point_m, const glm::dvec3& across, double width_m);

/// The region inside a convex outline seen along a body axis (0 = x, 1 = y, 2 = z). Corners are given by the two other
/// coordinates, clockwise or counter-clockwise.
Stencil outline(std::span<const glm::dvec2> corners_m, int axis);

/// A star in a disc, seen along an axis as in outline().
struct Roundel {
    glm::dvec2 middle_m{0.0};
    double radius_m = 0.5;
    glm::dvec2 to_top{1.0, 0.0}; ///< unit vector
    int axis = 2;
    glm::dvec3 facing{0.0};
};

void paint_roundel(PaintedSolid& solid, const Roundel& roundel, const std::string& disc, const std::string& star);

/// Coordinates of aircraft drawings, metres: station behind the nose, distance to the right, height above a reference
/// line.
struct Stations {
    /// Body x of station 0, and body z of height 0.
    double nose_m = 0.0;
    double line_down_m = 0.0;
    /// The width of a panel line.
    double panel_line_m = 0.02;

    /// The body axes of station `s`, distance to the right `r` and height `u`.
    glm::dvec3 at(double s, double r, double u) const { return {nose_m - s, r, line_down_m - u}; }

    /// A section between two heights with the half width `half`; `flat` and `side` as in Section.
    Section section(double s, double half, double top_u, double bottom_u, double flat = 0.0, double side = 0.0) const;

    /// Paints a panel line around a solid at a station.
    void ring_line(PaintedSolid& solid, double s) const;
};

inline const glm::dvec3 up(0.0, 0.0, -1.0);
inline const glm::dvec3 down(0.0, 0.0, 1.0);
inline const glm::dvec3 right(0.0, 1.0, 0.0);

/// Collects solids into a polygon model.
class ModelBuilder {
public:
    explicit ModelBuilder(std::string name);

    /// One of the name "glass" is a mirror.
    void add_material(const std::string& name, const glm::vec3& colour);

    /// Adds the faces to a part. Their materials must have been added before (asserted).
    void add(const std::string& part, const PaintedSolid& solid);

    /// Adds a solid and its mirror image as the parts NAME_right and NAME_left.
    void add_mirrored(const std::string& part, const PaintedSolid& right_side);

    /// Makes a part turn.
    void add_pivot(const std::string& part, const polygons::Pivot& pivot);

    /// Corners at one place become one vertex, and each polygon gets the vertices on its sides, which prevents cracks.
    polygons::PolygonModel finish();

private:
    std::uint32_t vertex_at(const glm::dvec3& at_m);
    std::uint32_t part_of(const std::string& name);

    polygons::PolygonModel model_;
    std::vector<std::vector<std::uint32_t>> outlines_; ///< vertices of each polygon
};

} // namespace octant::models::aircraft::test
