#pragma once

#include "visuals/nature/fine_view.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::nature {

/// Counts how many halvings the near triangles of a mesh take, by how long edges must look to be
/// halved, so that a number of them can be held without cutting any off.
class FineSurvey {
public:
    /// Returns how long edges must look, no less than `view.long_rad`, for a little less than
    /// `view.max_splits` halvings. It changes steadily with the view.
    float long_rad_within(const terrain::GroundMesh& mesh, const FineView& view);

    /// Whether a triangle of the last mesh has edges that may look long: most are too far off.
    bool is_near(std::size_t triangle) const { return is_near_[triangle] != 0; }

private:
    using Triangle = std::array<glm::vec3, 3>;

    static constexpr std::uint32_t bins_an_octave = 32;
    static constexpr std::size_t bins = std::size_t{16} * bins_an_octave;

    void count(const Triangle& triangle, float max_look2, int depth);

    FineView view_;
    float min_look2_ = 0.0F;
    std::size_t counted_ = 0;
    /// Halvings by the square of how long the edge looks, over min_look2_.
    std::array<std::uint32_t, bins> halvings_{};
    std::vector<std::uint8_t> is_near_;
};

} // namespace octant::visuals::nature
