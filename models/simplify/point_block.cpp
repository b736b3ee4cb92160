#include "models/simplify/point_block.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

namespace octant::models::simplify {

namespace {

std::array<float, 3> narrow(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

float inverse(double value) {
    return value > 1e-30 ? static_cast<float>(1.0 / value) : 0.0F;
}

/// Any unit vector across a unit vector.
glm::dvec3 across(const glm::dvec3& axis) {
    const glm::dvec3 helper =
        std::abs(axis.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::cross(axis, helper));
}

/// Four numbers, and as many whole ones; the compiler knows their instructions on any processor.
struct Narrow {
    using Floats = float __attribute__((vector_size(16)));
    using Ints = std::int32_t __attribute__((vector_size(16)));
    static constexpr std::size_t lanes = 4;
};

struct Wide {
    using Floats = float __attribute__((vector_size(32)));
    using Ints = std::int32_t __attribute__((vector_size(32)));
    static constexpr std::size_t lanes = 8;
};

// Results go out by reference: vectors as return values would depend on the processor's ABI.
#define OCTANT_INLINE [[gnu::always_inline]] inline

template <typename V, typename T>
OCTANT_INLINE void load(V& out, const T* from) {
    std::memcpy(&out, from, sizeof(V));
}

template <typename V, typename T>
OCTANT_INLINE void store(const V& value, T* to) {
    std::memcpy(to, &value, sizeof(V));
}

template <typename V>
OCTANT_INLINE void make_least(V& value, const V& other) {
    value = other < value ? other : value;
}

template <typename V>
OCTANT_INLINE void clamp_share(V& value) {
    value = value > 0.0F ? value : V{};
    value = value < 1.0F ? value : V{} + 1.0F;
}

/// Points in a triangle's plane, and what lies between them and the nearest place of its edges.
template <typename F>
struct EdgeFeet {
    F away_x, away_y, away2;
};

template <bool coloured, typename F>
OCTANT_INLINE void
nearest_on_edges(EdgeFeet<F>& feet, const F& x, const F& y, const FlatTriangle& t) {
    const F qx = x - t.bx;
    const float ex = t.cx - t.bx;
    F ab = x * (t.bx * t.per_ab2);
    F bc = (qx * ex + y * t.cy) * t.per_bc2;
    F ca = (x * t.cx + y * t.cy) * t.per_ca2;
    clamp_share(ab);
    clamp_share(bc);
    clamp_share(ca);
    const F ab_x = x - ab * t.bx;
    const F bc_x = qx - bc * ex;
    const F bc_y = y - bc * t.cy;
    const F ca_x = x - ca * t.cx;
    const F ca_y = y - ca * t.cy;
    const F ab2 = ab_x * ab_x + y * y;
    const F bc2 = bc_x * bc_x + bc_y * bc_y;
    const F ca2 = ca_x * ca_x + ca_y * ca_y;
    feet.away2 = ab2;
    make_least(feet.away2, bc2);
    if constexpr (coloured) {
        const auto is_bc = bc2 < ab2;
        const auto is_ca = ca2 < feet.away2;
        feet.away_x = is_bc ? bc_x : ab_x;
        feet.away_y = is_bc ? bc_y : y;
        feet.away_x = is_ca ? ca_x : feet.away_x;
        feet.away_y = is_ca ? ca_y : feet.away_y;
    }
    make_least(feet.away2, ca2);
}

/// Squares of the differences between the colours of points and of places of a triangle.
template <typename F>
OCTANT_INLINE void colour_errors(
    F& error2, PointBlock& points, std::size_t i, const FlatTriangle& t, const F& x, const F& y) {
    error2 = F{};
    const std::array<const float*, 3> colours = {&points.red[i], &points.green[i], &points.blue[i]};
    for (std::size_t part = 0; part < 3; ++part) {
        F colour;
        load(colour, colours[part]);
        const F off = t.colour[part] + x * t.colour_x[part] + y * t.colour_y[part] - colour;
        error2 += off * off;
    }
}

/// One triangle against `lanes` points. Without branches; every point's result is the same however
/// many are done at once.
template <typename Width, bool coloured>
OCTANT_INLINE void
nearest_to_one(PointBlock& points, std::size_t i, const FlatTriangle& t, std::int32_t index) {
    using F = typename Width::Floats;
    F dx, dy, dz;
    load(dx, &points.x[i]);
    load(dy, &points.y[i]);
    load(dz, &points.z[i]);
    dx -= t.origin[0];
    dy -= t.origin[1];
    dz -= t.origin[2];
    const F x = dx * t.x_axis[0] + dy * t.x_axis[1] + dz * t.x_axis[2];
    const F y = dx * t.y_axis[0] + dy * t.y_axis[1] + dz * t.y_axis[2];
    const F h = dx * t.normal[0] + dy * t.normal[1] + dz * t.normal[2];
    EdgeFeet<F> feet;
    nearest_on_edges<coloured>(feet, x, y, t);
    F inside = y;
    make_least(inside, F((t.cx - t.bx) * y - t.cy * (x - t.bx)));
    make_least(inside, F(t.cy * x - t.cx * y));
    const auto is_inside = inside >= 0.0F;
    const F distance2 = (is_inside ? F{} : feet.away2) + h * h;
    F known;
    load(known, &points.distances2[i]);
    const auto is_nearer = distance2 < known;
    if constexpr (coloured) {
        const F foot_x = x - (is_inside ? F{} : feet.away_x);
        const F foot_y = y - (is_inside ? F{} : feet.away_y);
        F error2, known_error2;
        colour_errors(error2, points, i, t, foot_x, foot_y);
        load(known_error2, &points.colour_errors2[i]);
        store(F(is_nearer ? error2 : known_error2), &points.colour_errors2[i]);
    }
    typename Width::Ints nearest;
    load(nearest, &points.nearest[i]);
    nearest = is_nearer ? typename Width::Ints{} + index : nearest;
    store(nearest, &points.nearest[i]);
    store(F(is_nearer ? distance2 : known), &points.distances2[i]);
}

template <typename Width, bool coloured>
OCTANT_INLINE void nearest_to_all(
    PointBlock& points,
    std::size_t first,
    std::size_t end,
    std::span<const FlatTriangle> triangles) {
    std::fill(
        points.distances2.begin() + static_cast<std::ptrdiff_t>(first),
        points.distances2.begin() + static_cast<std::ptrdiff_t>(end),
        std::numeric_limits<float>::max());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = first; i < end; i += Width::lanes) {
            nearest_to_one<Width, coloured>(points, i, triangles[t], static_cast<std::int32_t>(t));
        }
    }
}

/// Expects far away points behind the last one, up to a multiple of 8.
template <typename Width>
OCTANT_INLINE float least2(const PointBlock& points, const std::array<float, 3>& place) {
    using F = typename Width::Floats;
    F least = F{} + std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < points.size(); i += Width::lanes) {
        F dx, dy, dz;
        load(dx, &points.x[i]);
        load(dy, &points.y[i]);
        load(dz, &points.z[i]);
        dx -= place[0];
        dy -= place[1];
        dz -= place[2];
        make_least(least, F(dx * dx + dy * dy + dz * dz));
    }
    float found = least[0];
    for (std::size_t lane = 1; lane < Width::lanes; ++lane) {
        found = std::min(found, least[lane]);
    }
    return found;
}

#if defined(__x86_64__) && defined(__GNUC__)
#define OCTANT_HAS_WIDE_VECTORS 1

/// The same operations, eight at once; AVX2 alone brings no fused ones.
[[gnu::target("avx2")]] void find_nearest_wide(
    PointBlock& points,
    std::size_t first,
    std::size_t end,
    std::span<const FlatTriangle> triangles,
    bool coloured) {
    if (coloured) {
        nearest_to_all<Wide, true>(points, first, end, triangles);
    } else {
        nearest_to_all<Wide, false>(points, first, end, triangles);
    }
}

[[gnu::target("avx2")]] float
least2_wide(const PointBlock& points, const std::array<float, 3>& place) {
    return least2<Wide>(points, place);
}

bool has_wide_vectors() {
    static const bool wide = __builtin_cpu_supports("avx2") != 0;
    return wide;
}
#endif

} // namespace

FlatTriangle flat(const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 ab = corners[1] - corners[0];
    const glm::dvec3 ac = corners[2] - corners[0];
    const double length = glm::length(ab);
    const glm::dvec3 x_axis = length > 0.0 ? ab / length : glm::dvec3(1.0, 0.0, 0.0);
    const double along = glm::dot(ac, x_axis);
    const glm::dvec3 height = ac - along * x_axis;
    const double up = glm::length(height);
    const glm::dvec3 y_axis = up > 1e-12 * glm::length(ac) ? height / up : across(x_axis);
    FlatTriangle t{};
    t.origin = narrow(corners[0]);
    t.x_axis = narrow(x_axis);
    t.y_axis = narrow(y_axis);
    t.normal = narrow(glm::cross(x_axis, y_axis));
    t.bx = static_cast<float>(length);
    t.cx = static_cast<float>(along);
    t.cy = static_cast<float>(up);
    t.per_ab2 = inverse(length * length);
    t.per_bc2 = inverse((along - length) * (along - length) + up * up);
    t.per_ca2 = inverse(along * along + up * up);
    return t;
}

FlatTriangle
flat(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec3, 3>& corner_colours) {
    FlatTriangle t = flat(corners);
    const auto length = static_cast<double>(t.bx);
    const auto up = static_cast<double>(t.cy);
    const glm::dvec3 to_b = corner_colours[1] - corner_colours[0];
    const glm::dvec3 to_c = corner_colours[2] - corner_colours[0];
    const glm::dvec3 along_x = length > 0.0 ? to_b / length : glm::dvec3(0.0);
    const glm::dvec3 along_y =
        up > 1e-6 * length ? (to_c - along_x * static_cast<double>(t.cx)) / up : glm::dvec3(0.0);
    t.colour = narrow(corner_colours[0]);
    t.colour_x = narrow(along_x);
    t.colour_y = narrow(along_y);
    return t;
}

void PointBlock::make_room(std::size_t points) {
    if (points + 8 > x.size()) {
        const std::size_t room = 2 * points + 8;
        for (auto* values :
             {&x, &y, &z, &weights, &red, &green, &blue, &distances2, &colour_errors2}) {
            values->resize(room);
        }
        numbers.resize(room);
        nearest.resize(room);
    }
}

void find_nearest(
    PointBlock& points,
    std::size_t first,
    std::size_t end,
    std::span<const FlatTriangle> triangles,
    bool coloured) {
    assert(end <= points.size() && !triangles.empty());
#if defined(OCTANT_HAS_WIDE_VECTORS)
    if (has_wide_vectors()) {
        find_nearest_wide(points, first, end, triangles, coloured);
        return;
    }
#endif
    if (coloured) {
        nearest_to_all<Narrow, true>(points, first, end, triangles);
    } else {
        nearest_to_all<Narrow, false>(points, first, end, triangles);
    }
}

float least_distance2(PointBlock& points, const std::array<float, 3>& place) {
    assert(points.size() > 0);
    constexpr float far_away = 1e9F;
    for (std::size_t i = points.size(); i % 8 != 0; ++i) {
        points.x[i] = far_away;
    }
#if defined(OCTANT_HAS_WIDE_VECTORS)
    if (has_wide_vectors()) {
        return least2_wide(points, place);
    }
#endif
    return least2<Narrow>(points, place);
}

} // namespace octant::models::simplify
