#include "ui/id_comparison.h"

#include "ui/session.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace octant::ui {

namespace {

namespace gl = visuals::gl;
namespace scene = visuals::scene;

std::uint32_t id_at(const gl::Picture& picture, int x, int y) {
    std::uint32_t id = 0;
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
        static_cast<std::size_t>(x);
    std::memcpy(&id, picture.rgba.data() + 4 * pixel, sizeof id);
    return id;
}

bool occurs_around(const gl::Picture& reference, int x, int y, std::uint32_t id) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, reference.height - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, reference.width - 1); ++u) {
            if (id_at(reference, u, v) == id) {
                return true;
            }
        }
    }
    return false;
}

} // namespace

IdDifference difference_of(const gl::Picture& picture, const gl::Picture& reference) {
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
            difference.wrong += occurs_around(reference, x, y, id) ? 0 : 1;
        }
    }
    return difference;
}

IdComparison compare_with_depth_buffer(
    const scene::Settings& settings,
    int every,
    const std::function<void(int compared, int frames)>& seen) {
    scene::Settings painted = settings;
    painted.shadows = false;
    painted.samples = 1;
    scene::Settings tested = painted;
    tested.hidden_surface = scene::HiddenSurface::DepthBuffer;
    Session painter(painted, Shows::PolygonNumbers);
    Session reference(tested, Shows::PolygonNumbers);
    IdComparison sum;
    const int frames = (painter.frames() + every - 1) / every;
    for (int frame = 0; frame < painter.frames(); frame += every) {
        painter.make_current();
        const report::FrameRecord record = painter.draw(frame);
        reference.make_current();
        reference.draw(frame);
        const IdDifference difference = difference_of(painter.picture(), reference.picture());
        sum.difference.pixels += difference.pixels;
        sum.difference.differing += difference.differing;
        sum.difference.wrong += difference.wrong;
        sum.cuts += record.cuts;
        sum.unordered += record.unordered;
        sum.frames_with_cuts += record.cuts > 0 ? 1 : 0;
        if (difference.wrong > 0 && sum.first_wrong_frame < 0) {
            sum.first_wrong_frame = frame;
        }
        seen(++sum.frames, frames);
    }
    return sum;
}

} // namespace octant::ui
