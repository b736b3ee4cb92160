#pragma once

#include "ui/terrain/ground_view.h"
#include "ui/terrain/mesh_maker.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/renderer.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/mesh_measurement.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace octant::ui::terrain {

/// A view of a ground and the resolution of its mesh.
struct RandomView {
    visuals::scene::Camera camera;
    std::optional<int> triangles; ///< budget; without it `coarseness` counts
    double coarseness = 0.0;      ///< as MeshMaker::mesh takes it
};

/// View `number` of a seed: over the map or, in three of ten cases, outside it, 2 m to 20 km above the ground, in any
/// direction between straight down and 30 degrees up, fields of view of 5 to 100 degrees; meshes of 100 to 60,000
/// triangles, of C from 2 to 64 or of errors from 0.25 to 32 pixels. The result depends on the arguments alone.
RandomView random_view(
    const visuals::terrain::GroundSamples& ground, bool by_error, std::uint64_t seed, std::uint64_t number);

/// Draws meshes over a key colour that nothing else has and finds its pixels inside the ground.
class CrackFinder {
public:
    /// For meshes of a ground that reaches `half_extent_m` from its centre. Throws Error when there is no renderer.
    CrackFinder(const glm::ivec2& size_px, const glm::dvec2& half_extent_m);
    ~CrackFinder() = default;
    CrackFinder(const CrackFinder&) = delete;
    CrackFinder& operator=(const CrackFinder&) = delete;
    CrackFinder(CrackFinder&&) = delete;
    CrackFinder& operator=(CrackFinder&&) = delete;

    /// Returns the number of pixels with the key colour whose ray goes from above the mesh to below it: cracks and
    /// holes.
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

/// Which random views of a ground are checked.
struct TerrainCheck {
    int views = 1000;
    int seed = 1;
    int every = 1;       ///< only every Nth view is meshed
    int draw_every = 50; ///< every Nth meshed view is drawn; 0 = none
    double earth_radius_m = 0.0;
    bool by_error = false; ///< the maker's coarseness is in pixels
    bool quiet = false;
};

struct TerrainCheckResult {
    int views = 0;
    int drawn = 0;
    long triangles = 0;
    int cracked_views = 0; ///< views with any fault below
    visuals::terrain::Conformity edges;
    long key_pixels = 0;
};

/// Meshes random views and checks each by edge matching and some by drawing them over a key colour. Prints views with
/// faults on stderr unless quiet. Throws Error if there is no renderer.
TerrainCheckResult check_terrain(MeshMaker& maker, const TerrainCheck& check);

} // namespace octant::ui::terrain
