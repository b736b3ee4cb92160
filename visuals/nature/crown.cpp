#include "visuals/nature/crown.h"

#include "sim/base/hash.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::nature {

namespace {

/// Random numbers in [0, 1), the same on every machine.
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(scrambled(seed)) {}

    float next() {
        state_ = scrambled(state_ + 0x9e3779b9U);
        return static_cast<float>(state_ >> 8U) * (1.0F / 16777216.0F);
    }

    glm::vec3 next_direction() {
        const float x = next();
        const float y = next();
        return glm::vec3(x, y, next()) - 0.5F;
    }

private:
    std::uint32_t state_;
};

/// A clump of leaves.
struct Ball {
    glm::vec3 centre{0.0F};
    float radius = 0.0F;
};

/// One in the middle and others around it.
using Clumps = std::array<Ball, 24>;

Clumps make_clumps(Random& random) {
    Clumps clumps;
    clumps[0] = {glm::vec3(0.0F), 0.66F};
    for (std::size_t i = 1; i < clumps.size();) {
        const glm::vec3 way = random.next_direction();
        const float length = glm::length(way);
        if (length < 0.1F || length > 0.5F) { continue; }
        const float out = 0.56F + 0.16F * random.next();
        clumps[i++] = {way * (out / length), 0.24F + 0.16F * random.next()};
    }
    return clumps;
}

CrownPoint surface_of(const Clumps& clumps, const glm::vec3& way) {
    CrownPoint surface{0.0F};
    for (const Ball& ball : clumps) {
        const float along = glm::dot(way, ball.centre);
        const float rest = ball.radius * ball.radius - glm::dot(ball.centre, ball.centre) + along * along;
        const float exit = rest > 0.0F ? along + std::sqrt(rest) : 0.0F;
        if (exit > surface.radius) {
            surface.radius = exit;
            surface.normal = glm::normalize((exit * way - ball.centre) / ball.radius + 0.6F * way);
        }
    }
    surface.openness = (0.4F + 0.6F * glm::smoothstep(0.62F, 0.98F, surface.radius)) *
                       (0.50F + 0.50F * glm::smoothstep(-0.9F, 0.6F, way.z));
    // Crowns are flat below.
    if (way.z < 0.0F) { surface.radius = std::max(surface.radius, 0.8F) * 1.1F; }
    return surface;
}

/// The side of a cone that is pointed above, as high as `up` over the centre, and 1 wide where it ends at `down` below.
CrownPoint surface_of_cone(float up, float down, const glm::vec3& way) {
    const float level = glm::length(glm::vec2(way));
    const float height = up + down;
    CrownPoint surface;
    surface.radius = up / std::max(height * level + way.z, 1e-3F);
    if (way.z < 0.0F) { surface.radius = std::min(surface.radius, -down / way.z); }
    surface.normal = glm::vec3(0.8F * glm::vec2(way) / std::max(level, 1e-3F), way.z < -0.6F ? -0.6F : 0.6F);
    surface.openness = 0.70F + 0.30F * glm::smoothstep(-0.5F, 0.9F, way.z);
    return surface;
}

constexpr float max_radius = 0.98F; ///< the greatest distance of leaves from the axis

} // namespace

Crown::Crown(PlantKind kind, std::uint32_t variant) : is_cone_(kind == PlantKind::Conifer) {
    const std::uint32_t seed = 16U * static_cast<std::uint32_t>(kind) + variant;
    Random random(seed);
    const Clumps clumps = make_clumps(random);
    for (float& depth : notch_depths_) { depth = 0.08F + 0.14F * random.next(); }
    if (is_cone_) {
        lowest_ = 0.10F + 0.06F * random.next();
        centre_ = 0.62F;
    } else if (kind == PlantKind::Broadleaf) {
        lowest_ = 0.16F + 0.10F * random.next();
        centre_ = 0.54F + 0.04F * random.next();
    } else {
        lowest_ = 0.03F;
        centre_ = 0.35F;
    }
    const float rough = is_cone_ ? 0.14F : 0.30F;
    float top = 0.0F;
    for (std::size_t row = 0; row < nodes; ++row) {
        for (std::size_t column = 0; column < nodes; ++column) {
            // Those on the border that are there twice have the same leaves.
            constexpr std::size_t last = nodes - 1;
            const std::size_t own_row = column % last == 0 ? std::min(row, last - row) : row;
            const std::size_t own_column = own_row % last == 0 ? std::min(column, last - column) : column;
            Random leaves(seed + static_cast<std::uint32_t>(1024 * (own_row * nodes + own_column)));
            const float out = leaves.next() - 0.5F;
            const glm::vec3 way = direction_of(column, row);
            CrownPoint& point = points_[row * nodes + column];
            point =
                is_cone_ ? surface_of_cone(1.0F, (centre_ - lowest_) / (1.0F - centre_), way) : surface_of(clumps, way);
            point.radius *= 1.0F + rough * out;
            point.openness *= 1.0F + 0.4F * out;
            point.normal += rough * leaves.next_direction();
            top = std::max(top, point.radius * way.z);
        }
    }
    half_height_ = (1.0F - centre_) / (is_cone_ ? 1.0F : top);
    // Straight below its centre the crown meets the trunk.
    for (const std::size_t corner : {std::size_t{0}, nodes - 1, (nodes - 1) * nodes, nodes * nodes - 1}) {
        points_[corner].radius = (centre_ - lowest_) / half_height_;
    }
}

glm::vec3 Crown::direction_of(std::size_t column, std::size_t row) {
    constexpr float per_node = 2.0F / static_cast<float>(nodes - 1);
    const float u = static_cast<float>(column) * per_node - 1.0F;
    const float v = static_cast<float>(row) * per_node - 1.0F;
    const float up = 1.0F - std::abs(u) - std::abs(v);
    if (up >= 0.0F) { return glm::normalize(glm::vec3(u, v, up)); }
    return glm::normalize(glm::vec3(std::copysign(1.0F - std::abs(v), u), std::copysign(1.0F - std::abs(u), v), up));
}

CrownPoint Crown::at(const glm::vec3& way) const {
    const glm::vec3 on_octahedron = way / (std::abs(way.x) + std::abs(way.y) + std::abs(way.z));
    glm::vec2 at(on_octahedron);
    if (way.z < 0.0F) {
        at = {std::copysign(1.0F - std::abs(on_octahedron.y), way.x),
            std::copysign(1.0F - std::abs(on_octahedron.x), way.y)};
    }
    at = glm::clamp((at + 1.0F) * (0.5F * static_cast<float>(nodes - 1)), 0.0F, static_cast<float>(nodes - 1) - 1e-3F);
    const auto column = static_cast<std::size_t>(at.x);
    const auto row = static_cast<std::size_t>(at.y);
    const glm::vec2 part = at - glm::vec2(static_cast<float>(column), static_cast<float>(row));
    CrownPoint sum{0.0F, 0.0F};
    const auto add = [&](std::size_t node, float share) {
        sum.radius += share * points_[node].radius;
        sum.openness += share * points_[node].openness;
        sum.normal += share * points_[node].normal;
    };
    const std::size_t first = row * nodes + column;
    add(first, (1.0F - part.x) * (1.0F - part.y));
    add(first + 1, part.x * (1.0F - part.y));
    add(first + nodes, (1.0F - part.x) * part.y);
    add(first + nodes + 1, part.x * part.y);
    sum.radius = within_room(way, sum.radius);
    return sum;
}

/// A distance on a ray, or less where the plant's circle and height end.
float Crown::within_room(const glm::vec3& way, float radius) const {
    const float level = glm::length(glm::vec2(way));
    const float room = way.z < 0.0F ? centre_ - lowest_ : 1.0F - centre_;
    return std::min(
        {radius, max_radius / std::max(level, 1e-3F), room / std::max(half_height_ * std::abs(way.z), 1e-3F)});
}

namespace {

/// Unit vectors, counter-clockwise from the right: of spokes, and of others between them.
std::array<glm::vec2, CrownSide::max_corners> make_ways(bool is_conifer) {
    constexpr float cosine = 0.866025404F;
    constexpr std::array<glm::vec2, CrownSide::spokes> around{glm::vec2(1.0F, 0.0F), {cosine, 0.5F}, {0.5F, cosine},
        {0.0F, 1.0F}, {-0.5F, cosine}, {-cosine, 0.5F}, {-1.0F, 0.0F}, {-cosine, -0.5F}, {-0.5F, -cosine},
        {0.0F, -1.0F}, {0.5F, -cosine}, {cosine, -0.5F}};
    constexpr std::array<glm::vec2, CrownSide::spokes> on_cone{glm::vec2(0.81F, -0.85F), {0.59F, -0.35F},
        {0.35F, 0.20F}, {0.0F, 1.0F}, {-0.35F, 0.20F}, {-0.59F, -0.35F}, {-0.81F, -0.85F}, {-1.0F, -1.29F},
        {-0.5F, -1.29F}, {0.0F, -1.0F}, {0.5F, -1.29F}, {1.0F, -1.29F}};
    std::array<glm::vec2, CrownSide::max_corners> ways;
    for (std::size_t i = 0; i < around.size(); ++i) {
        ways[4 * i] = glm::normalize((is_conifer ? on_cone : around)[i]);
    }
    for (const std::size_t step : {4U, 2U}) {
        for (std::size_t i = 0; i < ways.size(); i += step) {
            ways[i + step / 2] = glm::normalize(ways[i] + ways[(i + step) % ways.size()]);
        }
    }
    return ways;
}

/// Finds corners on the side of a crown that faces an eye.
class CrownView {
public:
    CrownView(const Crown& crown, const glm::vec3& eye)
        : crown_(crown), distance_(std::max(glm::length(eye), 1e-3F)), to_eye_(eye / distance_),
          right_(glm::normalize(glm::vec3(-to_eye_.y, to_eye_.x + 1e-6F, 0.0F))), up_(glm::cross(to_eye_, right_)) {}

    /// The cosine between the way to the eye and that to the outline: where lines of sight touch a ball.
    float outline_cosine() const { return std::min(0.9F / distance_, 0.8F); }

    /// On the ray from the centre that is turned from the eye to a side by an angle of this cosine. The eye sees it off
    /// the axis by `max_off_axis` at most.
    CrownSide::Corner corner_on(const glm::vec2& side, float cosine, float max_off_axis) const {
        const float sine = std::sqrt(1.0F - cosine * cosine);
        const glm::vec3 way = cosine * to_eye_ + sine * (side.x * right_ + side.y * up_);
        const CrownPoint point = crown_.at(way);
        constexpr float before_eye = 0.8F; // of the eye's distance: an eye within the crown sees it before itself
        const float radius = std::min({point.radius, max_off_axis * distance_ / (sine + max_off_axis * cosine),
            before_eye * distance_ / std::max(cosine, 1e-3F)});
        return {radius * way, point.normal, point.openness, off_axis(radius * way)};
    }

    float off_axis(const glm::vec3& from_centre) const {
        return off_axis_m(from_centre) / (distance_ - glm::dot(from_centre, to_eye_));
    }

    /// Where the straight line between two corners on the outline meets the spoke amid theirs.
    CrownSide::Corner between(const CrownSide::Corner& one, const CrownSide::Corner& other) const {
        const float out = off_axis_m(one.from_centre);
        return mixed(one, other, out / std::max(out + off_axis_m(other.from_centre), 1e-6F));
    }

    CrownSide::Corner mixed(const CrownSide::Corner& one, const CrownSide::Corner& other, float share) const {
        const glm::vec3 from_centre = glm::mix(one.from_centre, other.from_centre, share);
        return {from_centre, glm::mix(one.normal, other.normal, share), glm::mix(one.openness, other.openness, share),
            off_axis(from_centre)};
    }

private:
    float off_axis_m(const glm::vec3& from_centre) const {
        return glm::length(glm::vec2(glm::dot(from_centre, right_), glm::dot(from_centre, up_)));
    }

    const Crown& crown_;
    float distance_;
    glm::vec3 to_eye_;
    glm::vec3 right_;
    glm::vec3 up_;
};

constexpr float far_off = 1e3F;
constexpr float max_ring_share = 0.52F; ///< of the outline's distance from the middle

float cross(const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; }

/// How far out the straight line between two points meets the ray along a unit vector.
float off_axis_between(const glm::vec2& one, const glm::vec2& other, const glm::vec2& way) {
    return cross(one, other) / (cross(one, way) + cross(way, other));
}

} // namespace

CrownSide::CrownSide(const Crown& crown, const glm::vec3& eye, float fineness) : has_ring(fineness > 0.0F) {
    if (fineness > 1.0F) { step = fineness > 2.0F ? 1 : 2; }
    static const std::array ways_of{make_ways(false), make_ways(true)};
    const std::array<glm::vec2, max_corners>& ways = ways_of[crown.is_cone() ? 1 : 0];
    const CrownView view(crown, eye);
    const float cosine = view.outline_cosine();
    middle = view.corner_on({1.0F, 0.0F}, 1.0F, far_off);
    for (std::size_t i = 0; i < max_corners; i += 4) { outline[i] = view.corner_on(ways[i], cosine, far_off); }
    if (!crown.is_cone() && fineness > 1.0F) {
        for (std::size_t i = 0; i < max_corners; i += 4) {
            const float notch = crown.notch_depth(i / 4) * std::clamp(0.5F * (fineness - 1.0F), 0.0F, 1.0F);
            outline[i] = view.corner_on(ways[i], cosine, (1.0F - notch) * outline[i].off_axis);
            outline[i].openness *= 1.0F - 2.0F * notch;
        }
    }
    // Seen from the side, the lowest corner reaches the trunk.
    Corner& lowest_corner = outline[3 * max_corners / 4];
    const glm::vec3 bottom = crown.from_centre({0.0F, 0.0F, crown.lowest()});
    if (view.off_axis(bottom) > lowest_corner.off_axis) {
        lowest_corner.from_centre = bottom;
        lowest_corner.off_axis = view.off_axis(bottom);
    }
    for (const std::size_t wide : {std::size_t{4}, std::size_t{2}}) {
        if (step >= wide) { break; }
        const float come = std::min(fineness - (wide == 4 ? 1.0F : 2.0F), 1.0F);
        // Corners between the ends of boughs are such ends when there are others between them.
        const float between_ends = wide == 4 ? std::clamp(3.0F - fineness, 0.0F, 1.0F) : 1.0F;
        for (std::size_t i = 0; i < max_corners; i += wide) {
            const float notch = crown.is_cone() ? between_ends * crown.notch_depth(i / 4) : 0.0F;
            const std::size_t next = (i + wide) % max_corners;
            const Corner chord = view.between(outline[i], outline[next]);
            const glm::vec2 way = glm::normalize(ways[i + wide / 2] + glm::vec2(0.0F, 0.5F * notch));
            // Farther in it would be seen beyond the side of a triangle from the ring to the next corner.
            const float in_ring = max_ring_share * outline[i / 4 * 4].off_axis;
            const float min_off = off_axis_between(ways[i / 4 * 4] * in_ring, ways[next] * outline[next].off_axis, way);
            Corner own = view.corner_on(way, cosine, (1.0F - notch) * (notch > 0.0F ? chord.off_axis : far_off));
            own.openness *= 1.0F - 2.0F * notch;
            const float near = (chord.off_axis - min_off) / std::max(chord.off_axis - own.off_axis, 1e-6F);
            if (own.off_axis < min_off) { own = view.mixed(chord, own, std::clamp(0.9F * near, 0.0F, 1.0F)); }
            outline[i + wide / 2] = view.mixed(chord, own, come);
        }
    }
    if (!has_ring) { return; }
    for (std::size_t i = 0; i < spokes; ++i) {
        const Corner& end = outline[4 * i];
        const Corner own = view.corner_on(ways[4 * i], 0.8F + 0.2F * cosine, max_ring_share * end.off_axis);
        ring[i] = view.mixed(view.mixed(middle, end, 0.45F), own, std::min(fineness, 1.0F));
    }
}

} // namespace octant::visuals::nature
