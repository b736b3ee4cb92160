#include "visuals/draworder/octant_path.h"

#include <cassert>
#include <cmath>

namespace octant::visuals::draworder {

namespace {

/// Where one axis of a coordinate system points in another one: along which axis, and whether in the opposite
/// direction.
struct AxisPlace {
    std::size_t axis = 0;
    bool turned_round = false;
};

AxisPlace place_of(const glm::dvec3& unit) {
    for (int i = 0; i < 3; ++i) {
        if (std::abs(unit[i]) > 0.5) { return {static_cast<std::size_t>(i), unit[i] < 0.0}; }
    }
    assert(false);
    return {};
}

/// Converts an octant path to other axes. Signs move with their axes. Children 0, 1, 2 are those at the corners on x,
/// y, z, and the corners of each child are named alike, so that every level changes in the same way.
template <typename ToOther>
std::string with_axes_changed(const std::string& path, ToOther to_other) {
    assert(is_octant_path(path));
    std::string out = path;
    std::array<AxisPlace, 3> places;
    for (std::size_t i = 0; i < 3; ++i) {
        glm::dvec3 unit(0.0);
        unit[static_cast<int>(i)] = 1.0;
        places[i] = place_of(to_other(unit));
        out[places[i].axis] = (path[i] == '-') != places[i].turned_round ? '-' : '+';
    }
    for (std::size_t at = 4; at < path.size(); at += 2) {
        const auto child = static_cast<std::size_t>(path[at] - '0');
        if (child < 3) { out[at] = static_cast<char>('0' + places[child].axis); }
    }
    return out;
}

} // namespace

bool is_octant_path(std::string_view text) {
    if (text.size() < 3 || text.size() % 2 == 0 || text.size() > 3 + 2 * max_path_levels) { return false; }
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool good = i < 3        ? text[i] == '+' || text[i] == '-'
                          : i % 2 == 1 ? text[i] == '/'
                                       : text[i] >= '0' && text[i] <= '3';
        if (!good) { return false; }
    }
    return true;
}

std::array<OctantTriangle, 4> subdivided(const OctantTriangle& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 ab = (a + b) / 2.0;
    const glm::dvec3 bc = (b + c) / 2.0;
    const glm::dvec3 ca = (c + a) / 2.0;
    return {{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}};
}

OctantTriangle octant_triangle(std::string_view path) {
    assert(is_octant_path(path));
    OctantTriangle corners{};
    for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = glm::dvec3(0.0);
        corners[i][static_cast<int>(i)] = path[i] == '+' ? 1.0 : -1.0;
    }
    for (std::size_t at = 4; at < path.size(); at += 2) {
        corners = subdivided(corners)[static_cast<std::size_t>(path[at] - '0')];
    }
    return corners;
}

std::string path_in_file(const std::string& path, const models::polygons::FileAxes& axes) {
    return with_axes_changed(path, [&](const glm::dvec3& v) { return axes.file_from_body(v); });
}

std::string path_in_body(const std::string& path, const models::polygons::FileAxes& axes) {
    return with_axes_changed(path, [&](const glm::dvec3& v) { return axes.body_from_file(v); });
}

} // namespace octant::visuals::draworder
