#include "visuals/planning/aircraft_effects.h"

#include "sim/base/units.h"
#include "sim/flight_models.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace octant::visuals::planning {

namespace {

using models::ColourVertex;
using models::polygons::Pivot;
using models::polygons::PolygonModel;

/// Blades that turn faster are seen as a disc.
constexpr double quick_turns_per_s = 3.0;
/// The share of a disc's radius that the rest may reach through its plane.
constexpr double slack = 0.06;
constexpr int segments = 32;
/// The length of a plume.
constexpr double plume_radii = 9.0;
/// The length of a trail of vapour.
constexpr double vapour_m = 14.0;
constexpr double vapour_high_m = 0.5;
constexpr int vapour_steps = 8;

std::uint32_t clear_colour(const glm::vec3& rgb, double alpha) {
    const auto byte = static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(alpha, 0.0, 1.0)));
    return (models::packed_colour(rgb) & 0x00ffffffU) | (byte << 24U);
}

/// Collects the triangles of one effect in body axes and moves them to the eye's.
struct Shape {
    const glm::dmat4& body_to_eye_world;
    std::vector<ColourVertex>& vertices;
    std::vector<std::uint32_t>& indices;

    std::uint32_t add(const glm::dvec3& at_m, std::uint32_t colour) {
        vertices.push_back({glm::vec3(body_to_eye_world * glm::dvec4(at_m, 1.0)), colour});
        return static_cast<std::uint32_t>(vertices.size() - 1);
    }

    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        indices.insert(indices.end(), {a, b, c, a, c, d});
    }
};

/// Two unit vectors square to `axis` and to each other.
std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 first = glm::normalize(glm::cross(axis, other));
    return {first, glm::cross(axis, first)};
}

/// A disc that is thin in the middle and at its edge, where the blades are fewest and their tips blur most.
void draw_disc(const glm::dvec3& centre_m, const glm::dvec3& axis, double radius_m, Shape& shape) {
    const auto [right, up] = across(axis);
    constexpr std::array rings{0.08, 0.5, 0.93, 1.0};
    constexpr std::array alphas{0.26, 0.2, 0.16, 0.0};
    const glm::vec3 grey(0.2F, 0.21F, 0.22F);
    std::array<std::uint32_t, rings.size()> first{};
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
        first[ring] = static_cast<std::uint32_t>(shape.vertices.size());
        for (int segment_index = 0; segment_index < segments; ++segment_index) {
            const double turn = 2.0 * pi * segment_index / segments;
            shape.add(centre_m + rings[ring] * radius_m * (std::cos(turn) * right + std::sin(turn) * up),
                clear_colour(grey, alphas[ring]));
        }
    }
    for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
        for (std::uint32_t segment_index = 0; segment_index < segments; ++segment_index) {
            const std::uint32_t next = (segment_index + 1) % segments;
            shape.quad(first[ring] + segment_index, first[ring + 1] + segment_index, first[ring + 1] + next,
                first[ring] + next);
        }
    }
}

/// Three sheets through the plume's axis: seen from any side they fill it.
void draw_plume(const glm::dvec3& from_m, double radius_m, const EffectStrength& strength, Shape& shape) {
    constexpr std::array along{0.0, 0.12, 0.35, 0.65, 1.0};
    constexpr std::array wide{0.85, 1.0, 0.8, 0.55, 0.25};
    constexpr std::array flame{0.55, 0.75, 0.5, 0.22, 0.0};
    const glm::vec3 hot(0.98F, 0.78F, 0.52F);
    const glm::vec3 blue(0.62F, 0.66F, 0.98F);
    const glm::vec3 smoke(0.33F, 0.32F, 0.31F);
    for (int sheet = 0; sheet < 3; ++sheet) {
        const double turn = pi * sheet / 3.0;
        const glm::dvec3 side(0.0, std::cos(turn), std::sin(turn));
        std::uint32_t before = 0;
        for (std::size_t i = 0; i < along.size(); ++i) {
            const glm::dvec3 middle_m = from_m - glm::dvec3(plume_radii * radius_m * along[i], 0.0, 0.0);
            const auto share = static_cast<float>(along[i]);
            const glm::vec3 fire = glm::mix(blue, hot, std::min(3.0F * share, 1.0F));
            const glm::vec3 rgb = glm::mix(smoke, fire, static_cast<float>(strength.burner));
            const double alpha = glm::mix(0.1 * strength.exhaust * (1.0 - along[i]), flame[i], strength.burner) * 0.6;
            const double half_m = radius_m * wide[i];
            const std::uint32_t left = shape.add(middle_m - half_m * side, clear_colour(rgb, 0.0));
            const std::uint32_t core = shape.add(middle_m, clear_colour(rgb, alpha));
            const std::uint32_t right = shape.add(middle_m + half_m * side, clear_colour(rgb, 0.0));
            if (i > 0) {
                shape.quad(before, left, core, before + 1);
                shape.quad(before + 1, core, right, before + 2);
            }
            before = left;
        }
    }
}

/// An upright sheet behind a wingtip that spreads and fades.
void draw_vapour(const glm::dvec3& from_m, double strength, Shape& shape) {
    std::uint32_t before = 0;
    for (int i = 0; i <= vapour_steps; ++i) {
        const double share = static_cast<double>(i) / vapour_steps;
        const glm::dvec3 middle_m = from_m - glm::dvec3(vapour_m * share, 0.0, 0.0);
        const double half_m = vapour_high_m * (0.15 + 0.85 * share);
        const double alpha = 0.7 * strength * (1.0 - share);
        const glm::vec3 white(0.94F, 0.95F, 0.97F);
        const std::uint32_t top = shape.add(middle_m - glm::dvec3(0.0, 0.0, half_m), clear_colour(white, 0.0));
        const std::uint32_t core = shape.add(middle_m, clear_colour(white, alpha));
        const std::uint32_t low = shape.add(middle_m + glm::dvec3(0.0, 0.0, half_m), clear_colour(white, 0.0));
        if (i > 0) {
            shape.quad(before, top, core, before + 1);
            shape.quad(before + 1, core, low, before + 2);
        }
        before = top;
    }
}

/// How far the model reaches along a direction, without one of its parts.
double reach_along(const PolygonModel& model, const glm::dvec3& direction, std::optional<std::uint32_t> excluded_part) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t polygon = 0; polygon < model.polygons.size(); ++polygon) {
        if (excluded_part && model.polygons[polygon].part == *excluded_part) { continue; }
        for (const std::uint32_t vertex : model.corners(polygon)) {
            most = std::max(most, glm::dot(direction, model.vertices_m[vertex]));
        }
    }
    return most;
}

bool is_of_nozzle(const std::string& name) {
    return name.starts_with("nozzle") || name.starts_with("burner") || name.starts_with("exhaust");
}

} // namespace

EffectStrength strength_of(const sim::AircraftKind* kind, const sim::AircraftState& state) {
    constexpr double full_flame = 0.1; // of the reheat: its first stage is seen as well as its last
    EffectStrength strength;
    strength.exhaust = 1.0;
    strength.burner = glm::smoothstep(0.0, full_flame, sim::reheat_fraction(kind, state));
    strength.vapour = glm::smoothstep(3.0, 5.5, std::abs(state.load_factor));
    return strength;
}

AircraftEffects::AircraftEffects(const PolygonModel& model) {
    find_discs(model);
    find_plumes(model);
    find_vapour(model);
}

void AircraftEffects::add_effect(const Effect& effect, const glm::dvec3& reach_m) {
    const glm::dvec3 half_m(effect.radius_m);
    const glm::dvec3 least = glm::min(effect.position_m, effect.position_m + reach_m) - half_m;
    const glm::dvec3 most = glm::max(effect.position_m, effect.position_m + reach_m) + half_m;
    extent_.min_m = effects_.empty() ? least : glm::min(extent_.min_m, least);
    extent_.max_m = effects_.empty() ? most : glm::max(extent_.max_m, most);
    effects_.push_back(effect);
}

void AircraftEffects::find_discs(const PolygonModel& model) {
    for (std::uint32_t number = 0; number < model.pivots.size(); ++number) {
        const Pivot& pivot = model.pivots[number];
        if (std::abs(pivot.turns_per_s) < quick_turns_per_s) { continue; }
        double radius_m = 0.0;
        double along_sum_m = 0.0;
        int corners = 0;
        for (std::size_t polygon = 0; polygon < model.polygons.size(); ++polygon) {
            if (model.polygons[polygon].part != pivot.part) { continue; }
            for (const std::uint32_t vertex : model.corners(polygon)) {
                const glm::dvec3 off_m = model.vertices_m[vertex] - pivot.point_m;
                const double along_m = glm::dot(off_m, pivot.axis);
                radius_m = std::max(radius_m, glm::length(off_m - along_m * pivot.axis));
                along_sum_m += along_m;
                ++corners;
            }
        }
        if (corners == 0) { continue; }
        const glm::dvec3 centre_m = pivot.point_m + along_sum_m / corners * pivot.axis;
        for (const double side : {-1.0, 1.0}) {
            const glm::dvec3 outward = side * pivot.axis;
            if (reach_along(model, outward, pivot.part) <= glm::dot(outward, centre_m) + slack * radius_m) {
                add_effect({Kind::Disc, centre_m, outward, radius_m, number}, glm::dvec3(0.0));
                break;
            }
        }
    }
}

/// The plane of all plumes is that of the rearmost corner.
void AircraftEffects::find_plumes(const PolygonModel& model) {
    const glm::dvec3 aft(-1.0, 0.0, 0.0);
    const double rear_m = -reach_along(model, aft, std::nullopt);
    for (const double side : {-1.0, 1.0}) {
        glm::dvec3 least(1e9);
        glm::dvec3 most(-1e9);
        for (std::size_t polygon = 0; polygon < model.polygons.size(); ++polygon) {
            if (!is_of_nozzle(model.parts[model.polygons[polygon].part])) { continue; }
            for (const std::uint32_t vertex : model.corners(polygon)) {
                const glm::dvec3& at_m = model.vertices_m[vertex];
                if (side * at_m.y >= 0.0) {
                    least = glm::min(least, at_m);
                    most = glm::max(most, at_m);
                }
            }
        }
        if (least.x > most.x) { continue; }
        const double radius_m = 0.42 * std::min(most.y - least.y, most.z - least.z);
        const glm::dvec3 position_m(rear_m, 0.5 * (least.y + most.y), 0.5 * (least.z + most.z));
        add_effect({Kind::Plume, position_m, aft, radius_m}, plume_radii * radius_m * aft);
    }
}

/// Only of jets: what has a plume. Others hardly ever load their tips so.
void AircraftEffects::find_vapour(const PolygonModel& model) {
    if (std::ranges::none_of(effects_, [](const Effect& one) { return one.kind == Kind::Plume; })) { return; }
    for (const double side : {-1.0, 1.0}) {
        const glm::dvec3 outward(0.0, side, 0.0);
        glm::dvec3 tip_m(0.0);
        double max_m = 0.0;
        for (const glm::dvec3& at_m : model.vertices_m) {
            // Of corners as far out the rearmost.
            if (side * at_m.y > max_m + 1e-6 || (side * at_m.y > max_m - 1e-6 && at_m.x < tip_m.x)) {
                max_m = std::max(max_m, side * at_m.y);
                tip_m = at_m;
            }
        }
        add_effect({Kind::Vapour, tip_m, outward, vapour_high_m}, {-vapour_m, 0.0, 0.0});
    }
}

AircraftEffects::TransparentRanges AircraftEffects::add(const glm::dmat4& body_to_eye_world,
    const EffectStrength& strength, std::span<const ArticulatedPart> articulated_parts, std::uint32_t number,
    TransparentGeometry& transparents) {
    const auto is_articulated = [&](std::uint32_t pivot) {
        return std::ranges::any_of(articulated_parts,
            [&](const ArticulatedPart& part) { return part.aircraft == number && part.pivot == pivot; });
    };
    const glm::dvec3 eye_m(glm::inverse(body_to_eye_world)[3]);
    TransparentRanges ranges;
    for (const bool after : {false, true}) {
        vertices_.clear();
        indices_.clear();
        Shape shape{body_to_eye_world, vertices_, indices_};
        for (const Effect& effect : effects_) {
            if ((glm::dot(eye_m - effect.position_m, effect.outward) > 0.0) != after) { continue; }
            if (effect.kind == Kind::Disc) {
                if (!is_articulated(effect.pivot)) {
                    draw_disc(effect.position_m, effect.outward, effect.radius_m, shape);
                }
            } else if (effect.kind == Kind::Plume) {
                draw_plume(effect.position_m, effect.radius_m, strength, shape);
            } else if (strength.vapour > 0.0) {
                draw_vapour(effect.position_m, strength.vapour, shape);
            }
        }
        (after ? ranges.after : ranges.before) = transparents.add(shape.vertices, shape.indices);
    }
    return ranges;
}

} // namespace octant::visuals::planning
