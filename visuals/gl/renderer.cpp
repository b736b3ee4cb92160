#include "visuals/gl/renderer.h"

#include "sim/base/error.h"
#include "visuals/gl/program.h"
#include "visuals/gl/shader_sources.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <cassert>
#include <cstddef>
#include <fmt/format.h>

// The order of drawing. A plan is painted background, sky, ground, aircraft; wherever the ground
// writes depth, drawing the sky after it, only where the depth is still that of infinity, gives
// the same picture and spares the pixels under the ground. With HiddenSurface::DepthBuffer all
// goes front to back: aircraft from the nearest, ground, sky. A tie in depth between aircraft and
// ground then goes to the aircraft too.
namespace octant::visuals::gl {
namespace {

using models::ColourVertex;
using scene::FramePlan;
using scene::HiddenSurface;
using scene::ModelVertex;

// Places of the inputs and uniforms in visuals/gl/shaders/*.vert.
constexpr GLuint position_input = 0;
constexpr GLuint colour_input = 1;
constexpr GLuint normal_input = 2;
constexpr GLint to_clip = 0;
constexpr GLint haze_colour = 1;
constexpr GLint haze_per_m = 2;
constexpr GLint body_to_eye_world = 3;
constexpr GLint sun_in_body = 4;
constexpr GLint ambient = 5;
constexpr GLint sunlight = 6;

void add_input(const Functions& gl, GLuint array, GLuint input, GLint floats, std::size_t offset) {
    gl.enable_vertex_array_attrib(array, input);
    gl.vertex_array_attrib_format(
        array, input, floats, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array, input, 0);
}

void add_colour_input(const Functions& gl, GLuint array, std::size_t offset) {
    gl.enable_vertex_array_attrib(array, colour_input);
    gl.vertex_array_attrib_format(
        array, colour_input, 4, GL_UNSIGNED_BYTE, GL_TRUE, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array, colour_input, 0);
}

Object
make_stream_array(const Functions& gl, const StreamBuffer& vertices, const StreamBuffer& indices) {
    Object array = make_vertex_array(gl);
    gl.vertex_array_vertex_buffer(array.name(), 0, vertices.name(), 0, sizeof(ColourVertex));
    gl.vertex_array_element_buffer(array.name(), indices.name());
    add_input(gl, array.name(), position_input, 3, offsetof(ColourVertex, position_m));
    add_colour_input(gl, array.name(), offsetof(ColourVertex, colour));
    return array;
}

Object make_model_array(const Functions& gl, const Object& vertices, const Object& indices) {
    Object array = make_vertex_array(gl);
    gl.vertex_array_vertex_buffer(array.name(), 0, vertices.name(), 0, sizeof(ModelVertex));
    gl.vertex_array_element_buffer(array.name(), indices.name());
    add_input(gl, array.name(), position_input, 3, offsetof(ModelVertex, position_m));
    add_input(gl, array.name(), normal_input, 3, offsetof(ModelVertex, normal));
    add_colour_input(gl, array.name(), offsetof(ModelVertex, colour));
    return array;
}

void set_matrix(const Functions& gl, const Object& program, GLint place, const glm::mat4& value) {
    gl.program_uniform_matrix_4fv(program.name(), place, 1, GL_FALSE, glm::value_ptr(value));
}

void set_vector(const Functions& gl, const Object& program, GLint place, const glm::vec3& value) {
    gl.program_uniform_3fv(program.name(), place, 1, glm::value_ptr(value));
}

void draw_range(const Functions& gl, std::size_t first, std::size_t count, GLint first_vertex) {
    gl.draw_elements_base_vertex(
        GL_TRIANGLES,
        static_cast<GLsizei>(count),
        GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(first * sizeof(std::uint32_t)),
        first_vertex);
}

} // namespace

Renderer::Renderer(const Functions& gl, int width, int height, int samples)
    : gl_(gl)
    , framebuffer_(gl, width, height, samples)
    , ground_program_(make_program(gl, "ground", ground_vert, smooth_frag))
    , sky_program_(make_program(gl, "sky", sky_vert, smooth_frag))
    , aircraft_program_(make_program(gl, "aircraft", aircraft_vert, flat_frag))
    , stream_vertices_(gl)
    , stream_indices_(gl)
    , model_vertices_(make_buffer(gl))
    , model_indices_(make_buffer(gl))
    , stream_array_(make_stream_array(gl, stream_vertices_, stream_indices_))
    , model_array_(make_model_array(gl, model_vertices_, model_indices_)) {}

void Renderer::load_models(std::span<const scene::ModelBuffers> models) {
    std::vector<ModelVertex> vertices;
    std::vector<std::uint32_t> indices;
    models_.clear();
    for (const scene::ModelBuffers& model : models) {
        models_.push_back(
            {indices.size(), model.indices.size(), static_cast<GLint>(vertices.size())});
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

void Renderer::warm_up() {
    const std::array<ColourVertex, 3> corners{
        ColourVertex{{-1.0F, -1.0F, -2.0F}, 0U},
        ColourVertex{{1.0F, -1.0F, -2.0F}, 0U},
        ColourVertex{{0.0F, 1.0F, -2.0F}, 0U}};
    const std::array<std::uint32_t, 3> triangle{0, 1, 2};
    FramePlan plan;
    plan.view_to_clip = glm::mat4(0.0F);
    plan.view_to_clip[0][0] = 1.0F;
    plan.view_to_clip[1][1] = 1.0F;
    plan.view_to_clip[2][3] = -1.0F;
    plan.view_to_clip[3][2] = 0.5F;
    plan.sky = {corners, triangle};
    plan.ground = {corners, triangle};
    if (!models_.empty()) {
        scene::AircraftDraw aircraft;
        aircraft.index_count = static_cast<std::uint32_t>(models_.front().index_count);
        aircraft.body_to_eye_world[3] = glm::vec4(0.0F, 0.0F, -100.0F, 1.0F);
        plan.aircraft.push_back(aircraft);
    }
    Picture picture;
    for (const HiddenSurface way :
         {HiddenSurface::Octant, HiddenSurface::DepthBuffer, HiddenSurface::BackFace}) {
        plan.hidden_surface = way;
        for (const bool ordered : {false, true}) {
            plan.ground_is_ordered = ordered;
            draw(plan);
            finish_and_read(picture);
        }
    }
}

void Renderer::prepare(const FramePlan& plan) {
    gl_.bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.viewport(0, 0, framebuffer_.width(), framebuffer_.height());
    // The upper left origin brings the rows out from the top. Which side of a triangle is its
    // front does not change with it: OpenGL turns the sign of the area along with the origin.
    gl_.clip_control(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    gl_.front_face(GL_CCW);
    gl_.cull_face(GL_BACK);
    gl_.provoking_vertex(GL_FIRST_VERTEX_CONVENTION);
    gl_.disable(GL_DITHER);
    gl_.depth_mask(GL_TRUE);
    const glm::vec4 background(plan.background, 1.0F);
    gl_.clear_named_framebufferfv(framebuffer_.name(), GL_COLOR, 0, glm::value_ptr(background));
    const float infinitely_far = 0.0F;
    gl_.clear_named_framebufferfv(framebuffer_.name(), GL_DEPTH, 0, &infinitely_far);
}

void Renderer::upload(const FramePlan& plan) {
    stream_vertices_.fill(std::as_bytes(plan.ground.vertices), std::as_bytes(plan.sky.vertices));
    stream_indices_.fill(std::as_bytes(plan.ground.indices), std::as_bytes(plan.sky.indices));
}

void Renderer::use_depth(Depth depth, GLenum nearer) {
    if (depth == Depth::Unused) {
        gl_.disable(GL_DEPTH_TEST);
        return;
    }
    gl_.enable(GL_DEPTH_TEST);
    gl_.depth_func(nearer);
    gl_.depth_mask(depth == Depth::Written ? GL_TRUE : GL_FALSE);
}

void Renderer::set_haze(const FramePlan& plan, const Object& program) {
    const float visibility_m = plan.haze.visibility_m;
    set_vector(gl_, program, haze_colour, plan.haze.colour);
    gl_.program_uniform_1f(
        program.name(), haze_per_m, visibility_m > 0.0F ? 1.0F / visibility_m : 0.0F);
}

void Renderer::draw_sky(const FramePlan& plan, Depth depth) {
    if (plan.sky.indices.empty()) {
        return;
    }
    use_depth(depth, GL_GEQUAL);
    gl_.disable(GL_CULL_FACE);
    set_matrix(gl_, sky_program_, to_clip, plan.view_to_clip * plan.world_to_view);
    gl_.use_program(sky_program_.name());
    gl_.bind_vertex_array(stream_array_.name());
    draw_range(
        gl_,
        plan.ground.indices.size(),
        plan.sky.indices.size(),
        static_cast<GLint>(plan.ground.vertices.size()));
}

void Renderer::draw_ground(const FramePlan& plan, Depth depth) {
    if (plan.ground.indices.empty()) {
        return;
    }
    use_depth(depth, GL_GREATER);
    gl_.disable(GL_CULL_FACE);
    set_matrix(gl_, ground_program_, to_clip, plan.view_to_clip * plan.world_to_view);
    set_haze(plan, ground_program_);
    gl_.use_program(ground_program_.name());
    gl_.bind_vertex_array(stream_array_.name());
    draw_range(gl_, 0, plan.ground.indices.size(), 0);
}

void Renderer::begin_aircraft(const FramePlan& plan, Depth depth) {
    use_depth(depth, GL_GREATER);
    gl_.enable(GL_CULL_FACE);
    set_haze(plan, aircraft_program_);
    set_vector(gl_, aircraft_program_, ambient, plan.ambient);
    set_vector(gl_, aircraft_program_, sunlight, plan.sunlight);
    gl_.use_program(aircraft_program_.name());
    gl_.bind_vertex_array(model_array_.name());
}

void Renderer::draw_aircraft(const scene::AircraftDraw& aircraft, const glm::mat4& world_to_clip) {
    assert(aircraft.model < models_.size());
    const ModelPlace& model = models_[aircraft.model];
    assert(std::size_t{aircraft.first_index} + aircraft.index_count <= model.index_count);
    set_matrix(gl_, aircraft_program_, to_clip, world_to_clip * aircraft.body_to_eye_world);
    set_matrix(gl_, aircraft_program_, body_to_eye_world, aircraft.body_to_eye_world);
    set_vector(gl_, aircraft_program_, sun_in_body, aircraft.sun_in_body);
    draw_range(
        gl_, model.first_index + aircraft.first_index, aircraft.index_count, model.first_vertex);
}

void Renderer::draw(const FramePlan& plan) {
    const glm::mat4 world_to_clip = plan.view_to_clip * plan.world_to_view;
    prepare(plan);
    upload(plan);
    if (plan.hidden_surface == HiddenSurface::DepthBuffer) {
        begin_aircraft(plan, Depth::Written);
        for (std::size_t i = plan.aircraft.size(); i-- > 0;) {
            draw_aircraft(plan.aircraft[i], world_to_clip);
        }
        draw_ground(plan, Depth::Written);
        draw_sky(plan, Depth::Tested);
        return;
    }
    if (plan.ground_is_ordered) {
        draw_sky(plan, Depth::Unused);
        draw_ground(plan, Depth::Unused);
    } else {
        draw_ground(plan, Depth::Written);
        draw_sky(plan, Depth::Tested);
    }
    begin_aircraft(plan, plan.ground_is_ordered ? Depth::Unused : Depth::Tested);
    for (const scene::AircraftDraw& aircraft : plan.aircraft) {
        draw_aircraft(aircraft, world_to_clip);
    }
}

void Renderer::finish() {
    gl_.finish();
    const GLenum fault = gl_.get_error();
    if (fault != GL_NO_ERROR) {
        throw Error(fmt::format("expected OpenGL to draw without error, got {:#06x}", fault));
    }
}

void Renderer::finish_and_read(Picture& picture) {
    finish();
    picture.width = framebuffer_.width();
    picture.height = framebuffer_.height();
    picture.rgba.resize(
        std::size_t{4} * static_cast<std::size_t>(picture.width) *
        static_cast<std::size_t>(picture.height));
    framebuffer_.read(picture.rgba);
}

} // namespace octant::visuals::gl
