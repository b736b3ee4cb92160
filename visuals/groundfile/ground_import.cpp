// Imports large height fields. The heights are first read into the end of the file that is being
// made, then the tiles are built in front of them, and at last the file is cut. The header tells
// how far this has come, so that an import which was stopped can go on.
#include "visuals/groundfile/ground_import.h"

#include "models/heights/height_source.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/ground_header.h"
#include "visuals/groundfile/import_files.h"
#include "visuals/groundfile/import_rows.h"
#include "visuals/groundfile/mapped_file.h"
#include "visuals/groundfile/integer_voids.h"
#include "visuals/terrain/ground_assembler.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <utility>

namespace octant::visuals::groundfile {

namespace {

using std::filesystem::path;
using Stage = ImportProgress::Stage;
using terrain::GroundAssembler;
using terrain::HeightStatistics;
using terrain::StoredHeights;

constexpr int samples_per_band = 1 << 22;
constexpr std::size_t tiles_per_batch = 256;

/// One import, from the inputs to the finished file.
class Import {
public:
    Import(
        const std::vector<path>& inputs,
        path out,
        const GroundImportOptions& options,
        const ImportCallback& callback);

    ImportSummary run();

private:
    /// Takes up an unfinished file if there is one that fits. Returns whether there was.
    bool resume_unfinished();
    /// Makes an empty file of the size that is needed while working.
    void restart();
    void report_progress(ImportStage stage, double done);
    /// Brings everything done so far to the disk, the header last.
    void save();
    void scan();
    void read();
    void fill();
    void build();
    void finish();
    /// Throws Error unless the disk gives back what was written.
    void verify_written();
    void write_header();
    void remove_part();

    /// Lets `read` read the inputs. If they are at fault, the unfinished file is removed, because
    /// there is nothing to go on from.
    template <typename Read>
    void read_inputs(const Read& read);

    /// Calls `work(first row, rows)` for the rows that are not yet done, from the north, and
    /// reports progress.
    template <typename Work>
    void for_each_band(ImportStage stage, const Work& work);

    std::span<std::byte> file_part(std::size_t offset, std::size_t size) {
        return file_->bytes().subspan(offset, size);
    }

    std::size_t samples() const {
        return static_cast<std::size_t>(source_.columns()) *
               static_cast<std::size_t>(source_.rows());
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
    models::heights::HeightSource source_;
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

Import::Import(
    const std::vector<path>& inputs,
    path out,
    const GroundImportOptions& options,
    const ImportCallback& callback)
    : out_(std::move(out))
    , part_(out_)
    , options_(options)
    , callback_(callback)
    , source_(inputs, options.source_options)
    , layout_(source_.columns(), source_.rows())
    , plan_(layout_)
    , inputs_(hash_of_inputs(inputs, options.source_options)) {
    part_ += ".part";
    check_output(inputs, out_, part_);
    if (!is_storable(terrain::shape_of(2, 2, source_.spacing_m(), 0.0, 0.0))) {
        throw_error_in(
            source_.name(),
            fmt::format(
                "expected samples from 1 mm to 1000 km apart, got {:g} m", source_.spacing_m()));
    }
}

ImportSummary Import::run() {
    shape_ = {source_.columns(), source_.rows(), source_.spacing_m(), 0.0, 1.0};
    if (!resume_unfinished()) {
        restart();
    }
    if (progress_.stage == Stage::Scanning) {
        scan();
    }
    if (progress_.stage == Stage::Reading) {
        read();
        fill();
    }
    build();
    finish();
    return {shape_, metadata_, plan_.file_bytes, note_, source_.notes()};
}

bool Import::resume_unfinished() {
    std::error_code code;
    if (!std::filesystem::exists(part_, code)) {
        return false;
    }
    file_ = std::make_unique<MappedFile>(part_, MappedFile::Access::ReadWrite);
    check_partial_file(part_);
    note_ = part_.string() + ": of other inputs or damaged, started anew";
    try {
        progress_ = read_header(part_, std::as_const(*file_).bytes()).progress;
    } catch (const Error&) {
        return false;
    }
    if (progress_.inputs != inputs_ || file_->bytes().size() != plan_.numbers + 2 * samples() ||
        progress_.stage == Stage::Filling || progress_.stage == Stage::Complete) {
        return false;
    }
    const bool builds = progress_.stage == Stage::Building;
    note_ = fmt::format(
        "{}: goes on after {} of {} {}",
        part_.string(),
        builds ? progress_.tiles_done : progress_.rows_done,
        builds ? plan_.tiles : static_cast<std::size_t>(source_.rows()),
        builds ? "tiles" : "rows");
    return true;
}

void Import::restart() {
    file_.reset();
    progress_ = {};
    progress_.inputs = inputs_;
    progress_.stage = source_.has_integer_metres() ? Stage::Reading : Stage::Scanning;
    progress_.lowest_m = std::numeric_limits<double>::max();
    progress_.highest_m = std::numeric_limits<double>::lowest();
    file_ = std::make_unique<MappedFile>(part_, plan_.numbers + 2 * samples());
    write_header();
}

void Import::report_progress(ImportStage stage, double done) {
    if (callback_(stage, done)) {
        save();
    }
}

void Import::save() {
    file_->sync();
    write_header();
    file_->sync();
}

void Import::write_header() {
    GroundHeader header = header_of(shape_, metadata_);
    header.progress = progress_;
    header.checksums = checksums_;
    const auto page = header_page(header);
    file_->write(0, page);
}

void Import::remove_part() {
    std::error_code code;
    std::filesystem::remove(part_, code);
}

template <typename Read>
void Import::read_inputs(const Read& read) {
    try {
        read();
    } catch (const Error&) {
        remove_part();
        throw;
    }
}

template <typename Work>
void Import::for_each_band(ImportStage stage, const Work& work) {
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

void Import::scan() {
    for_each_band(ImportStage::Scanning, [&](int first_row, int count) {
        read_inputs([&] { scan_rows(source_, first_row, count, progress_); });
    });
    progress_.stage = Stage::Reading;
    progress_.rows_done = 0;
}

void Import::read() {
    std::vector<std::int16_t> band;
    const auto columns = static_cast<std::size_t>(source_.columns());
    for_each_band(ImportStage::Reading, [&](int first_row, int count) {
        band.resize(static_cast<std::size_t>(count) * columns);
        read_inputs([&] { read_rows(source_, first_row, band, progress_); });
        const std::size_t offset =
            plan_.numbers + 2 * static_cast<std::size_t>(first_row) * columns;
        file_->write(offset, std::as_bytes(std::span(band)));
    });
    if (static_cast<std::size_t>(progress_.voids) == samples()) {
        remove_part();
        throw_error_in(source_.name(), "expected at least one height, got only samples without data");
    }
}

/// Fills the voids. From here until they are filled a stop must start anew, because half-filled
/// voids would not be found again.
void Import::fill() {
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

void Import::build() {
    shape_ = terrain::shape_of(
        source_.columns(),
        source_.rows(),
        source_.spacing_m(),
        progress_.lowest_m,
        progress_.highest_m);
    const StoredHeights heights =
        terrain::stored_heights(numbers(), shape_, source_.has_integer_metres());
    const std::span<std::byte> memory = file_part(GroundHeader::bytes, layout_.total_bytes());
    const std::span<std::byte> table = file_part(plan_.checksums, 8 * (plan_.tiles + 1));
    GroundAssembler assembly(shape_, layout_, heights, memory, options_.threads);
    report_progress(ImportStage::Building, 0.0);
    const HeightStatistics figures = assembly.write_overview();
    metadata_ = {
        source_.name(),
        source_.place(),
        source_.system(),
        progress_.voids,
        figures.lowest_m,
        figures.highest_m,
        figures.mean_m};
    const auto put = [&](std::size_t index, std::size_t offset, std::span<const std::byte> tile) {
        const std::uint64_t checksum = checksum_of(tile);
        std::memcpy(table.data() + 8 * (index + 1), &checksum, 8);
        file_->write(GroundHeader::bytes + offset, tile);
    };
    while (progress_.tiles_done < plan_.tiles) {
        progress_.tiles_done = assembly.build(progress_.tiles_done, tiles_per_batch, put);
        report_progress(
            ImportStage::Building,
            static_cast<double>(progress_.tiles_done) / static_cast<double>(plan_.tiles));
    }
    const std::uint64_t checksum = checksum_of(memory.first(layout_.first_tile()));
    std::memcpy(table.data(), &checksum, 8);
    checksums_ = checksum_of(table);
    const GroundTiles made(shape_, metadata_, memory, nullptr);
    read_inputs([&] {
        metadata_.deviation = source_.deviation_of(
            [&made](double x_m, double y_m) { return made.height_at(x_m, y_m); });
    });
}

void Import::finish() {
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

void Import::verify_written() {
    file_->drop_cached_pages();
    try {
        verify_ground(part_, options_.threads);
    } catch (const Error& fault) {
        remove_part();
        throw_error_in(
            out_,
            fmt::format("cannot be read back as it was written, try again: {}", fault.what()));
    }
}

} // namespace

ImportSummary import_ground(
    const std::vector<path>& inputs,
    const path& out,
    const GroundImportOptions& options,
    const ImportCallback& callback) {
    return Import(inputs, out, options, callback).run();
}

} // namespace octant::visuals::groundfile
