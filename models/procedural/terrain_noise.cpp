// Source: K. Perlin, Improving Noise, SIGGRAPH 2002 (quintic fade, gradients at lattice points). Deviations: gradients
// are hashed vectors of any length up to 1.4, not a table of twelve, so that no direction of the lattice is favoured.
// Compiled once for each instruction set. Only + - * / and conversions are used, one by one: the same bits in every
// build and on every processor.
#include "models/procedural/terrain_noise.h"

// SVE's vectors have no size that the compiler knows.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#define HWY_BROKEN_EMU128 0 // compiled so that it is right, see CMakeLists.txt
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "models/procedural/terrain_noise.cpp"
// clang-format off: foreach_target.h must come before all that includes highway.h
#include <hwy/foreach_target.h>
// clang-format on

#include "models/procedural/lattice_hash-inl.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace octant::models::procedural {
namespace HWY_NAMESPACE {

HWY_INLINE Real fade(Real t) {
    const Real inner = hn::Add(hn::Mul(t, hn::Sub(hn::Mul(t, real(6.0)), real(15.0))), real(10.0));
    return hn::Mul(hn::Mul(hn::Mul(t, t), t), inner);
}

/// The height that a lattice point's gradient gives a place so far from it.
HWY_INLINE Real slope_term(Word bits, Real dx, Real dy) {
    constexpr double to_unit = 1.0 / 2147483648.0;
    const auto unit = [](Word half) HWY_ATTR { return hn::Sub(hn::Mul(real_of_word(half), real(to_unit)), real(1.0)); };
    const Real gx = unit(hn::And(bits, word(0xffffffffU)));
    const Real gy = unit(hn::ShiftRight<32>(bits));
    return hn::Add(hn::Mul(gx, dx), hn::Mul(gy, dy));
}

/// Smooth noise of one wavelength in about [-1, 1], zero on average. Coordinates in wavelengths.
HWY_INLINE Real gradient_noise(std::uint64_t seed, Real x, Real y) {
    const Real west = hn::Floor(x);
    const Real south = hn::Floor(y);
    const Word column = word_of_real(west);
    const Word row = word_of_real(south);
    const std::array columns{column_part(column), column_part(hn::Add(column, word(1)))};
    const std::array rows{row_part(row), row_part(hn::Add(row, word(1)))};
    const Real dx = hn::Sub(x, west);
    const Real dy = hn::Sub(y, south);
    const Real u = fade(dx);
    const auto along_row = [&](std::size_t upper, Real up) HWY_ATTR {
        const Real left = slope_term(hashed(seed, columns[0], rows[upper]), dx, up);
        const Real right = slope_term(hashed(seed, columns[1], rows[upper]), hn::Sub(dx, real(1.0)), up);
        return hn::Add(hn::Mul(left, hn::Sub(real(1.0), u)), hn::Mul(right, u));
    };
    const Real low = along_row(0, dy);
    const Real high = along_row(1, hn::Sub(dy, real(1.0)));
    const Real v = fade(dy);
    const Real between = hn::Add(hn::Mul(low, hn::Sub(real(1.0), v)), hn::Mul(high, v));
    return hn::Mul(real(1.6), between);
}

HWY_INLINE Real fractal_at(const FractalNoise& fractal, Real x_m, Real y_m) {
    Real sum = real(0.0);
    double weight = 1.0;
    double weights = 0.0;
    Real x = hn::Div(x_m, real(fractal.wavelength_m));
    Real y = hn::Div(y_m, real(fractal.wavelength_m));
    for (int octave = 0; octave < fractal.octaves; ++octave) {
        const std::uint64_t seed = fractal.seed + static_cast<std::uint64_t>(octave) * 1013U;
        sum = hn::Add(sum, hn::Mul(real(weight), gradient_noise(seed, x, y)));
        weights += weight;
        weight *= fractal.gain;
        // Each octave is turned by the angle of (3, 4, 5), so that lattices never line up.
        const auto turned = [&](double of_x, double of_y) HWY_ATTR {
            return hn::Mul(real(2.0), hn::Add(hn::Mul(real(of_x), x), hn::Mul(real(of_y), y)));
        };
        const Real next_x = hn::Sub(turned(0.8, -0.6), real(5.7));
        y = hn::Add(turned(0.6, 0.8), real(17.3));
        x = next_x;
    }
    return hn::Div(sum, real(weights));
}

/// So many of the values from a place on, then zeros.
HWY_INLINE Real load_some(const double* from, std::size_t count) {
    if (count == lane_count) { return hn::LoadU(Reals(), from); }
    alignas(64) std::array<double, lane_count> room{};
    std::copy_n(from, count, room.begin());
    return hn::Load(Reals(), room.data());
}

HWY_INLINE void store_some(Real values, double* to, std::size_t count) {
    if (count == lane_count) {
        hn::StoreU(values, Reals(), to);
        return;
    }
    alignas(64) std::array<double, lane_count> room;
    hn::Store(values, Reals(), room.data());
    std::copy_n(room.begin(), count, to);
}

void FractalAt(
    const FractalNoise& fractal, std::span<const double> x_m, std::span<const double> y_m, std::span<double> values) {
    for (std::size_t i = 0; i < values.size(); i += lane_count) {
        const std::size_t count = std::min(values.size() - i, lane_count);
        const Real x = load_some(&x_m[i], count);
        const Real y = load_some(&y_m[i], count);
        store_some(fractal_at(fractal, x, y), &values[i], count);
    }
}

void WarpMove(const DomainWarp& warp, std::span<double> x_m, std::span<double> y_m, double times) {
    const FractalNoise east = {warp.seed, warp.wavelength_m, warp.octaves, 0.5};
    const FractalNoise north = {warp.seed + 500009U, warp.wavelength_m, warp.octaves, 0.5};
    for (std::size_t i = 0; i < x_m.size(); i += lane_count) {
        const std::size_t count = std::min(x_m.size() - i, lane_count);
        const Real x = load_some(&x_m[i], count);
        const Real y = load_some(&y_m[i], count);
        const auto moved = [&](Real from, const FractalNoise& shift) HWY_ATTR {
            const Real by_m = hn::Mul(real(0.25 * warp.wavelength_m), fractal_at(shift, x, y));
            return hn::Add(from, hn::Mul(real(times), by_m));
        };
        store_some(moved(x, east), &x_m[i], count);
        store_some(moved(y, north), &y_m[i], count);
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::models::procedural

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octant::models::procedural {

HWY_EXPORT(FractalAt);
HWY_EXPORT(WarpMove);

void FractalNoise::at(std::span<const double> x_m, std::span<const double> y_m, std::span<double> values) const {
    assert(x_m.size() == values.size() && y_m.size() == values.size());
    HWY_DYNAMIC_DISPATCH(FractalAt)(*this, x_m, y_m, values);
}

void DomainWarp::move(std::span<double> x_m, std::span<double> y_m, double times) const {
    assert(x_m.size() == y_m.size());
    HWY_DYNAMIC_DISPATCH(WarpMove)(*this, x_m, y_m, times);
}

double smooth_step(double low, double high, double value) {
    const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

} // namespace octant::models::procedural
#endif
