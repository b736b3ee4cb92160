// Reads certificates of painting orders in the format of certificate-format.md. The lines of the model and its order
// (StructureReader) come before the statements (StatementReader).
#include "visuals/verify/certificate.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <algorithm>
#include <array>
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

constexpr TextRules certificate_rules{.comment = '#', .joins_lines = true};

} // namespace

/// Reads what stands in a certificate's lines, as certificate-format.md describes them.
class CertificateTokens : public TextScanner {
public:
    explicit CertificateTokens(const std::filesystem::path& path)
        : TextScanner(TextScanner::of_file(path, certificate_rules)) {}

    CertificateTokens(const std::filesystem::path& path, std::string_view text)
        : TextScanner(path, text, certificate_rules) {}

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
        return words_.skip("model")       ? read_model()
               : words_.skip("tolerance") ? read_tolerance()
               : words_.skip("about")     ? read_reference()
               : words_.skip("vertex")    ? read_vertex()
               : words_.skip("axis")      ? read_axis()
               : words_.skip("polygon")   ? read_polygon(false)
               : words_.skip("turning")   ? read_polygon(true)
               : words_.skip("list")      ? read_list()
                                          : words_.skip("node") && read_node();
    }

private:
    bool read_model() {
        if (!made_.model_hash.empty()) { words_.refuse_next("one model"); }
        made_.model_hash = std::string(words_.word("the hash of a model"));
        made_.model = std::string(words_.rest_of_line());
        return true;
    }

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

namespace {

constexpr std::size_t unseen = std::numeric_limits<std::size_t>::max();

/// `line`: where the lines of the model and its order end.
void require_some(const Certificate& certificate, int line, bool some, const char* what) {
    if (!some) { throw_error_at(certificate.path, line, fmt::format("expected {} before here, got none", what)); }
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
/// `line`: where they end.
RegionPlaneCounts count_region_planes(const Certificate& certificate, int line) {
    require_some(certificate, line, !certificate.model_hash.empty(), "a model");
    require_some(certificate, line, certificate.tolerance > 0.0, "a tolerance");
    require_some(certificate, line, !certificate.polygons.empty(), "at least one polygon");
    require_some(certificate, line, !certificate.lists.empty(), "at least one list");
    return RegionPlaneCounter(certificate).count();
}

/// The words that begin statements, and what they say.
constexpr std::array<std::pair<std::string_view, Statement::Kind>, 5> statement_words{
    {{"pairs", Statement::Kind::Pairs}, {"sum", Statement::Kind::Sum}, {"never", Statement::Kind::Never},
        {"away", Statement::Kind::Away}, {"unproved", Statement::Kind::UnprovedPair}}};

constexpr std::string_view expected_statement = "pairs, sum, never, away or unproved";

} // namespace

/// Reads statements: pairs, sum, never, away and unproved.
class StatementReader {
public:
    StatementReader(CertificateTokens& words, const Certificate& certificate)
        : words_(words), certificate_(certificate),
          region_plane_counts_(count_region_planes(certificate, words.line_number())) {}

    /// Reads what follows the first word of a statement; returns the node or list that it is about.
    int take(Statement::Kind kind, Statement& statement) {
        const int child = part();
        statement.kind = kind;
        statement.factors = {};
        statement.runs.clear();
        statement.line = words_.line_number();
        statement.pair = {};
        const std::uint32_t first = polygon();
        if (kind == Statement::Kind::Pairs) {
            statement.pair.later = first;
            while (!words_.is_at_end_of_line()) { statement.runs.push_back(run()); }
            return child;
        }
        statement.pair.earlier = first;
        if (kind == Statement::Kind::Away) {
            statement.factors.earlier = 1.0;
            read_region_planes(statement.factors);
        } else if (kind == Statement::Kind::UnprovedPair && words_.is_at_end_of_line()) {
            statement.kind = Statement::Kind::UnprovedPolygon;
        } else {
            statement.pair.later = polygon();
            if (kind == Statement::Kind::UnprovedPair) { return child; }
            statement.factors.earlier = factor();
            statement.factors.later = factor();
            read_region_planes(statement.factors);
        }
        return child;
    }

private:
    /// The list or node that the line names next.
    int part() {
        const bool of_list = words_.skip("list");
        if (!of_list && !words_.skip("node")) { words_.refuse_next("list or node"); }
        const std::uint32_t number = of_list ? words_.index("a list", certificate_.lists.size())
                                             : words_.index("a node", certificate_.nodes.size());
        region_planes_ = of_list ? region_plane_counts_.by_list[number] : region_plane_counts_.by_node[number];
        return of_list ? ~static_cast<int>(number) : static_cast<int>(number);
    }

    std::uint32_t polygon() { return words_.index("a polygon", certificate_.polygons.size()); }

    double factor() { return words_.number("a factor", 0.0, largest_number); }

    /// The factor of 1, and those of region planes as NUMBER:FACTOR.
    void read_region_planes(StatedFactors& factors) {
        factors.one = factor();
        while (!words_.is_at_end_of_line()) {
            const std::string_view word = words_.word("a region plane");
            const std::size_t colon = std::min(word.find(':'), word.size());
            const auto plane = whole_number(word.substr(0, colon));
            const auto value = finite_number(word.substr(std::min(colon + 1, word.size())));
            const long least =
                factors.region_planes.empty() ? 0 : static_cast<long>(factors.region_planes.back().plane) + 1;
            if (!plane || *plane < least || *plane >= static_cast<long>(region_planes_)) {
                words_.refuse_last(
                    fmt::format("a region plane, {} to below {}, and its factor", least, region_planes_));
            }
            if (!value || *value < 0.0 || *value > largest_number) { words_.refuse_last("a factor"); }
            factors.region_planes.push_back({static_cast<std::uint32_t>(*plane), *value});
        }
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
    const Certificate& certificate_;
    RegionPlaneCounts region_plane_counts_;
    std::size_t region_planes_ = 0; ///< of the part of the current statement
};

namespace {

constexpr std::string_view header = "octant-certificate";
constexpr std::string_view version = "2";

} // namespace

class CertificateReader::Parser {
public:
    Parser(CertificateTokens words, const std::filesystem::path& path) : words_(std::move(words)) {
        certificate_.path = path;
        read_header();
        while (read_structure_line()) {}
        statements_.emplace(words_, certificate_);
        if (kind_) { take_statement(); }
    }

    const Certificate& certificate() const { return certificate_; }

    const Statement* next_of(int child) {
        if (is_taken_) { read_statement(); }
        if (!part_ || *part_ != child) { return nullptr; }
        is_taken_ = true;
        return &statement_;
    }

    void require_end() {
        if (is_taken_) { read_statement(); }
        if (part_) {
            throw_error_at(certificate_.path, statement_.line,
                fmt::format("expected statements in the order of the tree, each node's before those of its children, "
                            "got one about {} {}",
                    *part_ < 0 ? "list" : "node", *part_ < 0 ? ~*part_ : *part_));
        }
    }

private:
    bool next_line() {
        while (words_.next_line()) {
            if (!words_.is_at_end_of_line()) { return true; }
        }
        return false;
    }

    void require_end_of_line() {
        if (!words_.is_at_end_of_line()) { words_.refuse_next("the end of the line"); }
    }

    void read_header() {
        const std::string expected = fmt::format("'{} {}' first", header, version);
        if (!next_line()) {
            throw_error_in(certificate_.path, fmt::format("expected {}, got an empty file", expected));
        }
        if (!words_.skip(header)) { words_.refuse_next(expected); }
        if (!words_.skip(version)) {
            words_.refuse_next(
                fmt::format("version {} of the format (octant draw-order --certificate writes it)", version));
        }
        require_end_of_line();
    }

    /// Takes the first word of a line if it begins a statement.
    std::optional<Statement::Kind> statement_word() {
        for (const auto& [word, kind] : statement_words) {
            if (words_.skip(word)) { return kind; }
        }
        return std::nullopt;
    }

    /// Reads a line of the structure; false, with kind_ set, at the first statement, and at the end.
    bool read_structure_line() {
        if (!next_line()) { return false; }
        kind_ = statement_word();
        if (kind_) { return false; }
        if (!structure_.take()) {
            words_.refuse_next(fmt::format(
                "model, tolerance, about, vertex, axis, polygon, turning, list, node, {}", expected_statement));
        }
        require_end_of_line();
        return true;
    }

    void read_statement() {
        is_taken_ = false;
        part_.reset();
        if (!next_line()) { return; }
        kind_ = statement_word();
        if (!kind_) { words_.refuse_next(fmt::format("{} after the first of them", expected_statement)); }
        take_statement();
    }

    void take_statement() {
        part_ = statements_->take(*kind_, statement_);
        require_end_of_line();
    }

    CertificateTokens words_;
    Certificate certificate_;
    StructureReader structure_{words_, certificate_};
    std::optional<StatementReader> statements_; ///< Nothing until the structure is read.
    std::optional<Statement::Kind> kind_;
    Statement statement_;
    std::optional<int> part_; ///< what statement_ is about; nothing at the end
    bool is_taken_ = false;   ///< statement_ was handed out
};

CertificateReader::CertificateReader(const std::filesystem::path& path)
    : parser_(std::make_unique<Parser>(CertificateTokens(path), path)) {}

CertificateReader::CertificateReader(std::string_view text, const std::filesystem::path& name)
    : parser_(std::make_unique<Parser>(CertificateTokens(name, text), name)) {}

CertificateReader::CertificateReader(CertificateReader&&) noexcept = default;
CertificateReader& CertificateReader::operator=(CertificateReader&&) noexcept = default;
CertificateReader::~CertificateReader() = default;

const Certificate& CertificateReader::certificate() const { return parser_->certificate(); }

const Statement* CertificateReader::next_of(int child) { return parser_->next_of(child); }

void CertificateReader::require_end() { parser_->require_end(); }

} // namespace octant::visuals::verify
