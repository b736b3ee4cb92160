#pragma once

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace octant {

/// Four numbers that are computed together, each with the result of scalar arithmetic.
using Float4 = float __attribute__((vector_size(16)));

/// The results of comparing four numbers: all bits of those that hold, 0 for the others.
using Mask4 = int __attribute__((vector_size(16)));

#ifdef __SSE__
/// The larger one of each pair: a > b ? a : b, for which compilers do not use the instruction that does just that.
inline Float4 max4(Float4 a, Float4 b) { return _mm_max_ps(a, b); }

/// The smaller one of each pair: a < b ? a : b.
inline Float4 min4(Float4 a, Float4 b) { return _mm_min_ps(a, b); }
#else
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }

inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
#endif

/// The same number four times.
inline Float4 splat4(float each) { return Float4{each, each, each, each}; }

} // namespace octant
