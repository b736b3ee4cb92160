#pragma once

#include "sim/base/lazy_library.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <gdal_alg.h>
#include <gdalwarper.h>
#include <ogr_srs_api.h>

// The functions of GDAL that this module calls. The first call opens the library, because GDAL and its dependencies
// take longer to load than the rest of the program. A new function needs one line here. Only .cpp files of this module
// include this header.
namespace octant::models::heights {

extern constinit LazyLibrary gdal_library; // gdal_session.cpp

#define OCTANT_GDAL(name) inline const LazyFunction<decltype(::name)> name(gdal_library, #name)
OCTANT_GDAL(CPLErrorReset);
OCTANT_GDAL(CPLEscapeString);
OCTANT_GDAL(CPLGetErrorHandlerUserData);
OCTANT_GDAL(CPLMalloc);
OCTANT_GDAL(CPLPopErrorHandler);
OCTANT_GDAL(CPLPushErrorHandlerEx);
OCTANT_GDAL(CPLSetErrorHandlerEx);
OCTANT_GDAL(CPLSetThreadLocalConfigOption);
OCTANT_GDAL(CSLCount);
OCTANT_GDAL(CSLDestroy);
OCTANT_GDAL(CSLFetchNameValue);
OCTANT_GDAL(CSLSetNameValue);
OCTANT_GDAL(GDALAddBand);
OCTANT_GDAL(GDALAllRegister);
OCTANT_GDAL(GDALApproxTransform);
OCTANT_GDAL(GDALAutoCreateWarpedVRT);
OCTANT_GDAL(GDALChunkAndWarpImage);
OCTANT_GDAL(GDALClose);
OCTANT_GDAL(GDALCreate);
OCTANT_GDAL(GDALCreateApproxTransformer);
OCTANT_GDAL(GDALCreateGenImgProjTransformer);
OCTANT_GDAL(GDALCreateWarpOperation);
OCTANT_GDAL(GDALCreateWarpOptions);
OCTANT_GDAL(GDALDataTypeIsComplex);
OCTANT_GDAL(GDALDeregisterDriver);
OCTANT_GDAL(GDALDestroyTransformer);
OCTANT_GDAL(GDALDestroyWarpOperation);
OCTANT_GDAL(GDALDestroyWarpOptions);
OCTANT_GDAL(GDALFlushCache);
OCTANT_GDAL(GDALGenImgProjTransform);
OCTANT_GDAL(GDALGetBlockSize);
OCTANT_GDAL(GDALGetColorEntryAsRGB);
OCTANT_GDAL(GDALGetColorEntryCount);
OCTANT_GDAL(GDALGetDataTypeName);
OCTANT_GDAL(GDALGetDataTypeSizeBytes);
OCTANT_GDAL(GDALGetDatasetDriver);
OCTANT_GDAL(GDALGetDescription);
OCTANT_GDAL(GDALGetDriverByName);
OCTANT_GDAL(GDALGetDriverShortName);
OCTANT_GDAL(GDALGetFileList);
OCTANT_GDAL(GDALGetGCPCount);
OCTANT_GDAL(GDALGetGCPProjection);
OCTANT_GDAL(GDALGetGeoTransform);
OCTANT_GDAL(GDALGetMaskBand);
OCTANT_GDAL(GDALGetMaskFlags);
OCTANT_GDAL(GDALGetMetadata);
OCTANT_GDAL(GDALGetMetadataItem);
OCTANT_GDAL(GDALGetRasterBand);
OCTANT_GDAL(GDALGetRasterBandXSize);
OCTANT_GDAL(GDALGetRasterBandYSize);
OCTANT_GDAL(GDALGetRasterColorInterpretation);
OCTANT_GDAL(GDALGetRasterColorTable);
OCTANT_GDAL(GDALGetRasterCount);
OCTANT_GDAL(GDALGetRasterDataType);
OCTANT_GDAL(GDALGetRasterNoDataValue);
OCTANT_GDAL(GDALGetRasterNoDataValueAsInt64);
OCTANT_GDAL(GDALGetRasterNoDataValueAsUInt64);
OCTANT_GDAL(GDALGetRasterOffset);
OCTANT_GDAL(GDALGetRasterScale);
OCTANT_GDAL(GDALGetRasterUnitType);
OCTANT_GDAL(GDALGetRasterXSize);
OCTANT_GDAL(GDALGetRasterYSize);
OCTANT_GDAL(GDALGetSpatialRef);
OCTANT_GDAL(GDALIdentifyDriverEx);
OCTANT_GDAL(GDALOpenEx);
OCTANT_GDAL(GDALRasterIO);
OCTANT_GDAL(GDALRasterIOEx);
OCTANT_GDAL(GDALSetGeoTransform);
OCTANT_GDAL(GDALSetProjection);
OCTANT_GDAL(GDALSetRasterNoDataValue);
OCTANT_GDAL(GDALSetRasterUnitType);
OCTANT_GDAL(GDALSetSpatialRef);
OCTANT_GDAL(GDALSuggestedWarpOutput);
OCTANT_GDAL(OCTDestroyCoordinateTransformation);
OCTANT_GDAL(OCTNewCoordinateTransformation);
OCTANT_GDAL(OCTTransformEx);
OCTANT_GDAL(OSRClone);
OCTANT_GDAL(OSRExportToWkt);
OCTANT_GDAL(OSRGetAttrValue);
OCTANT_GDAL(OSRGetAxesCount);
OCTANT_GDAL(OSRGetLinearUnits);
OCTANT_GDAL(OSRGetName);
OCTANT_GDAL(OSRGetSemiMajor);
OCTANT_GDAL(OSRGetTargetLinearUnits);
OCTANT_GDAL(OSRIsGeographic);
OCTANT_GDAL(OSRIsLocal);
OCTANT_GDAL(OSRIsProjected);
OCTANT_GDAL(OSRIsSame);
OCTANT_GDAL(OSRNewSpatialReference);
OCTANT_GDAL(OSRRelease);
OCTANT_GDAL(OSRSetAxisMappingStrategy);
OCTANT_GDAL(OSRSetFromUserInput);
OCTANT_GDAL(OSRSetLinearUnits);
OCTANT_GDAL(OSRSetLocalCS);
OCTANT_GDAL(OSRSetPROJEnableNetwork);
OCTANT_GDAL(VSIFCloseL);
OCTANT_GDAL(VSIFOpenL);
OCTANT_GDAL(VSIFReadL);
OCTANT_GDAL(VSIFileFromMemBuffer);
OCTANT_GDAL(VSIFree);
OCTANT_GDAL(VSIGetMemFileBuffer);
OCTANT_GDAL(VSIReadDirRecursive);
OCTANT_GDAL(VSIStatL);
OCTANT_GDAL(VSIUnlink);
#undef OCTANT_GDAL

} // namespace octant::models::heights
