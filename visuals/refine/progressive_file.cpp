// Writes and reads progressive meshes; progressive_file.h describes the layout.
#include "visuals/refine/progressive_file.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "visuals/refine/progressive_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace octant::visuals::refine {

namespace {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

/// Appends numbers and texts to a string of bytes, little-endian.
class VarintWriter {
public:
    template <class Number>
    void put(const Number& number) {
        static_assert(std::is_trivially_copyable_v<Number>);
        char bytes[sizeof(Number)];
        std::memcpy(bytes, &number, sizeof(Number));
        bytes_.append(bytes, sizeof(Number));
    }

    /// Writes an unsigned number in 7 bits a byte, the lowest bits first (LEB128), so that small numbers take one byte.
    void put_varint(std::uint64_t number) {
        while (number >= 128) {
            bytes_.push_back(static_cast<char>(number % 128 + 128));
            number /= 128;
        }
        bytes_.push_back(static_cast<char>(number));
    }

    /// Writes `number` - `from`, which may be negative, with the sign in the lowest bit (zigzag coding) and then as
    /// put_varint does.
    void put_delta(std::uint32_t number, std::uint32_t from) {
        const std::int64_t difference = static_cast<std::int64_t>(number) - static_cast<std::int64_t>(from);
        put_varint(static_cast<std::uint64_t>(difference < 0 ? -2 * difference - 1 : 2 * difference));
    }

    void put_text(std::string_view text) {
        put_varint(text.size());
        bytes_.append(text);
    }

    std::string& bytes() { return bytes_; }

private:
    std::string bytes_;
};

/// Reads what VarintWriter wrote. It never reads beyond the end: what is asked for there is 0, and good() is false from
/// then on, so that callers may check once after several reads.
class VarintReader {
public:
    explicit VarintReader(std::string_view bytes) : bytes_(bytes) {}

    template <class Number>
    Number take() {
        static_assert(std::is_trivially_copyable_v<Number>);
        Number number{};
        if (bytes_.size() < sizeof(Number)) {
            fail();
            return number;
        }
        std::memcpy(&number, bytes_.data(), sizeof(Number));
        bytes_.remove_prefix(sizeof(Number));
        return number;
    }

    std::uint64_t take_varint() {
        std::uint64_t number = 0;
        for (unsigned shift = 0; shift < 63; shift += 7) {
            const auto byte = take<std::uint8_t>();
            number |= static_cast<std::uint64_t>(byte & 127U) << shift;
            if (byte < 128) { return number; }
        }
        fail();
        return 0;
    }

    /// As take_varint; numbers that need more than 32 bits are an error.
    std::uint32_t take_varint32() {
        const std::uint64_t number = take_varint();
        if (number > 0xffffffffU) {
            fail();
            return 0;
        }
        return static_cast<std::uint32_t>(number);
    }

    std::uint32_t take_delta(std::uint32_t from) {
        const std::uint64_t coded = take_varint();
        const auto half = static_cast<std::int64_t>(coded / 2);
        const std::int64_t number = static_cast<std::int64_t>(from) + (coded % 2 == 0 ? half : -half - 1);
        if (number < 0 || number > 0xffffffff) {
            fail();
            return 0;
        }
        return static_cast<std::uint32_t>(number);
    }

    std::string take_text() {
        const std::uint64_t size = take_varint();
        if (size > bytes_.size()) {
            fail();
            return {};
        }
        std::string text(bytes_.substr(0, size));
        bytes_.remove_prefix(size);
        return text;
    }

    bool good() const { return good_; }

    std::size_t left() const { return bytes_.size(); }

private:
    void fail() {
        good_ = false;
        bytes_ = {};
    }

    std::string_view bytes_;
    bool good_ = true;
};

// Writes progressive meshes (layout in progressive_file.h): the base mesh first, then the vertex splits coarsest first,
// so that any prefix of the file is a coarser model.

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

bool is_progressive_file(const std::filesystem::path& path) { return extension_of(path) == ".pm"; }

void write_progressive(const std::filesystem::path& path, const ProgressiveMesh& mesh) {
    write_file(path, ProgressiveWriter(mesh).text());
}

ProgressiveMesh read_progressive(const std::filesystem::path& path, std::size_t max_vertices) {
    return ProgressiveReader(path).read(max_vertices);
}

} // namespace octant::visuals::refine
