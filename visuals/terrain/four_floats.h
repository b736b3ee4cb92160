#pragma once

namespace octant::visuals::terrain {

/// Four numbers that are calculated with at a time, each as it would be alone.
using FourFloats = float __attribute__((vector_size(16)));

inline FourFloats larger(FourFloats a, FourFloats b) {
    return a > b ? a : b;
}

inline FourFloats four(float each) {
    return FourFloats{each, each, each, each};
}

} // namespace octant::visuals::terrain
