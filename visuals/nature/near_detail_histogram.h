#pragma once

#include "visuals/nature/near_detail_view.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::nature {

/// Counts how many halvings the near triangles of a mesh take, by how long edges must look to be
/// halved, so that a number of them can be held without cutting any off.
class NearDetailHistogram {
public:
    /// Returns how long edges must look, no less than `view.min_edge_rad`, for a little less than
    /// `view.max_splits` halvings. It changes steadily with the view.
    float min_edge_rad_for_budget(const terrain::GroundMesh& mesh, const NearDetailView& view);

    /// Whether a triangle of the last mesh has edges that may look long: most are too far off.
    bool is_near(std::size_t triangle) const { return is_near_[triangle] != 0; }

private:
    using Triangle = std::array<glm::vec3, 3>;

    static constexpr std::uint32_t bins_an_octave = 32;
    static constexpr std::size_t bins = std::size_t{16} * bins_an_octave;

    void count(const Triangle& triangle, float max_look2, int depth);

    NearDetailView view_;
    float min_angular_size2_ = 0.0F;
    std::size_t counted_ = 0;
    /// Halvings by the square of how long the edge looks, over min_angular_size2_.
    std::array<std::uint32_t, bins> split_counts_{};
    std::vector<std::uint8_t> is_near_;
};

} // namespace octant::visuals::nature
