#include "visuals/gl/aircraft_painter.h"

#include "visuals/gl/shader_sources.h"
#include "visuals/gl/vertex_array.h"

#include <algorithm>
#include <cassert>

namespace octant::visuals::gl {
namespace {

using scene::AircraftDraw;
using scene::ModelVertex;

constexpr std::size_t first_capacity_bytes = std::size_t{1} << 12;
constexpr GLuint vertex_binding = 0;
constexpr GLuint instance_binding = 1;
constexpr GLuint parts_binding = 0; ///< place in the shaders

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
    , programs_(make_program_pair(gl, "aircraft", {aircraft_vert, flat_frag}))
    , model_vertices_(make_buffer(gl))
    , model_indices_(make_buffer(gl))
    , part_buffer_(gl, first_capacity_bytes)
    , instance_buffer_(gl, first_capacity_bytes)
    , command_buffer_(gl, first_capacity_bytes)
    , array_(make_array(gl, model_vertices_, model_indices_, instance_buffer_)) {}

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
    commands_.clear();
    first_parts_.clear();
    for (const AircraftDraw& draw : plan.aircraft) {
        assert(draw.model < models_.size());
        const ModelPlace& model = models_[draw.model];
        assert(std::size_t{draw.first_index} + draw.index_count <= model.index_count);
        assert(std::size_t{draw.first_part} + model.parts <= plan.parts.size());
        commands_.push_back(
            {.index_count = draw.index_count,
             .instance_count = 1,
             .first_index = static_cast<GLuint>(model.first_index) + draw.first_index,
             .first_vertex = model.first_vertex,
             .first_instance = static_cast<GLuint>(commands_.size())});
        first_parts_.push_back(draw.first_part);
    }
    part_buffer_.fill({std::as_bytes(std::span(plan.parts))});
    instance_buffer_.fill({std::as_bytes(std::span(first_parts_))});
    command_buffer_.fill({std::as_bytes(std::span(commands_))});
    gl_.bind_buffer_base(GL_SHADER_STORAGE_BUFFER, parts_binding, part_buffer_.name());
    gl_.bind_buffer(GL_DRAW_INDIRECT_BUFFER, command_buffer_.name());
}

void AircraftPainter::draw(
    std::uint32_t first, std::uint32_t count, Depth depth, const scene::Clip* clip) {
    assert(std::size_t{first} + count <= commands_.size());
    if (count == 0) {
        return;
    }
    state_.use_depth(depth);
    state_.cull_back_faces(true);
    state_.use_program(programs_, clip);
    gl_.bind_vertex_array(array_.name());
    gl_.multi_draw_elements_indirect(
        GL_TRIANGLES,
        GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(first * sizeof(Command)),
        static_cast<GLsizei>(count),
        sizeof(Command));
    state_.count_draw_call();
}

} // namespace octant::visuals::gl
