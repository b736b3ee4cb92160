#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>

struct GLFWwindow;

namespace octant::visuals::gl {

/// A picture in memory that the program shares with the X server (MIT-SHM): it gets into a window by one copy, the
/// server's, without OpenGL.
class SharedPicture {
public:
    virtual ~SharedPicture() = default;
    SharedPicture(const SharedPicture&) = delete;
    SharedPicture& operator=(const SharedPicture&) = delete;
    SharedPicture(SharedPicture&&) = delete;
    SharedPicture& operator=(SharedPicture&&) = delete;

    /// Blue, green, red and a byte that means nothing for each pixel, rows from the top, no gaps.
    virtual std::uint8_t* pixels() = 0;

    /// Has the server copy it into the window's upper left corner; pixels() is not to be written to before wait().
    virtual void put() = 0;

    /// Returns when the server has done with it.
    virtual void wait() = 0;

protected:
    SharedPicture() = default;
};

/// Nothing where the window belongs to another system than X, its server runs elsewhere, or its pixels are not of that
/// kind.
std::unique_ptr<SharedPicture> make_shared_picture(GLFWwindow* window, const glm::ivec2& size_px);

} // namespace octant::visuals::gl
