#include "models/heights/gdal_session.h"

#include "sim/base/error.h"

#include <cpl_conv.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <mutex>
#include <ogr_srs_api.h>

namespace octant::models::heights {

namespace {

/// Only the drivers that read local rasters of heights or colours: no plug-in is searched for, and
/// none that follows references to other files or hosts is ever there.
void register_drivers() {
    GDALRegister_GTiff();
    GDALRegister_SRTMHGT();
    GDALRegister_USGSDEM();
    GDALRegister_PNG();
    GDALRegister_JPEG();
    GDALRegister_MEM();
    GDALRegister_PNM();
    GDALRegister_AAIGrid();
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
