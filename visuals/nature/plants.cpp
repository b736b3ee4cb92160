#include "visuals/nature/plants.h"

#include "sim/base/hash.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace octant::visuals::nature {

namespace {

// Heights of plants in the picture, pixels. Levels and the outline are those of a fineness of 1.
/// Smaller ones are a polygon that faces the eye: conifers, other plants of few corners and those of more corners.
constexpr float conifer_outline_px = 34.0F;
constexpr float outline_px = 32.0F;
constexpr float triangle_px = 20.0F;    ///< conifers that look lower have three corners from the side
constexpr float bare_trunk_px = 36.0F;  ///< crowns of this size reach down to the ground ...
constexpr float full_trunk_px = 90.0F;  ///< ... and have the whole trunk below them from this one on
constexpr float flat_trunk_px = 120.0F; ///< smaller ones have a trunk of one face, towards the eye
/// Where the ring of a crown (CrownSide) and more corners of its outline begin to come, and where they have come.
constexpr std::array crown_px{glm::vec2(70.0F, 105.0F), glm::vec2(70.0F, 100.0F), glm::vec2(100.0F, 160.0F)};
constexpr float full_contrast_px = 90.0F;
constexpr float min_contrast = 0.35F;
/// Smaller plants take on their ground's colour, of which they have the share `max_ground_share` in the end.
constexpr glm::vec2 ground_colour_px(40.0F, 6.0F);
constexpr float max_ground_share = 0.5F;

constexpr float lowest_outline = 0.2F;
constexpr float max_slope_lowest = 0.22F;         ///< of crowns, over the plant's height
constexpr std::array trunk_radii{0.075F, 0.085F}; ///< of trees, in those of the plant
constexpr glm::vec3 bark(0.23F, 0.19F, 0.13F);

/// The colours of the ground that bears them, which its plants have in the mean.
constexpr std::array ground_colours{
    glm::vec3(0.165F, 0.265F, 0.115F), glm::vec3(0.125F, 0.22F, 0.115F), glm::vec3(0.25F, 0.31F, 0.14F)};

/// How far the ground at the edge of the plant's circle rises over its foot at most.
float rise_m(const Plant& plant) { return glm::length(plant.anchor.slope) * plant.radius_m; }

/// The share of its ground's slope that a plant has so that what lies from `lowest_m` over its foot on stays above the
/// ground.
float lean_of(const Plant& plant, float lowest_m) {
    return rise_m(plant) > lowest_m ? 1.0F - lowest_m / rise_m(plant) : 0.0F;
}

/// Where leaves show the pattern of closed woods with the least contrast and with all of it.
constexpr glm::vec2 pattern_px(14.0F, 80.0F);

std::size_t variant_of(std::uint32_t random_bits) { return random_bits >> 24U & 3U; }

/// In eighths of a turn.
std::size_t turn_of(std::uint32_t random_bits) { return random_bits >> 27U & 7U; }

/// Turned by the angle of a unit vector.
glm::vec2 turned(const glm::vec2& way, const glm::vec2& turn) {
    return {turn.x * way.x - turn.y * way.y, turn.y * way.x + turn.x * way.y};
}

/// The share, 0 to 1, to which a detail is shown that appears between two sizes, pixels.
float come_at(float px, const glm::vec2& between) {
    return std::clamp((px - between.x) / (between.y - between.x), 0.0F, 1.0F);
}

float contrast_of(const Plant& plant) { return std::clamp(plant.height_px / full_contrast_px, min_contrast, 1.0F); }

/// The number of the covers of which leaves show the pattern (scene::LandCoverContrast): 64 is that of closed woods,
/// and those of less have less contrast.
std::uint32_t covers_of_leaves(const Plant& plant) {
    return 24U + static_cast<std::uint32_t>(40.0F * come_at(plant.height_px, pattern_px));
}

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
    constexpr float scattered = 0.5F;
    const float towards = (glm::dot(normal, to_sun_) + scattered) * (1.0F / (1.0F + scattered));
    return {openness * (0.72F + 0.28F * normal.z), openness * std::max(towards, 0.0F)};
}

glm::vec3 PlantMesher::lit(const Plant& plant, const glm::vec3& own, const Light& light) const {
    return glm::mix(own * (light.ambient * ambient_ + plant.sun * light.sun * sunlight_), plant.anchor.colour,
        ground_share_of(plant));
}

/// Each plant has a lightness and a hue of its own.
glm::vec3 PlantMesher::leaf_of(const Plant& plant) const {
    constexpr float lightness = 0.30F; // from the darkest to the lightest
    constexpr glm::vec3 hue(0.34F, 0.06F, -0.24F);
    const std::uint32_t bits = scrambled(plant.random_bits);
    return species_[static_cast<std::size_t>(plant.kind)].leaf * (1.0F + lightness * (share_of(bits, 8) - 0.5F)) *
           (1.0F + hue * (share_of(bits, 16) - 0.5F));
}

/// Small plants have less contrast.
glm::vec3 PlantMesher::lit_leaf(const Plant& plant, const glm::vec3& leaf, const Light& light) const {
    const Light& mean = species_[static_cast<std::size_t>(plant.kind)].mean;
    const float contrast = contrast_of(plant);
    return lit(plant, leaf, {glm::mix(mean.ambient, light.ambient, contrast), glm::mix(mean.sun, light.sun, contrast)});
}

PlantMesher::Species PlantMesher::make_species(PlantKind kind) const {
    Species species;
    float weight = 0.0F;
    species.mean = {0.0F, 0.0F};
    const auto add_to_mean = [&](const Light& light, float share) {
        species.mean.ambient += share * light.ambient;
        species.mean.sun += share * light.sun;
        weight += share;
    };
    for (std::size_t variant = 0; variant < variants; ++variant) {
        species.crowns.emplace_back(kind, static_cast<std::uint32_t>(variant));
        species.crowns.back().for_each_direction([&](const glm::vec3& way, const CrownPoint& point) {
            add_to_mean(light_on(glm::normalize(point.normal), point.openness), std::max(0.6F + way.z, 0.0F));
        });
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

    glm::vec3 place_m(const Plant& plant, const glm::vec3& at) const {
        const glm::vec2 off_m = plant.radius_m * turned(glm::vec2(at), turn);
        return plant.anchor.at_m +
               glm::vec3(off_m, base_m + height_m * at.z + lean * plant.anchor.height_at_offset_m(off_m));
    }
};

void PlantMesher::add(const Plant& plant, StandingMesh& to) const {
    const std::uint32_t bits = plant.random_bits;
    const bool is_conifer = plant.kind == PlantKind::Conifer;
    // Each changes at a size of its own.
    const float own_px = plant.fineness * plant.height_px / (0.85F + 0.3F * share_of(bits, 3));
    if (own_px < (is_conifer ? conifer_outline_px : outline_px)) {
        add_outline(plant, to);
        return;
    }
    const float own_lowest = species_[static_cast<std::size_t>(plant.kind)].crowns[variant_of(bits)].lowest();
    const float grown = come_at(plant.height_px, {bare_trunk_px, full_trunk_px});
    float lowest = std::min(own_lowest, glm::mix(0.03F, own_lowest, grown));
    if (plant.kind != PlantKind::Shrub) { // crowns on slopes are higher up their trunks, and stand upright
        lowest = std::max(lowest, std::min(max_slope_lowest, rise_m(plant) / plant.height_m));
    }
    Placement placement;
    placement.turn = compass_directions[turn_of(bits)];
    placement.lean = lean_of(plant, lowest * plant.height_m);
    placement.height_m = plant.height_m * (1.0F - lowest) / (1.0F - own_lowest);
    placement.base_m = plant.height_m * lowest - placement.height_m * own_lowest;
    const glm::vec3& foot_m = plant.anchor.at_m;
    const glm::vec2 level_m = -glm::vec2(foot_m);
    const float up_m = -foot_m.z - placement.base_m - placement.lean * plant.anchor.height_at_offset_m(level_m);
    placement.eye = glm::vec3((placement.turn.x * level_m.x + placement.turn.y * level_m.y) / plant.radius_m,
        (placement.turn.x * level_m.y - placement.turn.y * level_m.x) / plant.radius_m, up_m / placement.height_m);
    constexpr float min_trunk_px = 1.5F;
    const bool has_trunk = plant.kind != PlantKind::Shrub && lowest * plant.height_px > min_trunk_px;
    const bool eye_above = placement.eye.z > own_lowest;
    if (has_trunk && !eye_above) { add_trunk(plant, placement, own_lowest, to); }
    add_crown(plant, placement, to);
    if (has_trunk && eye_above) { add_trunk(plant, placement, own_lowest, to); }
}

void PlantMesher::add_crown(const Plant& plant, const Placement& placement, StandingMesh& to) const {
    const Crown& crown = species_[static_cast<std::size_t>(plant.kind)].crowns[variant_of(plant.random_bits)];
    const float fine_px = plant.fineness * plant.height_px;
    float fineness = 0.0F;
    for (const glm::vec2& px : crown_px) { fineness += come_at(fine_px, px); }
    const CrownSide side(crown, crown.from_centre(placement.eye), fineness);
    const glm::vec3 leaf = leaf_of(plant);
    const std::uint32_t covers = covers_of_leaves(plant);
    const auto add_corner = [&](const CrownSide::Corner& corner) {
        const glm::vec3 normal(turned(glm::vec2(corner.normal), placement.turn), corner.normal.z);
        return to.add(placement.place_m(plant, crown.in_plant(corner.from_centre)),
            lit_leaf(plant, leaf, light_on(glm::normalize(normal), corner.openness)), covers);
    };
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        to.indices.insert(to.indices.end(), {a, b, c});
    };
    const std::uint32_t middle = add_corner(side.middle);
    const std::uint32_t first = middle + 1;
    for (std::size_t i = 0; i < CrownSide::max_corners; i += side.step) { add_corner(side.outline[i]); }
    constexpr auto spokes = static_cast<std::uint32_t>(CrownSide::spokes);
    const auto each = static_cast<std::uint32_t>(4 / side.step); // sides of the outline from spoke to spoke
    const std::uint32_t first_of_ring = first + each * spokes;
    if (side.has_ring) {
        for (const CrownSide::Corner& corner : side.ring) { add_corner(corner); }
    }
    for (std::uint32_t spoke = 0; spoke < spokes; ++spoke) {
        const std::uint32_t next = (spoke + 1) % spokes;
        if (!side.has_ring) {
            triangle(middle, first + spoke, first + next);
            continue;
        }
        triangle(middle, first_of_ring + spoke, first_of_ring + next);
        for (std::uint32_t i = 0; i < each; ++i) {
            const std::uint32_t corner = each * spoke + i;
            triangle(first_of_ring + spoke, first + corner, first + (corner + 1) % (each * spokes));
        }
        triangle(first_of_ring + spoke, first + each * next, first_of_ring + next);
    }
}

/// From the ground to the plane below the crown, which parts them for every eye.
void PlantMesher::add_trunk(const Plant& plant, const Placement& placement, float lowest, StandingMesh& to) const {
    const float radius_m = trunk_radii[static_cast<std::size_t>(plant.kind)] * plant.radius_m;
    const float top_m = placement.base_m + placement.height_m * lowest;
    const auto face = [&](const glm::vec2& from_m, const glm::vec2& to_m, const glm::vec2& out) {
        const auto place_m = [&](const glm::vec2& off_m, bool is_high) {
            const float ground_m = plant.anchor.height_at_offset_m(off_m);
            const float up_m = top_m + placement.lean * ground_m;
            return plant.anchor.at_m + glm::vec3(off_m, is_high ? up_m : std::min(ground_m, up_m));
        };
        to.face(std::array{place_m(from_m, false), place_m(to_m, false), place_m(to_m, true), place_m(from_m, true)},
            lit(plant, bark, light_on(glm::vec3(out, 0.0F), 0.8F)));
    };
    const glm::vec2 level_m = -glm::vec2(plant.anchor.at_m);
    if (plant.height_px < flat_trunk_px && level_m != glm::vec2(0.0F)) {
        const glm::vec2 to_eye = glm::normalize(level_m);
        const glm::vec2 right_m = 0.85F * radius_m * glm::vec2(-to_eye.y, to_eye.x);
        face(-right_m, right_m, to_eye);
        return;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        face(radius_m * compass_directions[2 * i], radius_m * compass_directions[(2 * i + 2) % turns],
            compass_directions[2 * i + 1]);
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
    const glm::vec3 leaf = leaf_of(plant);
    const bool is_conifer = plant.kind == PlantKind::Conifer;
    const bool is_mirrored = (plant.random_bits >> 27U & 1U) != 0;
    const std::size_t corners = is_conifer ? pointed.size() : rounded.size();
    const bool is_triangle = is_conifer && plant.height_px < triangle_px && level > 0.9F;
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    for (std::size_t i = 0; i < corners; i += is_triangle ? 2 : 1) {
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
        to.add(foot_m + glm::vec3(off_m, up_m), lit_leaf(plant, leaf, light), covers_of_leaves(plant));
    }
    for (std::uint32_t i = first + 2; i < to.vertices.size(); ++i) {
        to.indices.insert(to.indices.end(), {first, i - 1, i});
    }
}

} // namespace octant::visuals::nature
