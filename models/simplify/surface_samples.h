#pragma once

#include "models/measure/triangle_bvh.h"
#include "models/simplify/working_surface.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::models::simplify {

/// A triangle in the coordinates of its own plane, in single precision, with its colours where there are any.
struct FlatTriangle : measure::PlaneFrame<float> {
    /// The colour at corner a, and its gradient along the plane's x and y axes.
    std::array<float, 3> colour;
    std::array<float, 3> colour_x;
    std::array<float, 3> colour_y;
};

/// The triangle without colours.
FlatTriangle flat(const std::array<glm::dvec3, 3>& corners);

/// The triangle with colours. On one without area the gradient may be zero.
FlatTriangle flat(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec3, 3>& corner_colours);

inline glm::dvec3 widen(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

/// Samples in structure-of-arrays layout for vector instructions, with the nearest triangle of each.
class SampleBlock {
public:
    void clear() { size_ = 0; }

    std::size_t size() const { return size_; }

    /// Allocates room for a total of `samples` samples, rounded up to whole vectors.
    void make_room(std::size_t samples);

    /// Adds a sample. make_room must have been called for it.
    void add(std::uint32_t number, const std::array<float, 3>& place, float weight) {
        numbers[size_] = number;
        x[size_] = place[0];
        y[size_] = place[1];
        z[size_] = place[2];
        weights[size_] = weight;
        ++size_;
    }

    std::vector<std::uint32_t> numbers;
    std::vector<float> x, y, z, weights;
    std::vector<float> red, green, blue; ///< Filled by the caller where there are colours.
    std::vector<float> distances2;       ///< The squared distance to the nearest triangle.
    std::vector<float> colour_errors2;   ///< The squared difference in colour to the nearest point.
    std::vector<std::int32_t> nearest;   ///< The index of the nearest triangle.

private:
    std::size_t size_ = 0;
};

/// Finds the nearest triangle of each sample: fills distances2 and nearest, and colour_errors2 if `coloured`. Of
/// triangles at the same distance the first one counts. Needs at least one triangle (asserted).
void find_nearest(SampleBlock& samples, std::span<const FlatTriangle> triangles, bool coloured);

/// Positions of samples are rounded to about this share of the diagonal; smaller distances are meaningless.
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

/// The penalty of a squared distance d2: d2 (1 + per_high2 d2), which is more than d2 for distances far above the usual
/// one. Minimizing its sum lowers both the mean and the largest distance.
struct Penalty {
    /// 1 / the squared distance whose penalty is 2 d2; 0 = the penalty is d2.
    double per_high2 = 0.0;

    double of(double distance2) const { return distance2 * (1.0 + per_high2 * distance2); }

    /// The derivative: the weight of a sample in a least-squares fit.
    double weight(double distance2) const { return 1.0 + 2.0 * per_high2 * distance2; }
};

/// The nearest point of the original to a point of the current surface.
struct BackwardFoot {
    OriginalPoint foot;
    /// The squared distance. From an inner point of a triangle against which the original faces there: plus the area of
    /// that triangle (LocalError::backward_error).
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

    /// Renumbers samples: those of a triangle become consecutive.
    void sort();

    /// Frees the memory of the lists until assign_all() makes new ones.
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

    /// Empties the list of a triangle.
    void clear(std::uint32_t face);

    /// Puts a sample that is in no list into that of a triangle. Its colour error stays until assign() moves it.
    void put(std::uint32_t sample, std::uint32_t face, float distance2);

    /// Allocates room for triangles numbered below `count`.
    void make_face_room(std::size_t count);

    /// Puts every sample into the list of triangle `faces[sample]`, at `distances2[sample]`. Samples get new numbers,
    /// so that those of a triangle follow each other.
    void assign_all(
        std::span<const std::uint32_t> faces, std::span<const float> distances2, const CollapsibleMesh& mesh);

    const Penalty& penalty() const { return penalty_; }

    /// Sets the penalty and recomputes the errors of all triangles.
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
