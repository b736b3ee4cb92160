#include "visuals/verify/claim_check.h"

#include "visuals/verify/refusal.h"

#include <fmt/format.h>

namespace octant::visuals::verify {

namespace {

void check_row(
    const PairCheck& check,
    const Row& row,
    std::span<const std::uint32_t> earlier,
    Facts& facts,
    ClaimCounts& counts) {
    std::uint64_t all = 0;
    for (const Run& run : row.runs) {
        all += run.count;
    }
    if (all != earlier.size()) {
        throw Refusal{
            row.line,
            fmt::format("expected pairs with {} earlier polygons, got {}", earlier.size(), all)};
    }
    std::size_t at = 0;
    for (const Run& run : row.runs) {
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const Pair pair{earlier[at++], row.later};
            if (run.by == Run::By::Elsewhere) {
                continue;
            }
            run.by == Run::By::Earlier ? check.check_earlier(pair, row.line)
                                       : check.check_later(pair, row.line);
            facts.add(pair);
            ++counts.by_polygons;
        }
    }
}

} // namespace

void check_claims(
    const PairCheck& check,
    const Claims& claims,
    const Walls& walls,
    const EarlierOf& earlier_of,
    Facts& facts,
    ClaimCounts& counts) {
    for (const Row& row : claims.rows) {
        const auto earlier = earlier_of(row.later);
        if (!earlier) {
            throw Refusal{
                row.line,
                fmt::format(
                    "expected pairs of a polygon that is painted over others there, got polygon {}",
                    row.later)};
        }
        check_row(check, row, *earlier, facts, counts);
    }
    for (const PairClaim& claim : claims.pairs) {
        check.check(claim, walls);
        facts.add(claim.pair);
        counts.by_sums += claim.kind == PairClaim::Kind::Sum ? 1 : 0;
        counts.never_seen += claim.kind == PairClaim::Kind::Never ? 1 : 0;
    }
}

} // namespace octant::visuals::verify
