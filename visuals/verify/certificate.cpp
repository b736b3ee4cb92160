// Reads certificates of painting orders in the format of certificate-format.md. The lines of the model and its order
// (StructureReader) come before the statements (StatementReader).
#include "visuals/verify/certificate.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::visuals::verify {

namespace {

/// The most entries of any kind that a certificate may have.
constexpr std::size_t max_entries = 50'000'000;
/// The largest number that may stand in a certificate.
constexpr double largest_number = 1e12;

constexpr double min_normal = 0.5; // The largest part of a unit vector is 0.577 at least.
constexpr double longest_normal = 1.5;

/// Reads what stands in a certificate's lines, as certificate-format.md describes them.
class CertificateTokens : public TextScanner {
public:
    CertificateTokens(const std::filesystem::path& path, std::string_view text)
        : TextScanner(path, text, {.comment = '#'}) {}

    bool is_at_end_of_line() { return peek().empty(); }

    double number(std::string_view what, double min, double max) {
        const auto value = finite_number(peek());
        if (!value || *value < min || *value > max) {
            refuse_next(fmt::format("{} (a number from {:g} to {:g})", what, min, max));
        }
        word_or_end();
        return *value;
    }

    /// An integer from 0 to below `end`.
    std::uint32_t index(std::string_view what, std::size_t end) {
        const auto value = take_integer(0, static_cast<long>(end) - 1);
        if (!value) {
            refuse_next(end == 0 ? fmt::format("{}, of which there are none", what)
                                 : fmt::format("{} (0 to {})", what, end - 1));
        }
        return static_cast<std::uint32_t>(*value);
    }

    Vector vector(const char* what) {
        const double x = coordinate(what);
        const double y = coordinate(what);
        const double z = coordinate(what);
        return {x, y, z};
    }

    /// A vector of a length of about 1.
    Vector unit_vector(const char* what) {
        const Vector v = vector(what);
        const double longest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
        if (longest < min_normal || longest > longest_normal) { refuse_last(fmt::format("{} of length 1", what)); }
        return v;
    }

    WrittenPlane plane() {
        const Vector normal = unit_vector("a normal");
        return {normal, coordinate("an offset")};
    }

    /// Appends an entry and refuses the line if there are too many.
    template <typename Entry>
    void add(std::vector<Entry>& entries, Entry entry) {
        if (entries.size() >= max_entries) { refuse_next(fmt::format("at most {} such lines", max_entries)); }
        entries.push_back(std::move(entry));
    }

private:
    double coordinate(const char* what) { return number(what, -largest_number, largest_number); }
};

/// Reads the lines of a certificate about the model and its order: tolerance, vertex, axis, polygon, turning, list and
/// node.
class StructureReader {
public:
    StructureReader(CertificateTokens& words, Certificate& made) : words_(words), made_(made) {}

    /// Reads the line at hand if it is one of these; false if its first word is another.
    bool take() {
        return words_.skip("tolerance") ? read_tolerance()
               : words_.skip("about")   ? read_reference()
               : words_.skip("vertex")  ? read_vertex()
               : words_.skip("axis")    ? read_axis()
               : words_.skip("polygon") ? read_polygon(false)
               : words_.skip("turning") ? read_polygon(true)
               : words_.skip("list")    ? read_list()
                                        : words_.skip("node") && read_node();
    }

private:
    bool read_tolerance() {
        if (made_.tolerance > 0.0) { words_.refuse_next("one tolerance"); }
        made_.tolerance = words_.number("a tolerance", 1e-30, largest_number);
        return true;
    }

    /// The reference point changes nothing in the proof, so it is only checked.
    bool read_reference() {
        if (!made_.vertices.empty() || !made_.axes.empty()) { words_.refuse_next("'about' before all places"); }
        words_.vector("a coordinate");
        return true;
    }

    bool read_vertex() {
        words_.add(made_.vertices, words_.vector("a coordinate"));
        return true;
    }

    bool read_axis() {
        const Vector point = words_.vector("a coordinate");
        words_.add(made_.axes, {point, words_.unit_vector("a direction")});
        return true;
    }

    bool read_polygon(bool turning) {
        CertificatePolygon polygon;
        polygon.line = words_.line_number();
        if (turning) { polygon.axis = words_.index("an axis", made_.axes.size()); }
        polygon.source = words_.index("a polygon of the model's file", max_entries);
        polygon.plane = words_.plane();
        while (!words_.is_at_end_of_line() || polygon.corners.size() < 3) {
            polygon.corners.push_back(words_.index("a vertex", made_.vertices.size()));
        }
        words_.add(made_.polygons, std::move(polygon));
        return true;
    }

    bool read_list() {
        OrderList list;
        list.line = words_.line_number();
        std::vector<bool>& used = used_;
        used.resize(made_.polygons.size());
        while (!words_.is_at_end_of_line()) {
            const std::uint32_t polygon = words_.index("a polygon", made_.polygons.size());
            if (used[polygon]) { words_.refuse_last("each polygon once"); }
            used[polygon] = true;
            list.polygons.push_back(polygon);
        }
        for (const std::uint32_t polygon : list.polygons) { used[polygon] = false; }
        words_.add(made_.lists, std::move(list));
        return true;
    }

    bool read_node() {
        OrderNode node;
        node.line = words_.line_number();
        const bool sequence = words_.skip("sequence");
        const bool parting = !sequence && words_.skip("parting");
        if (!sequence && !parting && !words_.skip("choice")) { words_.refuse_next("choice, parting or sequence"); }
        node.kind = sequence  ? OrderNode::Kind::Sequence
                    : parting ? OrderNode::Kind::PolygonSplit
                              : OrderNode::Kind::ViewSplit;
        if (!sequence) { node.plane = words_.plane(); }
        const auto side = [&] {
            return sequence || parting        ? child(true, true)
                   : words_.skip("unclaimed") ? OrderNode::not_covered
                                              : child(false, true);
        };
        node.front = side();
        node.back = side();
        if (parting) {
            node.coplanar_front = child(true, false);
            node.coplanar_back = child(true, false);
        }
        words_.add(made_.nodes, std::move(node));
        return true;
    }

    /// A child; whether it is there is known only when all are read.
    int child(bool may_be_nothing, bool may_be_node) {
        if (may_be_nothing && words_.skip("nothing")) { return OrderNode::no_child; }
        if (words_.skip("list")) { return ~static_cast<int>(words_.index("a list", max_entries)); }
        if (!may_be_node || !words_.skip("node")) {
            words_.refuse_next(
                fmt::format("{}list K{}", may_be_node ? "node K, " : "", may_be_nothing ? ", nothing" : ""));
        }
        const std::uint32_t number = words_.index("a node", max_entries);
        if (number <= made_.nodes.size()) { words_.refuse_last("a later node"); }
        return static_cast<int>(number);
    }

    CertificateTokens& words_;
    Certificate& made_;
    std::vector<bool> used_; ///< One flag for each polygon; all are false between lines.
};

/// The number of region planes of each node and list of a certificate: one for each view split above it.
struct RegionPlaneCounts {
    std::vector<std::size_t> by_node;
    std::vector<std::size_t> by_list;
};

constexpr std::size_t unseen = std::numeric_limits<std::size_t>::max();

void require_some(const Certificate& certificate, bool some, const char* what) {
    if (!some) { throw_error_in(certificate.path, fmt::format("expected {}, got none", what)); }
}

class RegionPlaneCounter {
public:
    explicit RegionPlaneCounter(const Certificate& certificate)
        : certificate_(certificate), counts_{std::vector<std::size_t>(certificate.nodes.size(), unseen),
                                         std::vector<std::size_t>(certificate.lists.size(), unseen)} {}

    RegionPlaneCounts count() {
        (counts_.by_node.empty() ? counts_.by_list : counts_.by_node).front() = 0;
        for (std::size_t i = 0; i < certificate_.nodes.size(); ++i) {
            const OrderNode& node = certificate_.nodes[i];
            require_reached(counts_.by_node[i], "node", i, node.line);
            const std::size_t more = node.kind == OrderNode::Kind::ViewSplit ? 1 : 0;
            for (const int child : {node.front, node.back, node.coplanar_front, node.coplanar_back}) {
                reach(child, counts_.by_node[i] + more, node.line);
            }
        }
        for (std::size_t i = 0; i < certificate_.lists.size(); ++i) {
            require_reached(counts_.by_list[i], "list", i, certificate_.lists[i].line);
        }
        return counts_;
    }

private:
    void require_reached(std::size_t region_planes, const char* what, std::size_t number, int line) const {
        if (region_planes == unseen) {
            throw_error_at(certificate_.path, line,
                fmt::format("expected {} {} to be the child of an earlier node, got none", what, number));
        }
    }

    void reach(int child, std::size_t region_planes, int line) {
        if (OrderNode::is_empty(child)) { return; }
        auto& all = child < 0 ? counts_.by_list : counts_.by_node;
        const auto number = static_cast<std::size_t>(child < 0 ? ~child : child);
        if (number >= all.size() || all[number] != unseen) {
            throw_error_at(certificate_.path, line,
                fmt::format("expected children that are there, each of one node, got {} {}",
                    child < 0 ? "list" : "node", number));
        }
        all[number] = region_planes;
    }

    const Certificate& certificate_;
    RegionPlaneCounts counts_;
};

/// Counts the region planes down from the first node, or for the only list where there is no node. Throws Error unless
/// nodes and lists are one tree and the certificate has a tolerance and polygons.
RegionPlaneCounts count_region_planes(const Certificate& certificate) {
    require_some(certificate, certificate.tolerance > 0.0, "a tolerance");
    require_some(certificate, !certificate.polygons.empty(), "at least one polygon");
    require_some(certificate, !certificate.lists.empty(), "at least one list");
    return RegionPlaneCounter(certificate).count();
}

/// The kind of a statement.
enum class StatementKind { Pairs, Sum, Never, Away, Unproved };

/// Reads the statements of a certificate, whose structure is known: pairs, sum, never, away and unproved.
class StatementReader {
public:
    /// What is read is put into `made`, whose nodes, lists and polygons are there.
    StatementReader(CertificateTokens& words, Certificate& made, RegionPlaneCounts region_planes)
        : words_(words), made_(made), region_plane_counts_(std::move(region_planes)) {}

    /// Reads what follows the first word of a statement.
    void take(StatementKind kind) {
        Statements& statements = current_statements();
        const std::uint32_t polygon = this->polygon();
        switch (kind) {
        case StatementKind::Pairs:
            return read_row(statements, polygon);
        case StatementKind::Sum:
            return read_factors(statements, PairStatement::Kind::Sum, polygon);
        case StatementKind::Never:
            return read_factors(statements, PairStatement::Kind::Never, polygon);
        case StatementKind::Away:
            return read_back_facing(statements, polygon);
        case StatementKind::Unproved:
            return read_unproved(statements, polygon);
        }
    }

private:
    /// The statements of the list or node that the line names next.
    Statements& current_statements() {
        const bool of_list = words_.skip("list");
        if (!of_list && !words_.skip("node")) { words_.refuse_next("list or node"); }
        const std::uint32_t number =
            of_list ? words_.index("a list", made_.lists.size()) : words_.index("a node", made_.nodes.size());
        current_region_plane_count_ =
            of_list ? region_plane_counts_.by_list[number] : region_plane_counts_.by_node[number];
        return of_list ? made_.by_list[number] : made_.by_node[number];
    }

    void read_factors(Statements& statements, PairStatement::Kind kind, std::uint32_t polygon) {
        PairStatement statement;
        statement.kind = kind;
        statement.pair = {polygon, this->polygon()};
        statement.line = words_.line_number();
        statement.factors.earlier = factor();
        statement.factors.later = factor();
        read_region_planes(statement.factors);
        words_.add(statements.pairs, std::move(statement));
    }

    std::uint32_t polygon() { return words_.index("a polygon", made_.polygons.size()); }

    double factor() { return words_.number("a factor", 0.0, largest_number); }

    /// The factor of 1 and those of the region planes.
    void read_region_planes(StatedFactors& factors) {
        factors.one = factor();
        for (std::size_t i = 0; i < current_region_plane_count_; ++i) { factors.region_planes.push_back(factor()); }
    }

    void read_back_facing(Statements& statements, std::uint32_t polygon) {
        BackFacingStatement statement;
        statement.line = words_.line_number();
        statement.factors.earlier = 1.0;
        read_region_planes(statement.factors);
        if (!statements.away.emplace(polygon, std::move(statement)).second) { words_.refuse_last("each polygon once"); }
    }

    /// A polygon or a pair without a proof.
    void read_unproved(Statements& statements, std::uint32_t polygon) {
        ++made_.unproved;
        made_.first_unproved = made_.first_unproved.value_or(words_.line_number());
        if (words_.is_at_end_of_line()) {
            statements.unproved.emplace(polygon, words_.line_number());
        } else {
            words_.add(statements.pairs,
                {PairStatement::Kind::Unproved, {polygon, this->polygon()}, {}, words_.line_number()});
        }
    }

    void read_row(Statements& statements, std::uint32_t later) {
        PairRow row;
        row.later = later;
        row.line = words_.line_number();
        while (!words_.is_at_end_of_line()) { row.runs.push_back(run()); }
        words_.add(statements.rows, std::move(row));
    }

    /// Reads a count and a letter.
    DeciderRun run() {
        const std::string_view word = words_.word("a run of pairs");
        const auto count = whole_number(word.substr(0, word.size() - 1));
        const char letter = word.back();
        const bool known = letter == 'e' || letter == 'l' || letter == '-';
        if (!known || !count || *count < 1 || static_cast<std::size_t>(*count) > max_entries) {
            words_.refuse_last("a count with e, l or -");
        }
        return {letter == 'e'   ? DeciderRun::By::Earlier
                : letter == 'l' ? DeciderRun::By::Later
                                : DeciderRun::By::Elsewhere,
            static_cast<std::uint32_t>(*count)};
    }

    CertificateTokens& words_;
    Certificate& made_;
    RegionPlaneCounts region_plane_counts_;
    std::size_t current_region_plane_count_ = 0; ///< How many region planes the region of the current statement has.
};

/// Takes the first word of a line if it begins a statement.
std::optional<StatementKind> read_statement_kind(CertificateTokens& words) {
    using Word = std::pair<std::string_view, StatementKind>;
    for (const auto& [word, kind] :
        {Word("pairs", StatementKind::Pairs), Word("sum", StatementKind::Sum), Word("never", StatementKind::Never),
            Word("away", StatementKind::Away), Word("unproved", StatementKind::Unproved)}) {
        if (words.skip(word)) { return kind; }
    }
    return std::nullopt;
}

constexpr std::size_t largest_bytes = std::size_t{2} << 30;

class CertificateParser {
public:
    CertificateParser(const std::filesystem::path& path, std::string_view text) : words_(path, text) {
        made_.path = path;
    }

    Certificate read() {
        while (words_.next_line()) {
            if (!words_.is_at_end_of_line()) { take(); }
        }
        if (!has_header_) { throw_error_in(made_.path, "expected 'octant-certificate 1' first, got an empty file"); }
        finish_structure();
        return std::move(made_);
    }

private:
    void take() {
        if (!has_header_) {
            if (!words_.skip("octant-certificate") || !words_.skip("1")) {
                words_.refuse_next("'octant-certificate 1' first");
            }
            has_header_ = true;
        } else if (const auto statement = read_statement_kind(words_)) {
            finish_structure();
            statements_->take(*statement);
        } else {
            take_structure();
        }
        if (!words_.is_at_end_of_line()) { words_.refuse_next("the end of the line"); }
    }

    void take_structure() {
        if (!structure_.take()) {
            words_.refuse_next("tolerance, about, vertex, axis, polygon, turning, list, node, pairs, "
                               "sum, never, away or unproved");
        }
        if (statements_) {
            throw_error_at(made_.path, words_.line_number(),
                "expected pairs, sum, never, away or unproved after the first of them, got "
                "something else");
        }
    }

    /// Called once all nodes and lists are read: requires that they are one tree, so that statements may follow.
    void finish_structure() {
        if (!statements_) {
            statements_.emplace(words_, made_, count_region_planes(made_));
            made_.by_node.resize(made_.nodes.size());
            made_.by_list.resize(made_.lists.size());
        }
    }

    CertificateTokens words_;
    Certificate made_;
    StructureReader structure_{words_, made_};
    std::optional<StatementReader> statements_; ///< Nothing until the structure is read.
    bool has_header_ = false;
};

} // namespace

Certificate read_certificate(const std::filesystem::path& path) {
    return certificate_of(read_text_file(path, largest_bytes), path);
}

Certificate certificate_of(std::string_view text, const std::filesystem::path& name) {
    return CertificateParser(name, text).read();
}

} // namespace octant::visuals::verify
