#include "models/meshfile/vrml_fields.h"

#include "models/meshfile/vrml_tokenizer.h"
#include "models/meshfile/word_scanner.h"
#include "sim/base/error.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <fmt/format.h>

namespace octant::models::meshfile {

namespace {

constexpr double max_rad = 1e6;

/// The matrix that turns by an angle around an axis, the right hand's way.
glm::dmat3 turned_about(const glm::dvec3& axis, double angle_rad) {
    const double length = glm::length(axis);
    if (!(length > 0.0)) {
        return glm::dmat3(1.0);
    }
    const glm::dvec3 a = axis / length;
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const auto image = [&](const glm::dvec3& v) {
        return v * c + glm::cross(a, v) * s + a * (glm::dot(a, v) * (1.0 - c));
    };
    return {image({1.0, 0.0, 0.0}), image({0.0, 1.0, 0.0}), image({0.0, 0.0, 1.0})};
}

} // namespace

std::vector<double> VrmlFields::numbers(
    const VrmlNode& node, std::string_view name, std::vector<double> otherwise) const {
    const VrmlField* field = node.field(name);
    if (field == nullptr) {
        return otherwise;
    }
    VrmlTokenizer words(path_, field->text, field->line);
    for (double& value : otherwise) {
        value = words.number(name);
    }
    return otherwise;
}

glm::dvec3
VrmlFields::vector(const VrmlNode& node, std::string_view name, const glm::dvec3& otherwise) const {
    const auto v = numbers(node, name, {otherwise.x, otherwise.y, otherwise.z});
    return {v[0], v[1], v[2]};
}

glm::dmat3 VrmlFields::turn(const VrmlNode& node, std::string_view name) const {
    const auto v = numbers(node, name, {0.0, 0.0, 1.0, 0.0});
    if (std::abs(v[3]) > max_rad) {
        throw_error_at(path_, node.line, fmt::format("expected an angle in radians, got {}", v[3]));
    }
    return turned_about({v[0], v[1], v[2]}, v[3]);
}

/// translation * center * rotation * scaleOrientation * scale * -scaleOrientation * -center.
AffineTransform VrmlFields::placement(const VrmlNode& node) const {
    const glm::dvec3 centre_m = vector(node, "center", glm::dvec3(0.0));
    const glm::dvec3 scale = vector(node, "scale", glm::dvec3(1.0));
    const glm::dmat3 slant = turn(node, "scaleOrientation");
    glm::dmat3 scaled(1.0);
    for (int part = 0; part < 3; ++part) {
        scaled[part][part] = scale[part];
    }
    AffineTransform made;
    made.turn = turn(node, "rotation");
    if (scale != glm::dvec3(1.0)) {
        made.turn = made.turn * slant * scaled * glm::transpose(slant);
    }
    made.shift_m = vector(node, "translation", glm::dvec3(0.0)) + centre_m - made.turn * centre_m;
    return made;
}

const VrmlNode* VrmlFields::only_node(const VrmlNode& node, std::string_view name) const {
    const VrmlField* field = node.field(name);
    return field == nullptr || field->nodes.empty() ? nullptr : &file_.nodes[field->nodes.front()];
}

std::uint32_t VrmlFields::place_of(const VrmlNode& node) const {
    return static_cast<std::uint32_t>(&node - file_.nodes.data());
}

bool VrmlFields::flag(const VrmlNode& node, std::string_view name) const {
    const VrmlField* field = node.field(name);
    if (field == nullptr || field->text == "TRUE") {
        return true;
    }
    if (field->text != "FALSE") {
        throw_error_at(path_, field->line, "expected TRUE or FALSE, got " + in_quotes(field->text));
    }
    return false;
}

std::vector<long> VrmlFields::indices(const VrmlNode& node, std::string_view name) const {
    std::vector<long> found;
    if (const VrmlField* field = node.field(name)) {
        VrmlTokenizer words(path_, field->text, field->line);
        while (!words.peek().empty()) {
            found.push_back(words.whole("a whole number"));
        }
    }
    return found;
}

std::vector<glm::dvec3>
VrmlFields::triples(const VrmlNode& set, std::string_view field_name, std::string_view name) const {
    std::vector<glm::dvec3> found;
    const VrmlNode* node = only_node(set, field_name);
    const VrmlField* field = node == nullptr ? nullptr : node->field(name);
    if (field == nullptr) {
        return found;
    }
    VrmlTokenizer words(path_, field->text, field->line);
    while (!words.peek().empty()) {
        const double x = words.number("a number");
        const double y = words.number("a number");
        const double z = words.number("a number");
        found.emplace_back(x, y, z);
    }
    return found;
}

} // namespace octant::models::meshfile
