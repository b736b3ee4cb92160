#include "visuals/gl/texture.h"

#include "sim/base/error.h"
#include "visuals/gl/context.h"
#include "visuals/scene/detail_pattern.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace octant::visuals::gl {
namespace {

// Along the line of sight. Where a processor draws, any but 1 makes a frame 3 to 5 times slower.
constexpr float max_anisotropy = 8.0F;

bool has_extension(const Functions& gl, std::string_view name) {
    GLint count = 0;
    gl.get_integerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* const found = gl.get_stringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (found != nullptr && name == reinterpret_cast<const char*>(found)) {
            return true;
        }
    }
    return false;
}

void set_filters(const Functions& gl, const Object& texture, GLenum beyond) {
    const auto set = [&](GLenum what, GLenum value) {
        gl.texture_parameteri(texture.name(), what, static_cast<GLint>(value));
    };
    set(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    set(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    set(GL_TEXTURE_WRAP_S, beyond);
    set(GL_TEXTURE_WRAP_T, beyond);
    if (!is_software_renderer(gl) && (has_extension(gl, "GL_EXT_texture_filter_anisotropic") ||
                                    has_extension(gl, "GL_ARB_texture_filter_anisotropic"))) {
        GLfloat most = 1.0F;
        gl.get_floatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &most);
        gl.texture_parameterf(
            texture.name(), GL_TEXTURE_MAX_ANISOTROPY, std::min(most, max_anisotropy));
    }
}

} // namespace

Object make_texture(const Functions& gl, const scene::GroundImage& image, TextureKind kind) {
    const bool colours = kind == TextureKind::Colours;
    Object texture = make_texture(gl, colours ? "ground colours" : "ground slopes");
    const auto longer_side = static_cast<unsigned>(std::max(image.width, image.height));
    gl.texture_storage_2d(
        texture.name(),
        static_cast<GLsizei>(std::bit_width(longer_side)),
        colours ? GL_RGB8 : GL_RG8,
        image.width,
        image.height);
    gl.pixel_storei(GL_UNPACK_ALIGNMENT, 1);
    gl.texture_sub_image_2d(
        texture.name(),
        0,
        0,
        0,
        image.width,
        image.height,
        colours ? GL_RGB : GL_RG,
        GL_UNSIGNED_BYTE,
        image.texels.data());
    gl.generate_texture_mipmap(texture.name());
    set_filters(gl, texture, GL_CLAMP_TO_EDGE);
    if (gl.get_error() != GL_NO_ERROR) {
        throw Error(fmt::format(
            "expected memory for a ground texture of {} x {} texels, got a refusal by the driver",
            image.width,
            image.height));
    }
    return texture;
}

Object make_detail_texture(const Functions& gl) {
    Object texture = make_texture(gl, "ground's fine pattern");
    const auto& levels = scene::detail_mip_levels();
    const auto side = static_cast<GLsizei>(levels.front().size);
    gl.texture_storage_2d(texture.name(), static_cast<GLsizei>(levels.size()), GL_R8, side, side);
    gl.pixel_storei(GL_UNPACK_ALIGNMENT, 1);
    GLint number = 0;
    for (const scene::DetailPattern& level : levels) {
        gl.texture_sub_image_2d(
            texture.name(),
            number++,
            0,
            0,
            level.size,
            level.size,
            GL_RED,
            GL_UNSIGNED_BYTE,
            level.texels.data());
    }
    set_filters(gl, texture, GL_REPEAT);
    return texture;
}

Object make_texture(const Functions& gl, const scene::LandCoverContrast& contrast) {
    Object texture = make_texture(gl, "contrast of ground's covers");
    // As the table has them, but from -1 on: one word is read for three shares.
    constexpr std::uint32_t signs = 0x80200800U;
    std::vector<std::uint32_t> shares;
    shares.reserve(contrast.table().size());
    for (const std::uint32_t entry : contrast.table()) {
        shares.push_back(entry ^ signs);
    }
    constexpr GLsizei width = scene::LandCoverContrast::pattern_step_count;
    constexpr GLsizei height = scene::LandCoverContrast::mixture_count;
    gl.texture_storage_2d(texture.name(), 1, GL_RGB10_A2, width, height);
    gl.texture_sub_image_2d(
        texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_INT_10_10_10_2, shares.data());
    return texture;
}

} // namespace octant::visuals::gl
