// Walks the tree of a painting order from its root and asks for a proof of everything that the order rests on.
// certificate-format.md says why each statement proves its pair.
#include "visuals/verify/verify.h"

#include "sim/base/error.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/exact_sides.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace octant::visuals::verify {

namespace {

/// The polygons below each node of a tree.
class TreeContents {
public:
    explicit TreeContents(const Certificate& certificate)
        : by_node_(certificate.nodes.size()), by_list_(certificate.lists.size()) {
        /// A node or list, and whether all below it has been gone through.
        struct Visit {
            int child = 0;
            bool leaves = false;
        };

        std::vector<Visit> to_do{{certificate.nodes.empty() ? ~0 : 0, false}};
        while (!to_do.empty()) {
            const Visit visit = to_do.back();
            to_do.pop_back();
            if (OrderNode::is_empty(visit.child)) { continue; }
            if (visit.child < 0) {
                const auto list = static_cast<std::size_t>(~visit.child);
                const auto& polygons = certificate.lists[list].polygons;
                by_list_[list].first = entries_.size();
                entries_.insert(entries_.end(), polygons.begin(), polygons.end());
                by_list_[list].end = entries_.size();
                continue;
            }
            const auto number = static_cast<std::size_t>(visit.child);
            if (visit.leaves) {
                by_node_[number].end = entries_.size();
                continue;
            }
            by_node_[number].first = entries_.size();
            const OrderNode& node = certificate.nodes[number];
            to_do.push_back({visit.child, true});
            for (const int child : {node.front, node.back, node.coplanar_front, node.coplanar_back}) {
                to_do.push_back({child, false});
            }
        }
    }

    /// The polygons that are painted for some eye in a child, ascending.
    std::vector<std::uint32_t> of(int child) const {
        if (OrderNode::is_empty(child)) { return {}; }
        const Range range =
            child < 0 ? by_list_[static_cast<std::size_t>(~child)] : by_node_[static_cast<std::size_t>(child)];
        std::vector<std::uint32_t> polygons(entries_.begin() + static_cast<std::ptrdiff_t>(range.first),
            entries_.begin() + static_cast<std::ptrdiff_t>(range.end));
        std::ranges::sort(polygons);
        polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
        return polygons;
    }

private:
    /// A range of entries_.
    struct Range {
        std::size_t first = 0;
        std::size_t end = 0;
    };

    std::vector<std::uint32_t> entries_; ///< All lists, those of each node side by side.
    std::vector<Range> by_node_;
    std::vector<Range> by_list_;
};

/// A set of polygons.
class PolygonSet {
public:
    explicit PolygonSet(std::size_t polygons) : words_((polygons + 63) / 64, 0) {}

    void add(std::uint32_t polygon) { words_[polygon / 64] |= std::uint64_t{1} << (polygon % 64); }

    void add(const PolygonSet& others) {
        for (std::size_t i = 0; i < words_.size(); ++i) { words_[i] |= others.words_[i]; }
    }

    bool has(std::uint32_t polygon) const { return ((words_[polygon / 64] >> (polygon % 64)) & 1U) != 0; }

    /// Whether all of these are among others.
    bool is_subset_of(const PolygonSet& others) const {
        for (std::size_t i = 0; i < words_.size(); ++i) {
            if ((words_[i] & ~others.words_[i]) != 0) { return false; }
        }
        return true;
    }

private:
    std::vector<std::uint64_t> words_;
};

/// Pairs of which the earlier polygon is proved to hide nothing of the later one from some eyes.
class ProvedPairs {
public:
    explicit ProvedPairs(std::size_t polygons) : polygons_(polygons) {}

    void add(const PolygonPair& pair) { row(pair.later).add(pair.earlier); }

    /// Adds what a plane proves that all eyes are before: whatever is behind it hides nothing of whatever is before it.
    void add_region_plane(const WrittenPlane& plane, const Certificate& certificate, const ExactSides& sides) {
        const WrittenPlane back = reversed(plane);
        PolygonSet behind(polygons_);
        for (std::uint32_t i = 0; i < polygons_; ++i) {
            if (sides.is_behind(i, plane, PartAngle::Turning)) { behind.add(i); }
        }
        for (std::uint32_t i = 0; i < polygons_; ++i) {
            if (!sides.is_behind(i, back, PartAngle::Turning)) { continue; }
            // Polygons that turn together see the plane turn.
            const auto& axis = certificate.polygons[i].axis;
            if (!axis) {
                row(i).add(behind);
                continue;
            }
            for (std::uint32_t earlier = 0; earlier < polygons_; ++earlier) {
                if (behind.has(earlier) && certificate.polygons[earlier].axis != axis) { row(i).add(earlier); }
            }
        }
    }

    /// Whether all of `painted` hide nothing of a polygon.
    bool decide(const PolygonSet& painted, std::uint32_t later) const {
        const auto known = rows_.find(later);
        return known != rows_.end() && painted.is_subset_of(known->second);
    }

    /// The first polygon of which that is not known; there is one (asserted).
    std::uint32_t first_open(std::span<const std::uint32_t> painted, std::uint32_t later) const {
        const auto known = rows_.find(later);
        const auto open = std::ranges::find_if(
            painted, [&](std::uint32_t earlier) { return known == rows_.end() || !known->second.has(earlier); });
        assert(open != painted.end());
        return *open;
    }

private:
    PolygonSet& row(std::uint32_t later) { return rows_.try_emplace(later, polygons_).first->second; }

    std::size_t polygons_;
    std::unordered_map<std::uint32_t, PolygonSet> rows_; ///< By the later polygon.
};

/// The region of the eyes of a list or node: it is in front of all of these planes.
using RegionPlanes = std::vector<WrittenPlane>;

/// Checks the statements about pairs; certificate-format.md says why each one is a proof. Throws InvalidCertificate for
/// false ones. Keeps references.
class PairCheck {
public:
    PairCheck(const Certificate& certificate, const ExactSides& sides) : certificate_(certificate), sides_(sides) {}

    /// That the plane of the earlier polygon has the later one before it.
    void check_earlier(const PolygonPair& pair, int line) const {
        const PartAngle pose = pose_of(pair);
        require_fixed_plane(pair.earlier, pose, line);
        if (!sides_.is_before(pair.later, certificate_.polygons[pair.earlier].plane, pose)) {
            throw InvalidCertificate{
                line, fmt::format("expected polygon {} before the plane of polygon {}, got a corner behind it",
                          pair.later, pair.earlier)};
        }
    }

    /// That the plane of the later polygon has the earlier one behind it.
    void check_later(const PolygonPair& pair, int line) const {
        const PartAngle pose = pose_of(pair);
        require_fixed_plane(pair.later, pose, line);
        if (!sides_.is_behind(pair.earlier, certificate_.polygons[pair.later].plane, pose)) {
            throw InvalidCertificate{
                line, fmt::format("expected polygon {} behind the plane of polygon {}, got a corner before it",
                          pair.earlier, pair.later)};
        }
    }

    /// The statement, a sum or never, for the eyes before all region planes.
    void check(const Statement& statement, const RegionPlanes& region_planes) const {
        const Sum sum{statement.pair, pose_of(statement.pair), statement.factors, region_planes, statement.line};
        statement.kind == Statement::Kind::Sum ? check_separates(sum) : check_never(sum);
    }

    /// That a polygon faces away from every eye before all region planes.
    void check_away(const Statement& statement, const RegionPlanes& region_planes) const {
        const std::uint32_t polygon = statement.pair.earlier;
        check_never({{polygon, polygon}, PartAngle::Turning, statement.factors, region_planes, statement.line});
    }

private:
    /// Factors that are stated for a pair.
    struct Sum {
        const PolygonPair& pair;
        PartAngle pose;
        const StatedFactors& factors;
        const RegionPlanes& region_planes;
        int line;
    };

    /// Polygons that turn together stand still to one another.
    PartAngle pose_of(const PolygonPair& pair) const {
        const auto& axis = certificate_.polygons[pair.earlier].axis;
        const bool together = axis && axis == certificate_.polygons[pair.later].axis;
        return together ? PartAngle::Standing : PartAngle::Turning;
    }

    void require_fixed_plane(std::uint32_t polygon, PartAngle pose, int line) const {
        if (!sides_.has_fixed_plane(polygon, pose)) {
            throw InvalidCertificate{line,
                fmt::format("expected a sum without the plane of polygon {}, which turns, got one with it", polygon)};
        }
    }

    ExactPlane plane_of(const Sum& sum) const {
        ExactPlane plane;
        const auto add_front = [&](double factor, std::uint32_t polygon) {
            if (factor > 0.0) {
                require_fixed_plane(polygon, sum.pose, sum.line);
                add(plane, factor, exact(certificate_.polygons[polygon].plane));
            }
        };
        add_front(sum.factors.earlier, sum.pair.earlier);
        add_front(sum.factors.later, sum.pair.later);
        const auto& axis = certificate_.polygons[sum.pair.earlier].axis;
        for (const auto& [i, factor] : sum.factors.region_planes) {
            if (factor > 0.0 && sum.pose == PartAngle::Standing && axis &&
                !is_across(sum.region_planes[i], certificate_.axes[*axis])) {
                throw InvalidCertificate{
                    sum.line, fmt::format("expected a sum without region plane {}, which turns for polygons {} and "
                                          "{}, got one with it",
                                  i, sum.pair.earlier, sum.pair.later)};
            }
            add(plane, factor, exact(sum.region_planes[i]));
        }
        plane.offset += Rational(sum.factors.one);
        return plane;
    }

    void check_separates(const Sum& sum) const {
        const ExactPlane plane = plane_of(sum);
        const auto refuse = [&](std::uint32_t polygon, const char* expected, const char* got) {
            throw InvalidCertificate{
                sum.line, fmt::format("expected factors of a plane with polygon {} {} it, got a corner {} it", polygon,
                              expected, got)};
        };
        if (largest(plane.normal) == 0) {
            throw InvalidCertificate{sum.line, "expected factors that make a plane, got none"};
        }
        if (!sides_.is_behind(sum.pair.earlier, plane, sum.pose)) { refuse(sum.pair.earlier, "behind", "before"); }
        if (!sides_.is_before(sum.pair.later, plane, sum.pose)) { refuse(sum.pair.later, "before", "behind"); }
    }

    void check_never(const Sum& sum) const {
        const StatedFactors& factors = sum.factors;
        const bool enough = Rational(factors.earlier) + Rational(factors.later) >= 1;
        if (!enough || !sides_.is_impossible(plane_of(sum))) {
            throw InvalidCertificate{sum.line,
                fmt::format("expected factors that leave no eye before the planes of polygons {} and {}, got a "
                            "sum that is not negative everywhere",
                    sum.pair.earlier, sum.pair.later)};
        }
    }

    const Certificate& certificate_;
    const ExactSides& sides_;
};

/// The earlier polygons of which a row of pairs speaks, by the later one; nothing where there should be no such row.
using EarlierOf = std::function<std::optional<std::span<const std::uint32_t>>(std::uint32_t later)>;

void check_row(const PairCheck& check, const Statement& row, std::span<const std::uint32_t> earlier,
    ProvedPairs& proved_pairs, StatementCounts& counts) {
    std::uint64_t all = 0;
    for (const DeciderRun& run : row.runs) { all += run.count; }
    if (all != earlier.size()) {
        throw InvalidCertificate{
            row.line, fmt::format("expected pairs with {} earlier polygons, got {}", earlier.size(), all)};
    }
    std::size_t at = 0;
    for (const DeciderRun& run : row.runs) {
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const PolygonPair pair{earlier[at++], row.pair.later};
            if (run.by == DeciderRun::By::Elsewhere) { continue; }
            run.by == DeciderRun::By::Earlier ? check.check_earlier(pair, row.line) : check.check_later(pair, row.line);
            proved_pairs.add(pair);
            ++counts.by_polygons;
        }
    }
}

/// What the statements of a node or list say of single polygons, ascending.
struct PolygonStatements {
    std::set<std::uint32_t> away; ///< proved to face away
    std::set<std::uint32_t> unproved;
};

struct Box {
    Vector least{};
    Vector most{};
    std::uint32_t polygon = 0;
};

Box box_of(const Certificate& certificate, std::uint32_t number) {
    const CertificatePolygon& polygon = certificate.polygons[number];
    Box box;
    box.polygon = number;
    box.least = box.most = certificate.vertices[polygon.corners.front()];
    for (const std::uint32_t corner : polygon.corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            box.least[i] = std::min(box.least[i], certificate.vertices[corner][i]);
            box.most[i] = std::max(box.most[i], certificate.vertices[corner][i]);
        }
    }
    // Polygons that only nearly overlap lie in one plane all the same.
    for (std::size_t i = 0; i < 3; ++i) {
        box.least[i] -= certificate.tolerance;
        box.most[i] += certificate.tolerance;
    }
    return box;
}

bool meet(const Box& a, const Box& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (a.most[i] < b.least[i] || b.most[i] < a.least[i]) { return false; }
    }
    return true;
}

/// All pairs of polygons that overlap in one plane and of which the later one of the model's file has to be painted
/// later.
std::vector<PolygonPair> coplanar_layer_pairs(const Certificate& certificate, const ExactSides& sides) {
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < certificate.polygons.size(); ++i) { boxes.push_back(box_of(certificate, i)); }
    std::ranges::sort(boxes, {}, [](const Box& box) { return box.least[0]; });
    std::vector<PolygonPair> found;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t j = i + 1; j < boxes.size() && boxes[j].least[0] <= boxes[i].most[0]; ++j) {
            PolygonPair pair{boxes[i].polygon, boxes[j].polygon};
            const CertificatePolygon& a = certificate.polygons[pair.earlier];
            const CertificatePolygon& b = certificate.polygons[pair.later];
            if (a.source != b.source && a.axis == b.axis && meet(boxes[i], boxes[j]) &&
                sides.are_coplanar_layers(pair.earlier, pair.later)) {
                if (a.source > b.source) { std::swap(pair.earlier, pair.later); }
                found.push_back(pair);
            }
        }
    }
    return found;
}

[[noreturn]] void fail_at_repeat(std::uint32_t polygon, int line) {
    throw InvalidCertificate{line, fmt::format("expected each polygon painted once, got {} again", polygon)};
}

[[noreturn]] void fail_layer_order(const PolygonPair& pair, int line) {
    throw InvalidCertificate{
        line, fmt::format("expected polygon {} painted over polygon {}, which it overlaps in one plane and "
                          "follows in the model's file, got it painted earlier",
                  pair.later, pair.earlier)};
}

std::unordered_map<std::uint32_t, std::size_t> places_of(std::span<const std::uint32_t> list) {
    std::unordered_map<std::uint32_t, std::size_t> places;
    for (std::size_t i = 0; i < list.size(); ++i) { places.emplace(list[i], i); }
    return places;
}

/// Checks that each polygon is painted where it can be seen, once, and over those of its own plane that it is to cover.
/// Throws InvalidCertificate. Keeps references.
class PaintedCheck {
public:
    PaintedCheck(const Certificate& certificate, const ExactSides& sides)
        : coplanar_layer_pairs_(coplanar_layer_pairs(certificate, sides)), mark_(certificate.polygons.size(), 0) {}

    /// That in the part of a line nothing is painted but what is expected, and that what is expected and not painted is
    /// stated to face away. Returns how many are.
    std::uint64_t require_painted(int line, std::span<const std::uint32_t> expected,
        std::span<const std::uint32_t> painted, const PolygonStatements& stated) {
        enum : char { None, Expected, Painted };

        for (const std::uint32_t polygon : expected) { mark_[polygon] = Expected; }
        for (const std::uint32_t polygon : painted) {
            if (std::exchange(mark_[polygon], Painted) != Expected) { fail_at_repeat(polygon, line); }
        }
        std::uint64_t unlisted = 0;
        for (const std::uint32_t polygon : expected) {
            if (std::exchange(mark_[polygon], None) == Painted || stated.unproved.contains(polygon)) { continue; }
            if (!stated.away.contains(polygon)) {
                throw InvalidCertificate{
                    line, fmt::format("expected polygon {} painted or proved to face away, got neither", polygon)};
            }
            ++unlisted;
        }
        return unlisted;
    }

    /// That no polygon lies in two parts of a node, front, back, along and against, but for flat ones in its plane that
    /// are seen from both sides.
    void require_disjoint(int line, const std::array<std::span<const std::uint32_t>, 4>& parts) {
        constexpr std::array<char, 4> marks{1, 2, 3, 4};
        for (std::size_t i = 0; i < parts.size(); ++i) {
            for (const std::uint32_t polygon : parts[i]) {
                const char before = std::exchange(mark_[polygon], marks[i]);
                if (before != 0 && !(before == marks[2] && i == 3)) { fail_at_repeat(polygon, line); }
            }
        }
        for (const auto& part : parts) {
            for (const std::uint32_t polygon : part) { mark_[polygon] = 0; }
        }
    }

    /// That in a list what overlaps in one plane is painted as the model's file has it.
    void require_layer_order(std::span<const std::uint32_t> list, int line) const {
        if (coplanar_layer_pairs_.empty()) { return; }
        const auto places = places_of(list);
        for (const PolygonPair& pair : coplanar_layer_pairs_) {
            const auto lower = places.find(pair.earlier);
            const auto upper = places.find(pair.later);
            if (lower != places.end() && upper != places.end() && upper->second < lower->second) {
                fail_layer_order(pair, line);
            }
        }
    }

    /// The same for all of one part painted before all of another.
    void require_layer_order(
        std::span<const std::uint32_t> first, std::span<const std::uint32_t> later, int line) const {
        if (coplanar_layer_pairs_.empty()) { return; }
        const auto places_first = places_of(first);
        const auto places_later = places_of(later);
        for (const PolygonPair& pair : coplanar_layer_pairs_) {
            if (places_first.contains(pair.later) && places_later.contains(pair.earlier)) {
                fail_layer_order(pair, line);
            }
        }
    }

private:
    std::vector<PolygonPair> coplanar_layer_pairs_;
    std::vector<char> mark_; ///< One for each polygon; all are 0 between checks.
};

constexpr double largest_tolerance_sizes = 1e-6;

using Polygons = std::vector<std::uint32_t>;

class Verifier {
public:
    Verifier(CertificateReader& reader, const std::function<void(std::size_t, std::size_t)>& progress)
        : reader_(reader), certificate_(reader.certificate()), progress_(progress), sides_(certificate_),
          pair_check_(certificate_, sides_), painted_check_(certificate_, sides_), contents_(certificate_) {
        const Rational most = sides_.size() * Rational(largest_tolerance_sizes);
        if (Rational(certificate_.tolerance) > most) {
            throw_error_in(certificate_.path,
                fmt::format("expected a tolerance of at most {:g} of the model's size, {:g}, got {:g}",
                    largest_tolerance_sizes, most.get_d(), certificate_.tolerance));
        }
        result_.tolerance_sizes = Rational(certificate_.tolerance / sides_.size()).get_d();
    }

    VerificationResult verified() {
        try {
            check_polygons();
            check_tree();
        } catch (InvalidCertificate& refusal) { result_.failure = std::move(refusal); }
        return result_;
    }

private:
    /// A part of the tree, the region planes of its eyes, and the polygons of which those that face such an eye have to
    /// be painted there.
    struct Task {
        int child = 0;
        RegionPlanes region_planes;
        std::shared_ptr<const Polygons> expected;
        /// The pairs that the view splits above prove, if there are any.
        std::shared_ptr<const ProvedPairs> known = nullptr;
        bool has_new_region_plane = false; ///< `known` does not hold yet what the last region plane proves.
        bool in_plane = false;             ///< A list of the polygons in the plane of a polygon split.
    };

    /// That each polygon lies in its plane and is seen from the front of it.
    void check_polygons() const {
        for (std::uint32_t i = 0; i < certificate_.polygons.size(); ++i) {
            const CertificatePolygon& polygon = certificate_.polygons[i];
            if (!sides_.is_behind(i, polygon.plane, PartAngle::Standing) ||
                !sides_.is_before(i, polygon.plane, PartAngle::Standing)) {
                throw InvalidCertificate{polygon.line, "expected all corners in the polygon's plane, got one off it"};
            }
            if (!sides_.is_counter_clockwise(i)) {
                throw InvalidCertificate{
                    polygon.line, "expected corners counter-clockwise about the normal, got others"};
            }
        }
    }

    void check_tree() {
        auto all = std::make_shared<Polygons>();
        for (std::uint32_t i = 0; i < certificate_.polygons.size(); ++i) { all->push_back(i); }
        std::vector<Task> to_do{{.child = certificate_.nodes.empty() ? ~0 : 0, .region_planes = {}, .expected = all}};
        const std::size_t parts = certificate_.nodes.size() + certificate_.lists.size();
        for (std::size_t done = 0; !to_do.empty(); ++done) {
            const Task task = std::move(to_do.back());
            to_do.pop_back();
            task.child < 0 ? check_list(task) : check_node(task, to_do);
            if (progress_) { progress_(done + 1, parts); }
        }
        reader_.require_end();
    }

    void check_list(const Task& task) {
        const OrderList& list = certificate_.lists[static_cast<std::size_t>(~task.child)];
        const std::span<const std::uint32_t> polygons = list.polygons;
        std::unordered_map<std::uint32_t, std::size_t> place;
        for (std::size_t i = 0; i < polygons.size(); ++i) { place.emplace(polygons[i], i); }
        ProvedPairs proved_pairs = proved_pairs_at(task);
        const PolygonStatements stated = check(task, proved_pairs, [&](std::uint32_t later) {
            const auto found = place.find(later);
            return found == place.end() ? std::nullopt : std::optional(polygons.first(found->second));
        });
        result_.unlisted += painted_check_.require_painted(list.line, *task.expected, polygons, stated);
        painted_check_.require_layer_order(polygons, list.line);
        const std::uint64_t pairs = pairs_among(polygons.size());
        result_.pairs += pairs;
        if (task.in_plane) {
            result_.by_node_planes += pairs;
            return;
        }
        PolygonSet painted(certificate_.polygons.size());
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            require_decided(proved_pairs, painted, polygons.first(i), polygons[i], list.line);
            painted.add(polygons[i]);
        }
    }

    void check_node(const Task& task, std::vector<Task>& to_do) {
        const OrderNode& node = certificate_.nodes[static_cast<std::size_t>(task.child)];
        if (node.kind == OrderNode::Kind::ViewSplit) {
            check_choice(task, node, to_do);
            return;
        }
        const Polygons front = contents_.of(node.front);
        const Polygons back = contents_.of(node.back);
        const Polygons coplanar_front = contents_.of(node.coplanar_front);
        const Polygons coplanar_back = contents_.of(node.coplanar_back);
        painted_check_.require_disjoint(node.line, {front, back, coplanar_front, coplanar_back});
        const auto known = known_below(task);
        ProvedPairs proved_pairs = proved_pairs_at(task);
        const bool is_sequence = node.kind == OrderNode::Kind::Sequence;
        const PolygonStatements stated = check(task, proved_pairs, [&](std::uint32_t later) {
            return is_sequence && std::ranges::binary_search(back, later) ? std::optional(std::span(front))
                                                                          : std::nullopt;
        });
        result_.unlisted += painted_check_.require_painted(node.line, *task.expected, contents_.of(task.child), stated);
        if (is_sequence) {
            check_sequence(proved_pairs, front, back, node.line);
        } else {
            check_parting(node, stated, {front, back}, {coplanar_front, coplanar_back});
        }
        const auto add = [&](int child, const Polygons& polygons, bool in_plane) {
            if (child != OrderNode::no_child) {
                const auto expected = std::make_shared<Polygons>(polygons);
                to_do.push_back({child, task.region_planes, expected, known, false, in_plane});
            }
        };
        // The last one that is added comes first.
        add(node.coplanar_back, coplanar_back, true);
        add(node.coplanar_front, coplanar_front, true);
        add(node.back, back, false);
        add(node.front, front, false);
    }

    /// The polygons expected of a view split are expected on both of its sides, but for those that face away from all
    /// of its eyes.
    void check_choice(const Task& task, const OrderNode& node, std::vector<Task>& to_do) {
        const Polygons below = contents_.of(task.child);
        const auto proved_pairs = std::make_shared<ProvedPairs>(proved_pairs_at(task));
        const PolygonStatements stated =
            check(task, *proved_pairs, [&](std::uint32_t) { return std::optional(std::span(below)); });
        auto expected = task.expected;
        if (!stated.away.empty()) {
            auto rest = std::make_shared<Polygons>();
            std::ranges::copy_if(*task.expected, std::back_inserter(*rest),
                [&](std::uint32_t polygon) { return !stated.away.contains(polygon); });
            result_.unlisted += task.expected->size() - rest->size();
            expected = std::move(rest);
        }
        for (const bool in_front : {false, true}) { // the front comes first
            RegionPlanes region_planes = task.region_planes;
            region_planes.push_back(in_front ? node.plane : reversed(node.plane));
            const int child = in_front ? node.front : node.back;
            if (child == OrderNode::not_covered) {
                result_.covers_every_eye = false;
                continue;
            }
            to_do.push_back({child, std::move(region_planes), expected, proved_pairs, true, false});
        }
    }

    /// That nothing of the first part hides anything of the second.
    void check_sequence(const ProvedPairs& proved_pairs, const Polygons& front, const Polygons& back, int line) {
        painted_check_.require_layer_order(front, back, line);
        PolygonSet painted(certificate_.polygons.size());
        for (const std::uint32_t polygon : front) { painted.add(polygon); }
        for (const std::uint32_t later : back) { require_decided(proved_pairs, painted, front, later, line); }
        result_.pairs += front.size() * back.size();
    }

    /// Reads and checks all statements of a part for the eyes before its region planes, and adds the pairs to the
    /// proved ones. Throws InvalidCertificate.
    PolygonStatements check(const Task& task, ProvedPairs& proved_pairs, const EarlierOf& earlier_of) {
        PolygonStatements stated;
        while (const Statement* statement = reader_.next_of(task.child)) {
            check(*statement, task, proved_pairs, earlier_of, stated);
        }
        return stated;
    }

    void check(const Statement& statement, const Task& task, ProvedPairs& proved_pairs, const EarlierOf& earlier_of,
        PolygonStatements& stated) {
        switch (statement.kind) {
        case Statement::Kind::Pairs: {
            const auto earlier = earlier_of(statement.pair.later);
            if (!earlier) {
                throw InvalidCertificate{statement.line,
                    fmt::format("expected pairs of a polygon that is painted over others there, got polygon {}",
                        statement.pair.later)};
            }
            check_row(pair_check_, statement, *earlier, proved_pairs, result_.statements);
            return;
        }
        case Statement::Kind::Sum:
        case Statement::Kind::Never:
            pair_check_.check(statement, task.region_planes);
            proved_pairs.add(statement.pair);
            ++(statement.kind == Statement::Kind::Sum ? result_.statements.by_sums
                                                      : result_.statements.never_both_visible);
            return;
        case Statement::Kind::Away:
            pair_check_.check_away(statement, task.region_planes);
            stated.away.insert(statement.pair.earlier);
            return;
        case Statement::Kind::UnprovedPair:
        case Statement::Kind::UnprovedPolygon:
            ++result_.unproved;
            result_.first_unproved = result_.first_unproved.value_or(statement.line);
            if (statement.kind == Statement::Kind::UnprovedPair) {
                proved_pairs.add(statement.pair); // that it is not is counted
            } else {
                stated.unproved.insert(statement.pair.earlier);
            }
            return;
        }
    }

    static std::uint64_t pairs_among(std::size_t polygons) { return polygons < 2 ? 0 : polygons * (polygons - 1) / 2; }

    /// What the nodes above and the last region plane prove for the eyes of a part.
    ProvedPairs proved_pairs_at(const Task& task) const {
        ProvedPairs proved_pairs = task.known ? *task.known : ProvedPairs(certificate_.polygons.size());
        if (task.has_new_region_plane) {
            proved_pairs.add_region_plane(task.region_planes.back(), certificate_, sides_);
        }
        return proved_pairs;
    }

    /// The proved pairs for the children of a node that is no view split; null where there are none.
    std::shared_ptr<const ProvedPairs> known_below(const Task& task) const {
        return task.has_new_region_plane ? std::make_shared<const ProvedPairs>(proved_pairs_at(task)) : task.known;
    }

    void require_decided(const ProvedPairs& proved_pairs, const PolygonSet& painted,
        std::span<const std::uint32_t> earlier, std::uint32_t later, int line) const {
        if (!earlier.empty() && !proved_pairs.decide(painted, later)) {
            throw InvalidCertificate{
                line, fmt::format("expected a proof that polygon {} hides nothing of polygon {}, got none",
                          proved_pairs.first_open(earlier, later), later)};
        }
    }

    /// Two of the parts of a polygon split.
    using TwoParts = std::pair<const Polygons&, const Polygons&>;

    /// Requires that the plane of a polygon split separates its parts, and that the polygons in it face the right way.
    void check_parting(
        const OrderNode& node, const PolygonStatements& stated, const TwoParts& sides, const TwoParts& coplanar) {
        const auto& [front, back] = sides;
        const auto& [coplanar_front, coplanar_back] = coplanar;
        const auto expect = [&](std::uint32_t polygon, bool good, const char* expected) {
            if (!good && !stated.unproved.contains(polygon)) {
                throw InvalidCertificate{node.line,
                    fmt::format("expected polygon {} {} the plane, got a corner elsewhere", polygon, expected)};
            }
        };
        const WrittenPlane back_of = reversed(node.plane);
        for (const std::uint32_t polygon : front) {
            expect(polygon, sides_.is_behind(polygon, back_of, PartAngle::Turning), "before");
        }
        for (const std::uint32_t polygon : back) {
            expect(polygon, sides_.is_behind(polygon, node.plane, PartAngle::Turning), "behind");
        }
        check_facing(coplanar_front, coplanar_back, node.plane, expect);
        check_facing(coplanar_back, coplanar_front, back_of, expect);
        const std::uint64_t pairs =
            front.size() * back.size() + (front.size() + back.size()) * (coplanar_front.size() + coplanar_back.size());
        result_.by_node_planes += pairs;
        result_.pairs += pairs;
    }

    /// That polygons lie in a plane, and face as it does unless they are painted for both sides.
    template <typename Expect>
    void check_facing(
        const Polygons& polygons, const Polygons& others, const WrittenPlane& plane, Expect expect) const {
        const ExactVector normal = exact(plane.normal);
        for (const std::uint32_t polygon : polygons) {
            const bool lies_in = sides_.is_behind(polygon, plane, PartAngle::Turning) &&
                                 sides_.is_before(polygon, plane, PartAngle::Turning);
            expect(polygon, lies_in, "in");
            const bool on_both = std::ranges::binary_search(others, polygon);
            const bool faces = sides_.has_fixed_plane(polygon, PartAngle::Turning) &&
                               dot(exact(certificate_.polygons[polygon].plane.normal), normal) > 0;
            expect(polygon, on_both || faces, "facing as");
        }
    }

    CertificateReader& reader_;
    const Certificate& certificate_;
    const std::function<void(std::size_t, std::size_t)>& progress_;
    ExactSides sides_;
    PairCheck pair_check_;
    PaintedCheck painted_check_;
    TreeContents contents_;
    VerificationResult result_;
};

} // namespace

VerificationResult verify(CertificateReader reader, const std::function<void(std::size_t, std::size_t)>& progress) {
    return Verifier(reader, progress).verified();
}

} // namespace octant::visuals::verify
