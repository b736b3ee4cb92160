#include "visuals/certificate/order_certificate.h"

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/proof_walk.h"
#include "visuals/separation/separating_plane_proof.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// Takes the text of a certificate, piece by piece.
using TextSink = std::function<void(std::string_view)>;

/// Texts that come in any order, by the parts that they belong to. What is more than a few MiB waits in a temporary
/// file without a name.
class TextsByPart {
public:
    void add(int part, std::string_view text) {
        waiting_[part] += text;
        waiting_bytes_ += text.size();
        constexpr std::size_t most_bytes = std::size_t{4} << 20U;
        if (waiting_bytes_ > most_bytes) { move_to_file(); }
    }

    /// Gives all texts of a part in the order in which they came.
    void give(int part, const TextSink& sink) {
        std::string text;
        for (const Piece& piece : pieces_[part]) {
            text.resize(piece.bytes);
            const bool is_read = std::fseek(file_.get(), piece.offset, SEEK_SET) == 0 &&
                                 std::fread(text.data(), 1, text.size(), file_.get()) == text.size();
            if (!is_read) { refuse_file(); }
            sink(text);
        }
        if (const auto found = waiting_.find(part); found != waiting_.end()) { sink(found->second); }
    }

private:
    struct Piece {
        long offset = 0;
        std::size_t bytes = 0;
    };

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    [[noreturn]] static void refuse_file() {
        throw Error(fmt::format("a temporary file cannot be written or read: {}", std::strerror(errno)));
    }

    void move_to_file() {
        if (file_ == nullptr) { file_.reset(std::tmpfile()); }
        if (file_ == nullptr) { refuse_file(); }
        for (const auto& [part, text] : waiting_) {
            if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) { refuse_file(); }
            pieces_[part].push_back({offset_, text.size()});
            offset_ += static_cast<long>(text.size());
        }
        waiting_.clear();
        waiting_bytes_ = 0;
    }

    std::map<int, std::string> waiting_;
    std::size_t waiting_bytes_ = 0;
    std::unique_ptr<std::FILE, Close> file_;
    long offset_ = 0;
    std::map<int, std::vector<Piece>> pieces_;
};

/// Thrown where a certificate takes more bytes than it may.
struct TooLong {};

/// The lines of a certificate; visuals/verify/certificate-format.md says what each means.
class CertificateText : public draworder::ProofVisitor {
public:
    /// `size_m` is the length that is 1 in a LocalModel; `on_part_done` is called after each node and list. Throws
    /// TooLong where there are more than `max_bytes`.
    CertificateText(double size_m, std::uint64_t max_bytes, TextSink sink, std::function<void()> on_part_done)
        : size_m_(size_m), max_bytes_(max_bytes), sink_(std::move(sink)), on_part_done_(std::move(on_part_done)) {}

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
        for (const glm::dvec3& vertex_m : model.vertices_m) {
            append(text_, "vertex {}\n", place(vertex_m));
            give_long_text();
        }
        for (const models::polygons::Pivot& pivot : model.pivots) {
            append(text_, "axis {} {}\n", place(pivot.point_m), text_of(axes.file_from_body(pivot.axis)));
        }
        for (std::size_t i = 0; i < model.polygons.size(); ++i) {
            const LocalPolygon& polygon = local.polygons[i];
            append(text_, "{} {} {}", polygon.axis ? fmt::format("turning {}", *polygon.axis) : "polygon",
                model.parent_of(i), text_of(local.in_metres(polygon.plane)));
            add_numbers(model.corners(i));
            give_long_text();
        }
    }

    /// The lists and nodes. Where a view split has nothing on a side, the line says `unclaimed` for its eyes.
    void add_tree(const DrawOrder& order, const LocalModel& local, const FileAxes& axes) {
        for (int list = 0; list < order.cell_count(); ++list) {
            text_ += "list";
            add_numbers(order.polygons_of(list));
            give_long_text();
        }
        for_each_part(order, [&](int part) { order_of_parts_.push_back(part); });
        for (const DrawOrder::Node& node : order.nodes()) {
            give_long_text();
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
        if (is_any_decided_) { add_statement(row_part_, row_ + '\n'); }
    }

    void add_plane_proof(
        int part, const SeparatingPlaneProof& plane_proof, std::uint32_t earlier, std::uint32_t later) override {
        const std::string where = fmt::format("{} {} {}", text_of_child(part), earlier, later);
        std::string text;
        if (plane_proof.kind == SeparatingPlaneProof::Kind::None) {
            add_statement(part, fmt::format("unproved{}\n", where));
            ++unproved_;
            return;
        }
        append(text, "{}{} {} {}", plane_proof.kind == SeparatingPlaneProof::Kind::Sum ? "sum" : "never", where,
            plane_proof.factors.earlier, plane_proof.factors.later);
        add_region_planes(plane_proof.factors, text);
        add_statement(part, text);
    }

    void add_back_facing(int part, std::uint32_t polygon, const PlaneFactors& factors) override {
        std::string text = fmt::format("away{} {}", text_of_child(part), polygon);
        add_region_planes(factors, text);
        add_statement(part, text);
    }

    void add_unproved(int part, std::uint32_t polygon) override {
        add_statement(part, fmt::format("unproved{} {}\n", text_of_child(part), polygon));
        ++unproved_;
    }

    void end_part(std::size_t /*polygons*/) override { on_part_done_(); }

    /// Gives what is left: the statements of each part together, in the order of the tree.
    void finish() {
        give_text();
        for (const int part : order_of_parts_) { statements_.give(part, sink_); }
    }

    std::uint64_t bytes() const { return bytes_; }

    /// Pairs and polygons for which no proof was found.
    std::uint64_t unproved() const { return unproved_; }

private:
    void count(std::size_t bytes) {
        bytes_ += bytes;
        if (bytes_ > max_bytes_) { throw TooLong(); }
    }

    void give_text() {
        count(text_.size());
        sink_(text_);
        text_.clear();
    }

    void give_long_text() {
        constexpr std::size_t long_bytes = std::size_t{1} << 20U;
        if (text_.size() > long_bytes) { give_text(); }
    }

    void add_statement(int part, std::string_view text) {
        count(text.size());
        statements_.add(part, text);
    }

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
    std::uint64_t max_bytes_;
    TextSink sink_;
    std::function<void()> on_part_done_;
    std::string text_; ///< of the model and its order, not yet given
    TextsByPart statements_;
    std::uint64_t bytes_ = 0;
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

namespace {

/// What one search for proofs found.
struct CertificateFigures {
    std::uint64_t bytes = 0;
    std::uint64_t unproved = 0;
};

/// Gives the text of a certificate within a tolerance to a sink. Throws TooLong.
CertificateFigures give_certificate(const CertifiedOrder& proved, double tolerance, std::uint64_t max_bytes,
    const TextSink& sink, const CertificateProgress& progress) {
    const std::size_t parts = proved.order.nodes().size() + static_cast<std::size_t>(proved.order.cell_count());
    const separation::LocalModel local = separation::local_model(proved.model, proved.axes, tolerance);
    CertificateText text(local.size_m, max_bytes, sink, [&, done = std::size_t{0}]() mutable {
        if (progress) { progress(++done, parts); }
    });
    text.add_model(proved.model, local, proved.axes, proved.bound_to);
    text.add_tree(proved.order, local, proved.axes);
    draworder::visit_proof({proved.model, proved.order, proved.axes, local}, text);
    text.finish();
    return {text.bytes(), text.unproved()};
}

constexpr std::uint64_t any_length = std::numeric_limits<std::uint64_t>::max();

} // namespace

OrderCertificate order_certificate(const CertifiedOrder& proved, const CertificateProgress& progress) {
    OrderCertificate best;
    for (const double tolerance : separation::proof_tolerances_sizes) {
        OrderCertificate made;
        const TextSink sink = [&](std::string_view text) { made.text += text; };
        made.unproved = give_certificate(proved, tolerance, any_length, sink, progress).unproved;
        if (best.text.empty() || made.unproved < best.unproved) { best = std::move(made); }
        if (best.unproved == 0) { break; }
    }
    return best;
}

WrittenCertificate write_order_certificate(const std::filesystem::path& file, const CertifiedOrder& proved,
    std::uint64_t max_bytes, const CertificateProgress& progress) {
    if (path_exists(file) && !is_file(file)) { // a device or a pipe, which nothing can replace
        const OrderCertificate made = order_certificate(proved, progress);
        const bool is_too_long = made.text.size() > max_bytes;
        if (!is_too_long) { write_file(file, made.text); }
        return {made.text.size(), made.unproved, is_too_long};
    }
    std::optional<WrittenCertificate> best;
    for (const double tolerance : separation::proof_tolerances_sizes) {
        try {
            WholeFile text(file);
            const CertificateFigures made = give_certificate(
                proved, tolerance, max_bytes, [&](std::string_view piece) { text.append(piece); }, progress);
            if (best && made.unproved >= best->unproved) { continue; }
            text.finish();
            best = {made.bytes, made.unproved, false};
        } catch (const TooLong&) {
            if (!best) { return {max_bytes, 0, true}; }
        }
        if (best->unproved == 0) { break; }
    }
    return *best;
}

} // namespace octant::visuals::certificate
