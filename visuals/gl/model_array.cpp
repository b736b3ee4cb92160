#include "visuals/gl/model_array.h"

#include "visuals/gl/vertex_array.h"
#include "visuals/scene/frame_plan.h"

#include <cstddef>

namespace octant::visuals::gl {
namespace {

using scene::ModelVertex;

constexpr GLuint vertex_binding = 0;
constexpr GLuint instance_binding = 1;

} // namespace

Object make_model_array(
    const Functions& gl, GLuint vertices, GLuint indices, GLuint instances, const char* label) {
    Object array = make_vertex_array(gl, label);
    gl.vertex_array_vertex_buffer(array.name(), vertex_binding, vertices, 0, sizeof(ModelVertex));
    gl.vertex_array_vertex_buffer(
        array.name(), instance_binding, instances, 0, sizeof(ModelInstance));
    gl.vertex_array_binding_divisor(array.name(), instance_binding, 1);
    gl.vertex_array_element_buffer(array.name(), indices);
    add_vector_input(gl, array, position_input, offsetof(ModelVertex, position_m));
    add_vector_input(gl, array, normal_input, offsetof(ModelVertex, normal));
    add_colour_input(gl, array, offsetof(ModelVertex, colour));
    add_colour_input(gl, array, offsetof(ModelVertex, face_colour), face_colour_input);
    add_number_input(gl, array, part_input, vertex_binding, offsetof(ModelVertex, part));
    add_vector_input(gl, array, face_normal_input, offsetof(ModelVertex, face_normal));
    add_number_input(gl, array, polygon_input, vertex_binding, offsetof(ModelVertex, polygon));
    add_number_input(
        gl, array, first_part_input, instance_binding, offsetof(ModelInstance, first_part));
    add_number_input(
        gl, array, first_smooth_input, instance_binding, offsetof(ModelInstance, first_smooth));
    add_colour_input(
        gl, array, offsetof(ModelInstance, smooth_tint), smooth_tint_input, instance_binding);
    add_colour_input(
        gl, array, offsetof(ModelInstance, flat_tint), flat_tint_input, instance_binding);
    return array;
}

} // namespace octant::visuals::gl
