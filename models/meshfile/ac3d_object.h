#pragma once

#include "models/meshfile/affine_transform.h"
#include "models/meshfile/read_options.h"
#include "models/invalid_index.h"

#include <cstdint>
#include <string>

namespace octant::models::meshfile {

/// What the options say of an object of an AC3D file and of all that hangs on it.
struct Ac3dObject {
    bool is_excluded = false;
    bool is_placeholder = false; ///< left out as what is no surface (ReadOptions::placeholders)
    std::uint32_t group = invalid_index;
    AffineTransform moved; ///< of places in the file
};

/// Of an object of this name that hangs on another.
Ac3dObject
object_settings(const std::string& name, const Ac3dObject& holder, const ReadOptions& options);

} // namespace octant::models::meshfile
