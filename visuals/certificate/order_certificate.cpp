#include "visuals/certificate/order_certificate.h"

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/hash.h"
#include "sim/base/text_file.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/proof_walk.h"
#include "visuals/separation/separating_plane_proof.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::visuals::certificate {

namespace {

using draworder::DrawOrder;
using models::polygons::FileAxes;
using separation::DecidingPolygon;
using separation::LocalModel;
using separation::LocalPolygon;
using separation::PlaneFactors;
using separation::SeparatingPlaneProof;

std::string text_of(const glm::dvec3& v) {
    return fmt::format("{} {} {}", v.x + 0.0, v.y + 0.0, v.z + 0.0); // no negative zeros
}

std::string text_of(const Plane& plane) { return fmt::format("{} {}", text_of(plane.normal), plane.offset_m + 0.0); }

std::string text_of_child(int child, const char* if_nothing = " nothing") {
    return child == DrawOrder::no_child ? if_nothing
           : child < 0                  ? fmt::format(" list {}", ~child)
                                        : fmt::format(" node {}", child);
}

template <typename... Values>
void append(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
    text += fmt::format(format, std::forward<Values>(values)...);
}

/// Calls visit(child) for each node and list: a node before its children, and these in the order of its line.
template <typename Visit>
void for_each_part(const DrawOrder& order, const Visit& visit) {
    std::vector<int> pending{order.nodes().empty() ? ~0 : 0};
    while (!pending.empty()) {
        const int part = pending.back();
        pending.pop_back();
        if (part == DrawOrder::no_child) { continue; }
        visit(part);
        if (part < 0) { continue; }
        const DrawOrder::Node& node = order.nodes()[static_cast<std::size_t>(part)];
        const bool parts = node.kind == DrawOrder::Kind::PolygonSplit;
        if (parts) { pending.insert(pending.end(), {node.coplanar_back, node.coplanar_front}); }
        pending.insert(pending.end(), {node.back, node.front});
    }
}

/// The lines of a certificate; visuals/verify/certificate-format.md says what each means.
class CertificateText : public draworder::ProofVisitor {
public:
    /// `size_m` is the length that is 1 in a LocalModel; `on_part_done` is called after each node and list.
    CertificateText(double size_m, std::function<void()> on_part_done)
        : size_m_(size_m), on_part_done_(std::move(on_part_done)) {}

    /// The header, corners, axes and polygons.
    void add_model(const models::polygons::PolygonModel& model, const LocalModel& local, const FileAxes& axes,
        const CertifiedModel& bound_to) {
        append(text_, "octant-certificate 2\n");
        std::string name = one_line(bound_to.name);
        std::ranges::replace_if(
            name, [](char letter) { return letter == '\\' || letter == '#'; }, '_');
        append(text_, "model {} {}\n", bound_to.hash, name);
        constexpr double rounded_up = 1.005; // so that the proofs found hold with three digits of it
        append(text_, "tolerance {:.2e}\n", rounded_up * local.tolerance * size_m_);
        const auto place = [&](const glm::dvec3& point_m) {
            return text_of(axes.file_from_body(point_m) - local.reference_m);
        };
        if (local.reference_m != glm::dvec3(0.0)) { append(text_, "about {}\n", text_of(local.reference_m)); }
        for (const glm::dvec3& vertex_m : model.vertices_m) { append(text_, "vertex {}\n", place(vertex_m)); }
        for (const models::polygons::Pivot& pivot : model.pivots) {
            append(text_, "axis {} {}\n", place(pivot.point_m), text_of(axes.file_from_body(pivot.axis)));
        }
        for (std::size_t i = 0; i < model.polygons.size(); ++i) {
            const LocalPolygon& polygon = local.polygons[i];
            append(text_, "{} {} {}", polygon.axis ? fmt::format("turning {}", *polygon.axis) : "polygon",
                model.parent_of(i), text_of(local.in_metres(polygon.plane)));
            add_numbers(model.corners(i));
        }
    }

    /// The lists and nodes. Where a view split has nothing on a side, the line says `unclaimed` for its eyes.
    void add_tree(const DrawOrder& order, const LocalModel& local, const FileAxes& axes) {
        for (int list = 0; list < order.cell_count(); ++list) {
            text_ += "list";
            add_numbers(order.polygons_of(list));
        }
        for_each_part(order, [&](int part) { order_of_parts_.push_back(part); });
        for (const DrawOrder::Node& node : order.nodes()) {
            const bool is_choice = node.kind == DrawOrder::Kind::ViewSplit;
            const char* const if_nothing = is_choice ? " unclaimed" : " nothing";
            const std::string children = text_of_child(node.front, if_nothing) + text_of_child(node.back, if_nothing);
            if (node.kind == DrawOrder::Kind::Sequence) {
                append(text_, "node sequence{}\n", children);
                continue;
            }
            const bool parts = node.kind == DrawOrder::Kind::PolygonSplit;
            append(text_, "node {} {}{}{}\n", parts ? "parting" : "choice",
                text_of(local.about({axes.file_from_body(node.plane.normal), node.plane.offset_m})), children,
                parts ? text_of_child(node.coplanar_front) + text_of_child(node.coplanar_back) : "");
        }
    }

    void begin_pairs(int part, std::uint32_t later, std::size_t /*count*/) override {
        row_.clear();
        append(row_, "pairs{} {}", text_of_child(part), later);
        row_part_ = part;
        row_line_ = 0;
        run_length_ = 0;
        is_any_decided_ = false;
    }

    void add_pair(DecidingPolygon by) override {
        if (by != run_by_) {
            add_run();
            run_by_ = by;
        }
        ++run_length_;
    }

    /// A row that decides nothing is left out.
    void end_pairs() override {
        add_run();
        if (is_any_decided_) { statements_[row_part_] += row_ + '\n'; }
    }

    void add_plane_proof(
        int part, const SeparatingPlaneProof& plane_proof, std::uint32_t earlier, std::uint32_t later) override {
        const std::string where = fmt::format("{} {} {}", text_of_child(part), earlier, later);
        std::string& text = statements_[part];
        if (plane_proof.kind == SeparatingPlaneProof::Kind::None) {
            append(text, "unproved{}\n", where);
            ++unproved_;
            return;
        }
        append(text, "{}{} {} {}", plane_proof.kind == SeparatingPlaneProof::Kind::Sum ? "sum" : "never", where,
            plane_proof.factors.earlier, plane_proof.factors.later);
        add_region_planes(plane_proof.factors, text);
    }

    void add_back_facing(int part, std::uint32_t polygon, const PlaneFactors& factors) override {
        std::string& text = statements_[part];
        append(text, "away{} {}", text_of_child(part), polygon);
        add_region_planes(factors, text);
    }

    void add_unproved(int part, std::uint32_t polygon) override {
        append(statements_[part], "unproved{} {}\n", text_of_child(part), polygon);
        ++unproved_;
    }

    void end_part(std::size_t /*polygons*/) override { on_part_done_(); }

    /// All lines, which are taken away: the statements of each part together, in the order of the tree.
    std::string take() {
        for (const int part : order_of_parts_) {
            if (const auto found = statements_.find(part); found != statements_.end()) {
                text_ += found->second;
                statements_.erase(found);
            }
        }
        return std::move(text_);
    }

    /// Pairs and polygons for which no proof was found.
    std::uint64_t unproved() const { return unproved_; }

private:
    void add_run() {
        if (run_length_ > 0) {
            const char letter = run_by_ == DecidingPolygon::Earlier ? 'e'
                                : run_by_ == DecidingPolygon::Later ? 'l'
                                                                    : '-';
            constexpr std::size_t bytes_of_line = 32768; // then it goes on in the next one behind a backslash
            if (row_.size() - row_line_ > bytes_of_line) {
                row_ += " \\\n";
                row_line_ = row_.size();
            }
            append(row_, " {}{}", run_length_, letter);
            is_any_decided_ = is_any_decided_ || letter != '-';
            run_length_ = 0;
        }
    }

    /// A long line goes on in the next one behind a backslash.
    void add_numbers(std::span<const std::uint32_t> numbers) {
        constexpr std::size_t numbers_of_line = 4096;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            append(text_, "{} {}", i > 0 && i % numbers_of_line == 0 ? " \\\n" : "", numbers[i]);
        }
        text_ += '\n';
    }

    /// The factor of 1, which is a length, and those of region planes that are not 0.
    void add_region_planes(const PlaneFactors& factors, std::string& text) const {
        append(text, " {}", factors.one * size_m_ + 0.0);
        for (std::size_t i = 0; i < factors.region_planes.size(); ++i) {
            if (factors.region_planes[i] != 0.0) { append(text, " {}:{}", i, factors.region_planes[i]); }
        }
        text += '\n';
    }

    double size_m_;
    std::function<void()> on_part_done_;
    std::string text_;
    std::map<int, std::string> statements_; ///< by part
    std::vector<int> order_of_parts_;
    std::string row_;
    int row_part_ = 0;
    std::size_t row_line_ = 0;    ///< where its last line begins
    bool is_any_decided_ = false; ///< of row_
    std::uint64_t unproved_ = 0;
    separation::DecidingPolygon run_by_ = separation::DecidingPolygon::Neither;
    std::size_t run_length_ = 0;
};

} // namespace

std::string model_hash(const models::polygons::PolygonModel& model, const FileAxes& axes) {
    Hash hash;
    const auto add = [&](const glm::dvec3& v) {
        for (const double number : {v.x + 0.0, v.y + 0.0, v.z + 0.0}) { // no negative zeros
            hash.add_word(std::bit_cast<std::uint64_t>(number));
        }
    };
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto pivot = models::polygons::pivot_of(model, i);
        hash.add_word(model.polygons[i].corner_count);
        hash.add_word(pivot ? *pivot + 1 : 0);
        for (const std::uint32_t vertex : model.corners(i)) { add(axes.file_from_body(model.vertices_m[vertex])); }
    }
    for (const models::polygons::Pivot& pivot : model.pivots) {
        add(axes.file_from_body(pivot.point_m));
        add(axes.file_from_body(pivot.axis));
    }
    return fmt::format("{:016x}", hash.value());
}

OrderCertificate order_certificate(const models::polygons::PolygonModel& model, const draworder::DrawOrder& order,
    const FileAxes& axes, const CertifiedModel& bound_to, const CertificateProgress& progress) {
    const std::size_t parts = order.nodes().size() + static_cast<std::size_t>(order.cell_count());
    OrderCertificate best;
    for (const double tolerance : separation::proof_tolerances_sizes) {
        const separation::LocalModel local = separation::local_model(model, axes, tolerance);
        CertificateText text(local.size_m, [&, done = std::size_t{0}]() mutable {
            if (progress) { progress(++done, parts); }
        });
        text.add_model(model, local, axes, bound_to);
        text.add_tree(order, local, axes);
        draworder::visit_proof({model, order, axes, local}, text);
        OrderCertificate made{text.take(), text.unproved()};
        if (best.text.empty() || made.unproved < best.unproved) { best = std::move(made); }
        if (best.unproved == 0) { break; }
    }
    return best;
}

} // namespace octant::visuals::certificate
