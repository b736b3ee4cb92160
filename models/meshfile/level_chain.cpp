#include "models/meshfile/level_chain.h"

#include "models/meshfile/byte_reader.h"
#include "models/meshfile/byte_writer.h"
#include "models/meshfile/chain_bytes.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <string_view>
#include <utility>

namespace octant::models::meshfile {

namespace {

/// Magic, version, a word for later, bytes behind the head, their hash.
constexpr std::string_view magic = "octchain";
constexpr std::uint32_t version = 1;
constexpr std::size_t head_bytes = 32;
constexpr std::size_t largest_chain_bytes = std::size_t{1} << 31U;
constexpr std::uint32_t max_levels = 1000;

double take_error_m(ByteReader& reader, double min_m) {
    const auto error_m = reader.number<double>("an error");
    if (!(error_m >= min_m && std::isfinite(error_m))) {
        reader.refuse_at(
            reader.at() - 8,
            fmt::format("an error of at least {}", min_m),
            fmt::format("{}", error_m));
    }
    return error_m;
}

/// Gives the bytes behind the head once they are what was written.
void check_head(ByteReader& reader, std::string_view bytes) {
    if (reader.take(magic.size(), "a chain of levels") != magic) {
        reader.refuse_at(0, "a chain of levels", "another file");
    }
    const auto found = reader.number<std::uint32_t>("a version");
    if (found != version) {
        reader.refuse_at(8, fmt::format("version {}", version), std::to_string(found));
    }
    reader.number<std::uint32_t>("a word");
    const auto size = reader.number<std::uint64_t>("a size");
    if (size != bytes.size() - std::min(bytes.size(), head_bytes)) {
        reader.refuse_at(
            16,
            fmt::format(
                "{} bytes behind the head", bytes.size() - std::min(bytes.size(), head_bytes)),
            std::to_string(size));
    }
    const auto hash = reader.number<std::uint64_t>("a checksum");
    const std::uint64_t own = checksum_of(bytes.substr(head_bytes));
    if (hash != own) {
        reader.refuse_at(
            24, fmt::format("the checksum {:016x}", own), fmt::format("{:016x}", hash));
    }
}

} // namespace

bool is_chain_file(const std::filesystem::path& path) {
    return extension_of(path) == ".chain";
}

LevelChain read_chain(const std::filesystem::path& path) {
    const std::string bytes = read_file(path, largest_chain_bytes);
    ByteReader reader(path, bytes);
    check_head(reader, bytes);
    LevelChain chain;
    chain.name = take_text(reader);
    const auto levels = reader.number<std::uint32_t>("a number of levels");
    if (levels == 0 || levels > max_levels) {
        reader.refuse_at(
            reader.at() - 4, fmt::format("1 to {} levels", max_levels), std::to_string(levels));
    }
    for (std::uint32_t i = 0; i < levels; ++i) {
        const double min_m = i == 0 ? 0.0 : chain.levels.back().error_m;
        ChainLevel level;
        level.error_m = take_error_m(reader, min_m);
        if (i == 0 && level.error_m != 0.0) {
            reader.refuse_at(
                reader.at() - 8,
                "an error of 0 of the finest level",
                fmt::format("{}", level.error_m));
        }
        level.mesh = take_mesh(reader);
        chain.levels.push_back(std::move(level));
    }
    const auto has_polygons = reader.number<std::uint32_t>("0 or 1");
    if (has_polygons > 1) {
        reader.refuse_at(reader.at() - 4, "0 or 1", std::to_string(has_polygons));
    }
    if (has_polygons == 1) {
        chain.polygons_error_m = take_error_m(reader, 0.0);
        chain.polygons = take_model(reader);
    }
    if (reader.bytes_left() > 0) {
        reader.refuse("the end of the file", fmt::format("{} more bytes", reader.bytes_left()));
    }
    return chain;
}

void write_chain(const std::filesystem::path& path, const LevelChain& chain) {
    assert(!chain.levels.empty() && chain.levels.size() <= max_levels);
    std::string body;
    append_text(body, chain.name);
    append_number(body, static_cast<std::uint32_t>(chain.levels.size()));
    for (const ChainLevel& level : chain.levels) {
        append_number(body, level.error_m);
        append_mesh(body, level.mesh);
    }
    append_number(body, static_cast<std::uint32_t>(chain.polygons.has_value()));
    if (chain.polygons) {
        append_number(body, chain.polygons_error_m);
        append_model(body, *chain.polygons);
    }
    std::string bytes(magic);
    append_number(bytes, version);
    append_number(bytes, std::uint32_t{0});
    append_number(bytes, static_cast<std::uint64_t>(body.size()));
    append_number(bytes, checksum_of(body));
    write_file(path, bytes + body);
}

} // namespace octant::models::meshfile
