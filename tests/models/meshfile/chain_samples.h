#pragma once

#include "models/meshfile/level_chain.h"

#include <string>

namespace octant::models::meshfile::test {

/// The coloured cube, a tetrahedron and one square with a pivot.
LevelChain sample_chain();

/// The bytes of a chain file with the size and the checksum that belong to them.
std::string sealed(std::string bytes);

} // namespace octant::models::meshfile::test
