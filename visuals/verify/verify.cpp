// Walks the tree of a painting order from its root and asks for a proof of everything that the
// order rests on. README.md has the proofs.
#include "visuals/verify/verify.h"

#include "sim/base/error.h"
#include "visuals/verify/statement_check.h"
#include "visuals/verify/proved_pairs.h"
#include "visuals/verify/painted_check.h"
#include "visuals/verify/pair_check.h"
#include "visuals/verify/exact_sides.h"
#include "visuals/verify/tree_contents.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

namespace octant::visuals::verify {

namespace {

constexpr double largest_tolerance_sizes = 1e-6;

using Polygons = std::vector<std::uint32_t>;

class Verifier {
public:
    Verifier(
        const Certificate& certificate,
        const std::function<void(std::size_t, std::size_t)>& progress)
        : certificate_(certificate)
        , progress_(progress)
        , sides_(certificate)
        , pair_check_(certificate, sides_)
        , painted_check_(certificate, sides_, pair_check_)
        , contents_(certificate) {
        const Rational most = sides_.size() * Rational(largest_tolerance_sizes);
        if (Rational(certificate.tolerance) > most) {
            throw_error_in(
                certificate.path,
                fmt::format(
                    "expected a tolerance of at most {:g} of the model's size, {:g}, got {:g}",
                    largest_tolerance_sizes,
                    most.get_d(),
                    certificate.tolerance));
        }
        verdict_.tolerance_sizes = Rational(certificate.tolerance / sides_.size()).get_d();
        verdict_.unproved = certificate.unproved;
    }

    VerificationResult result() {
        try {
            check_polygons();
            check_tree();
        } catch (InvalidCertificate& refusal) {
            verdict_.failure = std::move(refusal);
        }
        return verdict_;
    }

private:
    /// A part of the tree, the walls of its eyes, and the polygons of which those that face such an
    /// eye have to be painted there.
    struct Task {
        int child = 0;
        RegionPlanes region_planes;
        std::shared_ptr<const Polygons> expected;
        std::shared_ptr<const ProvedPairs> known = nullptr; ///< What the choices above prove, if any are.
        bool adds_wall = false; ///< Nothing has been made of the last wall yet.
        bool in_plane = false;  ///< A list of what lies in the plane of a parting.
    };

    /// That each polygon lies in its plane and is seen from the front of it.
    void check_polygons() const {
        for (std::uint32_t i = 0; i < certificate_.polygons.size(); ++i) {
            const CertificatePolygon& polygon = certificate_.polygons[i];
            if (!sides_.is_behind(i, polygon.plane, PartAngle::Standing) ||
                !sides_.is_before(i, polygon.plane, PartAngle::Standing)) {
                throw InvalidCertificate{
                    polygon.line, "expected all corners in the polygon's plane, got one beside it"};
            }
            if (!sides_.is_counter_clockwise(i)) {
                throw InvalidCertificate{
                    polygon.line,
                    "expected corners counter-clockwise about the normal, got others"};
            }
        }
    }

    void check_tree() {
        auto all = std::make_shared<Polygons>();
        for (std::uint32_t i = 0; i < certificate_.polygons.size(); ++i) {
            all->push_back(i);
        }
        std::vector<Task> to_do{
            {.child = certificate_.nodes.empty() ? ~0 : 0, .region_planes = {}, .expected = all}};
        const std::size_t parts = certificate_.nodes.size() + certificate_.lists.size();
        for (std::size_t done = 0; !to_do.empty(); ++done) {
            const Task task = std::move(to_do.back());
            to_do.pop_back();
            task.child < 0 ? check_list(task) : check_node(task, to_do);
            if (progress_) {
                progress_(done + 1, parts);
            }
        }
    }

    void check_list(const Task& task) {
        const OrderList& list = certificate_.lists[static_cast<std::size_t>(~task.child)];
        const std::span<const std::uint32_t> polygons = list.polygons;
        verdict_.unlisted +=
            painted_check_.require_painted(task.child, *task.expected, polygons, task.region_planes);
        painted_check_.require_layer_order(polygons, list.line);
        const std::uint64_t pairs = pairs_among(polygons.size());
        verdict_.pairs += pairs;
        if (task.in_plane) {
            verdict_.by_node_planes += pairs;
            return;
        }
        std::unordered_map<std::uint32_t, std::size_t> place;
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            place.emplace(polygons[i], i);
        }
        ProvedPairs proved_pairs = proved_pairs_at(task);
        check(task, proved_pairs, [&](std::uint32_t later) {
            const auto found = place.find(later);
            return found == place.end() ? std::nullopt
                                        : std::optional(polygons.first(found->second));
        });
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
        verdict_.unlisted += painted_check_.require_painted(
            task.child, *task.expected, contents_.of(task.child), task.region_planes);
        const auto known = known_below(task);
        if (node.kind == OrderNode::Kind::Sequence) {
            check_sequence(task, front, back);
        } else {
            check_parting(
                node, certificate_.statements_of(task.child), {front, back}, {coplanar_front, coplanar_back});
        }
        const auto add = [&](int child, const Polygons& polygons, bool in_plane) {
            if (child != OrderNode::nothing) {
                const auto expected = std::make_shared<Polygons>(polygons);
                to_do.push_back({child, task.region_planes, expected, known, false, in_plane});
            }
        };
        add(node.front, front, false);
        add(node.back, back, false);
        add(node.coplanar_front, coplanar_front, true);
        add(node.coplanar_back, coplanar_back, true);
    }

    /// Everything is expected on each side of a choice that is expected of the choice.
    void check_choice(const Task& task, const OrderNode& node, std::vector<Task>& to_do) {
        const Polygons below = contents_.of(task.child);
        const auto proved_pairs = std::make_shared<ProvedPairs>(proved_pairs_at(task));
        check(task, *proved_pairs, [&](std::uint32_t) { return std::optional(std::span(below)); });
        for (const bool in_front : {true, false}) {
            RegionPlanes region_planes = task.region_planes;
            region_planes.push_back(in_front ? node.plane : reversed(node.plane));
            const int child = in_front ? node.front : node.back;
            if (child == OrderNode::not_covered) {
                verdict_.covers_every_eye = false;
                continue;
            }
            to_do.push_back({child, std::move(region_planes), task.expected, proved_pairs, true, false});
        }
    }

    /// That nothing of the first part hides anything of the second.
    void check_sequence(const Task& task, const Polygons& front, const Polygons& back) {
        ProvedPairs proved_pairs = proved_pairs_at(task);
        const int line = certificate_.line_of(task.child);
        check(task, proved_pairs, [&](std::uint32_t later) {
            return std::ranges::binary_search(back, later) ? std::optional(std::span(front))
                                                           : std::nullopt;
        });
        painted_check_.require_layer_order(front, back, line);
        PolygonSet painted(certificate_.polygons.size());
        for (const std::uint32_t polygon : front) {
            painted.add(polygon);
        }
        for (const std::uint32_t later : back) {
            require_decided(proved_pairs, painted, front, later, line);
        }
        verdict_.pairs += front.size() * back.size();
    }

    /// Checks what is claimed about pairs.
    void check(const Task& task, ProvedPairs& proved_pairs, const EarlierOf& earlier_of) {
        check_statements(
            pair_check_,
            certificate_.statements_of(task.child),
            task.region_planes,
            earlier_of,
            proved_pairs,
            verdict_.claims);
    }

    static std::uint64_t pairs_among(std::size_t polygons) {
        return polygons < 2 ? 0 : polygons * (polygons - 1) / 2;
    }

    /// What the nodes above and the last wall prove for the eyes of a part.
    ProvedPairs proved_pairs_at(const Task& task) const {
        ProvedPairs proved_pairs = task.known ? *task.known : ProvedPairs(certificate_.polygons.size());
        if (task.adds_wall) {
            proved_pairs.add_region_plane(task.region_planes.back(), certificate_, sides_);
        }
        return proved_pairs;
    }

    /// The same for what is below a node that is no choice; null where nothing is known.
    std::shared_ptr<const ProvedPairs> known_below(const Task& task) const {
        return task.adds_wall ? std::make_shared<const ProvedPairs>(proved_pairs_at(task)) : task.known;
    }

    void require_decided(
        const ProvedPairs& proved_pairs,
        const PolygonSet& painted,
        std::span<const std::uint32_t> earlier,
        std::uint32_t later,
        int line) const {
        if (!earlier.empty() && !proved_pairs.decide(painted, later)) {
            throw InvalidCertificate{
                line,
                fmt::format(
                    "expected a proof that polygon {} hides nothing of polygon {}, got none",
                    proved_pairs.first_open(earlier, later),
                    later)};
        }
    }

    /// Two parts of what a parting parts.
    using TwoParts = std::pair<const Polygons&, const Polygons&>;

    /// That the plane of a parting parts, and that what lies in it faces as it should.
    void check_parting(
        const OrderNode& node, const Statements& claims, const TwoParts& beside, const TwoParts& is_subset_of) {
        const auto& [front, back] = beside;
        const auto& [coplanar_front, coplanar_back] = is_subset_of;
        const auto expect = [&](std::uint32_t polygon, bool good, const char* expected) {
            if (!good && !claims.unproved.contains(polygon)) {
                throw InvalidCertificate{
                    node.line,
                    fmt::format(
                        "expected polygon {} {} the plane, got a corner elsewhere",
                        polygon,
                        expected)};
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
        const std::uint64_t pairs = front.size() * back.size() +
                                    (front.size() + back.size()) * (coplanar_front.size() + coplanar_back.size());
        verdict_.by_node_planes += pairs;
        verdict_.pairs += pairs;
    }

    /// That polygons lie in a plane, and face as it does unless they are painted for both sides.
    template <typename Expect>
    void check_facing(
        const Polygons& polygons,
        const Polygons& others,
        const WrittenPlane& plane,
        Expect expect) const {
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

    const Certificate& certificate_;
    const std::function<void(std::size_t, std::size_t)>& progress_;
    ExactSides sides_;
    PairCheck pair_check_;
    PaintedCheck painted_check_;
    TreeContents contents_;
    VerificationResult verdict_;
};

} // namespace

VerificationResult verify(
    const Certificate& certificate, const std::function<void(std::size_t, std::size_t)>& progress) {
    return Verifier(certificate, progress).result();
}

} // namespace octant::visuals::verify
