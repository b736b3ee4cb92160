#pragma once

#include "visuals/verify/certificate.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::verify {

/// The polygons below each node of a tree.
class TreeContents {
public:
    explicit TreeContents(const Certificate& certificate);

    /// The polygons that are painted for some eye in a child, ascending.
    std::vector<std::uint32_t> of(int child) const;

private:
    /// A range of entries_.
    struct Range {
        std::size_t first = 0;
        std::size_t end = 0;
    };

    std::vector<std::uint32_t> entries_; ///< All lists, those of each node side by side.
    std::vector<Range> by_node_;
    std::vector<Range> by_list_;
};

} // namespace octant::visuals::verify
