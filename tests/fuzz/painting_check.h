#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/ordered_model.h"

#include <cstdint>
#include <string>

namespace octant::tests::fuzz {

/// By how much each polygon may be off, in sizes of the model (diagonals of its bounding box), when a painting order is
/// held against its own model. Hits closer than that to a side, seen along the ray, are left open, and so are depths
/// that two polygons so far off could have in common.
inline constexpr double order_margin_sizes = 1e-9;
/// The same when the picture is held against the model that was given: what making polygons flat and welding vertices
/// may move, besides how bent they are.
inline constexpr double picture_margin_sizes = 2e-6;

struct RaySamples {
    int rays = 4000;
    std::uint64_t seed = 1;
};

/// What rays found. A ray that none of the counts of faults has was right or `open`.
struct PaintingCounts {
    long rays = 0;
    long hits = 0;          ///< rays that meet the given model for sure
    long open = 0;          ///< within a margin of a side, of a plane's edge-on view or of equal depth
    long wrong_order = 0;   ///< another polygon of the ordered model is nearer than the one seen
    long wrong_picture = 0; ///< seen is a piece of another polygon than the nearest one given
    long wrong_decal = 0;   ///< seen is the earlier one of two that lie in one plane
    /// Eyes whose sequence repeats a polygon or names one that is not there.
    long bad_sequences = 0;
    std::string first; ///< the first fault in words; empty if there is none
};

/// Casts rays from eyes inside, near and far (some close to polygons and to their planes) and compares what is painted
/// last along each with what is nearest, in the ordered model and in the given one. Shares no code with the builder.
PaintingCounts check_painting(const models::polygons::PolygonModel& given,
    const visuals::draworder::OrderedModel& ordered, const RaySamples& samples);

} // namespace octant::tests::fuzz
