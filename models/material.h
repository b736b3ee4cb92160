#pragma once

#include <glm/vec3.hpp>

#include <memory>
#include <string>

namespace octant::models {

/// A named surface colour, perhaps with a picture.
struct Material {
    std::string name;
    glm::vec3 colour{0.7F}; ///< red, green, blue: display values 0..1 (models/srgb.h)
    /// The file of the picture that texture coordinates point into, or the name of one that stands in the mesh's own
    /// file; empty = none.
    std::string picture = {};
    /// The encoded picture where it stands in the mesh's own file, else null.
    std::shared_ptr<const std::string> picture_bytes = {};
};

} // namespace octant::models
