#pragma once

#include "visuals/nature/daylight.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/scene.h"
#include "visuals/planning/sky.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <glm/vec3.hpp>

namespace octant::visuals::planning {

/// The light, the haze and the sky of one view.
class Atmosphere {
public:
    /// The scene and the settings must outlive it.
    Atmosphere(const Scene& scene, const scene::AirSettings& settings);

    /// Goes on under the sun of the settings, where that has become another one.
    void set_sun();

    const nature::Daylight& daylight() const { return daylight_; }

    /// The direction to the sun: a unit vector, world axes.
    const glm::dvec3& to_sun() const { return to_sun_; }

    /// Writes light, haze and sky of a frame into its plan; valid until the next frame.
    void write(const FrameView& view, scene::FramePlan& plan);

private:
    float visibility_m(double eye_height_m) const;

    const Scene& scene_;
    const scene::AirSettings& settings_;
    nature::Daylight daylight_;
    glm::dvec3 to_sun_;
    /// The haze at the ground's mean height.
    scene::Haze haze_;
    Sky sky_;
};

} // namespace octant::visuals::planning
