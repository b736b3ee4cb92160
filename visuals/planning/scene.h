#pragma once

#include "visuals/landscape/ground.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/planning/drawn_path.h"
#include "visuals/scene/ground_texture.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace octant::visuals::planning {

/// A simpler model that replaces a model far away, where nobody sees the difference. Both have painting orders.
struct FarModel {
    /// Index into Scene::models.
    std::uint32_t model = 0;
    /// Index into Scene::models, of one without levels of detail.
    std::uint32_t far_model = 0;
    /// No point of one model is farther than this from the other.
    double error_m = 0.0;
};

/// Everything that is loaded once and looked at in every frame, by one view or by several. What is large is shared and
/// never changes: a copy costs little.
struct Scene {
    std::shared_ptr<const landscape::Ground> ground;
    /// Null = the ground shows its vertices' colours. Plans need no texels: they may be gone once a renderer has them.
    std::shared_ptr<const scene::GroundTexture> ground_texture;
    /// Each once, however many aircraft fly it.
    std::vector<std::shared_ptr<const AircraftModel>> models;
    /// The model of each aircraft.
    std::vector<std::uint32_t> aircraft;
    /// What stands in for some of the models from afar.
    std::vector<FarModel> far_models;
    /// The model of what the first pilot sees around the eye.
    std::optional<std::uint32_t> cockpit;
    /// The working dials of that cockpit.
    overlay::InstrumentLayout dials;
    /// The first aircraft's path, where one is known.
    std::shared_ptr<const DrawnPath> path = nullptr;

    const AircraftModel& model_of(std::size_t number) const { return *models[aircraft[number]]; }

    /// Returns the model's index.
    std::uint32_t add_model(AircraftModel model) {
        models.push_back(std::make_shared<const AircraftModel>(std::move(model)));
        return static_cast<std::uint32_t>(models.size() - 1);
    }
};

} // namespace octant::visuals::planning
