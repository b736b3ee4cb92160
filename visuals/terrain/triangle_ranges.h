#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace octant::visuals::terrain {

/// The triangles of a fan and of all fans below it, which follow one another in a mesh.
struct TriangleRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

/// Walks through a fan's run in drawing order: calls `own(triangle)` for each of its own triangles, and `below(child)`
/// for each of `children` (0 = none) with a run that is not empty. `run_of(child)` returns that run.
template <typename RunOf, typename Own, typename Below>
void for_each_in_range(const TriangleRange& run, const std::array<std::uint32_t, 4>& children, const RunOf& run_of,
    const Own& own, const Below& below) {
    std::array<std::uint32_t, 4> drawn{}; // In drawing order.
    std::size_t count = 0;
    for (const std::uint32_t child : children) {
        if (child == 0 || run_of(child).first == run_of(child).end) { continue; }
        drawn[count] = child;
        for (std::size_t k = count++; k > 0; --k) {
            if (run_of(drawn[k - 1]).first > run_of(drawn[k]).first) { std::swap(drawn[k - 1], drawn[k]); }
        }
    }
    std::uint32_t triangle = run.first;
    const auto own_up_to = [&](std::uint32_t end) {
        for (; triangle < end; ++triangle) { own(triangle); }
    };
    for (std::size_t k = 0; k < count; ++k) {
        const TriangleRange taken = run_of(drawn[k]);
        own_up_to(taken.first);
        below(drawn[k]);
        triangle = taken.end;
    }
    own_up_to(run.end);
}

} // namespace octant::visuals::terrain
