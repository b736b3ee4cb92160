#pragma once

#include "models/heights/height_field.h"
#include "ui/report/png_file.h"
#include "visuals/terrain/ground_query.h"

#include <span>

namespace octant::ui::terrain {

/// A map from above, north up, about 900 pixels long: shaded relief lit from the north-west, in colours by height with
/// a legend in metres. The colour scale leaves out the lowest and the highest 0.5 % of the heights, because single
/// wrong heights would compress it. Red rings with the number of the note, from 1, mark the locations of each note. The
/// same ground gives the same bytes.
report::Picture map_picture(
    const visuals::terrain::GroundSamples& ground, std::span<const models::heights::MapNote> notes);

} // namespace octant::ui::terrain
