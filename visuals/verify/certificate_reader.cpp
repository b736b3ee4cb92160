// Reads certificates of painting orders; README.md has their format.
#include "visuals/verify/certificate_reader.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "visuals/verify/wall_counts.h"
#include "visuals/verify/word_reader.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>

namespace octant::visuals::verify {

namespace {

constexpr double largest_number = 1e12;
constexpr std::size_t most_entries = 50'000'000; ///< Of any kind.
constexpr std::size_t largest_bytes = std::size_t{2} << 30;
constexpr double least_normal = 0.5; ///< The largest part of a unit vector is 0.577 at least.
constexpr double longest_normal = 1.5;

class Reading {
public:
    explicit Reading(const std::filesystem::path& path)
        : words_(path) {
        made_.path = path;
    }

    Certificate read(std::string_view text) {
        for (const std::string_view line : split_lines(text)) {
            if (words_.take_line(line)) {
                take();
            }
        }
        if (!has_header_) {
            error_in(made_.path, "expected 'octant-certificate 1' first, got an empty file");
        }
        finish_structure();
        return std::move(made_);
    }

private:
    void take() {
        if (!has_header_) {
            if (!words_.skip("octant-certificate") || !words_.skip("1")) {
                words_.refuse("'octant-certificate 1' first");
            }
            has_header_ = true;
        } else if (!take_claim() && !take_structure()) {
            words_.refuse(
                "tolerance, vertex, axis, polygon, turning, list, node, pairs, sum, never, away or "
                "unproved");
        }
        words_.end_of_line();
    }

    bool take_structure() {
        const bool known = words_.skip("tolerance") ? take_tolerance()
                           : words_.skip("vertex")  ? take_vertex()
                           : words_.skip("axis")    ? take_axis()
                           : words_.skip("polygon") ? take_polygon(false)
                           : words_.skip("turning") ? take_polygon(true)
                           : words_.skip("list")    ? take_list()
                                                    : words_.skip("node") && take_node();
        if (known && structure_is_done_) {
            error_at(
                made_.path,
                words_.line(),
                "expected pairs, sum, never, away or unproved after the first of them, got "
                "something else");
        }
        return known;
    }

    bool take_claim() {
        enum {
            Pairs,
            Sum,
            Never,
            Away,
            Unproved,
            Unknown
        } kind = words_.skip("pairs")      ? Pairs
                 : words_.skip("sum")      ? Sum
                 : words_.skip("never")    ? Never
                 : words_.skip("away")     ? Away
                 : words_.skip("unproved") ? Unproved
                                           : Unknown;

        if (kind == Unknown) {
            return false;
        }
        finish_structure();
        const bool of_list = words_.skip("list");
        if (!of_list && !words_.skip("node")) {
            words_.refuse("list or node");
        }
        const std::uint32_t number = of_list ? words_.index("a list", made_.lists.size())
                                             : words_.index("a node", made_.nodes.size());
        Claims& claims = of_list ? made_.of_lists[number] : made_.of_nodes[number];
        walls_at_hand_ = of_list ? walls_.of_lists[number] : walls_.of_nodes[number];
        const std::uint32_t polygon = this->polygon();
        if (kind == Pairs) {
            take_row(claims, polygon);
        } else if (kind == Away) {
            take_away(claims, polygon);
        } else if (kind == Unproved) {
            take_unproved(claims, polygon);
        } else {
            PairClaim claim;
            claim.kind = kind == Sum ? PairClaim::Kind::Sum : PairClaim::Kind::Never;
            claim.pair = {polygon, this->polygon()};
            claim.line = words_.line();
            claim.factors.earlier = factor();
            claim.factors.later = factor();
            take_walls(claim.factors);
            added(claims.pairs, std::move(claim));
        }
        return true;
    }

    std::uint32_t polygon() { return words_.index("a polygon", made_.polygons.size()); }

    double coordinate(const char* what) {
        return words_.number(what, -largest_number, largest_number);
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
        if (longest < least_normal || longest > longest_normal) {
            words_.refuse_last(fmt::format("{} of length 1", what));
        }
        return v;
    }

    WrittenPlane plane() {
        const Vector normal = unit_vector("a normal");
        return {normal, coordinate("an offset")};
    }

    bool take_tolerance() {
        if (made_.tolerance > 0.0) {
            words_.refuse("one tolerance");
        }
        made_.tolerance = words_.number("a tolerance", 1e-30, largest_number);
        return true;
    }

    template <typename Entry>
    Entry& added(std::vector<Entry>& entries, Entry entry) {
        if (entries.size() >= most_entries) {
            words_.refuse(fmt::format("at most {} such lines", most_entries));
        }
        entries.push_back(std::move(entry));
        return entries.back();
    }

    bool take_vertex() {
        added(made_.vertices, vector("a coordinate"));
        return true;
    }

    bool take_axis() {
        const Vector point = vector("a coordinate");
        added(made_.axes, {point, unit_vector("a direction")});
        return true;
    }

    bool take_polygon(bool turning) {
        Polygon polygon;
        polygon.line = words_.line();
        if (turning) {
            polygon.axis = words_.index("an axis", made_.axes.size());
        }
        polygon.source = words_.index("a polygon of the model's file", most_entries);
        polygon.plane = plane();
        while (!words_.done() || polygon.corners.size() < 3) {
            polygon.corners.push_back(words_.index("a vertex", made_.vertices.size()));
        }
        added(made_.polygons, std::move(polygon));
        return true;
    }

    bool take_list() {
        List list;
        list.line = words_.line();
        std::vector<bool>& used = used_;
        used.resize(made_.polygons.size());
        while (!words_.done()) {
            const std::uint32_t polygon = words_.index("a polygon", made_.polygons.size());
            if (used[polygon]) {
                words_.refuse_last("each polygon once");
            }
            used[polygon] = true;
            list.polygons.push_back(polygon);
        }
        for (const std::uint32_t polygon : list.polygons) {
            used[polygon] = false;
        }
        added(made_.lists, std::move(list));
        return true;
    }

    bool take_node() {
        Node node;
        node.line = words_.line();
        const bool sequence = words_.skip("sequence");
        const bool parting = !sequence && words_.skip("parting");
        if (!sequence && !parting && !words_.skip("choice")) {
            words_.refuse("choice, parting or sequence");
        }
        node.kind = sequence  ? Node::Kind::Sequence
                    : parting ? Node::Kind::Parting
                              : Node::Kind::Choice;
        if (!sequence) {
            node.plane = plane();
        }
        const auto side = [&] {
            return sequence || parting        ? child(true, true)
                   : words_.skip("unclaimed") ? Node::unclaimed
                                              : child(false, true);
        };
        node.front = side();
        node.back = side();
        if (parting) {
            node.along = child(true, false);
            node.against = child(true, false);
        }
        added(made_.nodes, std::move(node));
        return true;
    }

    /// A child; whether it is there is known only when all are read.
    int child(bool may_be_nothing, bool may_be_node) {
        if (may_be_nothing && words_.skip("nothing")) {
            return Node::nothing;
        }
        if (words_.skip("list")) {
            return ~static_cast<int>(words_.index("a list", most_entries));
        }
        if (!may_be_node || !words_.skip("node")) {
            words_.refuse(fmt::format(
                "{}list K{}", may_be_node ? "node K, " : "", may_be_nothing ? ", nothing" : ""));
        }
        const std::uint32_t number = words_.index("a node", most_entries);
        if (number <= made_.nodes.size()) {
            words_.refuse_last("a later node");
        }
        return static_cast<int>(number);
    }

    void finish_structure() {
        if (structure_is_done_) {
            return;
        }
        structure_is_done_ = true;
        walls_ = count_walls(made_);
        made_.of_nodes.resize(made_.nodes.size());
        made_.of_lists.resize(made_.lists.size());
    }

    double factor() { return words_.number("a factor", 0.0, largest_number); }

    /// The factor of 1 and those of the walls.
    void take_walls(Factors& factors) {
        factors.one = factor();
        for (std::size_t i = 0; i < walls_at_hand_; ++i) {
            factors.walls.push_back(factor());
        }
    }

    void take_away(Claims& claims, std::uint32_t polygon) {
        AwayClaim claim;
        claim.line = words_.line();
        claim.factors.earlier = 1.0;
        take_walls(claim.factors);
        if (!claims.away.emplace(polygon, std::move(claim)).second) {
            words_.refuse_last("each polygon once");
        }
    }

    /// A polygon or a pair without a proof.
    void take_unproved(Claims& claims, std::uint32_t polygon) {
        ++made_.unproved;
        made_.first_unproved = made_.first_unproved.value_or(words_.line());
        if (words_.done()) {
            claims.unproved.emplace(polygon, words_.line());
        } else {
            added(
                claims.pairs,
                {PairClaim::Kind::Unproved, {polygon, this->polygon()}, {}, words_.line()});
        }
    }

    void take_row(Claims& claims, std::uint32_t later) {
        Row row;
        row.later = later;
        row.line = words_.line();
        while (!words_.done()) {
            row.runs.push_back(run());
        }
        added(claims.rows, std::move(row));
    }

    /// Reads a count and a letter.
    Run run() {
        const std::string_view word = words_.word("a run of pairs");
        const auto count = whole_number(word.substr(0, word.size() - 1));
        const char letter = word.back();
        const bool known = letter == 'e' || letter == 'l' || letter == '-';
        if (!known || !count || *count < 1 || static_cast<std::size_t>(*count) > most_entries) {
            words_.refuse_last("a count with e, l or -");
        }
        return {
            letter == 'e'   ? Run::By::Earlier
            : letter == 'l' ? Run::By::Later
                            : Run::By::Elsewhere,
            static_cast<std::uint32_t>(*count)};
    }

    WordReader words_;
    Certificate made_;
    bool has_header_ = false;
    bool structure_is_done_ = false;
    std::vector<bool> used_; ///< One flag for each polygon; all are false between lines.
    WallCounts walls_;
    std::size_t walls_at_hand_ = 0; ///< How many walls the region of the claim at hand has.
};

} // namespace

Certificate read_certificate(const std::filesystem::path& path) {
    return certificate_of(read_text_file(path, largest_bytes), path);
}

Certificate certificate_of(std::string_view text, const std::filesystem::path& name) {
    return Reading(name).read(text);
}

} // namespace octant::visuals::verify
