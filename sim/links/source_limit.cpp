#include "sim/links/source_limit.h"

#include <algorithm>
#include <cstdint>

namespace octant::sim::links {

bool SourceLimit::admits(const PacketSource& source, double arrival_s) {
    const std::uint64_t key = static_cast<std::uint64_t>(source.address) << 16U | source.port;
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U; // the golden ratio's bits: spreads keys
    constexpr unsigned to_index = 54;                  // the ten highest bits
    Bucket& bucket = buckets_[static_cast<std::size_t>(key * odd >> to_index)];
    const double passed_s = std::max(arrival_s - bucket.filled_s, 0.0);
    bucket.tokens = std::min(bucket.tokens + passed_s * packets_per_s, burst);
    bucket.filled_s = std::max(bucket.filled_s, arrival_s);
    if (bucket.tokens < 1.0) { return false; }
    bucket.tokens -= 1.0;
    return true;
}

} // namespace octant::sim::links
