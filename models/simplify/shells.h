#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/simplify/surface_samples.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// Shells that are farther from the others than this are never dropped, in working units.
inline constexpr double max_shell_distance = 0.5;

/// The connected components (shells) of a surface during collapses, and the cost of dropping one: the rest of a small
/// shell of an assembly may cost more triangles than it is worth.
class Shells {
public:
    /// `face_numbers`: for each triangle slot its number in the original. A shell with a sample that is farther than
    /// `max_distance` from the others is not dropped. At the largest value, max_shell_distance, costs are estimated
    /// from some samples only. The samples must be in lists. All must outlive this.
    Shells(WorkingSurface& surface, std::span<const std::uint32_t> face_numbers, SurfaceSamples& samples,
        const OriginalSurface& original, double max_distance);

    std::size_t count() const { return faces_.size(); }

    /// Of those that were not dropped.
    std::size_t count_left() const { return count_left_; }

    std::uint32_t shell_of(std::uint32_t face) const { return of_face_[face]; }

    /// The number of triangles that a shell has now; 0 = it was dropped.
    std::size_t face_count(std::uint32_t shell) const { return face_counts_[shell]; }

    /// Counts triangles of a shell that went.
    void lose(std::uint32_t shell, std::size_t faces) { face_counts_[shell] -= faces; }

    /// The growth of the error when a shell is dropped: its samples then have the distance of the nearest other shell
    /// of the original. Infinite if there is no other shell or it is far away.
    double cost(std::uint32_t shell) const;

    /// Drops a shell after calling `gone` with each of its triangles. Its samples move to the nearest other triangles.
    template <typename Gone>
    void drop(std::uint32_t shell, const Gone& gone) {
        std::vector<std::uint32_t> numbers;
        for (const std::uint32_t face : faces_[shell]) {
            if (surface_.mesh.has_face(face)) {
                samples_.for_each(face, [&](std::uint32_t number) { numbers.push_back(number); });
                samples_.clear(face);
                gone(face);
                surface_.mesh.remove(face);
            }
        }
        face_counts_[shell] = 0;
        --count_left_;
        move_samples(shell, numbers);
    }

private:
    void move_samples(std::uint32_t shell, std::span<const std::uint32_t> numbers);
    measure::NearestOnMesh nearest_other(std::uint32_t shell, const glm::dvec3& place, double max_distance) const;

    WorkingSurface& surface_;
    SurfaceSamples& samples_;
    const OriginalSurface& original_;
    double max_distance_;
    std::vector<std::uint32_t> of_face_;            ///< For each triangle slot.
    std::vector<std::vector<std::uint32_t>> faces_; ///< Of each shell at first.
    std::vector<std::size_t> face_counts_;
    std::size_t count_left_ = 0;
    std::vector<std::uint32_t> of_original_; ///< For each triangle of the original.
    /// For each triangle of the original a sample on it or near it.
    std::vector<std::uint32_t> sample_near_;
};

} // namespace octant::models::simplify
