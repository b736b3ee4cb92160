#include "tests/ui/library/rays/ray_scene.h"

#include "tests/ui/library/rays/vectors.h"

#include <cmath>
#include <embree3/rtcore.h>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace octant::tests {

namespace {

/// "terrain" or "aircraft-2".
std::pair<SurfaceClass, std::uint32_t> group_of(const std::string& name) {
    const std::size_t dash = name.find('-');
    const std::string surface = name.substr(0, dash);
    for (std::size_t i = 0; i < surface_class_count; ++i) {
        const auto one = static_cast<SurfaceClass>(i);
        if (name_of(one) == surface) {
            return {
                one, dash == std::string::npos ? 0U : static_cast<std::uint32_t>(std::stoul(name.substr(dash + 1)))};
        }
    }
    throw std::runtime_error("no class of the name of the group " + name);
}

} // namespace

std::vector<SceneTriangle> read_scene(const std::string& file) {
    std::ifstream in(file);
    if (!in) { throw std::runtime_error("cannot read " + file); }
    std::vector<SceneTriangle> triangles;
    std::vector<Vec3> vertices;
    std::pair<SurfaceClass, std::uint32_t> group;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "g") {
            std::string name;
            words >> name;
            group = group_of(name);
        } else if (kind == "v") {
            Vec3& at = vertices.emplace_back();
            if (!(words >> at.x >> at.y >> at.z)) { throw std::runtime_error(file + ": bad vertex: " + line); }
        } else if (kind == "f") {
            std::array<std::size_t, 3> index{};
            if (!(words >> index[0] >> index[1] >> index[2])) {
                throw std::runtime_error(file + ": bad face: " + line);
            }
            SceneTriangle triangle{{vertices.at(index[0] - 1), vertices.at(index[1] - 1), vertices.at(index[2] - 1)},
                {}, group.first, group.second};
            const Vec3 normal = cross(minus(triangle.corners_m[1], triangle.corners_m[0]),
                minus(triangle.corners_m[2], triangle.corners_m[0]));
            const double size = length(normal);
            if (size > 0.0) {
                triangle.normal = times(1.0 / size, normal);
                triangles.push_back(triangle);
            }
        }
    }
    return triangles;
}

struct RayScene::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<SceneTriangle> triangles; ///< with the eye subtracted

    Embree() = default;
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;
    Embree(Embree&&) = delete;
    Embree& operator=(Embree&&) = delete;

    ~Embree() {
        if (scene != nullptr) { rtcReleaseScene(scene); }
        if (device != nullptr) { rtcReleaseDevice(device); }
    }

    static void leave_out_back_faces(const RTCFilterFunctionNArguments* given) {
        const auto& self = *static_cast<const Embree*>(given->geometryUserPtr);
        for (unsigned i = 0; i < given->N; ++i) {
            if (given->valid[i] == 0) { continue; }
            const Vec3 ray{RTCRayN_dir_x(given->ray, given->N, i), RTCRayN_dir_y(given->ray, given->N, i),
                RTCRayN_dir_z(given->ray, given->N, i)};
            const SceneTriangle& triangle = self.triangles[RTCHitN_primID(given->hit, given->N, i)];
            if (dot(triangle.normal, ray) >= 0.0) { given->valid[i] = 0; }
        }
    }
};

RayScene::RayScene(std::vector<SceneTriangle> triangles, const Vec3& eye_m) : embree_(std::make_shared<Embree>()) {
    embree_->device = rtcNewDevice("threads=1");
    if (embree_->device == nullptr) { throw std::runtime_error("Embree has no device"); }
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(embree_->scene, RTC_BUILD_QUALITY_HIGH);
    embree_->triangles = std::move(triangles);
    RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t count = embree_->triangles.size();
    auto* corners = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
    unsigned next = 0;
    for (SceneTriangle& triangle : embree_->triangles) {
        for (Vec3& corner : triangle.corners_m) {
            corner = minus(corner, eye_m);
            *corners++ = static_cast<float>(corner.x);
            *corners++ = static_cast<float>(corner.y);
            *corners++ = static_cast<float>(corner.z);
            *indices++ = next++;
        }
    }
    rtcSetGeometryUserData(geometry, embree_.get());
    rtcSetGeometryIntersectFilterFunction(geometry, Embree::leave_out_back_faces);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree_->scene);
}

std::optional<RayScene::Hit> RayScene::nearest(const Vec3& ray, double from) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.dir_x = static_cast<float>(ray.x);
    query.ray.dir_y = static_cast<float>(ray.y);
    query.ray.dir_z = static_cast<float>(ray.z);
    query.ray.tnear = static_cast<float>(from);
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0U;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) { return std::nullopt; }
    return Hit{query.hit.primID, way_to_plane(query.hit.primID, ray)};
}

double RayScene::way_to_plane(std::size_t triangle, const Vec3& ray) const {
    const SceneTriangle& at = embree_->triangles[triangle];
    return dot(at.normal, at.corners_m[0]) / dot(at.normal, ray);
}

const std::vector<SceneTriangle>& RayScene::triangles() const { return embree_->triangles; }

} // namespace octant::tests
