#include "visuals/gl/aircraft_painter.h"

#include "visuals/gl/shader_sources.h"
#include "visuals/gl/vertex_array.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <tuple>

namespace octant::visuals::gl {
namespace {

using scene::AircraftDraw;
using scene::ModelVertex;

constexpr std::size_t first_capacity_bytes = std::size_t{1} << 12;
constexpr GLuint vertex_binding = 0;
constexpr GLuint instance_binding = 1;
constexpr GLuint parts_binding = 0; ///< place in the shaders

struct Command {
    GLuint count, instances, first_index;
    GLint base_vertex;
    GLuint base_instance;
};

Object make_array(
    const Functions& gl,
    const Object& vertices,
    const Object& indices,
    const StreamBuffer& instances) {
    Object array = make_vertex_array(gl);
    gl.vertex_array_vertex_buffer(
        array.name(), vertex_binding, vertices.name(), 0, sizeof(ModelVertex));
    gl.vertex_array_vertex_buffer(
        array.name(), instance_binding, instances.name(), 0, sizeof(std::uint32_t));
    gl.vertex_array_binding_divisor(array.name(), instance_binding, 1);
    gl.vertex_array_element_buffer(array.name(), indices.name());
    add_vector_input(gl, array, position_input, offsetof(ModelVertex, position_m));
    add_vector_input(gl, array, normal_input, offsetof(ModelVertex, normal));
    add_colour_input(gl, array, offsetof(ModelVertex, colour));
    add_number_input(gl, array, part_input, vertex_binding, offsetof(ModelVertex, part));
    add_number_input(gl, array, first_part_input, instance_binding, 0);
    return array;
}

} // namespace

AircraftPainter::AircraftPainter(const Functions& gl, DrawState& state)
    : gl_(gl)
    , state_(state)
    , programs_(make_program_pair(gl, "aircraft", aircraft_vert, flat_frag))
    , model_vertices_(make_buffer(gl))
    , model_indices_(make_buffer(gl))
    , parts_(gl, first_capacity_bytes)
    , instances_(gl, first_capacity_bytes)
    , commands_(gl, first_capacity_bytes)
    , array_(make_array(gl, model_vertices_, model_indices_, instances_)) {}

void AircraftPainter::load_models(std::span<const scene::ModelBuffers> models) {
    std::vector<ModelVertex> vertices;
    std::vector<std::uint32_t> indices;
    models_.clear();
    for (const scene::ModelBuffers& model : models) {
        std::size_t parts = 0;
        for (const ModelVertex& vertex : model.vertices) {
            parts = std::max(parts, std::size_t{vertex.part} + 1);
        }
        models_.push_back(
            {indices.size(), model.indices.size(), static_cast<GLint>(vertices.size()), parts});
        vertices.insert(vertices.end(), model.vertices.begin(), model.vertices.end());
        indices.insert(indices.end(), model.indices.begin(), model.indices.end());
    }
    gl_.named_buffer_data(
        model_vertices_.name(),
        static_cast<GLsizeiptr>(std::span(vertices).size_bytes()),
        vertices.data(),
        GL_STATIC_DRAW);
    gl_.named_buffer_data(
        model_indices_.name(),
        static_cast<GLsizeiptr>(std::span(indices).size_bytes()),
        indices.data(),
        GL_STATIC_DRAW);
}

void AircraftPainter::add_any(scene::FramePlan& plan) const {
    if (!models_.empty()) {
        const auto indices = static_cast<std::uint32_t>(models_.front().index_count);
        glm::mat4 body_to_eye_world(1.0F);
        body_to_eye_world[3].z = -100.0F;
        plan.parts.assign(models_.front().parts, body_to_eye_world);
        plan.aircraft.push_back({.model = 0, .first_index = 0, .index_count = indices});
    }
}

void AircraftPainter::upload(const scene::FramePlan& plan) {
    aircraft_ = plan.aircraft;
    for ([[maybe_unused]] const AircraftDraw& draw : aircraft_) {
        assert(draw.model < models_.size());
        [[maybe_unused]] const ModelPlace& model = models_[draw.model];
        assert(std::size_t{draw.first_index} + draw.index_count <= model.index_count);
        assert(std::size_t{draw.first_part} + model.parts <= plan.parts.size());
    }
    order_.resize(aircraft_.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
        order_[i] = i;
    }
    if (plan.hidden_surface == scene::HiddenSurface::DepthBuffer && !std::getenv("NOGROUP")) {
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            const auto key = [&](std::uint32_t i) {
                const AircraftDraw& d = aircraft_[i];
                return std::tuple(d.model, d.first_index, d.index_count, i);
            };
            return key(a) < key(b);
        });
    }
    first_parts_.clear();
    for (const std::uint32_t i : order_) {
        first_parts_.push_back(aircraft_[i].first_part);
    }
    parts_.fill({std::as_bytes(std::span(plan.parts))});
    instances_.fill({std::as_bytes(std::span(first_parts_))});
    gl_.bind_buffer_base(GL_SHADER_STORAGE_BUFFER, parts_binding, parts_.name());
}

void AircraftPainter::paint(std::uint32_t first, std::uint32_t count, const scene::Clip* clip) {
    assert(std::size_t{first} + count <= aircraft_.size());
    state_.use_program(programs_, clip);
    state_.use_depth(Depth::Unused);
    state_.cull_back_faces(true);
    gl_.bind_vertex_array(array_.name());
    draw_range(first, count, false);
}

void AircraftPainter::draw_by_depth(std::uint32_t first, std::uint32_t count) {
    state_.use_program(programs_);
    state_.use_depth(Depth::Nearest);
    state_.cull_back_faces(true);
    gl_.bind_vertex_array(array_.name());
    draw_range(first, count, true);
}

void AircraftPainter::draw_range(std::uint32_t first, std::uint32_t count, bool join) {
    static std::vector<Command> commands;
    commands.clear();
    join = join && !std::getenv("NOJOIN");
    for (std::uint32_t i = first; i < first + count; ++i) {
        const AircraftDraw& d = aircraft_[order_[i]];
        const ModelPlace& model = models_[d.model];
        const Command c{
            d.index_count,
            1,
            static_cast<GLuint>(model.first_index) + d.first_index,
            model.first_vertex,
            i};
        if (join && !commands.empty() && commands.back().first_index == c.first_index &&
            commands.back().count == c.count && commands.back().base_vertex == c.base_vertex) {
            ++commands.back().instances;
        } else {
            commands.push_back(c);
        }
    }
    if (std::getenv("MDI")) {
        commands_.fill({std::as_bytes(std::span(commands))});
        gl_.bind_buffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
        gl_.multi_draw_elements_indirect(
            GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(commands.size()), 0);
        state_.count_draw_call();
    } else {
        for (const Command& c : commands) {
            gl_.draw_elements_instanced(
                GL_TRIANGLES,
                static_cast<GLsizei>(c.count),
                GL_UNSIGNED_INT,
                reinterpret_cast<const void*>(std::size_t{c.first_index} * 4),
                static_cast<GLsizei>(c.instances),
                c.base_vertex,
                c.base_instance);
            state_.count_draw_call();
        }
    }
}

} // namespace octant::visuals::gl
