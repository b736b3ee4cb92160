#include "visuals/nature/crown.h"

#include "sim/base/hash.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace octant::visuals::nature {

namespace {

constexpr std::size_t base_vertices = Icosphere::vertex_counts[0];

Icosphere::Face face_of(const Icosphere& sphere, const std::array<std::uint8_t, 3>& corners) {
    const glm::vec3& a = sphere.directions[corners[0]];
    const glm::vec3 normal = glm::cross(sphere.directions[corners[1]] - a, sphere.directions[corners[2]] - a);
    return {corners, normal / glm::dot(normal, a)};
}

} // namespace

Icosphere::Icosphere() {
    directions[0] = glm::vec3(0.0F, 0.0F, 1.0F);
    directions[11] = -directions[0];
    constexpr float up = 0.447213595F;
    constexpr std::array<glm::vec2, 5> around{glm::vec2(1.0F, 0.0F), {0.309016994F, 0.951056516F},
        {-0.809016994F, 0.587785252F}, {-0.809016994F, -0.587785252F}, {0.309016994F, -0.951056516F}};
    for (std::size_t i = 0; i < 5; ++i) {
        directions[1 + i] = glm::vec3(2.0F * up * around[i], up);
        directions[6 + i] = glm::vec3(-2.0F * up * around[(i + 3) % 5], -up);
    }
    for (std::uint8_t i = 0; i < 5; ++i) {
        const auto next = static_cast<std::uint8_t>((i + 1) % 5);
        const auto upper = [](std::uint8_t number) { return static_cast<std::uint8_t>(1 + number); };
        const auto lower = [](std::uint8_t number) { return static_cast<std::uint8_t>(6 + number); };
        faces[0].push_back(face_of(*this, {0, upper(i), upper(next)}));
        faces[0].push_back(face_of(*this, {upper(i), lower(i), upper(next)}));
        faces[0].push_back(face_of(*this, {lower(i), lower(next), upper(next)}));
        faces[0].push_back(face_of(*this, {11, lower(next), lower(i)}));
    }
    add_level(1);
    add_level(2);
}

void Icosphere::add_level(std::size_t level) {
    std::map<std::pair<std::uint8_t, std::uint8_t>, std::uint8_t> middles;
    auto next = static_cast<std::uint8_t>(vertex_counts[level - 1]);
    const auto middle_of = [&](std::uint8_t a, std::uint8_t b) {
        const auto [known, is_new] = middles.try_emplace(std::minmax(a, b), next);
        if (is_new) {
            parents[next] = {std::min(a, b), std::max(a, b)};
            directions[next] = glm::normalize(directions[a] + directions[b]);
            ++next;
        }
        return known->second;
    };
    for (const Face& face : faces[level - 1]) {
        const auto& [a, b, c] = face.corners;
        const std::uint8_t ab = middle_of(a, b);
        const std::uint8_t bc = middle_of(b, c);
        const std::uint8_t ca = middle_of(c, a);
        for (const std::array<std::uint8_t, 3>& part :
            {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
            faces[level].push_back(face_of(*this, part));
        }
    }
}

const Icosphere& icosphere() {
    static const Icosphere sphere;
    return sphere;
}

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

/// A place of the surface as seen along a ray: its distance, where the icosphere has 1.
struct SurfacePoint {
    float radius = 1.0F;
    glm::vec3 normal{0.0F};
    float openness = 1.0F;
};

/// A clump of leaves.
struct Ball {
    glm::vec3 centre{0.0F};
    float radius = 0.0F;
};

/// One ball at each corner of the icosahedron, and one in the middle.
using Clumps = std::array<Ball, base_vertices + 1>;

Clumps make_clumps(Random& random) {
    Clumps clumps;
    for (std::size_t i = 0; i < base_vertices; ++i) {
        const glm::vec3 way = glm::normalize(icosphere().directions[i] + 0.55F * random.next_direction());
        clumps[i] = {way * (0.52F + 0.16F * random.next()), 0.34F + 0.10F * random.next()};
    }
    clumps[base_vertices] = {glm::vec3(0.0F), 0.60F};
    return clumps;
}

SurfacePoint surface_of(const Clumps& clumps, const glm::vec3& way) {
    SurfacePoint surface{0.0F};
    for (const Ball& ball : clumps) {
        const float along = glm::dot(way, ball.centre);
        const float rest = ball.radius * ball.radius - glm::dot(ball.centre, ball.centre) + along * along;
        const float exit = rest > 0.0F ? along + std::sqrt(rest) : 0.0F;
        if (exit > surface.radius) {
            surface.radius = exit;
            surface.normal = glm::normalize((exit * way - ball.centre) / ball.radius + 0.6F * way);
        }
    }
    surface.openness = (0.25F + 0.75F * glm::smoothstep(0.58F, 0.98F, surface.radius)) *
                       (0.62F + 0.38F * glm::smoothstep(-1.0F, 0.5F, way.z));
    return surface;
}

/// The greatest distance of a vertex from the axis.
constexpr float max_radius = 0.98F;
constexpr float roughness = 0.26F; ///< of the leaves' surface, of its distance from the centre

} // namespace

float Crown::within_room(const glm::vec3& way, float radius) const {
    const float level = glm::length(glm::vec2(way));
    const float room = way.z < 0.0F ? centre - lowest : 1.0F - centre;
    return std::min(
        {radius, max_radius / std::max(level, 1e-3F), room / std::max(half_height * std::abs(way.z), 1e-3F)});
}

namespace {

/// Places the vertices on their rays within the plant's circle and height.
void place(Crown& crown, const std::array<SurfacePoint, Icosphere::vertex_counts[2]>& surface) {
    const Icosphere& sphere = icosphere();
    std::array<float, Icosphere::vertex_counts[2]> radii{};
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const glm::vec3& way = sphere.directions[i];
        radii[i] = crown.within_room(way, surface[i].radius);
        const glm::vec3 from_centre = radii[i] * way * glm::vec3(1.0F, 1.0F, crown.half_height);
        const auto& [a, b] = sphere.parents[i];
        const float on_chord = a == b ? 0.5F : radii[a] / (radii[a] + radii[b]);
        crown.vertices[i] = {glm::vec3(0.0F, 0.0F, crown.centre) + from_centre, surface[i].normal, surface[i].openness,
            radii[i], on_chord};
    }
}

} // namespace

Crown make_crown(PlantKind kind, std::uint32_t variant) {
    Random random(16U * static_cast<std::uint32_t>(kind) + variant);
    std::array<SurfacePoint, Icosphere::vertex_counts[2]> surface;
    Crown crown;
    const Clumps clumps = make_clumps(random);
    float top = 0.0F;
    for (std::size_t i = 0; i < surface.size(); ++i) {
        const glm::vec3& way = icosphere().directions[i];
        surface[i] = surface_of(clumps, way);
        const float out = random.next() - 0.5F;
        surface[i].radius *= 1.0F + roughness * out;
        surface[i].openness *= 1.0F + 0.6F * out;
        surface[i].normal = glm::normalize(surface[i].normal + roughness * random.next_direction());
        top = std::max(top, surface[i].radius * way.z);
    }
    const bool is_tree = kind == PlantKind::Broadleaf;
    crown.lowest = is_tree ? 0.10F : 0.03F;
    crown.centre = is_tree ? 0.48F : 0.35F;
    if (is_tree) { surface[base_vertices - 1].radius *= 0.65F; } // the lowest: crowns are flat below
    crown.half_height = (1.0F - crown.centre) / top;
    place(crown, surface);
    crown.lowest =
        std::ranges::min_element(crown.vertices, {}, [](const Crown::Vertex& vertex) { return vertex.at.z; })->at.z;
    // Straight below its centre the crown meets the trunk, at every level.
    surface[base_vertices - 1].radius = (crown.centre - crown.lowest) / crown.half_height;
    place(crown, surface);
    return crown;
}

namespace {

/// The boughs of a tier end at every other side, long ones and short ones.
void make_radii(Random& random, std::size_t tier, TierRing& ring) {
    const float height = (TieredCrown::heights[tier] - TieredCrown::lowest) / (1.0F - TieredCrown::lowest);
    const float whole = max_radius * (1.0F - height) * (1.0F + 0.30F * height);
    const float open = 0.70F + 0.30F * height;
    for (std::size_t side = 0; side < TieredCrown::sides; ++side) {
        const bool is_end = TieredCrown::is_bough_end(tier, side);
        ring[side].radius = whole * ((is_end ? 0.80F : 0.54F) + (is_end ? 0.20F : 0.06F) * random.next());
        ring[side].openness = open * (is_end ? 1.0F : 0.72F);
    }
}

float min_radius(const TierRing& ring) { return std::ranges::min_element(ring, {}, &TierVertex::radius)->radius; }

/// The upper edge of a tier whose lower edge is `low` fits below the next one's lower edge.
float top_share(const TierRing& low, const TierRing& next) {
    constexpr float room = 0.85F;
    return std::min(room * min_radius(next) / std::ranges::max_element(low, {}, &TierVertex::radius)->radius, 1.0F);
}

} // namespace

TieredCrown::TieredCrown(std::uint32_t variant) {
    Random random(16U * static_cast<std::uint32_t>(PlantKind::Conifer) + variant);
    for (std::size_t tier = 0; tier < tiers; ++tier) { make_radii(random, tier, lower_[tier]); }
    for (std::size_t tier = 0; tier + 1 < tiers; ++tier) {
        upper_share_[tier] = top_share(lower_[tier], lower_[tier + 1]);
    }
    for (std::size_t tier = 0; tier + 2 < tiers; tier += 2) {
        coarse_share_[tier] = top_share(lower_[tier], lower_[tier + 2]);
    }
}

namespace {

TierRing scaled(const TierRing& ring, float share) {
    TierRing smaller = ring;
    for (TierVertex& vertex : smaller) {
        vertex.radius *= share;
        vertex.openness *= TieredCrown::inner_openness + (1.0F - TieredCrown::inner_openness) * share;
    }
    return smaller;
}

TierRing mixed(const TierRing& one, const TierRing& other, float share_of_other) {
    TierRing ring;
    for (std::size_t side = 0; side < ring.size(); ++side) {
        ring[side] = {glm::mix(one[side].radius, other[side].radius, share_of_other),
            glm::mix(one[side].openness, other[side].openness, share_of_other)};
    }
    return ring;
}

/// A ring whose sides between the ends of boughs lie on the straight lines between those.
TierRing without_gaps(const TierRing& ring, std::size_t tier) {
    constexpr float cosine = 0.866025404F; // of a side
    TierRing plain = ring;
    for (std::size_t side = 0; side < ring.size(); ++side) {
        if (TieredCrown::is_bough_end(tier, side)) { continue; }
        const TierVertex& before = ring[(side + ring.size() - 1) % ring.size()];
        const TierVertex& after = ring[(side + 1) % ring.size()];
        plain[side] = {2.0F * cosine * before.radius * after.radius / (before.radius + after.radius),
            0.5F * (before.openness + after.openness)};
    }
    return plain;
}

} // namespace

void TieredCrown::find_tier(std::size_t tier, std::size_t level, float come, TierRing& low, TierRing& high) const {
    const std::size_t coarse = tier / 2 * 2;
    const TierRing& whole = lower_[coarse];
    if (level < Icosphere::levels - 1) {
        low = level == 0 ? without_gaps(whole, coarse) : mixed(without_gaps(whole, coarse), whole, come);
        high = scaled(low, coarse_share_[coarse]);
        return;
    }
    const float end = coarse + 2 < tiers ? heights[coarse + 2] : 1.0F;
    const float middle = (heights[coarse + 1] - heights[coarse]) / (end - heights[coarse]);
    const TierRing cut = scaled(whole, glm::mix(1.0F, coarse_share_[coarse], middle));
    if (tier == coarse) {
        low = whole;
        high = mixed(cut, scaled(whole, upper_share_[tier]), come);
    } else {
        low = mixed(cut, lower_[tier], come);
        high = mixed(scaled(whole, coarse_share_[coarse]), scaled(lower_[tier], upper_share_[tier]), come);
    }
}

} // namespace octant::visuals::nature
