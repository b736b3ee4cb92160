#pragma once

namespace octant {

/// Twice the area of a triangle seen along z, positive when it is counter-clockwise; of vectors of two or three parts.
template <typename Vector>
auto signed_area2(const Vector& a, const Vector& b, const Vector& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

} // namespace octant
