#pragma once

#include "visuals/scene/camera.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/renderer.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/mesh_surface.h"
#include "visuals/terrain/perspective_view.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace octant::ui::terrain {

/// Draws meshes over a colour that nothing else has and looks for it inside the ground.
class CrackFinder {
public:
    /// For meshes of a ground that reaches `half_extent_m` from its centre. Throws Error when there
    /// is no renderer.
    CrackFinder(const glm::ivec2& size_px, const glm::dvec2& half_extent_m);
    ~CrackFinder() = default;
    CrackFinder(const CrackFinder&) = delete;
    CrackFinder& operator=(const CrackFinder&) = delete;
    CrackFinder(CrackFinder&&) = delete;
    CrackFinder& operator=(CrackFinder&&) = delete;

    /// Pixels through which the key colour is seen though their ray comes from above the mesh and
    /// goes on below it: cracks and holes.
    int cracks(const visuals::terrain::GroundMesh& mesh, const visuals::scene::Camera& camera);

private:
    void draw(const visuals::terrain::GroundMesh& mesh, const visuals::scene::Camera& camera);
    bool is_key(int x, int y) const;
    bool goes_below(const glm::dvec3& ray) const;

    glm::ivec2 size_px_;
    glm::dvec2 half_extent_m_;
    std::unique_ptr<visuals::scene::Renderer> renderer_;
    visuals::scene::Picture picture_;
    visuals::terrain::MeshSurface surface_;
    visuals::terrain::PerspectiveView view_;
    double reach_m_ = 0.0;  ///< of the mesh from the eye
    double lowest_m_ = 0.0; ///< of the mesh, world height
    double highest_m_ = 0.0;
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> facing_;
};

} // namespace octant::ui::terrain
