#pragma once

#include "models/simplify/sample_block.h"
#include "models/simplify/working_surface.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// Positions of samples are rounded to about this share of the diagonal; smaller distances mean nothing.
inline constexpr double sample_rounding = 1e-7;

/// A point of the original surface.
struct SurfaceSample {
    std::array<float, 3> place{};
    float weight = 0.0F;           ///< The area that it stands for.
    float distance2 = 0.0F;        ///< The squared distance from the current surface.
    float colour_error2 = 0.0F;    ///< The squared difference in colour to the nearest point there.
    std::uint32_t face = none;     ///< The triangle of the current surface in whose list it is.
    std::uint32_t next = none;     ///< The next sample in that list.
    std::uint32_t triangle = none; ///< Of the original.
};

/// What a squared distance counts as: itself, and more where it is far above the usual one, so that one sum lowers the
/// mean and the largest distance together.
struct Penalty {
    /// 1 / the squared distance that counts twice; 0 = plain squares.
    double per_high2 = 0.0;

    double of(double distance2) const { return distance2 * (1.0 + per_high2 * distance2); }

    /// The derivative: the weight of a sample in a least-squares fit.
    double weight(double distance2) const { return 1.0 + 2.0 * per_high2 * distance2; }
};

/// Where the way back from a point of the current surface ends.
struct BackwardFoot {
    OriginalPoint foot;
    float distance2 = 0.0F;
};

/// Points of the original surface. Each has the share of the original's area that it stands for as its weight, and is
/// in the list of that triangle of the current surface that is nearest to it. Steps only touch the lists of triangles
/// that change.
class SurfaceSamples {
public:
    /// About `wanted` samples of a mesh (working units), spread over the area: each triangle that is larger than the
    /// area of one sample has some, and so has each shell. All vertices are samples where they are fewer. At first each
    /// sample is in the list of a triangle that it lies on.
    SurfaceSamples(const WorkingSurface& original, std::size_t wanted);

    std::size_t size() const { return samples_.size(); }

    bool coloured() const { return !colours_.empty(); }

    const SurfaceSample& operator[](std::uint32_t sample) const { return samples_[sample]; }

    /// Calls `visit(sample)` for each sample in the list of a triangle.
    template <typename Visit>
    void for_each(std::uint32_t face, const Visit& visit) const {
        for (std::uint32_t sample = first_[face]; sample != none; sample = samples_[sample].next) { visit(sample); }
    }

    /// Tells the processor that the samples of a triangle will be gathered. Mostly they lie in memory one before the
    /// other.
    void prefetch(std::uint32_t face) const {
        constexpr std::uint32_t samples_a_line = 2;
        const std::uint32_t first = first_[face];
        for (std::uint32_t i = 0; i < counts_[face] && i <= first; i += samples_a_line) {
            __builtin_prefetch(&samples_[first - i]);
        }
    }

    /// Gives samples new numbers, so that those of a triangle follow each other.
    void sort();

    /// Gives the memory of lists back until assign_all() makes them anew.
    void drop_lists();

    std::size_t count(std::uint32_t face) const { return counts_[face]; }

    /// The error of a triangle: the weighted penalties of its samples, colours included, and of its way back to the
    /// original (LocalError).
    double error(std::uint32_t face) const { return errors_[face] + back_errors_[face]; }

    void set_back_error(std::uint32_t face, double error) { back_errors_[face] = error; }

    /// The ways back from three points of a triangle, by its corners, and from a vertex (LocalError).
    std::array<BackwardFoot, 3>& from_face(std::uint32_t face) { return from_faces_[face]; }

    BackwardFoot& from_vertex(std::uint32_t vertex) { return from_vertices_[vertex]; }

    double back_error(std::uint32_t face) const { return back_errors_[face]; }

    /// Appends a triangle's samples to a block.
    void gather(std::uint32_t face, SampleBlock& block) const;

    /// Moves the samples of a block from their lists to those of `faces[block.nearest]`. The block must hold all
    /// samples of all `emptied` triangles.
    void assign(const SampleBlock& block, std::span<const std::uint32_t> emptied, std::span<const std::uint32_t> faces);

    /// Takes all samples of a triangle out of its list.
    void clear(std::uint32_t face);

    /// Puts a sample that is in no list into that of a triangle. Its colour counts as it did until assign() moves it.
    void put(std::uint32_t sample, std::uint32_t face, float distance2);

    /// Makes room for triangles numbered below `count`.
    void make_face_room(std::size_t count);

    /// Puts every sample into the list of triangle `faces[sample]`, at `distances2[sample]`. Samples get new numbers,
    /// so that those of a triangle follow each other.
    void assign_all(
        std::span<const std::uint32_t> faces, std::span<const float> distances2, const CollapsibleMesh& mesh);

    const Penalty& penalty() const { return penalty_; }

    /// Errors are counted anew.
    void set_penalty(const Penalty& penalty);

    /// The weighted mean of the squared distances.
    double mean2() const;

private:
    double error_of(const SurfaceSample& sample) const;
    void add(const WorkingSurface& from, std::uint32_t face, const glm::dvec3& weights, double area);
    void add_vertices(const WorkingSurface& from, std::span<const double> areas);
    void add_on_faces(const WorkingSurface& from, std::span<const double> areas, std::size_t count, bool with_vertices);
    void add_to_unsampled_shells(const WorkingSurface& from, std::span<const double> areas);

    std::vector<SurfaceSample> samples_;
    std::vector<std::array<float, 3>> colours_; ///< Empty = no colours.
    std::vector<std::uint32_t> first_;          ///< For each triangle the head of its list.
    std::vector<std::uint32_t> counts_;
    std::vector<double> errors_;
    std::vector<double> back_errors_;
    std::vector<std::array<BackwardFoot, 3>> from_faces_;
    std::vector<BackwardFoot> from_vertices_;
    Penalty penalty_;
};

/// The triangle nearest to a place that is found by going from `start` from neighbour to neighbour as long as that
/// leads nearer; its squared distance goes to `distance2`. `triangles` are those of all slots, or empty: then they are
/// made one by one, which is slower.
std::uint32_t nearest_face_from(const WorkingSurface& surface, std::uint32_t start, const std::array<float, 3>& place,
    float& distance2, std::span<const FlatTriangle> triangles = {});

} // namespace octant::models::simplify
