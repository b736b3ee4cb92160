#pragma once

#include "visuals/verify/certificate.h"

#include <array>
#include <cstdint>
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

/// Whether the height of a point over a plane is at most `tolerance` times largest(normal). Decided in floating point
/// where its rounding cannot matter, else exactly.
bool is_behind(const WrittenPlane& plane, const Vector& point, double tolerance);

/// Whether the height of a point over a plane is at most `tolerance` times largest(normal), decided exactly.
bool is_behind(const ExactPlane& plane, const ExactVector& point, const Rational& tolerance);

/// Whether that is so, exactly, for every point of the circle on which a point travels about an axis.
bool is_circle_behind(const ExactPlane& plane, const TurnAxis& axis, const Vector& point, const Rational& tolerance);

/// Whether a plane stays where it is when it turns about an axis.
bool is_across(const WrittenPlane& plane, const TurnAxis& axis);

/// How a polygon is looked at.
enum class PartAngle {
    Turning, ///< At every angle of its axis; the same as it stands where it has none.
    Standing ///< As it stands in the file.
};

/// Where polygons lie to planes, without rounding. Keeps a reference to the certificate.
class ExactSides {
public:
    explicit ExactSides(const Certificate& certificate);

    /// Whether no corner is before a plane by more than the tolerance.
    bool is_behind(std::uint32_t polygon, const WrittenPlane& plane, PartAngle pose) const;
    bool is_behind(std::uint32_t polygon, const ExactPlane& plane, PartAngle pose) const;

    /// Whether no corner is behind a plane by more than the tolerance.
    template <typename AnyPlane>
    bool is_before(std::uint32_t polygon, const AnyPlane& plane, PartAngle pose) const {
        return is_behind(polygon, reversed(plane), pose);
    }

    /// Whether eyes that see a polygon are before its plane: not if the plane turns with it.
    bool has_fixed_plane(std::uint32_t polygon, PartAngle pose) const {
        return pose == PartAngle::Standing || keeps_plane_[polygon];
    }

    /// Whether two polygons overlap in one plane that both are seen from, as they stand: all corners of each within a
    /// tenth of the tolerance of the other's plane, and no edge between them.
    bool are_coplanar_layers(std::uint32_t a, std::uint32_t b) const;

    /// Whether the corners of a polygon run counter-clockwise, seen from before its plane.
    bool is_counter_clockwise(std::uint32_t polygon) const;

    /// Whether a plane is the negative of nothing but rounding: nobody is before it by more than the tolerance times (1
    /// + the eye's distance from the model's middle in sizes of the model).
    bool is_impossible(const ExactPlane& plane) const;

    /// The longest side of the box around all corners.
    const Rational& size() const { return size_; }

private:
    bool edge_separates(std::uint32_t a, std::uint32_t b) const;

    const Certificate& certificate_;
    Rational tolerance_;
    double tenth_ = 0.0;
    ExactVector middle_;
    Rational size_;
    std::vector<bool> keeps_plane_;
};

} // namespace octant::visuals::verify
