#include "models/meshfile/flightgear_numbers.h"

#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/word_scanner.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

glm::dvec3 vector_in(
    const std::filesystem::path& file,
    const XmlElement& parent,
    const std::array<std::string_view, 3>& names) {
    return {
        number_in(file, parent, names[0]),
        number_in(file, parent, names[1]),
        number_in(file, parent, names[2])};
}

} // namespace

double number_in(
    const std::filesystem::path& file,
    const XmlElement& parent,
    std::string_view name,
    double without) {
    const XmlElement* found = parent.find(name);
    if (found == nullptr || found->text.empty()) {
        return without;
    }
    const auto value = finite_number(found->text);
    if (!value || std::abs(*value) > max_coordinate) {
        throw_error_at(file, found->line, "expected a number, got " + in_quotes(found->text));
    }
    return *value;
}

double interpolated(const std::filesystem::path& file, const XmlElement& animation, double value) {
    const XmlElement* table = animation.find("interpolation");
    std::vector<std::pair<double, double>> entries;
    for (std::size_t i = 0; table != nullptr && i < table->children.size(); ++i) {
        const XmlElement& entry = table->children[i];
        entries.emplace_back(number_in(file, entry, "ind"), number_in(file, entry, "dep"));
    }
    std::ranges::sort(entries);
    const auto next =
        std::ranges::upper_bound(entries, value, {}, [](const auto& entry) { return entry.first; });
    if (entries.empty()) {
        return value;
    }
    if (next == entries.begin() || next == entries.end()) {
        return next == entries.begin() ? next->second : entries.back().second;
    }
    const auto& [from, start] = *std::prev(next);
    return start + (value - from) / (next->first - from) * (next->second - start);
}

RotationAxis axis_in(const std::filesystem::path& file, const XmlElement& animation) {
    RotationAxis about;
    about.direction = glm::dvec3(0.0);
    if (const XmlElement* axis = animation.find("axis")) {
        if (axis->find("x1-m") != nullptr || axis->find("x2-m") != nullptr) {
            about.point_m = vector_in(file, *axis, {"x1-m", "y1-m", "z1-m"});
            about.direction = vector_in(file, *axis, {"x2-m", "y2-m", "z2-m"}) - about.point_m;
        } else {
            about.direction = vector_in(file, *axis, {"x", "y", "z"});
        }
    }
    if (const XmlElement* centre = animation.find("center")) {
        about.point_m = vector_in(file, *centre, {"x-m", "y-m", "z-m"});
    }
    return about;
}

} // namespace octant::models::meshfile
