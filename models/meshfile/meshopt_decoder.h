#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace octant::models::meshfile {

/// How a buffer view of a glTF file is packed by EXT_meshopt_compression.
struct MeshoptView {
    enum class Mode { Attributes, Triangles, Indices };
    enum class Filter { None, Octahedral, Exponential };

    Mode mode = Mode::Attributes;
    Filter filter = Filter::None;
    std::size_t count = 0;  ///< of elements
    std::size_t stride = 0; ///< bytes of an unpacked element
};

/// Returns count * stride unpacked bytes. Throws Error "expected ..., got ..." without a file for packed bytes that end
/// early, for other versions of the packing, for strides that the mode does not have, and for more elements than the
/// bytes can hold; memory is allocated after that check.
std::string meshopt_unpacked(std::string_view packed, const MeshoptView& view);

} // namespace octant::models::meshfile
