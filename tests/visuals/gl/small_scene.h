#pragma once

#include "visuals/gl/context.h"
#include "visuals/gl/renderer.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

// Scenes of a few triangles, seen along -z from the origin in a square picture with a field of view of 90 degrees: what
// is `d` metres ahead at (x d, y d) lands at (x, y) of -1..1.
namespace octant::tests {

using namespace octant::visuals;

constexpr int side_px = 64;

constexpr glm::vec3 red{1.0F, 0.0F, 0.0F};
constexpr glm::vec3 green{0.0F, 1.0F, 0.0F};
constexpr glm::vec3 blue{0.0F, 0.0F, 1.0F};
constexpr glm::vec3 grey{0.5F, 0.5F, 0.5F};

using Pixel = std::array<int, 4>;

/// The two ways in which planners have a scene drawn.
enum class HiddenSurfaceMode { InOrder, ByDepth };
constexpr std::array<HiddenSurfaceMode, 2> all_modes{HiddenSurfaceMode::InOrder, HiddenSurfaceMode::ByDepth};

constexpr Pixel red_px{255, 0, 0, 255};
constexpr Pixel green_px{0, 255, 0, 255};
constexpr Pixel blue_px{0, 0, 255, 255};
constexpr Pixel grey_px{128, 128, 128, 255};

/// Part of the picture, -1..1 from the left and from the bottom.
struct Area {
    float left = -1.0F;
    float bottom = -1.0F;
    float right = 1.0F;
    float top = 1.0F;
};

struct Triangles {
    std::vector<models::ColourVertex> vertices;
    std::vector<std::uint32_t> indices;

    /// A rectangle facing the eye, or turned away from it.
    Triangles& add(Area area, float ahead_m, const glm::vec3& colour, bool faces_eye = true) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        const std::array<glm::vec2, 4> corners{glm::vec2(area.left, area.bottom), glm::vec2(area.right, area.bottom),
            glm::vec2(area.right, area.top), glm::vec2(area.left, area.top)};
        for (const glm::vec2& corner : corners) {
            vertices.push_back({glm::vec3(corner * ahead_m, -ahead_m), models::packed_colour(colour)});
        }
        const std::array<std::uint32_t, 6> seen{0, 1, 2, 0, 2, 3};
        for (std::size_t i = 0; i < 6; ++i) { indices.push_back(first + seen[faces_eye ? i : 5 - i]); }
        return *this;
    }

    scene::TriangleDraw draw() const { return {vertices, indices}; }
};

/// An aircraft that is one square of 2 m facing along +z of its body, two triangles.
inline scene::ModelBuffers square_model(const glm::vec3& colour) {
    scene::ModelBuffers model;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        model.vertices.push_back({glm::vec3(corner, 0.0F), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1),
            models::packed_colour(colour), models::packed_colour(colour)});
    }
    model.indices = {0, 1, 2, 0, 2, 3};
    return model;
}

/// Appends another model's polygons.
void append(scene::ModelBuffers& model, const scene::ModelBuffers& other);

/// The steps of a whole picture for a plan. In order: sky, ground, the plan's own steps, overlay. By depth: all its
/// aircraft and meshes, ground, the last `shadow_indices` of repaint_indices as shadows, sky, overlay.
scene::FramePlan framed(
    scene::FramePlan plan, HiddenSurfaceMode mode = HiddenSurfaceMode::InOrder, int shadow_indices = 0);

/// Nothing but grey background; aircraft keep their own colour.
inline scene::FramePlan empty_plan() {
    scene::Camera camera;
    camera.vertical_fov_rad = 2.0 * std::atan(1.0);
    scene::FramePlan plan;
    plan.view_to_clip = scene::view_to_clip(camera, 1.0);
    plan.background = grey;
    plan.ambient = glm::vec3(1.0F);
    plan.sunlight = glm::vec3(0.0F);
    plan.smooth = {0};
    return plan;
}

/// Ground before grey background.
inline scene::FramePlan plan_of(const Triangles& ground) {
    scene::FramePlan plan = empty_plan();
    plan.ground = ground.draw();
    return plan;
}

/// A place ahead in the middle of the picture; bodies there have the axes of the view.
inline glm::mat4 ahead(float ahead_m) {
    glm::mat4 body_to_eye_world(1.0F);
    body_to_eye_world[3].z = -ahead_m;
    return body_to_eye_world;
}

/// Puts the whole of square_model, as model `model`, behind the aircraft of the plan. Its steps become one with all
/// aircraft.
void add_square(scene::FramePlan& plan, std::uint32_t model, const glm::mat4& body_to_eye_world);

/// Leaves the plan with this one aircraft.
void set_square(scene::FramePlan& plan, std::uint32_t model, const glm::mat4& body_to_eye_world);

inline Pixel pixel(const scene::Picture& picture, int column, int row) {
    const std::size_t at = 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                                   static_cast<std::size_t>(column));
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2], picture.rgba[at + 3]};
}

inline Pixel middle(const scene::Picture& picture) { return pixel(picture, picture.width / 2, picture.height / 2); }

/// A context and a renderer that take a plan to its picture.
class Studio {
public:
    explicit Studio(std::unique_ptr<gl::Context> context = gl::make_osmesa_context(), int samples = 1,
        int width = side_px, int height = side_px)
        : context_(std::move(context)), renderer_(context_, {width, height}, samples) {}

    ~Studio() = default;
    Studio(const Studio&) = delete;
    Studio& operator=(const Studio&) = delete;
    Studio(Studio&&) = delete;
    Studio& operator=(Studio&&) = delete;

    /// Of the framed() plan.
    scene::Picture picture(
        const scene::FramePlan& plan, HiddenSurfaceMode mode = HiddenSurfaceMode::InOrder, int shadow_indices = 0) {
        scene::Picture drawn;
        renderer_.draw(framed(plan, mode, shadow_indices));
        renderer_.finish_and_read(drawn);
        return drawn;
    }

    gl::Renderer& renderer() { return renderer_; }

    gl::Context& context() { return *context_; }

private:
    std::shared_ptr<gl::Context> context_;
    gl::Renderer renderer_;
};

/// A scene with everything in it: hilly ground, a shadow, sky, three aircraft of two models, one with a turning part,
/// one painted again cut by planes, haze. Its plan is valid as long as it lives where it is.
class FullScene {
public:
    FullScene();

    std::span<const scene::ModelBuffers> models() const { return models_; }

    /// Of its repaint_indices the last shadow_indices are all of its shadow.
    scene::FramePlan plan() const;
    static constexpr int shadow_indices = 3;

private:
    Triangles ground_;
    Triangles sky_;
    std::vector<scene::ModelBuffers> models_;
};

/// Models 0 red, 1 green and 2 blue, each a square_model.
void load_squares(Studio& studio, bool as_meshes = false);

/// Number of pixels of that colour.
int count_of(const scene::Picture& picture, const Pixel& colour);

/// Number of pixels of which a part differs by more than `tolerance`.
int differing(const scene::Picture& a, const scene::Picture& b, int tolerance);

/// Hash of the picture of FullScene, drawn in order and by depth.
std::uint64_t hash_of_full_scene(Studio& studio);

} // namespace octant::tests
