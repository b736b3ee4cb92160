// Point-to-triangle distances, many at a time. This is where simplification spends its time: each collapse asks for the
// distances of some dozens of samples to some dozen triangles. The inner loop has no branches and is written once for
// vectors of 4 (any processor) and 8 floats (with AVX2, chosen when the program runs). Every lane computes the same
// operations in the same order, so that results do not depend on the width.
#include "models/simplify/sample_block.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

namespace octant::models::simplify {

namespace {

/// Vectors of four floats and four integers, which the compiler maps to any processor.
struct Narrow {
    using Floats = float __attribute__((vector_size(16)));
    using Ints = std::int32_t __attribute__((vector_size(16)));
    static constexpr std::size_t lanes = 4;
};

/// Vectors of eight floats and eight integers.
struct Wide {
    using Floats = float __attribute__((vector_size(32)));
    using Ints = std::int32_t __attribute__((vector_size(32)));
    static constexpr std::size_t lanes = 8;
};

template <typename V, typename T>
OCTANT_INLINE void load(V& out, const T* from) {
    std::memcpy(&out, from, sizeof(V));
}

template <typename V, typename T>
OCTANT_INLINE void store(const V& value, T* to) {
    std::memcpy(to, &value, sizeof(V));
}

/// The squared differences between the colours of samples and those at positions (x, y) of a triangle.
template <typename F>
OCTANT_INLINE void colour_errors(
    F& error2, SampleBlock& samples, std::size_t i, const FlatTriangle& t, const F& x, const F& y) {
    error2 = F{};
    const std::array<const float*, 3> colours = {&samples.red[i], &samples.green[i], &samples.blue[i]};
    for (std::size_t part = 0; part < 3; ++part) {
        F colour;
        load(colour, colours[part]);
        const F off = t.colour[part] + x * t.colour_x[part] + y * t.colour_y[part] - colour;
        error2 += off * off;
    }
}

/// Compares one triangle with the next few samples and keeps it where it is nearer. Without branches; each point's
/// result is the same whatever the width.
template <typename Width, bool coloured>
OCTANT_INLINE void nearest_to_one(SampleBlock& samples, std::size_t i, const FlatTriangle& t, std::int32_t index) {
    using F = typename Width::Floats;
    std::array<F, 3> place;
    load(place[0], &samples.x[i]);
    load(place[1], &samples.y[i]);
    load(place[2], &samples.z[i]);
    measure::FramePoints<F> found;
    measure::find_in_frame<coloured>(found, place, t);
    F known;
    load(known, &samples.distances2[i]);
    const auto is_nearer = found.distance2 < known;
    if constexpr (coloured) {
        const F foot_x = found.x - found.feet.away_x;
        const F foot_y = found.y - found.feet.away_y;
        F error2, known_error2;
        colour_errors(error2, samples, i, t, foot_x, foot_y);
        load(known_error2, &samples.colour_errors2[i]);
        store(F(is_nearer ? error2 : known_error2), &samples.colour_errors2[i]);
    }
    typename Width::Ints nearest;
    load(nearest, &samples.nearest[i]);
    nearest = is_nearer ? typename Width::Ints{} + index : nearest;
    store(nearest, &samples.nearest[i]);
    store(F(is_nearer ? found.distance2 : known), &samples.distances2[i]);
}

/// Compares all triangles with all samples.
template <typename Width, bool coloured>
OCTANT_INLINE void nearest_to_all(SampleBlock& samples, std::span<const FlatTriangle> triangles) {
    std::fill_n(samples.distances2.begin(), samples.size(), std::numeric_limits<float>::max());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = 0; i < samples.size(); i += Width::lanes) {
            nearest_to_one<Width, coloured>(samples, i, triangles[t], static_cast<std::int32_t>(t));
        }
    }
}

#if defined(__x86_64__) && defined(__GNUC__)
#define OCTANT_HAS_WIDE_VECTORS 1

/// The same operations, eight samples at a time. AVX2 alone does not fuse multiplications and additions, so that the
/// bits are the same.
[[gnu::target("avx2")]] void find_nearest_wide(
    SampleBlock& samples, std::span<const FlatTriangle> triangles, bool coloured) {
    if (coloured) {
        nearest_to_all<Wide, true>(samples, triangles);
    } else {
        nearest_to_all<Wide, false>(samples, triangles);
    }
}

bool has_wide_vectors() {
    static const bool wide = __builtin_cpu_supports("avx2") != 0;
    return wide;
}
#endif

} // namespace

FlatTriangle flat(const std::array<glm::dvec3, 3>& corners) { return {measure::plane_frame(corners), {}, {}, {}}; }

FlatTriangle flat(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec3, 3>& corner_colours) {
    FlatTriangle t = flat(corners);
    const auto length = static_cast<double>(t.bx);
    const auto up = static_cast<double>(t.cy);
    const glm::dvec3 to_b = corner_colours[1] - corner_colours[0];
    const glm::dvec3 to_c = corner_colours[2] - corner_colours[0];
    const glm::dvec3 along_x = length > 0.0 ? to_b / length : glm::dvec3(0.0);
    const glm::dvec3 along_y = up > 1e-6 * length ? (to_c - along_x * static_cast<double>(t.cx)) / up : glm::dvec3(0.0);
    t.colour = measure::narrow(corner_colours[0]);
    t.colour_x = measure::narrow(along_x);
    t.colour_y = measure::narrow(along_y);
    return t;
}

void SampleBlock::make_room(std::size_t samples) {
    if (samples + 8 > x.size()) {
        const std::size_t room = 2 * samples + 8;
        for (auto* values : {&x, &y, &z, &weights, &red, &green, &blue, &distances2, &colour_errors2}) {
            values->resize(room);
        }
        numbers.resize(room);
        nearest.resize(room);
    }
}

void find_nearest(SampleBlock& samples, std::span<const FlatTriangle> triangles, bool coloured) {
    assert(!triangles.empty());
#if defined(OCTANT_HAS_WIDE_VECTORS)
    if (has_wide_vectors()) {
        find_nearest_wide(samples, triangles, coloured);
        return;
    }
#endif
    if (coloured) {
        nearest_to_all<Narrow, true>(samples, triangles);
    } else {
        nearest_to_all<Narrow, false>(samples, triangles);
    }
}

} // namespace octant::models::simplify
