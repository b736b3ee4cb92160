#pragma once

#include <string>

namespace octant::ui::base {

/// Version of the program, such as "0.1.0".
std::string program_version();

/// Commit it was built from, with "+" when the tree had changes: "5e974e81a0b1+". Of a source archive, the commit and a
/// checksum of the sources: "5e974e81a0b1-3f2a9c017d55"; of other sources without a .git folder "sources-3f2a9c017d55".
std::string program_commit();

/// A hash of the program file that runs, 16 hex digits: two programs of the same commit that were built from other
/// changes have others. Empty where it cannot be read.
std::string program_hash();

} // namespace octant::ui::base
