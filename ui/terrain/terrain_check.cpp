#include "ui/terrain/terrain_check.h"

#include "ui/base/progress.h"
#include "ui/terrain/ground_view.h"
#include "ui/terrain/crack_finder.h"
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
    sum.t_junctions += found.t_junctions;
    sum.overlapping_edges += found.overlapping_edges;
    sum.inverted_triangles += found.inverted_triangles;
    sum.duplicate_vertices += found.duplicate_vertices;
}

} // namespace

TerrainCheckResult check_terrain(MeshMaker& maker, const TerrainCheck& check) {
    const std::unique_ptr<CrackFinder> pictures =
        check.draw_every > 0
            ? std::make_unique<CrackFinder>(size_px, maker.ground().half_extent_m())
            : nullptr;
    terrain::ConformityCheck edges(maker.ground());
    GroundViewOptions seen;
    seen.size_px = size_px;
    seen.earth_radius_m = check.earth_radius_m;
    TerrainCheckResult check_result;
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
        add(check_result.edges, found);
        int key_pixels = 0;
        if (pictures && check_result.views % check.draw_every == 0) {
            key_pixels = pictures->cracks(mesh, random.camera);
            ++check_result.drawn;
        }
        ++check_result.views;
        check_result.triangles += mesh.counters.triangles;
        check_result.key_pixels += key_pixels;
        if (!found.is_conforming() || key_pixels > 0) {
            ++check_result.cracked_views;
            base::print_note(
                check.quiet,
                fmt::format("view {}: {}, {} key pixels", number, found.text(), key_pixels));
        }
        progress.show(number + 1, fmt::format("{} with faults", check_result.cracked_views));
    }
    return check_result;
}

} // namespace octant::ui::terrain
