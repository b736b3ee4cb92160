// Writes and reads progressive meshes; progressive_file.h describes the layout.
#include "visuals/refine/progressive_file.h"

#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "visuals/refine/progressive_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace octant::visuals::refine {

namespace {

/// Writes an unsigned number in 7 bits a byte, the lowest bits first (LEB128), so that small numbers take one byte.
void put_varint(BinaryWriter& out, std::uint64_t number) {
    for (; number >= 128; number /= 128) { out.put(static_cast<std::uint8_t>(number % 128 + 128)); }
    out.put(static_cast<std::uint8_t>(number));
}

std::uint64_t take_varint(BinaryReader& in, std::uint64_t max = ~std::uint64_t{0}) {
    std::uint64_t number = 0;
    for (unsigned shift = 0; shift < 63; shift += 7) {
        const auto byte = in.take<std::uint8_t>();
        number |= static_cast<std::uint64_t>(byte & 127U) << shift;
        if (byte < 128 && number <= max) { return number; }
        if (byte < 128) { break; }
    }
    in.refuse(fmt::format("a number of at most {} before", max), "a larger one");
}

std::uint32_t take_varint32(BinaryReader& in) { return static_cast<std::uint32_t>(take_varint(in, 0xffffffffU)); }

/// Writes `number` - `from`, which may be negative, with the sign in the lowest bit (zigzag coding) as a varint.
void put_delta(BinaryWriter& out, std::uint32_t number, std::uint32_t from) {
    const std::int64_t difference = static_cast<std::int64_t>(number) - static_cast<std::int64_t>(from);
    put_varint(out, static_cast<std::uint64_t>(difference < 0 ? -2 * difference - 1 : 2 * difference));
}

std::uint32_t take_delta(BinaryReader& in, std::uint32_t from) {
    const std::uint64_t coded = take_varint(in);
    const auto half = static_cast<std::int64_t>(coded / 2);
    const std::int64_t number = static_cast<std::int64_t>(from) + (coded % 2 == 0 ? half : -half - 1);
    in.check(number >= 0 && number <= 0xffffffff, "a number of 32 bits");
    return static_cast<std::uint32_t>(number);
}

void put_text(BinaryWriter& out, std::string_view text) {
    put_varint(out, text.size());
    out.put_bytes(text);
}

std::string take_text(BinaryReader& in) { return std::string(in.take_bytes(take_varint(in), "a text")); }

// Writes progressive meshes (layout in progressive_file.h): the base mesh first, then the vertex splits coarsest first,
// so that any prefix of the file is a coarser model.

/// The bytes of one file while they are put together.
class ProgressiveWriter {
public:
    explicit ProgressiveWriter(const ProgressiveMesh& mesh)
        : mesh_(mesh), is_base_(mesh.base_faces()), order_(mesh.coarsest_first()) {}

    std::string text() {
        BinaryWriter blocks;
        put_block(blocks, base());
        for (std::size_t first = 0; first < order_.size(); first += splits_per_block) {
            BinaryWriter block;
            const std::size_t end = std::min(first + splits_per_block, order_.size());
            for (std::size_t i = first; i < end; ++i) { put_split(block, order_[i]); }
            put_block(blocks, block.bytes());
        }
        put_block(blocks, numbers());
        const std::size_t head_bytes = head(0).size() + block_header_bytes;
        BinaryWriter out;
        out.put_bytes(progressive_signature);
        put_block(out, head(progressive_signature.size() + head_bytes + blocks.size()));
        out.put_bytes(blocks.bytes());
        return out.take();
    }

private:
    static void put_block(BinaryWriter& out, const std::string& bytes) {
        out.put(static_cast<std::uint32_t>(bytes.size()));
        out.put_bytes(bytes);
        out.put(checksum_of(bytes));
    }

    /// The first block. `file_bytes` is the length of the whole file; the block's own length does not depend on it.
    std::string head(std::uint64_t file_bytes) const {
        const ProgressiveMeshData& parts = mesh_.parts();
        BinaryWriter out;
        out.put(progressive_version);
        out.put(file_bytes);
        out.put(static_cast<std::uint32_t>(mesh_.leaf_count()));
        out.put(static_cast<std::uint32_t>(order_.size()));
        out.put(static_cast<std::uint32_t>(mesh_.face_count()));
        out.put(static_cast<std::uint32_t>(mesh_.roots().size()));
        out.put(static_cast<std::uint8_t>(
            (mesh_.has_colours() ? has_colours : 0) | (parts.face_materials.empty() ? 0 : has_materials)));
        out.put(parts.origin_m);
        put_text(out, parts.name);
        put_varint(out, parts.materials.size());
        for (const models::Material& material : parts.materials) {
            put_text(out, material.name);
            out.put(material.colour);
            out.put(material.opacity);
        }
        return out.take();
    }

    void put_node(BinaryWriter& out, std::uint32_t node) const {
        out.put(mesh_.position_m(node));
        out.put(mesh_.packed_normal(node));
        if (mesh_.has_colours()) { out.put(mesh_.packed_colour(node)); }
    }

    /// Writes a face's corners as differences from leaf `near`, which makes them short.
    void put_face(BinaryWriter& out, std::uint32_t face, std::uint32_t near) const {
        for (const std::uint32_t corner : mesh_.faces()[face]) { put_delta(out, corner, near); }
        if (!mesh_.parts().face_materials.empty()) { put_varint(out, mesh_.parts().face_materials[face]); }
    }

    std::string base() const {
        BinaryWriter out;
        const auto roots = mesh_.roots();
        std::vector<std::uint32_t> begins;
        for (const std::uint32_t root : roots) { begins.push_back(mesh_.first_leaf(root)); }
        std::ranges::sort(begins);
        begins.push_back(static_cast<std::uint32_t>(mesh_.leaf_count()));
        for (const std::uint32_t root : roots) {
            const auto at = std::ranges::lower_bound(begins, mesh_.first_leaf(root));
            put_varint(out, *at);
            put_varint(out, *std::next(at) - *at);
            put_node(out, root);
        }
        const auto inner = std::ranges::count(is_base_, true);
        put_varint(out, static_cast<std::uint64_t>(inner));
        for (std::uint32_t face = 0; face < is_base_.size(); ++face) {
            if (is_base_[face]) { put_face(out, face, 0); }
        }
        return out.take();
    }

    void put_split(BinaryWriter& out, std::uint32_t node) const {
        const VertexSplit split = mesh_.split_of(node);
        const std::uint32_t begin = mesh_.first_leaf(node);
        const std::uint32_t middle = mesh_.first_leaf(split.second);
        put_varint(out, begin);
        put_varint(out, middle - begin);
        out.put(split.error_m);
        put_node(out, split.first);
        put_node(out, split.second);
        out.put(static_cast<std::uint8_t>(
            (split.left_face != none ? has_left_face : 0) | (split.right_face != none ? has_right_face : 0)));
        for (const std::uint32_t face : {split.left_face, split.right_face}) {
            if (face != none) { put_face(out, face, begin); }
        }
    }

    /// The last block: the original numbers of leaves and faces, each as the difference from the one before.
    std::string numbers() const {
        BinaryWriter out;
        std::uint32_t last = 0;
        const auto put = [&](std::uint32_t number) {
            put_delta(out, number, last);
            last = number;
        };
        std::ranges::for_each(mesh_.parts().original_vertices, put);
        for (std::uint32_t face = 0; face < is_base_.size(); ++face) {
            if (is_base_[face]) { put(mesh_.original_face(face)); }
        }
        for (const std::uint32_t node : order_) {
            const VertexSplit split = mesh_.split_of(node);
            for (const std::uint32_t face : {split.left_face, split.right_face}) {
                if (face != none) { put(mesh_.original_face(face)); }
            }
        }
        return out.take();
    }

    const ProgressiveMesh& mesh_;
    std::vector<bool> is_base_;
    std::vector<std::uint32_t> order_; ///< All inner nodes, coarsest first.
};

// Reads progressive meshes (layout in progressive_file.h). Files come from outside, so every number is checked before
// it is used: blocks by their checksums, counts against each other and against the bytes that are there, and the
// hierarchy itself by ProgressiveTree. A file that ends early is still of use, because its splits come coarsest first.

/// The counts in a file's first block.
struct Head {
    std::uint64_t file_bytes = 0;
    std::uint32_t leaves = 0;
    std::uint32_t splits = 0;
    std::uint32_t faces = 0;
    std::uint32_t roots = 0;
    std::uint8_t flags = 0;
};

/// The reading of one file's bytes.
class ProgressiveReader {
public:
    ProgressiveReader(std::string_view bytes, const std::filesystem::path& path)
        : path_(path), bytes_(bytes), in_(bytes, path) {}

    ProgressiveMesh read(std::size_t max_vertices) {
        if (!bytes_.starts_with(progressive_signature)) {
            in_.refuse("a progressive mesh of Octant", "something else");
        }
        in_.take_bytes(progressive_signature.size(), "a signature");
        auto head_block = next_block();
        if (!head_block) { in_.refuse("a head", "the end of the file"); }
        read_head(*head_block);
        auto base_block = next_block();
        if (!base_block) { in_.refuse("the base mesh", "the end of the file"); }
        read_base(*base_block);
        const std::size_t wanted =
            std::min<std::size_t>(head_.splits, max_vertices - std::min<std::size_t>(max_vertices, head_.roots));
        const bool whole_splits = read_splits(wanted);
        if (whole_splits && wanted == head_.splits) {
            in_.check(tree_.is_complete(head_.leaves, head_.faces), consistent);
            read_numbers();
        }
        ProgressiveMeshData parts = tree_.parts();
        if ((head_.flags & has_colours) == 0) { parts.colours = {}; }
        if ((head_.flags & has_materials) == 0) { parts.face_materials = {}; }
        parts.name = name_;
        parts.origin_m = origin_m_;
        parts.materials = materials_;
        if (bytes_.size() < head_.file_bytes && !(whole_splits && wanted < head_.splits)) {
            parts.notes.push_back(fmt::format("{}: cut off at byte {} of {}: {} of {} splits are whole", path_.string(),
                bytes_.size(), head_.file_bytes, tree_.split_count(), head_.splits));
        }
        return ProgressiveMesh(std::move(parts));
    }

private:
    static constexpr const char* consistent = "a consistent progressive mesh";

    /// A reader of the next block; nothing where the file ends before the block does. Throws Error for a block whose
    /// checksum is wrong, and for a whole file with a block that reaches beyond its end.
    std::optional<BinaryReader> next_block() {
        const std::size_t left = in_.bytes_left();
        const std::size_t at = in_.at() + sizeof(std::uint32_t);
        const std::size_t count = left < block_header_bytes ? left : in_.take<std::uint32_t>();
        if (left < block_header_bytes || count > left - block_header_bytes) {
            if (head_.file_bytes != 0 && bytes_.size() >= head_.file_bytes) {
                in_.refuse("a block", "one longer than the file");
            }
            return std::nullopt;
        }
        const std::string_view block = in_.take_bytes(count, "a block");
        in_.check(in_.take<std::uint64_t>() == checksum_of(block), "a block and its checksum");
        return BinaryReader(bytes_.substr(0, at + count), path_, at);
    }

    void read_head(BinaryReader& in) {
        const auto version = in.take<std::uint32_t>();
        if (version < 1 || version > progressive_version) {
            in.refuse_at(in.at() - 4, fmt::format("version 1 to {}", progressive_version), std::to_string(version));
        }
        head_.file_bytes = in.take<std::uint64_t>();
        head_.leaves = in.take<std::uint32_t>();
        head_.splits = in.take<std::uint32_t>();
        head_.faces = in.take<std::uint32_t>();
        head_.roots = in.take<std::uint32_t>();
        head_.flags = in.take<std::uint8_t>();
        origin_m_ = in.take<glm::dvec3>();
        name_ = take_text(in);
        const std::uint64_t materials = take_varint(in);
        for (std::uint64_t i = 0; i < materials; ++i) {
            models::Material material;
            material.name = take_text(in);
            material.colour = in.take<glm::vec3>();
            if (version > 1) { material.opacity = in.take<float>(); }
            in.check(material.opacity >= 0.0F && material.opacity <= 1.0F, "an opacity of 0 to 1");
            materials_.push_back(material);
        }
        const bool fits = static_cast<std::uint64_t>(head_.roots) + head_.splits == head_.leaves;
        in.check(fits && std::isfinite(origin_m_.x) && std::isfinite(origin_m_.y) && std::isfinite(origin_m_.z),
            "a consistent head");
        in.expect_end();
        if (head_.leaves > ProgressiveMesh::max_leaves || head_.faces > ProgressiveMesh::max_faces) {
            in.refuse(fmt::format(
                          "at most {} vertices and {} faces", ProgressiveMesh::max_leaves, ProgressiveMesh::max_faces),
                fmt::format("{} and {}", head_.leaves, head_.faces));
        }
        if (bytes_.size() > head_.file_bytes) {
            throw_error_in(path_, fmt::format("expected {} bytes, got {}", head_.file_bytes, bytes_.size()));
        }
    }

    TreeNode take_node(BinaryReader& in) const {
        TreeNode node;
        node.position_m = in.take<glm::vec3>();
        node.normal = in.take<PackedNormal>();
        if ((head_.flags & has_colours) != 0) { node.colour = in.take<PackedColour>(); }
        return node;
    }

    /// Reads a face whose corners were written as differences from leaf `near`.
    TreeFace take_face(BinaryReader& in, std::uint32_t near) const {
        TreeFace face;
        for (std::uint32_t& corner : face.corners) { corner = take_delta(in, near); }
        if ((head_.flags & has_materials) != 0) {
            const std::uint32_t material = take_varint32(in);
            in.check(material < materials_.size() && material <= 65535, "a material of the file");
            face.material = static_cast<std::uint16_t>(material);
        }
        return face;
    }

    void read_base(BinaryReader& in) {
        for (std::uint32_t i = 0; i < head_.roots; ++i) {
            const std::uint32_t begin = take_varint32(in);
            const std::uint32_t leaves = take_varint32(in);
            TreeNode root = take_node(in);
            root.begin = begin;
            root.end = begin + std::min(leaves, none - begin);
            in.check(tree_.add_root(root) && root.end <= head_.leaves, consistent);
        }
        in.check(tree_.roots_cover_leaves(head_.leaves), consistent);
        const std::uint64_t faces = take_varint(in);
        for (std::uint64_t i = 0; i < faces; ++i) { in.check(tree_.add_base_face(take_face(in, 0)), consistent); }
        in.expect_end();
    }

    /// Reads the first `wanted` splits. Returns false where the file was cut off before them.
    bool read_splits(std::size_t wanted) {
        while (tree_.split_count() < wanted) {
            auto block = next_block();
            if (!block) { return false; }
            const std::size_t in_block = std::min<std::size_t>(splits_per_block, head_.splits - tree_.split_count());
            const std::size_t end = std::min(wanted, tree_.split_count() + in_block);
            while (tree_.split_count() < end) { take_split(*block); }
            if (end == head_.splits) { block->expect_end(); }
        }
        return true;
    }

    void take_split(BinaryReader& in) {
        TreeSplit split;
        split.begin = take_varint32(in);
        split.middle = split.begin + std::min(take_varint32(in), none - split.begin);
        split.error_m = in.take<float>();
        split.first = take_node(in);
        split.second = take_node(in);
        const auto sides = in.take<std::uint8_t>();
        if ((sides & has_left_face) != 0) { split.left = take_face(in, split.begin); }
        if ((sides & has_right_face) != 0) { split.right = take_face(in, split.begin); }
        in.check(tree_.add_split(split), consistent);
    }

    void read_numbers() {
        auto block = next_block();
        if (!block) { return; } // The file was cut off just before this block; the leaves then count as they come.
        std::uint32_t last = 0;
        const auto take = [&] { return last = take_delta(*block, last); };
        std::vector<std::uint32_t> vertices(head_.leaves);
        std::ranges::generate(vertices, take);
        std::vector<std::uint32_t> faces(head_.faces);
        std::ranges::generate(faces, take);
        block->expect_end();
        in_.check(tree_.number(std::move(vertices), std::move(faces)), consistent);
    }

    std::filesystem::path path_;
    std::string_view bytes_;
    BinaryReader in_;
    Head head_;
    std::string name_;
    glm::dvec3 origin_m_{0.0};
    std::vector<models::Material> materials_;
    ProgressiveTree tree_;
};

} // namespace

bool is_progressive_file(const std::filesystem::path& path) { return extension_of(path) == ".pm"; }

std::string progressive_bytes(const ProgressiveMesh& mesh) { return ProgressiveWriter(mesh).text(); }

void write_progressive(const std::filesystem::path& path, const ProgressiveMesh& mesh) {
    write_file(path, progressive_bytes(mesh));
}

ProgressiveMesh progressive_mesh(std::string_view bytes, const std::filesystem::path& path, std::size_t max_vertices) {
    return ProgressiveReader(bytes, path).read(max_vertices);
}

ProgressiveMesh read_progressive(const std::filesystem::path& path, std::size_t max_vertices) {
    constexpr std::size_t max_bytes = std::size_t{1} << 31U;
    return progressive_mesh(read_file(path, max_bytes), path, max_vertices);
}

} // namespace octant::visuals::refine
