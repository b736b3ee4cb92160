// The outside judge of painting orders: a ray shows the polygon that is painted last among those that it meets from the
// front. That must be the nearest one of the ordered model, and a piece of the nearest one of the model that was given;
// of polygons that lie in one plane the later one of the file. What a margin leaves open is not held against the
// builder.
#include "tests/fuzz/painting_check.h"

#include "sim/base/random_generator.h"
#include "tests/fuzz/facets.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::tests::fuzz {

namespace {

/// Eyes and targets where painting orders go wrong: eyes on all scales and near the planes at which facings and cells
/// change, targets all over polygons and close to their sides.
class RaySource {
public:
    /// Keeps a reference to `facets`.
    RaySource(const Facets& facets, std::uint64_t seed) : facets_(facets), dice_(seed) {}

    /// The next eye, body axes, metres.
    glm::dvec3 next_eye_m();

    /// A direction (unit) from an eye (from the model's middle) to a polygon that faces it, if one is found quickly.
    Vec next_ray(const Vec& eye);

private:
    const Facet& any_facet();
    Vec point_of(const Facet& facet);
    Vec point_by_side(const Facet& facet);
    /// 10 to a power that is spread evenly.
    long double power(double least, double most);

    Vec direction() { return Vec(dice_.direction()); }

    const Facets& facets_;
    RandomGenerator dice_;
    int eyes_ = 0;
};

constexpr int kinds_of_eyes = 8;
constexpr int tries_for_a_facing_polygon = 12;
constexpr double share_of_rays_by_sides = 0.4;

long double RaySource::power(double least, double most) {
    return std::pow(10.0L, static_cast<long double>(dice_.between(least, most)));
}

const Facet& RaySource::any_facet() {
    const auto count = static_cast<double>(facets_.all.size());
    return facets_.all[static_cast<std::size_t>(dice_.next() * count)];
}

Vec RaySource::point_of(const Facet& facet) {
    Vec sum(0.0L);
    long double weights = 0.0L;
    for (const Vec& corner : facet.corners) {
        const auto even = static_cast<long double>(dice_.next());
        const long double weight = even * even + 1e-6L;
        sum += corner * weight;
        weights += weight;
    }
    return sum / weights;
}

Vec RaySource::point_by_side(const Facet& facet) {
    const std::size_t count = facet.corners.size();
    const auto side = static_cast<std::size_t>(dice_.next() * static_cast<double>(count));
    const auto share = static_cast<long double>(dice_.next());
    const Vec at = facet.corners[side] * share + facet.corners[(side + 1) % count] * (1.0L - share);
    return at + direction() * (power(-7.5, -1.0) * facets_.size_m);
}

glm::dvec3 RaySource::next_eye_m() {
    const long double size_m = facets_.size_m;
    Vec eye(0.0L);
    switch (eyes_++ % kinds_of_eyes) {
    case 0: // far away, where rays are nearly parallel
        eye = direction() * (power(1.0, 3.0) * size_m);
        break;
    case 1: // inside the bounding sphere
        eye = direction() * (std::cbrt(static_cast<long double>(dice_.next())) * 0.5L * size_m);
        break;
    case 2: // right before a polygon or behind it
        eye = point_of(any_facet()) + direction() * (power(-4.0, -1.0) * size_m);
        break;
    case 3: { // beside a polygon, close to its plane
        const Facet& facet = any_facet();
        eye = facet.middle + direction() * (power(-0.5, 0.5) * size_m);
        const long double off_m = (dice_.next() < 0.5 ? -1.0L : 1.0L) * power(-6.0, -2.0) * size_m;
        eye += facet.normal * (off_m - glm::dot(eye - facet.middle, facet.normal));
        break;
    }
    default:
        eye = direction() * (power(-0.6, 1.0) * size_m);
        break;
    }
    return glm::dvec3(eye + facets_.middle_m);
}

Vec RaySource::next_ray(const Vec& eye) {
    const Facet* facet = &any_facet();
    for (int i = 0; i < tries_for_a_facing_polygon; ++i) {
        if (glm::dot(eye - facet->middle, facet->normal) > 0.0L) { break; }
        facet = &any_facet();
    }
    const bool by_side = dice_.next() < share_of_rays_by_sides;
    const Vec target = by_side ? point_by_side(*facet) : point_of(*facet);
    return target == eye ? Vec(1.0L, 0.0L, 0.0L) : glm::normalize(target - eye);
}

using models::polygons::PolygonModel;

constexpr int rays_per_eye = 20;
constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

std::vector<std::uint32_t> painted_for(const visuals::draworder::DrawOrder& order, const glm::dvec3& eye_m) {
    std::vector<std::uint32_t> painted;
    visuals::draworder::DrawOrder::Walk walk;
    order.append_painted(eye_m, walk, painted);
    return painted;
}

/// A polygon and how the ray at hand meets it.
struct Met {
    std::uint32_t polygon = 0;
    Hit hit;
};

class Checking {
public:
    Checking(const PolygonModel& given, const visuals::draworder::OrderedModel& ordered, const RaySamples& samples)
        : given_(given), ordered_(ordered), given_facets_(facets_of(given, picture_margin_sizes, true)),
          facets_(facets_of(ordered.model, order_margin_sizes, false)), source_(given_facets_, samples.seed),
          rays_(samples.rays) {}

    PaintingCounts run() {
        while (counts_.rays < rays_) { look_from(source_.next_eye_m()); }
        return counts_;
    }

private:
    void look_from(const glm::dvec3& eye_m) {
        eye_m_ = eye_m;
        painted_ = painted_for(ordered_.order, eye_m);
        if (!is_proper(painted_)) {
            ++counts_.bad_sequences;
            note("the sequence repeats a polygon or names one that is not there");
            counts_.rays += rays_per_eye;
            return;
        }
        const Vec for_given = Vec(eye_m) - given_facets_.middle_m;
        for (int i = 0; i < rays_per_eye; ++i) {
            ray_ = source_.next_ray(for_given);
            look_along();
        }
    }

    bool is_proper(std::span<const std::uint32_t> painted) {
        used_.assign(facets_.all.size(), false);
        for (const std::uint32_t polygon : painted) {
            if (polygon >= used_.size() || used_[polygon]) { return false; }
            used_[polygon] = true;
        }
        return true;
    }

    void look_along() {
        ++counts_.rays;
        const std::optional<std::uint32_t> seen = judge_order();
        if (!seen) { return; }
        judge_picture(*seen);
    }

    /// The polygon that is seen, `nothing`, or no answer where a margin leaves it open or the order has been found
    /// wrong.
    std::optional<std::uint32_t> judge_order() {
        const Vec eye = Vec(eye_m_) - facets_.middle_m;
        Met seen{nothing, {Meeting::Missed, std::numeric_limits<long double>::infinity(), 0.0L}};
        bool open = false;
        Met nearest = seen;
        for (const std::uint32_t polygon : painted_) {
            const Hit hit = meet(facets_.all[polygon], eye, ray_);
            if (hit.meeting == Meeting::Hit) {
                seen = {polygon, hit};
                open = false;
                nearest = hit.depth_m < nearest.hit.depth_m ? seen : nearest;
            } else if (hit.meeting == Meeting::Doubtful) {
                open = true;
            }
        }
        for (std::uint32_t polygon = 0; polygon < used_.size(); ++polygon) {
            const Hit hit = used_[polygon] ? Hit{} : meet(facets_.all[polygon], eye, ray_);
            if (hit.meeting == Meeting::Hit && hit.depth_m < nearest.hit.depth_m) { nearest = {polygon, hit}; }
        }
        const long double margin_m = seen.hit.margin_m + nearest.hit.margin_m;
        if (!open && nearest.polygon != nothing && seen.hit.depth_m > nearest.hit.depth_m + margin_m) {
            ++counts_.wrong_order;
            note(fmt::format("{} is seen, but {} is nearer, by {:.3g} sizes", piece_name(seen.polygon),
                piece_name(nearest.polygon), double((seen.hit.depth_m - nearest.hit.depth_m) / facets_.size_m)));
            return std::nullopt;
        }
        counts_.open += open ? 1 : 0;
        return open ? std::nullopt : std::optional(seen.polygon);
    }

    void judge_picture(std::uint32_t seen) {
        const Vec eye = Vec(eye_m_) - given_facets_.middle_m;
        met_.clear();
        Met nearest{nothing, {Meeting::Missed, std::numeric_limits<long double>::infinity(), 0.0L}};
        for (std::uint32_t polygon = 0; polygon < given_facets_.all.size(); ++polygon) {
            const Hit hit = meet(given_facets_.all[polygon], eye, ray_);
            if (hit.meeting != Meeting::Missed) { met_.push_back({polygon, hit}); }
            if (hit.meeting == Meeting::Hit && hit.depth_m < nearest.hit.depth_m) { nearest = met_.back(); }
        }
        if (nearest.polygon == nothing) {
            counts_.open += met_.empty() && seen == nothing ? 0 : 1;
            if (met_.empty() && seen != nothing && !by_side_of(ordered_.model.parent_of(seen))) {
                ++counts_.wrong_picture;
                note(piece_name(seen) + " is seen where nothing is");
            }
            return;
        }
        ++counts_.hits;
        judge_parent(seen == nothing ? nothing : ordered_.model.parent_of(seen), nearest);
    }

    /// Whether the ray passes a side of a polygon of the file within the margin.
    bool by_side_of(std::uint32_t parent) const {
        const Vec eye = Vec(eye_m_) - given_facets_.middle_m;
        for (std::uint32_t polygon = 0; polygon < given_facets_.all.size(); ++polygon) {
            if (given_.parent_of(polygon) == parent && passes_side(given_facets_.all[polygon], eye, ray_)) {
                return true;
            }
        }
        return false;
    }

    /// Holds the polygon of the file that is seen against those that the ray meets first. Decals on it are looked for
    /// where each piece of it that may be seen is hit: a bent polygon has pieces in other planes, too.
    void judge_parent(std::uint32_t parent, const Met& nearest) {
        const Met* shown = nullptr;
        bool is_hit = true;
        bool open = false;
        for (const Met& met : met_) {
            const long double margin_m = met.hit.margin_m + nearest.hit.margin_m;
            if (met.hit.depth_m > nearest.hit.depth_m + margin_m) { continue; }
            if (given_.parent_of(met.polygon) == parent) {
                shown = &met;
                is_hit = is_hit && met.hit.meeting == Meeting::Hit;
            }
            open = open || met.hit.meeting == Meeting::Doubtful;
        }
        if (shown != nullptr) {
            if (is_hit) { judge_decals(*shown); }
        } else if (open || by_side_of(parent)) {
            ++counts_.open;
        } else {
            ++counts_.wrong_picture;
            note(fmt::format("{} is seen, nearest of the given ones is {}",
                parent == nothing ? "nothing" : fmt::format("P{}", parent + 1), given_name(nearest.polygon)));
        }
    }

    void judge_decals(const Met& shown) {
        const Facet& facet = given_facets_.all[shown.polygon];
        const long double within_m = 0.5L * order_margin_sizes * given_facets_.size_m + 2.0L * given_facets_.noise_m;
        for (const Met& met : met_) {
            if (met.hit.meeting == Meeting::Hit && met.polygon != shown.polygon &&
                given_.parent_of(met.polygon) > given_.parent_of(shown.polygon) &&
                same_plane(facet, given_facets_.all[met.polygon], within_m)) {
                ++counts_.wrong_decal;
                note(fmt::format("{} is seen, but {} in its plane comes later in the file", given_name(shown.polygon),
                    given_name(met.polygon)));
                return;
            }
        }
    }

    std::string piece_name(std::uint32_t piece) const {
        return piece == nothing ? "nothing"
                                : fmt::format("piece {} of P{}", piece + 1, ordered_.model.parent_of(piece) + 1);
    }

    std::string given_name(std::uint32_t polygon) const { return fmt::format("P{}", given_.parent_of(polygon) + 1); }

    void note(const std::string& what) {
        if (counts_.first.empty()) {
            counts_.first = fmt::format("from ({}, {}, {}) along ({:.9g}, {:.9g}, {:.9g}): {}", eye_m_.x, eye_m_.y,
                eye_m_.z, double(ray_.x), double(ray_.y), double(ray_.z), what);
        }
    }

    const PolygonModel& given_;
    const visuals::draworder::OrderedModel& ordered_;
    Facets given_facets_;
    Facets facets_; ///< of the ordered model
    RaySource source_;
    long rays_;
    PaintingCounts counts_;
    glm::dvec3 eye_m_{0.0};
    Vec ray_{1.0L, 0.0L, 0.0L};
    std::vector<std::uint32_t> painted_;
    std::vector<bool> used_; ///< one a polygon of the ordered model: it is painted
    std::vector<Met> met_;
};

} // namespace

PaintingCounts check_painting(
    const PolygonModel& given, const visuals::draworder::OrderedModel& ordered, const RaySamples& samples) {
    return Checking(given, ordered, samples).run();
}

} // namespace octant::tests::fuzz
