#include "ui/report/zip_file.h"

#include "sim/base/error.h"
#include "sim/base/lazy_library.h"
#include "sim/base/output_file.h"

#include <algorithm>
#include <cassert>
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <unistd.h>
#include <utility>
#include <zlib.h>

namespace octant::ui::report {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t piece_bytes = std::size_t{1} << 20;

// What reads and writes zip files: few commands do, and the library takes long to load.
constinit LazyLibrary gdal_library(OCTANT_GDAL_FILE);

#define OCTANT_GDAL(name) const LazyFunction<decltype(::name)> name(gdal_library, #name)
OCTANT_GDAL(CPLCloseFileInZip);
OCTANT_GDAL(CPLCloseZip);
OCTANT_GDAL(CPLCreateFileInZip);
OCTANT_GDAL(CPLCreateZip);
OCTANT_GDAL(CPLErrorReset);
OCTANT_GDAL(CPLGetLastErrorType);
OCTANT_GDAL(CPLPopErrorHandler);
OCTANT_GDAL(CPLPushErrorHandler);
OCTANT_GDAL(CPLQuietErrorHandler);
OCTANT_GDAL(CPLWriteFileInZip);
OCTANT_GDAL(CSLDestroy);
OCTANT_GDAL(VSIFCloseL);
OCTANT_GDAL(VSIFOpenL);
OCTANT_GDAL(VSIFReadL);
OCTANT_GDAL(VSIReadDirRecursive);
OCTANT_GDAL(VSIStatL);
#undef OCTANT_GDAL

/// Keeps the library from printing what it finds wrong.
class SilencedGdal {
public:
    SilencedGdal() {
        CPLPushErrorHandler(CPLQuietErrorHandler);
        CPLErrorReset();
    }

    ~SilencedGdal() { CPLPopErrorHandler(); }

    SilencedGdal(const SilencedGdal&) = delete;
    SilencedGdal& operator=(const SilencedGdal&) = delete;
    SilencedGdal(SilencedGdal&&) = delete;
    SilencedGdal& operator=(SilencedGdal&&) = delete;
};

struct CloseFile {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

struct FreeList {
    void operator()(char** list) const { CSLDestroy(list); }
};

/// A zip file as the library's file functions name it.
std::string vsizip_path(const fs::path& zip, const std::string& name = {}) {
    return fmt::format("/vsizip/{{{}}}{}{}", fs::absolute(zip).string(), name.empty() ? "" : "/", name);
}

[[noreturn]] void is_no_zip(const fs::path& zip) {
    throw_error_in(zip, "expected a zip file, got something else or a part of it");
}

} // namespace

ZipWriter::ZipWriter(fs::path file)
    : file_(std::move(file)), part_(fmt::format("{}.{}.part", file_.string(), ::getpid())) {
    check_can_write(file_);
    const SilencedGdal quiet;
    zip_ = CPLCreateZip(part_.c_str(), nullptr);
    if (zip_ == nullptr) { throw_error_in(file_, "cannot be written"); }
}

ZipWriter::~ZipWriter() {
    if (zip_ != nullptr) {
        const SilencedGdal quiet;
        CPLCloseZip(zip_);
    }
    std::error_code ignored;
    fs::remove(part_, ignored);
}

void ZipWriter::begin_entry(const std::string& name) {
    const SilencedGdal quiet;
    if (CPLCreateFileInZip(zip_, name.c_str(), nullptr) != CE_None) { throw_error_in(file_, "cannot be written"); }
}

void ZipWriter::write(std::string_view bytes) {
    const SilencedGdal quiet;
    for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), piece_bytes))) {
        const auto size = static_cast<int>(std::min(bytes.size(), piece_bytes));
        if (CPLWriteFileInZip(zip_, bytes.data(), size) != CE_None) {
            throw_error_in(file_, "cannot be written: is the disk full?");
        }
    }
}

void ZipWriter::end_entry() {
    const SilencedGdal quiet;
    if (CPLCloseFileInZip(zip_) != CE_None) { throw_error_in(file_, "cannot be written: is the disk full?"); }
}

void ZipWriter::add(const std::string& name, std::string_view bytes) {
    begin_entry(name);
    write(bytes);
    end_entry();
}

void ZipWriter::add_file(const std::string& name, const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) { throw_error_in(file, "expected a file that can be read, got none"); }
    begin_entry(name);
    std::string piece(piece_bytes, '\0');
    while (in) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        write(std::string_view(piece).substr(0, static_cast<std::size_t>(in.gcount())));
    }
    end_entry();
}

void ZipWriter::finish() {
    const SilencedGdal quiet;
    if (CPLCloseZip(std::exchange(zip_, nullptr)) != CE_None) {
        throw_error_in(file_, "cannot be written: is the disk full?");
    }
    std::error_code code;
    fs::rename(part_, file_, code);
    if (code) { throw_error_in(file_, fmt::format("cannot be written: {}", code.message())); }
}

std::vector<ZipEntry> zip_entries(const fs::path& zip) {
    const SilencedGdal quiet;
    const std::unique_ptr<char*, FreeList> names(VSIReadDirRecursive(vsizip_path(zip).c_str()));
    if (!names) { is_no_zip(zip); }
    std::vector<ZipEntry> entries;
    for (char** name = names.get(); *name != nullptr; ++name) {
        if (std::string_view(*name).ends_with('/')) { continue; }
        VSIStatBufL status{};
        if (VSIStatL(vsizip_path(zip, *name).c_str(), &status) != 0) { is_no_zip(zip); }
        entries.push_back({*name, static_cast<std::uint64_t>(status.st_size)});
    }
    std::ranges::sort(entries, {}, &ZipEntry::name);
    return entries;
}

namespace {

/// Gives a file of a zip file to take() in pieces. Throws Error.
template <class Take>
void read_entry(const fs::path& zip, const std::string& name, Take&& take) {
    const SilencedGdal quiet;
    const std::unique_ptr<VSILFILE, CloseFile> in(VSIFOpenL(vsizip_path(zip, name).c_str(), "rb"));
    if (!in) { is_no_zip(zip); }
    std::string piece(piece_bytes, '\0');
    std::uint64_t taken = 0;
    for (;;) {
        const std::size_t read = VSIFReadL(piece.data(), 1, piece.size(), in.get());
        take(std::string_view(piece).substr(0, read));
        taken += read;
        if (read < piece.size()) { break; }
    }
    VSIStatBufL status{};
    const bool whole =
        VSIStatL(vsizip_path(zip, name).c_str(), &status) == 0 && static_cast<std::uint64_t>(status.st_size) == taken;
    if (!whole || CPLGetLastErrorType() >= CE_Failure) {
        throw_error_in(zip, fmt::format("expected '{}' whole, got damaged bytes", printable(name)));
    }
}

} // namespace

void extract(const fs::path& zip, const std::string& name, const fs::path& out) {
    AppendedFile file(out);
    read_entry(zip, name, [&file](std::string_view piece) {
        file.append(piece);
        file.flush();
    });
}

std::string zip_text(const fs::path& zip, const std::string& name, std::size_t largest_bytes) {
    std::string text;
    read_entry(zip, name, [&](std::string_view piece) {
        text += piece;
        if (text.size() > largest_bytes) {
            throw_error_in(zip, fmt::format("expected at most {} bytes in '{}'", largest_bytes, printable(name)));
        }
    });
    return text;
}

namespace {

/// The lowest bytes of a number, least first, as zip files have all of theirs.
void append_number(std::string& out, std::uint64_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) { out += static_cast<char>(number >> (8 * i) & 0xffU); }
}

/// Raw deflate data at the quickest level; the same for the same bytes.
std::string deflated(std::string_view bytes) {
    z_stream stream{};
    constexpr int raw_window_bits = -15;
    constexpr int memory_level = 8;
    if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, raw_window_bits, memory_level, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw std::bad_alloc();
    }
    std::string out(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data())); // zlib does not write there
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    [[maybe_unused]] const int ended = deflate(&stream, Z_FINISH);
    assert(ended == Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

} // namespace

std::string zip_bytes(std::span<const ZipContent> entries) {
    std::string file;
    std::string directory;
    for (const ZipContent& entry : entries) {
        const std::string data = deflated(entry.bytes);
        std::string common; // of the entry's own header and of its row in the directory
        constexpr std::uint64_t version = 20;
        constexpr std::uint64_t no_time = 0x00210000; // the first day that dates can name
        append_number(common, version, 2);
        append_number(common, 0, 2);
        append_number(common, Z_DEFLATED, 2);
        append_number(common, no_time, 4);
        append_number(common,
            crc32(0, reinterpret_cast<const Bytef*>(entry.bytes.data()), static_cast<uInt>(entry.bytes.size())), 4);
        append_number(common, data.size(), 4);
        append_number(common, entry.bytes.size(), 4);
        append_number(common, entry.name.size(), 2);
        append_number(common, 0, 2);
        directory += "PK\x01\x02";
        append_number(directory, version, 2);
        directory += common;
        append_number(directory, 0, 10); // no comment, first disk, no attributes
        append_number(directory, file.size(), 4);
        directory += entry.name;
        file += "PK\x03\x04" + common + entry.name + data;
    }
    assert(file.size() + directory.size() < std::numeric_limits<std::uint32_t>::max());
    std::string end = "PK\x05\x06";
    append_number(end, 0, 4);
    append_number(end, entries.size(), 2);
    append_number(end, entries.size(), 2);
    append_number(end, directory.size(), 4);
    append_number(end, file.size(), 4);
    append_number(end, 0, 2);
    return file + directory + end;
}

} // namespace octant::ui::report
