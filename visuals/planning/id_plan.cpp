#include "visuals/planning/id_plan.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <fmt/format.h>
#include <span>

namespace octant::visuals::planning {

namespace {

constexpr std::uint32_t aircraft_bit = 1U << 23U;
constexpr std::uint32_t number_mask = aircraft_bit - 1U;
constexpr std::uint32_t opaque = 0xFF000000U;

/// A number of the triangle's three places, whatever the order of its corners; never 0.
std::uint32_t ground_id(const std::array<glm::vec3, 3>& corners) {
    std::array<std::uint64_t, 3> hashes{};
    for (std::size_t i = 0; i < 3; ++i) {
        Hash hash;
        hash.add(std::as_bytes(std::span(&corners[i], 1)));
        hashes[i] = hash.value();
    }
    std::sort(hashes.begin(), hashes.end());
    Hash whole;
    whole.add(std::as_bytes(std::span(hashes)));
    const auto number = static_cast<std::uint32_t>(whole.value() ^ (whole.value() >> 32U));
    return std::max(number & number_mask, 1U);
}

/// What is painted on the ground has a number for each colour: its pieces overlap.
std::uint32_t paint_id(std::uint32_t colour) {
    Hash hash;
    hash.add(std::as_bytes(std::span(&colour, 1)));
    return std::max(static_cast<std::uint32_t>(hash.value()) & number_mask, 1U);
}

/// Numbers of a model's polygons. Not how many they are: a model may be split in one way of drawing, whole in another.
std::uint32_t number_count(const AircraftModel& model) {
    std::uint32_t count = 0;
    for (std::size_t polygon = 0; polygon < model.polygons.polygons.size(); ++polygon) {
        count = std::max(count, model.polygons.parent_of(polygon) + 1);
    }
    return count;
}

/// The model's vertices with the numbers of their polygons for colours, counted from `first`.
scene::ModelBuffers numbered(const AircraftModel& model, std::uint32_t first) {
    scene::ModelBuffers buffers = model.buffers;
    buffers.textures.clear();
    for (scene::ModelVertex& vertex : buffers.vertices) { vertex.texture = 0; }
    const std::uint32_t count = number_count(model);
    if (first + count + buffers.vertices.size() > number_mask) {
        throw Error(fmt::format("pictures of polygon numbers: expected less than {} polygons and corners in all, got "
                                "more with {}",
            number_mask, model.polygons.name));
    }
    const std::vector<std::uint32_t>& begins = model.first_vertices;
    for (std::size_t polygon = 0; polygon + 1 < begins.size(); ++polygon) {
        const std::uint32_t id = first + model.polygons.parent_of(polygon);
        for (std::uint32_t i = begins[polygon]; i < begins[polygon + 1]; ++i) {
            buffers.vertices[i].face_colour = opaque | aircraft_bit | id;
        }
    }
    // Behind them those of the levels of detail: one of them begins each triangle.
    for (std::size_t i = begins.back(); i < buffers.vertices.size(); ++i) {
        const auto id = static_cast<std::uint32_t>(first + count + i);
        buffers.vertices[i].face_colour = opaque | aircraft_bit | id;
    }
    return buffers;
}

void throw_if_refined(const AircraftModel& model) {
    if (model.progressive) {
        throw Error(fmt::format("pictures of polygon numbers: expected polygons or levels of detail, got {}, which is "
                                "refined in each frame and whose triangles have no numbers",
            model.polygons.name));
    }
}

} // namespace

IdPlan::IdPlan(const Scene& scene) {
    std::uint32_t first = 0;
    const auto add = [&](const AircraftModel& model) {
        throw_if_refined(model);
        const std::size_t parts = model.part_count();
        model_of_part_.insert(model_of_part_.end(), parts, static_cast<std::uint32_t>(models_.size()));
        models_.push_back(numbered(model, first));
        first += number_count(model);
        first += model.levels.empty() ? 0 : static_cast<std::uint32_t>(model.buffers.vertices.size());
    };
    for (const std::uint32_t model : scene.aircraft) {
        const auto far = std::ranges::find(scene.far_models, model, &FarModel::model);
        const std::size_t first_part = model_of_part_.size();
        add(*scene.models[model]);
        if (far != scene.far_models.end()) {
            // Both have the same parts in a plan, of which it draws one.
            const std::size_t parts = model_of_part_.size() - first_part;
            far_ids_of_part_.push_back(
                {static_cast<std::uint32_t>(first_part), far->far_model, static_cast<std::uint32_t>(models_.size())});
            add(*scene.models[far->far_model]);
            const std::size_t far_parts = model_of_part_.size() - first_part - parts;
            model_of_part_.resize(first_part + std::max(parts, far_parts), model_of_part_[first_part]);
        }
    }
    if (scene.cockpit) { add(*scene.models[*scene.cockpit]); }
}

void IdPlan::add_ground(const scene::FramePlan& plan, std::span<const std::uint32_t> indices) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::size_t own = plan.ground.vertices.size();
        std::array<glm::vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = indices[i + k];
            corners[k] = at < own ? plan.ground.vertices[at].position_m : plan.shadow_vertices[at - own].position_m;
        }
        const std::uint32_t colour =
            opaque | (indices[i] < own ? ground_id(corners) : paint_id(plan.shadow_vertices[indices[i] - own].colour));
        for (const glm::vec3& corner : corners) {
            indices_.push_back(static_cast<std::uint32_t>(vertices_.size()));
            vertices_.push_back({corner, colour});
        }
    }
}

const scene::FramePlan& IdPlan::of(const scene::FramePlan& plan) {
    vertices_.clear();
    indices_.clear();
    plan_ = plan;
    plan_.background = glm::vec3(0.0F);
    plan_.haze = {};
    plan_.ground_texture.reset();
    plan_.detail_texture.reset();
    plan_.ground_has_polygon_numbers = true;
    plan_.ambient = glm::vec3(1.0F);
    plan_.sunlight = glm::vec3(0.0F);
    std::erase_if(plan_.steps, [](const scene::PaintStep& step) {
        return step.content == scene::PaintStep::Content::Sky ||
               step.content == scene::PaintStep::Content::Transparent ||
               step.content == scene::PaintStep::Content::Overlay;
    });
    for (scene::PaintStep& step : plan_.steps) { step.opacity = 1.0F; } // the nearest polygon counts, glass or not
    std::ranges::fill(plan_.smooth, 0U);                                // a flat polygon has one colour
    for (scene::AircraftDraw& draw : plan_.aircraft) {
        const auto far = std::ranges::find_if(far_ids_of_part_,
            [&](const FarModelIds& one) { return one.first_part == draw.first_part && one.far_model == draw.model; });
        draw.model = far != far_ids_of_part_.end() ? far->numbered : model_of_part_[draw.first_part];
        draw.tints = {};
    }
    add_ground(plan, plan.ground.indices);
    const std::size_t ground_indices = indices_.size();
    add_ground(plan, plan.repaint_indices);
    plan_.ground = {vertices_, std::span(indices_).first(ground_indices)};
    plan_.repaint_indices.assign(indices_.begin() + static_cast<std::ptrdiff_t>(ground_indices), indices_.end());
    return plan_;
}

} // namespace octant::visuals::planning
