#pragma once

#include "sim/base/random_generator.h"

#include <span>
#include <string>

namespace octant::tests::formats {

/// One of the seeds with one to four faults: bits and bytes changed, numbers made huge, negative or none, words of the
/// format put in, pieces and lines taken out, doubled or swapped, the end cut off, the head of one seed before the tail
/// of another. At least one seed. Decided by the dice alone: the same everywhere.
std::string mutated(std::span<const std::string> seeds, std::span<const std::string> words, RandomGenerator& dice);

} // namespace octant::tests::formats
