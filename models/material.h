#pragma once

#include <glm/vec3.hpp>

#include <string>

namespace octant::models {

/// A surface colour, linear parts 0..1 of red, green, blue.
struct Material {
    std::string name;
    glm::vec3 colour{0.7F};
};

} // namespace octant::models
