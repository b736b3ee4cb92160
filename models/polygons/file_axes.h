#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <string>
#include <string_view>

namespace octant::models::polygons {

/// The axes of a model file relative to the body axes (x forward, y right, z down). Files are right-handed: the
/// conversion is a rotation by quarter turns, exact in both directions.
class FileAxes {
public:
    /// The usual axes of OBJ files: x right, y up, -z forward.
    FileAxes() = default;

    /// Reads axes from text: the directions of the file's x, y and z axes, each one of right, left, up, down, forward,
    /// back, such as "right,up,back" (the default) or "forward,left,up". Throws Error for other text, for axes that do
    /// not span space and for left-handed ones.
    static FileAxes from_text(std::string_view text);

    glm::dvec3 body_from_file(const glm::dvec3& in_file) const;

    glm::dvec3 file_from_body(const glm::dvec3& in_body) const;

    /// The text that from_text reads back.
    std::string text() const;

private:
    /// Unit vectors of the file's axes, in body axes.
    std::array<glm::dvec3, 3> axes_{glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1), glm::dvec3(-1, 0, 0)};
};

/// The same axes with the nose at the other end: turned half round about the upward axis.
FileAxes nose_at_other_end(const FileAxes& axes);

} // namespace octant::models::polygons
