#pragma once

#include "models/heights/height_field.h"
#include "models/heights/local_frame.h"
#include "sim/base/transverse_mercator.h"

#include <memory>
#include <optional>

namespace octant::models::heights {

/// How ground lies on the earth or another planet that is laid out along the axes of a coordinate system, by the system
/// itself. Far from the ground, or where the system ends, places are those of the TransverseMercator frame at the
/// ground's middle.
class MapFrame final : public EarthFrame {
public:
    /// `system` names a system that knows its place on the earth, `middle` is the ground's there.
    MapFrame(const CoordinateSystem& system, const GeoPosition& middle);

    GeoPosition origin() const override { return about_.origin(); }

    glm::dvec2 local_from_geo(const GeoPosition& place) const override;
    GeoPosition geo_from_local(const glm::dvec2& east_north_m) const override;

private:
    CoordinateSystem system_;
    TransverseMercator about_;
    Transformation from_globe_;
    Transformation to_globe_;
};

/// The frame of ground with a place on the earth, null for other ground: that of its system, where it has one, or the
/// TransverseMercator frame there.
std::shared_ptr<const EarthFrame> frame_of_ground(
    const std::optional<CoordinateSystem>& system, const std::optional<GeoPosition>& place);

} // namespace octant::models::heights
