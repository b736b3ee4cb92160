#include "ui/studies/flicker/shimmer_table.h"

#include "sim/base/parallel_for.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/flight/flight_cameras.h"
#include "ui/flight/session.h"
#include "ui/studies/flicker/shimmer.h"
#include "ui/terrain/loaded_ground.h"
#include "ui/world/terrain_file.h"
#include "visuals/terrain/ground_query.h"

#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::studies::flicker {

namespace scene = visuals::scene;
namespace terrain = visuals::terrain;

namespace {

struct RaySampler {
    int samples;
    bool geomorphs;
};

constexpr std::array samplings = {
    RaySampler{1, false}, RaySampler{1, true}, RaySampler{4, false}, RaySampler{4, true}};

/// Sums over pairs of frames.
struct Change {
    std::array<double, samplings.size()> sum{};
    std::size_t pairs = 0;
    std::size_t pixels = 0;
};

void add_change(report::HtmlTable& table, const std::string& path, const Change& change) {
    std::vector<std::string> row = {
        path, fmt::format("{}", change.pairs), fmt::format("{}", change.pixels)};
    for (const double sum : change.sum) {
        row.push_back(fmt::format("{:.3f}", sum / static_cast<double>(change.pairs)));
    }
    table.rows.push_back(row);
}

Change shimmer_along(
    const ShimmerOptions& options,
    const settings::RunSettings& flown,
    const ui::terrain::LoadedGround& ground) {
    const terrain::GroundSamples samples = ground.samples();
    const std::vector<flight::FlightCamera> cameras = flight::flight_cameras(flown);
    std::array<std::unique_ptr<flight::Session>, samplings.size()> sessions;
    for (std::size_t k = 0; k < samplings.size(); ++k) {
        settings::RunSettings settings = flown;
        settings.view.samples = samplings[k].samples;
        settings.ground.geomorphs = samplings[k].geomorphs;
        sessions[k] = std::make_unique<flight::Session>(settings);
    }
    const double radius_m = flown.ground.earth_curvature ? ground.mean_radius_m() : 0.0;
    base::Progress progress(flown.path.name, static_cast<int>(cameras.size()), options.quiet);
    Change change;
    const auto step = static_cast<std::size_t>(options.every);
    for (std::size_t frame = 0; frame + 1 < cameras.size(); frame += step) {
        const std::vector<ReprojectedPixel> matches =
            reprojected_pixels(samples, cameras[frame], cameras[frame + 1], flown.view.size_px, radius_m);
        for (std::size_t k = 0; k < samplings.size(); ++k) {
            flight::Session& session = *sessions[k];
            session.draw(static_cast<int>(frame));
            const visuals::scene::Picture earlier = session.picture();
            session.draw(static_cast<int>(frame) + 1);
            change.sum[k] += mean_change(earlier, session.picture(), matches);
        }
        ++change.pairs;
        change.pixels += matches.size();
        progress.show(static_cast<int>(frame));
    }
    return change;
}

} // namespace

report::HtmlTable shimmer_table(const ShimmerOptions& options) {
    const ui::terrain::LoadedGround ground = ui::terrain::load_ground(
        options.settings.path.terrain,
        world::import_options(options.settings.path),
        true); // popping said the notes
    report::HtmlTable table;
    table.title = "Shimmer: mean change of luminance (0 to 255) after the motion is taken out";
    table.header = {
        "path",
        "pairs of frames",
        "pixels",
        "1 sample, no geomorphs",
        "1 sample, geomorphs",
        "4 samples, no geomorphs",
        "4 samples, geomorphs"};
    std::vector<Change> changes(base::built_in_paths.size());
    ShimmerOptions of_path = options;
    of_path.quiet = options.quiet || options.jobs > 1; // progress of one at a time only
    parallel_for(changes.size(), options.jobs, [&](std::size_t i, std::size_t /*worker*/) {
        settings::RunSettings settings = options.settings;
        settings.path.name = std::string(base::built_in_paths[i]);
        settings.surface.shadows = false;
        settings.ground.mesh = scene::GroundMetric::ScreenError;
        changes[i] = shimmer_along(of_path, settings, ground);
    });
    Change all;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        add_change(table, std::string(base::built_in_paths[i]), changes[i]);
        for (std::size_t k = 0; k < samplings.size(); ++k) {
            all.sum[k] += changes[i].sum[k];
        }
        all.pairs += changes[i].pairs;
        all.pixels += changes[i].pixels;
    }
    add_change(table, "all", all);
    table.note = "Every fourth pixel, both ways, of the later frame that shows ground which the "
                 "earlier one shows: rays to the full-resolution ground; the earlier picture is "
                 "read between its pixels. Not near the aircraft; no shadows.";
    return table;
}

} // namespace octant::ui::studies::flicker
