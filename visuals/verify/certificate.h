#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
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

/// A region plane, counted from the root, and its factor in a sum of planes.
struct RegionPlaneFactor {
    std::uint32_t plane = 0;
    double factor = 0.0;
};

/// Factors of a sum of planes: of the earlier polygon's (or the only one's), of the later one's, of the constant 1, and
/// of region planes of the region; that of others is 0.
struct StatedFactors {
    double earlier = 0.0;
    double later = 0.0;
    double one = 0.0;
    std::vector<RegionPlaneFactor> region_planes;
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

/// A statement for the eyes of a node or a list.
struct Statement {
    enum class Kind {
        Pairs, ///< how the pairs of `pair.later` with earlier polygons are decided
        Sum,   ///< a pair is decided by factors
        Never, ///< no eye sees both polygons of a pair, by factors
        Away,  ///< `pair.earlier` faces away from all eyes, by factors
        UnprovedPair,
        UnprovedPolygon ///< `pair.earlier` is not proved to lie where it should, or to face away
    };
    Kind kind = Kind::Pairs;
    PolygonPair pair;
    StatedFactors factors;
    std::vector<DeciderRun> runs;
    int line = 0;
};

/// A certificate without its statements, as read from its file: well-formed, all numbers in their ranges, nodes and
/// lists a tree.
struct Certificate {
    std::filesystem::path path;
    std::string model;      ///< what the writer calls the model
    std::string model_hash; ///< of the polygons of the model's file, which `octant verify` can compare
    double tolerance = 0.0; ///< Lengths up to this are taken for none.
    std::vector<Vector> vertices;
    std::vector<TurnAxis> axes;
    std::vector<CertificatePolygon> polygons;
    std::vector<OrderNode> nodes; ///< Node 0 is the root; without nodes list 0 is.
    std::vector<OrderList> lists;

    int line_of(int child) const {
        return child < 0 ? lists[static_cast<std::size_t>(~child)].line : nodes[static_cast<std::size_t>(child)].line;
    }
};

/// Reads a certificate: first all but the statements, then one statement at a time, so that memory does not grow with
/// their number. certificate-format.md describes the format. All functions throw Error "file:line: expected ..., got
/// ..." for whatever is not a certificate at all: no header, another version, unknown keywords, numbers that are
/// missing, too many, not finite or out of range, nodes and lists that are no tree, statements about polygons, nodes or
/// lists that do not exist, or in another order than that of the tree.
class CertificateReader {
public:
    explicit CertificateReader(const std::filesystem::path& path);
    /// Of the text of a file, which must outlive the reader; `name` is what errors call it.
    CertificateReader(std::string_view text, const std::filesystem::path& name);
    CertificateReader(const CertificateReader&) = delete;
    CertificateReader& operator=(const CertificateReader&) = delete;
    CertificateReader(CertificateReader&&) noexcept;
    CertificateReader& operator=(CertificateReader&&) noexcept;
    ~CertificateReader();

    const Certificate& certificate() const;

    /// Reads the next statement if it is about this node or list; else null. Valid until the next call. Parts must be
    /// asked for in the order of the tree: a node before its children, and these in the order of its line.
    const Statement* next_of(int child);

    /// Throws Error if there is a statement that was not read.
    void require_end();

private:
    class Parser;
    std::unique_ptr<Parser> parser_;
};

} // namespace octant::visuals::verify
