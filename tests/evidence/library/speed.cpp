// Pictures per CPU second of liboctant, beside Embree (depth only) and, with TINY_RENDERER, PyBullet's TinyRenderer on
// the same triangles. Prints Markdown. speed.sh compiles and runs it.
#include "tests/ui/library/rays/ray_scene.h"
#include "tests/ui/library/rays/vectors.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <embree3/rtcore.h>
#include <fstream>
#include <functional>
#include <limits>
#include <octant/octant.h>
#include <span>
#include <string>
#include <unistd.h>
#include <vector>

#ifdef TINY_RENDERER
#include "tests/evidence/library/tiny_picture.h"
#endif

using namespace octant;
using namespace octant::tests;

namespace {

constexpr Output all_outputs =
    Output::Rgb | Output::Depth | Output::ClassId | Output::ObjectId | Output::Normal | Output::Flow;

double cpu_s() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double resident_mb() {
    std::ifstream in("/proc/self/statm");
    double all = 0.0;
    double resident = 0.0;
    in >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Pictures per second of repeats of some pictures.
struct Rate {
    double median = 0.0;
    double slowest_tenth = 0.0; ///< a tenth of the repeats are slower
};

/// Repeats `work`, which makes `pictures`, for at least `least_s` and 7 times.
Rate rate_of(double pictures, const std::function<void()>& work, double (*clock)() = cpu_s, double least_s = 0.7) {
    work();
    std::vector<double> rates;
    for (double all = 0.0; all < least_s || rates.size() < 7;) {
        const double begin = clock();
        work();
        const double took = clock() - begin;
        all += took;
        rates.push_back(pictures / took);
    }
    std::ranges::sort(rates);
    return {rates[rates.size() / 2], rates[rates.size() / 10]};
}

constexpr std::size_t pose_count = 1000;
constexpr std::size_t round_count = 100; ///< cameras of a round of "draw" and of a call that remembers

/// As in an example of Python: cameras over the map, here with aircraft ahead of each. There are so many that a call
/// hardly ever meets ground that was seen before.
struct Cameras {
    std::vector<Pose> poses;
    std::vector<State> states; ///< two for each pose

    explicit Cameras(const World& world) {
        for (const Vec3& eye : world.random_positions(pose_count, 30.0, 300.0, 7)) {
            const double heading_deg = 3.6 * static_cast<double>(poses.size());
            Pose pose{.eye_m = eye, .attitude = attitude(heading_deg, -10.0)};
            pose.previous_eye_m = minus(eye, {1.0, 1.0, 1.0});
            poses.push_back(pose);
            State state;
            state.position_m = plus(eye, turned(pose.attitude, {35.0, -6.0, 2.0}));
            state.attitude = attitude(heading_deg + 70.0, 10.0, 20.0);
            states.push_back(state);
            state.position_m = plus(eye, turned(pose.attitude, {30.0, 9.0, -1.0}));
            states.push_back(state);
        }
    }
};

World world_of(int triangles) {
    WorldSettings settings{.terrain = "hills", .aircraft = {"f15-detailed", "500md-detailed"}};
    settings.sun_elevation_deg = 25.0;
    settings.triangles = triangles;
    settings.on_note = [](std::string_view) {};
    return World(settings);
}

Rate octant_rate(const World& world, const Cameras& cameras, const Camera& camera, Output outputs, std::size_t count,
    int threads = 1, double (*clock)() = cpu_s) {
    Frames frames;
    RenderOptions options;
    options.threads = threads;
    std::size_t first = 0;
    return rate_of(
        static_cast<double>(count),
        [&] {
            options.states = std::span(cameras.states).subspan(2 * first, 2 * count);
            frames = world.render(camera, std::span(cameras.poses).subspan(first, count), outputs, options);
            first = (first + count) % pose_count;
        },
        clock);
}

/// The triangles of each pose, and rays through them in packets of 16.
class EmbreePictures {
public:
    EmbreePictures(const World& world, const Cameras& cameras, const Camera& camera, std::size_t count) {
        device_ = rtcNewDevice("threads=1,set_affinity=0");
        const std::string file = "/tmp/octant-speed-" + std::to_string(getpid()) + ".obj";
        for (std::size_t i = 0; i < count; ++i) {
            World placed = world;
            placed.set_states(std::span(cameras.states).subspan(2 * i, 2));
            placed.export_scene(file, camera, cameras.poses[i]);
            triangles.push_back(read_scene(file));
            for (SceneTriangle& triangle : triangles.back()) {
                for (Vec3& corner : triangle.corners_m) { corner = minus(corner, cameras.poses[i].eye_m); }
            }
        }
        std::remove(file.c_str());
    }

    EmbreePictures(const EmbreePictures&) = delete;
    EmbreePictures& operator=(const EmbreePictures&) = delete;

    ~EmbreePictures() {
        for (RTCScene scene : scenes_) { rtcReleaseScene(scene); }
        rtcReleaseDevice(device_);
    }

    RTCScene build(std::size_t picture) const {
        RTCScene scene = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        const std::vector<SceneTriangle>& of = triangles[picture];
        auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * of.size()));
        auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), of.size()));
        for (const SceneTriangle& triangle : of) {
            for (const Vec3& corner : triangle.corners_m) {
                *corners++ = static_cast<float>(corner.x);
                *corners++ = static_cast<float>(corner.y);
                *corners++ = static_cast<float>(corner.z);
            }
        }
        for (unsigned i = 0; i < 3 * of.size(); ++i) { *indices++ = i; }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
        return scene;
    }

    void build_all() {
        for (std::size_t i = 0; i < triangles.size(); ++i) { scenes_.push_back(build(i)); }
    }

    void trace(RTCScene scene, const Camera& camera, const Pose& pose, std::vector<float>& depth) const {
        const Intrinsics matrix = camera.matrix();
        const Vec3 ahead = turned(pose.attitude, {1.0, 0.0, 0.0});
        const Vec3 right = turned(pose.attitude, {0.0, 1.0, 0.0});
        const Vec3 down = turned(pose.attitude, {0.0, 0.0, 1.0});
        alignas(64) int valid[16];
        std::ranges::fill(valid, -1);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        // Blocks of 4 x 4 pixels.
        for (int row = 0; row < camera.height; row += 4) {
            for (int column = 0; column < camera.width; column += 4) {
                RTCRayHit16 rays;
                for (int i = 0; i < 16; ++i) {
                    const auto x = static_cast<float>((column + i % 4 - matrix.cx) / matrix.fx);
                    const auto y = static_cast<float>((row + i / 4 - matrix.cy) / matrix.fy);
                    rays.ray.org_x[i] = rays.ray.org_y[i] = rays.ray.org_z[i] = 0.0F;
                    rays.ray.dir_x[i] =
                        static_cast<float>(ahead.x) + x * static_cast<float>(right.x) + y * static_cast<float>(down.x);
                    rays.ray.dir_y[i] =
                        static_cast<float>(ahead.y) + x * static_cast<float>(right.y) + y * static_cast<float>(down.y);
                    rays.ray.dir_z[i] =
                        static_cast<float>(ahead.z) + x * static_cast<float>(right.z) + y * static_cast<float>(down.z);
                    rays.ray.tnear[i] = 0.5F;
                    rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
                    rays.ray.mask[i] = ~0U;
                    rays.ray.flags[i] = 0;
                    rays.ray.time[i] = 0.0F;
                    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
                    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
                }
                rtcIntersect16(valid, scene, &context, &rays);
                for (int i = 0; i < 16; ++i) {
                    depth[static_cast<std::size_t>((row + i / 4) * camera.width + column + i % 4)] = rays.ray.tfar[i];
                }
            }
        }
    }

    RTCScene scene(std::size_t picture) const { return scenes_[picture]; }

    std::vector<std::vector<SceneTriangle>> triangles; ///< with the eye subtracted

private:
    RTCDevice device_;
    std::vector<RTCScene> scenes_;
};

#ifdef TINY_RENDERER
TinyPicture tiny_picture(const std::vector<SceneTriangle>& triangles, const Camera& camera, const Pose& pose) {
    std::vector<float> corners;
    std::vector<float> normals;
    for (const SceneTriangle& triangle : triangles) {
        for (const Vec3& corner : triangle.corners_m) {
            for (const double value : {corner.x, corner.y, corner.z}) { corners.push_back(static_cast<float>(value)); }
        }
        for (const double value : {triangle.normal.x, triangle.normal.y, triangle.normal.z}) {
            normals.push_back(static_cast<float>(value));
        }
    }
    TinyCamera tiny{camera.width, camera.height, camera.matrix().fy, {}};
    const Vec3 axes[3] = {turned(pose.attitude, {0.0, 1.0, 0.0}), turned(pose.attitude, {0.0, 0.0, -1.0}),
        turned(pose.attitude, {-1.0, 0.0, 0.0})};
    for (int i = 0; i < 3; ++i) {
        tiny.axes[i][0] = axes[i].x;
        tiny.axes[i][1] = axes[i].y;
        tiny.axes[i][2] = axes[i].z;
    }
    return {corners, normals, tiny};
}
#endif

struct Size {
    int width;
    int height;
};

constexpr Size sizes[] = {{64, 64}, {128, 128}, {256, 256}, {640, 360}};

void compare(const World& world, const Cameras& cameras) {
    std::printf("| picture | cameras a call | RGB: median, slowest tenth | RGB and all truth |\n|---|---|---|---|\n");
    for (const Size& size : sizes) {
        const Camera camera{size.width, size.height, 60.0};
        for (const std::size_t count : {1UL, 10UL, 100UL}) {
            const Rate rgb = octant_rate(world, cameras, camera, Output::Rgb, count);
            const Rate all = octant_rate(world, cameras, camera, all_outputs, count);
            std::printf("| %d x %d | %zu | %.0f, %.0f | %.0f, %.0f |\n", size.width, size.height, count, rgb.median,
                rgb.slowest_tenth, all.median, all.slowest_tenth);
            std::fflush(stdout);
        }
    }
    std::printf(
        "\n| picture | liboctant RGB | RGB, 1 sample | depth alone | all truth | Embree, depth | Embree with its build "
        "| TinyRenderer |\n|---|---|---|---|---|---|---|---|\n");
    for (const Size& size : sizes) {
        const Camera camera{size.width, size.height, 60.0};
        Camera rough = camera;
        rough.samples = 1;
        constexpr std::size_t count = 20;
        EmbreePictures embree(world, cameras, camera, count);
        embree.build_all();
        std::vector<float> depth(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
        const Rate traced = rate_of(count, [&] {
            for (std::size_t i = 0; i < count; ++i) { embree.trace(embree.scene(i), camera, cameras.poses[i], depth); }
        });
        const Rate built = rate_of(count, [&] {
            for (std::size_t i = 0; i < count; ++i) {
                RTCScene scene = embree.build(i);
                embree.trace(scene, camera, cameras.poses[i], depth);
                rtcReleaseScene(scene);
            }
        });
        double tiny = 0.0;
        double filled = 0.0;
#ifdef TINY_RENDERER
        std::vector<TinyPicture> pictures;
        for (std::size_t i = 0; i < count; ++i) {
            pictures.push_back(tiny_picture(embree.triangles[i], camera, cameras.poses[i]));
        }
        tiny = rate_of(count, [&] {
            for (const TinyPicture& picture : pictures) { picture.draw(); }
        }).median;
        for (const TinyPicture& picture : pictures) { filled += picture.filled() / static_cast<double>(count); }
#endif
        double triangles = 0.0;
        for (const auto& of : embree.triangles) { triangles += static_cast<double>(of.size()) / count; }
        const Rate rgb = octant_rate(world, cameras, camera, Output::Rgb, count);
        const Rate one = octant_rate(world, cameras, rough, Output::Rgb, count);
        const Rate deep = octant_rate(world, cameras, camera, Output::Depth, count);
        const Rate all = octant_rate(world, cameras, camera, all_outputs, count);
        std::printf("| %d x %d | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f |\n", size.width, size.height,
            rgb.median, one.median, deep.median, all.median, traced.median, built.median, tiny);
        std::fprintf(stderr, "%.0f triangles a picture; TinyRenderer fills %.3f of its pictures\n", triangles, filled);
        std::fflush(stdout);
    }
}

void scale(const World& world, const Cameras& cameras) {
    const Camera camera{128, 128, 60.0};
    for (const Output outputs : {Output::Rgb, all_outputs}) {
        const Rate one = octant_rate(world, cameras, camera, outputs, 100, 1, wall_s);
        const Rate two = octant_rate(world, cameras, camera, outputs, 100, 2, wall_s);
        const Rate two_cpu = octant_rate(world, cameras, camera, outputs, 100, 2, cpu_s);
        const Rate one_cpu = octant_rate(world, cameras, camera, outputs, 100, 1, cpu_s);
        std::printf(
            "two threads, %s: %.2f times the pictures per second of wall time of one, %.3f of those per CPU second\n",
            outputs == Output::Rgb ? "RGB" : "all", two.median / one.median, two_cpu.median / one_cpu.median);
    }
}

void remember(const World& world, const Cameras& cameras, int pictures) {
    const Camera camera{64, 64, 60.0};
    const auto draw = [&](const World& one, int rounds) {
        for (int i = 0; i < rounds; ++i) {
            one.render(camera, std::span(cameras.poses).first(round_count), all_outputs,
                {.threads = 1, .states = std::span(cameras.states).first(2 * round_count)});
        }
    };
    draw(world, 1);
    double before = resident_mb();
    std::vector<World> copies(20, world);
    for (World& copy : copies) {
        copy.set_states(std::span(cameras.states).subspan(0, 2));
        copy.render(camera, std::span(cameras.poses).first(1), all_outputs, {.threads = 1});
    }
    std::printf("a further copy with states of its own: %.2f MB\n", (resident_mb() - before) / 20.0);
    before = resident_mb();
    WorldSettings settings{.terrain = "hills", .aircraft = {"f15-detailed", "500md-detailed"}};
    settings.sun_elevation_deg = 40.0;
    settings.triangles = 3000;
    std::vector<World> others;
    for (int i = 0; i < 5; ++i) {
        others.emplace_back(settings, world);
        others.back().render(camera, std::span(cameras.poses).first(1), all_outputs, {.threads = 1});
    }
    std::printf("a further world over the same map with another sun: %.2f MB\n", (resident_mb() - before) / 5.0);
    others.clear();
    draw(world, 20);
    before = resident_mb();
    const double begin = cpu_s();
    draw(world, pictures / static_cast<int>(round_count));
    std::printf("%d pictures of 64 x 64 in a row: resident memory %.2f MB before, %.2f MB after; %.0f a CPU second\n",
        pictures, before, resident_mb(), pictures / (cpu_s() - begin));
}

} // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "compare";
    const double begin = wall_s();
    const double begin_cpu = cpu_s();
    const World world = world_of(3000);
    const Cameras cameras(world);
    if (what == "first") {
        const Camera camera{128, 128, 60.0};
        const double loaded = wall_s();
        world.render(
            camera, std::span(cameras.poses).first(1), Output::Rgb, {.states = std::span(cameras.states).first(2)});
        std::printf("first picture: %.3f s after the start, %.3f s of CPU; the world was loaded after %.3f s\n",
            wall_s() - begin, cpu_s() - begin_cpu, loaded - begin);
    } else if (what == "compare") {
        compare(world, cameras);
    } else if (what == "scale") {
        scale(world, cameras);
    } else if (what == "memory") {
        remember(world, cameras, argc > 2 ? std::stoi(argv[2]) : 100000);
    } else if (what == "draw") { // for profilers
        const Camera camera{128, 128, 60.0};
        for (int i = 0; i < (argc > 2 ? std::stoi(argv[2]) : 1); ++i) {
            const std::size_t first = round_count * static_cast<std::size_t>(i) % pose_count;
            world.render(camera, std::span(cameras.poses).subspan(first, round_count),
                argc > 3 ? all_outputs : Output::Rgb,
                {.threads = 1, .states = std::span(cameras.states).subspan(2 * first, 2 * round_count)});
        }
    } else {
        std::fprintf(stderr, "usage: speed compare|scale|memory [PICTURES]|first|draw [ROUNDS [all]]\n");
        return 2;
    }
}
