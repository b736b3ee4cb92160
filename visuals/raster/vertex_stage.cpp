// Step 2 of a picture (renderer.cpp): vertices are projected to the screen and hazed, those of aircraft lit before,
// several at once. Compiled once for each instruction set; all give the same bits, because real numbers are summed and
// multiplied one by one. Next: triangle_setup.cpp.
#include "visuals/raster/vertex_stage.h"

// SVE's vectors have no size that the compiler knows: they can be no members.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#define HWY_BROKEN_EMU128 0 // compiled so that it is right, see CMakeLists.txt
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visuals/raster/vertex_stage.cpp"
// clang-format off: foreach_target.h must come before all that includes highway.h
#include <hwy/foreach_target.h>
// clang-format on

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <hwy/highway.h>
#include <span>

HWY_BEFORE_NAMESPACE();

namespace octant::visuals::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Reals = hn::CappedTag<float, 16>;
using Whole = hn::RebindToSigned<Reals>;
using Bits = hn::RebindToUnsigned<Reals>;
using Real = hn::Vec<Reals>;
constexpr std::size_t at_once = hn::MaxLanes(Reals());
constexpr float max_level = 255.0F;
/// Fall of the haze's density along a line of sight, as a power of e: below the minimum it is taken as linear, above
/// the maximum as the maximum.
constexpr float min_haze_fall = 4e-3F;
constexpr float max_haze_fall = 60.0F;
/// Cosine between a line of sight and a polygon's normal above which its back is seen: a hundred times what rounding
/// leaves open.
constexpr float min_turn = 1e-5F;

HWY_INLINE Real set(float value) { return hn::Set(Reals(), value); }

/// The value between `from` and `to` at `share`, as mix() of GLSL gives it.
HWY_INLINE Real mixed(Real from, Real to, Real share) {
    return hn::Add(hn::Mul(from, hn::Sub(set(1.0F), share)), hn::Mul(to, share));
}

/// 2^-part is the Taylor series of exp(-part * ln 2) about part = 1/2.
HWY_INLINE Real exp_of_minus(Real x) {
    const Whole whole;
    const auto power = hn::Min(hn::Mul(x, set(1.44269504F)), set(126.0F));
    const auto down = hn::ConvertTo(whole, power);
    const auto part = hn::Sub(power, hn::ConvertTo(Reals(), down));
    const auto t = hn::Mul(hn::Sub(set(0.5F), part), set(0.693147181F));
    auto series = set(1.0F);
    for (const float order : {7.0F, 6.0F, 5.0F, 4.0F, 3.0F, 2.0F, 1.0F}) {
        series = hn::Add(set(1.0F), hn::Mul(hn::Div(t, set(order)), series));
    }
    const auto power_of_two = hn::ShiftLeft<23>(hn::Sub(hn::Set(whole, 127), down));
    return hn::Mul(hn::Mul(set(0.707106781F), series), hn::BitCast(Reals(), power_of_two));
}

/// Three values of each vertex: a place or a direction.
struct Triple {
    Real x, y, z;
};

HWY_INLINE Real dot(const Triple& a, const Triple& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// A byte of packed colours.
template <int shift>
HWY_INLINE Real level(hn::Vec<Bits> colour) {
    const auto byte = hn::And(hn::ShiftRight<shift>(colour), hn::Set(Bits(), 0xffU));
    return hn::ConvertTo(Reals(), hn::BitCast(Whole(), byte));
}

float ExpOfMinus(float x) { return hn::GetLane(exp_of_minus(set(x))); }

/// Corners of ground: their places in world axes with the eye subtracted, metres.
struct GroundCorners : Triple {
    hn::Vec<Bits> colour;

    HWY_INLINE explicit GroundCorners(const models::ColourVertex* from) {
        const Reals reals;
        Real packed;
        static_assert(sizeof(models::ColourVertex) == 4 * sizeof(float));
        hn::LoadInterleaved4(reals, &from->position_m.x, x, y, z, packed);
        colour = hn::BitCast(Bits(), packed);
    }
};

/// Haze between the eye and places, as scene::Haze says.
struct Haze {
    Real distance_m;
    Real share;
    std::array<Real, 3> rgb_255;

    HWY_INLINE Haze(const Triple& at, const Light& light) {
        const Reals reals;
        distance_m = hn::Sqrt(dot(at, at));
        const auto haze_density_exponent = hn::Mul(at.z, set(light.falloff_per_m));
        const auto size = hn::Abs(haze_density_exponent);
        const auto left = exp_of_minus(hn::Min(size, set(max_haze_fall)));
        const auto over = hn::IfThenElse(hn::Gt(haze_density_exponent, hn::Zero(reals)), size, hn::Mul(size, left));
        const auto density = hn::IfThenElse(hn::Ge(size, set(min_haze_fall)), hn::Div(hn::Sub(set(1.0F), left), over),
            hn::Sub(set(1.0F), hn::Mul(set(0.5F), haze_density_exponent)));
        const auto depth = hn::Mul(hn::Mul(distance_m, set(light.per_m)), density);
        share = hn::Sub(set(1.0F), exp_of_minus(depth));
        const auto level_m =
            hn::Add(hn::Mul(at.x, set(light.horizontal_to_sun.x)), hn::Mul(at.y, set(light.horizontal_to_sun.y)));
        const auto towards = hn::Max(hn::Div(level_m, hn::Max(distance_m, set(1e-6F))), hn::Zero(reals));
        const auto sunward_colour = hn::Mul(towards, towards);
        for (glm::length_t i = 0; i < 3; ++i) {
            rgb_255[static_cast<std::size_t>(i)] =
                hn::Mul(mixed(set(light.haze[i]), set(light.sunward_colour[i]), sunward_colour), set(max_level));
        }
    }
};

/// A block of corners on their way to the lists.
struct VertexStore {
    alignas(64) std::array<float, 4 * at_once> place;
    alignas(64) std::array<float, 4 * at_once> value;
    alignas(64) std::array<float, 3 * at_once> clip;

    /// Projects, as place() does a single vertex.
    HWY_INLINE void put(const Triple& at, const Projection& projection) {
        const Reals reals;
        const Whole whole;
        const auto row = [&](glm::length_t i) HWY_ATTR {
            const auto& m = projection.world_to_clip;
            const auto sum = hn::Add(hn::Mul(set(m[0][i]), at.x), hn::Mul(set(m[1][i]), at.y));
            return hn::Add(hn::Add(sum, hn::Mul(set(m[2][i]), at.z)), set(m[3][i]));
        };
        const auto x = row(0);
        const auto y = row(1);
        const auto w = row(3);
        hn::StoreInterleaved3(x, y, w, reals, clip.data());
        const auto minus_w = hn::Neg(w);
        const auto bit_where = [&](hn::Mask<Reals> mask, std::uint32_t bit) HWY_ATTR {
            return hn::IfThenElseZero(hn::RebindMask(Bits(), mask), hn::Set(Bits(), bit));
        };
        const auto is_placed = hn::And(
            hn::Ge(w, set(projection.near_m)), hn::And(hn::Le(hn::Abs(x), hn::Mul(set(projection.max_over_w.x), w)),
                                                   hn::Le(hn::Abs(y), hn::Mul(set(projection.max_over_w.y), w))));
        const auto off_sides =
            hn::Or(bit_where(hn::Lt(x, minus_w), left_of_view), bit_where(hn::Gt(x, w), right_of_view));
        const auto over = hn::Or(bit_where(hn::Gt(y, w), above_view), bit_where(hn::Lt(y, minus_w), below_view));
        const auto outcode = hn::Or(hn::Or(off_sides, over), bit_where(hn::Not(is_placed), beyond_range));
        const auto inverse_w = hn::Div(set(1.0F), w);
        const auto steps = [&](hn::Vec<Reals> px) HWY_ATTR {
            const auto from_middle = hn::Mul(hn::Sub(px, set(0.5F)), set(static_cast<float>(ScreenVertex::per_px)));
            const auto half = hn::IfThenElse(hn::Lt(from_middle, hn::Zero(reals)), set(-0.5F), set(0.5F));
            const auto placed = hn::IfThenElseZero(is_placed, hn::Add(from_middle, half));
            return hn::BitCast(reals, hn::ConvertTo(whole, placed));
        };
        const auto half_x = set(projection.half_px.x);
        const auto half_y = set(projection.half_px.y);
        const auto x_px = hn::Add(hn::Mul(hn::Mul(x, inverse_w), half_x), half_x);
        const auto y_px = hn::Sub(half_y, hn::Mul(hn::Mul(y, inverse_w), half_y));
        hn::StoreInterleaved4(steps(x_px), steps(y_px), inverse_w, hn::BitCast(reals, outcode), reals, place.data());
    }

    HWY_INLINE void put_values(Real a, Real b, Real c, Real d) {
        hn::StoreInterleaved4(a, b, c, d, Reals(), value.data());
    }

    HWY_INLINE void copy(std::size_t count, std::size_t first, const VertexOutputs& to) const {
        static_assert(sizeof(ScreenVertex) == 8 * sizeof(float));
        static_assert(sizeof(ClipPosition) == 3 * sizeof(float));
        std::memcpy(&to.clip[first].x, clip.data(), count * sizeof(ClipPosition));
        for (std::size_t i = 0; i < count; ++i) {
            ScreenVertex& vertex = to.vertices[first + i];
            std::memcpy(&vertex.x, place.data() + 4 * i, 4 * sizeof(float));
            std::memcpy(vertex.value.data(), value.data() + 4 * i, 4 * sizeof(float));
        }
    }
};

/// Calls values_of(places, store) for each block of corners, then writes it.
template <class ValuesOf>
HWY_INLINE void project_each(std::span<const models::ColourVertex> from, const Projection& projection,
    const VertexOutputs& to, const ValuesOf& values_of) {
    VertexStore store;
    std::array<models::ColourVertex, at_once> last{};
    for (std::size_t first = 0; first < from.size(); first += at_once) {
        const std::size_t count = std::min(at_once, from.size() - first);
        const models::ColourVertex* block = from.data() + first;
        if (count < at_once) {
            std::copy_n(block, count, last.begin());
            block = last.data();
        }
        const GroundCorners at(block);
        store.put(at, projection);
        values_of(at, store);
        store.copy(count, first, to);
    }
}

void ProjectColoured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const VertexOutputs& to) {
    const auto own = [&](const GroundCorners& at, VertexStore& store) HWY_ATTR {
        store.put_values(level<0>(at.colour), level<8>(at.colour), level<16>(at.colour), level<24>(at.colour));
    };
    const auto in_haze = [&](const GroundCorners& at, VertexStore& store) HWY_ATTR {
        const Haze haze(at, light);
        store.put_values(mixed(level<0>(at.colour), haze.rgb_255[0], haze.share),
            mixed(level<8>(at.colour), haze.rgb_255[1], haze.share),
            mixed(level<16>(at.colour), haze.rgb_255[2], haze.share), level<24>(at.colour));
    };
    if (light.per_m > 0.0F) {
        project_each(from, projection, to, in_haze);
    } else {
        project_each(from, projection, to, own);
    }
}

void ProjectTextured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const TexelTransform& to_texels, const VertexOutputs& to) {
    project_each(from, projection, to, [&](const GroundCorners& at, VertexStore& store) HWY_ATTR {
        const auto x = hn::Add(set(to_texels.at_eye.x), hn::Mul(at.x, set(to_texels.per_m.x)));
        const auto y = hn::Add(set(to_texels.at_eye.y), hn::Mul(at.y, set(to_texels.per_m.y)));
        const auto light_left = hn::Div(level<24>(at.colour), set(max_level));
        store.put_values(x, y, light_left, Haze(at, light).share);
    });
}

// -- Vertices of aircraft.

/// A register of four values each of every fourth vertex, where the next vertex lies `stride` values behind.
template <class Tag>
HWY_INLINE hn::Vec<Tag> four_of_each(Tag tag, const float* from, std::size_t stride) {
    if constexpr (hn::MaxLanes(tag) == 4) {
        return hn::LoadU(tag, from);
    } else {
        const hn::Half<Tag> half;
        return hn::Combine(
            tag, four_of_each(half, from + hn::MaxLanes(half) * stride, stride), four_of_each(half, from, stride));
    }
}

/// Vertices of aircraft, as many as a register holds: a register for each of their members' values.
class ModelBlock {
public:
    HWY_INLINE explicit ModelBlock(const scene::ModelVertex* from) {
        const auto* const values = reinterpret_cast<const float*>(from);
        for (std::size_t i = 0; i < count; i += 4) {
            // The first, second, third and last vertex of each four.
            const auto vertex = [&](std::size_t k)
                                    HWY_ATTR { return four_of_each(Reals(), values + k * count + i, count); };
            transpose({vertex(0), vertex(1), vertex(2), vertex(3)}, i);
        }
    }

    /// A member that takes four bytes, by its offset.
    HWY_INLINE hn::Vec<Bits> bits(std::size_t offset) const {
        return hn::BitCast(Bits(), values_[offset / sizeof(float)]);
    }

    /// A glm::vec3.
    HWY_INLINE Triple triple(std::size_t offset) const {
        const std::size_t i = offset / sizeof(float);
        return {values_[i], values_[i + 1], values_[i + 2]};
    }

private:
    static constexpr std::size_t count = sizeof(scene::ModelVertex) / sizeof(float);
    static_assert(count % 4 == 0 && count * sizeof(float) == sizeof(scene::ModelVertex));

    /// Four values of each vertex, from the i-th on, in four registers.
    HWY_INLINE void transpose(const std::array<Real, 4>& vertices, std::size_t i) {
        const Reals reals;
        const auto even = [&](std::size_t k) HWY_ATTR {
            return std::array{hn::InterleaveLower(reals, vertices[k], vertices[k + 2]),
                hn::InterleaveUpper(reals, vertices[k], vertices[k + 2])};
        };
        const auto first = even(0);
        const auto second = even(1);
        for (std::size_t k = 0; k < 2; ++k) {
            values_[i + 2 * k] = hn::InterleaveLower(reals, first[k], second[k]);
            values_[i + 2 * k + 1] = hn::InterleaveUpper(reals, first[k], second[k]);
        }
    }

    std::array<Real, count> values_;
};

/// From the axes of each vertex's part to world axes with the eye subtracted.
class PartTurns {
public:
    HWY_INLINE PartTurns(std::span<const glm::mat4> parts, hn::Vec<Bits> part) {
        const std::uint32_t first = hn::GetLane(part);
        if (hn::AllTrue(Bits(), hn::Eq(part, hn::Set(Bits(), first)))) {
            set_each([&](glm::length_t column, glm::length_t row) HWY_ATTR { return set(parts[first][column][row]); });
            return;
        }
        const auto matrices = hn::BitCast(Whole(), hn::ShiftLeft<4>(part)); // in numbers, from the first one
        set_each([&](glm::length_t column, glm::length_t row)
                     HWY_ATTR { return hn::GatherIndex(Reals(), &parts[0][column][row], matrices); });
    }

    HWY_INLINE Triple place(const Triple& at) const {
        const auto row = [&](std::size_t i) HWY_ATTR {
            const auto level = hn::Add(hn::Mul(columns_[0][i], at.x), hn::Mul(columns_[1][i], at.y));
            return hn::Add(level, hn::Add(hn::Mul(columns_[2][i], at.z), columns_[3][i]));
        };
        return {row(0), row(1), row(2)};
    }

    HWY_INLINE Triple direction(const Triple& in_part) const {
        const auto row = [&](std::size_t i) HWY_ATTR {
            return dot({columns_[0][i], columns_[1][i], columns_[2][i]}, in_part);
        };
        return {row(0), row(1), row(2)};
    }

private:
    static_assert(sizeof(glm::mat4) == 16 * sizeof(float));

    template <class Number>
    HWY_INLINE void set_each(const Number& number) {
        for (std::size_t column = 0; column < 4; ++column) {
            for (std::size_t row = 0; row < 3; ++row) {
                columns_[column][row] = number(static_cast<glm::length_t>(column), static_cast<glm::length_t>(row));
            }
        }
    }

    std::array<std::array<Real, 3>, 4> columns_;
};

/// Colours 0..255 under a tint, if its alpha says so.
HWY_INLINE Triple tinted(hn::Vec<Bits> colour, std::uint32_t tint) {
    const Triple own{level<0>(colour), level<8>(colour), level<16>(colour)};
    if (tint == 0) { return own; }
    const auto over = hn::Set(Bits(), tint);
    const auto share = hn::Div(level<24>(over), set(max_level));
    return {
        mixed(own.x, level<0>(over), share), mixed(own.y, level<8>(over), share), mixed(own.z, level<16>(over), share)};
}

/// What glass adds to a surface: its own colour times `left`, plus `rgb_255`.
struct Mirror {
    Real left;
    Triple rgb_255;
};

HWY_INLINE Mirror no_mirror() { return {set(1.0F), {set(0.0F), set(0.0F), set(0.0F)}}; }

/// The part of a haze's colour that an axis has, 0..255, towards a direction.
HWY_INLINE Real haze_towards(const Triple& direction, const Light& light, glm::length_t i) {
    const auto level = hn::Add(
        hn::Mul(direction.x, set(light.horizontal_to_sun.x)), hn::Mul(direction.y, set(light.horizontal_to_sun.y)));
    const auto towards = hn::Max(level, hn::Zero(Reals()));
    return hn::Mul(mixed(set(light.haze[i]), set(light.sunward_colour[i]), hn::Mul(towards, towards)), set(max_level));
}

/// scene::MirroredSky at corners of these colours, of which those without glass mirror nothing.
HWY_INLINE Mirror mirror_of(
    hn::Vec<Bits> colour, const Triple& at, Real distance_m, const Triple& outwards, const Light& light) {
    using scene::MirroredSky;
    const auto alpha = hn::ShiftRight<24>(colour);
    const auto is_glass = hn::RebindMask(Reals(), hn::Ne(alpha, hn::Set(Bits(), 255U)));
    if (!light.mirrored_sky || hn::AllFalse(Reals(), is_glass)) { return no_mirror(); }
    const auto one = set(1.0F);
    const auto zero = hn::Zero(Reals());
    const auto inverse = hn::Div(one, hn::Max(distance_m, set(1e-6F)));
    const auto along = hn::Mul(dot(outwards, at), inverse); // minus the cosine
    const auto doubled = hn::Add(along, along);
    const Triple mirrored{hn::Sub(hn::Mul(at.x, inverse), hn::Mul(doubled, outwards.x)),
        hn::Sub(hn::Mul(at.y, inverse), hn::Mul(doubled, outwards.y)),
        hn::Sub(hn::Mul(at.z, inverse), hn::Mul(doubled, outwards.z))};
    const auto flat = hn::Sub(one, hn::Min(hn::Abs(along), one));
    const auto squared = hn::Mul(flat, flat);
    const auto share =
        hn::Add(set(MirroredSky::f0), hn::Mul(set(1.0F - MirroredSky::f0), hn::Mul(hn::Mul(squared, squared), flat)));
    auto glint = hn::Max(dot(mirrored, {set(light.to_sun.x), set(light.to_sun.y), set(light.to_sun.z)}), zero);
    for (int power = 1; power < MirroredSky::power; power *= 2) { glint = hn::Mul(glint, glint); }
    const auto up = hn::Min(hn::Max(mirrored.z, zero), one);
    const auto overhead = hn::Mul(up, hn::Sub(set(2.0F), up));
    const auto below = hn::Min(hn::Max(hn::Mul(mirrored.z, set(-4.0F)), zero), one);
    const auto opacity = hn::Mul(hn::ConvertTo(Reals(), hn::BitCast(Whole(), alpha)), set(1.0F / 254.0F));
    const auto weight = hn::IfThenElseZero(is_glass, hn::Div(share, hn::Max(opacity, set(0.05F))));
    const auto seen = [&](glm::length_t i) HWY_ATTR {
        const auto haze = haze_towards(mirrored, light, i);
        const auto sky = mixed(haze, set(light.mirrored_sky->overhead[i] * max_level), overhead);
        const auto all = mixed(sky, set(light.mirrored_sky->below[i] * max_level), below);
        const auto sun = hn::Mul(glint, set(light.sunlight[i] * MirroredSky::glint * max_level));
        return hn::Mul(weight, hn::Add(all, sun));
    };
    return {hn::IfThenElse(is_glass, hn::Sub(one, share), one), {seen(0), seen(1), seen(2)}};
}

/// Colours under the light on surfaces that face `outwards`, behind haze; 0..255. Those of textured ones are multiplied
/// by texels before anything else happens to them: they keep what the haze leaves, and may be more than full.
HWY_INLINE Triple lit(const Triple& rgb_255, const Triple& outwards, const Light& light, const Haze& haze,
    const Mirror& mirror, hn::Mask<Reals> is_textured) {
    constexpr float most = 380.0F; // fits the painter's numbers
    const Triple to_sun{set(light.to_sun.x), set(light.to_sun.y), set(light.to_sun.z)};
    const auto towards_sun = hn::Max(dot(outwards, to_sun), hn::Zero(Reals()));
    const auto seen = [&](Real own, Real added, glm::length_t i) HWY_ATTR {
        const auto sum = hn::Add(set(light.ambient[i]), hn::Mul(set(light.sunlight[i]), towards_sun));
        const auto under_light = hn::Add(hn::Mul(hn::Mul(own, sum), mirror.left), added);
        const auto in_haze =
            mixed(hn::Min(under_light, set(max_level)), haze.rgb_255[static_cast<std::size_t>(i)], haze.share);
        const auto left = hn::Mul(hn::Min(under_light, set(most)), hn::Sub(set(1.0F), haze.share));
        return hn::IfThenElse(is_textured, left, in_haze);
    };
    const Triple& added = mirror.rgb_255;
    return {seen(rgb_255.x, added.x, 0), seen(rgb_255.y, added.y, 1), seen(rgb_255.z, added.z, 2)};
}

/// Whether each vertex's polygon is smooth.
HWY_INLINE hn::Mask<Bits> is_smooth(std::span<const std::uint32_t> smooth, hn::Vec<Bits> polygon) {
    const Bits bits;
    const auto word = hn::ShiftRight<5>(polygon);
    const auto words = hn::Set(bits, static_cast<std::uint32_t>(smooth.size()));
    const auto is_known = hn::Lt(word, words);
    if (smooth.empty()) { return is_known; } // none is
    const auto place = hn::BitCast(Whole(), hn::IfThenElseZero(is_known, word));
    const auto values = hn::GatherIndex(bits, smooth.data(), place);
    const auto bit = hn::Shl(hn::Set(bits, 1U), hn::And(polygon, hn::Set(bits, 31U)));
    return hn::And(is_known, hn::Ne(hn::And(values, bit), hn::Zero(bits)));
}

/// Whether each vertex has a texture.
HWY_INLINE hn::Mask<Reals> has_texture_of(const ModelBlock& block, const AircraftDrawState& state) {
    if (!state.has_textures) { return hn::MaskFromVec(hn::Zero(Reals())); }
    const auto texture = block.bits(offsetof(scene::ModelVertex, texture));
    return hn::RebindMask(Reals(), hn::Ne(texture, hn::Zero(Bits())));
}

/// Writes what vertices that are lit in each pixel need.
void put_lit(const std::array<Triple, 4>& triples, Real transmittance, std::span<LitVertex> to) {
    constexpr std::array members{&LitVertex::normal, &LitVertex::to_eye, &LitVertex::rgb, &LitVertex::haze};
    alignas(64) std::array<float, at_once> values;
    for (std::size_t k = 0; k < members.size(); ++k) {
        const std::array parts{triples[k].x, triples[k].y, triples[k].z};
        for (std::size_t i = 0; i < 3; ++i) {
            hn::Store(parts[i], Reals(), values.data());
            for (std::size_t lane = 0; lane < to.size(); ++lane) { (to[lane].*members[k])[i] = values[lane]; }
        }
    }
    hn::Store(transmittance, Reals(), values.data());
    for (std::size_t lane = 0; lane < to.size(); ++lane) { to[lane].transmittance = values[lane]; }
}

void ProjectAircraft(std::span<const scene::ModelVertex> from, const AircraftDrawState& state,
    const Projection& projection, const Light& light, const VertexOutputs& to) {
    using scene::ModelVertex;
    const Bits bits;
    VertexStore store;
    std::array<ModelVertex, at_once> last{};
    alignas(64) std::array<float, 4 * at_once> flat;
    for (std::size_t first = 0; first < from.size(); first += at_once) {
        const std::size_t count = std::min(at_once, from.size() - first);
        const ModelVertex* vertices = from.data() + first;
        if (count < at_once) {
            std::copy_n(vertices, count, last.begin());
            vertices = last.data();
        }
        const ModelBlock block(vertices);
        const PartTurns turns(state.parts, block.bits(offsetof(ModelVertex, part)));
        const Triple at = turns.place(block.triple(offsetof(ModelVertex, position_m)));
        store.put(at, projection);
        const Haze haze(at, light);
        const Triple own = tinted(block.bits(offsetof(ModelVertex, colour)), state.tints.smooth);
        const Triple normal = turns.direction(block.triple(offsetof(ModelVertex, normal)));
        const auto has_texture = has_texture_of(block, state);
        const auto textured = [&](std::uint32_t tint)
                                  HWY_ATTR { return tint == 0 ? has_texture : hn::MaskFromVec(hn::Zero(Reals())); };
        // Tinted polygons show their tint alone.
        const auto mirror_at = [&](std::size_t offset, std::uint32_t tint, const Triple& outwards) HWY_ATTR {
            return tint != 0 ? no_mirror() : mirror_of(block.bits(offset), at, haze.distance_m, outwards, light);
        };
        const Mirror mirror = mirror_at(offsetof(ModelVertex, colour), state.tints.smooth, normal);
        const Triple of_corner = lit(own, normal, light, haze, mirror, textured(state.tints.smooth));
        store.put_values(of_corner.x, of_corner.y, of_corner.z, haze.share);
        store.copy(count, first, to);
        const Triple face_normal = turns.direction(block.triple(offsetof(ModelVertex, face_normal)));
        const Triple face_own = tinted(block.bits(offsetof(ModelVertex, face_colour)), state.tints.flat);
        const Mirror face_mirror = mirror_at(offsetof(ModelVertex, face_colour), state.tints.flat, face_normal);
        const Triple of_face = lit(face_own, face_normal, light, haze, face_mirror, textured(state.tints.flat));
        const auto turned_away = hn::Gt(dot(face_normal, at), hn::Mul(set(min_turn), haze.distance_m));
        const auto smooth = is_smooth(state.smooth, block.bits(offsetof(ModelVertex, polygon)));
        const auto flags = hn::Or(hn::IfThenElseZero(smooth, hn::Set(bits, FlatColour::smooth)),
            hn::IfThenElseZero(hn::RebindMask(bits, turned_away), hn::Set(bits, FlatColour::back_facing)));
        hn::StoreInterleaved4(of_face.x, of_face.y, of_face.z, hn::BitCast(Reals(), flags), Reals(), flat.data());
        static_assert(sizeof(FlatColour) == 4 * sizeof(float));
        std::memcpy(to.flat[first].rgb.data(), flat.data(), count * sizeof(FlatColour));
        if (!to.lit.empty()) {
            const Triple to_eye{hn::Neg(at.x), hn::Neg(at.y), hn::Neg(at.z)};
            // What is mirrored comes to the eye as haze does.
            const auto transmittance = hn::Sub(set(1.0F), haze.share);
            const auto air = [&](Real mirrored, std::size_t i) HWY_ATTR {
                return hn::Add(
                    hn::Mul(haze.rgb_255[i], haze.share), hn::Mul(hn::Min(mirrored, set(max_level)), transmittance));
            };
            const Triple haze_rgb{air(mirror.rgb_255.x, 0), air(mirror.rgb_255.y, 1), air(mirror.rgb_255.z, 2)};
            put_lit({normal, to_eye, own, haze_rgb}, hn::Mul(transmittance, mirror.left), to.lit.subspan(first, count));
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace octant::visuals::raster

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octant::visuals::raster {

HWY_EXPORT(ExpOfMinus);
HWY_EXPORT(ProjectColoured);
HWY_EXPORT(ProjectTextured);
HWY_EXPORT(ProjectAircraft);

Light light_of(const scene::FramePlan& plan) {
    const float visibility_m = plan.haze.visibility_m;
    return {plan.ambient, plan.sunlight, plan.to_sun, plan.haze.colour,
        visibility_m > 0.0F ? 1.0F / visibility_m : 0.0F, plan.haze.falloff_per_m, plan.haze.horizontal_to_sun,
        plan.haze.sunward_colour, plan.mirrored_sky};
}

std::array<std::uint16_t, 3> haze_before(const glm::vec3& at_m, const Light& light) {
    const float level_m = at_m.x * light.horizontal_to_sun.x + at_m.y * light.horizontal_to_sun.y;
    const float towards = std::max(level_m / std::max(glm::length(at_m), 1e-6F), 0.0F);
    const glm::vec3 colour = glm::mix(light.haze, light.sunward_colour, towards * towards);
    const auto packed = [](float share) {
        return static_cast<std::uint16_t>(std::clamp(share, 0.0F, 1.0F) * 255.0F * 128.0F + 0.5F);
    };
    return {packed(colour.x), packed(colour.y), packed(colour.z)};
}

float exp_of_minus(float x) { return HWY_DYNAMIC_DISPATCH(ExpOfMinus)(x); }

void project_coloured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const VertexOutputs& to) {
    assert(to.vertices.size() == from.size() && to.clip.size() == from.size());
    HWY_DYNAMIC_DISPATCH(ProjectColoured)(from, projection, light, to);
}

void project_textured(std::span<const models::ColourVertex> from, const Projection& projection, const Light& light,
    const TexelTransform& to_texels, const VertexOutputs& to) {
    assert(to.vertices.size() == from.size() && to.clip.size() == from.size());
    HWY_DYNAMIC_DISPATCH(ProjectTextured)(from, projection, light, to_texels, to);
}

void project_aircraft(std::span<const scene::ModelVertex> from, const AircraftDrawState& state,
    const Projection& projection, const Light& light, const VertexOutputs& to) {
    assert(to.vertices.size() == from.size() && to.flat.size() == from.size());
    HWY_DYNAMIC_DISPATCH(ProjectAircraft)(from, state, projection, light, to);
}

} // namespace octant::visuals::raster
#endif
