#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace octant::sim::links {

/// value + slope t + bend t^2.
template <class Value>
struct Parabola {
    Value value{};
    Value slope{};
    Value bend{};
};

/// The weighted least squares of points by a line or a parabola, from sums: points are added, not kept. Value: double
/// or glm::dvec3.
template <class Value>
class ParabolaFit {
public:
    void add(double t, const Value& value, double weight = 1.0) {
        double power = weight;
        for (std::size_t k = 0; k < t_.size(); ++k) {
            t_[k] += power;
            if (k < v_.size()) { v_[k] += power * value; }
            power *= t;
        }
    }

    /// Nothing where the points do not determine it.
    std::optional<Parabola<Value>> line() const {
        const double determinant = t_[0] * t_[2] - t_[1] * t_[1];
        if (!(determinant > min_share * t_[0] * t_[2])) { return std::nullopt; }
        return Parabola<Value>{
            (t_[2] * v_[0] - t_[1] * v_[1]) / determinant, (t_[0] * v_[1] - t_[1] * v_[0]) / determinant, Value(0.0)};
    }

    /// Nothing where the points do not determine it.
    std::optional<Parabola<Value>> parabola() const {
        const auto& [s0, s1, s2, s3, s4] = t_;
        // Cofactors of the symmetric matrix of the normal equations.
        const double a = s2 * s4 - s3 * s3;
        const double b = s2 * s3 - s1 * s4;
        const double c = s1 * s3 - s2 * s2;
        const double d = s0 * s4 - s2 * s2;
        const double e = s1 * s2 - s0 * s3;
        const double f = s0 * s2 - s1 * s1;
        const double determinant = s0 * a + s1 * b + s2 * c;
        if (!(determinant > min_share * s0 * s2 * s4)) { return std::nullopt; }
        return Parabola<Value>{(a * v_[0] + b * v_[1] + c * v_[2]) / determinant,
            (b * v_[0] + d * v_[1] + e * v_[2]) / determinant, (c * v_[0] + e * v_[1] + f * v_[2]) / determinant};
    }

private:
    static constexpr double min_share = 1e-9; ///< of what the determinant is without cancellation

    std::array<double, 5> t_{}; ///< sums of weight t^k
    std::array<Value, 3> v_{};  ///< sums of weight t^k value
};

} // namespace octant::sim::links
