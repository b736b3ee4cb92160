#pragma once

#include "models/heights/height_field.h"
#include "ui/report/png_file.h"
#include "visuals/terrain/ground_query.h"

#include <span>

namespace octant::ui::terrain {

/// A map from above, north up, about 900 pixels long: shaded relief lit from the north-west, in colours by height with
/// a legend in metres. The colours run over all heights but the lowest and the highest 0.5 %, so that single wrong ones
/// do not fade the rest. The places of each note are ringed in red and carry the number of the note, counted from 1.
/// Same ground, same bytes.
report::Picture map_picture(
    const visuals::terrain::GroundSamples& ground, std::span<const models::heights::MapNote> notes);

} // namespace octant::ui::terrain
