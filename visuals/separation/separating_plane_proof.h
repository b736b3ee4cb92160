#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::separation {

/// Lengths up to this are taken for none, in longest sides of the model's bounding box: builders decide by 1e-9 of its
/// radius, a point from a plane and a polygon's own width alike.
inline constexpr double tolerance_sizes = 2e-9;

/// The tolerances with which a proof is sought, one after the other. Larger ones are for bent polygons, whose parts
/// meet at a hair; those beyond 5e-8, still less than the last of six digits, for planes that are parallel but for such
/// a digit: some eyes 1e5 sizes away are before two of them that face away from one another.
inline constexpr std::array proof_tolerances_sizes = {tolerance_sizes, 1e-8, 5e-8, 2.5e-7, 8e-7};

/// A line about which polygons turn; `along` is a unit vector.
struct LocalAxis {
    glm::dvec3 point{0.0};
    glm::dvec3 along{0.0};
};

/// A polygon in the form in which separating planes are sought.
struct LocalPolygon {
    Plane plane;
    std::vector<glm::dvec3> corners;
    std::optional<std::uint32_t> axis;
    bool keeps_plane = true; ///< It does not turn, or about an axis across its plane.
    /// Points whose hull holds all that the polygon sweeps; the corners if it does not turn.
    std::vector<glm::dvec3> swept;
};

/// A model in the axes of its file, about the middle of its bounding box, with the longest side of the box as unit.
struct LocalModel {
    glm::dvec3 middle_m{0.0}; ///< In the file's axes.
    double size_m = 1.0;
    /// From where certificates measure, in the file's axes: the origin or, of a model so far from it that the rounding
    /// of planes would count in a sum of them, the middle.
    glm::dvec3 reference_m{0.0};
    double tolerance = tolerance_sizes; ///< Of the certificate.
    std::vector<LocalAxis> axes;        ///< One for each pivot.
    std::vector<LocalPolygon> polygons;

    Plane from_file(const Plane& plane_m) const;
    /// A plane of the file with its offset from reference_m.
    Plane about(const Plane& plane_m) const;
    /// The same of a plane of this model.
    Plane in_metres(const Plane& plane) const;
};

/// Where it is within the tolerance, pieces of one polygon share the plane of the largest, which is the one known best,
/// and polygons that turn in their own plane have their axis as normal.
LocalModel local_model(const models::polygons::PolygonModel& model, const models::polygons::FileAxes& axes,
    double tolerance = tolerance_sizes);

/// Whether no corner, at any angle where `turns`, is before a plane by more than the tolerance.
bool is_behind(const LocalModel& model, std::uint32_t polygon, const Plane& plane, bool turns);

inline bool is_before(const LocalModel& model, std::uint32_t polygon, const Plane& plane, bool turns) {
    return is_behind(model, polygon, turned_over(plane), turns);
}

/// Values of a matrix game: what each choice gives in each case, case after case. The factors of a sum of planes are
/// found as such a game, in which a choice is a plane and a case is a point that the sum must have on one side.
struct Payoffs {
    std::size_t choices = 0;
    std::vector<double> values;

    std::size_t cases() const { return choices == 0 ? 0 : values.size() / choices; }
};

/// The shares of the choices, >= 0 with the sum 1, for which the worst case gives most (a game of two against one
/// another: J. von Neumann, "Zur Theorie der Gesellschaftsspiele", 1928). Meant for up to some dozens of choices and
/// cases with values of about 1; as exact as rounding allows. As many shares as can be are 0. There is at least one of
/// each (asserted). The same payoffs always give the same shares.
std::vector<double> best_shares(const Payoffs& payoffs);

/// Factors of a sum of planes, in the unit of a LocalModel.
struct PlaneFactors {
    double earlier = 0.0;
    double later = 0.0;
    double one = 0.0;
    std::vector<double> region_planes;
};

/// The polygon of a pair whose plane alone decides it.
enum class DecidingPolygon { Neither, Earlier, Later };

/// Whether the plane of one polygon proves that the earlier one hides nothing of the later one, for eyes anywhere.
/// Where both do it is `preferred`.
DecidingPolygon deciding_polygon(
    const LocalModel& model, std::uint32_t earlier, std::uint32_t later, DecidingPolygon preferred);

/// What proves that one polygon hides nothing of another that is painted later.
struct SeparatingPlaneProof {
    enum class Kind {
        Sum,   ///< A sum of planes has the earlier polygon behind it, the other one before it.
        Never, ///< No eye sees both.
        None   ///< No proof is found.
    };

    Kind kind = Kind::None;
    PlaneFactors factors;
};

/// Seeks a separating plane for the eyes in front of all of some planes.
SeparatingPlaneProof find_separating_plane(
    const LocalModel& model, std::span<const Plane> region_planes, std::uint32_t earlier, std::uint32_t later);

/// Seeks factors which prove that a polygon faces away from all of these eyes.
std::optional<PlaneFactors> find_back_facing_proof(
    const LocalModel& model, std::span<const Plane> region_planes, std::uint32_t polygon);

} // namespace octant::visuals::separation
