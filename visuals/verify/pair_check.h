#pragma once

#include "visuals/verify/certificate.h"
#include "visuals/verify/sides.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::verify {

/// The eyes of a list or node: what is before all of these planes.
using Walls = std::vector<WrittenPlane>;

/// Judges witnesses; README.md says why each one proves what it claims. Throws Refusal for those
/// that do not. Keeps references.
class PairCheck {
public:
    PairCheck(const Certificate& certificate, const Sides& sides)
        : certificate_(certificate)
        , sides_(sides) {}

    /// That the plane of the earlier polygon has the later one before it.
    void check_earlier(const Pair& pair, int line) const;

    /// That the plane of the later polygon has the earlier one behind it.
    void check_later(const Pair& pair, int line) const;

    /// What a claim says for the eyes before all walls; of Kind::Unproved nothing is asked.
    void check(const PairClaim& claim, const Walls& walls) const;

    /// That a polygon faces away from every eye before all walls.
    void check_away(std::uint32_t polygon, const AwayClaim& claim, const Walls& walls) const;

private:
    /// Factors that are claimed for a pair.
    struct Sum {
        const Pair& pair;
        Pose pose;
        const Factors& factors;
        const Walls& walls;
        int line;
    };

    Pose pose_of(const Pair& pair) const;
    void expect_front(std::uint32_t polygon, Pose pose, int line) const;
    ExactPlane plane_of(const Sum& sum) const;
    void check_separates(const Sum& sum) const;
    void check_never(const Sum& sum) const;

    const Certificate& certificate_;
    const Sides& sides_;
};

} // namespace octant::visuals::verify
