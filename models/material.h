#pragma once

#include <glm/vec3.hpp>

#include <string>

namespace octant::models {

/// A named surface colour.
struct Material {
    std::string name;
    glm::vec3 colour{0.7F}; ///< red, green, blue: display values 0..1 (models/display_colour.h)
};

} // namespace octant::models
