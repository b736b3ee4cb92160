#pragma once

#include "visuals/verify/certificate.h"
#include "visuals/verify/certificate_tokens.h"
#include "visuals/verify/region_plane_counts.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace octant::visuals::verify {

/// What a line claims.
enum class StatementKind { Pairs, Sum, Never, Away, Unproved };

/// Takes the first word of a line if it begins a claim.
std::optional<StatementKind> read_statement_kind(CertificateTokens& words);

/// Reads the claims of a certificate, whose structure is known: pairs, sum, never, away and
/// unproved.
class StatementReader {
public:
    /// What is read is put into `made`, whose nodes, lists and polygons are there.
    StatementReader(CertificateTokens& words, Certificate& made, RegionPlaneCounts region_planes)
        : words_(words)
        , made_(made)
        , walls_(std::move(region_planes)) {}

    /// Reads what follows the first word of a claim.
    void take(StatementKind kind);

private:
    Statements& current_statements();
    void read_factors(Statements& claims, PairStatement::Kind kind, std::uint32_t polygon);
    std::uint32_t polygon();
    double factor();
    void read_region_planes(StatedFactors& factors);
    void read_back_facing(Statements& claims, std::uint32_t polygon);
    void read_unproved(Statements& claims, std::uint32_t polygon);
    void read_row(Statements& claims, std::uint32_t later);
    DeciderRun run();

    CertificateTokens& words_;
    Certificate& made_;
    RegionPlaneCounts walls_;
    std::size_t current_region_plane_count_ = 0; ///< How many walls the region of the claim at hand has.
};

} // namespace octant::visuals::verify
