// Reads progressive meshes (layout in progressive_layout.h). Files come from outside, so every number is checked before
// it is used: blocks by their checksums, counts against each other and against the bytes that are there, and the
// hierarchy itself by ProgressiveTree. A file that ends early is still of use, because its splits come coarsest first.
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/progressive_layout.h"
#include "visuals/refine/progressive_tree.h"
#include "visuals/refine/varint_coder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <span>
#include <utility>

namespace octant::visuals::refine {

namespace {

/// The counts in a file's first block.
struct Head {
    std::uint64_t file_bytes = 0;
    std::uint32_t leaves = 0;
    std::uint32_t splits = 0;
    std::uint32_t faces = 0;
    std::uint32_t roots = 0;
    std::uint8_t flags = 0;
};

/// The reading of one file, with its position for messages.
class ProgressiveReader {
public:
    explicit ProgressiveReader(const std::filesystem::path& path) : path_(path) {
        std::error_code fault;
        if (!std::filesystem::is_regular_file(path, fault)) { throw_error_in(path, "expected a file, found none"); }
        file_bytes_ = std::filesystem::file_size(path, fault);
        file_.open(path, std::ios::binary);
        if (fault || !file_) { throw_error_in(path, "expected a file that can be read"); }
    }

    ProgressiveMesh read(std::size_t max_vertices) {
        read_signature();
        const auto head_block = next_block();
        if (!head_block) { refuse("expected a head, got the end of the file"); }
        read_head(*head_block);
        const auto base_block = next_block();
        if (!base_block) { refuse("expected the base mesh, got the end of the file"); }
        read_base(*base_block);
        const std::size_t wanted =
            std::min<std::size_t>(head_.splits, max_vertices - std::min<std::size_t>(max_vertices, head_.roots));
        const bool whole_splits = read_splits(wanted);
        if (whole_splits && wanted == head_.splits) {
            keep(tree_.is_complete(head_.leaves, head_.faces));
            read_numbers();
        }
        ProgressiveMeshData parts = tree_.parts();
        if ((head_.flags & has_colours) == 0) { parts.colours = {}; }
        if ((head_.flags & has_materials) == 0) { parts.face_materials = {}; }
        parts.name = name_;
        parts.origin_m = origin_m_;
        parts.materials = materials_;
        if (file_bytes_ < head_.file_bytes && !(whole_splits && wanted < head_.splits)) {
            parts.notes.push_back(fmt::format("{}: cut off at byte {} of {}: {} of {} splits are whole", path_.string(),
                file_bytes_, head_.file_bytes, tree_.split_count(), head_.splits));
        }
        return ProgressiveMesh(std::move(parts));
    }

private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw_error_in(path_, fmt::format("{} at byte {}", what, at_));
    }

    void read_signature() {
        std::string mark(progressive_signature.size(), '\0');
        file_.read(mark.data(), static_cast<std::streamsize>(mark.size()));
        if (!file_ || mark != progressive_signature) {
            refuse("expected a progressive mesh of Octant, got something else");
        }
        at_ = mark.size();
    }

    /// The bytes of the next block; nothing where the file ends before the block does. Throws Error for a block whose
    /// checksum is wrong.
    std::optional<std::string> next_block() {
        const std::uint64_t left = file_bytes_ - std::min(file_bytes_, at_);
        std::string frame(4, '\0');
        if (left < block_header_bytes) { return truncated(); }
        file_.read(frame.data(), 4);
        const auto count = VarintReader(frame).take<std::uint32_t>();
        if (count > left - block_header_bytes) { return truncated(); }
        std::string bytes(count, '\0');
        file_.read(bytes.data(), static_cast<std::streamsize>(count));
        std::string sum(8, '\0');
        file_.read(sum.data(), 8);
        if (!file_ || VarintReader(sum).take<std::uint64_t>() != checksum_of(bytes)) {
            refuse("expected a whole block, got a wrong checksum");
        }
        at_ += count + block_header_bytes;
        return bytes;
    }

    /// Returns nothing for a file shorter than its head says. Throws Error for a whole file with a block that reaches
    /// beyond its end.
    std::optional<std::string> truncated() {
        if (head_.file_bytes != 0 && file_bytes_ >= head_.file_bytes) {
            refuse("expected a block, got one longer than the file");
        }
        return std::nullopt;
    }

    void read_head(const std::string& block) {
        VarintReader in(block);
        const auto version = in.take<std::uint32_t>();
        if (version != progressive_version) {
            refuse(fmt::format("expected version {}, got {}", progressive_version, version));
        }
        head_.file_bytes = in.take<std::uint64_t>();
        head_.leaves = in.take<std::uint32_t>();
        head_.splits = in.take<std::uint32_t>();
        head_.faces = in.take<std::uint32_t>();
        head_.roots = in.take<std::uint32_t>();
        head_.flags = in.take<std::uint8_t>();
        origin_m_ = in.take<glm::dvec3>();
        name_ = in.take_text();
        const std::uint64_t materials = in.take_varint();
        for (std::uint64_t i = 0; i < materials && in.good(); ++i) {
            models::Material material;
            material.name = in.take_text();
            material.colour = in.take<glm::vec3>();
            materials_.push_back(material);
        }
        const bool fits = static_cast<std::uint64_t>(head_.roots) + head_.splits == head_.leaves;
        if (!in.good() || in.left() > 0 || !fits || !std::isfinite(origin_m_.x) || !std::isfinite(origin_m_.y) ||
            !std::isfinite(origin_m_.z)) {
            refuse("expected a head, got numbers that do not fit together");
        }
        if (head_.leaves > ProgressiveMesh::max_leaves || head_.faces > ProgressiveMesh::max_faces) {
            refuse(fmt::format("expected at most {} vertices and {} faces, got {} and {}", ProgressiveMesh::max_leaves,
                ProgressiveMesh::max_faces, head_.leaves, head_.faces));
        }
        if (file_bytes_ > head_.file_bytes) {
            throw_error_in(path_, fmt::format("expected {} bytes, got {}", head_.file_bytes, file_bytes_));
        }
    }

    TreeNode take_node(VarintReader& in) const {
        TreeNode node;
        node.position_m = in.take<glm::vec3>();
        node.normal = in.take<PackedNormal>();
        if ((head_.flags & has_colours) != 0) { node.colour = in.take<PackedColour>(); }
        return node;
    }

    /// Reads a face whose corners were written as differences from leaf `near`.
    TreeFace take_face(VarintReader& in, std::uint32_t near) const {
        TreeFace face;
        for (std::uint32_t& corner : face.corners) { corner = in.take_delta(near); }
        if ((head_.flags & has_materials) != 0) {
            const std::uint32_t material = in.take_varint32();
            if (material >= materials_.size() || material > 65535) {
                refuse("expected a material of the file, got another one");
            }
            face.material = static_cast<std::uint16_t>(material);
        }
        return face;
    }

    void read_base(const std::string& block) {
        VarintReader in(block);
        for (std::uint32_t i = 0; i < head_.roots && in.good(); ++i) {
            const std::uint32_t begin = in.take_varint32();
            const std::uint32_t leaves = in.take_varint32();
            TreeNode root = take_node(in);
            root.begin = begin;
            root.end = begin + std::min(leaves, none - begin);
            keep(tree_.add_root(root) && root.end <= head_.leaves && in.good());
        }
        keep(in.good() && tree_.roots_cover_leaves(head_.leaves));
        const std::uint64_t faces = in.take_varint();
        for (std::uint64_t i = 0; i < faces && in.good(); ++i) { keep(tree_.add_base_face(take_face(in, 0))); }
        keep(in.good() && in.left() == 0);
    }

    /// Reads the first `wanted` splits. Returns false where the file was cut off before them.
    bool read_splits(std::size_t wanted) {
        while (tree_.split_count() < wanted) {
            const auto block = next_block();
            if (!block) { return false; }
            VarintReader in(*block);
            const std::size_t in_block = std::min<std::size_t>(splits_per_block, head_.splits - tree_.split_count());
            const std::size_t end = std::min(wanted, tree_.split_count() + in_block);
            while (tree_.split_count() < end) { take_split(in); }
            keep(end < head_.splits || in.left() == 0);
        }
        return true;
    }

    void take_split(VarintReader& in) {
        TreeSplit split;
        split.begin = in.take_varint32();
        split.middle = split.begin + std::min(in.take_varint32(), none - split.begin);
        split.error_m = in.take<float>();
        split.first = take_node(in);
        split.second = take_node(in);
        const auto sides = in.take<std::uint8_t>();
        if ((sides & has_left_face) != 0) { split.left = take_face(in, split.begin); }
        if ((sides & has_right_face) != 0) { split.right = take_face(in, split.begin); }
        keep(in.good() && tree_.add_split(split));
    }

    void read_numbers() {
        const auto block = next_block();
        if (!block) {
            // The file was cut off just before this block; the leaves then count as they come.
            return;
        }
        VarintReader in(*block);
        std::uint32_t last = 0;
        const auto take = [&] { return last = in.take_delta(last); };
        std::vector<std::uint32_t> vertices(head_.leaves);
        std::ranges::generate(vertices, take);
        std::vector<std::uint32_t> faces(head_.faces);
        std::ranges::generate(faces, take);
        keep(in.good() && in.left() == 0 && tree_.number(std::move(vertices), std::move(faces)));
    }

    /// Throws Error when a promise of the format is broken.
    void keep(bool promise) const {
        if (!promise) { refuse("expected a progressive mesh, got one that does not hold together"); }
    }

    std::filesystem::path path_;
    std::ifstream file_;
    std::uint64_t file_bytes_ = 0;
    std::uint64_t at_ = 0;
    Head head_;
    std::string name_;
    glm::dvec3 origin_m_{0.0};
    std::vector<models::Material> materials_;
    ProgressiveTree tree_;
};

} // namespace

ProgressiveMesh read_progressive(const std::filesystem::path& path, std::size_t max_vertices) {
    return ProgressiveReader(path).read(max_vertices);
}

} // namespace octant::visuals::refine
