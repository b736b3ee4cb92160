#include "sim/links/datagram.h"

#include <fmt/format.h>

namespace octant::sim::links {

std::string text_of(const Source& source) {
    if (source == Source{}) {
        return "standard input";
    }
    const auto part = [&source](unsigned shift) { return source.address >> shift & 0xffU; };
    return fmt::format("{}.{}.{}.{}:{}", part(24), part(16), part(8), part(0), source.port);
}

} // namespace octant::sim::links
