#include "models/heights/gdal_session.h"

#include "models/heights/gdal_functions.h"
#include "sim/base/error.h"

#include <array>
#include <fmt/format.h>
#include <mutex>

namespace octant::models::heights {

namespace {

/// All drivers but those that speak to other computers.
void register_drivers() {
    constexpr std::array<const char*, 14> remote = {
        "WMS",
        "WCS",
        "WMTS",
        "HTTP",
        "DAAS",
        "EEDA",
        "EEDAI",
        "PLMOSAIC",
        "PLSCENES",
        "NGW",
        "OGCAPI",
        "STACTA",
        "STACIT",
        "PostGISRaster"};
    GDALAllRegister();
    for (const char* const name : remote) {
        if (const GDALDriverH driver = GDALGetDriverByName(name)) {
            GDALDeregisterDriver(driver);
        }
    }
    OSRSetPROJEnableNetwork(0);
}

void erase_all(std::string& text, const std::string& piece) {
    for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at)) {
        text.erase(at, piece.size());
    }
}

void CPL_STDCALL hear(CPLErr severity, CPLErrorNum /*number*/, const char* text) {
    if (severity >= CE_Failure) {
        static_cast<GdalSession*>(CPLGetErrorHandlerUserData())->note_error(text);
    }
}

} // namespace

void error_unreadable(
    const std::filesystem::path& file, std::string_view expected, const std::string& got) {
    error_in(file, fmt::format("expected {} that GDAL can read, got {}", expected, got));
}

void CloseDataset::operator()(void* dataset) const {
    GDALClose(dataset);
}

GdalSession::GdalSession() {
    CPLPushErrorHandlerEx(&hear, this);
    static std::once_flag registered;
    std::call_once(registered, register_drivers);
    CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO");
}

GdalSession::~GdalSession() {
    CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr);
    CPLErrorReset();
    CPLPopErrorHandler();
}

void GdalSession::note_error(const char* text) {
    if (first_error_.empty()) {
        first_error_ = text;
    }
}

bool GdalSession::names_no_format() const {
    return first_error_.find("not recognized as") != std::string::npos;
}

std::string GdalSession::reason(const std::filesystem::path& path) const {
    std::string text = first_error_;
    for (const std::string& name : {path.string(), path.filename().string()}) {
        if (!name.empty()) {
            erase_all(text, name);
        }
    }
    const std::size_t start = text.find_first_not_of(" `'\",:;");
    text.erase(0, start);
    return text.empty() ? "no reason given" : printable(text);
}

} // namespace octant::models::heights
