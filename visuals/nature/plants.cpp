#include "visuals/nature/plants.h"

#include "sim/base/hash.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

namespace octant::visuals::nature {

namespace {

// Heights of plants in the picture, pixels. Levels and the outline are those of a fineness of 1.
/// Smaller ones are a polygon that faces the eye: conifers, other plants of few corners and those of more corners.
constexpr float conifer_outline_px = 34.0F;
constexpr float outline_px = 24.0F;
constexpr float triangle_px = 20.0F; ///< conifers that look lower have three corners from the side
constexpr float round_outline_px = 70.0F;
constexpr float bare_trunk_px = 36.0F;  ///< crowns of this size reach down to the ground ...
constexpr float full_trunk_px = 90.0F;  ///< ... and have the whole trunk below them from this one on
constexpr float flat_trunk_px = 120.0F; ///< smaller ones have a trunk of one face, towards the eye
/// Where a level of the crown begins, and where its vertices have wholly come.
constexpr std::array<glm::vec2, Icosphere::levels> level_px{
    glm::vec2(0.0F), glm::vec2(80.0F, 130.0F), glm::vec2(160.0F, 270.0F)};
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

/// The number of the covers of closed woods (scene::LandCoverContrast), whose pattern leaves show.
constexpr std::uint32_t leaves = 64;

constexpr std::uint32_t no_vertex = ~std::uint32_t{0};

std::size_t variant_of(std::uint32_t random_bits) { return random_bits >> 24U & 3U; }

/// In eighths of a turn.
std::size_t turn_of(std::uint32_t random_bits) { return random_bits >> 27U & 7U; }

/// Turned by the angle of a unit vector.
glm::vec2 turned(const glm::vec2& way, const glm::vec2& turn) {
    return {turn.x * way.x - turn.y * way.y, turn.y * way.x + turn.x * way.y};
}

/// Of the sides of conifers, counter-clockwise from east.
constexpr std::array<glm::vec2, TieredCrown::sides> side_directions{glm::vec2(1.0F, 0.0F), {0.866025404F, 0.5F},
    {0.5F, 0.866025404F}, {0.0F, 1.0F}, {-0.5F, 0.866025404F}, {-0.866025404F, 0.5F}, {-1.0F, 0.0F},
    {-0.866025404F, -0.5F}, {-0.5F, -0.866025404F}, {0.0F, -1.0F}, {0.5F, -0.866025404F}, {0.866025404F, -0.5F}};

constexpr glm::vec2 half_side(0.965925826F, 0.258819045F); ///< the cosine and sine of half the angle between two

/// The direction in which boughs on a side catch light.
glm::vec3 out_of_side(const glm::vec2& way) { return {0.8F * way, 0.6F}; }

float contrast_of(const Plant& plant) { return std::clamp(plant.height_px / full_contrast_px, min_contrast, 1.0F); }

float ground_share_of(const Plant& plant) {
    const float small = (ground_colour_px.x - plant.height_px) / (ground_colour_px.x - ground_colour_px.y);
    return max_ground_share * std::clamp(small, 0.0F, 1.0F);
}

} // namespace

PlantMesher::PlantMesher(const Daylight& day)
    : to_sun_(day.to_sun()), ambient_(day.ambient()),
      sunlight_(day.sunlight()), tiered_{TieredCrown(0), TieredCrown(1), TieredCrown(2), TieredCrown(3)},
      species_{make_species(PlantKind::Broadleaf), make_species(PlantKind::Conifer), make_species(PlantKind::Shrub)} {}

/// Leaves scatter light: sides just beyond the sun's reach have some.
PlantMesher::Light PlantMesher::light_on(const glm::vec3& normal, float openness) const {
    constexpr float scattered = 0.25F;
    const float towards = (glm::dot(normal, to_sun_) + scattered) * (1.0F / (1.0F + scattered));
    return {openness * (0.62F + 0.38F * normal.z), openness * std::max(towards, 0.0F)};
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

PlantMesher::Fineness PlantMesher::fineness_of(const Plant& plant) {
    std::size_t level = Icosphere::levels - 1;
    const float fine_px = plant.fineness * plant.height_px;
    while (level > 0 && fine_px <= level_px[level].x) { --level; }
    if (plant.kind != PlantKind::Conifer && level < 2) { return {1}; }
    if (level == 0) { return {}; }
    return {level, std::min((fine_px - level_px[level].x) / (level_px[level].y - level_px[level].x), 1.0F)};
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
        if (kind == PlantKind::Conifer) {
            TierRing low;
            TierRing high;
            for (std::size_t tier = 0; tier < TieredCrown::tiers; ++tier) {
                tiered_[variant].find_tier(tier, Icosphere::levels - 1, 1.0F, low, high);
                for (std::size_t side = 0; side < TieredCrown::sides; ++side) {
                    const glm::vec3 out = out_of_side(side_directions[side]);
                    for (const TierVertex& vertex : {low[side], high[side]}) {
                        add_to_mean(light_on(out, vertex.openness), vertex.radius);
                    }
                }
            }
            continue;
        }
        Crown& crown = species.crowns[variant];
        crown = make_crown(kind, static_cast<std::uint32_t>(variant));
        for (std::size_t turn = 0; turn < turns; ++turn) {
            for (std::size_t i = 0; i < crown.vertices.size(); ++i) {
                const auto& [at, normal, openness, radius, on_chord] = crown.vertices[i];
                const Light light =
                    light_on(glm::vec3(turned(glm::vec2(normal), compass_directions[turn]), normal.z), openness);
                species.light[variant][turn][i] = light;
                if (i < Icosphere::vertex_counts[1]) {
                    add_to_mean(light, std::max(0.6F + icosphere().directions[i].z, 0.0F));
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

    glm::vec3 place_m(const Plant& plant, const glm::vec3& at) const {
        const glm::vec2 off_m = plant.radius_m * turned(glm::vec2(at), turn);
        return plant.anchor.at_m +
               glm::vec3(off_m, base_m + height_m * at.z + lean * plant.anchor.height_at_offset_m(off_m));
    }
};

void PlantMesher::add(const Plant& plant, StandingMesh& to) {
    const std::uint32_t bits = plant.random_bits;
    const bool is_conifer = plant.kind == PlantKind::Conifer;
    // Each changes at a size of its own.
    const float own_px = plant.fineness * plant.height_px / (0.85F + 0.3F * share_of(bits, 3));
    if (own_px < (is_conifer ? conifer_outline_px : outline_px)) {
        add_outline(plant, to);
        return;
    }
    const float own_lowest = is_conifer
                                 ? TieredCrown::lowest
                                 : species_[static_cast<std::size_t>(plant.kind)].crowns[variant_of(bits)].lowest;
    const float grown = std::clamp((plant.height_px - bare_trunk_px) / (full_trunk_px - bare_trunk_px), 0.0F, 1.0F);
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
    const bool is_tree = plant.kind != PlantKind::Shrub;
    const bool eye_above = placement.eye.z > own_lowest;
    if (is_tree && !eye_above) { add_trunk(plant, placement, own_lowest, to); }
    if (is_conifer) {
        add_tiers(plant, placement, to);
    } else if (own_px < round_outline_px) {
        add_round_outline(plant, placement, to);
    } else {
        add_crown(plant, placement, to);
    }
    if (is_tree && eye_above) { add_trunk(plant, placement, own_lowest, to); }
}

void PlantMesher::add_crown(const Plant& plant, const Placement& placement, StandingMesh& to) {
    const Species& species = species_[static_cast<std::size_t>(plant.kind)];
    const std::size_t variant = variant_of(plant.random_bits);
    const Crown& crown = species.crowns[variant];
    const CrownLight& light = species.light[variant][turn_of(plant.random_bits)];
    const auto [level, come] = fineness_of(plant);
    const Icosphere& sphere = icosphere();
    const std::size_t old_count = level == 0 ? Icosphere::vertex_counts[0] : Icosphere::vertex_counts[level - 1];
    const std::size_t count = Icosphere::vertex_counts[level];
    const auto moved = [&, come = come](std::size_t i, const auto& value_of) {
        const auto own = value_of(i);
        if (i < old_count) { return own; }
        const auto& [a, b] = sphere.parents[i];
        const auto chord = value_of(a) + (value_of(b) - value_of(a)) * crown.vertices[i].on_chord;
        return chord + (own - chord) * come;
    };
    for (std::size_t i = 0; i < count; ++i) {
        places_m_[i] = placement.place_m(plant, moved(i, [&](std::size_t k) { return crown.vertices[k].at; }));
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
    std::fill_n(numbers_.begin(), count, no_vertex);
    const glm::vec3 leaf = leaf_of(plant);
    for (std::size_t k = 0; k < seen; ++k) {
        for (const std::uint8_t corner : faces[order_[k].second].corners) {
            std::uint32_t& number = numbers_[corner];
            if (number == no_vertex) {
                const float ambient = moved(corner, [&](std::size_t i) { return light[i].ambient; });
                const float sun = moved(corner, [&](std::size_t i) { return light[i].sun; });
                number = to.add(places_m_[corner], lit_leaf(plant, leaf, {ambient, sun}), leaves);
            }
            to.indices.push_back(number);
        }
    }
}

/// A polygon across the line of sight through the crown's centre, with corners on the crown's surface.
void PlantMesher::add_round_outline(const Plant& plant, const Placement& placement, StandingMesh& to) const {
    const Icosphere& sphere = icosphere();
    constexpr float min_cosine = 0.84F; // the way to vertices of the icosphere among which means are taken
    const Species& species = species_[static_cast<std::size_t>(plant.kind)];
    const std::size_t variant = variant_of(plant.random_bits);
    const Crown& crown = species.crowns[variant];
    const CrownLight& light = species.light[variant][turn_of(plant.random_bits)];
    const glm::vec3 leaf = leaf_of(plant);
    const auto add = [&](const glm::vec3& way, float ragged) {
        glm::vec3 sum(0.0F); // radius, ambient light, sunlight
        float weight = 0.0F;
        for (std::size_t i = 0; i < Icosphere::vertex_counts[1]; ++i) {
            const float near = glm::dot(sphere.directions[i], way) - min_cosine;
            if (near <= 0.0F) { continue; }
            sum += near * near * glm::vec3(crown.vertices[i].radius, light[i].ambient, light[i].sun);
            weight += near * near;
        }
        sum /= weight;
        constexpr float is_lowest = -0.9F; // such corners reach down to the trunk
        const float radius = way.z < is_lowest ? std::numeric_limits<float>::max() : sum.x * ragged;
        const glm::vec3 from_centre =
            crown.within_room(way, radius) * way * glm::vec3(1.0F, 1.0F, crown.half_height);
        return to.add(placement.place_m(plant, glm::vec3(0.0F, 0.0F, crown.centre) + from_centre),
            lit_leaf(plant, leaf, {sum.y, sum.z}), leaves);
    };
    const glm::vec3 to_eye = glm::normalize(
        glm::vec3(placement.eye.x, placement.eye.y, (placement.eye.z - crown.centre) / crown.half_height));
    const glm::vec3 right = glm::normalize(glm::vec3(-to_eye.y, to_eye.x + 1e-6F, 0.0F));
    const glm::vec3 up = glm::cross(to_eye, right);
    const std::uint32_t middle = add(to_eye, 0.0F);
    constexpr auto corners = static_cast<std::uint32_t>(side_directions.size());
    for (std::uint32_t i = 0; i < corners; ++i) {
        const glm::vec2 way = turned(side_directions[i], half_side);
        const float random = share_of(scrambled(plant.random_bits + i), 8) - 0.5F;
        add(way.x * right + way.y * up, 1.0F + 0.24F * random);
    }
    for (std::uint32_t i = 0; i < corners; ++i) {
        to.indices.insert(to.indices.end(), {middle, middle + 1 + i, middle + 1 + (i + 1) % corners});
    }
}

void PlantMesher::add_tiers(const Plant& plant, const Placement& placement, StandingMesh& to) const {
    std::array<std::pair<float, std::size_t>, TieredCrown::sides> nearness;
    for (std::size_t side = 0; side < nearness.size(); ++side) {
        const glm::vec2 middle = side_directions[side] + side_directions[(side + 1) % nearness.size()];
        nearness[side] = {glm::dot(middle, glm::vec2(placement.eye)), side};
    }
    std::ranges::sort(nearness, std::ranges::greater());
    SideOrder order;
    std::ranges::transform(nearness, order.begin(), [](const auto& side) { return side.second; });
    const std::size_t step = TieredCrown::tiers_each(fineness_of(plant).level);
    std::size_t at_eye = 0;
    while (at_eye + step < TieredCrown::tiers && placement.eye.z > TieredCrown::heights[at_eye + step]) {
        at_eye += step;
    }
    for (std::size_t tier = at_eye; tier < TieredCrown::tiers; tier += step) {
        add_tier(plant, placement, tier, order, to);
    }
    for (std::size_t tier = at_eye; tier > 0;) { add_tier(plant, placement, tier -= step, order, to); }
}

void PlantMesher::add_tier(
    const Plant& plant, const Placement& placement, std::size_t tier, const SideOrder& order, StandingMesh& to) const {
    constexpr float underside = 0.35F; // openness
    const auto [level, come] = fineness_of(plant);
    TierRing low;
    TierRing high;
    tiered_[variant_of(plant.random_bits)].find_tier(tier, level, come, low, high);
    const std::size_t above = tier + TieredCrown::tiers_each(level);
    const bool is_last = above >= TieredCrown::tiers;
    const float low_height = TieredCrown::heights[tier];
    const glm::vec3 leaf = leaf_of(plant);
    struct Edge {
        std::array<glm::vec3, TieredCrown::sides> at_m;
        std::array<std::uint32_t, TieredCrown::sides> numbers;
    };
    const auto edge_of = [&](const TierRing& ring, float height) {
        Edge edge;
        for (std::size_t side = 0; side < ring.size(); ++side) {
            edge.at_m[side] = placement.place_m(plant, glm::vec3(ring[side].radius * side_directions[side], height));
        }
        edge.numbers.fill(no_vertex);
        return edge;
    };
    const auto number_of = [&](Edge& edge, const TierRing& ring, std::size_t side) {
        if (edge.numbers[side] == no_vertex) {
            const glm::vec3 out = out_of_side(turned(side_directions[side], placement.turn));
            edge.numbers[side] = to.add(edge.at_m[side], lit_leaf(plant, leaf, light_on(out, ring[side].openness)), leaves);
        }
        return edge.numbers[side];
    };
    Edge lower = edge_of(low, low_height);
    Edge upper = edge_of(high, is_last ? 1.0F : TieredCrown::heights[above]);
    const glm::vec3 middle_m = placement.place_m(plant, glm::vec3(0.0F, 0.0F, low_height));
    // At level 0 tiers are convex: any order is right.
    const std::size_t step = level == 0 ? 2 : 1;
    for (const std::size_t side : order) {
        if (step == 2 && !TieredCrown::is_bough_end(tier, side)) { continue; }
        const std::size_t next = (side + step) % TieredCrown::sides;
        const std::size_t top = is_last ? 0 : next;
        if (StandingMesh::faces_eye(lower.at_m[side], lower.at_m[next], upper.at_m[top])) {
            to.indices.insert(to.indices.end(),
                {number_of(lower, low, side), number_of(lower, low, next), number_of(upper, high, top)});
        }
        if (!is_last && StandingMesh::faces_eye(lower.at_m[side], upper.at_m[next], upper.at_m[side])) {
            to.indices.insert(to.indices.end(),
                {number_of(lower, low, side), number_of(upper, high, next), number_of(upper, high, side)});
        }
        if (placement.eye.z < low_height) {
            to.face(std::array{middle_m, lower.at_m[next], lower.at_m[side]},
                lit_leaf(plant, leaf, light_on(glm::vec3(0.0F, 0.0F, -1.0F), underside)), leaves);
        }
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
        to.add(foot_m + glm::vec3(off_m, up_m), lit_leaf(plant, leaf, light), leaves);
    }
    for (std::uint32_t i = first + 2; i < to.vertices.size(); ++i) {
        to.indices.insert(to.indices.end(), {first, i - 1, i});
    }
}

} // namespace octant::visuals::nature
