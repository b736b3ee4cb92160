#include "tests/visuals/terrain/pixel_errors.h"

#include "sim/base/plane.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace octant::visuals::terrain::test {

namespace {

double area2(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return signed_area2(glm::dvec2(a), glm::dvec2(b), glm::dvec2(c));
}

/// The samples of a ground as a picture shows them.
class SamplesInPicture {
public:
    SamplesInPicture(const GroundTiles& ground, const TestPicture& picture, double earth_radius_m)
        : ground_(ground), picture_(picture), curvature_(earth_radius_m > 0.0 ? 0.5 / earth_radius_m : 0.0),
          first_m_(-ground.half_extent_m() - glm::dvec2(picture.eye_m)) {}

    /// Adds the errors of the samples that lie in one triangle, rim included.
    void measure(const std::array<glm::dvec3, 3>& t, std::vector<float>& errors_px) const {
        const double whole = area2(t[0], t[1], t[2]);
        const auto [west, east] = std::minmax({t[0].x, t[1].x, t[2].x});
        const auto [south, north] = std::minmax({t[0].y, t[1].y, t[2].y});
        const double spacing_m = ground_.spacing_m();
        const auto first = [&](double from, double at) {
            return static_cast<int>(std::ceil((at - from) / spacing_m - 1e-3));
        };
        const auto last = [&](double from, double at) {
            return static_cast<int>(std::floor((at - from) / spacing_m + 1e-3));
        };
        for (int row = first(first_m_.y, south); row <= last(first_m_.y, north); ++row) {
            for (int column = first(first_m_.x, west); column <= last(first_m_.x, east); ++column) {
                const glm::dvec3 sample = sample_m(column, row);
                const double a = area2(sample, t[1], t[2]) / whole;
                const double b = area2(t[0], sample, t[2]) / whole;
                const double c = 1.0 - a - b;
                if (std::min({a, b, c}) < -1e-5) { continue; }
                const glm::dvec3 there = picture_.seen(sample);
                if (picture_.shows(there)) {
                    const double drawn_m = a * t[0].z + b * t[1].z + c * t[2].z;
                    const glm::dvec3 here = picture_.seen({sample.x, sample.y, drawn_m});
                    errors_px.push_back(static_cast<float>(std::hypot(here.x - there.x, here.y - there.y)));
                }
            }
        }
    }

private:
    glm::dvec3 sample_m(int column, int row) const {
        const double x = first_m_.x + column * ground_.spacing_m();
        const double y = first_m_.y + row * ground_.spacing_m();
        const double height_m = static_cast<double>(ground_.height_m(column, row));
        return {x, y, height_m - picture_.eye_m.z - curvature_ * (x * x + y * y)};
    }

    const GroundTiles& ground_;
    const TestPicture& picture_;
    double curvature_;
    glm::dvec2 first_m_;
};

} // namespace

TestPicture::TestPicture(const glm::dvec3& eye, const glm::dvec3& look)
    : eye_m(eye), ahead(glm::normalize(look - eye)),
      right(glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 0.0, 1.0)))), up(glm::cross(right, ahead)) {}

MeshView TestPicture::view(double earth_radius_m) const {
    MeshView view;
    view.eye_m = eye_m;
    view.focal_px = focal_px;
    view.ahead = ahead;
    view.corner_cos = focal_px / std::hypot(focal_px, half_width_px, half_height_px);
    view.earth_radius_m = earth_radius_m;
    view.frustum_normals = {glm::normalize(focal_px * right + half_width_px * ahead),
        glm::normalize(-focal_px * right + half_width_px * ahead),
        glm::normalize(focal_px * up + half_height_px * ahead),
        glm::normalize(-focal_px * up + half_height_px * ahead)};
    return view;
}

glm::dvec3 TestPicture::seen(const glm::dvec3& at_m) const {
    const double depth_m = glm::dot(at_m, ahead);
    return {focal_px * glm::dot(at_m, right) / depth_m, focal_px * glm::dot(at_m, up) / depth_m, depth_m};
}

bool TestPicture::shows(const glm::dvec3& seen_px) const {
    return seen_px.z > 10.0 && std::abs(seen_px.x) <= half_width_px && std::abs(seen_px.y) <= half_height_px;
}

PixelErrors pixel_errors(
    const GroundMesh& mesh, const GroundTiles& ground, const TestPicture& picture, double earth_radius_m) {
    const SamplesInPicture samples(ground, picture, earth_radius_m);
    std::vector<float> errors_px;
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        samples.measure({glm::dvec3(mesh.vertices[mesh.indices[k]].position_m),
                            glm::dvec3(mesh.vertices[mesh.indices[k + 1]].position_m),
                            glm::dvec3(mesh.vertices[mesh.indices[k + 2]].position_m)},
            errors_px);
    }
    if (errors_px.empty()) { return {}; }
    std::ranges::sort(errors_px);
    return {static_cast<double>(errors_px.back()), static_cast<double>(errors_px[(errors_px.size() - 1) * 999 / 1000]),
        static_cast<int>(errors_px.size())};
}

} // namespace octant::visuals::terrain::test
