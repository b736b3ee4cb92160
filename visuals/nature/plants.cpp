#include "visuals/nature/plants.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

namespace octant::visuals::nature {

namespace {

// Heights of plants in the picture, pixels. Levels and the outline are those of a fineness of 1.
constexpr float outline_px = 34.0F;    ///< smaller ones are a polygon that faces the eye
constexpr float bare_trunk_px = 36.0F; ///< crowns of this size reach down to the ground ...
constexpr float full_trunk_px = 90.0F; ///< ... and have the whole trunk below them from this one on
/// Where a level of the crown begins, and where its vertices have wholly come.
constexpr std::array<glm::vec2, Icosphere::levels> level_px{
    glm::vec2(0.0F), glm::vec2(70.0F, 110.0F), glm::vec2(200.0F, 330.0F)};
constexpr float full_contrast_px = 80.0F;
constexpr float min_contrast = 0.35F;
/// Smaller plants take on their ground's colour, of which they have the share `max_ground_share` in the end.
constexpr glm::vec2 ground_colour_px(28.0F, 6.0F);
constexpr float max_ground_share = 0.5F;

constexpr float lowest_outline = 0.2F;
constexpr float trunk_radius = 0.065F; ///< of the plant's
constexpr glm::vec3 bark(0.23F, 0.19F, 0.13F);

/// The colours of the ground that bears them, which its plants have in the mean.
constexpr std::array ground_colours{
    glm::vec3(0.165F, 0.265F, 0.115F), glm::vec3(0.125F, 0.22F, 0.115F), glm::vec3(0.36F, 0.36F, 0.20F)};

/// The share of its ground's slope that a plant has so that what lies from `lowest_m` over its foot on stays above the
/// ground.
float lean_of(const Plant& plant, float lowest_m) {
    const float rise_m = glm::length(plant.anchor.slope) * plant.radius_m;
    return rise_m > lowest_m ? 1.0F - lowest_m / rise_m : 0.0F;
}

float contrast_of(const Plant& plant) { return std::clamp(plant.height_px / full_contrast_px, min_contrast, 1.0F); }

float ground_share_of(const Plant& plant) {
    const float small = (ground_colour_px.x - plant.height_px) / (ground_colour_px.x - ground_colour_px.y);
    return max_ground_share * std::clamp(small, 0.0F, 1.0F);
}

} // namespace

PlantMesher::PlantMesher(const Daylight& day)
    : to_sun_(day.to_sun()), ambient_(day.ambient()),
      sunlight_(day.sunlight()), species_{make_species(PlantKind::Broadleaf), make_species(PlantKind::Conifer),
                                     make_species(PlantKind::Shrub)} {}

/// Leaves scatter light: sides just beyond the sun's reach have some.
PlantMesher::Light PlantMesher::light_on(const glm::vec3& normal, float openness) const {
    constexpr float scattered = 0.25F;
    const float towards = (glm::dot(normal, to_sun_) + scattered) * (1.0F / (1.0F + scattered));
    return {openness * (0.70F + 0.30F * normal.z), openness * std::max(towards, 0.0F)};
}

glm::vec3 PlantMesher::lit(const Plant& plant, const glm::vec3& own, const Light& light) const {
    return glm::mix(own * (light.ambient * ambient_ + plant.sun * light.sun * sunlight_), plant.anchor.colour,
        ground_share_of(plant));
}

PlantMesher::Species PlantMesher::make_species(PlantKind kind) const {
    Species species;
    const std::size_t seen = Icosphere::vertex_counts[1];
    float weight = 0.0F;
    species.mean = {0.0F, 0.0F};
    for (std::size_t variant = 0; variant < variants; ++variant) {
        Crown& crown = species.crowns[variant];
        crown = make_crown(kind, static_cast<std::uint32_t>(variant));
        for (std::size_t turn = 0; turn < turns; ++turn) {
            const glm::vec2& way = compass_directions[turn];
            for (std::size_t i = 0; i < crown.vertices.size(); ++i) {
                const auto& [at, normal, openness, on_chord] = crown.vertices[i];
                const glm::vec3 turned(
                    way.x * normal.x - way.y * normal.y, way.y * normal.x + way.x * normal.y, normal.z);
                const Light light = light_on(turned, openness);
                species.light[variant][turn][i] = light;
                if (i < seen) {
                    const float share = std::max(0.6F + icosphere().directions[i].z, 0.0F);
                    species.mean.ambient += share * light.ambient;
                    species.mean.sun += share * light.sun;
                    weight += share;
                }
            }
        }
    }
    species.mean = {species.mean.ambient / weight, species.mean.sun / weight};
    const float sky = glm::dot(luminance_weights, ambient_);
    const float sun = glm::dot(luminance_weights, sunlight_);
    species.leaf = ground_colours[static_cast<std::size_t>(kind)] * (sky + sun * std::max(to_sun_.z, 0.0F)) /
                   (sky * species.mean.ambient + sun * species.mean.sun);
    return species;
}

/// A place of the crown at `at` lies at foot + turned(radius * at.xy) + up * (base + height * at.z), and leans.
struct PlantMesher::Placement {
    glm::vec2 turn; ///< cosine and sine
    float lean = 0.0F;
    float base_m = 0.0F;
    float height_m = 1.0F;
    glm::vec3 eye{0.0F}; ///< in the crown's space
};

void PlantMesher::add(const Plant& plant, StandingMesh& to) {
    const std::uint32_t bits = plant.random_bits;
    if (plant.fineness * plant.height_px < outline_px * (0.85F + 0.3F * share_of(bits, 3))) {
        add_outline(plant, to);
        return;
    }
    const Crown& crown = species_[static_cast<std::size_t>(plant.kind)].crowns[bits >> 24U & (variants - 1)];
    const float grown = std::clamp((plant.height_px - bare_trunk_px) / (full_trunk_px - bare_trunk_px), 0.0F, 1.0F);
    const float lowest = std::min(crown.lowest, glm::mix(0.03F, crown.lowest, grown));
    Placement placement;
    placement.turn = compass_directions[bits >> 27U & (turns - 1)];
    placement.lean = lean_of(plant, lowest * plant.height_m);
    placement.height_m = plant.height_m * (1.0F - lowest) / (1.0F - crown.lowest);
    placement.base_m = plant.height_m * lowest - placement.height_m * crown.lowest;
    const glm::vec3& foot_m = plant.anchor.at_m;
    const glm::vec2 level_m = -glm::vec2(foot_m);
    const float up_m = -foot_m.z - placement.base_m - placement.lean * plant.anchor.height_at_offset_m(level_m);
    placement.eye = glm::vec3((placement.turn.x * level_m.x + placement.turn.y * level_m.y) / plant.radius_m,
        (placement.turn.x * level_m.y - placement.turn.y * level_m.x) / plant.radius_m, up_m / placement.height_m);
    const bool is_tree = plant.kind != PlantKind::Shrub;
    const bool eye_above = placement.eye.z > crown.lowest;
    if (is_tree && !eye_above) { add_trunk(plant, placement, to); }
    add_crown(plant, placement, to);
    if (is_tree && eye_above) { add_trunk(plant, placement, to); }
}

void PlantMesher::add_crown(const Plant& plant, const Placement& placement, StandingMesh& to) {
    const std::uint32_t bits = plant.random_bits;
    const Species& species = species_[static_cast<std::size_t>(plant.kind)];
    const std::size_t variant = bits >> 24U & (variants - 1);
    const Crown& crown = species.crowns[variant];
    const CrownLight& light = species.light[variant][bits >> 27U & (turns - 1)];
    std::size_t level = Icosphere::levels - 1;
    const float fine_px = plant.fineness * plant.height_px;
    while (level > 0 && fine_px <= level_px[level].x) { --level; }
    const Icosphere& sphere = icosphere();
    const float come =
        level == 0 ? 1.0F : std::min((fine_px - level_px[level].x) / (level_px[level].y - level_px[level].x), 1.0F);
    const std::size_t old_count = level == 0 ? Icosphere::vertex_counts[0] : Icosphere::vertex_counts[level - 1];
    const std::size_t count = Icosphere::vertex_counts[level];
    const auto moved = [&](std::size_t i, const auto& value_of) {
        const auto own = value_of(i);
        if (i < old_count) { return own; }
        const auto& [a, b] = sphere.parents[i];
        const auto chord = value_of(a) + (value_of(b) - value_of(a)) * crown.vertices[i].on_chord;
        return chord + (own - chord) * come;
    };
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 at = moved(i, [&](std::size_t k) { return crown.vertices[k].at; });
        const glm::vec2 off_m = plant.radius_m * glm::vec2(placement.turn.x * at.x - placement.turn.y * at.y,
                                                     placement.turn.y * at.x + placement.turn.x * at.y);
        const float up_m =
            placement.base_m + placement.height_m * at.z + placement.lean * plant.anchor.height_at_offset_m(off_m);
        places_m_[i] = plant.anchor.at_m + glm::vec3(off_m, up_m);
    }
    const glm::vec3 eye(placement.eye.x, placement.eye.y, (placement.eye.z - crown.centre) / crown.half_height);
    std::size_t seen = 0;
    const std::vector<Icosphere::Face>& faces = sphere.faces[level];
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
        const auto& [a, b, c] = faces[i].corners;
        if (StandingMesh::faces_eye(places_m_[a], places_m_[b], places_m_[c])) {
            order_[seen++] = {glm::dot(faces[i].plane, eye), i};
        }
    }
    std::sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(seen), std::greater<>());
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::fill_n(numbers_.begin(), count, none);
    const float contrast = contrast_of(plant);
    const glm::vec3 leaf = species.leaf * (0.90F + 0.2F * share_of(bits, 8));
    for (std::size_t k = 0; k < seen; ++k) {
        for (const std::uint8_t corner : faces[order_[k].second].corners) {
            std::uint32_t& number = numbers_[corner];
            if (number == none) {
                const float ambient = moved(corner, [&](std::size_t i) { return light[i].ambient; });
                const float sun = moved(corner, [&](std::size_t i) { return light[i].sun; });
                number = to.add(places_m_[corner], lit(plant, leaf,
                                                       {glm::mix(species.mean.ambient, ambient, contrast),
                                                           glm::mix(species.mean.sun, sun, contrast)}));
            }
            to.indices.push_back(number);
        }
    }
}

/// A prism from the ground to the plane below the crown, which parts them for every eye.
void PlantMesher::add_trunk(const Plant& plant, const Placement& placement, StandingMesh& to) const {
    const Crown& crown =
        species_[static_cast<std::size_t>(plant.kind)].crowns[plant.random_bits >> 24U & (variants - 1)];
    const float radius_m = trunk_radius * plant.radius_m;
    const float top_m = placement.base_m + placement.height_m * crown.lowest;
    std::array<glm::vec3, 4> low_m;
    std::array<glm::vec3, 4> high_m;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec2 off_m = radius_m * compass_directions[2 * i];
        const float ground_m = plant.anchor.height_at_offset_m(off_m);
        low_m[i] = plant.anchor.at_m + glm::vec3(off_m, std::min(ground_m, top_m + placement.lean * ground_m));
        high_m[i] = plant.anchor.at_m + glm::vec3(off_m, top_m + placement.lean * ground_m);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        const glm::vec3 out(compass_directions[2 * i + 1], 0.0F);
        to.face(std::array{low_m[i], low_m[next], high_m[next], high_m[i]}, lit(plant, bark, light_on(out, 0.8F)));
    }
}

/// A polygon within the ellipsoid that the plant fills, across the line of sight.
void PlantMesher::add_outline(const Plant& plant, StandingMesh& to) const {
    // In the plane across the line of sight, to the right and up, within the unit circle. Conifers are pointed from the
    // side and round from above.
    constexpr std::array<glm::vec2, 5> pointed{
        glm::vec2(0.80F, -0.60F), {0.46F, 0.16F}, {0.0F, 1.0F}, {-0.46F, 0.16F}, {-0.80F, -0.60F}};
    constexpr std::array<glm::vec2, 5> pentagon{
        glm::vec2(0.588F, -0.809F), {0.951F, 0.309F}, {0.0F, 1.0F}, {-0.951F, 0.309F}, {-0.588F, -0.809F}};
    constexpr std::array<glm::vec2, 6> rounded{
        glm::vec2(0.55F, -0.83F), {0.98F, -0.10F}, {0.62F, 0.78F}, {-0.20F, 0.97F}, {-0.90F, 0.42F}, {-0.78F, -0.60F}};
    constexpr float centre = 0.52F;
    constexpr float half_height = 0.48F;
    const Species& species = species_[static_cast<std::size_t>(plant.kind)];
    const glm::vec3& foot_m = plant.anchor.at_m;
    const float lean = lean_of(plant, lowest_outline * plant.height_m);
    const float radius_m = 0.95F * plant.radius_m;
    const float half_m = half_height * plant.height_m;
    const float over_foot_m = centre * plant.height_m;
    const glm::vec2 level_m = -glm::vec2(foot_m);
    const glm::vec3 to_eye = glm::normalize(glm::vec3(
        level_m / radius_m, (-foot_m.z - over_foot_m - lean * plant.anchor.height_at_offset_m(level_m)) / half_m));
    const float level = std::sqrt(to_eye.x * to_eye.x + to_eye.y * to_eye.y);
    const glm::vec3 right =
        level > 1e-3F ? glm::vec3(-to_eye.y / level, to_eye.x / level, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 up = glm::cross(to_eye, right);
    const float contrast = contrast_of(plant);
    const glm::vec3 leaf = species.leaf * (0.90F + 0.2F * share_of(plant.random_bits, 8));
    const bool is_conifer = plant.kind == PlantKind::Conifer;
    const bool is_mirrored = (plant.random_bits >> 27U & 1U) != 0;
    const std::size_t corners = is_conifer ? pointed.size() : rounded.size();
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    for (std::size_t i = 0; i < corners; ++i) {
        glm::vec2 at;
        if (is_conifer) {
            at = glm::mix(pentagon[i], pointed[i], level * level);
        } else {
            at = rounded[is_mirrored ? corners - 1 - i : i];
            at.x = is_mirrored ? -at.x : at.x;
        }
        const glm::vec3 out = at.x * right + at.y * up;
        const glm::vec2 off_m = radius_m * glm::vec2(out);
        const float up_m = over_foot_m + half_m * out.z + lean * plant.anchor.height_at_offset_m(off_m);
        const Light light = light_on(0.75F * out + 0.66F * to_eye, 0.85F + 0.10F * out.z);
        to.add(foot_m + glm::vec3(off_m, up_m), lit(plant, leaf,
                                                    {glm::mix(species.mean.ambient, light.ambient, contrast),
                                                        glm::mix(species.mean.sun, light.sun, contrast)}));
    }
    for (std::uint32_t i = 2; i < corners; ++i) {
        to.indices.insert(to.indices.end(), {first, first + i - 1, first + i});
    }
}

} // namespace octant::visuals::nature
