// Writes progressive meshes (layout in progressive_layout.h): the base mesh first, then the vertex splits coarsest
// first, so that any prefix of the file is a coarser model.
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/progressive_layout.h"
#include "visuals/refine/varint_coder.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace octant::visuals::refine {

namespace {

/// The bytes of one file while they are put together.
class ProgressiveWriter {
public:
    explicit ProgressiveWriter(const ProgressiveMesh& mesh)
        : mesh_(mesh), is_base_(mesh.base_faces()), order_(mesh.coarsest_first()) {}

    std::string text() {
        add_block(base());
        VarintWriter block;
        std::size_t in_block = 0;
        for (const std::uint32_t node : order_) {
            put_split(block, node);
            if (++in_block == splits_per_block) {
                add_block(block.bytes());
                block.bytes().clear();
                in_block = 0;
            }
        }
        if (in_block > 0) { add_block(block.bytes()); }
        add_block(numbers());
        const std::size_t head_bytes = head(0).size() + block_header_bytes;
        const std::string blocks = std::move(text_);
        text_ = progressive_signature;
        add_block(head(text_.size() + head_bytes + blocks.size()));
        return text_ + blocks;
    }

private:
    void add_block(const std::string& bytes) {
        VarintWriter frame;
        frame.put(static_cast<std::uint32_t>(bytes.size()));
        text_ += frame.bytes() + bytes;
        frame.bytes().clear();
        frame.put(checksum_of(bytes));
        text_ += frame.bytes();
    }

    /// The first block. `file_bytes` is the length of the whole file; the block's own length does not depend on it.
    std::string head(std::uint64_t file_bytes) const {
        const ProgressiveMeshData& parts = mesh_.parts();
        VarintWriter out;
        out.put(progressive_version);
        out.put(file_bytes);
        out.put(static_cast<std::uint32_t>(mesh_.leaf_count()));
        out.put(static_cast<std::uint32_t>(order_.size()));
        out.put(static_cast<std::uint32_t>(mesh_.face_count()));
        out.put(static_cast<std::uint32_t>(mesh_.roots().size()));
        out.put(static_cast<std::uint8_t>(
            (mesh_.has_colours() ? has_colours : 0) | (parts.face_materials.empty() ? 0 : has_materials)));
        out.put(parts.origin_m);
        out.put_text(parts.name);
        out.put_varint(parts.materials.size());
        for (const models::Material& material : parts.materials) {
            out.put_text(material.name);
            out.put(material.colour);
        }
        return out.bytes();
    }

    void put_node(VarintWriter& out, std::uint32_t node) const {
        out.put(mesh_.position_m(node));
        out.put(mesh_.packed_normal(node));
        if (mesh_.has_colours()) { out.put(mesh_.packed_colour(node)); }
    }

    /// Writes a face's corners as differences from leaf `near`, which makes them short.
    void put_face(VarintWriter& out, std::uint32_t face, std::uint32_t near) const {
        for (const std::uint32_t corner : mesh_.faces()[face]) { out.put_delta(corner, near); }
        if (!mesh_.parts().face_materials.empty()) { out.put_varint(mesh_.parts().face_materials[face]); }
    }

    std::string base() const {
        VarintWriter out;
        const auto roots = mesh_.roots();
        std::vector<std::uint32_t> begins;
        for (const std::uint32_t root : roots) { begins.push_back(mesh_.first_leaf(root)); }
        std::ranges::sort(begins);
        begins.push_back(static_cast<std::uint32_t>(mesh_.leaf_count()));
        for (const std::uint32_t root : roots) {
            const auto at = std::ranges::lower_bound(begins, mesh_.first_leaf(root));
            out.put_varint(*at);
            out.put_varint(*std::next(at) - *at);
            put_node(out, root);
        }
        const auto inner = std::ranges::count(is_base_, true);
        out.put_varint(static_cast<std::uint64_t>(inner));
        for (std::uint32_t face = 0; face < is_base_.size(); ++face) {
            if (is_base_[face]) { put_face(out, face, 0); }
        }
        return out.bytes();
    }

    void put_split(VarintWriter& out, std::uint32_t node) const {
        const VertexSplit split = mesh_.split_of(node);
        const std::uint32_t begin = mesh_.first_leaf(node);
        const std::uint32_t middle = mesh_.first_leaf(split.second);
        out.put_varint(begin);
        out.put_varint(middle - begin);
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
        VarintWriter out;
        std::uint32_t last = 0;
        const auto put = [&](std::uint32_t number) {
            out.put_delta(number, last);
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
        return out.bytes();
    }

    const ProgressiveMesh& mesh_;
    std::vector<bool> is_base_;
    std::vector<std::uint32_t> order_; ///< All inner nodes, coarsest first.
    std::string text_;
};

} // namespace

bool is_progressive_file(const std::filesystem::path& path) { return extension_of(path) == ".pm"; }

void write_progressive(const std::filesystem::path& path, const ProgressiveMesh& mesh) {
    write_file(path, ProgressiveWriter(mesh).text());
}

} // namespace octant::visuals::refine
