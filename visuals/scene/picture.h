#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace octant::visuals::scene {

/// Gives memory that begins where a line of the processor's caches does, so that whoever writes past the caches writes
/// whole lines.
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

} // namespace octant::visuals::scene
