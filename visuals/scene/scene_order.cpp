#include "visuals/scene/scene_order.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace octant::visuals::scene {

namespace {

/// False when the spheres around two boxes are seen apart, with nothing said about the boxes.
bool spheres_may_overlap_on_screen(
    const glm::dvec3& a_m, double a_radius_m, const glm::dvec3& b_m, double b_radius_m) {
    const double a_distance_m = glm::length(a_m);
    const double b_distance_m = glm::length(b_m);
    if (a_distance_m <= a_radius_m || b_distance_m <= b_radius_m) {
        return true;
    }
    const double cosine = glm::dot(a_m, b_m) / (a_distance_m * b_distance_m);
    const double between_rad = std::acos(glm::clamp(cosine, -1.0, 1.0));
    return between_rad <=
           std::asin(a_radius_m / a_distance_m) + std::asin(b_radius_m / b_distance_m) + 1e-7;
}

} // namespace

void SceneOrder::arrange(std::span<const HullBox> boxes) {
    roots_.resize(boxes.size());
    std::iota(roots_.begin(), roots_.end(), 0U);
    // Each failed try joins knots, so that there are fewer of them in the next.
    while (!try_to_arrange(boxes)) {
    }
    list_members();
}

bool SceneOrder::try_to_arrange(std::span<const HullBox> boxes) {
    gather(boxes);
    if (!compare_near_pairs()) {
        return false;
    }
    std::ranges::sort(windows_);
    std::size_t next = 0;
    while (next < windows_.size()) {
        auto [first, last] = windows_[next++];
        while (next < windows_.size() && windows_[next].first <= last) {
            last = std::max(last, windows_[next++].second);
        }
        if (!sort_window(first, last)) {
            return false;
        }
    }
    return true;
}

/// One body for each root, farthest first.
void SceneOrder::gather(std::span<const HullBox> boxes) {
    bodies_.clear();
    body_of_root_.resize(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (roots_[i] == i) {
            body_of_root_[i] = static_cast<std::uint32_t>(bodies_.size());
            bodies_.push_back({boxes[i], 0.0, 0.0, i});
            continue;
        }
        Body& body = bodies_[body_of_root_[roots_[i]]];
        const HullExtent a = world_extent(body.box);
        const HullExtent b = world_extent(boxes[i]);
        body.box = box_between({glm::min(a.least_m, b.least_m), glm::max(a.most_m, b.most_m)});
    }
    for (Body& body : bodies_) {
        body.radius_m = radius_m(body.box);
        body.power_m2 =
            glm::dot(body.box.centre_m, body.box.centre_m) - body.radius_m * body.radius_m;
    }
    std::ranges::sort(bodies_, [](const Body& a, const Body& b) {
        return a.power_m2 != b.power_m2 ? a.power_m2 > b.power_m2 : a.root < b.root;
    });
}

/// Sweeps along x for bodies whose spheres meet. Notes the windows of the list in which a body
/// stands before one that it hides; false when bodies were joined.
bool SceneOrder::compare_near_pairs() {
    windows_.clear();
    by_x_.resize(bodies_.size());
    std::iota(by_x_.begin(), by_x_.end(), 0U);
    const auto least_x = [&](std::uint32_t i) {
        return bodies_[i].box.centre_m.x - bodies_[i].radius_m;
    };
    std::ranges::sort(by_x_, [&](std::uint32_t a, std::uint32_t b) {
        return least_x(a) != least_x(b) ? least_x(a) < least_x(b) : a < b;
    });
    bool joined = false;
    for (std::size_t i = 0; i < by_x_.size(); ++i) {
        const Body& body = bodies_[by_x_[i]];
        const double most_x = body.box.centre_m.x + body.radius_m;
        for (std::size_t k = i + 1; k < by_x_.size() && least_x(by_x_[k]) <= most_x; ++k) {
            const Body& other = bodies_[by_x_[k]];
            const glm::dvec3 apart_m = other.box.centre_m - body.box.centre_m;
            const double touch_m = body.radius_m + other.radius_m;
            if (glm::dot(apart_m, apart_m) > touch_m * touch_m) {
                continue;
            }
            const auto [earlier, later] = std::minmax(by_x_[i], by_x_[k]);
            const HidingPair pair = hiding_pair(bodies_[earlier].box, bodies_[later].box);
            if (pair.meet) {
                join(bodies_[earlier].root, bodies_[later].root);
                joined = true;
            } else if (pair.a_hides_b) {
                windows_.emplace_back(earlier, later);
            }
        }
    }
    return !joined;
}

void SceneOrder::fill_precedences(std::uint32_t first, std::uint32_t count) {
    precedes_.assign(std::size_t{count} * count, 0);
    for (std::uint32_t a = 0; a < count; ++a) {
        const Body& earlier = bodies_[first + a];
        for (std::uint32_t b = a + 1; b < count; ++b) {
            const Body& later = bodies_[first + b];
            if (!spheres_may_overlap_on_screen(
                    earlier.box.centre_m, earlier.radius_m, later.box.centre_m, later.radius_m)) {
                continue;
            }
            const HidingPair pair = hiding_pair(earlier.box, later.box);
            precedes_[std::size_t{a} * count + b] = pair.b_hides_a ? 1 : 0;
            precedes_[std::size_t{b} * count + a] = pair.a_hides_b ? 1 : 0;
        }
    }
}

/// Sorts bodies first .. last so that none hides a later one, those of great power first where that
/// leaves a choice; false when a ring was joined.
bool SceneOrder::sort_window(std::uint32_t first, std::uint32_t last) {
    const std::uint32_t count = last - first + 1;
    fill_precedences(first, count);
    placed_.assign(count, 0);
    sorted_.clear();
    while (sorted_.size() < count) {
        std::uint32_t next = 0;
        const auto must_wait = [&](std::uint32_t body) {
            for (std::uint32_t other = 0; other < count; ++other) {
                if (placed_[other] == 0 && precedes_[std::size_t{other} * count + body] != 0) {
                    return true;
                }
            }
            return false;
        };
        while (next < count && (placed_[next] != 0 || must_wait(next))) {
            ++next;
        }
        if (next == count) {
            join_a_ring(first, count);
            return false;
        }
        placed_[next] = 1;
        sorted_.push_back(bodies_[first + next]);
    }
    std::ranges::copy(sorted_, bodies_.begin() + first);
    return true;
}

/// Walks from a body that cannot be placed to one that it waits for, until a body comes again.
void SceneOrder::join_a_ring(std::uint32_t first, std::uint32_t count) {
    const auto waits_for = [&](std::uint32_t body) {
        std::uint32_t other = 0;
        while (placed_[other] != 0 || precedes_[std::size_t{other} * count + body] == 0) {
            ++other;
        }
        return other;
    };
    std::uint32_t start = 0;
    while (placed_[start] != 0) {
        ++start;
    }
    for (std::uint32_t step = 0; step < count; ++step) {
        start = waits_for(start); // after so many steps within the ring
    }
    for (std::uint32_t body = waits_for(start); body != start; body = waits_for(body)) {
        join(bodies_[first + start].root, bodies_[first + body].root);
    }
}

void SceneOrder::join(std::uint32_t root, std::uint32_t other) {
    const std::uint32_t a = roots_[root]; // may have been joined since
    const std::uint32_t b = roots_[other];
    const auto [kept, lost] = std::minmax(a, b);
    std::ranges::replace(roots_, std::uint32_t{lost}, std::uint32_t{kept});
}

void SceneOrder::list_members() {
    knots_.clear();
    members_.clear();
    std::uint32_t place = 0;
    for (const Body& body : bodies_) {
        body_of_root_[body.root] = static_cast<std::uint32_t>(knots_.size());
        knots_.push_back({body.box, 0, 0});
    }
    for (const std::uint32_t root : roots_) {
        ++knots_[body_of_root_[root]].count;
    }
    for (Knot& knot : knots_) {
        knot.first = place;
        place += knot.count;
        knot.count = 0;
    }
    members_.resize(roots_.size());
    for (std::uint32_t i = 0; i < roots_.size(); ++i) {
        Knot& knot = knots_[body_of_root_[roots_[i]]];
        members_[knot.first + knot.count++] = i;
    }
}

} // namespace octant::visuals::scene
