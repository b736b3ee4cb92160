#pragma once

#include "sim/links/datagram.h"

#include <array>
#include <cstddef>

namespace octant::sim::links {

/// Lets so many packets a second through from each sender, by a bucket of tokens. Senders share buckets by chance, so
/// that no number of them takes more memory.
class SourceLimit {
public:
    static constexpr double packets_per_s = 25000.0;
    static constexpr double burst = 25000.0;

    SourceLimit() { buckets_.fill({burst, 0.0}); }

    /// Whether a packet that came at this time is let through.
    bool admits(const PacketSource& source, double arrival_s);

private:
    struct Bucket {
        double tokens = 0.0;
        double filled_s = 0.0;
    };

    std::array<Bucket, 1024> buckets_{};
};

} // namespace octant::sim::links
