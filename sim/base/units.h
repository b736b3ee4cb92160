#pragma once

#include <numbers>

namespace octant {

/// Standard gravity, m/s2 (ISO 80000-3).
inline constexpr double gravity_mps2 = 9.80665;

inline constexpr double pi = std::numbers::pi;

// Conversions at the file, wire and screen borders; inside, everything is metres, seconds, radians.
constexpr double rad_from_deg(double deg) { return deg * (pi / 180.0); }

constexpr double deg_from_rad(double rad) { return rad * (180.0 / pi); }

constexpr double m_from_ft(double ft) { return ft * 0.3048; }

constexpr double ft_from_m(double m) { return m / 0.3048; }

constexpr double mps_from_kt(double kt) { return kt * (1852.0 / 3600.0); }

constexpr double kt_from_mps(double mps) { return mps * (3600.0 / 1852.0); }

} // namespace octant
