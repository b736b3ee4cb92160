#pragma once

#include "sim/base/random_generator.h"
#include "tests/fuzz/obj_polygons.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace octant::tests::fuzz {

/// A way to make models that are hard to order.
struct Kind {
    std::string_view name;
    std::string_view meaning;
    /// About `polygons` polygons, at least enough for the shape, about 2 m large, around the origin.
    Soup (*make)(RandomGenerator& dice, int polygons);
};

std::span<const Kind> box_kinds();
std::span<const Kind> plate_kinds();
std::span<const Kind> curved_kinds();

/// All kinds, the three above and these: "far" (any other, 1e6 m from the origin), "tiny" (1e-6 of the size) and "huge"
/// (1e6 times).
std::span<const std::string_view> kind_names();

/// The model of a kind and a seed: the same with every library and on every machine. Half of them are turned at random,
/// half are rounded to six decimals. Throws Error for a kind that is not there.
ObjPolygons made_model(std::string_view kind, std::uint64_t seed, int polygons);

} // namespace octant::tests::fuzz
