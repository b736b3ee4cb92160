#include "ui/terrain/terrain_check.h"

#include "ui/base/progress.h"
#include "ui/terrain/ground_view.h"
#include "ui/terrain/key_pictures.h"
#include "ui/terrain/random_view.h"

#include <cstdint>
#include <fmt/format.h>
#include <memory>

namespace octant::ui::terrain {

namespace terrain = visuals::terrain;

namespace {

constexpr glm::ivec2 size_px{320, 180};

void add(terrain::Conformity& sum, const terrain::Conformity& found) {
    sum.open_edges += found.open_edges;
    sum.corners_on_edges += found.corners_on_edges;
    sum.crowded_edges += found.crowded_edges;
    sum.turned_triangles += found.turned_triangles;
    sum.doubled_vertices += found.doubled_vertices;
}

} // namespace

TerrainFaults check_terrain(MeshMaker& maker, const TerrainCheck& check) {
    const std::unique_ptr<KeyPictures> pictures =
        check.draw_every > 0
            ? std::make_unique<KeyPictures>(size_px, maker.ground().half_extent_m())
            : nullptr;
    terrain::ConformityCheck edges(maker.ground());
    GroundViewOptions seen;
    seen.size_px = size_px;
    seen.earth_radius_m = check.earth_radius_m;
    TerrainFaults faults;
    base::Progress progress("views", check.views, check.quiet, "views");
    for (int number = 0; number < check.views; number += check.every) {
        const RandomView random = random_view(
            maker.ground(),
            check.by_error,
            static_cast<std::uint64_t>(check.seed),
            static_cast<std::uint64_t>(number));
        const terrain::MeshView view = mesh_view(random.camera, seen);
        const terrain::GroundMesh mesh = random.triangles
                                             ? maker.mesh_within(view, *random.triangles)
                                             : maker.mesh(view, random.coarseness);
        const terrain::Conformity found = edges.check(mesh, view);
        add(faults.edges, found);
        int key_pixels = 0;
        if (pictures && faults.views % check.draw_every == 0) {
            key_pixels = pictures->cracks(mesh, random.camera);
            ++faults.drawn;
        }
        ++faults.views;
        faults.triangles += mesh.counters.triangles;
        faults.key_pixels += key_pixels;
        if (!found.is_whole() || key_pixels > 0) {
            ++faults.cracked_views;
            base::say(
                check.quiet,
                fmt::format("view {}: {}, {} key pixels", number, found.text(), key_pixels));
        }
        progress.show(number + 1, fmt::format("{} with faults", faults.cracked_views));
    }
    return faults;
}

} // namespace octant::ui::terrain
