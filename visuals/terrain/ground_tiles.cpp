// Access to a ground's numbers by node and by sample.

#include "visuals/terrain/ground_tiles.h"

#include "models/heights/height_field.h"

#include <bit>
#include <cassert>
#include <utility>

namespace octant::visuals::terrain {

GroundTiles::GroundTiles(const GroundShape& shape, GroundMetadata metadata, std::span<const std::byte> memory,
    std::shared_ptr<const void> owner, std::shared_ptr<const TileValidator> validator)
    : shape_(shape), metadata_(std::move(metadata)), layout_(shape), codes_(codes_of(shape)), memory_(memory),
      owner_(std::move(owner)),
      validator_(validator ? std::move(validator) : std::make_shared<const TileValidator>(layout_)),
      base_m_(shape.height_base_m), unit_m_(shape.height_unit_m) {
    assert(memory.size() == layout_.total_bytes());
}

float GroundTiles::height_m(int column, int row) const {
    assert(column >= 0 && row >= 0 && column < columns() && row < rows());
    const auto steps = static_cast<unsigned>(column | row);
    const int root_edge = layout_.level(0).edge;
    if (steps % static_cast<unsigned>(root_edge) == 0) {
        return corner_m((column != 0 ? 1U : 0U) + (row != 0 ? 2U : 0U));
    }
    const int zeros = std::countr_zero(steps);
    const int level = levels() - 1 - zeros;
    const int half = 1 << zeros;
    const NodePart part = (column & half) == 0 ? NodePart::West
                          : (row & half) == 0  ? NodePart::South
                                               : NodePart::Centre;
    return height_m(level, part, column >> (zeros + 1), row >> (zeros + 1));
}

glm::dvec2 GroundTiles::half_extent_m() const {
    return {0.5 * (columns() - 1) * spacing_m(), 0.5 * (rows() - 1) * spacing_m()};
}

std::optional<double> GroundTiles::height_at(double x_m, double y_m) const {
    return models::heights::bilinear_height_m(*this, x_m, y_m);
}

} // namespace octant::visuals::terrain
