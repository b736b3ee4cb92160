#include "visuals/verify/statement_check.h"

#include "visuals/verify/invalid_certificate.h"

#include <fmt/format.h>

namespace octant::visuals::verify {

namespace {

void check_row(
    const PairCheck& check,
    const PairRow& row,
    std::span<const std::uint32_t> earlier,
    ProvedPairs& proved_pairs,
    StatementCounts& counts) {
    std::uint64_t all = 0;
    for (const DeciderRun& run : row.runs) {
        all += run.count;
    }
    if (all != earlier.size()) {
        throw InvalidCertificate{
            row.line,
            fmt::format("expected pairs with {} earlier polygons, got {}", earlier.size(), all)};
    }
    std::size_t at = 0;
    for (const DeciderRun& run : row.runs) {
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const PolygonPair pair{earlier[at++], row.later};
            if (run.by == DeciderRun::By::Elsewhere) {
                continue;
            }
            run.by == DeciderRun::By::Earlier ? check.check_earlier(pair, row.line)
                                       : check.check_later(pair, row.line);
            proved_pairs.add(pair);
            ++counts.by_polygons;
        }
    }
}

} // namespace

void check_statements(
    const PairCheck& check,
    const Statements& claims,
    const RegionPlanes& region_planes,
    const EarlierOf& earlier_of,
    ProvedPairs& proved_pairs,
    StatementCounts& counts) {
    for (const PairRow& row : claims.rows) {
        const auto earlier = earlier_of(row.later);
        if (!earlier) {
            throw InvalidCertificate{
                row.line,
                fmt::format(
                    "expected pairs of a polygon that is painted over others there, got polygon {}",
                    row.later)};
        }
        check_row(check, row, *earlier, proved_pairs, counts);
    }
    for (const PairStatement& statement : claims.pairs) {
        check.check(statement, region_planes);
        proved_pairs.add(statement.pair);
        counts.by_sums += statement.kind == PairStatement::Kind::Sum ? 1 : 0;
        counts.never_both_visible += statement.kind == PairStatement::Kind::Never ? 1 : 0;
    }
}

} // namespace octant::visuals::verify
