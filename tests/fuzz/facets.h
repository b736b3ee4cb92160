#pragma once

#include "models/polygons/polygon_model.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace octant::tests::fuzz {

/// Points and directions with 64 bits of mantissa: eleven more than those of the numbers checked.
using Vec = glm::vec<3, long double, glm::highp>;

/// A convex polygon as rays meet it. Places are measured from the model's middle, metres.
struct Facet {
    Vec normal{0.0L}; ///< unit; zero for a polygon without area
    Vec middle{0.0L};
    long double radius_m = 0.0L; ///< around `middle`
    std::vector<Vec> corners;
    long double bend_m = 0.0L;  ///< how far a corner lies off the plane, at most
    long double slack_m = 0.0L; ///< how far the polygon may be from where the model has it
    long double tilt = 0.0L;    ///< by what angle the plane may lean at that slack, radians
};

/// A model's polygons and its measures.
struct Facets {
    std::vector<Facet> all;     ///< one a polygon
    Vec middle_m{0.0L};         ///< of the bounding box, body axes
    long double size_m = 0.0L;  ///< its diagonal
    long double noise_m = 0.0L; ///< rounding of one coordinate, at most
};

/// The facets of a model. The slack of each is its own bend, its rounding and `slack_sizes` of the model's size; where
/// `bends_spread` also the bend of polygons that share a corner's place, since making those flat may move the corner. A
/// bent one leans then as far as its pieces may.
Facets facets_of(const models::polygons::PolygonModel& model, long double slack_sizes, bool bends_spread);

/// How a ray meets the front of a facet.
enum class Meeting {
    Missed,   ///< passes it, or comes from behind
    Doubtful, ///< within the margin of a side or of the plane
    Hit
};

struct Hit {
    Meeting meeting = Meeting::Missed;
    long double depth_m = 0.0L;  ///< along the ray
    long double margin_m = 0.0L; ///< of the depth: slack over the cosine of the angle of incidence
};

/// Meets a ray from `eye` (from the model's middle) in the unit direction `ray` with the front of a facet. Closer to a
/// side than the slack, seen along the ray, is doubtful.
Hit meet(const Facet& facet, const Vec& eye, const Vec& ray);

/// Whether a ray passes a side of a facet within the slack, whichever way the facet faces: slivers that a bent polygon
/// has there may face otherwise.
bool passes_side(const Facet& facet, const Vec& eye, const Vec& ray);

/// Whether two facets lie in one plane and are seen from the same side, both within `within_m`.
bool same_plane(const Facet& a, const Facet& b, long double within_m);

} // namespace octant::tests::fuzz
