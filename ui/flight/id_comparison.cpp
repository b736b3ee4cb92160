#include "ui/flight/id_comparison.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <memory>
#include <utility>

namespace octant::ui::flight {

namespace {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

std::uint32_t id_at(const scene::Picture& picture, int x, int y) {
    std::uint32_t id = 0;
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
    std::memcpy(&id, picture.rgba.data() + 4 * pixel, sizeof id);
    return id;
}

/// Whether a number occurs in the picture within `reach` pixels of a place, in either direction.
bool occurs_in_neighbourhood(const scene::Picture& picture, const glm::ivec2& at, int reach, std::uint32_t id) {
    for (int v = std::max(at.y - reach, 0); v <= std::min(at.y + reach, picture.height - 1); ++v) {
        for (int u = std::max(at.x - reach, 0); u <= std::min(at.x + reach, picture.width - 1); ++u) {
            if (id_at(picture, u, v) == id) { return true; }
        }
    }
    return false;
}

/// Draws a frame by depth, three times as large, when it is asked for.
class EnlargedReference {
public:
    static constexpr int scale = 3; // odd: the middles of the pixels are middles here too

    EnlargedReference(const settings::RunSettings& settings, const world::World& world)
        : settings_(settings), world_(world) {
        settings_.view.size_px *= scale;
    }

    const scene::Picture& picture(int frame) {
        if (!session_) { session_ = std::make_unique<Session>(settings_, PictureContent::PolygonIds, nullptr, world_); }
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
            if (id == id_at(reference, x, y)) { continue; }
            ++difference.differing;
            if (!occurs_in_neighbourhood(reference, {x, y}, 1, id)) { difference.unmatched.emplace_back(x, y); }
        }
    }
    return difference;
}

long count_wrong_ids(std::span<const glm::ivec2> pixels, const scene::Picture& picture,
    const scene::Picture& large_reference, int scale) {
    return std::ranges::count_if(pixels, [&](const glm::ivec2& pixel) {
        const glm::ivec2 middle = pixel * scale + scale / 2;
        const int reach = scale + scale / 2;
        return !occurs_in_neighbourhood(large_reference, middle, reach, id_at(picture, pixel.x, pixel.y));
    });
}

ComparisonSettings comparison_settings(const settings::RunSettings& settings) {
    ComparisonSettings compared{settings, settings};
    for (settings::RunSettings* one : {&compared.painted, &compared.depth_buffered}) {
        one->surface.shadows = false;
        one->view.samples = 1;
    }
    settings::RunSettings& depth_buffered = compared.depth_buffered;
    depth_buffered.surface.hidden_surface = scene::HiddenSurface::DepthBuffer;
    // Transparent things have no object numbers and no depth: neither picture has them. Discs of rotors stay as set.
    if (settings.surface.effects == true) { depth_buffered.surface.effects.reset(); }
    depth_buffered.air.clouds = 0.0;
    depth_buffered.view.path_ribbon = false;
    return compared;
}

ComparisonWorlds load_comparison_worlds(const settings::RunSettings& settings) {
    const auto [painted, depth_buffered] = comparison_settings(settings);
    world::World world = world::load_world(painted);
    world::World other = world::load_world(depth_buffered, world::RenderDevice::Cpu, &world);
    return {std::move(world), std::move(other)};
}

IdComparison compare_with_depth_buffer(const settings::RunSettings& settings, const ComparisonWorlds& worlds, int every,
    const std::function<void(int compared, int frames)>& on_frame) {
    const auto [painted, depth_buffered] = comparison_settings(settings);
    Session painter(painted, PictureContent::PolygonIds, nullptr, worlds.painted);
    Session reference(depth_buffered, PictureContent::PolygonIds, nullptr, worlds.depth_buffered);
    EnlargedReference large(depth_buffered, worlds.depth_buffered);
    IdComparison sum;
    const int frames = (painter.frames() + every - 1) / every;
    for (int frame = 0; frame < painter.frames(); frame += every) {
        const report::FrameRecord record = painter.draw(frame);
        reference.draw(frame);
        const IdDifference difference = difference_of(painter.picture(), reference.picture());
        sum.pixels += difference.pixels;
        sum.differing += difference.differing;
        if (!difference.unmatched.empty()) {
            sum.unmatched += static_cast<long>(difference.unmatched.size());
            sum.wrong += count_wrong_ids(
                difference.unmatched, painter.picture(), large.picture(frame), EnlargedReference::scale);
        }
        sum.cuts += record.cuts;
        sum.unordered += record.unordered;
        sum.frames_with_cuts += record.cuts > 0 ? 1 : 0;
        on_frame(++sum.frames, frames);
    }
    return sum;
}

namespace {

scene::Picture draw_id_picture(Session& session, const settings::RunSettings& settings) {
    // Meshed by the session's settings, so that all pictures show the same triangles.
    const planning::Scene& scene = session.world().scene;
    planning::Planner planner(scene, settings,
        scene.ground->mesher(landscape::mesh_settings(session.settings(), scene.ground_texture != nullptr)));
    planning::IdPlan ids(scene);
    const auto renderer = session.renderer().sibling(settings.view.size_px, 1);
    renderer->load_models(ids.models());
    const planning::PlannedFrame frame = planner.plan({session.camera(), session.states(), session.triangle_target()});
    scene::Picture picture;
    renderer->draw(ids.of(frame.plan));
    renderer->finish_and_read(picture);
    return picture;
}

} // namespace

PixelCheck check_pixels(Session& session) {
    settings::RunSettings alone = session.settings();
    alone.view.inset.reset();
    const auto [painted, depth_buffered] = comparison_settings(alone);
    settings::RunSettings large = depth_buffered;
    large.view.size_px *= EnlargedReference::scale;
    const scene::Picture picture = draw_id_picture(session, painted);
    const IdDifference difference = difference_of(picture, draw_id_picture(session, depth_buffered));
    PixelCheck check{.pixels = difference.pixels, .differing = difference.differing};
    if (!difference.unmatched.empty()) {
        check.wrong =
            count_wrong_ids(difference.unmatched, picture, draw_id_picture(session, large), EnlargedReference::scale);
    }
    return check;
}

} // namespace octant::ui::flight
