# The library (component library) and what programs are built with (component development): headers, find_package(octant),
# pkg-config. All paths are relative to the prefix, which may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(octant_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/octant)
install(TARGETS octant_shared EXPORT octant-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/library/octant ${PROJECT_SOURCE_DIR}/sim/base/octant
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING PATTERN "*.h")
install(EXPORT octant-targets NAMESPACE octant:: FILE octant-config.cmake DESTINATION ${octant_package_folder}
  COMPONENT development)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/octant-config-version.cmake VERSION ${PROJECT_VERSION}
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octant-config-version.cmake DESTINATION ${octant_package_folder}
  COMPONENT development)
file(CONFIGURE OUTPUT octant.pc @ONLY CONTENT "prefix=\${pcfiledir}/../../..
Name: octant
Description: pictures of flight over terrain with their ground truth, drawn by the processor
Version: @PROJECT_VERSION@
Cflags: -I\${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
Libs: -L\${prefix}/@CMAKE_INSTALL_LIBDIR@ -loctant
")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octant.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
