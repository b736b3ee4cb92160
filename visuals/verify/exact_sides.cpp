#include "visuals/verify/exact_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace octant::visuals::verify {

// Arithmetic without rounding (GMP), and a way past it: where a floating-point result is larger than all that rounding
// can have done to it, its sign is certain.

ExactVector exact(const Vector& vector) { return {Rational(vector[0]), Rational(vector[1]), Rational(vector[2])}; }

ExactPlane exact(const WrittenPlane& plane) { return {exact(plane.normal), Rational(plane.offset)}; }

Rational dot(const ExactVector& a, const ExactVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

ExactVector cross(const ExactVector& a, const ExactVector& b) {
    return {
        Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]), Rational(a[0] * b[1] - a[1] * b[0])};
}

ExactVector difference(const ExactVector& a, const ExactVector& b) {
    return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}

Rational height(const ExactPlane& plane, const ExactVector& point) { return dot(plane.normal, point) + plane.offset; }

Rational largest(const ExactVector& vector) {
    Rational most = abs(vector[0]);
    most = std::max(most, Rational(abs(vector[1])));
    return std::max(most, Rational(abs(vector[2])));
}

ExactPlane reversed(const ExactPlane& plane) {
    return {
        {Rational(-plane.normal[0]), Rational(-plane.normal[1]), Rational(-plane.normal[2])}, Rational(-plane.offset)};
}

WrittenPlane reversed(const WrittenPlane& plane) {
    return {{-plane.normal[0], -plane.normal[1], -plane.normal[2]}, -plane.offset};
}

void add(ExactPlane& sum, double factor, const ExactPlane& plane) {
    if (factor == 0.0) { return; }
    const Rational times(factor);
    for (std::size_t i = 0; i < 3; ++i) { sum.normal[i] += times * plane.normal[i]; }
    sum.offset += times * plane.offset;
}

// Four products and five sums, each off by half a unit of the last place at most, are together off by less than six
// such halves of the sum of all magnitudes; sixteen leave room for the rounding of the bound itself. The constant
// stands for numbers too small to be rounded in proportion.
bool is_behind(const WrittenPlane& plane, const Vector& point, double tolerance) {
    constexpr double share = 16.0 * std::numeric_limits<double>::epsilon() / 2.0;
    constexpr double tiny = 1e-300;
    double sum = plane.offset;
    double magnitude = std::abs(plane.offset);
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double product = plane.normal[i] * point[i];
        sum += product;
        magnitude += std::abs(product);
        longest = std::max(longest, std::abs(plane.normal[i]));
    }
    const double limit = tolerance * longest;
    const double over = sum - limit;
    const double doubt = share * (magnitude + limit) + tiny;
    if (over < -doubt) { return true; }
    if (over > doubt) { return false; }
    return is_behind(exact(plane), exact(point), Rational(tolerance));
}

bool is_behind(const ExactPlane& plane, const ExactVector& point, const Rational& tolerance) {
    return height(plane, point) <= tolerance * largest(plane.normal);
}

// Over the circle of radius r about the foot on the axis the height is that of the foot and up to r * |part of the
// normal across the axis| more. Squares are compared, as both roots are irrational.
bool is_circle_behind(const ExactPlane& plane, const TurnAxis& axis, const Vector& point, const Rational& tolerance) {
    const ExactVector along = exact(axis.direction);
    const ExactVector from = exact(axis.point);
    const ExactVector away = difference(exact(point), from);
    const Rational square = dot(along, along);
    const Rational share = dot(along, away) / square;
    const Rational above = dot(plane.normal, along);
    const Rational foot = height(plane, from) + share * above;
    const Rational room = tolerance * largest(plane.normal) - foot;
    const Rational radius_square = dot(away, away) - share * share * square;
    const Rational across_square = dot(plane.normal, plane.normal) - above * above / square;
    return room >= 0 && radius_square * across_square <= room * room;
}

bool is_across(const WrittenPlane& plane, const TurnAxis& axis) {
    return largest(cross(exact(plane.normal), exact(axis.direction))) == 0;
}

ExactSides::ExactSides(const Certificate& certificate)
    : certificate_(certificate), tolerance_(certificate.tolerance), tenth_(certificate.tolerance / 10.0) {
    Vector least = certificate.vertices[certificate.polygons.front().corners.front()];
    Vector most = least;
    for (const CertificatePolygon& polygon : certificate.polygons) {
        for (const std::uint32_t corner : polygon.corners) {
            for (std::size_t i = 0; i < 3; ++i) {
                least[i] = std::min(least[i], certificate.vertices[corner][i]);
                most[i] = std::max(most[i], certificate.vertices[corner][i]);
            }
        }
    }
    const ExactVector box = difference(exact(most), exact(least));
    size_ = largest(box);
    for (std::size_t i = 0; i < 3; ++i) { middle_[i] = Rational(least[i]) + box[i] / 2; }
    for (const CertificatePolygon& polygon : certificate.polygons) {
        keeps_plane_.push_back(!polygon.axis || is_across(polygon.plane, certificate.axes[*polygon.axis]));
    }
}

bool ExactSides::is_behind(std::uint32_t number, const WrittenPlane& plane, PartAngle pose) const {
    const CertificatePolygon& polygon = certificate_.polygons[number];
    if (pose == PartAngle::Turning && polygon.axis) { return is_behind(number, exact(plane), pose); }
    return std::ranges::all_of(polygon.corners, [&](std::uint32_t corner) {
        return verify::is_behind(plane, certificate_.vertices[corner], certificate_.tolerance);
    });
}

bool ExactSides::is_behind(std::uint32_t number, const ExactPlane& plane, PartAngle pose) const {
    const CertificatePolygon& polygon = certificate_.polygons[number];
    return std::ranges::all_of(polygon.corners, [&](std::uint32_t corner) {
        const Vector& at = certificate_.vertices[corner];
        return pose == PartAngle::Turning && polygon.axis
                   ? is_circle_behind(plane, certificate_.axes[*polygon.axis], at, tolerance_)
                   : verify::is_behind(plane, exact(at), tolerance_);
    });
}

bool ExactSides::are_coplanar_layers(std::uint32_t a, std::uint32_t b) const {
    const CertificatePolygon& one = certificate_.polygons[a];
    const CertificatePolygon& other = certificate_.polygons[b];
    const auto lies_in = [&](const CertificatePolygon& polygon, const WrittenPlane& plane) {
        return std::ranges::all_of(polygon.corners, [&](std::uint32_t corner) {
            const Vector& at = certificate_.vertices[corner];
            return verify::is_behind(plane, at, tenth_) && verify::is_behind(reversed(plane), at, tenth_);
        });
    };
    return lies_in(other, one.plane) && lies_in(one, other.plane) &&
           dot(exact(one.plane.normal), exact(other.plane.normal)) > 0 && !edge_separates(a, b) &&
           !edge_separates(b, a);
}

bool ExactSides::edge_separates(std::uint32_t a, std::uint32_t b) const {
    const CertificatePolygon& polygon = certificate_.polygons[a];
    const ExactVector normal = exact(polygon.plane.normal);
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
        const std::size_t next = (i + 1) % polygon.corners.size();
        const ExactVector from = exact(certificate_.vertices[polygon.corners[i]]);
        const ExactVector to = exact(certificate_.vertices[polygon.corners[next]]);
        const ExactVector inward = cross(normal, difference(to, from));
        const ExactPlane edge_plane{inward, Rational(-dot(inward, from))};
        if (largest(inward) > 0 && is_behind(b, edge_plane, PartAngle::Standing)) { return true; }
    }
    return false;
}

// The normal by Newell's sum of the triangles from the first corner.
bool ExactSides::is_counter_clockwise(std::uint32_t number) const {
    const CertificatePolygon& polygon = certificate_.polygons[number];
    const ExactVector first = exact(certificate_.vertices[polygon.corners.front()]);
    const ExactVector normal = exact(polygon.plane.normal);
    Rational area = 0;
    ExactVector last = difference(exact(certificate_.vertices[polygon.corners[1]]), first);
    for (std::size_t i = 2; i < polygon.corners.size(); ++i) {
        ExactVector next = difference(exact(certificate_.vertices[polygon.corners[i]]), first);
        area += dot(normal, cross(last, next));
        last = std::move(next);
    }
    return area >= 0; // without an area it shows nothing
}

bool ExactSides::is_impossible(const ExactPlane& plane) const {
    return height(plane, middle_) <= tolerance_ && largest(plane.normal) * size_ <= tolerance_;
}

} // namespace octant::visuals::verify
