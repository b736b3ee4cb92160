#include "models/triangle_mesh.h"
#include "ui/studies/hybrid_shading/study_shading.h"
#include "ui/studies/shading_pictures.h"
#include "visuals/shading/vertex_normals.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace octant;
using namespace octant::ui::studies;
using namespace octant::ui::studies::hybrid_shading;
namespace shading = octant::visuals::shading;

namespace {

const shading::ShadingLight from_above{
    .to_light = {0.0F, 0.0F, 1.0F}, .ambient = 0.0F, .diffuse = 1.0F, .specular = 0.0F};

/// Two level triangles that make the square from -1 to 1; normals of the one with the corner (-1, 1) are tilted by 60
/// degrees there.
shading::ShadedPolygons square() {
    models::TriangleMesh mesh;
    mesh.vertices_m = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.colours.assign(4, glm::vec3(1.0F, 0.0F, 0.0F));
    std::vector<glm::vec3> normals(6, glm::vec3(0.0F, 0.0F, 1.0F));
    normals[5] = {std::sqrt(0.75F), 0.0F, 0.5F};
    return shading::shaded_polygons(mesh, normals);
}

LightPicture even(float light) { return {8, std::vector<float>(64, light)}; }

const std::vector<std::uint8_t> everywhere(64, 1);

const ShadedModel& model_of(const std::vector<ShadedModel>& models, const std::string& name) {
    return *std::ranges::find(models, name, &ShadedModel::name);
}

void check_gain(const ShadingRun& run) {
    for (std::size_t step = 1; step <= 3; ++step) {
        const double theirs_db = run.rules[paper_rule].to_gouraud[step].psnr_db();
        INFO(run.name << ", " << step * share_step_percent << " %");
        CHECK(run.rules[error_rule].to_gouraud[step].psnr_db() >= theirs_db + 2.0);
    }
}

} // namespace

TEST_CASE("a flat triangle has one light, a smooth one that of its corners between them") {
    const shading::ShadedPolygons polygons = square();
    const ShadingPictures pictures(polygons, from_above, {0.0, 1e-3, 10.0}, 101);
    const LightPicture flat = pictures.hybrid(std::vector<std::uint8_t>{0, 0});
    const LightPicture hybrid = pictures.hybrid(std::vector<std::uint8_t>{0, 1});
    int covered = 0;
    int darker = 0;
    float darkest = 1.0F;
    for (std::size_t i = 0; i < flat.light.size(); ++i) {
        if (pictures.covered()[i] != 0) {
            ++covered;
            CHECK(flat.light[i] == 1.0F);
            darker += hybrid.light[i] < 0.999F ? 1 : 0;
            darkest = std::min(darkest, hybrid.light[i]);
        } else {
            CHECK(hybrid.light[i] == 0.0F);
        }
    }
    CHECK(covered == 97 * 97); // 97 % of the picture's side
    CHECK(std::abs(darker - covered / 2) < 100);
    CHECK(darkest == Approx(0.5).margin(0.02));
}

TEST_CASE("light that is 0.3 too bright everywhere is 20 dB below white") {
    CHECK(mean_square_error(even(1.3F), even(1.0F), everywhere) == Approx(0.09));
    CHECK(psnr_db(0.09) == Approx(20.0));
}

TEST_CASE("what is not covered does not count") {
    LightPicture picture = even(1.0F);
    picture.light[0] = 5.0F;
    std::vector<std::uint8_t> covered = everywhere;
    covered[0] = 0;
    CHECK(mean_square_error(picture, even(1.0F), covered) == 0.0);
    CHECK(structural_similarity(picture, even(1.0F), covered) == Approx(1.0));
}

TEST_CASE("a picture is like itself, less like itself in stripes") {
    LightPicture stripes = even(1.0F);
    for (std::size_t i = 0; i < stripes.light.size(); i += 2) { stripes.light[i] = 2.0F; }
    CHECK(structural_similarity(stripes, stripes, everywhere) == Approx(1.0));
    CHECK(structural_similarity(stripes, even(1.5F), everywhere) < 0.1);
}

TEST_CASE("at 10, 20 and 30 % the error rule is 2 dB and more above the paper's") {
    const std::vector<ShadedModel> models = shading_models({});
    for (const char* name : {"torus of 416 triangles", "torus of 416 quads", "uneven ball"}) {
        check_gain(run_shading(model_of(models, name), 100, [] {}));
    }
}

TEST_CASE("more smooth polygons are never worse by any rule, none are flat and all are exact") {
    const std::vector<ShadedModel> models = shading_models({});
    for (const char* name : {"torus of 416 quads", "f15", "500md"}) {
        const ShadingRun run = run_shading(model_of(models, name), 100, [] {});
        for (const RuleQuality& rule : run.rules) {
            INFO(name << ", " << rule.name);
            const auto& shares = rule.to_gouraud;
            CHECK(shares.front().psnr_db() == run.rules[random_rule].to_gouraud.front().psnr_db());
            for (std::size_t step = 1; step < share_steps; ++step) {
                CHECK(shares[step].psnr_db() >= shares[step - 1].psnr_db());
            }
            CHECK(std::isinf(shares.back().psnr_db()));
        }
    }
}
