#include "sim/base/earth_frame.h"

#include "sim/base/axes.h"
#include "sim/base/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
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

FramePosition EarthFrame::place_of(const GeoPosition& place) const {
    const double aside_deg = place.latitude_deg > 0.0 ? -1e-4 : 1e-4; // 11 m, away from the pole
    const glm::dvec2 at_m = local_from_geo(place);
    const glm::dvec2 beside_m = local_from_geo({place.latitude_deg + aside_deg, place.longitude_deg});
    const glm::dvec2 north_m = aside_deg > 0.0 ? beside_m - at_m : at_m - beside_m;
    return {at_m, std::atan2(north_m.x, north_m.y)};
}

// C. F. F. Karney, "Transverse Mercator with an accuracy of a few nanometers", Journal of Geodesy 85, 2011: eqs. 7 to 9
// (conformal latitude), 11 to 15 and 35, 36 (Krueger's series, here to the fourth order), 19 to 21 (latitude from the
// conformal one).
//
// Deviations: places more than about 84 degrees of arc from the meridian are drawn that far off it, where the paper's
// map goes to infinity.

namespace {

/// Of xi and eta, radians: beyond, the series loses its sense.
constexpr double furthest_across = 3.0;
constexpr double furthest_along = 10.0;

using Series = TransverseMercator::Series;

/// xi + i eta, along and across, brought from one form of the earth to the other: the series' sines of 2, 4, 6 and 8
/// zeta are summed by Clenshaw's rule.
std::complex<double> brought(const std::complex<double>& zeta, const Series& series) {
    const std::complex<double> twice_cosine = 2.0 * std::cos(2.0 * zeta);
    std::complex<double> sum;
    std::complex<double> before;
    for (std::size_t j = series.size(); j-- > 0;) {
        const std::complex<double> next = series.at(j) + twice_cosine * sum - before;
        before = sum;
        sum = next;
    }
    return zeta + sum * std::sin(2.0 * zeta);
}

/// Tangent of the conformal latitude from that of the geodetic one.
double conformal(double tau, double e2) {
    const double e = std::sqrt(e2);
    const double length = std::hypot(1.0, tau);
    const double sigma = std::sinh(e * std::atanh(e * tau / length));
    return tau * std::hypot(1.0, sigma) - sigma * length;
}

double geodetic(double conformal_tau, double e2) {
    double tau = conformal_tau / (1.0 - e2);
    for (int i = 0; i < 5; ++i) { // Newton's: three do
        const double now = conformal(tau, e2);
        const double length = std::hypot(1.0, tau);
        const double change =
            (conformal_tau - now) / std::hypot(1.0, now) * (1.0 + (1.0 - e2) * tau * tau) / ((1.0 - e2) * length);
        tau += change;
    }
    return tau;
}

} // namespace

TransverseMercator::TransverseMercator(const GeoPosition& origin) : origin_(origin) {
    const double flattening = origin.ellipsoid.flattening;
    const double n = flattening / (2.0 - flattening);
    const double n2 = n * n;
    const double n3 = n2 * n;
    const double n4 = n2 * n2;
    mean_radius_m_ = origin.ellipsoid.semi_major_m / (1.0 + n) * (1.0 + n2 / 4.0 + n4 / 64.0);
    from_sphere_ = {n / 2.0 - 2.0 / 3.0 * n2 + 5.0 / 16.0 * n3 + 41.0 / 180.0 * n4,
        13.0 / 48.0 * n2 - 3.0 / 5.0 * n3 + 557.0 / 1440.0 * n4, 61.0 / 240.0 * n3 - 103.0 / 140.0 * n4,
        49561.0 / 161280.0 * n4};
    to_sphere_ = {-n / 2.0 + 2.0 / 3.0 * n2 - 37.0 / 96.0 * n3 + 1.0 / 360.0 * n4,
        -1.0 / 48.0 * n2 - 1.0 / 15.0 * n3 + 437.0 / 1440.0 * n4, -17.0 / 480.0 * n3 + 37.0 / 840.0 * n4,
        -4397.0 / 161280.0 * n4};
    north_of_equator_m_ = project(origin.latitude_deg, 0.0).real();
}

std::complex<double> TransverseMercator::project(double latitude_deg, double away_rad) const {
    const double tau = conformal(std::tan(rad_from_deg(latitude_deg)), origin_.ellipsoid.e2());
    const double length = std::hypot(1.0, tau);
    const double most = std::tanh(furthest_across);
    const double across = std::clamp(std::sin(away_rad) / length, -most, most);
    const std::complex<double> on_sphere(std::atan2(tau, std::cos(away_rad)), std::atanh(across));
    return mean_radius_m_ * brought(on_sphere, from_sphere_);
}

glm::dvec2 TransverseMercator::local_from_geo(const GeoPosition& place) const {
    const double away_rad = wrapped_to_pi(rad_from_deg(place.longitude_deg - origin_.longitude_deg));
    const std::complex<double> at_m = project(place.latitude_deg, away_rad);
    return {at_m.imag(), at_m.real() - north_of_equator_m_};
}

GeoPosition TransverseMercator::geo_from_local(const glm::dvec2& east_north_m) const {
    const double along = (east_north_m.y + north_of_equator_m_) / mean_radius_m_;
    const double across = east_north_m.x / mean_radius_m_;
    const std::complex<double> on_sphere = brought(
        {std::clamp(along, -furthest_along, furthest_along), std::clamp(across, -furthest_across, furthest_across)},
        to_sphere_);
    const double beside = std::sinh(on_sphere.imag());
    const double ahead = std::cos(on_sphere.real());
    const double from_pole = std::hypot(beside, ahead);
    constexpr double at_pole = 1e-14;
    const double tau = std::sin(on_sphere.real()) / std::max(from_pole, at_pole);
    const double longitude_deg = origin_.longitude_deg + deg_from_rad(std::atan2(beside, ahead));
    return {std::clamp(deg_from_rad(std::atan(geodetic(tau, origin_.ellipsoid.e2()))), -90.0, 90.0),
        std::remainder(longitude_deg, 360.0), origin_.ellipsoid};
}

const EarthFrame& frame_or_at_zero(const EarthFrame* frame) {
    static const TransverseMercator at_zero{GeoPosition{}};
    return frame == nullptr ? at_zero : *frame;
}

} // namespace octant
