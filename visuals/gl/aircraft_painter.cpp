#include "visuals/gl/aircraft_painter.h"

#include "visuals/gl/shader_sources.h"

#include <algorithm>
#include <cassert>
#include <map>

namespace octant::visuals::gl {

namespace {

using scene::AircraftDraw;
using scene::ModelVertex;

constexpr std::size_t first_capacity_bytes = std::size_t{1} << 12;

// Places in the shaders.
constexpr GLuint parts_binding = 0;
constexpr GLuint smooth_binding = 1;

/// The vertex array of scene::ModelVertex, one ModelInstance an instance.
Object make_model_array(const Functions& gl, GLuint vertices, GLuint indices, GLuint instances, const char* label) {
    using Kind = VertexInput::Kind;
    return make_vertex_array(gl, label, indices, {{vertices, sizeof(ModelVertex)}, {instances, sizeof(ModelInstance)}},
        {{position_input, Kind::Floats3, offsetof(ModelVertex, position_m)},
            {normal_input, Kind::Floats3, offsetof(ModelVertex, normal)},
            {colour_input, Kind::Colour, offsetof(ModelVertex, colour)},
            {face_colour_input, Kind::Colour, offsetof(ModelVertex, face_colour)},
            {part_input, Kind::Number, offsetof(ModelVertex, part)},
            {face_normal_input, Kind::Floats3, offsetof(ModelVertex, face_normal)},
            {polygon_input, Kind::Number, offsetof(ModelVertex, polygon)},
            {on_texture_input, Kind::Floats2, offsetof(ModelVertex, on_texture)},
            {texture_input, Kind::Number, offsetof(ModelVertex, texture)},
            {first_part_input, Kind::Number, offsetof(ModelInstance, first_part), true},
            {first_smooth_input, Kind::Number, offsetof(ModelInstance, first_smooth), true},
            {smooth_tint_input, Kind::Colour, offsetof(ModelInstance, smooth_tint), true},
            {flat_tint_input, Kind::Colour, offsetof(ModelInstance, flat_tint), true},
            {first_texture_input, Kind::Number, offsetof(ModelInstance, first_texture), true}});
}

constexpr GLuint table_binding = 2;
constexpr GLuint levels_binding = 3;
constexpr GLuint texels_binding = 4;
constexpr GLint opacity_uniform = 8;

/// As texture.glsl has them.
struct TextureEntry {
    std::uint32_t first_level = 0;
    std::uint32_t level_count = 0;
    std::uint32_t modes = 0;
    float threshold = 0.0F;
};

struct LevelEntry {
    std::uint32_t first_texel = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t unused = 0;
};

/// How many of the finest levels of each picture are left out so that the others fit in so many bytes: of the largest
/// pictures first.
std::map<const models::TexturePicture*, std::size_t> skipped_levels(
    std::span<const scene::ModelBuffers> models, std::size_t most_bytes) {
    std::map<const models::TexturePicture*, std::size_t> skipped;
    std::vector<const models::TexturePicture*> pictures; // in the order of the models, which does not depend on memory
    std::size_t bytes = 0;
    for (const scene::ModelBuffers& model : models) {
        for (const models::SurfaceTexture& texture : model.textures) {
            if (skipped.emplace(texture.picture.get(), 0).second) {
                pictures.push_back(texture.picture.get());
                bytes += texture.picture->bytes();
            }
        }
    }
    while (bytes > most_bytes) {
        const models::TexturePicture* largest = nullptr;
        std::size_t most = 0;
        for (const models::TexturePicture* picture : pictures) {
            const std::size_t own =
                skipped[picture] + 1 < picture->levels.size() ? picture->levels[skipped[picture]].rgba.size() : 0;
            if (own > most) {
                most = own;
                largest = picture;
            }
        }
        if (largest == nullptr) { break; }
        ++skipped[largest];
        bytes -= most;
    }
    return skipped;
}

} // namespace

TextureBuffers::TextureBuffers(const Functions& gl)
    : gl_(gl), table_(make_buffer(gl, "textures")), levels_(make_buffer(gl, "texture levels")),
      texels_(make_buffer(gl, "texels")) {}

void TextureBuffers::load(std::span<const scene::ModelBuffers> models) {
    GLint most_bytes = 0;
    gl_.get_integerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most_bytes);
    auto skipped = skipped_levels(models, static_cast<std::size_t>(std::max(most_bytes, 0)));
    std::vector<TextureEntry> table;
    std::vector<LevelEntry> levels;
    std::vector<std::uint8_t> texels;
    std::map<const models::TexturePicture*, TextureEntry> placed;
    firsts_.clear();
    for (const scene::ModelBuffers& model : models) {
        firsts_.push_back(static_cast<std::uint32_t>(table.size()));
        for (const models::SurfaceTexture& texture : model.textures) {
            const models::TexturePicture& picture = *texture.picture;
            const auto [at, is_new] = placed.try_emplace(&picture);
            if (is_new) {
                const auto kept = std::span(picture.levels).subspan(skipped[&picture]);
                at->second = {
                    static_cast<std::uint32_t>(levels.size()), static_cast<std::uint32_t>(kept.size()), 0, 0.0F};
                for (const models::TextureLevel& level : kept) {
                    levels.push_back({static_cast<std::uint32_t>(texels.size() / 4),
                        static_cast<std::uint32_t>(level.width), static_cast<std::uint32_t>(level.height), 0});
                    texels.insert(texels.end(), level.rgba.begin(), level.rgba.end());
                }
            }
            TextureEntry entry = at->second;
            entry.modes = static_cast<std::uint32_t>(texture.wrap_u) |
                          static_cast<std::uint32_t>(texture.wrap_v) << 2U |
                          static_cast<std::uint32_t>(texture.alpha) << 4U;
            entry.threshold = texture.threshold;
            table.push_back(entry);
        }
    }
    is_empty_ = table.empty();
    const auto fill = [&](const Object& buffer, std::span<const std::byte> bytes) {
        gl_.named_buffer_data(buffer.name(), static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    };
    fill(table_, std::as_bytes(std::span(table)));
    fill(levels_, std::as_bytes(std::span(levels)));
    fill(texels_, std::as_bytes(std::span(texels)));
}

void TextureBuffers::bind() const {
    gl_.bind_buffer_base(GL_SHADER_STORAGE_BUFFER, table_binding, table_.name());
    gl_.bind_buffer_base(GL_SHADER_STORAGE_BUFFER, levels_binding, levels_.name());
    gl_.bind_buffer_base(GL_SHADER_STORAGE_BUFFER, texels_binding, texels_.name());
}

AircraftPainter::AircraftPainter(const Functions& gl, DrawState& state)
    : gl_(gl), state_(state), programs_(make_program_pair(gl, "aircraft", {aircraft_vert, aircraft_frag})),
      textures_(gl), model_vertices_(make_buffer(gl, "model vertices")),
      model_indices_(make_buffer(gl, "model indices")), part_buffer_(gl, "parts of aircraft", first_capacity_bytes),
      smooth_buffer_(gl, "smooth polygons", first_capacity_bytes),
      instance_buffer_(gl, "aircraft instances", first_capacity_bytes),
      command_buffer_(gl, "aircraft draws", first_capacity_bytes),
      joined_index_buffer_(gl, "gathered model indices", first_capacity_bytes),
      array_(make_model_array(gl, model_vertices_.name(), model_indices_.name(), instance_buffer_.name(), "aircraft")),
      joined_array_(make_model_array(
          gl, model_vertices_.name(), joined_index_buffer_.name(), instance_buffer_.name(), "aircraft")) {}

void AircraftPainter::load_models(std::span<const scene::ModelBuffers> models) {
    std::vector<ModelVertex> vertices;
    indices_.clear();
    models_.clear();
    has_depth_drawn_meshes_ = false;
    for (const scene::ModelBuffers& model : models) {
        has_depth_drawn_meshes_ = has_depth_drawn_meshes_ || model.has_depth_drawn_meshes;
        std::size_t parts = 0;
        for (const ModelVertex& vertex : model.vertices) { parts = std::max(parts, std::size_t{vertex.part} + 1); }
        models_.push_back({indices_.size(), model.indices.size(), static_cast<GLint>(vertices.size()), parts});
        vertices.insert(vertices.end(), model.vertices.begin(), model.vertices.end());
        indices_.insert(indices_.end(), model.indices.begin(), model.indices.end());
    }
    const auto fill = [&](const Object& buffer, std::span<const std::byte> bytes) {
        gl_.named_buffer_data(buffer.name(), static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    };
    fill(model_vertices_, std::as_bytes(std::span(vertices)));
    fill(model_indices_, std::as_bytes(std::span(indices_)));
    textures_.load(models);
    phong_programs_.reset();
    textured_programs_.reset();
    if (!textures_.is_empty()) {
        textured_programs_ = make_program_pair(gl_, "aircraft", {aircraft_vert, aircraft_frag}, {"TEXTURED"});
    }
}

void AircraftPainter::add_one_of_each(scene::FramePlan& plan) const {
    if (!models_.empty()) {
        const auto indices = static_cast<std::uint32_t>(models_.front().index_count);
        glm::mat4 body_to_eye_world(1.0F);
        body_to_eye_world[3].z = -100.0F;
        plan.parts.assign(models_.front().parts, body_to_eye_world);
        plan.aircraft.push_back({.model = 0, .first_index = 0, .index_count = indices});
        plan.smooth.assign(models_.front().index_count / 3 / 32 + 1, 0U);
    }
}

void AircraftPainter::upload(const scene::FramePlan& plan) {
    lights_pixels_ = plan.lights_pixels;
    if (lights_pixels_ && !phong_programs_) {
        std::vector<const char*> defined{"PHONG"};
        if (!textures_.is_empty()) { defined.push_back("TEXTURED"); }
        phong_programs_ = make_program_pair(gl_, "aircraft", {aircraft_vert, aircraft_frag}, defined);
    }
    if (!textures_.is_empty()) { textures_.bind(); }
    commands_.clear();
    uses_joined_indices_.clear();
    joined_indices_.clear();
    instances_.clear();
    for (const AircraftDraw& draw : plan.aircraft) {
        assert(draw.model < models_.size());
        assert(draw.first_smooth < plan.smooth.size());
        const ModelRange& model = models_[draw.model];
        assert(std::size_t{draw.first_index} + draw.index_count <= model.index_count);
        assert(std::size_t{draw.first_part} + model.parts <= plan.parts.size());
        IndirectDraw command{.index_count = draw.index_count,
            .instance_count = 1,
            .first_index = static_cast<GLuint>(model.first_index) + draw.first_index,
            .first_vertex = model.first_vertex,
            .first_instance = static_cast<GLuint>(commands_.size())};
        if (!draw.ranges.empty()) { append_ranges(draw, command); }
        commands_.push_back(command);
        uses_joined_indices_.push_back(draw.ranges.empty() ? 0 : 1);
        instances_.push_back({draw.first_part, draw.first_smooth, draw.tints.smooth, draw.tints.flat,
            textures_.first_texture(draw.model)});
    }
    part_buffer_.fill({std::as_bytes(std::span(plan.parts))});
    smooth_buffer_.fill({std::as_bytes(std::span(plan.smooth))});
    instance_buffer_.fill({std::as_bytes(std::span(instances_))});
    command_buffer_.fill({std::as_bytes(std::span(commands_))});
    if (!joined_indices_.empty()) { joined_index_buffer_.fill({std::as_bytes(std::span(joined_indices_))}); }
    gl_.bind_buffer_base(GL_SHADER_STORAGE_BUFFER, parts_binding, part_buffer_.name());
    gl_.bind_buffer_base(GL_SHADER_STORAGE_BUFFER, smooth_binding, smooth_buffer_.name());
    gl_.bind_buffer(GL_DRAW_INDIRECT_BUFFER, command_buffer_.name());
}

void AircraftPainter::append_ranges(const AircraftDraw& draw, IndirectDraw& command) {
    const ModelRange& model = models_[draw.model];
    const std::size_t before = joined_indices_.size();
    for (const scene::IndexRange& range : draw.ranges) {
        assert(std::size_t{range.first_index} + range.index_count <= model.index_count);
        const auto from = std::span(indices_).subspan(model.first_index + range.first_index, range.index_count);
        joined_indices_.insert(joined_indices_.end(), from.begin(), from.end());
    }
    command.first_index = static_cast<GLuint>(before);
    command.index_count = static_cast<GLuint>(joined_indices_.size() - before);
}

void AircraftPainter::draw(const scene::PaintStep& step, const scene::Clip* clip) {
    assert(std::size_t{step.first} + step.count <= commands_.size());
    assert(step.depth != scene::DepthUse::DepthOnly);
    if (step.count == 0) { return; }
    state_.use_depth(step.depth);
    // Where nothing else tells what hides what, the shader leaves out back faces (aircraft.frag).
    state_.cull_back_faces(step.depth != scene::DepthUse::None);
    begin_step(step, clip);
    const std::size_t end = std::size_t{step.first} + step.count;
    for (std::size_t first = step.first; first < end;) {
        std::size_t next = first + 1;
        while (next < end && uses_joined_indices_[next] == uses_joined_indices_[first]) { ++next; }
        draw_commands(first, next - first);
        first = next;
    }
    end_step(step);
}

void AircraftPainter::begin_step(const scene::PaintStep& step, const scene::Clip* clip) {
    state_.use_program(programs(), clip);
    if (!textures_.is_empty()) {
        const Object& program = clip != nullptr ? programs().clipped : programs().unclipped;
        const glm::vec4 opacity(step.opacity, 0.0F, 0.0F, 0.0F);
        gl_.program_uniform_4fv(program.name(), opacity_uniform, 1, &opacity.x);
    }
    if (step.opacity < 1.0F) { state_.blend_by(step.opacity, !textures_.is_empty()); }
}

void AircraftPainter::end_step(const scene::PaintStep& step) {
    if (step.opacity < 1.0F) { state_.blend_by(1.0F); }
}

/// Draws by commands that all read the same index buffer.
void AircraftPainter::draw_commands(std::size_t first, std::size_t count) {
    gl_.bind_vertex_array((uses_joined_indices_[first] != 0 ? joined_array_ : array_).name());
    gl_.multi_draw_elements_indirect(GL_TRIANGLES, GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(first * sizeof(IndirectDraw)), static_cast<GLsizei>(count), sizeof(IndirectDraw));
    state_.count_draw_call();
}

RefinedPainter::RefinedPainter(const Functions& gl, DrawState& state)
    : gl_(gl), state_(state), vertices_(gl, "refined vertices", first_capacity_bytes),
      indices_(gl, "refined indices", first_capacity_bytes), instances_(gl, "refined instances", first_capacity_bytes),
      array_(make_model_array(gl, vertices_.name(), indices_.name(), instances_.name(), "refined aircraft")) {}

void RefinedPainter::upload(const scene::FramePlan& plan, const AircraftPainter& aircraft) {
    ranges_.clear();
    instance_values_.clear();
    if (plan.refined.empty()) { return; }
    pieces_.clear();
    std::size_t vertices = 0;
    std::size_t indices = 0;
    for (const scene::RefinedDraw& draw : plan.refined) {
        assert(draw.first_smooth < plan.smooth.size() && draw.first_part < plan.parts.size());
        ranges_.push_back({indices, draw.indices.size(), static_cast<GLint>(vertices)});
        instance_values_.push_back({draw.first_part, draw.first_smooth, draw.tints.smooth, draw.tints.flat,
            aircraft.has_textures() ? aircraft.first_texture(draw.model) : 0});
        vertices += draw.vertices.size();
        indices += draw.indices.size();
        pieces_.push_back(std::as_bytes(draw.vertices));
    }
    vertices_.fill(pieces_);
    pieces_.clear();
    for (const scene::RefinedDraw& draw : plan.refined) { pieces_.push_back(std::as_bytes(draw.indices)); }
    indices_.fill(pieces_);
    instances_.fill({std::as_bytes(std::span(instance_values_))});
}

void RefinedPainter::draw(const scene::PaintStep& step, const scene::Clip* clip, AircraftPainter& aircraft) {
    assert(std::size_t{step.first} + step.count <= ranges_.size());
    assert(step.depth != scene::DepthUse::DepthOnly);
    if (step.count == 0) { return; }
    state_.use_depth(step.depth);
    state_.cull_back_faces(true);
    aircraft.begin_step(step, clip);
    gl_.bind_vertex_array(array_.name());
    for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
        gl_.draw_elements_instanced(GL_TRIANGLES, static_cast<GLsizei>(ranges_[i].index_count), GL_UNSIGNED_INT,
            index_offset(ranges_[i].first_index), 1, ranges_[i].first_vertex, i);
        state_.count_draw_call();
    }
    aircraft.end_step(step);
}

} // namespace octant::visuals::gl
