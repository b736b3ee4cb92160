#pragma once

#include "sim/trajectory.h"
#include "visuals/landscape/ground.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::visuals::planning {

/// The path of an aircraft as it is drawn: points at equal intervals of time, and its legs. World axes.
struct DrawnPath {
    struct Point {
        glm::dvec3 position_m{0.0};
        /// A unit vector along the wings.
        glm::dvec3 right{1.0, 0.0, 0.0};
    };

    struct Leg {
        std::size_t first_point = 0;
        std::string name;
    };

    /// The time of the first point, and the time from one point to the next.
    double first_s = 0.0;
    double step_s = 0.1;
    std::vector<Point> points;
    /// By ascending first_point.
    std::vector<Leg> legs;

    double time_s(std::size_t point) const { return first_s + step_s * static_cast<double>(point); }
};

/// The first time of a leg, and its name.
struct NamedTime {
    double time_s = 0.0;
    std::string name;
};

/// The path of a trajectory. A long one gets fewer points a second.
DrawnPath drawn_path(const sim::Trajectory& trajectory, std::span<const NamedTime> legs);

/// A simpler model that replaces a model where the difference is too small to see. Both have painting orders.
struct FarModel {
    /// Index into Scene::models.
    std::uint32_t model = 0;
    /// Index into Scene::models, of one without levels of detail.
    std::uint32_t far_model = 0;
    /// The largest distance from a point of one model to the other.
    double error_m = 0.0;
};

/// Everything that is loaded once and read in every frame, by one view or several. Large members are shared and
/// immutable: a copy is cheap.
struct Scene {
    std::shared_ptr<const landscape::Ground> ground;
    /// Null = the ground shows its vertices' colours. Only a renderer needs the texels; they may be freed after it has
    /// loaded them.
    std::shared_ptr<const scene::GroundTexture> ground_texture;
    /// Each model once.
    std::vector<std::shared_ptr<const AircraftModel>> models;
    /// For each aircraft the index of its model.
    std::vector<std::uint32_t> aircraft;
    std::vector<FarModel> far_models;
    /// The index of the model of the cockpit around the first pilot's eye.
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
