#pragma once

#include "ui/terrain/mesh_maker.h"
#include "visuals/terrain/conformity.h"

namespace octant::ui::terrain {

/// Which random views of a ground are looked at.
struct TerrainCheck {
    int views = 1000;
    int seed = 1;
    int every = 1;       ///< of these views
    int draw_every = 50; ///< of those; 0 = none is drawn
    double earth_radius_m = 0.0;
    bool by_error = false; ///< the maker's coarseness is in pixels
    bool quiet = false;
};

struct TerrainCheckResult {
    int views = 0;
    int drawn = 0;
    long triangles = 0;
    int cracked_views = 0; ///< with any of the following
    visuals::terrain::Conformity edges;
    long key_pixels = 0;
};

/// Meshes random views and checks each by edge matching and some by drawing them over a key
/// colour. Tells of views with faults on stderr unless quiet. Throws Error when nothing can draw.
TerrainCheckResult check_terrain(MeshMaker& maker, const TerrainCheck& check);

} // namespace octant::ui::terrain
