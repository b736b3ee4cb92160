#include "visuals/verify/painted_check.h"

#include "visuals/verify/invalid_certificate.h"
#include "visuals/verify/coplanar_layers.h"

#include <fmt/format.h>
#include <utility>

namespace octant::visuals::verify {

namespace {

[[noreturn]] void fail_at_repeat(std::uint32_t polygon, int line) {
    throw InvalidCertificate{line, fmt::format("expected each polygon painted once, got {} again", polygon)};
}

[[noreturn]] void fail_layer_order(const PolygonPair& pair, int line) {
    throw InvalidCertificate{
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
    const Certificate& certificate, const ExactSides& sides, const PairCheck& pair_check)
    : certificate_(certificate)
    , pair_check_(pair_check)
    , coplanar_layer_pairs_(coplanar_layer_pairs(certificate, sides))
    , mark_(certificate.polygons.size(), 0) {}

std::uint64_t PaintedCheck::require_painted(
    int child,
    std::span<const std::uint32_t> expected,
    std::span<const std::uint32_t> painted,
    const RegionPlanes& region_planes) {
    enum : char { None, Expected, Painted };

    const int line = certificate_.line_of(child);
    const Statements& claims = certificate_.statements_of(child);
    for (const std::uint32_t polygon : expected) {
        mark_[polygon] = Expected;
    }
    for (const std::uint32_t polygon : painted) {
        if (std::exchange(mark_[polygon], Painted) != Expected) {
            fail_at_repeat(polygon, line);
        }
    }
    std::uint64_t unlisted = 0;
    for (const std::uint32_t polygon : expected) {
        if (std::exchange(mark_[polygon], None) == Painted || claims.unproved.contains(polygon)) {
            continue;
        }
        const auto away = claims.away.find(polygon);
        if (away == claims.away.end()) {
            throw InvalidCertificate{
                line,
                fmt::format(
                    "expected polygon {} painted or proved to face away, got neither", polygon)};
        }
        pair_check_.check_away(polygon, away->second, region_planes);
        ++unlisted;
    }
    return unlisted;
}

void PaintedCheck::require_disjoint(
    int line, const std::array<std::span<const std::uint32_t>, 4>& parts) {
    constexpr std::array<char, 4> marks{1, 2, 3, 4};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (const std::uint32_t polygon : parts[i]) {
            const char before = std::exchange(mark_[polygon], marks[i]);
            if (before != 0 && !(before == marks[2] && i == 3)) {
                fail_at_repeat(polygon, line);
            }
        }
    }
    for (const auto& part : parts) {
        for (const std::uint32_t polygon : part) {
            mark_[polygon] = 0;
        }
    }
}

void PaintedCheck::require_layer_order(std::span<const std::uint32_t> list, int line) const {
    if (coplanar_layer_pairs_.empty()) {
        return;
    }
    const auto places = places_of(list);
    for (const PolygonPair& pair : coplanar_layer_pairs_) {
        const auto lower = places.find(pair.earlier);
        const auto upper = places.find(pair.later);
        if (lower != places.end() && upper != places.end() && upper->second < lower->second) {
            fail_layer_order(pair, line);
        }
    }
}

void PaintedCheck::require_layer_order(
    std::span<const std::uint32_t> first, std::span<const std::uint32_t> later, int line) const {
    if (coplanar_layer_pairs_.empty()) {
        return;
    }
    const auto places_first = places_of(first);
    const auto places_later = places_of(later);
    for (const PolygonPair& pair : coplanar_layer_pairs_) {
        if (places_first.contains(pair.later) && places_later.contains(pair.earlier)) {
            fail_layer_order(pair, line);
        }
    }
}

} // namespace octant::visuals::verify
