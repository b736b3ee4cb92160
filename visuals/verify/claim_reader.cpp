#include "visuals/verify/claim_reader.h"

#include "sim/base/text_file.h"

#include <string_view>
#include <utility>

namespace octant::visuals::verify {

std::optional<ClaimKind> claim_begun(CertificateWords& words) {
    using Word = std::pair<std::string_view, ClaimKind>;
    for (const auto& [word, kind] :
         {Word("pairs", ClaimKind::Pairs),
          Word("sum", ClaimKind::Sum),
          Word("never", ClaimKind::Never),
          Word("away", ClaimKind::Away),
          Word("unproved", ClaimKind::Unproved)}) {
        if (words.skip(word)) {
            return kind;
        }
    }
    return std::nullopt;
}

void ClaimReader::take(ClaimKind kind) {
    Claims& claims = claims_at_hand();
    const std::uint32_t polygon = this->polygon();
    switch (kind) {
    case ClaimKind::Pairs:
        return take_row(claims, polygon);
    case ClaimKind::Sum:
        return take_factors(claims, PairClaim::Kind::Sum, polygon);
    case ClaimKind::Never:
        return take_factors(claims, PairClaim::Kind::Never, polygon);
    case ClaimKind::Away:
        return take_away(claims, polygon);
    case ClaimKind::Unproved:
        return take_unproved(claims, polygon);
    }
}

/// The claims of the list or node that the line names next.
Claims& ClaimReader::claims_at_hand() {
    const bool of_list = words_.skip("list");
    if (!of_list && !words_.skip("node")) {
        words_.refuse("list or node");
    }
    const std::uint32_t number = of_list ? words_.index("a list", made_.lists.size())
                                         : words_.index("a node", made_.nodes.size());
    walls_at_hand_ = of_list ? walls_.of_lists[number] : walls_.of_nodes[number];
    return of_list ? made_.of_lists[number] : made_.of_nodes[number];
}

std::uint32_t ClaimReader::polygon() {
    return words_.index("a polygon", made_.polygons.size());
}

void ClaimReader::take_factors(Claims& claims, PairClaim::Kind kind, std::uint32_t polygon) {
    PairClaim claim;
    claim.kind = kind;
    claim.pair = {polygon, this->polygon()};
    claim.line = words_.line();
    claim.factors.earlier = factor();
    claim.factors.later = factor();
    take_walls(claim.factors);
    words_.add(claims.pairs, std::move(claim));
}

double ClaimReader::factor() {
    return words_.number("a factor", 0.0, largest_number);
}

/// The factor of 1 and those of the walls.
void ClaimReader::take_walls(Factors& factors) {
    factors.one = factor();
    for (std::size_t i = 0; i < walls_at_hand_; ++i) {
        factors.walls.push_back(factor());
    }
}

void ClaimReader::take_away(Claims& claims, std::uint32_t polygon) {
    AwayClaim claim;
    claim.line = words_.line();
    claim.factors.earlier = 1.0;
    take_walls(claim.factors);
    if (!claims.away.emplace(polygon, std::move(claim)).second) {
        words_.refuse_last("each polygon once");
    }
}

/// A polygon or a pair without a proof.
void ClaimReader::take_unproved(Claims& claims, std::uint32_t polygon) {
    ++made_.unproved;
    made_.first_unproved = made_.first_unproved.value_or(words_.line());
    if (words_.done()) {
        claims.unproved.emplace(polygon, words_.line());
    } else {
        words_.add(
            claims.pairs,
            {PairClaim::Kind::Unproved, {polygon, this->polygon()}, {}, words_.line()});
    }
}

void ClaimReader::take_row(Claims& claims, std::uint32_t later) {
    Row row;
    row.later = later;
    row.line = words_.line();
    while (!words_.done()) {
        row.runs.push_back(run());
    }
    words_.add(claims.rows, std::move(row));
}

/// Reads a count and a letter.
Run ClaimReader::run() {
    const std::string_view word = words_.word("a run of pairs");
    const auto count = whole_number(word.substr(0, word.size() - 1));
    const char letter = word.back();
    const bool known = letter == 'e' || letter == 'l' || letter == '-';
    if (!known || !count || *count < 1 || static_cast<std::size_t>(*count) > max_entries) {
        words_.refuse_last("a count with e, l or -");
    }
    return {
        letter == 'e'   ? Run::By::Earlier
        : letter == 'l' ? Run::By::Later
                        : Run::By::Elsewhere,
        static_cast<std::uint32_t>(*count)};
}

} // namespace octant::visuals::verify
