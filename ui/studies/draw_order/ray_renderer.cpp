#include "ui/studies/draw_order/ray_renderer.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;

namespace {

constexpr std::uint32_t without_alpha = 0xffffffU;
constexpr double nearer_share = 1e-6; ///< by which one of two depths must be nearer to count

std::size_t index_of(const glm::ivec2& pixel, const glm::ivec2& size_px) {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size_px.x) + static_cast<std::size_t>(pixel.x);
}

std::uint32_t number_in(const scene::Picture& picture, std::size_t pixel) {
    std::uint32_t number = 0;
    std::memcpy(&number, picture.rgba.data() + 4 * pixel, sizeof number);
    return number & without_alpha;
}

double distance_to_segment(const glm::dvec2& at, const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 side = to - from;
    const double length2 = glm::dot(side, side);
    const double share = length2 > 0.0 ? std::clamp(glm::dot(at - from, side) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(at, from + share * side);
}

/// Places within reach of a pixel's middle, itself among them: a square grid.
std::array<glm::dvec3, 25> places_around(const glm::ivec2& pixel, double reach_px) {
    std::array<glm::dvec3, 25> places;
    for (int i = 0; i < 25; ++i) {
        const glm::dvec2 steps(i % 5 - 2, i / 5 - 2);
        places[static_cast<std::size_t>(i)] = {glm::dvec2(pixel) + steps * (reach_px / 2.0), 1.0};
    }
    return places;
}

/// The box of what of a triangle lies before the near plane, from homogeneous places in pixels.
std::array<glm::dvec2, 2> box_of(const glm::dmat3& corners, double near_m) {
    std::array<glm::dvec2, 2> box{glm::dvec2(1e9), glm::dvec2(-1e9)};
    const auto add = [&](const glm::dvec3& at) {
        box[0] = glm::min(box[0], glm::dvec2(at) / at.z);
        box[1] = glm::max(box[1], glm::dvec2(at) / at.z);
    };
    for (glm::length_t i = 0; i < 3; ++i) {
        const glm::dvec3& here = corners[i];
        const glm::dvec3& next = corners[(i + 1) % 3];
        if (here.z >= near_m) { add(here); }
        if ((here.z >= near_m) != (next.z >= near_m)) {
            add(glm::mix(here, next, (near_m - here.z) / (next.z - here.z)));
        }
    }
    return box;
}

} // namespace

double RayRenderer::Target::inside_px(const glm::dvec3& at) const {
    return std::min({glm::dot(inwards[0], at), glm::dot(inwards[1], at), glm::dot(inwards[2], at)});
}

double RayRenderer::Target::distance_px(const glm::dvec2& at) const {
    const double inside = inside_px({at, 1.0});
    if (inside >= 0.0) { return 0.0; }
    return is_placed ? std::min({distance_to_segment(at, corners_px[0], corners_px[1]),
                           distance_to_segment(at, corners_px[1], corners_px[2]),
                           distance_to_segment(at, corners_px[2], corners_px[0])})
                     : -inside;
}

RayRenderer::RayRenderer(const glm::ivec2& size_px) : size_px_(size_px) {
    info_ = {.description = "rays", .device = "processor", .is_software = true};
    picture_.width = size_px.x;
    picture_.height = size_px.y;
    const std::size_t pixels = static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y);
    picture_.rgba.assign(4 * pixels, 0);
    inverse_depths_.assign(pixels, 0.0);
}

void RayRenderer::draw(const scene::FramePlan& plan) {
    world_to_clip_ = glm::dmat4(plan.view_to_clip) * glm::dmat4(plan.world_to_view);
    near_m_ = static_cast<double>(plan.view_to_clip[3][2]);
    targets_.clear();
    pieces_ = 0;
    add_ground(plan);
    for (const scene::PaintStep& step : plan.steps) {
        for (std::uint32_t i = step.first;
             step.content == scene::PaintStep::Content::Aircraft && i < step.first + step.count; ++i) {
            add_aircraft(plan, plan.aircraft[i]);
        }
    }
    std::ranges::fill(picture_.rgba, std::uint8_t{0});
    std::ranges::fill(inverse_depths_, 0.0);
    for (const Target& target : targets_) { draw_target(target); }
}

void RayRenderer::add_ground(const scene::FramePlan& plan) {
    const auto& indices = plan.ground.indices;
    const auto& vertices = plan.ground.vertices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        ++pieces_;
        add({vertices[indices[i]].position_m, vertices[indices[i + 1]].position_m, vertices[indices[i + 2]].position_m},
            vertices[indices[i]].colour, false);
    }
}

void RayRenderer::add_aircraft(const scene::FramePlan& plan, const scene::AircraftDraw& draw) {
    const scene::ModelBuffers& model = models_[draw.model];
    const auto add_range = [&](std::size_t first, std::size_t count) {
        std::optional<std::uint32_t> polygon;
        for (std::size_t i = first; i + 2 < first + count; i += 3) {
            const std::uint32_t next = model.vertices[model.indices[i]].polygon;
            if (polygon != next) { ++pieces_; }
            polygon = next;
            std::array<glm::vec3, 3> corners_m;
            for (std::size_t k = 0; k < 3; ++k) {
                const scene::ModelVertex& vertex = model.vertices[model.indices[i + k]];
                const glm::dmat4 turn(plan.parts[draw.first_part + vertex.part]);
                corners_m[k] = glm::vec3(turn * glm::dvec4(glm::dvec3(vertex.position_m), 1.0));
            }
            add(corners_m, model.vertices[model.indices[i]].face_colour, true);
        }
    };
    if (draw.ranges.empty()) { add_range(draw.first_index, draw.index_count); }
    for (const scene::IndexRange& range : draw.ranges) { add_range(range.first_index, range.index_count); }
}

void RayRenderer::add(const std::array<glm::vec3, 3>& corners_m, std::uint32_t number, bool culls) {
    glm::dmat3 corners; // homogeneous places, pixels from the middle of the upper left one
    for (glm::length_t k = 0; k < 3; ++k) {
        const glm::dvec4 clip = world_to_clip_ * glm::dvec4(glm::dvec3(corners_m[static_cast<std::size_t>(k)]), 1.0);
        corners[k] = {(clip.x + clip.w) * 0.5 * size_px_.x - 0.5 * clip.w,
            (clip.w - clip.y) * 0.5 * size_px_.y - 0.5 * clip.w, clip.w};
    }
    const double doubled_area = glm::determinant(corners);
    if (doubled_area == 0.0 || (culls && doubled_area > 0.0)) { return; }
    const auto [least, most] = box_of(corners, near_m_);
    Target target;
    target.least = glm::max(glm::ivec2(glm::max(glm::floor(least) - 1.0, glm::dvec2(-1.0))), glm::ivec2(0));
    target.most = glm::min(glm::ivec2(glm::min(glm::ceil(most) + 1.0, glm::dvec2(size_px_))), size_px_ - 1);
    if (target.least.x > target.most.x || target.least.y > target.most.y) { return; }
    const glm::dmat3 rows = glm::transpose(glm::inverse(corners));
    for (glm::length_t k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        target.inwards[i] = rows[k] / std::max(glm::length(glm::dvec2(rows[k])), 1e-300);
        target.inverse_depth += rows[k];
        target.max_over_w = std::max(target.max_over_w, 1.0 / std::max(corners[k].z, near_m_));
        target.corners_px[i] = glm::dvec2(corners[k]) / corners[k].z;
    }
    target.is_placed = corners[0].z >= near_m_ && corners[1].z >= near_m_ && corners[2].z >= near_m_;
    target.number = number & without_alpha;
    target.piece = pieces_;
    targets_.push_back(target);
}

void RayRenderer::draw_target(const Target& target) {
    for (int row = target.least.y; row <= target.most.y; ++row) {
        for (int column = target.least.x; column <= target.most.x; ++column) {
            const glm::dvec3 at(column, row, 1.0);
            if (target.inside_px(at) < 0.0) { continue; }
            const double inverse_depth = glm::dot(target.inverse_depth, at);
            const std::size_t pixel = index_of({column, row}, size_px_);
            if (inverse_depth > inverse_depths_[pixel] && inverse_depth * near_m_ <= 1.0) {
                inverse_depths_[pixel] = inverse_depth;
                std::memcpy(picture_.rgba.data() + 4 * pixel, &target.number, sizeof target.number);
            }
        }
    }
}

std::uint32_t RayRenderer::number_of(const glm::ivec2& pixel) const {
    return number_in(picture_, index_of(pixel, size_px_));
}

RayRenderer::Difference RayRenderer::compare(const scene::Picture& picture, double reach_px) const {
    assert(picture.width == size_px_.x && picture.height == size_px_.y);
    Difference difference;
    for (int row = 0; row < size_px_.y; ++row) {
        for (int column = 0; column < size_px_.x; ++column) {
            const std::size_t pixel = index_of({column, row}, size_px_);
            const std::uint32_t number = number_in(picture, pixel);
            if (number == number_in(picture_, pixel)) { continue; }
            ++difference.differing;
            if (const auto fault = wrong_pixel_at({column, row}, number, reach_px)) {
                difference.wrong.push_back(*fault);
            }
        }
    }
    return difference;
}

bool RayRenderer::may_reach(const Target& target, const glm::ivec2& pixel, double reach_px) {
    return pixel.x >= target.least.x && pixel.x <= target.most.x && pixel.y >= target.least.y &&
           pixel.y <= target.most.y && target.inside_px({pixel, 1.0}) >= -reach_px;
}

std::optional<RayRenderer::WrongPixel> RayRenderer::wrong_pixel_at(
    const glm::ivec2& pixel, std::uint32_t number, double reach_px) const {
    const glm::dvec2 middle(pixel);
    const glm::dvec3 at(middle, 1.0);
    std::vector<const Target*> others;
    double shown_by_w = number == 0 ? 0.0 : -1.0; // 0: nothing, infinitely far
    for (const Target& target : targets_) {
        if (!may_reach(target, pixel, reach_px)) { continue; }
        if (target.number != number) {
            others.push_back(&target);
        } else if (target.distance_px(middle) <= reach_px) {
            const double inverse_depth =
                glm::dot(target.inverse_depth, at) + reach_px * glm::length(glm::dvec2(target.inverse_depth));
            shown_by_w = std::max(shown_by_w, std::min(inverse_depth, target.max_over_w));
        }
    }
    if (shown_by_w < 0.0) { return WrongPixel{pixel, number, std::nullopt}; }
    const auto hides = [&](const glm::dvec3& place) {
        return std::ranges::any_of(others, [&](const Target* other) {
            const double inverse_depth = glm::dot(other->inverse_depth, place);
            return other->inside_px(place) >= 0.0 && inverse_depth * near_m_ <= 1.0 &&
                   inverse_depth > shown_by_w * (1.0 + nearer_share);
        });
    };
    if (!std::ranges::all_of(places_around(pixel, reach_px), hides)) { return std::nullopt; }
    const double found_by_w = inverse_depths_[index_of(pixel, size_px_)];
    return WrongPixel{pixel, number, found_by_w / shown_by_w - 1.0};
}

bool RayRenderer::is_rounding(
    const glm::ivec2& pixel, std::uint32_t number, std::uint32_t seen, double reach_px) const {
    const glm::dvec2 middle(pixel);
    const auto places = places_around(pixel, reach_px);
    std::uint32_t last = 0; // painted without rounding
    bool may_be_shown = false;
    for (auto first = targets_.begin(); first != targets_.end();) {
        const auto end =
            std::find_if(first, targets_.end(), [&](const Target& one) { return one.piece != first->piece; });
        const std::span piece(first, end);
        first = end;
        if (std::ranges::none_of(piece, [&](const Target& one) {
                return may_reach(one, pixel, reach_px) && one.distance_px(middle) <= reach_px;
            })) {
            continue;
        }
        const auto covers = [&](const glm::dvec3& place) {
            return std::ranges::any_of(piece, [&](const Target& one) { return one.inside_px(place) >= 0.0; });
        };
        const bool is_certain = std::ranges::all_of(places, covers);
        last = covers({middle, 1.0}) ? piece.front().number : last;
        may_be_shown = !is_certain && (may_be_shown || piece.front().number == number);
    }
    return may_be_shown && last == seen;
}

} // namespace octant::ui::studies::draw_order
