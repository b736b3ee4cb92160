#include "ui/flight/id_comparison.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <memory>

namespace octant::ui::flight {

namespace {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

std::uint32_t id_at(const scene::Picture& picture, int x, int y) {
    std::uint32_t id = 0;
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
        static_cast<std::size_t>(x);
    std::memcpy(&id, picture.rgba.data() + 4 * pixel, sizeof id);
    return id;
}

/// Whether a number occurs in the picture within `reach` pixels of a place, in either direction.
bool occurs_around(
    const scene::Picture& picture, const glm::ivec2& at, int reach, std::uint32_t id) {
    for (int v = std::max(at.y - reach, 0); v <= std::min(at.y + reach, picture.height - 1); ++v) {
        for (int u = std::max(at.x - reach, 0); u <= std::min(at.x + reach, picture.width - 1);
             ++u) {
            if (id_at(picture, u, v) == id) {
                return true;
            }
        }
    }
    return false;
}

/// Draws a frame by depth, three times as large, when it is asked for.
class LargeReference {
public:
    static constexpr int scale = 3; // odd: the middles of the pixels are middles here too

    LargeReference(const settings::RunSettings& settings, const world::World& world)
        : settings_(settings)
        , world_(world) {
        settings_.view.size_px *= scale;
    }

    const scene::Picture& picture(int frame) {
        if (!session_) {
            session_ = std::make_unique<Session>(settings_, Shows::PolygonNumbers, nullptr, world_);
        }
        session_->draw(frame);
        return session_->picture();
    }

private:
    settings::RunSettings settings_;
    const world::World& world_;
    std::unique_ptr<Session> session_;
};

} // namespace

IdDifference difference_of(const scene::Picture& picture, const scene::Picture& reference) {
    assert(picture.width == reference.width && picture.height == reference.height);
    IdDifference difference;
    difference.pixels = static_cast<long>(picture.width) * picture.height;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const std::uint32_t id = id_at(picture, x, y);
            if (id == id_at(reference, x, y)) {
                continue;
            }
            ++difference.differing;
            if (!occurs_around(reference, {x, y}, 1, id)) {
                difference.apart.emplace_back(x, y);
            }
        }
    }
    return difference;
}

long wrong_among(
    std::span<const glm::ivec2> pixels,
    const scene::Picture& picture,
    const scene::Picture& large_reference,
    int scale) {
    return std::ranges::count_if(pixels, [&](const glm::ivec2& pixel) {
        const glm::ivec2 middle = pixel * scale + scale / 2;
        const int reach = scale + scale / 2;
        return !occurs_around(large_reference, middle, reach, id_at(picture, pixel.x, pixel.y));
    });
}

ComparedSettings compared_settings(const settings::RunSettings& settings) {
    ComparedSettings compared{settings, settings};
    for (settings::RunSettings* one : {&compared.painted, &compared.by_depth}) {
        one->surface.shadows = false;
        one->view.samples = 1;
    }
    settings::RunSettings& by_depth = compared.by_depth;
    by_depth.surface.hidden_surface = scene::HiddenSurface::DepthBuffer;
    // What is seen through has no numbers, and no depth.
    by_depth.surface.effects = false;
    by_depth.air.clouds = 0.0;
    by_depth.view.path_ribbon = false;
    return compared;
}

ComparedWorlds compared_worlds(const settings::RunSettings& settings) {
    const auto [painted, by_depth] = compared_settings(settings);
    ComparedWorlds worlds{.painted = world::load_world(painted), .by_depth = {}};
    worlds.by_depth = world::load_world(by_depth, world::DrawnBy::Processor, &worlds.painted);
    return worlds;
}

IdComparison compare_with_depth_buffer(
    const settings::RunSettings& settings,
    const ComparedWorlds& worlds,
    int every,
    const std::function<void(int compared, int frames)>& seen) {
    const auto [painted, by_depth] = compared_settings(settings);
    Session painter(painted, Shows::PolygonNumbers, nullptr, worlds.painted);
    Session reference(by_depth, Shows::PolygonNumbers, nullptr, worlds.by_depth);
    LargeReference large(by_depth, worlds.by_depth);
    IdComparison sum;
    const int frames = (painter.frames() + every - 1) / every;
    for (int frame = 0; frame < painter.frames(); frame += every) {
        const report::FrameRecord record = painter.draw(frame);
        reference.draw(frame);
        const IdDifference difference = difference_of(painter.picture(), reference.picture());
        sum.pixels += difference.pixels;
        sum.differing += difference.differing;
        if (!difference.apart.empty()) {
            sum.apart += static_cast<long>(difference.apart.size());
            sum.wrong += wrong_among(
                difference.apart, painter.picture(), large.picture(frame), LargeReference::scale);
        }
        sum.cuts += record.cuts;
        sum.unordered += record.unordered;
        sum.frames_with_cuts += record.cuts > 0 ? 1 : 0;
        seen(++sum.frames, frames);
    }
    return sum;
}

namespace {

scene::Picture number_picture(Session& session, const settings::RunSettings& settings) {
    // Meshed by the session's settings, so that all pictures show the same triangles.
    const planning::Scene& scene = session.world().scene;
    planning::Planner planner(
        scene,
        settings,
        scene.ground->mesher(
            landscape::mesh_settings(session.settings(), scene.ground_texture != nullptr)));
    planner.settle(session.camera());
    planning::IdPlan ids(scene);
    const auto renderer = session.renderer().beside(settings.view.size_px, 1);
    renderer->load_models(ids.models());
    const planning::PlannedFrame frame =
        planner.plan({session.camera(), session.states(), session.triangle_target()});
    scene::Picture picture;
    renderer->draw(ids.of(frame.plan));
    renderer->finish_and_read(picture);
    return picture;
}

} // namespace

PixelCheck check_pixels(Session& session) {
    settings::RunSettings alone = session.settings();
    alone.view.inset.reset();
    const auto [painted, by_depth] = compared_settings(alone);
    settings::RunSettings large = by_depth;
    large.view.size_px *= LargeReference::scale;
    const scene::Picture picture = number_picture(session, painted);
    const IdDifference difference = difference_of(picture, number_picture(session, by_depth));
    PixelCheck check{.pixels = difference.pixels, .differing = difference.differing};
    if (!difference.apart.empty()) {
        check.wrong = wrong_among(
            difference.apart, picture, number_picture(session, large), LargeReference::scale);
    }
    return check;
}

} // namespace octant::ui::flight
