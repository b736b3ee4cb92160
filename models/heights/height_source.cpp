#include "models/heights/height_source.h"

#include "models/heights/gdal_functions.h"
#include "models/heights/gdal_session.h"
#include "models/heights/height_field.h"
#include "models/heights/height_raster.h"
#include "models/heights/height_voids.h"
#include "models/heights/local_frame.h"
#include "models/heights/map_defects.h"
#include "models/heights/map_inputs.h"
#include "models/heights/map_resampling.h"
#include "sim/base/error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::heights {

namespace {

using std::filesystem::path;

HeightField field_from(const std::vector<path>& files, const ImportOptions& options) {
    HeightSource source(files, options);
    check_size(files.front(), source.columns(), source.rows(), max_import_samples);
    HeightGrid grid;
    grid.columns = source.columns();
    grid.rows = source.rows();
    grid.heights_m.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
    source.read(0, grid.heights_m);
    const long voids = fill_voids(grid);
    if (static_cast<std::size_t>(voids) == grid.heights_m.size()) {
        throw_error_in(files.front(), "expected at least one height, got only samples without data");
    }
    HeightField field(grid.columns, grid.rows, source.spacing_m(), std::move(grid.heights_m));
    field.name = source.name();
    field.place = source.place();
    field.system = source.system();
    field.filled_voids = voids;
    field.notes = source.notes();
    return field;
}

} // namespace

HeightField read_height_field(const path& file, const ImportOptions& options) {
    return read_height_field(std::vector<path>{file}, options);
}

HeightField read_height_field(const std::vector<path>& files, const ImportOptions& options) {
    assert(options.spacing_m > 0.0 && std::isfinite(options.spacing_m));
    assert(!options.height_scale || *options.height_scale > 0.0);
    try {
        return field_from(files, options);
    } catch (const std::bad_alloc&) {
        throw_error_in(files.front(), "expected a height field that fits in memory, got a larger one");
    }
}

void check_coordinate_system(const ImportOptions& options) {
    if (options.system && *options.system != local_metres_name) {
        const GdalSession gdal;
        coordinate_system_from_name(*options.system);
    }
}

namespace {

using std::filesystem::path;

constexpr int block_edge = 256;
/// Source coordinates are interpolated linearly between positions this many samples apart. At 100 m spacing the error
/// is 0.05 m, far below a sample.
constexpr int place_step = 16;
/// How far outside a grid's border a position may be because of rounding, in cells.
constexpr double rim = 0.02;
constexpr float no_height = std::numeric_limits<float>::quiet_NaN();

} // namespace

/// Resamples source grids to a target grid: bilinear, from the first source grid that has data at a position. A source
/// sample that is higher than its eight neighbours keeps its height at the nearest target sample, which preserves
/// summits.
class Resampler {
public:
    /// The source grids must be in the target grid's frame. Both must outlive the resampler.
    Resampler(const std::vector<SourceGrid>& grids, const TargetGrid& target) : grids_(grids), target_(target) {}

    /// Rows from `first_row` on, as many as fill the span; NaN without data. Throws Error.
    void read(int first_row, std::span<float> heights_m, const GdalSession& gdal) {
        const auto width = static_cast<std::size_t>(target_.columns);
        const int count = static_cast<int>(heights_m.size() / width);
        std::fill(heights_m.begin(), heights_m.end(), no_height);
        for (int row = 0; row < count; row += block_edge) {
            for (int column = 0; column < target_.columns; column += block_edge) {
                const Block block{column, std::min(block_edge, target_.columns - column), first_row + row,
                    std::min(block_edge, count - row)};
                block_m_.assign(
                    static_cast<std::size_t>(block.columns) * static_cast<std::size_t>(block.rows), no_height);
                for (const SourceGrid& grid : grids_) {
                    locate_samples(grid, block);
                    const GridWindow window = window_of(grid);
                    if (window.columns > 0 && window.rows > 0) {
                        source_m_.resize(
                            static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.rows));
                        grid.read(window, source_m_, gdal);
                        sample(block, window);
                    }
                }
                for (int r = 0; r < block.rows; ++r) {
                    std::copy_n(block_m_.begin() + std::ptrdiff_t{r} * block.columns, block.columns,
                        heights_m.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row + r) * width +
                                                                        static_cast<std::size_t>(column)));
                }
            }
        }
    }

private:
    /// Columns and rows of the target grid that are read at a time.
    struct Block {
        int first_column = 0;
        int columns = 0;
        int first_row = 0;
        int rows = 0;
    };

    /// The positions of a block's samples in a grid: exact every place_step samples, linear between.
    void locate_samples(const SourceGrid& grid, const Block& block) {
        const int across = (block.columns - 1) / place_step + 2;
        const int up = (block.rows - 1) / place_step + 2;
        std::vector<double> x;
        std::vector<double> y;
        for (int j = 0; j < up; ++j) {
            for (int i = 0; i < across; ++i) {
                x.push_back(target_.west + (block.first_column + i * place_step) * target_.step);
                y.push_back(target_.south + (block.first_row + j * place_step) * target_.step);
            }
        }
        grid.grid_from_frame(x, y);
        half_step_ =
            0.5 *
            glm::dvec2(std::hypot(x[1] - x[0], y[1] - y[0]),
                std::hypot(x[static_cast<std::size_t>(across)] - x[0], y[static_cast<std::size_t>(across)] - y[0])) /
            static_cast<double>(place_step);
        x_.clear();
        y_.clear();
        const double last_column = grid.columns() - 1.0;
        const double last_row = grid.rows() - 1.0;
        for (int r = 0; r < block.rows; ++r) {
            const double v = static_cast<double>(r % place_step) / place_step;
            for (int c = 0; c < block.columns; ++c) {
                const auto low = static_cast<std::size_t>(r / place_step * across + c / place_step);
                const std::size_t high = low + static_cast<std::size_t>(across);
                const glm::dvec2 share(static_cast<double>(c % place_step) / place_step, v);
                const double column = bilinear(x[low], x[low + 1], x[high], x[high + 1], share);
                const double row = bilinear(y[low], y[low + 1], y[high], y[high + 1], share);
                const bool inside =
                    column >= -rim && column <= last_column + rim && row >= -rim && row <= last_row + rim;
                x_.push_back(inside ? std::clamp(column, 0.0, last_column) : std::nan(""));
                y_.push_back(inside ? std::clamp(row, 0.0, last_row) : std::nan(""));
            }
        }
    }

    /// The part of a grid that a block's positions need; empty if all are outside.
    GridWindow window_of(const SourceGrid& grid) const {
        double west = std::numeric_limits<double>::infinity();
        double east = -west;
        double south = west;
        double north = -west;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            if (!std::isnan(x_[i])) {
                west = std::min(west, x_[i]);
                east = std::max(east, x_[i]);
                south = std::min(south, y_[i]);
                north = std::max(north, y_[i]);
            }
        }
        if (west > east) { return {}; }
        constexpr int beside = 2; // for the neighbours of summits
        const int first_column = std::max(0, static_cast<int>(west) - beside);
        const int first_row = std::max(0, static_cast<int>(south) - beside);
        return {first_column, std::min(grid.columns(), static_cast<int>(east) + beside + 2) - first_column, first_row,
            std::min(grid.rows(), static_cast<int>(north) + beside + 2) - first_row};
    }

    void sample(const Block& block, const GridWindow& window) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(block.columns) * static_cast<std::size_t>(block.rows);
             ++i) {
            if (std::isnan(block_m_[i]) && !std::isnan(x_[i])) {
                const double column = x_[i] - window.first_column;
                const double row = y_[i] - window.first_row;
                const float surface = surface_m(window, column, row);
                const float summit = summit_m(window, column, row);
                block_m_[i] = summit > surface ? summit : surface;
            }
        }
    }

    float source_at(const GridWindow& window, int column, int row) const {
        return source_m_[static_cast<std::size_t>(row) * static_cast<std::size_t>(window.columns) +
                         static_cast<std::size_t>(column)];
    }

    /// The bilinear height of the known samples if they have at least half of the weight, else NaN.
    float surface_m(const GridWindow& window, double column, double row) const {
        const CellPosition cell = cell_at({column, row}, window.columns, window.rows);
        const int east = std::min(cell.column + 1, window.columns - 1);
        const int north = std::min(cell.row + 1, window.rows - 1);
        const std::array corners_m{source_at(window, cell.column, cell.row), source_at(window, east, cell.row),
            source_at(window, cell.column, north), source_at(window, east, north)};
        const auto height_m = bilinear_of_known(corners_m, cell.share, 0.5);
        return height_m ? static_cast<float>(*height_m) : no_height;
    }

    /// The height of the source sample to which this place is the nearest of the target, if that one is higher than
    /// all around it; else the lowest number.
    float summit_m(const GridWindow& window, double column, double row) const {
        constexpr float none = std::numeric_limits<float>::lowest();
        const int c = static_cast<int>(std::lround(column));
        const int r = static_cast<int>(std::lround(row));
        if (c < 1 || r < 1 || c + 1 >= window.columns || r + 1 >= window.rows || std::abs(column - c) > half_step_.x ||
            std::abs(row - r) > half_step_.y) {
            return none;
        }
        const float own = source_at(window, c, r);
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                if ((i != 0 || j != 0) && !(source_at(window, c + i, r + j) < own)) { return none; }
            }
        }
        return own;
    }

    const std::vector<SourceGrid>& grids_;
    const TargetGrid& target_;
    std::vector<double> x_; ///< for each sample of a block its column in the grid; NaN outside
    std::vector<double> y_;
    std::vector<float> source_m_;
    std::vector<float> block_m_;
    glm::dvec2 half_step_{0.0}; ///< of the target, in cells of the grid
};

namespace {

std::vector<SourceGrid> open_grids(const std::vector<path>& files, const ImportOptions& options, GdalSession& gdal) {
    std::vector<SourceGrid> grids;
    for (const path& file : files) {
        check_local_file(file);
        SourcePiece piece{file, open_height_raster(file, options, gdal)};
        if (files.size() > 1 && !piece.raster.map) {
            throw_error_in(file, "expected a file that knows its place, beside others, got a picture");
        }
        const bool taken = std::ranges::any_of(grids, [&piece](SourceGrid& grid) { return grid.take(piece); });
        if (!taken) { grids.emplace_back(std::move(piece)); }
    }
    return grids;
}

/// A sample of a file: its stored number and its height.
struct StoredSample {
    double raw = 0.0;
    float height_m = 0.0F;
};

} // namespace

struct HeightSource::Content {
    std::vector<path> files;
    GdalSession gdal;
    std::vector<SourceGrid> grids;
    TargetGrid target;
    std::optional<Resampler> resampler; ///< where heights are not the files' own
    double spacing_m = 0.0;
    std::optional<GeoPosition> place;
    std::optional<CoordinateSystem> system;
    std::optional<SpikeFinder> spikes;

    void open(const ImportOptions& options) {
        grids = open_grids(files, options, gdal);
        if (!grids.front().map()) {
            take_picture(grids.front().columns(), grids.front().rows(), options.spacing_m);
            return;
        }
        target = target_grid_for(files.front(), grids);
        spacing_m = target.step * target.unit_m;
        if (!target.is_source) { resampler.emplace(grids, target); }
        find_place();
        gdal.forget(); // a system without a place on the earth is no fault
    }

    /// A ground without georeference.
    void take_picture(int columns, int rows, double spacing) {
        check_size(files.front(), columns, rows, SourceGrid::largest_samples);
        target.columns = columns;
        target.rows = rows;
        target.is_source = true;
        target.cell_m = {spacing, spacing};
        spacing_m = spacing;
    }

    void find_place() {
        if (!target.frame) { return; }
        system = target.system();
        const SpatialReference globe = geographic_coordinate_system(ellipsoid_of(system->wkt));
        const Transformation to_globe = between(target.frame.get(), globe.get());
        const auto middle = to_globe ? moved(to_globe, {system->centre_x, system->centre_y}) : std::nullopt;
        if (middle && std::abs(middle->y) <= 90.0) {
            place = GeoPosition{middle->y, middle->x, ellipsoid_of(system->wkt)};
        }
    }

    void read(int first_row, std::span<float> heights_m) {
        const auto width = static_cast<std::size_t>(target.columns);
        if (resampler) {
            resampler->read(first_row, heights_m, gdal);
        } else {
            const int count = static_cast<int>(heights_m.size() / width);
            grids.front().read({0, target.columns, first_row, count}, heights_m, gdal);
        }
    }

    std::string name() const {
        const std::string first = files.front().filename().string();
        const std::size_t more = files.size() - 1;
        return more == 0 ? first : fmt::format("{} and {} more", first, more);
    }

    bool has_map() const { return grids.front().map().has_value(); }

    /// East and north of the centre.
    glm::dvec2 metres_of(const glm::dvec2& column_row) const {
        return (column_row - 0.5 * glm::dvec2(target.columns - 1, target.rows - 1)) * spacing_m;
    }

    /// A position as text for messages: latitude and longitude if they are known.
    std::string words_of(const glm::dvec2& at_m) const {
        std::string geo;
        if (place) {
            const SpatialReference globe = geographic_coordinate_system(place->ellipsoid);
            const glm::dvec2 centre(system->centre_x, system->centre_y);
            const auto there = moved(between(target.frame.get(), globe.get()), centre + at_m / target.unit_m);
            geo = there ? fmt::format("{:.5f}, {:.5f}, ", there->y, there->x) : "";
        }
        return fmt::format("{}{:.0f} m east and {:.0f} m north of the middle", geo, at_m.x, at_m.y);
    }

    /// Samples of the files at most `radius` columns and rows away from a target sample.
    std::vector<StoredSample> samples_near(const glm::ivec2& column_row, int radius) const {
        std::vector<StoredSample> samples;
        for (const SourceGrid& grid : grids) {
            glm::dvec2 at(column_row);
            if (!target.is_source) {
                at = glm::dvec2(target.west, target.south) + at * target.step;
                grid.grid_from_frame({&at.x, 1}, {&at.y, 1});
            }
            const glm::ivec2 centre(glm::round(at));
            for (const SourcePiece& piece : grid.pieces()) {
                const glm::ivec2 corner(piece.column, piece.row);
                const glm::ivec2 size(piece.raster.columns, piece.raster.rows);
                const glm::ivec2 first = glm::max(centre - radius - corner, 0);
                const glm::ivec2 count = glm::min(centre + radius + 1 - corner, size) - first;
                if (count.x <= 0 || count.y <= 0) { continue; }
                const GridWindow window{first.x, count.x, first.y, count.y};
                const auto n = static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y);
                std::vector<double> raw(n);
                std::vector<float> heights_m(n);
                read_raw(piece.file, piece.raster, window, raw, gdal);
                read_heights(piece.file, piece.raster, window, heights_m, gdal);
                for (std::size_t i = 0; i < n; ++i) { samples.push_back({raw[i], heights_m[i]}); }
            }
        }
        std::erase_if(samples, [](const StoredSample& each) { return std::isnan(each.height_m); });
        return samples;
    }

    /// The samples of the files that form a spike, the one with the largest difference to its surroundings first.
    std::vector<StoredSample> samples_of(const Spike& spike) const {
        // A sample of the ground lies up to one sample of the file away from the file's own.
        const int radius = spike.radius + (target.is_source ? 0 : 1);
        std::vector<StoredSample> samples = samples_near({spike.column, spike.row}, radius);
        const bool is_pit = spike.above_m < 0.0F;
        std::ranges::stable_sort(samples, [is_pit](const StoredSample& a, const StoredSample& b) {
            return is_pit ? a.height_m < b.height_m : a.height_m > b.height_m;
        });
        // What lies around is all of above_m away from the first.
        const float limit_m = samples.empty() ? 0.0F : samples.front().height_m - 0.5F * spike.above_m;
        std::erase_if(samples, [is_pit, limit_m](const StoredSample& each) {
            return is_pit ? each.height_m > limit_m : each.height_m < limit_m;
        });
        return samples;
    }

    /// The number of samples of the files with one of these numbers. Reads all samples.
    std::int64_t count_of(std::span<const double> numbers) const {
        const auto is_one = [numbers](double raw) {
            return std::ranges::any_of(numbers, [raw](double number) { return is_same_raw(raw, number); });
        };
        std::int64_t samples = 0;
        for_each_row([&](const SourcePiece& piece, const GridWindow& row) {
            std::vector<double> raw(static_cast<std::size_t>(row.columns));
            read_raw(piece.file, piece.raster, row, raw, gdal);
            samples += std::ranges::count_if(raw, is_one);
        });
        return samples;
    }

    /// The option that declares the samples of a spike as missing, and the number of samples that it affects in all.
    std::string cure_of(std::span<const StoredSample> samples) const {
        constexpr std::size_t max_numbers = 16;
        std::vector<double> numbers;
        std::vector<std::string> texts;
        for (const StoredSample& sample : samples) {
            if (std::ranges::find(numbers, sample.raw) == numbers.end()) {
                numbers.push_back(sample.raw);
                texts.push_back(raw_text(sample.raw));
            }
        }
        if (numbers.size() > max_numbers) {
            return fmt::format("its {} different numbers are too many for --void", numbers.size());
        }
        const std::int64_t count = count_of(numbers);
        return fmt::format("--void {} treats every sample of {} as missing ({} in all)", fmt::join(texts, ","),
            numbers.size() == 1 ? "that value" : "these values", count);
    }

    /// Calls act(piece, window) for each row of each file.
    template <typename Do>
    void for_each_row(const Do& act) const {
        for (const SourceGrid& grid : grids) {
            for (const SourcePiece& piece : grid.pieces()) {
                for (int y = 0; y < piece.raster.rows; ++y) { act(piece, GridWindow{0, piece.raster.columns, y, 1}); }
            }
        }
    }

    void add_spikes(std::vector<MapNote>& notes) const {
        constexpr std::size_t max_told = 3;
        constexpr std::size_t min_steep = 30; // so many are rather a wrong width of cells
        std::vector<Spike> found = spikes ? spikes->found() : std::vector<Spike>();
        std::ranges::stable_sort(
            found, [](const Spike& a, const Spike& b) { return std::abs(a.above_m) > std::abs(b.above_m); });
        if (found.size() >= min_steep && !target.frame) {
            MapNote note{fmt::format("{}: {} places are steeper than any ground on earth if cells are {:g} m wide{}",
                name(), spikes->count(), spacing_m, has_map() ? "" : ": --terrain-spacing says how wide they are")};
            for (const Spike& spike : found) { note.places_m.push_back(metres_of({spike.column, spike.row})); }
            notes.push_back(std::move(note));
            return;
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
            const Spike& spike = found[i];
            const glm::dvec2 at_m = metres_of({spike.column, spike.row});
            if (i >= max_told) {
                notes.back().places_m.push_back(at_m);
                continue;
            }
            const std::vector<StoredSample> samples = samples_of(spike);
            notes.push_back(
                {fmt::format("{}: {} {:.6g} m, {:.0f} m {} all {} neighbours, at {}; {}", name(),
                     samples.size() == 1 ? "one sample is" : fmt::format("{} samples are up to", samples.size()),
                     samples.empty() ? spike.height_m : samples.front().height_m, std::abs(spike.above_m),
                     spike.above_m > 0.0F ? "above" : "below", samples.size() == 1 ? "its" : "their", words_of(at_m),
                     cure_of(samples)),
                    {at_m}});
        }
        if (found.size() > max_told) {
            notes.back().text = fmt::format("{}; {} more such places are marked in --picture", notes.back().text,
                spikes->count() - static_cast<std::int64_t>(max_told));
        }
    }

    void add_seams(std::vector<MapNote>& notes) const {
        const double cell_m = std::min(target.cell_m.x, target.cell_m.y);
        for (const SeamStep& seam : steps_at_seams(grids, cell_m, gdal)) {
            MapNote note;
            for (glm::dvec2 at : seam.column_row) {
                seam.grid->frame_from_grid({&at.x, 1}, {&at.y, 1});
                note.places_m.push_back(metres_of((at - glm::dvec2(target.west, target.south)) / target.step));
            }
            note.text = fmt::format("{} and {}: heights step by {:.1f} m where the files meet, {:.1f} m more than the "
                                    "slope "
                                    "on both sides, at {}. To avoid the step, load only one of the two files",
                seam.a->file.filename().string(), seam.b->file.filename().string(), std::abs(seam.rise_m),
                std::abs(seam.step_m), words_of(note.places_m[note.places_m.size() / 2]));
            notes.push_back(std::move(note));
        }
    }
};

HeightSource::HeightSource(std::vector<path> files, const ImportOptions& options)
    : content_(std::make_unique<Content>()) {
    assert(!files.empty());
    content_->files = std::move(files);
    content_->open(options);
    content_->spikes.emplace(columns(), rows(), spacing_m());
}

HeightSource::~HeightSource() = default;

int HeightSource::columns() const { return content_->target.columns; }

int HeightSource::rows() const { return content_->target.rows; }

double HeightSource::spacing_m() const { return content_->spacing_m; }

std::optional<GeoPosition> HeightSource::place() const { return content_->place; }

std::optional<CoordinateSystem> HeightSource::system() const { return content_->system; }

std::string HeightSource::name() const { return content_->name(); }

std::string HeightSource::system_name() const {
    const SpatialReferenceHandle own = content_->grids.front().system();
    const char* const name = own == nullptr ? nullptr : OSRGetName(own);
    return name == nullptr ? "" : printable(name);
}

glm::dvec2 HeightSource::cell_m() const { return content_->target.cell_m; }

std::vector<MapNote> HeightSource::notes() const {
    std::vector<MapNote> notes;
    for (const SourceGrid& grid : content_->grids) {
        for (const SourcePiece& piece : grid.pieces()) {
            const std::vector<MapNote> own = notes_of(piece.file, piece.raster);
            notes.insert(notes.end(), own.begin(), own.end());
        }
    }
    for (const std::string& warning : content_->gdal.warnings()) {
        notes.push_back({fmt::format("{}: GDAL warns: {}", name(), warning)});
    }
    content_->add_spikes(notes);
    content_->add_seams(notes);
    const auto names_width = [](const MapNote& note) {
        return note.text.find("--terrain-spacing") != std::string::npos;
    };
    if (!content_->has_map() && spacing_m() == ImportOptions().spacing_m && std::ranges::none_of(notes, names_width)) {
        notes.push_back({fmt::format("{}: the file does not say how wide its cells are: taken as {:g} m; "
                                     "--terrain-spacing says another width",
            name(), spacing_m())});
    }
    content_->gdal.forget();
    return notes;
}

std::int64_t HeightSource::count_voids() const {
    std::int64_t voids = 0;
    content_->for_each_row([&](const SourcePiece& piece, const GridWindow& row) {
        std::vector<float> heights_m(static_cast<std::size_t>(row.columns));
        read_heights(piece.file, piece.raster, row, heights_m, content_->gdal);
        voids += std::ranges::count_if(heights_m, [](float height_m) { return std::isnan(height_m); });
    });
    return voids;
}

bool HeightSource::has_integer_metres() const {
    return content_->target.is_source && content_->grids.front().has_integer_metres();
}

std::optional<double> HeightSource::height_at(double x_m, double y_m) const {
    assert(content_->grids.front().map());
    return source_height_m(content_->grids, content_->target, x_m, y_m, content_->gdal);
}

std::optional<HeightDeviation> HeightSource::deviation_of(const GroundAt& ground) const {
    if (!content_->grids.front().map()) { return std::nullopt; }
    return deviation_from_source(content_->grids, content_->target, ground, content_->gdal);
}

void HeightSource::read(int first_row, std::span<float> heights_m) {
    content_->read(first_row, heights_m);
    content_->spikes->take(first_row, heights_m);
}

} // namespace octant::models::heights
