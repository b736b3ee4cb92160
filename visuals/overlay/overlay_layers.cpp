#include "visuals/overlay/overlay_layers.h"

namespace octant::visuals::overlay {

void OverlayLayers::clear() {
    vertices_.clear();
    indices_.clear();
}

void OverlayLayers::add(const scene::OverlayDraw& draw) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    vertices_.insert(vertices_.end(), draw.vertices.begin(), draw.vertices.end());
    indices_.reserve(indices_.size() + draw.indices.size());
    for (const std::uint32_t index : draw.indices) { indices_.push_back(first + index); }
}

} // namespace octant::visuals::overlay
