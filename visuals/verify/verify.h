#pragma once

#include "visuals/verify/certificate.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace octant::visuals::verify {

/// The numbers of checked statements about pairs, by kind.
struct StatementCounts {
    std::uint64_t by_polygons = 0;        ///< The plane of one polygon of the pair decides.
    std::uint64_t by_sums = 0;            ///< A sum of planes decides.
    std::uint64_t never_both_visible = 0; ///< No eye sees both.
};

/// A statement that is false, or missing where one is needed. The first one is thrown.
struct InvalidCertificate {
    int line = 0;
    std::string what; ///< "expected ..., got ..."
};

/// What a certificate proves.
struct VerificationResult {
    std::optional<InvalidCertificate> failure; ///< The first false statement; the counts below end there.
    std::uint64_t pairs = 0;                   ///< Polygons that some eyes paint one before the other.
    std::uint64_t by_node_planes = 0;          ///< Of these, decided by a plane that parts many from many.
    StatementCounts statements;
    std::uint64_t unlisted = 0;        ///< Polygons that face away from all eyes of a list or node.
    std::uint64_t unproved = 0;        ///< Claims that the file itself says are not proved.
    std::optional<int> first_unproved; ///< The line of the first of them.
    bool covers_every_eye = true;      ///< No view split leaves the eyes on one side without statements.
    double tolerance_sizes = 0.0;      ///< The tolerance, in longest sides of the model's bounding box.

    bool proved() const { return !failure && unproved == 0; }
};

/// Proves without rounding that a painting order is right for every eye (certificate-format.md says what that means),
/// or returns the first false statement. Reads the statements from `reader`, from which none was read before.
/// `progress(done, all)` counts nodes and lists.
///
/// Throws Error for a tolerance of more than 1e-6 of the model's size, which would prove nothing, and for statements
/// that are no certificate.
VerificationResult verify(CertificateReader reader, const std::function<void(std::size_t, std::size_t)>& progress = {});

} // namespace octant::visuals::verify
