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
        clumps[i] = {way * (0.44F + 0.14F * random.next()), 0.40F + 0.10F * random.next()};
    }
    clumps[base_vertices] = {glm::vec3(0.0F), 0.62F};
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
    surface.openness =
        glm::smoothstep(0.58F, 0.98F, surface.radius) * (0.62F + 0.38F * glm::smoothstep(-1.0F, 0.5F, way.z));
    return surface;
}

/// Tiers of boughs, wide at their lower edges, around a cone. `detail`: how far a vertex is in or out of the cone,
/// 0..1.
struct Tiers {
    static constexpr float count = 5.0F;
    static constexpr float centre = 0.40F;
    static constexpr float half_height = 0.60F;
    static constexpr float lowest = 0.13F;
    std::array<glm::vec2, 8> turns; ///< of each tier's longest boughs
    float raggedness = 0.15F;

    SurfacePoint surface_of(const glm::vec3& way, float detail) const {
        const float level = glm::length(glm::vec2(way));
        const glm::vec2 level_way = level > 1e-3F ? glm::vec2(way) / level : glm::vec2(1.0F, 0.0F);
        SurfacePoint surface{
            0.0F, glm::normalize(glm::vec3(way.x, way.y, 0.45F * level + (way.z > 0.0F ? 1.0F : 0.5F) * way.z))};
        for (int step = 1; step < 200; ++step) {
            const float radius = 0.01F * static_cast<float>(step);
            const float height = (centre + half_height * radius * way.z - lowest) / (1.0F - lowest);
            if (height < 0.0F || height > 1.0F) { break; }
            const float tiers_down = count * (1.0F - height);
            const float tier = std::floor(tiers_down);
            const float edge = glm::mix(0.85F, tiers_down - tier, detail);
            // The cosine of five times the angle.
            const float c = glm::dot(level_way, turns[static_cast<std::size_t>(tier)]);
            const float ragged = 1.0F + raggedness * c * (5.0F + c * c * (16.0F * c * c - 20.0F));
            const float narrower = (1.0F - height) * (1.0F + 0.35F * height);
            if (radius * level > narrower * (0.60F + 0.40F * edge) * ragged + 0.012F) { break; }
            surface.radius = radius;
            surface.openness = (0.45F + 0.55F * edge) * (0.7F + 0.3F * height);
        }
        return surface;
    }
};

/// The greatest distance of a vertex from the axis.
constexpr float max_radius = 0.98F;

/// Places the vertices on their rays within the plant's circle and height.
void place(Crown& crown, const std::array<SurfacePoint, Icosphere::vertex_counts[2]>& surface) {
    const Icosphere& sphere = icosphere();
    std::array<float, Icosphere::vertex_counts[2]> radii{};
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const glm::vec3& way = sphere.directions[i];
        const float level = glm::length(glm::vec2(way));
        const float room = way.z < 0.0F ? crown.centre - crown.lowest : 1.0F - crown.centre;
        radii[i] = std::min(surface[i].radius, max_radius / std::max(level, 1e-3F));
        radii[i] = std::min(radii[i], room / std::max(crown.half_height * std::abs(way.z), 1e-3F));
        const glm::vec3 from_centre = radii[i] * way * glm::vec3(1.0F, 1.0F, crown.half_height);
        const auto& [a, b] = sphere.parents[i];
        const float on_chord = a == b ? 0.5F : radii[a] / (radii[a] + radii[b]);
        crown.vertices[i] = {
            glm::vec3(0.0F, 0.0F, crown.centre) + from_centre, surface[i].normal, surface[i].openness, on_chord};
    }
}

} // namespace

Crown make_crown(PlantKind kind, std::uint32_t variant) {
    Random random(16U * static_cast<std::uint32_t>(kind) + variant);
    std::array<SurfacePoint, Icosphere::vertex_counts[2]> surface;
    Crown crown;
    if (kind == PlantKind::Conifer) {
        Tiers tiers;
        for (glm::vec2& turn : tiers.turns) { turn = glm::normalize(glm::vec2(random.next_direction())); }
        tiers.raggedness = 0.10F + 0.10F * random.next();
        for (std::size_t i = 0; i < surface.size(); ++i) {
            const float detail = i < base_vertices ? 0.0F : i < Icosphere::vertex_counts[1] ? 0.75F : 1.0F;
            surface[i] = tiers.surface_of(icosphere().directions[i], detail);
        }
        crown.centre = Tiers::centre;
        crown.half_height = Tiers::half_height;
        crown.lowest = Tiers::lowest;
    } else {
        const Clumps clumps = make_clumps(random);
        float top = 0.0F;
        for (std::size_t i = 0; i < surface.size(); ++i) {
            surface[i] = surface_of(clumps, icosphere().directions[i]);
            top = std::max(top, surface[i].radius * icosphere().directions[i].z);
        }
        const bool is_tree = kind == PlantKind::Broadleaf;
        crown.lowest = is_tree ? 0.10F : 0.03F;
        crown.centre = is_tree ? 0.48F : 0.35F;
        if (is_tree) { surface[base_vertices - 1].radius *= 0.65F; } // the lowest: crowns are flat below
        crown.half_height = (1.0F - crown.centre) / top;
    }
    place(crown, surface);
    crown.lowest =
        std::ranges::min_element(crown.vertices, {}, [](const Crown::Vertex& vertex) { return vertex.at.z; })->at.z;
    // Straight below its centre the crown meets the trunk, at every level.
    surface[base_vertices - 1].radius = (crown.centre - crown.lowest) / crown.half_height;
    place(crown, surface);
    return crown;
}

} // namespace octant::visuals::nature
