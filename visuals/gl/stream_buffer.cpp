#include "visuals/gl/stream_buffer.h"

namespace octant::visuals::gl {

StreamBuffer::StreamBuffer(const Functions& gl, const char* label, std::size_t first_capacity_bytes)
    : gl_(gl), buffer_(make_buffer(gl, label)), capacity_bytes_(first_capacity_bytes) {}

void StreamBuffer::fill(std::span<const std::span<const std::byte>> pieces) {
    std::size_t size = 0;
    for (const auto& piece : pieces) { size += piece.size(); }
    while (capacity_bytes_ < size) { capacity_bytes_ *= 2; }
    gl_.named_buffer_data(name(), static_cast<GLsizeiptr>(capacity_bytes_), nullptr, GL_STREAM_DRAW);
    std::size_t at = 0;
    for (const auto& piece : pieces) {
        if (!piece.empty()) {
            gl_.named_buffer_sub_data(
                name(), static_cast<GLintptr>(at), static_cast<GLsizeiptr>(piece.size()), piece.data());
        }
        at += piece.size();
    }
}

} // namespace octant::visuals::gl
