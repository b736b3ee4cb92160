#pragma once

#include "visuals/verify/certificate.h"
#include "visuals/verify/exact_sides.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::verify {

/// The eyes of a list or node: what is before all of these planes.
using RegionPlanes = std::vector<WrittenPlane>;

/// Judges witnesses; README.md says why each one proves what it claims. Throws Refusal for those
/// that do not. Keeps references.
class PairCheck {
public:
    PairCheck(const Certificate& certificate, const ExactSides& sides)
        : certificate_(certificate)
        , sides_(sides) {}

    /// That the plane of the earlier polygon has the later one before it.
    void check_earlier(const PolygonPair& pair, int line) const;

    /// That the plane of the later polygon has the earlier one behind it.
    void check_later(const PolygonPair& pair, int line) const;

    /// What a claim says for the eyes before all walls; of Kind::Unproved nothing is asked.
    void check(const PairStatement& statement, const RegionPlanes& region_planes) const;

    /// That a polygon faces away from every eye before all walls.
    void check_away(std::uint32_t polygon, const BackFacingStatement& statement, const RegionPlanes& region_planes) const;

private:
    /// Factors that are claimed for a pair.
    struct Sum {
        const PolygonPair& pair;
        PartAngle pose;
        const StatedFactors& factors;
        const RegionPlanes& region_planes;
        int line;
    };

    PartAngle pose_of(const PolygonPair& pair) const;
    void require_fixed_plane(std::uint32_t polygon, PartAngle pose, int line) const;
    ExactPlane plane_of(const Sum& sum) const;
    void check_separates(const Sum& sum) const;
    void check_never(const Sum& sum) const;

    const Certificate& certificate_;
    const ExactSides& sides_;
};

} // namespace octant::visuals::verify
