#pragma once

#include "tests/fuzz/obj_polygons.h"
#include "tests/fuzz/trial.h"

namespace octant::tests::fuzz {

struct ReductionLimits {
    int trials = 400;
    double wall_s = 120.0;
};

/// A model that fails as `outcome` tells with fewer polygons: halves, quarters, ... and single ones are left out as
/// long as what stays fails in the same way.
ObjPolygons reduced(
    ObjPolygons model, Outcome outcome, const TrialOptions& options, const ReductionLimits& limits = {});

} // namespace octant::tests::fuzz
