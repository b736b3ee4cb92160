#pragma once

#include "sim/base/plane.h"
#include "visuals/separation/local_model.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::separation {

/// What each choice gives in each case, case after case.
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

/// Seeks a witness for the eyes before all of some planes.
SeparatingPlaneProof find_separating_plane(
    const LocalModel& model, std::span<const Plane> region_planes, std::uint32_t earlier, std::uint32_t later);

/// Seeks factors which prove that a polygon faces away from all of these eyes.
std::optional<PlaneFactors> find_back_facing_proof(
    const LocalModel& model, std::span<const Plane> region_planes, std::uint32_t polygon);

} // namespace octant::visuals::separation
