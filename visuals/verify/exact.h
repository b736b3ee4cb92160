#pragma once

#include "visuals/verify/certificate.h"

#include <array>
#include <gmpxx.h>

namespace octant::visuals::verify {

/// A number without rounding.
using Rational = mpq_class;
using ExactVector = std::array<Rational, 3>;

/// A plane without rounding.
struct ExactPlane {
    ExactVector normal;
    Rational offset;
};

ExactVector exact(const Vector& vector);
ExactPlane exact(const WrittenPlane& plane);
Rational dot(const ExactVector& a, const ExactVector& b);
ExactVector cross(const ExactVector& a, const ExactVector& b);
ExactVector difference(const ExactVector& a, const ExactVector& b);

/// normal . point + offset.
Rational height(const ExactPlane& plane, const ExactVector& point);

/// The greatest of |x|, |y| and |z|: at most the length, and rational.
Rational largest(const ExactVector& vector);

/// The plane with its front and back exchanged.
ExactPlane reversed(const ExactPlane& plane);
WrittenPlane reversed(const WrittenPlane& plane);

/// Adds a plane times a factor.
void add(ExactPlane& sum, double factor, const ExactPlane& plane);

/// Whether the height of a point over a plane is at most `tolerance` times largest(normal). Decided
/// in floating point where its rounding cannot matter, else exactly.
bool is_behind(const WrittenPlane& plane, const Vector& point, double tolerance);

/// Whether the height of a point over a plane is at most `tolerance` times largest(normal), decided
/// exactly.
bool is_behind(const ExactPlane& plane, const ExactVector& point, const Rational& tolerance);

/// Whether that is so, exactly, for every point of the circle on which a point travels about an
/// axis.
bool is_circle_behind(
    const ExactPlane& plane, const TurnAxis& axis, const Vector& point, const Rational& tolerance);

/// Whether a plane stays where it is when it turns about an axis.
bool is_across(const WrittenPlane& plane, const TurnAxis& axis);

} // namespace octant::visuals::verify
