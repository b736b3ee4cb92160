#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace octant::visuals::verify {

/// A point or direction as a file has it.
using Vector = std::array<double, 3>;

/// A plane as a file has it: points p with normal . p + offset = 0; its front is where that is positive. The normal is
/// about 1 long.
struct WrittenPlane {
    Vector normal{};
    double offset = 0.0;
};

/// A line about which polygons turn.
struct TurnAxis {
    Vector point{};
    Vector direction{};
};

struct CertificatePolygon {
    std::uint32_t source = 0; ///< The polygon of the model's file of which it is a piece.
    WrittenPlane plane;       ///< It is seen from the front of it.
    std::vector<std::uint32_t> corners;
    std::optional<std::uint32_t> axis; ///< About which it turns; it stands at angle 0.
    int line = 0;
};

/// A part of the tree, as visuals/draworder has them.
struct OrderNode {
    enum class Kind { ViewSplit, PolygonSplit, Sequence };

    /// A child where nothing is painted; else a child >= 0 is a node, one < 0 the list ~child.
    static constexpr int no_child = std::numeric_limits<int>::min();
    /// A side of a view split about whose eyes nothing is stated.
    static constexpr int not_covered = no_child + 1;

    /// Whether a child is neither a node nor a list.
    static bool is_empty(int child) { return child == no_child || child == not_covered; }

    Kind kind = Kind::ViewSplit;
    WrittenPlane plane; ///< Not of a sequence.
    int front = no_child;
    int back = no_child;
    int coplanar_front = no_child;
    int coplanar_back = no_child;
    int line = 0;
};

struct OrderList {
    std::vector<std::uint32_t> polygons; ///< First painted first.
    int line = 0;
};

/// Factors of a sum of planes: of the earlier polygon's (or the only one's), of the later one's, of the constant 1, and
/// of each region plane of the region, the root's first.
struct StatedFactors {
    double earlier = 0.0;
    double later = 0.0;
    double one = 0.0;
    std::vector<double> region_planes;
};

/// Two polygons, of which one may be painted earlier and one later.
struct PolygonPair {
    std::uint32_t earlier = 0;
    std::uint32_t later = 0;
};

/// How several pairs in a row are decided that have the later polygon in common: by the plane of the earlier one, by
/// that of the later one, or somewhere else.
struct DeciderRun {
    enum class By { Earlier, Later, Elsewhere };
    By by = By::Elsewhere;
    std::uint32_t count = 0;
};

/// Pairs of one later polygon.
struct PairRow {
    std::uint32_t later = 0;
    std::vector<DeciderRun> runs;
    int line = 0;
};

/// A pair decided by factors, or not at all.
struct PairStatement {
    enum class Kind { Sum, Never, Unproved };
    Kind kind = Kind::Unproved;
    PolygonPair pair;
    StatedFactors factors;
    int line = 0;
};

/// A polygon that is not painted because it faces away from all eyes.
struct BackFacingStatement {
    StatedFactors factors;
    int line = 0;
};

/// The statements for the eyes of a node or a list.
struct Statements {
    std::vector<PairRow> rows;
    std::vector<PairStatement> pairs;
    std::map<std::uint32_t, BackFacingStatement> away;
    /// Polygons that are not proved to lie where they should, or to face away, and the line.
    std::map<std::uint32_t, int> unproved;
};

/// A certificate as read from its file. Its statements may be false, but they are well-formed: all numbers are in their
/// ranges, and nodes and lists form a tree.
struct Certificate {
    std::filesystem::path path;
    double tolerance = 0.0; ///< Lengths up to this are taken for none.
    std::vector<Vector> vertices;
    std::vector<TurnAxis> axes;
    std::vector<CertificatePolygon> polygons;
    std::vector<OrderNode> nodes; ///< Node 0 is the root; without nodes list 0 is.
    std::vector<OrderList> lists;
    std::vector<Statements> by_node;
    std::vector<Statements> by_list;
    std::size_t unproved = 0;          ///< How many lines say so.
    std::optional<int> first_unproved; ///< The first of them.

    const Statements& statements_of(int child) const {
        return child < 0 ? by_list[static_cast<std::size_t>(~child)] : by_node[static_cast<std::size_t>(child)];
    }

    int line_of(int child) const {
        return child < 0 ? lists[static_cast<std::size_t>(~child)].line : nodes[static_cast<std::size_t>(child)].line;
    }
};

/// Reads a certificate; certificate-format.md describes it. Throws Error "file:line: expected ..., got ..." for whatever is not a
/// certificate at all: no header, unknown keywords, numbers that are missing, too many, not finite or out of range,
/// nodes and lists that are no tree, statements about polygons, nodes or lists that do not exist.
Certificate read_certificate(const std::filesystem::path& path);

/// The same of the text of a file; `name` is what errors call it.
Certificate certificate_of(std::string_view text, const std::filesystem::path& name);

} // namespace octant::visuals::verify
