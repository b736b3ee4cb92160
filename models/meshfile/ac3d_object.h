#pragma once

#include "models/meshfile/placement.h"
#include "models/meshfile/read_options.h"
#include "models/no_index.h"

#include <cstdint>
#include <string>

namespace octant::models::meshfile {

/// What the options say of an object of an AC3D file and of all that hangs on it.
struct Ac3dObject {
    bool is_left_out = false;
    bool stands_in = false; ///< left out as what is no surface (ReadOptions::stand_ins)
    std::uint32_t group = no_index;
    Placement moved; ///< of places in the file
};

/// Of an object of this name that hangs on another.
Ac3dObject
object_called(const std::string& name, const Ac3dObject& holder, const ReadOptions& options);

} // namespace octant::models::meshfile
