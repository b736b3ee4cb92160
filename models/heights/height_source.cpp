#include "models/heights/height_source.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/height_raster.h"
#include "models/heights/plain_pgm.h"
#include "models/heights/raster_file.h"
#include "models/heights/resampler.h"
#include "models/heights/source_grid.h"
#include "models/heights/target_lattice.h"
#include "sim/base/error.h"

#include <algorithm>
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

    void open(const ImportOptions& options);
    void take_picture(int columns, int rows, double spacing);
    void find_place();
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
    const Reference globe = globe_system();
    const Transformation to_globe = between(lattice.frame.get(), globe.get());
    const auto middle =
        to_globe ? moved(to_globe, {system->centre_x, system->centre_y}) : std::nullopt;
    if (middle && std::abs(middle->y) <= 90.0) {
        place = GeoPlace{middle->y, middle->x};
    }
}

HeightSource::HeightSource(std::vector<path> files, const ImportOptions& options)
    : content_(std::make_unique<Content>()) {
    assert(!files.empty());
    content_->files = std::move(files);
    content_->open(options);
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
    const std::string first = content_->files.front().filename().string();
    const std::size_t more = content_->files.size() - 1;
    return more == 0 ? first : fmt::format("{} and {} more", first, more);
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

void HeightSource::read(int first_row, std::span<float> heights_m) {
    if (content_->whole) {
        const std::size_t first =
            static_cast<std::size_t>(first_row) * static_cast<std::size_t>(columns());
        std::copy_n(
            content_->whole->heights_m.begin() + static_cast<std::ptrdiff_t>(first),
            heights_m.size(),
            heights_m.begin());
        return;
    }
    if (content_->resampler) {
        content_->resampler->read(first_row, heights_m, *content_->gdal);
        return;
    }
    const int count = static_cast<int>(heights_m.size() / static_cast<std::size_t>(columns()));
    content_->grids.front().read({0, columns(), first_row, count}, heights_m, *content_->gdal);
}

void HeightSource::read(int first_row, std::span<std::int16_t> heights_m) {
    assert(whole_metres());
    const int count = static_cast<int>(heights_m.size() / static_cast<std::size_t>(columns()));
    content_->grids.front().read({0, columns(), first_row, count}, heights_m, *content_->gdal);
}

} // namespace octant::models::heights
