#include "visuals/planning/frame_view.h"

namespace octant::visuals::planning {

FrameView frame_view(const scene::Camera& camera, const glm::ivec2& size_px, double earth_radius_m) {
    const double aspect = static_cast<double>(size_px.x) / size_px.y;
    return {
        camera, size_px, aspect, 1.0 / focal_px(camera, size_px.y), frustum_normals(camera, aspect), earth_radius_m};
}

bool in_view(const OrientedBox& box, const FrameView& view) {
    return scene::in_view(box.centre_m, radius_m(box), view.frustum);
}

} // namespace octant::visuals::planning
