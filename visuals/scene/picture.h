#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace octant::visuals::scene {

/// Allocates memory aligned to a cache line, so that non-temporal stores write whole lines.
template <class Value>
struct CacheLineAllocator {
    using value_type = Value;
    static constexpr std::align_val_t line{64};

    CacheLineAllocator() = default;

    template <class Other>
    explicit CacheLineAllocator(const CacheLineAllocator<Other>& /*other*/) {}

    Value* allocate(std::size_t count) { return static_cast<Value*>(::operator new(count * sizeof(Value), line)); }

    void deallocate(Value* at, std::size_t /*count*/) { ::operator delete(at, line); }

    bool operator==(const CacheLineAllocator&) const = default;
};

using PictureBytes = std::vector<std::uint8_t, CacheLineAllocator<std::uint8_t>>;

/// A picture in memory: display values.
struct Picture {
    int width = 0;
    int height = 0;
    /// Four bytes a pixel, rows from the top, without gaps.
    PictureBytes rgba;
};

/// A part of a picture, pixels from its upper left corner.
struct PixelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// Memory of a window into which a renderer writes a picture, so that nothing is copied.
class WindowPicture {
public:
    virtual ~WindowPicture() = default;
    WindowPicture(const WindowPicture&) = delete;
    WindowPicture& operator=(const WindowPicture&) = delete;
    WindowPicture(WindowPicture&&) = delete;
    WindowPicture& operator=(WindowPicture&&) = delete;

    /// The memory of the next picture, valid until the next call: four bytes a pixel (blue, green, red, one without
    /// meaning), rows from the top without gaps, aligned to a cache line. Waits until the window no longer reads the
    /// last picture.
    virtual std::uint8_t* begin(const glm::ivec2& size_px) = 0;

    /// Shows the picture of the last begin() in the lower left corner of the window, upright and stretched to
    /// `window_px`.
    virtual void show(const glm::ivec2& window_px) = 0;

protected:
    WindowPicture() = default;
};

} // namespace octant::visuals::scene
