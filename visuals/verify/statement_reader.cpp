#include "visuals/verify/statement_reader.h"

#include "sim/base/text_file.h"

#include <string_view>
#include <utility>

namespace octant::visuals::verify {

std::optional<StatementKind> read_statement_kind(CertificateTokens& words) {
    using Word = std::pair<std::string_view, StatementKind>;
    for (const auto& [word, kind] :
         {Word("pairs", StatementKind::Pairs),
          Word("sum", StatementKind::Sum),
          Word("never", StatementKind::Never),
          Word("away", StatementKind::Away),
          Word("unproved", StatementKind::Unproved)}) {
        if (words.skip(word)) {
            return kind;
        }
    }
    return std::nullopt;
}

void StatementReader::take(StatementKind kind) {
    Statements& claims = current_statements();
    const std::uint32_t polygon = this->polygon();
    switch (kind) {
    case StatementKind::Pairs:
        return read_row(claims, polygon);
    case StatementKind::Sum:
        return read_factors(claims, PairStatement::Kind::Sum, polygon);
    case StatementKind::Never:
        return read_factors(claims, PairStatement::Kind::Never, polygon);
    case StatementKind::Away:
        return read_back_facing(claims, polygon);
    case StatementKind::Unproved:
        return read_unproved(claims, polygon);
    }
}

/// The claims of the list or node that the line names next.
Statements& StatementReader::current_statements() {
    const bool of_list = words_.skip("list");
    if (!of_list && !words_.skip("node")) {
        words_.refuse("list or node");
    }
    const std::uint32_t number = of_list ? words_.index("a list", made_.lists.size())
                                         : words_.index("a node", made_.nodes.size());
    current_region_plane_count_ = of_list ? walls_.by_list[number] : walls_.by_node[number];
    return of_list ? made_.by_list[number] : made_.by_node[number];
}

std::uint32_t StatementReader::polygon() {
    return words_.index("a polygon", made_.polygons.size());
}

void StatementReader::read_factors(Statements& claims, PairStatement::Kind kind, std::uint32_t polygon) {
    PairStatement statement;
    statement.kind = kind;
    statement.pair = {polygon, this->polygon()};
    statement.line = words_.line();
    statement.factors.earlier = factor();
    statement.factors.later = factor();
    read_region_planes(statement.factors);
    words_.add(claims.pairs, std::move(statement));
}

double StatementReader::factor() {
    return words_.number("a factor", 0.0, largest_number);
}

/// The factor of 1 and those of the walls.
void StatementReader::read_region_planes(StatedFactors& factors) {
    factors.one = factor();
    for (std::size_t i = 0; i < current_region_plane_count_; ++i) {
        factors.region_planes.push_back(factor());
    }
}

void StatementReader::read_back_facing(Statements& claims, std::uint32_t polygon) {
    BackFacingStatement statement;
    statement.line = words_.line();
    statement.factors.earlier = 1.0;
    read_region_planes(statement.factors);
    if (!claims.away.emplace(polygon, std::move(statement)).second) {
        words_.fail_at_last("each polygon once");
    }
}

/// A polygon or a pair without a proof.
void StatementReader::read_unproved(Statements& claims, std::uint32_t polygon) {
    ++made_.unproved;
    made_.first_unproved = made_.first_unproved.value_or(words_.line());
    if (words_.done()) {
        claims.unproved.emplace(polygon, words_.line());
    } else {
        words_.add(
            claims.pairs,
            {PairStatement::Kind::Unproved, {polygon, this->polygon()}, {}, words_.line()});
    }
}

void StatementReader::read_row(Statements& claims, std::uint32_t later) {
    PairRow row;
    row.later = later;
    row.line = words_.line();
    while (!words_.done()) {
        row.runs.push_back(run());
    }
    words_.add(claims.rows, std::move(row));
}

/// Reads a count and a letter.
DeciderRun StatementReader::run() {
    const std::string_view word = words_.word("a run of pairs");
    const auto count = whole_number(word.substr(0, word.size() - 1));
    const char letter = word.back();
    const bool known = letter == 'e' || letter == 'l' || letter == '-';
    if (!known || !count || *count < 1 || static_cast<std::size_t>(*count) > max_entries) {
        words_.fail_at_last("a count with e, l or -");
    }
    return {
        letter == 'e'   ? DeciderRun::By::Earlier
        : letter == 'l' ? DeciderRun::By::Later
                        : DeciderRun::By::Elsewhere,
        static_cast<std::uint32_t>(*count)};
}

} // namespace octant::visuals::verify
