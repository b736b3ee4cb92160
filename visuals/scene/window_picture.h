#pragma once

#include <glm/vec2.hpp>

#include <cstdint>

namespace octant::visuals::scene {

/// Memory that a window shows: whoever makes a picture writes it there, and nothing is copied.
class WindowPicture {
public:
    virtual ~WindowPicture() = default;
    WindowPicture(const WindowPicture&) = delete;
    WindowPicture& operator=(const WindowPicture&) = delete;
    WindowPicture(WindowPicture&&) = delete;
    WindowPicture& operator=(WindowPicture&&) = delete;

    /// Room for the next picture, valid until the next call: blue, green, red and a byte that means nothing for each
    /// pixel, rows from the top, no gaps, from a line of the caches on. Waits until the window has done with the last
    /// one.
    virtual std::uint8_t* begin(const glm::ivec2& size_px) = 0;

    /// Puts it into the lower left corner of the window, stretched to `window_px`, upright there.
    virtual void show(const glm::ivec2& window_px) = 0;

protected:
    WindowPicture() = default;
};

} // namespace octant::visuals::scene
