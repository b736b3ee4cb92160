#pragma once

namespace octant::visuals::terrain {

/// Four numbers that are computed with at a time, each with the same result as alone.
using FourFloats = float __attribute__((vector_size(16)));

/// The larger one of each pair.
inline FourFloats larger(FourFloats a, FourFloats b) {
    return a > b ? a : b;
}

/// The smaller one of each pair.
inline FourFloats smaller(FourFloats a, FourFloats b) {
    return a < b ? a : b;
}

/// The same number four times.
inline FourFloats four(float each) {
    return FourFloats{each, each, each, each};
}

} // namespace octant::visuals::terrain
