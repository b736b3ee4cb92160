#include "visuals/verify/painted_check.h"

#include "visuals/verify/refusal.h"
#include "visuals/verify/stacked.h"

#include <fmt/format.h>
#include <utility>

namespace octant::visuals::verify {

namespace {

[[noreturn]] void refuse_again(std::uint32_t polygon, int line) {
    throw Refusal{line, fmt::format("expected each polygon painted once, got {} again", polygon)};
}

[[noreturn]] void refuse_stack(const Pair& pair, int line) {
    throw Refusal{
        line,
        fmt::format(
            "expected polygon {} painted over polygon {}, which it overlaps in one plane and "
            "follows in the model's file, got it painted earlier",
            pair.later,
            pair.earlier)};
}

std::unordered_map<std::uint32_t, std::size_t> places_of(std::span<const std::uint32_t> list) {
    std::unordered_map<std::uint32_t, std::size_t> places;
    for (std::size_t i = 0; i < list.size(); ++i) {
        places.emplace(list[i], i);
    }
    return places;
}

} // namespace

PaintedCheck::PaintedCheck(
    const Certificate& certificate, const Sides& sides, const PairCheck& pair_check)
    : certificate_(certificate)
    , pair_check_(pair_check)
    , stacked_(stacked_pairs(certificate, sides))
    , mark_(certificate.polygons.size(), 0) {}

std::uint64_t PaintedCheck::expect_painted(
    int child,
    std::span<const std::uint32_t> expected,
    std::span<const std::uint32_t> painted,
    const Walls& walls) {
    enum : char { None, Expected, Painted };

    const int line = certificate_.line_of(child);
    const Claims& claims = certificate_.claims_of(child);
    for (const std::uint32_t polygon : expected) {
        mark_[polygon] = Expected;
    }
    for (const std::uint32_t polygon : painted) {
        if (std::exchange(mark_[polygon], Painted) != Expected) {
            refuse_again(polygon, line);
        }
    }
    std::uint64_t unlisted = 0;
    for (const std::uint32_t polygon : expected) {
        if (std::exchange(mark_[polygon], None) == Painted || claims.unproved.contains(polygon)) {
            continue;
        }
        const auto away = claims.away.find(polygon);
        if (away == claims.away.end()) {
            throw Refusal{
                line,
                fmt::format(
                    "expected polygon {} painted or proved to face away, got neither", polygon)};
        }
        pair_check_.check_away(polygon, away->second, walls);
        ++unlisted;
    }
    return unlisted;
}

void PaintedCheck::expect_apart(
    int line, const std::array<std::span<const std::uint32_t>, 4>& parts) {
    constexpr std::array<char, 4> marks{1, 2, 3, 4};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (const std::uint32_t polygon : parts[i]) {
            const char before = std::exchange(mark_[polygon], marks[i]);
            if (before != 0 && !(before == marks[2] && i == 3)) {
                refuse_again(polygon, line);
            }
        }
    }
    for (const auto& part : parts) {
        for (const std::uint32_t polygon : part) {
            mark_[polygon] = 0;
        }
    }
}

void PaintedCheck::expect_stacked(std::span<const std::uint32_t> list, int line) const {
    if (stacked_.empty()) {
        return;
    }
    const auto places = places_of(list);
    for (const Pair& pair : stacked_) {
        const auto lower = places.find(pair.earlier);
        const auto upper = places.find(pair.later);
        if (lower != places.end() && upper != places.end() && upper->second < lower->second) {
            refuse_stack(pair, line);
        }
    }
}

void PaintedCheck::expect_stacked(
    std::span<const std::uint32_t> first, std::span<const std::uint32_t> later, int line) const {
    if (stacked_.empty()) {
        return;
    }
    const auto places_first = places_of(first);
    const auto places_later = places_of(later);
    for (const Pair& pair : stacked_) {
        if (places_first.contains(pair.later) && places_later.contains(pair.earlier)) {
            refuse_stack(pair, line);
        }
    }
}

} // namespace octant::visuals::verify
