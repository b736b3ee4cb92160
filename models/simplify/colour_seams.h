#pragma once

#include "models/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace octant::models::simplify {

/// Seams along which a mesh's colours break, kept through its simplification. Seams part the
/// surface into charts. The simplifier sees them as borders of materials, which it keeps where they
/// are; what it made then takes the colours of each side of a seam from the chart on that side.
class ColourSeams {
public:
    /// `corner_colours` has one entry a triangle, or none where no colours break: nothing is
    /// changed then. The mesh must be a manifold with colours where there are corner colours.
    ColourSeams(TriangleMesh mesh, std::vector<CornerColours> corner_colours);

    /// The mesh to be simplified: its materials tell charts apart as well.
    const TriangleMesh& marked() const { return marked_; }

    /// What was made of marked(), with the materials of the mesh and with a vertex for each chart
    /// where charts meet, at the same place to the bit and in the colour of its side.
    TriangleMesh broken(TriangleMesh made) const;

private:
    void give_materials_back(TriangleMesh& made) const;

    TriangleMesh marked_;
    std::vector<CornerColours> corner_colours_;
    std::vector<Material> materials_;               ///< the mesh's own
    std::vector<std::uint32_t> materials_of_marks_; ///< for each material of marked()
};

} // namespace octant::models::simplify
