#pragma once

namespace octant::visuals::terrain {

/// Four numbers that are computed with at a time, each with the same result as alone.
using Float4 = float __attribute__((vector_size(16)));

/// The larger one of each pair.
inline Float4 max4(Float4 a, Float4 b) {
    return a > b ? a : b;
}

/// The smaller one of each pair.
inline Float4 min4(Float4 a, Float4 b) {
    return a < b ? a : b;
}

/// The same number four times.
inline Float4 splat4(float each) {
    return Float4{each, each, each, each};
}

} // namespace octant::visuals::terrain
