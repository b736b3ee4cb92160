#pragma once

#include "sim/base/random_generator.h"
#include "tests/fuzz/obj_polygons.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace octant::tests::fuzz {

/// All kinds: boxes, plates, curved surfaces, and these: "far" (any other, 1e6 m from the origin), "tiny" (1e-6 of the
/// size) and "huge" (1e6 times).
std::span<const std::string_view> kind_names();

/// The model of a kind and a seed: the same with every library and on every machine. Half of them are turned at random,
/// half are rounded to six decimals. Throws Error for a kind that is not there.
ObjPolygons made_model(std::string_view kind, std::uint64_t seed, int polygons);

} // namespace octant::tests::fuzz
