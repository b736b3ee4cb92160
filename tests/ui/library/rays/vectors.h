#pragma once

#include <cmath>
#include <octant/octant.h>

// The arithmetic of an oracle that shares no code with what it checks: double precision, plain formulas.

namespace octant::tests {

inline Vec3 plus(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

inline Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

inline Vec3 times(double factor, const Vec3& a) { return {factor * a.x, factor * a.y, factor * a.z}; }

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// From body axes to world axes.
inline Vec3 turned(const Quaternion& q, const Vec3& v) {
    const Vec3 axis{q.x, q.y, q.z};
    const Vec3 across = times(2.0, cross(axis, v));
    return plus(plus(v, times(q.w, across)), cross(axis, across));
}

/// From world axes to body axes.
inline Vec3 turned_back(const Quaternion& q, const Vec3& v) { return turned({q.w, -q.x, -q.y, -q.z}, v); }

/// The rotation `b`, then `a`.
inline Quaternion product(const Quaternion& a, const Quaternion& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

} // namespace octant::tests
