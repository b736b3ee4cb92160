#include "visuals/verify/exact_sides.h"

#include <algorithm>
#include <utility>

namespace octant::visuals::verify {

ExactSides::ExactSides(const Certificate& certificate)
    : certificate_(certificate)
    , tolerance_(certificate.tolerance)
    , tenth_(certificate.tolerance / 10.0) {
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
    for (std::size_t i = 0; i < 3; ++i) {
        middle_[i] = Rational(least[i]) + box[i] / 2;
    }
    for (const CertificatePolygon& polygon : certificate.polygons) {
        keeps_plane_.push_back(
            !polygon.axis || is_across(polygon.plane, certificate.axes[*polygon.axis]));
    }
}

bool ExactSides::is_behind(std::uint32_t number, const WrittenPlane& plane, PartAngle pose) const {
    const CertificatePolygon& polygon = certificate_.polygons[number];
    if (pose == PartAngle::Turning && polygon.axis) {
        return is_behind(number, exact(plane), pose);
    }
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
            return verify::is_behind(plane, at, tenth_) &&
                   verify::is_behind(reversed(plane), at, tenth_);
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
        const ExactPlane wall{inward, Rational(-dot(inward, from))};
        if (largest(inward) > 0 && is_behind(b, wall, PartAngle::Standing)) {
            return true;
        }
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
    return area > 0;
}

bool ExactSides::is_impossible(const ExactPlane& plane) const {
    return height(plane, middle_) <= tolerance_ && largest(plane.normal) * size_ <= tolerance_;
}

} // namespace octant::visuals::verify
