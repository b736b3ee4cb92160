#pragma once

#include "ui/terrain/ground_view.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_query.h"

#include <glm/vec3.hpp>

#include <memory>
#include <string>

namespace octant::ui::terrain {

/// Any of the program's meshers over one ground. One number, the coarseness, controls it.
class MeshMaker {
public:
    virtual ~MeshMaker() = default;
    MeshMaker(const MeshMaker&) = delete;
    MeshMaker& operator=(const MeshMaker&) = delete;
    MeshMaker(MeshMaker&&) = delete;
    MeshMaker& operator=(MeshMaker&&) = delete;

    /// The ground at full resolution.
    virtual visuals::terrain::GroundSamples ground() const = 0;

    /// Useful range of the coarseness: the error in pixels, or 1 / C.
    struct Range {
        double finest;
        double coarsest;
    };

    virtual Range range() const = 0;

    virtual visuals::terrain::GroundMesh mesh(const visuals::terrain::MeshView& view, double coarseness) = 0;

    /// The mesh with the most triangles up to `triangles`; more only if the coarsest mesh has more.
    virtual visuals::terrain::GroundMesh mesh_within(const visuals::terrain::MeshView& view, int triangles) = 0;

protected:
    MeshMaker() = default;
};

/// The ground must outlive the maker and not move. Throws Error for a kind of mesh that an imported ground does not
/// support.
std::unique_ptr<MeshMaker> make_mesh_maker(const LoadedGround& ground, const GroundMeshOptions& options);

/// The mesh for --error-px, --triangles or resolution-c. Throws Error if none of them is given, or one that this kind
/// of mesh does not have.
visuals::terrain::GroundMesh mesh_from_options(
    MeshMaker& maker, const visuals::terrain::MeshView& view, const GroundMeshOptions& options);

/// A mesh as a PLY file: world coordinates in double precision, triangles counter-clockwise from above. Positions of
/// the mesh are relative to `eye_m`.
std::string ply_of(const visuals::terrain::GroundMesh& mesh, const glm::dvec3& eye_m, bool ascii);

} // namespace octant::ui::terrain
