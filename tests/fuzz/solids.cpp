#include "tests/fuzz/solids.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace octant::tests::fuzz {

glm::dmat3 attitude_along(const glm::dvec3& along) {
    const glm::dvec3 x = glm::normalize(along);
    const glm::dvec3 aside = std::abs(x.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 y = glm::normalize(glm::cross(aside, x));
    return {x, y, glm::cross(x, y)};
}

glm::dmat3 any_attitude(RandomGenerator& dice) {
    const glm::dvec3 x = dice.direction();
    const glm::dvec3 y = glm::normalize(glm::cross(dice.direction(), x));
    return {x, y, glm::cross(x, y)};
}

void add_box(Soup& soup, const glm::dvec3& centre, const glm::dmat3& axes, const glm::dvec3& half_m) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const int next = (axis + 1) % 3;
            const int last = (axis + 2) % 3;
            std::vector<glm::dvec3> face;
            constexpr std::array<std::array<double, 2>, 4> ways{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
            for (const auto& way : ways) {
                glm::dvec3 at(0.0);
                at[axis] = side * half_m[axis];
                at[next] = way[0] * half_m[next];
                at[last] = side * way[1] * half_m[last];
                face.push_back(centre + axes * at);
            }
            soup.push_back(face);
        }
    }
}

void add_disc(Soup& soup, const glm::dvec3& centre, const glm::dmat3& axes, double radius_m, int corners) {
    std::vector<glm::dvec3> polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle_rad = 2.0 * pi * i / corners;
        polygon.push_back(
            centre + axes * glm::dvec3(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), 0.0));
    }
    soup.push_back(polygon);
}

void add_backs(Soup& soup) {
    const std::size_t count = soup.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<glm::dvec3> back(soup[i].rbegin(), soup[i].rend());
        soup.push_back(back);
    }
}

} // namespace octant::tests::fuzz
