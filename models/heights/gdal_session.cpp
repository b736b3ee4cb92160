#include "models/heights/gdal_session.h"

#include "models/heights/gdal_functions.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <fmt/format.h>
#include <mutex>
#include <new>

namespace octant::models::heights {

constinit LazyLibrary gdal_library(OCTANT_GDAL_FILE);

namespace {

void add_text(std::vector<std::string>& texts, const char* text) {
    const std::string line = one_line(text);
    if (texts.size() < GdalSession::max_warnings && std::ranges::find(texts, line) == texts.end()) {
        texts.push_back(line);
    }
}

/// Silences threads without a session.
void CPL_STDCALL hear_nothing(CPLErr /*severity*/, CPLErrorNum /*number*/, const char* /*text*/) {}

/// All drivers but those that speak to other computers.
void register_drivers() {
    constexpr std::array<const char*, 14> remote = {"WMS", "WCS", "WMTS", "HTTP", "DAAS", "EEDA", "EEDAI", "PLMOSAIC",
        "PLSCENES", "NGW", "OGCAPI", "STACTA", "STACIT", "PostGISRaster"};
    CPLSetErrorHandlerEx(&hear_nothing, nullptr);
    GDALAllRegister();
    for (const char* const name : remote) {
        if (const GDALDriverH driver = GDALGetDriverByName(name)) { GDALDeregisterDriver(driver); }
    }
    OSRSetPROJEnableNetwork(0);
}

/// Stops HDF5, which netCDF is built on, from printing each error that its callers provoke and handle. HDF5 holds this
/// setting per thread. Does nothing in a GDAL without HDF5.
void silence_hdf5() {
    thread_local bool is_silent = false;
    if (is_silent) { return; }
    is_silent = true;
    constexpr std::int64_t default_stack = 0;
    using SetAuto = int(std::int64_t stack, void* function, void* data);
    if (void* const set_auto = gdal_library.find("H5Eset_auto2")) {
        reinterpret_cast<SetAuto*>(set_auto)(default_stack, nullptr, nullptr);
    }
}

void erase_all(std::string& text, const std::string& piece) {
    for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at)) {
        text.erase(at, piece.size());
    }
}

void CPL_STDCALL hear(CPLErr severity, CPLErrorNum /*number*/, const char* text) {
    auto& session = *static_cast<GdalSession*>(CPLGetErrorHandlerUserData());
    if (severity >= CE_Failure) {
        session.note_error(text);
    } else if (severity == CE_Warning) {
        session.note_warning(text);
    }
}

} // namespace

void throw_unreadable(const std::filesystem::path& file, std::string_view expected, const std::string& got) {
    throw_error_in(file, fmt::format("expected {} that GDAL can read, got {}", expected, got));
}

void check_size(const std::filesystem::path& file, double columns, double rows, int max) {
    const auto fits = [max](double n) { return n >= 2.0 && n <= max; };
    if (!fits(columns) || !fits(rows)) {
        throw_error_in(
            file, fmt::format("expected 2 x 2 to {0} x {0} samples, got {1:.0f} x {2:.0f}", max, columns, rows));
    }
}

void DatasetDeleter::operator()(void* dataset) const { GDALClose(dataset); }

MemoryFile::MemoryFile(std::string_view name, std::string_view bytes) {
    static std::atomic<int> count = 0;
    path_ = fmt::format("/vsimem/octant-{}/{}", count++, name);
    if (bytes.empty()) { return; }
    auto* const data = reinterpret_cast<GByte*>(const_cast<char*>(bytes.data())); // only read
    VSILFILE* const file = VSIFileFromMemBuffer(path_.c_str(), data, bytes.size(), FALSE);
    if (file == nullptr) { throw std::bad_alloc(); }
    VSIFCloseL(file);
}

MemoryFile::~MemoryFile() { VSIUnlink(path_.c_str()); }

std::string_view MemoryFile::bytes() const {
    vsi_l_offset size = 0;
    const GByte* data = VSIGetMemFileBuffer(path_.c_str(), &size, FALSE);
    return {reinterpret_cast<const char*>(data), data == nullptr ? 0 : size};
}

GdalSession::GdalSession() {
    CPLPushErrorHandlerEx(&hear, this);
    CPLSetThreadLocalConfigOption("GDAL_NUM_THREADS", "1");
    static std::once_flag registered;
    std::call_once(registered, register_drivers);
    silence_hdf5();
}

GdalSession::~GdalSession() {
    CPLErrorReset();
    CPLPopErrorHandler();
}

void GdalSession::note_error(const char* text) {
    if (first_error_.empty()) { first_error_ = text; }
}

void GdalSession::note_warning(const char* text) { add_text(warnings_, text); }

bool GdalSession::is_unknown_format() const { return first_error_.find("not recognized as") != std::string::npos; }

std::string GdalSession::reason(const std::filesystem::path& path) const {
    std::string text = first_error_;
    for (const std::string& name : {path.string(), path.filename().string()}) {
        if (!name.empty()) { erase_all(text, name); }
    }
    const std::size_t start = text.find_first_not_of(" `'\",:;");
    text.erase(0, start);
    return text.empty() ? "no reason given" : printable(text);
}

} // namespace octant::models::heights
