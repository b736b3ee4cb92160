#pragma once

#include "visuals/verify/certificate.h"
#include "visuals/verify/certificate_words.h"
#include "visuals/verify/wall_counts.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace octant::visuals::verify {

/// What a line claims.
enum class ClaimKind { Pairs, Sum, Never, Away, Unproved };

/// Takes the first word of a line if it begins a claim.
std::optional<ClaimKind> claim_begun(CertificateWords& words);

/// Reads the claims of a certificate, whose structure is known: pairs, sum, never, away and
/// unproved.
class ClaimReader {
public:
    /// What is read is put into `made`, whose nodes, lists and polygons are there.
    ClaimReader(CertificateWords& words, Certificate& made, WallCounts walls)
        : words_(words)
        , made_(made)
        , walls_(std::move(walls)) {}

    /// Reads what follows the first word of a claim.
    void take(ClaimKind kind);

private:
    Claims& claims_at_hand();
    void take_factors(Claims& claims, PairClaim::Kind kind, std::uint32_t polygon);
    std::uint32_t polygon();
    double factor();
    void take_walls(Factors& factors);
    void take_away(Claims& claims, std::uint32_t polygon);
    void take_unproved(Claims& claims, std::uint32_t polygon);
    void take_row(Claims& claims, std::uint32_t later);
    Run run();

    CertificateWords& words_;
    Certificate& made_;
    WallCounts walls_;
    std::size_t walls_at_hand_ = 0; ///< How many walls the region of the claim at hand has.
};

} // namespace octant::visuals::verify
