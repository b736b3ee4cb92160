#include "visuals/planning/transparents.h"

#include "models/colour_vertex.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/units.h"
#include "sim/flight_models.h"
#include "visuals/landscape/ground.h"
#include "visuals/nature/cloud_layer.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/scene.h"
#include "visuals/planning/sky.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace octant::visuals::planning {

using models::ColourVertex;
using models::polygons::PolygonModel;

namespace {

constexpr float near_plane_m = 0.3F;
/// The clip planes at the view's sides, as a multiple of the half width and height.
constexpr float view_margin = 1.05F;

constexpr int planes = 5;

/// The distance of a point in clip space from one of the planes, below zero outside.
float before_plane(const glm::vec4& clip, int plane) {
    switch (plane) {
    case 0:
        return clip.w - near_plane_m;
    case 1:
        return view_margin * clip.w - clip.x;
    case 2:
        return view_margin * clip.w + clip.x;
    case 3:
        return view_margin * clip.w - clip.y;
    default:
        return view_margin * clip.w + clip.y;
    }
}

glm::vec3 rgb_of(std::uint32_t colour) {
    return glm::vec3(static_cast<float>(colour & 0xffU), static_cast<float>(colour >> 8U & 0xffU),
               static_cast<float>(colour >> 16U & 0xffU)) /
           255.0F;
}

std::uint32_t packed(const glm::vec4& colour) {
    const auto alpha = static_cast<std::uint32_t>(std::lround(255.0F * std::clamp(colour.w, 0.0F, 1.0F)));
    return (models::packed_colour(glm::vec3(colour)) & 0x00ffffffU) | (alpha << 24U);
}

} // namespace

/// Turns transparent triangles of a frame into triangles in pixels: mixes their colours with the haze, clips them to
/// the view and projects them.
class TransparentGeometry {
public:
    /// Forgets the last frame. The haze must outlive the frame.
    void begin(const glm::mat4& world_to_clip, const glm::ivec2& size_px, const scene::Haze& haze) {
        world_to_clip_ = world_to_clip;
        size_px_ = glm::vec2(size_px);
        haze_ = &haze;
        vertices_.clear();
        indices_.clear();
    }

    /// Adds triangles of any orientation, in world axes with the eye subtracted; alpha is their coverage of the
    /// background. Returns the range of their visible parts.
    TransparentRange add(std::span<const models::ColourVertex> vertices, std::span<const std::uint32_t> indices) {
        TransparentRange range{indices_.size(), 0};
        vertex_cache_.clear();
        for (const models::ColourVertex& vertex : vertices) { vertex_cache_.push_back(placed(vertex)); }
        std::array<TransparentVertex, 3> three;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            std::uint32_t all = ~0U;
            std::uint32_t any = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const TransparentVertex& vertex_out = vertex_cache_[indices[i + k]];
                all &= vertex_out.outside;
                any |= vertex_out.outside;
            }
            if (all != 0) { continue; }
            for (std::size_t k = 0; k < 3; ++k) {
                TransparentVertex& vertex_out = vertex_cache_[indices[i + k]];
                colour(vertices[indices[i + k]], vertex_out);
                three[k] = vertex_out;
            }
            if (any == 0) {
                add_polygon(three);
            } else {
                polygon_.assign(three.begin(), three.end());
                cut();
                add_polygon(polygon_);
            }
        }
        range.count = indices_.size() - range.first;
        return range;
    }

    /// All triangles since begin(). Valid until the next call of another member.
    scene::OverlayDraw draw() const { return {vertices_, indices_}; }

private:
    struct TransparentVertex {
        glm::vec4 clip{0.0F};
        /// Display values and alpha; red is below 0 until colour() sets it.
        glm::vec4 colour{-1.0F};
        /// The planes behind which the vertex is, one bit each.
        std::uint32_t outside = 0;
    };

    TransparentVertex placed(const models::ColourVertex& vertex) const {
        TransparentVertex vertex_out;
        vertex_out.clip = world_to_clip_ * glm::vec4(vertex.position_m, 1.0F);
        for (int plane = 0; plane < planes; ++plane) {
            vertex_out.outside |= before_plane(vertex_out.clip, plane) < 0.0F ? 1U << plane : 0U;
        }
        return vertex_out;
    }

    /// Sets the colour seen through the haze, unless it is set.
    void colour(const models::ColourVertex& vertex, TransparentVertex& vertex_out) const {
        if (vertex_out.colour.x < 0.0F) {
            vertex_out.colour = glm::vec4(through_haze(*haze_, glm::dvec3(vertex.position_m), rgb_of(vertex.colour)),
                static_cast<float>(vertex.colour >> 24U) / 255.0F);
        }
    }

    /// Clips the polygon to the view (Sutherland and Hodgman 1974).
    void cut() {
        for (int plane = 0; plane < planes; ++plane) {
            scratch_.clear();
            for (std::size_t i = 0; i < polygon_.size(); ++i) {
                const TransparentVertex& from = polygon_[i];
                const TransparentVertex& to = polygon_[(i + 1) % polygon_.size()];
                const float from_m = before_plane(from.clip, plane);
                const float to_m = before_plane(to.clip, plane);
                if (from_m >= 0.0F) { scratch_.push_back(from); }
                if ((from_m < 0.0F) != (to_m < 0.0F)) {
                    const float share = from_m / (from_m - to_m);
                    scratch_.push_back(
                        {glm::mix(from.clip, to.clip, share), glm::mix(from.colour, to.colour, share), 0});
                }
            }
            std::swap(polygon_, scratch_);
        }
    }

    void add_polygon(std::span<const TransparentVertex> corners) {
        if (corners.size() < 3) { return; }
        const auto first = static_cast<std::uint32_t>(vertices_.size());
        for (const TransparentVertex& vertex_out : corners) {
            const glm::vec2 at = glm::vec2(vertex_out.clip) / vertex_out.clip.w;
            vertices_.push_back({glm::vec2(0.5F + 0.5F * at.x, 0.5F - 0.5F * at.y) * size_px_,
                packed(vertex_out.colour), vertex_out.clip.z / vertex_out.clip.w});
        }
        for (std::uint32_t i = 2; i < corners.size(); ++i) {
            indices_.insert(indices_.end(), {first, first + i - 1, first + i});
        }
    }

    glm::mat4 world_to_clip_{1.0F};
    glm::vec2 size_px_{1.0F};
    const scene::Haze* haze_ = nullptr;
    std::vector<TransparentVertex> vertex_cache_;
    std::vector<TransparentVertex> polygon_;
    std::vector<TransparentVertex> scratch_;
    std::vector<scene::OverlayVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

// Effects around aircraft.

namespace {

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

/// Collects the triangles of an effect, given in body axes, in world axes with the eye at the origin.
struct Shape {
    glm::dmat4 body_to_eye_world;
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

/// Two unit vectors that are perpendicular to `axis` and to each other.
std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 first = glm::normalize(glm::cross(axis, other));
    return {first, glm::cross(axis, first)};
}

/// The light of a frame, the eye at the origin of world axes.
struct EffectLight {
    glm::vec3 ambient;
    glm::vec3 sunlight;
    glm::dvec3 to_sun;
    double pixel_rad = 0.0;
};

/// A circle of a disc: its radius, its coverage of what is behind and its grey under full light.
struct DiscRing {
    double radius; ///< as a share of the disc's
    double alpha;
    float grey;
};

/// Blades are dark and cover a larger share near the hub; tips are painted in light colours.
constexpr std::array disc_rings{
    DiscRing{0.0, 0.34, 0.16F}, DiscRing{0.92, 0.2, 0.24F}, DiscRing{0.96, 0.24, 0.62F}, DiscRing{1.0, 0.0, 0.62F}};

/// How much more than seen along its axis a disc covers where the line of sight meets it at an angle of this sine: its
/// blades have a thickness, about this share of their chord with their pitch.
double oblique_coverage(double alpha, double sine) {
    constexpr double thickness = 0.15;
    constexpr double max_alpha = 0.75;
    return std::min(alpha * (1.0 + thickness * (1.0 / std::max(sine, 0.01) - 1.0)), max_alpha);
}

/// The segments of a circle whose chords are at most 1.5 pixels from it, which its faint edge hides; `radius_px` is
/// above 0.
int segments_of(double radius_px) {
    constexpr double max_error_px = 1.5;
    const double half_rad = std::acos(1.0 - std::min(max_error_px / radius_px, 0.5));
    return std::clamp(static_cast<int>(std::ceil(pi / half_rad)), 8, 64);
}

/// Draws a disc, from the light on the side that the eye sees, brighter where the sun is mirrored or shines through.
/// `root_m`: its inner radius; `strength`: of its coverage, 0..1.
void draw_disc(const WorldCircle& disc, double root_m, float strength, const EffectLight& light, Shape& shape) {
    const double radius_px = disc.radius_m / (light.pixel_rad * std::max(glm::length(disc.centre_m), disc.radius_m));
    const double sun_side = glm::dot(disc.axis, light.to_sun) * (glm::dot(disc.axis, disc.centre_m) > 0.0 ? -1.0 : 1.0);
    constexpr double let_through = 0.5; // of the light on the other side
    const double facing = std::max(sun_side, -let_through * sun_side);
    const glm::vec3 whole = light.ambient + light.sunlight * static_cast<float>(facing);
    // A line of sight in this direction meets the sun, mirrored or behind the disc.
    const glm::dvec3 to_glare = sun_side > 0.0 ? glm::reflect(light.to_sun, disc.axis) : light.to_sun;
    const int segments = segments_of(radius_px);
    const auto [right, up] = across(disc.axis);
    const auto first = static_cast<std::uint32_t>(shape.vertices.size());
    for (const DiscRing& ring : disc_rings) {
        const double ring_m = std::max(ring.radius * disc.radius_m, root_m);
        for (int segment = 0; segment < segments; ++segment) {
            const double turn = 2.0 * pi * segment / segments;
            const glm::dvec3 at_m = disc.centre_m + ring_m * (std::cos(turn) * right + std::sin(turn) * up);
            const glm::dvec3 sight = at_m / std::max(glm::length(at_m), 1e-6);
            const double alpha = oblique_coverage(ring.alpha, std::abs(glm::dot(sight, disc.axis)));
            const double cosine = std::max(glm::dot(sight, to_glare), 0.0);
            const double squared = cosine * cosine;
            const auto glare = static_cast<float>(0.4 * squared * squared * squared * squared);
            const glm::vec3 rgb = glm::min(ring.grey * whole + glare * light.sunlight, glm::vec3(1.0F));
            shape.add(at_m, clear_colour(rgb, static_cast<double>(strength) * alpha));
        }
    }
    const auto count = static_cast<std::uint32_t>(segments);
    for (std::uint32_t ring = 0; ring + 1 < disc_rings.size(); ++ring) {
        for (std::uint32_t segment = 0; segment < count; ++segment) {
            const std::uint32_t inner = first + ring * count;
            const std::uint32_t next = (segment + 1) % count;
            shape.quad(inner + segment, inner + count + segment, inner + count + next, inner + next);
        }
    }
}

/// Draws three sheets through the plume's axis, which fill it when seen from any side.
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

/// Draws a vertical sheet behind a wingtip that widens and fades.
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

/// The x coordinate of the rearmost corner of a polygon.
double rear_of(const PolygonModel& model) {
    double min_m = std::numeric_limits<double>::infinity();
    for (const std::uint32_t vertex : model.corner_vertices) { min_m = std::min(min_m, model.vertices_m[vertex].x); }
    return min_m;
}

bool is_of_nozzle(const std::string& name) {
    return name.starts_with("nozzle") || name.starts_with("burner") || name.starts_with("exhaust");
}

} // namespace

EffectStrength strength_of(const sim::AircraftKind* kind, const sim::AircraftState& state) {
    constexpr double full_flame = 0.1; // The reheat fraction with a full flame: its first stage looks like its last.
    EffectStrength strength;
    strength.exhaust = 1.0;
    strength.burner = glm::smoothstep(0.0, full_flame, sim::reheat_fraction(kind, state));
    strength.vapour = glm::smoothstep(3.0, 5.5, std::abs(state.load_factor));
    return strength;
}

/// The transparent effects around an aircraft: plumes behind nozzles and vapour behind wingtips. Each effect lies
/// beyond a plane on whose other side, or in which, the whole aircraft lies: it is painted after the aircraft for eyes
/// on its own side and before it for all others.
class AircraftEffects {
public:
    /// Finds the effects of a model in body axes: plumes at its parts named as nozzles or burners, and, if there is
    /// one, vapour at its wingtips.
    explicit AircraftEffects(const PolygonModel& model) {
        find_plumes(model);
        find_vapour(model);
    }

    /// The bounds of all effects at any strength, body axes.
    const std::optional<AxisAlignedBox>& bounds() const { return extent_; }

    /// Draws the effects that are before or after the aircraft in the painting order.
    void draw(const PlacedAircraft& aircraft, Transparent::Place place, const EffectStrength& strength, Shape& shape) {
        const glm::dvec3 eye_m(glm::inverse(aircraft.parts[0])[3]);
        // From far to near.
        std::ranges::sort(effects_, std::ranges::greater(), [&](const Effect& effect) {
            return std::tuple(glm::distance(effect.position_m, eye_m), effect.kind, effect.outward.y);
        });
        for (const Effect& effect : effects_) {
            if (place_of(effect, eye_m) != place) { continue; }
            if (effect.kind == Kind::Plume) {
                draw_plume(effect.position_m, effect.radius_m, strength, shape);
            } else if (strength.vapour > 0.0) {
                draw_vapour(effect.position_m, strength.vapour, shape);
            }
        }
    }

private:
    enum class Kind : std::uint8_t { Plume, Vapour };

    /// `outward` is the unit vector from the plane through `position_m` to the effect's side.
    struct Effect {
        Kind kind = Kind::Plume;
        glm::dvec3 position_m{0.0};
        glm::dvec3 outward{-1.0, 0.0, 0.0};
        double radius_m = 1.0;
    };

    static Transparent::Place place_of(const Effect& effect, const glm::dvec3& eye_m) {
        const bool in_front = glm::dot(eye_m - effect.position_m, effect.outward) > 0.0;
        return in_front ? Transparent::Place::InFront : Transparent::Place::Behind;
    }

    /// The plane of all plumes is that of the rearmost corner.
    void find_plumes(const PolygonModel& model) {
        const glm::dvec3 aft(-1.0, 0.0, 0.0);
        const double rear_m = rear_of(model);
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 min_m(1e9);
            glm::dvec3 max_m(-1e9);
            for (std::size_t polygon = 0; polygon < model.polygons.size(); ++polygon) {
                if (!is_of_nozzle(model.parts[model.polygons[polygon].part])) { continue; }
                for (const std::uint32_t vertex : model.corners(polygon)) {
                    const glm::dvec3& at_m = model.vertices_m[vertex];
                    if (side * at_m.y >= 0.0) {
                        min_m = glm::min(min_m, at_m);
                        max_m = glm::max(max_m, at_m);
                    }
                }
            }
            if (min_m.x > max_m.x) { continue; }
            const double radius_m = 0.42 * std::min(max_m.y - min_m.y, max_m.z - min_m.z);
            const glm::dvec3 position_m(rear_m, 0.5 * (min_m.y + max_m.y), 0.5 * (min_m.z + max_m.z));
            add_effect({.kind = Kind::Plume, .position_m = position_m, .outward = aft, .radius_m = radius_m},
                plume_radii * radius_m * aft);
        }
    }

    /// Only aircraft with a plume, which are jets: others hardly ever reach such load factors.
    void find_vapour(const PolygonModel& model) {
        if (std::ranges::none_of(effects_, [](const Effect& one) { return one.kind == Kind::Plume; })) { return; }
        for (const double side : {-1.0, 1.0}) {
            const glm::dvec3 outward(0.0, side, 0.0);
            glm::dvec3 tip_m(0.0);
            double max_m = 0.0;
            for (const glm::dvec3& at_m : model.vertices_m) {
                // The rearmost of the outermost corners.
                if (side * at_m.y > max_m + 1e-6 || (side * at_m.y > max_m - 1e-6 && at_m.x < tip_m.x)) {
                    max_m = std::max(max_m, side * at_m.y);
                    tip_m = at_m;
                }
            }
            add_effect({.kind = Kind::Vapour, .position_m = tip_m, .outward = outward, .radius_m = vapour_high_m},
                {-vapour_m, 0.0, 0.0});
        }
    }

    void add_effect(const Effect& effect, const glm::dvec3& reach_m) {
        const glm::dvec3 min_m = glm::min(effect.position_m, effect.position_m + reach_m) - effect.radius_m;
        const glm::dvec3 max_m = glm::max(effect.position_m, effect.position_m + reach_m) + effect.radius_m;
        const AxisAlignedBox before = extent_.value_or(AxisAlignedBox{min_m, max_m});
        extent_ = AxisAlignedBox{glm::min(before.min_m, min_m), glm::max(before.max_m, max_m)};
        effects_.push_back(effect);
    }

    std::vector<Effect> effects_;
    std::optional<AxisAlignedBox> extent_;
};

// The ribbon.

namespace {

constexpr std::size_t max_dashes = 80;
/// The time of a dash; longer where there would be more than max_dashes.
constexpr double dash_s = 1.0;
constexpr double box_margin_m = 0.2;
constexpr double farthest_dash_m = 40000.0;
/// Amber and cyan.
constexpr std::array<std::uint32_t, 2> leg_colours{0x001e8cffU, 0x00e6d232U};
constexpr std::uint32_t flown_alpha = 0xd0U;
constexpr std::uint32_t coming_alpha = 0x68U;

/// The smallest box along a dash's chord around its corners.
OrientedBox box_around(std::span<const models::ColourVertex> corners, const glm::dvec3& chord) {
    OrientedBox box;
    const double length_m = glm::length(chord);
    const glm::dvec3 along = length_m > 1e-6 ? chord / length_m : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 level(-along.y, along.x, 0.0);
    const glm::dvec3 side = glm::length(level) > 1e-6 ? glm::normalize(level) : glm::dvec3(0.0, 1.0, 0.0);
    box.axes = glm::dmat3(along, side, glm::cross(along, side));
    glm::dvec3 min_m(1e300);
    glm::dvec3 max_m(-1e300);
    for (const models::ColourVertex& corner : corners) {
        const glm::dvec3 at = glm::transpose(box.axes) * glm::dvec3(corner.position_m);
        min_m = glm::min(min_m, at);
        max_m = glm::max(max_m, at);
    }
    box.centre_m = box.axes * (0.5 * (min_m + max_m));
    box.half_m = 0.5 * (max_m - min_m) + box_margin_m;
    return box;
}

} // namespace

/// The eye, and the properties of the ribbon in one frame.
struct RibbonView {
    glm::dvec3 eye_m{0.0};
    /// The radius of the earth, by whose curvature distant points sink; 0 = flat.
    double earth_radius_m = 0.0;
    /// The path before this time has a stronger colour.
    double time_s = 0.0;
    double half_width_m = 3.0;
    /// The ribbon ends at this distance before and behind the aircraft.
    double gap_m = 15.0;
};

/// A path as a ribbon along the wings, in dashes of about equal times with gaps between them, so that each dash has its
/// own place in the painting order. Legs alternate between two colours.
class PathRibbon {
public:
    /// The path must outlive the ribbon.
    explicit PathRibbon(const DrawnPath& path) : path_(path) {
        const auto usual = static_cast<std::size_t>(std::lround(dash_s / path.step_s));
        points_per_dash_ = std::max({usual, path.points.size() / max_dashes, std::size_t{2}});
    }

    /// A dash of a frame, and the box around it, eye at the origin.
    struct Dash {
        OrientedBox box;
        TransparentRange range;
    };

    /// The dashes of a frame, added to its geometry. Valid until the next call.
    std::span<const Dash> dashes(const RibbonView& view, TransparentGeometry& geometry) {
        dashes_.clear();
        if (path_.points.size() < 2) { return dashes_; }
        const std::size_t last = path_.points.size() - 1;
        for (std::size_t first = 0; first < last; first += points_per_dash_) {
            // The last tenth is the gap to the next dash.
            const std::size_t gap = std::max<std::size_t>(points_per_dash_ / 10, 1);
            add_dash(first, std::min(first + points_per_dash_ - gap, last), view, geometry);
        }
        return dashes_;
    }

private:
    /// The aircraft's position on the path, between `point` and the next one.
    struct AircraftPoint {
        /// The time as a number of points.
        double fractional_point;
        /// The last point that it has passed.
        std::size_t point;
        glm::dvec3 place_m;
    };

    AircraftPoint aircraft_point(double time_s) const {
        const double fractional_point = (time_s - path_.first_s) / path_.step_s;
        const auto last = static_cast<double>(path_.points.size() - 1);
        const double at = std::clamp(fractional_point, 0.0, last);
        const auto point = static_cast<std::size_t>(at);
        const std::size_t next = std::min(point + 1, path_.points.size() - 1);
        return {fractional_point, point,
            glm::mix(path_.points[point].position_m, path_.points[next].position_m, at - static_cast<double>(point))};
    }

    /// Adds the dash of points first .. last without the part near the aircraft; in two pieces if that is inside.
    void add_dash(std::size_t first, std::size_t last, const RibbonView& view, TransparentGeometry& geometry) {
        const AircraftPoint aircraft = aircraft_point(view.time_s);
        const auto close = [&](std::size_t point) {
            return glm::distance(path_.points[point].position_m, aircraft.place_m) < view.gap_m;
        };
        const bool holds_aircraft = aircraft.point >= first && aircraft.point < last;
        std::size_t until = holds_aircraft ? aircraft.point : last;
        std::size_t from = holds_aircraft ? aircraft.point + 1 : first;
        while (until > first && close(until)) { --until; }
        while (from < last && close(from)) { ++from; }
        if (holds_aircraft) {
            add_ribbon_section(first, until, view, geometry);
            add_ribbon_section(from, last, view, geometry);
        } else {
            add_ribbon_section(from, until, view, geometry);
        }
    }

    void add_ribbon_section(
        std::size_t first, std::size_t last, const RibbonView& view, TransparentGeometry& geometry) {
        const auto away_m = [&](std::size_t point) {
            return glm::distance(path_.points[point].position_m, view.eye_m);
        };
        if (first >= last || std::min(away_m(first), away_m(last)) > farthest_dash_m) { return; }
        const double fractional_point = aircraft_point(view.time_s).fractional_point;
        const auto next_leg = std::ranges::upper_bound(path_.legs, first, {}, &DrawnPath::Leg::first_point);
        const auto leg = static_cast<std::size_t>(next_leg - path_.legs.begin());
        vertices_.clear();
        indices_.clear();
        for (std::size_t i = first; i <= last; ++i) {
            const DrawnPath::Point& point = path_.points[i];
            const bool flown = static_cast<double>(i) <= fractional_point;
            const std::uint32_t colour = leg_colours[leg % leg_colours.size()] | (flown ? flown_alpha : coming_alpha)
                                                                                     << 24U;
            for (const double side : {-1.0, 1.0}) {
                glm::dvec3 at_m = point.position_m + side * view.half_width_m * point.right - view.eye_m;
                if (view.earth_radius_m > 0.0) {
                    at_m.z -= (at_m.x * at_m.x + at_m.y * at_m.y) / (2.0 * view.earth_radius_m);
                }
                vertices_.push_back({glm::vec3(at_m), colour});
            }
            if (i > first) {
                const auto a = static_cast<std::uint32_t>(vertices_.size() - 4);
                indices_.insert(indices_.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
            }
        }
        const glm::dvec3 chord = path_.points[last].position_m - path_.points[first].position_m;
        const TransparentRange range = geometry.add(vertices_, indices_);
        if (range.count > 0) { dashes_.push_back({box_around(vertices_, chord), range}); }
    }

    const DrawnPath& path_;
    std::size_t points_per_dash_ = 1;
    std::vector<Dash> dashes_;
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

// The list.

struct Transparents::Parts {
    const Scene& scene;
    TransparentGeometry geometry;
    std::optional<nature::CloudLayer> clouds;
    double cloud_height_m = 0.0;
    std::optional<PathRibbon> ribbon;
    std::vector<AircraftEffects> effects; ///< One for each of Scene::aircraft; empty where none are asked for.
    std::vector<std::optional<AxisAlignedBox>> effect_bounds;
    std::vector<Transparent> list;
    std::vector<OrientedBox> boxes;
    TransparentRange cloud_range;
    /// The corners and triangles of one effect.
    std::vector<models::ColourVertex> vertices;
    std::vector<std::uint32_t> indices;

    void add(Transparent::Place place, std::size_t box, const TransparentRange& range) {
        if (range.count > 0 || place == Transparent::Place::Glass || place == Transparent::Place::Disc) {
            list.push_back({place, static_cast<std::uint32_t>(box), range});
        }
    }

    void add_effects(
        const FrameView& view, const PlanRequest& request, const Fleet& fleet, const scene::FramePlan& plan) {
        constexpr double min_px = 6.0; // Smaller aircraft have no effects.
        const EffectLight light{plan.ambient, plan.sunlight, glm::dvec3(plan.to_sun), view.pixel_rad};
        for (std::size_t i = 0; i < fleet.bounding_boxes().size(); ++i) {
            const OrientedBox& hull = fleet.bounding_boxes()[i];
            const bool is_seen = radius_m(hull) > min_px * view.pixel_rad * glm::length(hull.centre_m);
            if (!is_seen || !in_view(hull, view)) { continue; }
            const PlacedAircraft& aircraft = fleet.placed()[i];
            for (const PlacedDisc& disc : aircraft.discs) {
                Shape shape = empty_shape(glm::dmat4(1.0));
                draw_disc(place_disc(*aircraft.model, aircraft.parts, disc.disc, disc.side),
                    aircraft.model->discs[disc.disc].root_m, aircraft.disc_strengths[disc.disc], light, shape);
                add(Transparent::Place::Disc, i, geometry.add(vertices, indices));
            }
            if (effects.empty()) { continue; }
            const EffectStrength strength =
                strength_of(sim::find_aircraft_kind(scene.model_of(i).polygons.name), request.states[i]);
            for (const Transparent::Place place : {Transparent::Place::Behind, Transparent::Place::InFront}) {
                Shape shape = empty_shape(aircraft.parts[0]);
                effects[i].draw(aircraft, place, strength, shape);
                add(place, i, geometry.add(vertices, indices));
            }
        }
    }

    Shape empty_shape(const glm::dmat4& body_to_eye_world) {
        vertices.clear();
        indices.clear();
        return {body_to_eye_world, vertices, indices};
    }

    /// Adds the dashes of the ribbon, except dashes that intersect the box of an aircraft: they have no painting order.
    void add_ribbon(const FrameView& view, double time_s, std::span<const OrientedBox> hulls) {
        const double radius = scene.model_of(0).subject.radius_m;
        constexpr double half_width = 0.3; // As a share of the aircraft's radius, as the gap.
        constexpr double gap = 1.8;
        const auto dashes = ribbon->dashes(
            {view.camera.eye_m, view.earth_radius_m, time_s, half_width * radius, gap * radius}, geometry);
        for (const PathRibbon::Dash& dash : dashes) {
            const auto intersects = [&](const OrientedBox& hull) { return occlusion_pair(hull, dash.box).intersect; };
            if (std::ranges::any_of(hulls, intersects)) { continue; }
            add(Transparent::Place::Apart, hulls.size() + boxes.size(), dash.range);
            boxes.push_back(dash.box);
        }
    }
};

namespace {

double height_of_clouds_m(const landscape::Ground& ground, const scene::AirSettings& air) {
    constexpr double above_ground_m = 500.0;
    return air.cloud_height_m ? *air.cloud_height_m : landscape::highest_m(ground) + above_ground_m;
}

} // namespace

Transparents::Transparents(const Scene& scene, const scene::Settings& settings, const nature::Daylight& day)
    : parts_(new Parts{scene, {}, {}, 0.0, {}, {}, {}, {}, {}, {}, {}, {}}) {
    if (settings.air.clouds > 0.0) {
        parts_->clouds.emplace(settings.air.clouds);
        parts_->cloud_height_m = height_of_clouds_m(*scene.ground, settings.air);
        set_daylight(day);
    }
    if (settings.view.path_ribbon && scene.path) { parts_->ribbon.emplace(*scene.path); }
    for (const std::uint32_t model : scene.aircraft) {
        std::optional<AxisAlignedBox>& bounds = parts_->effect_bounds.emplace_back();
        if (settings.surface.effects == true) {
            bounds = parts_->effects.emplace_back(scene.models[model]->polygons).bounds();
        }
    }
}

Transparents::~Transparents() = default;

void Transparents::set_daylight(const nature::Daylight& day) {
    if (parts_->clouds) { parts_->clouds->set_daylight(day); }
}

void Transparents::make(
    const FrameView& view, const PlanRequest& request, const Fleet& fleet, const scene::FramePlan& plan) {
    Parts& parts = *parts_;
    parts.list.clear();
    parts.boxes.clear();
    parts.cloud_range = {};
    parts.geometry.begin(plan.view_to_clip * plan.world_to_view, view.size_px, plan.haze);
    if (parts.clouds) {
        const auto clouds = parts.clouds->seen_from(view.camera.eye_m, parts.cloud_height_m, view.earth_radius_m);
        parts.cloud_range = parts.geometry.add(clouds.vertices, clouds.indices);
        parts.add(Transparent::Place::CloudLayer, models::invalid_index, parts.cloud_range);
    }
    parts.add_effects(view, request, fleet, plan);
    for (std::size_t i = 0; i < fleet.bounding_boxes().size(); ++i) {
        const PlacedAircraft& aircraft = fleet.placed()[i];
        if (has_glass(aircraft)) { parts.add(Transparent::Place::Glass, i, {}); }
    }
    if (parts.ribbon) { parts.add_ribbon(view, request.states.front().time_s, fleet.bounding_boxes()); }
    std::ranges::stable_sort(parts.list, {}, [](const Transparent& one) { return std::pair(one.box, one.place); });
}

std::span<const std::optional<AxisAlignedBox>> Transparents::effect_bounds() const { return parts_->effect_bounds; }

std::span<const Transparent> Transparents::list() const { return parts_->list; }

std::span<const OrientedBox> Transparents::boxes() const { return parts_->boxes; }

scene::OverlayDraw Transparents::draw() const { return parts_->geometry.draw(); }

TransparentRange Transparents::clouds() const { return parts_->cloud_range; }

std::optional<double> Transparents::cloud_height_m() const {
    return parts_->clouds ? std::optional(parts_->cloud_height_m) : std::nullopt;
}

bool Transparents::has_ribbon() const { return parts_->ribbon.has_value(); }

} // namespace octant::visuals::planning
