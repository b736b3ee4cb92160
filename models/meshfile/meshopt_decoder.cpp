// The bit streams of glTF's EXT_meshopt_compression, as its specification describes them.
#include "models/meshfile/meshopt_decoder.h"

#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <span>
#include <utility>
#include <vector>

namespace octant::models::meshfile {

namespace {

/// Packed bytes, read from the front.
class PackedBytes {
public:
    explicit PackedBytes(std::string_view bytes) : bytes_(bytes) {}

    std::uint8_t byte() {
        if (at_ == bytes_.size()) { throw Error("expected packed bytes, got their end"); }
        return static_cast<std::uint8_t>(bytes_[at_++]);
    }

    std::string_view take(std::size_t count) {
        if (count > bytes_.size() - at_) {
            throw Error(fmt::format("expected {} packed bytes, got {}", count, bytes_.size() - at_));
        }
        at_ += count;
        return bytes_.substr(at_ - count, count);
    }

    /// Seven bits a byte, the lowest first.
    std::uint32_t variable() {
        std::uint32_t value = 0;
        for (unsigned shift = 0; shift < 35; shift += 7) {
            const std::uint32_t next = byte();
            value |= (next & 0x7fU) << shift;
            if (next < 0x80U) { return value; }
        }
        throw Error("expected a number of at most five packed bytes, got a longer one");
    }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

/// 0, -1, 1, -2, 2 ... of 0, 1, 2, 3, 4 ..., as a two's complement.
std::uint32_t unzigzag(std::uint32_t value) { return (value >> 1U) ^ (0U - (value & 1U)); }

constexpr std::size_t meshopt_group = 16;

/// Sixteen differences of one byte of neighbouring elements; `mode` 0: all are zero, else they have 2, 4 or 8 bits,
/// where the largest number of 2 or 4 bits stands for a whole byte that follows.
void take_group(PackedBytes& in, unsigned mode, std::span<std::uint8_t, meshopt_group> out) {
    std::ranges::fill(out, std::uint8_t{0});
    if (mode == 0) { return; }
    const unsigned bits = 1U << mode;
    const std::string_view packed = in.take(meshopt_group * bits / 8);
    const unsigned escape = (1U << bits) - 1;
    for (std::size_t i = 0; i < meshopt_group; ++i) {
        const std::size_t bit = i * bits;
        const unsigned byte = static_cast<std::uint8_t>(packed[bit / 8]);
        const unsigned value = byte >> (8 - bits - bit % 8) & escape;
        out[i] = mode < 3 && value == escape ? in.byte() : static_cast<std::uint8_t>(value);
    }
}

std::string unpacked_attributes(std::string_view packed, const MeshoptView& view) {
    constexpr std::uint8_t version = 0xa0;
    constexpr std::size_t least_tail = 32;
    const std::size_t tail = std::max(least_tail, view.stride);
    const std::size_t groups = (view.count + meshopt_group - 1) / meshopt_group;
    // Each group of each byte takes at least the two bits of its mode.
    if (packed.size() < 1 + tail + groups * view.stride / 4) {
        throw Error(fmt::format("expected packed bytes for {} elements, got {}", view.count, packed.size()));
    }
    std::vector<std::uint8_t> before(view.stride);
    std::memcpy(before.data(), packed.data() + packed.size() - view.stride, view.stride);
    PackedBytes in(packed.substr(0, packed.size() - tail));
    if (const unsigned got = in.byte(); got != version) {
        throw Error(fmt::format("expected attributes of version {:#x}, got {:#x}", version, got));
    }
    std::string out(view.count * view.stride, '\0');
    const std::size_t block = std::min<std::size_t>((8192 / view.stride) & ~std::size_t{15}, 256);
    for (std::size_t first = 0; first < view.count; first += block) {
        const std::size_t count = std::min(block, view.count - first);
        const std::size_t block_groups = (count + meshopt_group - 1) / meshopt_group;
        for (std::size_t k = 0; k < view.stride; ++k) {
            const std::string_view modes = in.take((block_groups + 3) / 4);
            for (std::size_t group = 0; group < block_groups; ++group) {
                std::array<std::uint8_t, meshopt_group> differences{};
                take_group(in, static_cast<std::uint8_t>(modes[group / 4]) >> (group % 4 * 2) & 3U, differences);
                for (std::size_t i = group * meshopt_group; i < std::min(count, (group + 1) * meshopt_group); ++i) {
                    before[k] = static_cast<std::uint8_t>(before[k] + unzigzag(differences.at(i % meshopt_group)));
                    out[(first + i) * view.stride + k] = static_cast<char>(before[k]);
                }
            }
        }
    }
    return out;
}

/// Writes indices of 2 or 4 bytes.
class IndexBytes {
public:
    IndexBytes(std::size_t count, std::size_t stride) : stride_(stride) { bytes_.reserve(count * stride); }

    void put(std::uint32_t index) {
        for (std::size_t k = 0; k < stride_; ++k) { bytes_ += static_cast<char>(index >> (8 * k) & 0xffU); }
    }

    std::string take() { return std::move(bytes_); }

private:
    std::size_t stride_;
    std::string bytes_;
};

/// The corners of triangles, packed by what their neighbours share.
class TriangleUnpacking {
public:
    TriangleUnpacking(std::string_view packed, const MeshoptView& view)
        : view_(view), aux_(packed.substr(packed.size() - aux_bytes)), codes_(packed.substr(1, view.count / 3)),
          data_(packed.substr(1 + view.count / 3, packed.size() - aux_bytes - 1 - view.count / 3)),
          out_(view.count, view.stride) {}

    static constexpr std::size_t aux_bytes = 16;

    std::string unpacked() {
        for (const char code : codes_) {
            const auto byte = static_cast<std::uint8_t>(code);
            byte < 0xf0 ? take_neighbour(byte) : take_free(byte);
        }
        return out_.take();
    }

private:
    struct Edge {
        std::uint32_t from = 0;
        std::uint32_t to = 0;
    };

    /// Both queues of 16 are read from the last entry backwards.
    std::uint32_t vertex_before(unsigned back) const { return vertices_.at((vertex_end_ - back) & 15U); }

    void push_vertex(std::uint32_t vertex, bool keep = true) {
        vertices_.at(vertex_end_ & 15U) = vertex;
        vertex_end_ += keep ? 1U : 0U;
    }

    void push_edge(std::uint32_t from, std::uint32_t to) { edges_.at(edge_end_++ & 15U) = {from, to}; }

    std::uint32_t free_vertex() { return last_ = last_ + unzigzag(data_.variable()); }

    void put(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        out_.put(a);
        out_.put(b);
        out_.put(c);
    }

    /// A triangle at a recent edge.
    void take_neighbour(std::uint8_t code) {
        const Edge edge = edges_.at((edge_end_ - 1U - (code >> 4U)) & 15U);
        const unsigned kind = code & 15U;
        std::uint32_t c = 0;
        bool is_new = true;
        if (kind == 0) {
            c = next_++;
        } else if (kind < 13) {
            c = vertex_before(1 + kind);
            is_new = false;
        } else if (kind == 15) {
            c = free_vertex();
        } else {
            c = last_ = kind == 13 ? last_ - 1 : last_ + 1;
        }
        put(edge.from, edge.to, c);
        push_vertex(c, is_new);
        push_edge(c, edge.to);
        push_edge(edge.from, c);
    }

    void take_free(std::uint8_t code) {
        const bool in_table = code < 0xfe;
        const unsigned aux = in_table ? static_cast<std::uint8_t>(aux_[code & 15U]) : data_.byte();
        if (!in_table && aux == 0) { next_ = 0; }
        const unsigned kind_b = aux >> 4U;
        const unsigned kind_c = aux & 15U;
        const bool free_a = code == 0xff;
        const bool free_b = !in_table && kind_b == 15;
        const bool free_c = !in_table && kind_c == 15;
        std::uint32_t a = free_a ? 0 : next_++;
        std::uint32_t b = kind_b == 0 ? next_++ : vertex_before(kind_b);
        std::uint32_t c = kind_c == 0 ? next_++ : vertex_before(kind_c);
        if (free_a) { a = free_vertex(); }
        if (free_b) { b = free_vertex(); }
        if (free_c) { c = free_vertex(); }
        put(a, b, c);
        push_vertex(a);
        push_vertex(b, kind_b == 0 || free_b);
        push_vertex(c, kind_c == 0 || free_c);
        push_edge(b, a);
        push_edge(c, b);
        push_edge(a, c);
    }

    MeshoptView view_;
    std::string_view aux_;
    std::string_view codes_;
    PackedBytes data_;
    IndexBytes out_;
    std::array<std::uint32_t, 16> vertices_{};
    std::array<Edge, 16> edges_{};
    unsigned vertex_end_ = 0;
    unsigned edge_end_ = 0;
    std::uint32_t next_ = 0;
    std::uint32_t last_ = 0;
};

void expect_version(std::string_view packed, std::uint8_t version, std::string_view what) {
    const unsigned got = packed.empty() ? 0 : static_cast<std::uint8_t>(packed[0]);
    if (got != version) { throw Error(fmt::format("expected {} of version {:#x}, got {:#x}", what, version, got)); }
}

std::string unpacked_triangles(std::string_view packed, const MeshoptView& view) {
    expect_version(packed, 0xe1, "triangles");
    if (view.count % 3 != 0 || packed.size() < 1 + view.count / 3 + TriangleUnpacking::aux_bytes) {
        throw Error(fmt::format(
            "expected packed bytes of whole triangles for {} indices, got {} bytes", view.count, packed.size()));
    }
    return TriangleUnpacking(packed, view).unpacked();
}

std::string unpacked_indices(std::string_view packed, const MeshoptView& view) {
    constexpr std::size_t tail = 4;
    expect_version(packed, 0xd1, "indices");
    if (packed.size() < 1 + view.count + tail) {
        throw Error(fmt::format("expected packed bytes for {} indices, got {}", view.count, packed.size()));
    }
    PackedBytes in(packed.substr(1, packed.size() - 1 - tail));
    std::array<std::uint32_t, 2> last{};
    IndexBytes out(view.count, view.stride);
    for (std::size_t i = 0; i < view.count; ++i) {
        const std::uint32_t value = in.variable();
        std::uint32_t& index = last.at(value & 1U);
        index += unzigzag(value >> 1U);
        out.put(index);
    }
    return out.take();
}

template <typename Part>
Part number_at(const std::string& bytes, std::size_t at) {
    Part part{};
    std::memcpy(&part, bytes.data() + at, sizeof part);
    return part;
}

/// Directions of two coordinates on an octahedron and its size, as three coordinates; the fourth stays.
template <typename Part>
void unfold_directions(std::string& bytes) {
    const double largest = sizeof(Part) == 1 ? 127.0 : 32767.0;
    for (std::size_t at = 0; at < bytes.size(); at += 4 * sizeof(Part)) {
        double x = number_at<Part>(bytes, at);
        double y = number_at<Part>(bytes, at + sizeof(Part));
        const double z = number_at<Part>(bytes, at + 2 * sizeof(Part)) - std::abs(x) - std::abs(y);
        const double fold = std::min(z, 0.0);
        x += x >= 0.0 ? fold : -fold;
        y += y >= 0.0 ? fold : -fold;
        const double length = std::sqrt(x * x + y * y + z * z);
        const double scale = length > 0.0 ? largest / length : 0.0;
        const std::array<Part, 3> parts{static_cast<Part>(std::lround(x * scale)),
            static_cast<Part>(std::lround(y * scale)), static_cast<Part>(std::lround(z * scale))};
        std::memcpy(bytes.data() + at, parts.data(), sizeof parts);
    }
}

/// Floats of 24 bits and an exponent of 8, both signed.
void unfold_exponents(std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += 4) {
        const auto word = number_at<std::int32_t>(bytes, at);
        const std::int32_t exponent = word >> 24;
        const auto digits = static_cast<std::int32_t>(static_cast<std::uint32_t>(word) << 8U) >> 8;
        const auto value = static_cast<float>(std::ldexp(static_cast<double>(digits), exponent));
        std::memcpy(bytes.data() + at, &value, sizeof value);
    }
}

void unfold_elements(std::string& bytes, const MeshoptView& view) {
    if (view.filter == MeshoptView::Filter::Octahedral) {
        view.stride == 4 ? unfold_directions<std::int8_t>(bytes) : unfold_directions<std::int16_t>(bytes);
    } else if (view.filter == MeshoptView::Filter::Exponential) {
        unfold_exponents(bytes);
    }
}

void check_meshopt_stride(const MeshoptView& view) {
    const bool is_index = view.mode != MeshoptView::Mode::Attributes;
    const bool is_octahedral = view.filter == MeshoptView::Filter::Octahedral;
    const bool good = is_index ? (view.stride == 2 || view.stride == 4) && view.filter == MeshoptView::Filter::None
                      : is_octahedral ? view.stride == 4 || view.stride == 8
                                      : view.stride > 0 && view.stride <= 256 && view.stride % 4 == 0;
    if (!good) { throw Error(fmt::format("expected a byteStride that mode and filter allow, got {}", view.stride)); }
}

} // namespace

std::string meshopt_unpacked(std::string_view packed, const MeshoptView& view) {
    check_meshopt_stride(view);
    constexpr std::size_t most = std::size_t{1} << 28U;
    if (view.count > most / view.stride) {
        throw Error(
            fmt::format("expected at most {} unpacked bytes, got {} elements of {}", most, view.count, view.stride));
    }
    switch (view.mode) {
    case MeshoptView::Mode::Triangles:
        return unpacked_triangles(packed, view);
    case MeshoptView::Mode::Indices:
        return unpacked_indices(packed, view);
    case MeshoptView::Mode::Attributes:
        break;
    }
    std::string bytes = unpacked_attributes(packed, view);
    unfold_elements(bytes, view);
    return bytes;
}

} // namespace octant::models::meshfile
