#pragma once

#include "visuals/verify/certificate.h"
#include "visuals/verify/token_reader.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace octant::visuals::verify {

/// The most entries of any kind that a certificate may have.
constexpr std::size_t max_entries = 50'000'000;
/// The largest number that may stand in a certificate.
constexpr double largest_number = 1e12;

/// The words of a certificate's lines, read as what its README.md has. What is wrong is refused as
/// TokenReader refuses it.
class CertificateTokens : public TokenReader {
public:
    using TokenReader::TokenReader;

    Vector vector(const char* what);
    /// A vector of a length of about 1.
    Vector unit_vector(const char* what);
    WrittenPlane plane();

    /// Appends an entry and refuses the line if there are too many.
    template <typename Entry>
    void add(std::vector<Entry>& entries, Entry entry) const {
        if (entries.size() >= max_entries) {
            fail_too_many();
        }
        entries.push_back(std::move(entry));
    }

private:
    double coordinate(const char* what);
    [[noreturn]] void fail_too_many() const;
};

} // namespace octant::visuals::verify
