#include "ui/terrain/mesh_maker.h"

#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "ui/settings/settings_text.h"
#include "visuals/terrain/bisection_mesher.h"
#include "visuals/terrain/quadtree.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <vector>

namespace octant::ui::terrain {

namespace terrain = visuals::terrain;

namespace {

std::vector<std::uint32_t> no_colours(int columns, int rows) {
    return std::vector<std::uint32_t>(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0xffffffffU);
}

/// The paper's quadtree; coarseness is 1 / C.
class QuadtreeMaker final : public MeshMaker {
public:
    QuadtreeMaker(const models::heights::HeightField& field, const GroundMeshOptions& options)
        : tree_(field, terrain::quadtree_options(options.lod)), colours_(no_colours(field.columns(), field.rows())),
          mesher_(tree_, colours_), detail_(terrain::quadtree_detail(options.lod)) {}

    terrain::GroundSamples ground() const override { return terrain::GroundSamples(tree_.field()); }

    Range range() const override {
        constexpr double largest_resolution = 5000.0;
        return {1.0 / largest_resolution, 1.0 / tree_.options().min_resolution};
    }

    terrain::GroundMesh mesh(const terrain::MeshView& view, double coarseness) override {
        detail_.resolution = 1.0 / coarseness;
        return mesher_.mesh(view, detail_);
    }

    terrain::GroundMesh mesh_within(const terrain::MeshView& view, int triangles) override {
        terrain::TriangleBudget budget;
        budget.triangles = triangles;
        return mesher_.mesh_within(view, detail_, budget);
    }

private:
    terrain::Quadtree tree_;
    std::vector<std::uint32_t> colours_;
    terrain::QuadtreeMesher mesher_;
    terrain::QuadtreeDetail detail_;
};

/// The default; coarseness is pixels.
class ErrorMaker final : public MeshMaker {
public:
    ErrorMaker(const LoadedGround& ground, const GroundMeshOptions& options)
        : tiles_(ground.tiles()), mesher_(tiles_), finest_px_(options.error_px.value_or(0.0)),
          geomorphs_(options.geomorphs) {}

    terrain::GroundSamples ground() const override { return terrain::GroundSamples(tiles_); }

    Range range() const override {
        constexpr double finest_px = 0.01;
        constexpr double coarsest_px = 200.0;
        return {finest_px, coarsest_px};
    }

    terrain::GroundMesh mesh(const terrain::MeshView& view, double coarseness) override {
        return mesher_.mesh(view, {coarseness, terrain::unlimited_triangles, geomorphs_});
    }

    terrain::GroundMesh mesh_within(const terrain::MeshView& view, int triangles) override {
        return mesher_.mesh(view, {finest_px_, triangles, geomorphs_});
    }

private:
    terrain::GroundTiles tiles_;
    terrain::BisectionMesher mesher_;
    double finest_px_;
    bool geomorphs_;
};

} // namespace

std::unique_ptr<MeshMaker> make_mesh_maker(const LoadedGround& ground, const GroundMeshOptions& options) {
    if (terrain::ground_metric(options.lod) == terrain::GroundMetric::ScreenError) {
        return std::make_unique<ErrorMaker>(ground, options);
    }
    if (ground.field() == nullptr) {
        throw Error(fmt::format(
            "--terrain-lod: expected screen-error for an imported ground, got {}", settings::text_of(options.lod)));
    }
    return std::make_unique<QuadtreeMaker>(*ground.field(), options);
}

terrain::GroundMesh mesh_from_options(
    MeshMaker& maker, const terrain::MeshView& view, const GroundMeshOptions& options) {
    const bool by_error = terrain::ground_metric(options.lod) == terrain::GroundMetric::ScreenError;
    if (options.triangles) { return maker.mesh_within(view, *options.triangles); }
    if (by_error && options.error_px) { return maker.mesh(view, *options.error_px); }
    if (!by_error && options.lod.resolution_c > 0.0) { return maker.mesh(view, 1.0 / options.lod.resolution_c); }
    throw Error(by_error ? "expected --triangles N or --error-px E, got neither"
                         : "expected --triangles N or --terrain-lod KIND:resolution-c=C for this mesh, got neither");
}

std::string ply_of(const visuals::terrain::GroundMesh& mesh, const glm::dvec3& eye_m, bool ascii) {
    const std::string head =
        fmt::format("ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty "
                    "double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
            ascii ? "ascii" : "binary_little_endian", mesh.vertices.size(), mesh.indices.size() / 3);
    BinaryWriter out;
    out.put_bytes(head);
    for (const models::ColourVertex& vertex : mesh.vertices) {
        const glm::dvec3 world_m = eye_m + glm::dvec3(vertex.position_m);
        if (ascii) {
            out.put_bytes(fmt::format("{:.9g} {:.9g} {:.9g}\n", world_m.x, world_m.y, world_m.z));
        } else {
            out.put(world_m);
        }
    }
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        if (ascii) {
            out.put_bytes(fmt::format("3 {} {} {}\n", mesh.indices[k], mesh.indices[k + 1], mesh.indices[k + 2]));
        } else {
            out.put(std::uint8_t{3});
            for (std::size_t i = 0; i < 3; ++i) { out.put(static_cast<std::int32_t>(mesh.indices[k + i])); }
        }
    }
    return out.take();
}

} // namespace octant::ui::terrain
