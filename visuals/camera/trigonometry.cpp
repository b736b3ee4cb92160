#include "visuals/camera/trigonometry.h"

#include "sim/base/units.h"

#include <cmath>

namespace octant::visuals::camera {

double angle_of(double along, double across) {
    if (along < 0.0) { return pi - angle_of(-along, across); }
    const double length = std::sqrt(along * along + across * across);
    if (length == 0.0) { return 0.0; }
    // Three times the half angle: the tangent is below 0.2 then.
    double tangent = across / (length + along);
    for (int i = 0; i < 2; ++i) { tangent /= 1.0 + std::sqrt(1.0 + tangent * tangent); }
    const double square = tangent * tangent;
    double sum = 0.0;
    for (int power = 23; power >= 1; power -= 2) { sum = 1.0 / power - square * sum; }
    return 8.0 * tangent * sum;
}

glm::dvec2 cosine_and_sine(double angle_rad) {
    const double part = std::remainder(angle_rad, 2.0 * pi) / 8.0;
    const double square = part * part;
    // sin x / x, and (1 - cos x) / x^2, which keeps small angles exact.
    double sine = 0.0;
    double versine = 0.0;
    for (int n = 9; n >= 0; --n) {
        sine = 1.0 - square / ((2 * n + 2) * (2 * n + 3)) * sine;
        versine = 1.0 - square / ((2 * n + 3) * (2 * n + 4)) * versine;
    }
    sine *= part;
    versine *= 0.5 * square;
    for (int i = 0; i < 3; ++i) {
        const double whole_versine = 2.0 * sine * sine;
        sine = 2.0 * sine * (1.0 - versine);
        versine = whole_versine;
    }
    return {1.0 - versine, sine};
}

glm::dquat rotation_by(const glm::dvec3& turn_rad) {
    const double angle_rad = std::sqrt(turn_rad.x * turn_rad.x + turn_rad.y * turn_rad.y + turn_rad.z * turn_rad.z);
    if (angle_rad == 0.0) { return {1.0, 0.0, 0.0, 0.0}; }
    const glm::dvec2 half = cosine_and_sine(angle_rad / 2.0);
    const glm::dvec3 axis = turn_rad * (half.y / angle_rad);
    return {half.x, axis.x, axis.y, axis.z};
}

} // namespace octant::visuals::camera
