// Opens imported grounds. A file of 16385 x 16385 samples is 940 MB; mapping it makes flights over it start at once,
// and only the tiles that a mesh looks at are read.
#include "visuals/groundfile/ground_file.h"

#include "models/heights/local_frame.h"
#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/text_file.h"
#include "sim/base/thread_pool.h"
#include "visuals/groundfile/mapped_file.h"
#include "visuals/terrain/bisection_tiles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant::visuals::groundfile {

// Writes and checks the first page of a ground's file. Files come from outside: every number is checked before it is
// used, and a hash of the layout refuses files of another release.

namespace {

constexpr std::size_t checksum_bytes = 8;
constexpr std::size_t max_name_bytes = 256;
constexpr std::size_t max_wkt_bytes = 3072;

constexpr ArchiveKind header_kind{.content = "a ground made by terrain import",
    .signature = "octant g",
    .version = 7,
    .max_bytes = GroundHeader::bytes};
/// Files of versions 1 to 6, which were no archives, begin with this.
constexpr std::string_view earlier_signature = "octant ground\r\n\x1a";

bool is_power_of_two(double x) {
    int exponent = 0;
    return std::frexp(x, &exponent) == 0.5;
}

/// Whether |x| is at most `largest`; false for a NaN.
bool lies_within(double x, double largest) { return std::abs(x) <= largest; }

/// Whether all numbers of a header may be used.
bool is_intact(const GroundHeader& h) {
    const auto fits = [](int n) { return n >= 2 && n <= 65536; };
    const auto are_finite = [](auto... numbers) { return (std::isfinite(numbers) && ...); };
    const GroundMetadata& m = h.metadata;
    return fits(h.shape.columns) && fits(h.shape.rows) && is_storable(h.shape) &&
           are_finite(m.lowest_m, m.highest_m, m.mean_m, h.progress.lowest_m, h.progress.highest_m) &&
           (!m.place || (lies_within(m.place->latitude_deg, 90.0) && lies_within(m.place->longitude_deg, 360.0))) &&
           (!m.system ||
               (are_finite(m.system->centre_x, m.system->centre_y, m.system->unit_m) && m.system->unit_m > 0.0)) &&
           (!m.deviation || (are_finite(m.deviation->rms_m, m.deviation->worst_m) && m.deviation->places >= 0)) &&
           h.progress.stage <= ImportProgress::Stage::Complete;
}

/// The length of the longest beginning of a text that has at most `longest` bytes and ends with a whole character.
std::size_t truncated_length(std::string_view text, std::size_t longest) {
    std::size_t length = 0;
    while (length < text.size()) {
        const std::size_t next = length + std::max(utf8_length(text.substr(length)), std::size_t{1});
        if (next > longest) { break; }
        length = next;
    }
    return length;
}

/// The text with everything replaced that is not valid UTF-8 or is a control character.
std::string sanitized_utf8(std::string_view text) {
    constexpr std::string_view replacement = "\xEF\xBF\xBD";
    std::string out;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const auto first = static_cast<unsigned char>(text.front());
        const bool is_control = first < 0x20 || first == 0x7f;
        out += length == 0 || is_control ? replacement : text.substr(0, length);
        text.remove_prefix(std::max(length, std::size_t{1}));
    }
    return out;
}

} // namespace

GroundFileLayout::GroundFileLayout(const GroundLayout& layout) {
    for (int level = 0; level < layout.levels(); ++level) { tiles += layout.level(level).tile_count(); }
    checksums = (GroundHeader::bytes + layout.total_bytes() + checksum_bytes - 1) / checksum_bytes * checksum_bytes;
    file_bytes = checksums + checksum_bytes * (tiles + 1);
    const std::size_t page = GroundLayout::page_bytes;
    numbers = (file_bytes + page - 1) / page * page;
}

std::uint64_t hash_of(const GroundShape& shape) {
    const GroundLayout layout(shape);
    Hash hash;
    for (int level = 0; level < layout.levels(); ++level) {
        const GroundLayout::Level& at = layout.level(level);
        for (const std::size_t place : {at.tile_nodes, at.tile_bytes, at.first_tile, at.north_heights,
                 at.north_errors[0], at.east_heights, at.east_errors[0], at.ranges}) {
            hash.add_word(place);
        }
        for (const std::size_t place : {at.errors[1][0], at.errors[1][1], at.north_errors[1], at.east_errors[1]}) {
            hash.add_word(place);
        }
    }
    const terrain::ErrorCodes codes(shape.height_unit_m);
    for (int code = 0; code < 256; ++code) {
        hash.add_word(std::bit_cast<std::uint32_t>(codes.metres(static_cast<std::uint8_t>(code))));
    }
    return hash.value();
}

bool is_storable(const GroundShape& shape) {
    const double unit_m = shape.height_unit_m;
    return shape.spacing_m >= 1e-3 && shape.spacing_m <= 1e6 && lies_within(shape.height_base_m, 1e5) &&
           unit_m >= 0x1p-12 && unit_m <= 1.0 && is_power_of_two(unit_m);
}

namespace {

void put_metadata(const GroundMetadata& metadata, BinaryWriter& out) {
    out.put_text(std::string_view(metadata.name).substr(0, truncated_length(metadata.name, max_name_bytes)));
    out.put(std::uint8_t{metadata.place.has_value()});
    if (metadata.place) {
        out.put(metadata.place->latitude_deg);
        out.put(metadata.place->longitude_deg);
    }
    const bool has_system = metadata.system && metadata.system->wkt.size() <= max_wkt_bytes;
    out.put(std::uint8_t{has_system});
    if (has_system) {
        out.put_text(metadata.system->wkt);
        out.put(metadata.system->centre_x);
        out.put(metadata.system->centre_y);
        out.put(metadata.system->unit_m);
    }
    out.put(std::uint8_t{metadata.deviation.has_value()});
    if (metadata.deviation) {
        out.put(metadata.deviation->rms_m);
        out.put(metadata.deviation->worst_m);
        out.put(std::int64_t{metadata.deviation->places});
    }
    out.put(metadata.filled_voids);
    out.put(metadata.lowest_m);
    out.put(metadata.highest_m);
    out.put(metadata.mean_m);
}

/// What put_metadata wrote. Braces evaluate from left to right.
GroundMetadata take_metadata(BinaryReader& in) {
    GroundMetadata metadata;
    metadata.name = sanitized_utf8(in.take_text("a name"));
    if (in.take<std::uint8_t>() != 0) { metadata.place = GeoPosition{in.take<double>(), in.take<double>()}; }
    if (in.take<std::uint8_t>() != 0) {
        metadata.system = models::heights::CoordinateSystem{
            std::string(in.take_text("a coordinate system")), in.take<double>(), in.take<double>(), in.take<double>()};
        if (metadata.place) { metadata.place->ellipsoid = models::heights::ellipsoid_of(metadata.system->wkt); }
    }
    if (in.take<std::uint8_t>() != 0) {
        metadata.deviation =
            models::heights::HeightDeviation{in.take<double>(), in.take<double>(), in.take<std::int64_t>()};
    }
    metadata.filled_voids = in.take<std::int64_t>();
    metadata.lowest_m = in.take<float>();
    metadata.highest_m = in.take<float>();
    metadata.mean_m = in.take<float>();
    return metadata;
}

ImportProgress take_progress(BinaryReader& in) {
    return {in.take<ImportProgress::Stage>(), in.take<std::uint64_t>(), in.take<std::uint64_t>(),
        in.take<std::uint64_t>(), in.take<std::int64_t>(), in.take<double>(), in.take<double>()};
}

GroundHeader decoded_header(BinaryReader body) {
    GroundHeader header;
    GroundShape& shape = header.shape;
    shape.columns = body.take<std::int32_t>();
    shape.rows = body.take<std::int32_t>();
    for (double* const number : {&shape.spacing_m, &shape.height_base_m, &shape.height_unit_m}) {
        *number = body.take<double>();
    }
    const auto layout = body.take<std::uint64_t>();
    header.checksums = body.take<std::uint64_t>();
    header.progress = take_progress(body);
    header.metadata = take_metadata(body);
    body.check(is_intact(header), "numbers of a ground");
    body.check(layout == hash_of(shape), "the layout of this release");
    return header;
}

} // namespace

std::array<std::byte, GroundHeader::bytes> header_page(const GroundHeader& header) {
    const ImportProgress& progress = header.progress;
    BinaryWriter body;
    body.put(std::int32_t{header.shape.columns});
    body.put(std::int32_t{header.shape.rows});
    body.put(header.shape.spacing_m);
    body.put(header.shape.height_base_m);
    body.put(header.shape.height_unit_m);
    body.put(hash_of(header.shape));
    body.put(header.checksums);
    body.put(progress.stage);
    for (const std::uint64_t number : {progress.inputs, progress.rows_done, progress.tiles_done}) { body.put(number); }
    body.put(progress.voids);
    body.put(progress.lowest_m);
    body.put(progress.highest_m);
    put_metadata(header.metadata, body);
    std::string padded = body.bytes();
    padded.resize(GroundHeader::bytes - archive_head_bytes, '\0');
    const std::string bytes = archive_bytes(header_kind, padded);
    std::array<std::byte, GroundHeader::bytes> page = {};
    std::ranges::copy(std::as_bytes(std::span(bytes)), page.begin());
    return page;
}

GroundHeader read_header(const std::filesystem::path& path, std::span<const std::byte> file) {
    const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
    if (file.size() < GroundHeader::bytes || !bytes.starts_with(header_kind.signature)) {
        throw_error_in(path, "expected a ground made by terrain import, got another kind of file");
    }
    if (bytes.starts_with(earlier_signature)) {
        throw_error_in(path,
            fmt::format("expected a ground of version {}, got an earlier one: import it again", header_kind.version));
    }
    try {
        return decoded_header(archive_body(bytes.substr(0, GroundHeader::bytes), path, header_kind));
    } catch (const Error& fault) { throw Error(fmt::format("{}: import it again", fault.what())); }
}

namespace {

struct TileId {
    int level = 0;
    std::size_t tile = 0; ///< as the level's tiles lie in memory
};

/// Whether the tile of a level is sound in the file.
using TileCheck = std::function<bool(int level, std::size_t tile)>;

using terrain::MorphMargin;
using terrain::NodePart;

constexpr std::array<NodePart, 3> parts = {NodePart::Centre, NodePart::South, NodePart::West};
constexpr std::uint8_t greatest_code = 255;

struct GridIndex {
    int column = 0;
    int row = 0;

    bool operator==(const GridIndex&) const = default;
};

class TileRepair {
public:
    TileRepair(const TileCheck& is_intact, const GroundTiles& ground, TileId number, std::span<std::byte> bytes)
        : is_intact_(is_intact), ground_(ground), level_(number.level), at_(ground.layout().level(number.level)),
          first_{static_cast<int>(number.tile % static_cast<std::size_t>(at_.tiles_across)) << at_.tile_shift,
              static_cast<int>(number.tile / static_cast<std::size_t>(at_.tiles_across)) << at_.tile_shift},
          end_{std::min(first_.column + side(), at_.columns), std::min(first_.row + side(), at_.rows)}, bytes_(bytes) {}

    void repair() {
        std::fill(bytes_.begin(), bytes_.end(), std::byte{0});
        for (int row = first_.row; row < end_.row; ++row) {
            for (int column = first_.column; column < end_.column; ++column) {
                for (const NodePart part : parts) { write_height(part, {column, row}, height(part, {column, row})); }
            }
        }
        // Where both margins share a place, the smaller errors stay.
        repair_errors(MorphMargin::Full);
        repair_errors(MorphMargin::None);
    }

private:
    void repair_errors(MorphMargin morph_margin) {
        for (int row = first_.row; row < end_.row; ++row) {
            for (int column = first_.column; column < end_.column; ++column) {
                code(NodePart::Centre, {column, row}, morph_margin) = centre_code({column, row}, morph_margin);
            }
        }
        for (int row = first_.row; row < end_.row; ++row) {
            for (int column = first_.column; column < end_.column; ++column) {
                const std::uint8_t own = code_of({column, row}, morph_margin);
                const bool in_south = row == 0;
                const bool in_west = column == 0;
                code(NodePart::South, {column, row}, morph_margin) =
                    in_south ? own : std::min(own, code_of({column, row - 1}, morph_margin));
                code(NodePart::West, {column, row}, morph_margin) =
                    in_west ? own : std::min(own, code_of({column - 1, row}, morph_margin));
            }
        }
    }

    int side() const { return 1 << at_.tile_shift; }

    bool is_own(GridIndex node) const {
        return node.column >= first_.column && node.row >= first_.row && node.column < end_.column &&
               node.row < end_.row;
    }

    std::size_t index_of(GridIndex node) const { return at_.node_in_tile(node.column, node.row); }

    void write_height(NodePart part, GridIndex node, std::int16_t stored) {
        reinterpret_cast<std::int16_t*>(
            bytes_.data())[static_cast<std::size_t>(part) * at_.tile_nodes + index_of(node)] = stored;
    }

    std::uint8_t& code(NodePart part, GridIndex node, MorphMargin morph_margin) {
        const std::size_t first = at_.errors[static_cast<std::size_t>(morph_margin)][static_cast<std::size_t>(part)];
        return reinterpret_cast<std::uint8_t*>(bytes_.data())[first + index_of(node)];
    }

    /// The code of a node's centre, in this tile or another of its level.
    std::uint8_t code_of(GridIndex node, MorphMargin morph_margin) {
        return is_own(node) ? code(NodePart::Centre, node, morph_margin)
                            : ground_.error_code(level_, NodePart::Centre, node.column, node.row, morph_margin);
    }

    /// A centre needs the middles of the two edges of its parent that lie on its own.
    std::uint8_t centre_code(GridIndex node, MorphMargin morph_margin) const {
        if (level_ == 0) { return greatest_code; }
        const int column = node.column / 2;
        const int row = node.row / 2;
        return std::min(ground_.error_code(level_ - 1, NodePart::South, column, row + node.row % 2, morph_margin),
            ground_.error_code(level_ - 1, NodePart::West, column + node.column % 2, row, morph_margin));
    }

    GridIndex clamped(GridIndex sample) const {
        return {std::clamp(sample.column, 0, ground_.columns() - 1), std::clamp(sample.row, 0, ground_.rows() - 1)};
    }

    /// The height of a sample where the tile that holds it is sound.
    std::optional<double> intact_height_m(GridIndex sample) const {
        const auto steps = static_cast<unsigned>(sample.column | sample.row);
        if (steps % static_cast<unsigned>(ground_.layout().level(0).edge) != 0) {
            const int zeros = std::countr_zero(steps);
            const int level = ground_.levels() - 1 - zeros;
            const GroundLayout::Level& at = ground_.layout().level(level);
            const GridIndex node{sample.column >> (zeros + 1), sample.row >> (zeros + 1)};
            const bool in_tile = node.column < at.columns && node.row < at.rows;
            if (in_tile && !is_intact_(level, at.tile_of(node.column, node.row))) { return std::nullopt; }
        }
        return static_cast<double>(ground_.height_m(sample.column, sample.row));
    }

    /// The mean of two samples where both are there and sound.
    std::optional<double> mean_m(GridIndex a, GridIndex b) const {
        const auto at_a = a == clamped(a) ? intact_height_m(a) : std::nullopt;
        const auto at_b = b == clamped(b) ? intact_height_m(b) : std::nullopt;
        return at_a && at_b ? std::optional(0.5 * (*at_a + *at_b)) : std::nullopt;
    }

    /// The ends of the edge that a node's sample halves.
    std::array<GridIndex, 2> ends_of(NodePart part, GridIndex node) const {
        const GridIndex low{node.column * at_.edge, node.row * at_.edge};
        const GridIndex high{low.column + at_.edge, low.row + at_.edge};
        if (part == NodePart::South) { return {low, GridIndex{high.column, low.row}}; }
        if (part == NodePart::West) { return {low, GridIndex{low.column, high.row}}; }
        return node.column % 2 == node.row % 2
                   ? std::array{low, high}
                   : std::array{GridIndex{high.column, low.row}, GridIndex{low.column, high.row}};
    }

    double coarser_m(NodePart part, GridIndex node) const {
        const auto end_m = [&](GridIndex nominal) -> std::optional<double> {
            const GridIndex end = clamped(nominal);
            return end == nominal ? std::optional(static_cast<double>(ground_.height_m(end.column, end.row)))
                                  : intact_height_m(end);
        };
        const auto [a, b] = ends_of(part, node);
        const auto at_a = end_m(a);
        const auto at_b = end_m(b);
        return at_a && at_b ? 0.5 * (*at_a + *at_b)
               : at_a       ? *at_a
                            : at_b.value_or(static_cast<double>(ground_.metadata().mean_m));
    }

    double height_m(NodePart part, GridIndex node) const {
        const int half = at_.edge / 2;
        const GridIndex nominal{node.column * at_.edge + (part == NodePart::West ? 0 : half),
            node.row * at_.edge + (part == NodePart::South ? 0 : half)};
        const GridIndex sample = clamped(nominal);
        if (sample != nominal) {
            if (const auto known_m = intact_height_m(sample)) { return *known_m; }
        }
        if (half > 1) {
            const auto across_m = mean_m({sample.column - 1, sample.row}, {sample.column + 1, sample.row});
            const auto along_m = mean_m({sample.column, sample.row - 1}, {sample.column, sample.row + 1});
            if (across_m && along_m) { return 0.5 * (*across_m + *along_m); }
            if (across_m || along_m) { return across_m ? *across_m : *along_m; }
        }
        return coarser_m(part, node);
    }

    std::int16_t height(NodePart part, GridIndex node) const {
        const GroundShape& shape = ground_.shape();
        const int shift = std::max(level_ - ground_.layout().range_level(), 0);
        const int level = level_ - shift;
        const double lowest_m = static_cast<double>(ground_.lowest_m(level, node.column >> shift, node.row >> shift));
        const double highest_m = static_cast<double>(ground_.highest_m(level, node.column >> shift, node.row >> shift));
        const double own_m = std::clamp(height_m(part, node), lowest_m, highest_m);
        return static_cast<std::int16_t>(std::lround((own_m - shape.height_base_m) / shape.height_unit_m));
    }

    const TileCheck& is_intact_;
    const GroundTiles& ground_;
    int level_;
    GroundLayout::Level at_;
    GridIndex first_;
    GridIndex end_;
    std::span<std::byte> bytes_;
};

/// Writes what is known of a damaged tile into its memory. Heights of a level that has finer ones are the means of the
/// undamaged samples around them; else each lies half-way between the ends of the edge that it halves, as the coarser
/// ground is drawn. Errors are the least of those of the samples that they need: never below the true ones, so that
/// errors stay nested and meshes have no cracks. Reads other tiles through `ground`, but not this one.
void repair_tile(const TileCheck& is_intact, const GroundTiles& ground, TileId number, std::span<std::byte> bytes) {
    TileRepair(is_intact, ground, number, bytes).repair();
}

using TileKey = std::tuple<int, std::size_t, std::size_t>; ///< level, row, column

struct DamageLog {
    std::mutex mutex;
    std::map<std::filesystem::path, std::set<TileKey>> tiles;
};

DamageLog& damage_log() {
    static DamageLog all;
    return all;
}

/// Counts a damaged tile that this program met. Any thread may call it.
void log_tile_damage(const std::filesystem::path& file, const TileKey& tile) {
    DamageLog& all = damage_log();
    const std::scoped_lock lock(all.mutex);
    all.tiles[file].insert(tile);
}

/// The tiles of a mapped file. Each tile is compared with its checksum when it is first read. A damaged tile is
/// repaired in memory, never in the file, and logged (log_tile_damage).
class ChecksumValidator final : public terrain::TileValidator {
public:
    /// A finished file, sound before its tiles, mapped with Access::CopyOnWrite, and its header.
    ChecksumValidator(std::filesystem::path path, std::shared_ptr<MappedFile> file, const GroundHeader& header)
        : TileValidator(GroundLayout(header.shape), false), path_(std::move(path)), file_(std::move(file)),
          ground_(header.shape, header.metadata,
              std::as_const(*file_).bytes().subspan(GroundHeader::bytes, GroundLayout(header.shape).total_bytes()),
              nullptr, std::shared_ptr<const TileValidator>(std::shared_ptr<const void>(), this)),
          checksums_(GroundFileLayout(ground_.layout()).checksums), bad_(GroundFileLayout(ground_.layout()).tiles) {}

private:
    /// Whether a tile's bytes in the file match its checksum; false for a repaired one.
    bool is_intact(int level, std::size_t tile) const {
        const std::scoped_lock lock(mutex_);
        const std::size_t index = index_of(level, tile);
        if (bad_[index] || is_valid(index)) { return !bad_[index]; }
        std::uint64_t checksum = 0;
        const std::size_t place = checksums_ + 8 * (index + 1); // the first is that of the bytes before the tiles
        std::memcpy(&checksum, std::as_const(*file_).bytes().data() + place, sizeof checksum);
        return checksum_of(ground_.tile(level, tile)) == checksum;
    }

    void validate(int level, std::size_t tile) const override {
        const std::scoped_lock lock(mutex_);
        const std::size_t index = index_of(level, tile);
        if (is_valid(index)) { return; }
        if (!is_intact(level, tile)) {
            bad_[index] = true;
            const GroundLayout::Level& at = ground_.layout().level(level);
            const auto across = static_cast<std::size_t>(at.tiles_across);
            log_tile_damage(path_, {level, tile / across, tile % across});
            const std::span<const std::byte> bytes = ground_.tile(level, tile);
            const auto offset = static_cast<std::size_t>(bytes.data() - std::as_const(*file_).bytes().data());
            repair_tile([this](int l, std::size_t t) { return is_intact(l, t); }, ground_, {level, tile},
                file_->writable_copy(offset, bytes.size()));
        }
        set_valid(index);
    }

    std::filesystem::path path_;
    std::shared_ptr<MappedFile> file_;
    GroundTiles ground_; ///< Over the same memory, guarded by this object.
    std::size_t checksums_;
    /// Held while a tile is checked or repaired, which may need other tiles.
    mutable std::recursive_mutex mutex_;
    mutable std::vector<bool> bad_;
};

using std::filesystem::path;

std::span<const std::byte> memory_of(const MappedFile& file, const GroundLayout& layout) {
    return file.bytes().subspan(GroundHeader::bytes, layout.total_bytes());
}

std::uint64_t checksum_at(const MappedFile& file, const GroundFileLayout& plan, std::size_t index) {
    std::uint64_t checksum = 0;
    std::memcpy(&checksum, file.bytes().data() + plan.checksums + 8 * index, 8);
    return checksum;
}

/// Throws Error unless the file is finished, has its full length and is sound before the tiles.
void check_before_tiles(const path& path, const MappedFile& file, const GroundHeader& header) {
    const GroundLayout layout(header.shape);
    const GroundFileLayout plan(layout);
    if (header.progress.stage != ImportProgress::Stage::Complete) {
        throw_error_in(path, "expected a finished ground, got one whose import was stopped");
    }
    if (file.bytes().size() != plan.file_bytes) {
        throw_error_in(path,
            fmt::format("expected {} bytes, got {}: copy or import it again", plan.file_bytes, file.bytes().size()));
    }
    if (checksum_of(file.bytes().subspan(plan.checksums)) != header.checksums ||
        checksum_of(memory_of(file, layout).first(layout.first_tile())) != checksum_at(file, plan, 0)) {
        throw_error_in(path, "expected sound data before the tiles, got damage: import it again");
    }
}

} // namespace

bool is_ground_file(const path& path) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(path, code)) { return false; }
    std::array<char, header_kind.signature.size()> signature = {};
    std::ifstream(path, std::ios::binary).read(signature.data(), signature.size());
    return std::string_view(signature.data(), signature.size()) == header_kind.signature;
}

GroundTiles open_ground(const path& path) {
    const auto file = std::make_shared<MappedFile>(path, MappedFile::Access::CopyOnWrite);
    const GroundHeader header = read_header(path, std::as_const(*file).bytes());
    check_before_tiles(path, *file, header);
    const GroundShape shape = header.shape;
    const GroundLayout layout(shape);
    const auto tested = std::make_shared<const ChecksumValidator>(path, file, header);
    return {shape, header.metadata, memory_of(*file, layout), file, tested};
}

std::uint64_t hash_of_ground(const path& path) {
    const MappedFile file(path, MappedFile::Access::Read);
    const GroundHeader header = read_header(path, file.bytes());
    check_before_tiles(path, file, header);
    const GroundLayout layout(header.shape);
    Hash hash;
    hash.add(file.bytes().first(GroundHeader::bytes + layout.first_tile()));
    hash.add(file.bytes().subspan(GroundFileLayout(layout).checksums));
    return hash.value();
}

void verify_ground(const path& path, int threads) {
    const MappedFile file(path, MappedFile::Access::Read);
    const GroundHeader header = read_header(path, file.bytes());
    check_before_tiles(path, file, header);
    const GroundLayout layout(header.shape);
    const GroundFileLayout plan(layout);
    std::size_t before = 1;
    for (int level = 0; level < layout.levels(); ++level) {
        const GroundLayout::Level& at = layout.level(level);
        const std::size_t count = at.tile_count();
        std::atomic<std::size_t> first_bad = count;
        parallel_for(count, threads, [&](std::size_t tile, std::size_t /*worker*/) {
            const auto bytes = memory_of(file, layout).subspan(at.first_tile + tile * at.tile_bytes, at.tile_bytes);
            if (checksum_of(bytes) != checksum_at(file, plan, before + tile)) {
                std::size_t known = first_bad;
                while (tile < known && !first_bad.compare_exchange_weak(known, tile)) {}
            }
        });
        if (first_bad < count) {
            const auto across = static_cast<std::size_t>(at.tiles_across);
            throw_error_in(path,
                fmt::format("expected sound tiles, got damage in level {}, tile column {}, row {}: import it again",
                    level, first_bad % across, first_bad / across));
        }
        before += count;
    }
}

std::vector<std::string> tile_damage_messages() {
    DamageLog& all = damage_log();
    const std::scoped_lock lock(all.mutex);
    std::vector<std::string> lines;
    for (const auto& [file, tiles] : all.tiles) {
        const auto& [level, row, column] = *tiles.begin();
        lines.push_back(fmt::format("{}: expected sound tiles, got damage in {} tile{} (the coarsest in level {}, "
                                    "column {}, row {}), where a coarser ground was shown: import it again",
            file.string(), tiles.size(), tiles.size() == 1 ? "" : "s", level, column, row));
    }
    return lines;
}

} // namespace octant::visuals::groundfile
