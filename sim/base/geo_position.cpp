#include "sim/base/geo_position.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace octant {

namespace {

struct Body {
    std::string_view name;
    double semi_major_m;
};

/// Sizes of the IAU's working group on cartographic coordinates (B. A. Archinal and others, 2018).
constexpr std::array bodies = {Body{"the earth", wgs84.semi_major_m}, Body{"the Moon", 1737400.0},
    Body{"Mars", 3396190.0}, Body{"Mercury", 2440530.0}, Body{"Venus", 6051800.0}, Body{"Io", 1829400.0},
    Body{"Europa", 1562600.0}, Body{"Ganymede", 2631200.0}, Body{"Callisto", 2410300.0}, Body{"Titan", 2575150.0},
    Body{"Triton", 1352600.0}, Body{"Pluto", 1188300.0}, Body{"Ceres", 487300.0}};

bool is_size_of(const Body& body, const Ellipsoid& ellipsoid, double tolerance) {
    return std::abs(ellipsoid.semi_major_m / body.semi_major_m - 1.0) <= tolerance;
}

} // namespace

double Ellipsoid::mean_radius_m() const { return 1000.0 * std::round((2.0 * semi_major_m + semi_minor_m()) / 3000.0); }

bool Ellipsoid::is_earth() const { return is_size_of(bodies.front(), *this, 0.01); }

std::string name_of_body(const Ellipsoid& ellipsoid) {
    const auto body =
        std::ranges::find_if(bodies, [&](const Body& each) { return is_size_of(each, ellipsoid, 0.005); });
    return body != bodies.end() ? std::string(body->name)
                                : fmt::format("a body with a radius of {:.0f} km", 1e-3 * ellipsoid.semi_major_m);
}

} // namespace octant
