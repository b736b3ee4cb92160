#include "sim/links/datagram.h"

#include <fmt/format.h>

namespace octant::sim::links {

std::string_view name_of(Protocol protocol) {
    switch (protocol) {
    case Protocol::Fdm:
        return "FlightGear FDM";
    case Protocol::Lines:
        return "lines";
    case Protocol::MavLink:
        return "MAVLink";
    case Protocol::Dis:
        return "DIS";
    case Protocol::Cigi:
        return "CIGI";
    case Protocol::XPlane:
        return "X-Plane";
    }
    return "unknown";
}

std::string text_of(const PacketSource& source) {
    if (source == PacketSource{}) { return "standard input"; }
    const auto part = [&source](unsigned shift) { return source.address >> shift & 0xffU; };
    return fmt::format("{}.{}.{}.{}:{}", part(24), part(16), part(8), part(0), source.port);
}

} // namespace octant::sim::links
