#include "tests/ui/flight/layer_rays.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace octant::tests {

namespace scene = visuals::scene;

namespace {

/// View axes: x right, y up, z back; the eye at the origin.
struct SeenTriangle {
    std::array<glm::dvec3, 3> corners_m;
    glm::dvec3 colour{0.0}; ///< levels, 0..255
    double opacity = 1.0;
};

struct Layer {
    double depth_m = 0.0;
    const SeenTriangle* triangle = nullptr;
};

void add_triangles(std::span<const scene::ModelVertex> vertices, std::span<const std::uint32_t> indices,
    std::span<const glm::mat4> parts, const glm::dmat4& world_to_view, double opacity,
    std::vector<SeenTriangle>& triangles) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        if (indices[i] == indices[i + 1]) { continue; }
        SeenTriangle& made = triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const scene::ModelVertex& vertex = vertices[indices[i + k]];
            const glm::dmat4 to_view = world_to_view * glm::dmat4(parts[vertex.part]);
            made.corners_m[k] = glm::dvec3(to_view * glm::dvec4(glm::dvec3(vertex.position_m), 1.0));
        }
        const std::uint32_t colour = vertices[indices[i]].face_colour;
        made.colour = glm::dvec3(colour & 255U, colour >> 8U & 255U, colour >> 16U & 255U);
        made.opacity = opacity;
    }
}

std::vector<SeenTriangle> triangles_of(const scene::FramePlan& plan, std::span<const scene::ModelBuffers> models) {
    std::vector<SeenTriangle> triangles;
    const glm::dmat4 to_view(plan.world_to_view);
    for (const scene::PaintStep& step : plan.steps) {
        for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
            if (step.content == scene::PaintStep::Content::Refined) {
                const scene::RefinedDraw& draw = plan.refined[i];
                add_triangles(draw.vertices, draw.indices, std::span(plan.parts).subspan(draw.first_part), to_view, 1.0,
                    triangles);
            } else if (step.content == scene::PaintStep::Content::Aircraft) {
                const scene::AircraftDraw& draw = plan.aircraft[i];
                const scene::ModelBuffers& model = models[draw.model];
                const auto parts = std::span(plan.parts).subspan(draw.first_part);
                const auto add = [&](std::uint32_t first, std::uint32_t count) {
                    add_triangles(model.vertices, std::span(model.indices).subspan(first, count), parts, to_view,
                        static_cast<double>(step.opacity), triangles);
                };
                if (draw.ranges.empty()) { add(draw.first_index, draw.index_count); }
                for (const scene::IndexRange& range : draw.ranges) { add(range.first_index, range.index_count); }
            }
        }
    }
    return triangles;
}

/// The depth at which a ray of depth 1 enters a triangle by its front.
std::optional<double> hit(const SeenTriangle& triangle, const glm::dvec3& way) {
    const auto& [a, b, c] = triangle.corners_m;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double towards = glm::dot(normal, way);
    if (towards >= 0.0) { return std::nullopt; }
    const double depth_m = glm::dot(normal, a) / towards;
    if (!(depth_m > 0.0)) { return std::nullopt; }
    const auto is_left = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(from, to), way) <= 0.0;
    };
    const bool inside = is_left(a, b) && is_left(b, c) && is_left(c, a);
    return inside ? std::optional(depth_m) : std::nullopt;
}

/// Triangles by the pixels that they may cover, with a margin.
class CandidateGrid {
public:
    CandidateGrid(std::span<const SeenTriangle> triangles, const scene::FramePlan& plan, const glm::ivec2& size_px)
        : size_px_(size_px), of_pixel_(static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y)) {
        for (const SeenTriangle& triangle : triangles) { add(triangle, plan); }
    }

    std::span<const SeenTriangle* const> at(int column, int row) const { return of_pixel_[place(column, row)]; }

private:
    std::size_t place(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_px_.x) + static_cast<std::size_t>(column);
    }

    void add(const SeenTriangle& triangle, const scene::FramePlan& plan) {
        constexpr double margin_px = 2.0;
        glm::dvec2 low(std::numeric_limits<double>::max());
        glm::dvec2 high(std::numeric_limits<double>::lowest());
        for (const glm::dvec3& corner_m : triangle.corners_m) {
            if (corner_m.z > -1e-3) { // near the eye: anywhere
                low = glm::dvec2(0.0);
                high = glm::dvec2(size_px_);
                break;
            }
            const glm::dvec2 at(corner_m.x * static_cast<double>(plan.view_to_clip[0][0]),
                corner_m.y * static_cast<double>(plan.view_to_clip[1][1]));
            const glm::dvec2 px = (glm::dvec2(at.x, -at.y) / -corner_m.z + 1.0) * 0.5 * glm::dvec2(size_px_);
            low = glm::min(low, px - margin_px);
            high = glm::max(high, px + margin_px);
        }
        const glm::dvec2 end(size_px_ - 1);
        const glm::ivec2 from(glm::clamp(low, glm::dvec2(0.0), end));
        const glm::ivec2 to(glm::clamp(high, glm::dvec2(0.0), end));
        for (int row = from.y; row <= to.y; ++row) {
            for (int column = from.x; column <= to.x; ++column) { of_pixel_[place(column, row)].push_back(&triangle); }
        }
    }

    glm::ivec2 size_px_;
    std::vector<std::vector<const SeenTriangle*>> of_pixel_;
};

/// What a ray sees, the nearest first, up to the first opaque surface. Nothing where two surfaces that differ are in
/// one place.
std::optional<std::vector<Layer>> layers_along(std::span<const SeenTriangle* const> triangles, const glm::dvec3& way) {
    constexpr double same_place = 1e-5; // of the depth
    std::vector<Layer> layers;
    for (const SeenTriangle* triangle : triangles) {
        if (const auto depth_m = hit(*triangle, way)) { layers.push_back({*depth_m, triangle}); }
    }
    std::ranges::sort(layers, {}, &Layer::depth_m);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (i > 0 && layers[i].depth_m - layers[i - 1].depth_m < same_place * layers[i].depth_m &&
            (layers[i].triangle->colour != layers[i - 1].triangle->colour ||
                layers[i].triangle->opacity != layers[i - 1].triangle->opacity)) {
            return std::nullopt;
        }
        const bool is_last = layers[i].triangle->opacity == 1.0;
        const bool next_is_near =
            i + 1 < layers.size() && layers[i + 1].depth_m - layers[i].depth_m < same_place * layers[i].depth_m;
        if (is_last && !next_is_near) {
            layers.resize(i + 1);
            break;
        }
    }
    return layers;
}

bool look_alike(const std::vector<Layer>& a, const std::vector<Layer>& b) {
    return std::ranges::equal(a, b, [](const Layer& one, const Layer& other) {
        return one.triangle->colour == other.triangle->colour && one.triangle->opacity == other.triangle->opacity;
    });
}

} // namespace

LayerCheck& LayerCheck::operator+=(const LayerCheck& more) {
    pixels += more.pixels;
    layered += more.layered;
    deepest = std::max(deepest, more.deepest);
    wrong += more.wrong;
    first_wrong.insert(first_wrong.end(), more.first_wrong.begin(), more.first_wrong.end());
    return *this;
}

void keep_only_aircraft(scene::FramePlan& plan) {
    using Content = scene::PaintStep::Content;
    std::erase_if(plan.steps, [](const scene::PaintStep& step) {
        return step.content != Content::Aircraft && step.content != Content::Refined &&
               step.content != Content::ClearDepth;
    });
    plan.background = glm::vec3(0.0F);
    plan.haze = {};
    plan.mirrored_sky.reset();
    plan.ambient = glm::vec3(1.0F);
    plan.sunlight = glm::vec3(0.0F);
    plan.ground_texture.reset();
    plan.detail_texture.reset();
    plan.ground = {};
    plan.sky = {};
    plan.overlay = {};
    std::ranges::fill(plan.smooth, 0U);
}

LayerCheck check_layers(
    const scene::FramePlan& plan, std::span<const scene::ModelBuffers> models, const scene::Picture& picture) {
    const glm::ivec2 size_px(picture.width, picture.height);
    const std::vector<SeenTriangle> triangles = triangles_of(plan, models);
    const CandidateGrid grid(triangles, plan, size_px);
    const auto way = [&](double x_px, double y_px) {
        return glm::dvec3((2.0 * x_px - size_px.x) / size_px.x / static_cast<double>(plan.view_to_clip[0][0]),
            (size_px.y - 2.0 * y_px) / size_px.y / static_cast<double>(plan.view_to_clip[1][1]), -1.0);
    };
    LayerCheck check;
    for (int row = 1; row + 1 < size_px.y; ++row) {
        for (int column = 1; column + 1 < size_px.x; ++column) {
            const auto candidates = grid.at(column, row);
            if (candidates.empty()) { continue; }
            const auto middle = layers_along(candidates, way(column + 0.5, row + 0.5));
            // Whether rays around the middle, so many each way, meet the same layers.
            const auto is_plain = [&](int each_way) {
                if (!middle || middle->empty()) { return false; }
                for (int k = 0; k < (2 * each_way + 1) * (2 * each_way + 1); ++k) {
                    const double x = 0.7 * (k % (2 * each_way + 1) - each_way) / each_way;
                    const double y = 0.7 * (k / (2 * each_way + 1) - each_way) / each_way;
                    const auto beside = layers_along(candidates, way(column + 0.5 + x, row + 0.5 + y));
                    if (!beside || !look_alike(*middle, *beside)) { return false; }
                }
                return true;
            };
            if (!is_plain(1)) { continue; }
            glm::dvec3 colour(0.0);
            int clear = 0;
            for (auto layer = middle->rbegin(); layer != middle->rend(); ++layer) {
                colour = glm::mix(colour, layer->triangle->colour, layer->triangle->opacity);
                clear += layer->triangle->opacity < 1.0 ? 1 : 0;
            }
            const std::size_t at = 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(size_px.x) +
                                           static_cast<std::size_t>(column));
            const glm::dvec3 got(picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]);
            const glm::dvec3 off = glm::abs(got - colour);
            const bool is_wrong = std::max({off.x, off.y, off.z}) > 2.0 + clear;
            if (is_wrong && !is_plain(20)) { continue; } // a gap or a sliver between the first rays
            ++check.pixels;
            check.layered += clear > 0 && middle->size() > 1 ? 1 : 0;
            check.deepest = std::max(check.deepest, clear);
            if (is_wrong) {
                ++check.wrong;
                if (check.first_wrong.size() < 2) {
                    std::string& text = check.first_wrong.emplace_back(
                        fmt::format("({}, {}) is {} {} {}, not", column, row, got.x, got.y, got.z));
                    for (const Layer& layer : *middle) {
                        const glm::dvec3& own = layer.triangle->colour;
                        text += fmt::format(" {} {} {} of {:.2f} at {:.6f} m,", own.x, own.y, own.z,
                            layer.triangle->opacity, layer.depth_m);
                    }
                }
            }
        }
    }
    return check;
}

} // namespace octant::tests
