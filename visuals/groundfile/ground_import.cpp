// Imports large height fields. The heights are first read into the end of the file that is being made, then the tiles
// are built in front of them, and at last the file is cut. The header tells how far this has come, so that an import
// which was stopped can go on.
#include "visuals/groundfile/ground_import.h"

#include "models/heights/height_raster.h"
#include "models/heights/height_source.h"
#include "models/heights/height_voids.h"
#include "models/heights/import_options.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/mapped_file.h"
#include "visuals/terrain/bisection_ground_builder.h"
#include "visuals/terrain/bisection_tiles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::visuals::groundfile {

namespace heights = models::heights;
using std::filesystem::path;

namespace {

using Stage = ImportProgress::Stage;

// Fills voids of fields that are too large to be smoothed in one piece: coarse first, then tile by tile with a margin.

/// The most samples that are filled in one piece.
constexpr std::size_t max_samples_at_once = std::size_t{1} << 22U;
constexpr int rectangle_edge = 1024;
constexpr int margin = 32; ///< Samples around a piece that take part in its smoothing.

/// Marks a sample without data while a ground is imported.
constexpr std::int16_t void_number = std::numeric_limits<std::int16_t>::min();

struct Field {
    std::span<std::int16_t> numbers;
    int columns;
    int rows;

    std::int16_t& at(int column, int row) const {
        return numbers[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column)];
    }
};

float height_of(std::int16_t number) {
    return number == void_number ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(number);
}

/// A rectangle of samples; east and north are one past the last.
struct SampleRectangle {
    int west;
    int east;
    int south;
    int north;
};

bool has_voids(const Field& field, const SampleRectangle& piece) {
    for (int row = piece.south; row < piece.north; ++row) {
        const std::int16_t* const start = &field.at(0, row);
        if (std::find(start + piece.west, start + piece.east, void_number) != start + piece.east) { return true; }
    }
    return false;
}

/// Writes the heights of a grid into the voids of a piece. `of` is the rectangle that the grid covers.
void write_filled(
    const Field& field, const SampleRectangle& piece, const heights::HeightGrid& grid, SampleRectangle of) {
    for (int row = piece.south; row < piece.north; ++row) {
        for (int column = piece.west; column < piece.east; ++column) {
            std::int16_t& number = field.at(column, row);
            if (number == void_number) {
                number = static_cast<std::int16_t>(std::lround(grid.at(column - of.west, row - of.south)));
            }
        }
    }
}

/// Fills the voids of one piece, starting from the coarse field.
void fill_rectangle(const Field& field, const SampleRectangle& piece, const heights::HeightGrid& coarse, int edge) {
    const SampleRectangle wide{std::max(0, piece.west - margin), std::min(field.columns, piece.east + margin),
        std::max(0, piece.south - margin), std::min(field.rows, piece.north + margin)};
    heights::HeightGrid grid;
    grid.columns = wide.east - wide.west;
    grid.rows = wide.north - wide.south;
    for (int row = wide.south; row < wide.north; ++row) {
        for (int column = wide.west; column < wide.east; ++column) {
            grid.heights_m.push_back(height_of(field.at(column, row)));
        }
    }
    heights::fill_voids_from(grid, [&](int column, int row) {
        return heights::interpolated(
            coarse, (wide.west + column + 0.5) / edge - 0.5, (wide.south + row + 0.5) / edge - 0.5);
    });
    write_filled(field, piece, grid, wide);
}

/// Gives every void of a field (row after row) a height that runs smoothly from rim to rim, rounded to a whole number.
/// At least one sample must be known; known samples stay as they are. Up to four million samples are filled in one
/// piece (models/heights/height_voids.h). Of a larger field, a coarser one of block means is filled first, and from it
/// the voids are smoothed piece by piece. Memory: at most 80 MB besides the numbers.
void fill_integer_voids(std::span<std::int16_t> numbers, int columns, int rows) {
    const Field field{numbers, columns, rows};
    int edge = 1;
    while (numbers.size() > max_samples_at_once * static_cast<std::size_t>(edge * edge)) { edge *= 2; }
    heights::HeightGrid coarse = heights::block_means(
        columns, rows, edge, [&](int column, int row) { return height_of(field.at(column, row)); });
    heights::fill_voids(coarse);
    if (edge == 1) {
        const SampleRectangle all{0, columns, 0, rows};
        write_filled(field, all, coarse, all);
        return;
    }
    for (int south = 0; south < rows; south += rectangle_edge) {
        for (int west = 0; west < columns; west += rectangle_edge) {
            const SampleRectangle piece{
                west, std::min(west + rectangle_edge, columns), south, std::min(south + rectangle_edge, rows)};
            if (has_voids(field, piece)) { fill_rectangle(field, piece, coarse, edge); }
        }
    }
}

/// Updates the lowest and highest height in `progress`; NaN counts for nothing.
void take_range(std::span<const float> heights_m, ImportProgress& progress) {
    for (const double height_m : heights_m) {
        progress.lowest_m = height_m < progress.lowest_m ? height_m : progress.lowest_m;
        progress.highest_m = height_m > progress.highest_m ? height_m : progress.highest_m;
    }
}

/// Reads the rows that fill the span as the numbers to keep, void_number for samples without data. If the source has
/// whole metres, these are kept, and lowest and highest in `progress` are updated; otherwise the numbers are those of
/// shape_of the scanned heights. Counts voids. Throws Error as the source does.
void read_rows(
    heights::HeightSource& source, int first_row, std::span<std::int16_t> numbers, ImportProgress& progress) {
    std::vector<float> heights_m(numbers.size());
    source.read(first_row, heights_m);
    const bool is_integer = source.has_integer_metres();
    if (is_integer) { take_range(heights_m, progress); }
    const terrain::GroundShape shape = terrain::shape_of(1, 1, 1.0, progress.lowest_m, progress.highest_m);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const bool is_void = std::isnan(heights_m[i]);
        progress.voids += is_void ? 1 : 0;
        numbers[i] = is_void      ? void_number
                     : is_integer ? static_cast<std::int16_t>(heights_m[i])
                                  : terrain::stored_number(heights_m[i], shape);
    }
}

// The files around an import: nothing of the user's is overwritten, and a finished file appears under its name in one
// step.

/// A hash of the inputs (names, sizes, times) and options of an import, which tells one import from another.
std::uint64_t hash_of_inputs(const std::vector<path>& inputs, const heights::ImportOptions& options) {
    Hash hash;
    hash.add_word(std::bit_cast<std::uint64_t>(options.spacing_m));
    hash.add_word(std::bit_cast<std::uint64_t>(options.height_scale.value_or(0.0)));
    for (const std::optional<std::string>& text : {options.system, options.band}) {
        hash.add_word(text ? text->size() + 1 : 0);
        const std::string bytes = text.value_or("");
        hash.add(std::as_bytes(std::span(bytes)));
    }
    hash.add_word(options.voids.only ? 1 : 0);
    hash.add_word(options.voids.values.size());
    hash.add(std::as_bytes(std::span(options.voids.values)));
    for (const path& input : inputs) {
        std::error_code code;
        const std::string name = std::filesystem::absolute(input, code).string();
        hash.add(std::as_bytes(std::span(name)));
        hash.add_word(std::filesystem::file_size(input, code));
        hash.add_word(
            static_cast<std::uint64_t>(std::filesystem::last_write_time(input, code).time_since_epoch().count()));
    }
    return hash.value();
}

/// Throws Error when writing `out`, and `part` on the way, would overwrite an input or something that is no regular
/// file.
void check_output(const std::vector<path>& inputs, const path& out, const path& part) {
    std::error_code code;
    for (const path& written : {out, part}) {
        for (const path& input : inputs) {
            if (std::filesystem::equivalent(input, written, code)) {
                throw_error_in(written, "expected a file to write, got one of the inputs");
            }
        }
        if (std::filesystem::exists(written, code) && !std::filesystem::is_regular_file(written, code)) {
            throw_error_in(written, "expected a file to write, got a folder, device or pipe");
        }
    }
}

/// Throws Error when there is a file at `part` that is neither empty nor begins as ground files do.
void check_partial_file(const path& part) {
    std::error_code code;
    if (!is_ground_file(part) && std::filesystem::file_size(part, code) > 0) {
        throw_error_in(part,
            "expected what an earlier import left, got another kind of file: move it away or choose another --out");
    }
}

/// Renames the part to `out`; the new name is on the disk when it returns. Throws Error.
void rename_into_place(const path& part, const path& out) {
    std::error_code code;
    std::filesystem::rename(part, out, code);
    if (code) { throw_error_in(out, fmt::format("cannot be written: {}", code.message())); }
    sync_folder_of(out);
}

constexpr int samples_per_band = 1 << 22;
constexpr std::size_t tiles_per_batch = 256;

/// One import, from the inputs to the finished file.
class Import {
public:
    Import(
        const std::vector<path>& inputs, path out, const GroundImportOptions& options, const ImportCallback& callback)
        : out_(std::move(out)), part_(out_), options_(options), callback_(callback),
          source_(inputs, options.source_options), layout_(source_.columns(), source_.rows()), plan_(layout_),
          inputs_(hash_of_inputs(inputs, options.source_options)) {
        part_ += ".part";
        check_output(inputs, out_, part_);
        if (!is_storable(terrain::shape_of(2, 2, source_.spacing_m(), 0.0, 0.0))) {
            throw_error_in(source_.name(),
                fmt::format("expected samples from 1 mm to 1000 km apart, got {:g} m", source_.spacing_m()));
        }
    }

    ImportSummary run() {
        shape_ = {source_.columns(), source_.rows(), source_.spacing_m(), 0.0, 1.0};
        if (!resume_unfinished()) { restart(); }
        if (progress_.stage == Stage::Scanning) { scan(); }
        if (progress_.stage == Stage::Reading) {
            read();
            fill();
        }
        build();
        finish();
        return {shape_, metadata_, plan_.file_bytes, note_, source_.notes()};
    }

private:
    /// Takes up an unfinished file if there is one that fits. Returns whether there was.
    bool resume_unfinished() {
        std::error_code code;
        if (!std::filesystem::exists(part_, code)) { return false; }
        file_ = std::make_unique<MappedFile>(part_, MappedFile::Access::ReadWrite);
        check_partial_file(part_);
        note_ = part_.string() + ": of other inputs or damaged, started anew";
        try {
            progress_ = read_header(part_, std::as_const(*file_).bytes()).progress;
        } catch (const Error&) { return false; }
        if (progress_.inputs != inputs_ || file_->bytes().size() != plan_.numbers + 2 * samples() ||
            progress_.stage == Stage::Filling || progress_.stage == Stage::Complete) {
            return false;
        }
        const bool builds = progress_.stage == Stage::Building;
        note_ = fmt::format("{}: goes on after {} of {} {}", part_.string(),
            builds ? progress_.tiles_done : progress_.rows_done,
            builds ? plan_.tiles : static_cast<std::size_t>(source_.rows()), builds ? "tiles" : "rows");
        return true;
    }

    /// Makes an empty file of the size that is needed while working.
    void restart() {
        file_.reset();
        progress_ = {};
        progress_.inputs = inputs_;
        progress_.stage = source_.has_integer_metres() ? Stage::Reading : Stage::Scanning;
        progress_.lowest_m = std::numeric_limits<double>::max();
        progress_.highest_m = std::numeric_limits<double>::lowest();
        file_ = std::make_unique<MappedFile>(part_, plan_.numbers + 2 * samples());
        write_header();
    }

    void report_progress(ImportStage stage, double done) {
        if (callback_(stage, done)) { save(); }
    }

    /// Brings everything done so far to the disk, the header last.
    void save() {
        file_->sync();
        write_header();
        file_->sync();
    }

    void scan() {
        std::vector<float> heights_m;
        for_each_band(ImportStage::Scanning, [&](int first_row, int count) {
            heights_m.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(source_.columns()));
            read_inputs([&] { source_.read(first_row, heights_m); });
            take_range(heights_m, progress_);
        });
        progress_.stage = Stage::Reading;
        progress_.rows_done = 0;
    }

    void read() {
        std::vector<std::int16_t> band;
        const auto columns = static_cast<std::size_t>(source_.columns());
        for_each_band(ImportStage::Reading, [&](int first_row, int count) {
            band.resize(static_cast<std::size_t>(count) * columns);
            read_inputs([&] { read_rows(source_, first_row, band, progress_); });
            const std::size_t offset = plan_.numbers + 2 * static_cast<std::size_t>(first_row) * columns;
            file_->write(offset, std::as_bytes(std::span(band)));
        });
        if (static_cast<std::size_t>(progress_.voids) == samples()) {
            remove_part();
            throw_error_in(source_.name(), "expected at least one height, got only samples without data");
        }
    }

    /// Fills the voids. From here until they are filled a stop must start anew, because half-filled voids would not be
    /// found again.
    void fill() {
        if (progress_.voids > 0) {
            report_progress(ImportStage::Filling, 0.0);
            progress_.stage = Stage::Filling;
            save();
            fill_integer_voids(numbers(), source_.columns(), source_.rows());
            progress_.stage = Stage::Building;
            report_progress(ImportStage::Filling, 1.0);
        }
        progress_.stage = Stage::Building;
    }

    void build() {
        shape_ = terrain::shape_of(
            source_.columns(), source_.rows(), source_.spacing_m(), progress_.lowest_m, progress_.highest_m);
        const terrain::StoredHeights stored = terrain::stored_heights(numbers(), shape_, source_.has_integer_metres());
        const std::span<std::byte> memory = file_part(GroundHeader::bytes, layout_.total_bytes());
        const std::span<std::byte> table = file_part(plan_.checksums, 8 * (plan_.tiles + 1));
        terrain::GroundAssembler assembly(shape_, layout_, stored, memory, options_.threads);
        report_progress(ImportStage::Building, 0.0);
        const terrain::HeightStatistics figures = assembly.write_overview();
        metadata_ = {source_.name(), source_.place(), source_.system(), progress_.voids, figures.lowest_m,
            figures.highest_m, figures.mean_m};
        const auto put = [&](std::size_t index, std::size_t offset, std::span<const std::byte> tile) {
            const std::uint64_t checksum = checksum_of(tile);
            std::memcpy(table.data() + 8 * (index + 1), &checksum, 8);
            file_->write(GroundHeader::bytes + offset, tile);
        };
        while (progress_.tiles_done < plan_.tiles) {
            progress_.tiles_done = assembly.build(progress_.tiles_done, tiles_per_batch, put);
            report_progress(
                ImportStage::Building, static_cast<double>(progress_.tiles_done) / static_cast<double>(plan_.tiles));
        }
        const std::uint64_t checksum = checksum_of(memory.first(layout_.first_tile()));
        std::memcpy(table.data(), &checksum, 8);
        checksums_ = checksum_of(table);
        const GroundTiles made(shape_, metadata_, memory, nullptr);
        read_inputs([&] {
            metadata_.deviation =
                source_.deviation_of([&made](double x_m, double y_m) { return made.height_at(x_m, y_m); });
        });
    }

    void finish() {
        report_progress(ImportStage::Writing, 0.0);
        file_->truncate(plan_.file_bytes);
        file_->sync();
        progress_ = {};
        progress_.stage = Stage::Complete;
        write_header();
        file_->sync();
        verify_written();
        rename_into_place(part_, out_); // While the part is still locked.
        file_.reset();
        callback_(ImportStage::Writing, 1.0);
    }

    /// Throws Error unless the disk gives back what was written.
    void verify_written() {
        file_->drop_cached_pages();
        try {
            verify_ground(part_, options_.threads);
        } catch (const Error& fault) {
            remove_part();
            throw_error_in(out_, fmt::format("cannot be read back as it was written, try again: {}", fault.what()));
        }
    }

    void write_header() { file_->write(0, header_page({shape_, metadata_, progress_, checksums_})); }

    void remove_part() {
        std::error_code code;
        std::filesystem::remove(part_, code);
    }

    /// Lets `read` read the inputs. If they are at fault, the unfinished file is removed, because there is nothing to
    /// go on from.
    template <typename Read>
    void read_inputs(const Read& read) {
        try {
            read();
        } catch (const Error&) {
            remove_part();
            throw;
        }
    }

    /// Calls `work(first row, rows)` for the rows that are not yet done, from the north, and reports progress.
    template <typename Work>
    void for_each_band(ImportStage stage, const Work& work) {
        const int rows = source_.rows();
        const int rows_per_band = std::max(1, samples_per_band / source_.columns());
        report_progress(stage, static_cast<double>(progress_.rows_done) / rows);
        while (progress_.rows_done < static_cast<std::uint64_t>(rows)) {
            const int end = rows - static_cast<int>(progress_.rows_done);
            const int first = std::max(0, end - rows_per_band);
            work(first, end - first);
            progress_.rows_done = static_cast<std::uint64_t>(rows - first);
            report_progress(stage, static_cast<double>(progress_.rows_done) / rows);
        }
    }

    std::span<std::byte> file_part(std::size_t offset, std::size_t size) {
        return file_->bytes().subspan(offset, size);
    }

    std::size_t samples() const {
        return static_cast<std::size_t>(source_.columns()) * static_cast<std::size_t>(source_.rows());
    }

    /// The field's rows, which lie behind what will be the ground.
    std::span<std::int16_t> numbers() {
        std::byte* const start = file_->bytes().data() + plan_.numbers;
        return {reinterpret_cast<std::int16_t*>(start), samples()};
    }

    path out_;
    path part_;
    GroundImportOptions options_;
    const ImportCallback& callback_;
    heights::HeightSource source_;
    GroundLayout layout_;
    GroundFileLayout plan_;
    std::uint64_t inputs_;
    std::unique_ptr<MappedFile> file_;
    ImportProgress progress_;
    GroundShape shape_;
    GroundMetadata metadata_;
    std::uint64_t checksums_ = 0;
    std::string note_;
};

} // namespace

ImportSummary import_ground(const std::vector<path>& inputs, const path& out, const GroundImportOptions& options,
    const ImportCallback& callback) {
    return Import(inputs, out, options, callback).run();
}

} // namespace octant::visuals::groundfile
