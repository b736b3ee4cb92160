#include "visuals/gl/stream_buffer.h"

namespace octant::visuals::gl {
namespace {

void put(const Functions& gl, GLuint buffer, std::size_t at, std::span<const std::byte> bytes) {
    if (!bytes.empty()) {
        gl.named_buffer_sub_data(
            buffer, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes.size()), bytes.data());
    }
}

} // namespace

StreamBuffer::StreamBuffer(const Functions& gl)
    : gl_(gl)
    , buffer_(make_buffer(gl))
    , capacity_bytes_(std::size_t{1} << 20) {}

void StreamBuffer::fill(std::span<const std::byte> first, std::span<const std::byte> second) {
    const std::size_t size = first.size() + second.size();
    while (capacity_bytes_ < size) {
        capacity_bytes_ *= 2;
    }
    gl_.named_buffer_data(
        name(), static_cast<GLsizeiptr>(capacity_bytes_), nullptr, GL_STREAM_DRAW);
    put(gl_, name(), 0, first);
    put(gl_, name(), first.size(), second);
}

} // namespace octant::visuals::gl
