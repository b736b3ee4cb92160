#pragma once

#include "models/polygons/file_axes.h"
#include "models/triangle_mesh.h"

#include <glm/vec3.hpp>

#include <optional>
#include <span>

namespace octant::models::polygons {

/// What is known of a file's axes before its shape is looked at: that its top or its nose points along an axis of the
/// file. Several hints may contradict each other.
struct AxesHint {
    enum class Subject { Top, Nose };

    Subject subject = Subject::Top;
    glm::dvec3 towards{0.0, 1.0, 0.0}; ///< along an axis of the file
    /// The natural logarithm of how much likelier this direction is than one without a hint.
    double weight = 0.0;
};

/// The likeliest axes of an aircraft.
struct AxesGuess {
    FileAxes axes;
    /// The natural logarithm of how much likelier they are than those with another nose or top.
    double lead = 0.0;
    /// The part of the lead over the axes with the nose at the other end that hints do not explain.
    double lead_of_shape = 0.0;

    /// Whether the evidence is clear.
    bool is_clear() const { return lead >= 1.5; }
};

/// Finds the likeliest axes of an aircraft's mesh from its shape, from the names of its materials and from hints. An
/// aircraft is the same left and right; it is flat; fin and tailplane are at its tail, the fin on top; wings are swept
/// back and bent up; a helicopter's rotor is on top, nearer to the nose; a canopy is ahead, exhausts, rudders and
/// elevators are behind, wheels are below. Small parts far from the rest do not count. Nothing for a mesh without an
/// extent. Time is linear in the number of triangles, plus a grid of 64 cells a side.
std::optional<AxesGuess> guess_axes(const TriangleMesh& mesh, std::span<const AxesHint> hints = {});

} // namespace octant::models::polygons
