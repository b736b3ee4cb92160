#include "models/heights/height_source.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/height_raster.h"
#include "models/heights/map_doubts.h"
#include "models/heights/plain_pgm.h"
#include "models/heights/raster_file.h"
#include "models/heights/resampler.h"
#include "models/heights/source_grid.h"
#include "models/heights/target_lattice.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

/// A plain PGM's heights in metres; adds a note of voids that it does not declare.
HeightGrid
plain_heights(const path& file, const ImportOptions& options, std::vector<MapNote>& notes) {
    HeightGrid grid = read_plain_pgm(
        file, [&file](int columns, int rows) { check_import_size(file, columns, rows); });
    const double unit_m = options.height_scale.value_or(1.0);
    VoidSurvey survey(lowest_import_m, highest_import_m, 65536.0);
    for (const float height : grid.heights_m) {
        survey.add(static_cast<double>(height), static_cast<double>(height) * unit_m);
    }
    UndeclaredVoids voids = survey.result();
    if (options.void_value) {
        voids = {};
        voids.values.push_back(*options.void_value);
    }
    for (float& height : grid.heights_m) {
        const double raw = static_cast<double>(height);
        if (voids.has(raw)) {
            height = std::numeric_limits<float>::quiet_NaN();
        } else {
            check_height(file, raw * unit_m, raw, false);
            height = static_cast<float>(raw * unit_m);
        }
    }
    if (!voids.note.empty()) {
        notes.push_back({fmt::format("{}: {}", file.filename().string(), voids.note)});
    }
    return grid;
}

std::vector<SourceGrid>
open_grids(const std::vector<path>& files, const ImportOptions& options, GdalSession& gdal) {
    std::vector<SourceGrid> grids;
    for (const path& file : files) {
        SourcePiece piece{file, open_height_raster(file, options, gdal)};
        if (files.size() > 1 && !piece.raster.map) {
            error_in(file, "expected a file that knows its place, beside others, got a picture");
        }
        const bool taken =
            std::ranges::any_of(grids, [&piece](SourceGrid& grid) { return grid.take(piece); });
        if (!taken) {
            grids.emplace_back(std::move(piece));
        }
    }
    return grids;
}

} // namespace

struct HeightSource::Content {
    std::vector<path> files;
    std::unique_ptr<GdalSession> gdal;
    std::vector<SourceGrid> grids;
    std::optional<HeightGrid> whole; ///< a plain PGM
    std::vector<MapNote> whole_notes;
    TargetLattice lattice;
    std::optional<Resampler> resampler; ///< where heights are not the files' own
    double spacing_m = 0.0;
    std::optional<GeoPlace> place;
    std::optional<MapSystem> system;
    std::optional<SpikeFinder> spikes;

    void open(const ImportOptions& options);
    void take_picture(int columns, int rows, double spacing);
    void find_place();
    void read(int first_row, std::span<float> heights_m);
    std::string name() const;

    glm::dvec2 metres_of(const glm::dvec2& column_row) const;
    std::string words_of(const glm::dvec2& at_m) const;
    double own_height_m(const Spike& spike) const;
    void add_spikes(std::vector<MapNote>& notes) const;
    void add_seams(std::vector<MapNote>& notes) const;
};

void HeightSource::Content::open(const ImportOptions& options) {
    for (const path& file : files) {
        check_local_file(file);
        if (!is_plain_pgm(file)) {
            continue;
        }
        if (files.size() > 1) {
            error_in(file, "expected a file that knows its place, beside others, got a picture");
        }
        whole = plain_heights(file, options, whole_notes);
        take_picture(whole->columns, whole->rows, options.spacing_m);
        return;
    }
    gdal = std::make_unique<GdalSession>();
    grids = open_grids(files, options, *gdal);
    if (!grids.front().map()) {
        take_picture(grids.front().columns(), grids.front().rows(), options.spacing_m);
        return;
    }
    lattice = lattice_for(files.front(), grids);
    spacing_m = lattice.step * lattice.unit_m;
    if (!lattice.is_source) {
        resampler.emplace(grids, lattice);
    }
    find_place();
    gdal->forget(); // a system without a place on the earth is no fault
}

/// A ground without a place.
void HeightSource::Content::take_picture(int columns, int rows, double spacing) {
    const auto fits = [](int n) { return n >= 2 && n <= largest_samples; };
    if (!fits(columns) || !fits(rows)) {
        error_in(
            files.front(),
            fmt::format(
                "expected 2 x 2 to {0} x {0} samples, got {1} x {2}",
                static_cast<int>(largest_samples),
                columns,
                rows));
    }
    lattice.columns = columns;
    lattice.rows = rows;
    lattice.is_source = true;
    lattice.cell_m = {spacing, spacing};
    spacing_m = spacing;
}

void HeightSource::Content::find_place() {
    if (!lattice.frame) {
        return;
    }
    system = lattice.system();
    const Reference globe = globe_system(ellipsoid_of(system->wkt));
    const Transformation to_globe = between(lattice.frame.get(), globe.get());
    const auto middle =
        to_globe ? moved(to_globe, {system->centre_x, system->centre_y}) : std::nullopt;
    if (middle && std::abs(middle->y) <= 90.0) {
        place = GeoPlace{middle->y, middle->x, ellipsoid_of(system->wkt)};
    }
}

std::string HeightSource::Content::name() const {
    const std::string first = files.front().filename().string();
    const std::size_t more = files.size() - 1;
    return more == 0 ? first : fmt::format("{} and {} more", first, more);
}

/// East and north of the centre.
glm::dvec2 HeightSource::Content::metres_of(const glm::dvec2& column_row) const {
    return (column_row - 0.5 * glm::dvec2(lattice.columns - 1, lattice.rows - 1)) * spacing_m;
}

/// A place for people: by latitude and longitude where they are known.
std::string HeightSource::Content::words_of(const glm::dvec2& at_m) const {
    std::string geo;
    if (place) {
        const Reference globe = globe_system(place->ellipsoid);
        const glm::dvec2 centre(system->centre_x, system->centre_y);
        const auto there =
            moved(between(lattice.frame.get(), globe.get()), centre + at_m / lattice.unit_m);
        geo = there ? fmt::format("{:.5f}, {:.5f}, ", there->y, there->x) : "";
    }
    return fmt::format("{}{:.0f} m east and {:.0f} m north of the middle", geo, at_m.x, at_m.y);
}

/// The height that the file itself has at a spike or right beside it.
double HeightSource::Content::own_height_m(const Spike& spike) const {
    float own_m = spike.height_m;
    glm::dvec2 at = glm::dvec2(lattice.west, lattice.south) +
                    glm::dvec2(spike.column, spike.row) * lattice.step;
    for (const SourceGrid& grid : grids) {
        glm::dvec2 there = at;
        grid.grid_from_frame({&there.x, 1}, {&there.y, 1});
        const int column = static_cast<int>(std::lround(there.x)) - 1;
        const int row = static_cast<int>(std::lround(there.y)) - 1;
        std::array<float, 9> near_m = {};
        grid.read({column, 3, row, 3}, near_m, *gdal);
        for (const float height_m : near_m) {
            const bool is_beyond = spike.above_m > 0.0F ? height_m > own_m : height_m < own_m;
            own_m = is_beyond ? height_m : own_m;
        }
    }
    return own_m;
}

void HeightSource::Content::add_spikes(std::vector<MapNote>& notes) const {
    constexpr std::size_t max_told = 3;
    std::vector<Spike> found = spikes ? spikes->found() : std::vector<Spike>();
    std::ranges::stable_sort(found, [](const Spike& a, const Spike& b) {
        return std::abs(a.above_m) > std::abs(b.above_m);
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Spike& spike = found[i];
        const glm::dvec2 at_m = metres_of({spike.column, spike.row});
        if (i >= max_told) {
            notes.back().places_m.push_back(at_m);
            continue;
        }
        const double own_m = lattice.is_source ? spike.height_m : own_height_m(spike);
        notes.push_back(
            {fmt::format(
                 "{}: a height of {:.6g} m stands alone, {:.0f} m {} all around it, at {}: --void "
                 "{:.9g} leaves it out",
                 name(),
                 own_m,
                 std::abs(spike.above_m),
                 spike.above_m > 0.0F ? "above" : "below",
                 words_of(at_m),
                 own_m),
             {at_m}});
    }
    if (found.size() > max_told) {
        notes.back().text = fmt::format(
            "{}; {} more heights stand alone",
            notes.back().text,
            spikes->count() - static_cast<std::int64_t>(max_told));
    }
}

void HeightSource::Content::add_seams(std::vector<MapNote>& notes) const {
    const double cell_m = std::min(lattice.cell_m.x, lattice.cell_m.y);
    for (const SeamStep& seam : steps_at_seams(grids, cell_m, *gdal)) {
        MapNote note;
        for (glm::dvec2 at : seam.column_row) {
            seam.grid->frame_from_grid({&at.x, 1}, {&at.y, 1});
            note.places_m.push_back(
                metres_of((at - glm::dvec2(lattice.west, lattice.south)) / lattice.step));
        }
        note.text = fmt::format(
            "{} and {}: heights step by {:.1f} m where the files meet, {:.1f} m more than the "
            "slope on "
            "both sides, about {}: --terrain with one of them alone has no step",
            seam.a->file.filename().string(),
            seam.b->file.filename().string(),
            std::abs(seam.rise_m),
            std::abs(seam.step_m),
            words_of(note.places_m[note.places_m.size() / 2]));
        notes.push_back(std::move(note));
    }
}

HeightSource::HeightSource(std::vector<path> files, const ImportOptions& options)
    : content_(std::make_unique<Content>()) {
    assert(!files.empty());
    content_->files = std::move(files);
    content_->open(options);
    content_->spikes.emplace(columns(), rows(), spacing_m());
}

HeightSource::~HeightSource() = default;

int HeightSource::columns() const {
    return content_->lattice.columns;
}

int HeightSource::rows() const {
    return content_->lattice.rows;
}

double HeightSource::spacing_m() const {
    return content_->spacing_m;
}

std::optional<GeoPlace> HeightSource::place() const {
    return content_->place;
}

std::optional<MapSystem> HeightSource::system() const {
    return content_->system;
}

std::string HeightSource::name() const {
    return content_->name();
}

std::string HeightSource::system_name() const {
    const SystemHandle own = content_->grids.empty() ? nullptr : content_->grids.front().system();
    const char* const name = own == nullptr ? nullptr : OSRGetName(own);
    return name == nullptr ? "" : printable(name);
}

glm::dvec2 HeightSource::cell_m() const {
    return content_->lattice.cell_m;
}

std::vector<MapNote> HeightSource::notes() const {
    std::vector<MapNote> notes = content_->whole_notes;
    for (const SourceGrid& grid : content_->grids) {
        for (const SourcePiece& piece : grid.pieces()) {
            const std::vector<MapNote> own = notes_of(piece.file, piece.raster);
            notes.insert(notes.end(), own.begin(), own.end());
        }
    }
    if (content_->gdal) {
        for (const std::string& warning : content_->gdal->warnings()) {
            notes.push_back({fmt::format("{}: GDAL warns: {}", name(), warning)});
        }
    }
    content_->add_spikes(notes);
    if (content_->gdal) { // a plain PGM has none
        content_->add_seams(notes);
        content_->gdal->forget();
    }
    return notes;
}

std::int64_t HeightSource::count_voids() const {
    std::int64_t voids = 0;
    if (content_->whole) {
        return std::ranges::count_if(
            content_->whole->heights_m, [](float height_m) { return std::isnan(height_m); });
    }
    std::vector<float> row;
    for (const SourceGrid& grid : content_->grids) {
        for (const SourcePiece& piece : grid.pieces()) {
            row.resize(static_cast<std::size_t>(piece.raster.columns));
            for (int y = 0; y < piece.raster.rows; ++y) {
                read_heights(
                    piece.file,
                    piece.raster,
                    {0, piece.raster.columns, y, 1},
                    row,
                    *content_->gdal);
                voids +=
                    std::ranges::count_if(row, [](float height_m) { return std::isnan(height_m); });
            }
        }
    }
    return voids;
}

bool HeightSource::whole_metres() const {
    return has_own_samples() && !content_->whole && content_->grids.front().whole_metres();
}

bool HeightSource::has_own_samples() const {
    return content_->lattice.is_source;
}

std::optional<double> HeightSource::height_at(double x_m, double y_m) const {
    assert(!content_->grids.empty() && content_->grids.front().map());
    return source_height_m(content_->grids, content_->lattice, x_m, y_m, *content_->gdal);
}

std::optional<Deviation> HeightSource::deviation_of(const GroundAt& ground) const {
    if (content_->grids.empty() || !content_->grids.front().map()) {
        return std::nullopt;
    }
    return deviation_from_source(content_->grids, content_->lattice, ground, *content_->gdal);
}

void HeightSource::Content::read(int first_row, std::span<float> heights_m) {
    const auto width = static_cast<std::size_t>(lattice.columns);
    if (whole) {
        const std::size_t first = static_cast<std::size_t>(first_row) * width;
        std::copy_n(
            whole->heights_m.begin() + static_cast<std::ptrdiff_t>(first),
            heights_m.size(),
            heights_m.begin());
    } else if (resampler) {
        resampler->read(first_row, heights_m, *gdal);
    } else {
        const int count = static_cast<int>(heights_m.size() / width);
        grids.front().read({0, lattice.columns, first_row, count}, heights_m, *gdal);
    }
}

void HeightSource::read(int first_row, std::span<float> heights_m) {
    content_->read(first_row, heights_m);
    content_->spikes->take(first_row, heights_m);
}

void HeightSource::read(int first_row, std::span<std::int16_t> heights_m) {
    assert(whole_metres());
    const auto width = static_cast<std::size_t>(columns());
    const int count = static_cast<int>(heights_m.size() / width);
    content_->grids.front().read({0, columns(), first_row, count}, heights_m, *content_->gdal);
    std::vector<float> row(width);
    for (int i = 0; i < count; ++i) {
        const auto metres = heights_m.subspan(static_cast<std::size_t>(i) * width, width);
        std::ranges::transform(metres, row.begin(), [](std::int16_t height_m) {
            return height_m == void_metres ? std::numeric_limits<float>::quiet_NaN()
                                           : static_cast<float>(height_m);
        });
        content_->spikes->take(first_row + i, row);
    }
}

} // namespace octant::models::heights
