#include "models/polygons/file_axes.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace octant::models::polygons {

namespace {

struct Direction {
    std::string_view name;
    glm::dvec3 in_body;
};

const std::array<Direction, 6> directions{Direction{"right", glm::dvec3(0, 1, 0)},
    Direction{"left", glm::dvec3(0, -1, 0)}, Direction{"up", glm::dvec3(0, 0, -1)},
    Direction{"down", glm::dvec3(0, 0, 1)}, Direction{"forward", glm::dvec3(1, 0, 0)},
    Direction{"back", glm::dvec3(-1, 0, 0)}};

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
    throw_error_in(
        "axes", fmt::format("expected where x, y and z point, such as right,up,back (of right, left, up, down, "
                            "forward, back), got '{}'{}",
                    printable(std::string(text)), why));
}

} // namespace

FileAxes FileAxes::from_text(std::string_view text) {
    const auto names = split_fields(text, ',');
    if (names.size() != 3) { refuse(text, ""); }
    FileAxes axes;
    for (std::size_t i = 0; i < 3; ++i) {
        bool known = false;
        for (const Direction& direction : directions) {
            if (direction.name == names[i]) {
                axes.axes_[i] = direction.in_body;
                known = true;
            }
        }
        if (!known) { refuse(text, ""); }
    }
    const double volume = glm::dot(glm::cross(axes.axes_[0], axes.axes_[1]), axes.axes_[2]);
    if (volume == 0.0) { refuse(text, ", where two axes lie on one line"); }
    if (volume < 0.0) { refuse(text, ", which is left-handed"); }
    return axes;
}

// Adding zero turns a negative zero into a plain one.
glm::dvec3 FileAxes::body_from_file(const glm::dvec3& in_file) const {
    return axes_[0] * in_file.x + axes_[1] * in_file.y + axes_[2] * in_file.z + 0.0;
}

glm::dvec3 FileAxes::file_from_body(const glm::dvec3& in_body) const {
    return glm::dvec3(glm::dot(axes_[0], in_body), glm::dot(axes_[1], in_body), glm::dot(axes_[2], in_body)) + 0.0;
}

std::string FileAxes::text() const {
    std::string text;
    for (const glm::dvec3& axis : axes_) {
        for (const Direction& direction : directions) {
            if (direction.in_body == axis) {
                text += text.empty() ? "" : ",";
                text += direction.name;
            }
        }
    }
    return text;
}

FileAxes nose_at_other_end(const FileAxes& axes) {
    const std::string before = axes.text();
    std::string text;
    for (const std::string_view name : split_fields(before, ',')) {
        text += text.empty() ? "" : ",";
        text += name == "forward" ? "back"
                : name == "back"  ? "forward"
                : name == "right" ? "left"
                : name == "left"  ? "right"
                                  : name;
    }
    return FileAxes::from_text(text);
}

} // namespace octant::models::polygons
