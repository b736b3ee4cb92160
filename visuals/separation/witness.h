#pragma once

#include "sim/base/plane.h"
#include "visuals/separation/local_model.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::separation {

/// Factors of a sum of planes, in the unit of a LocalModel.
struct Factors {
    double earlier = 0.0;
    double later = 0.0;
    double one = 0.0;
    std::vector<double> walls;
};

/// The polygon of a pair whose plane alone decides it.
enum class Decider { Neither, Earlier, Later };

/// Whether the plane of one polygon proves that the earlier one hides nothing of the later one, for
/// eyes anywhere. Where both do it is `preferred`.
Decider
decider(const LocalModel& model, std::uint32_t earlier, std::uint32_t later, Decider preferred);

/// What proves that one polygon hides nothing of another that is painted later.
struct Witness {
    enum class Kind {
        Sum,   ///< A sum of planes has the earlier polygon behind it, the other one before it.
        Never, ///< No eye sees both.
        None   ///< No proof is found.
    };

    Kind kind = Kind::None;
    Factors factors;
};

/// Seeks a witness for the eyes before all of some planes.
Witness witness_of(
    const LocalModel& model,
    std::span<const Plane> walls,
    std::uint32_t earlier,
    std::uint32_t later);

/// Seeks factors which prove that a polygon faces away from all of these eyes.
std::optional<Factors>
factors_away(const LocalModel& model, std::span<const Plane> walls, std::uint32_t polygon);

} // namespace octant::visuals::separation
