#include "tried_models.h"

#include "models/polygons/obj_reader.h"

#include <utility>

namespace octant::tests {

models::polygons::PolygonModel shipped(const std::string& name) {
    return models::polygons::read_obj(OCTANT_SOURCE_DIR "/models/" + name + ".obj");
}

visuals::draworder::OrderedModel by(visuals::draworder::OrderMethod method, models::polygons::PolygonModel model) {
    return visuals::draworder::ordered(std::move(model), {.method = method, .paper = {}});
}

visuals::orderfile::RaySampling all_eyes(int eyes) {
    return {.eyes = eyes, .rays_per_eye = 30, .min_distance_radii = 0.05};
}

} // namespace octant::tests
