#pragma once

#include "ui/terrain/ground_view.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_query.h"

#include <glm/vec3.hpp>

#include <memory>
#include <string>

namespace octant::ui::terrain {

/// Any of the program's meshers over one ground, driven by one number.
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

    /// The mesh with as many triangles as steps allow, never more where that is possible.
    virtual visuals::terrain::GroundMesh mesh_within(const visuals::terrain::MeshView& view, int triangles) = 0;

protected:
    MeshMaker() = default;
};

/// The ground must outlive the maker and stay where it is. Throws Error for a kind of mesh that imported grounds have
/// not.
std::unique_ptr<MeshMaker> make_mesh_maker(const LoadedGround& ground, const GroundMeshOptions& options);

/// The mesh that --error-px, --triangles or --resolution-c ask for. Throws Error when none of them is there, or one
/// that does not go with the kind of mesh.
visuals::terrain::GroundMesh mesh_from_options(
    MeshMaker& maker, const visuals::terrain::MeshView& view, const GroundMeshOptions& options);

/// A mesh as a PLY file: world coordinates in double precision, triangles counter-clockwise from above. `eye_m`: what
/// the mesh is relative to.
std::string ply_of(const visuals::terrain::GroundMesh& mesh, const glm::dvec3& eye_m, bool ascii);

} // namespace octant::ui::terrain
