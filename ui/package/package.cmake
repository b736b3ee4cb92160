# Desktop file, pages, examples and the Debian package (cpack in the build folder). The programs print their manual pages
# and completions themselves.
include(GNUInstallDirs)
set(package ${CMAKE_CURRENT_LIST_DIR})
install(FILES ${package}/octant.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${package}/octant.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${package}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/octant)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/ui/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/octant)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/ui/schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/octant FILES_MATCHING PATTERN "*.json")
install(CODE "set(octant_programs \"$<TARGET_FILE_DIR:octant>\")
  set(octant_changes \"${PROJECT_SOURCE_DIR}/CHANGES.md\")
  set(octant_debian_changes \"${package}/changelog\")")
install(SCRIPT ${package}/install_manual.cmake)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME octant)
set(CPACK_PACKAGE_VENDOR "Octant")
set(CPACK_PACKAGE_CONTACT "Octant's authors <octant@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "flight simulation over level-of-detail terrain, drawn and timed")
set(CPACK_PACKAGE_DESCRIPTION
  "Octant flies polygon aircraft along scripted paths, recorded tracks or by hand
over level-of-detail terrain, draws what a chase camera, the pilot or a control
tower sees, with or without a window and without a GPU, and records frame
timings with reports. Five papers on hidden surfaces, terrain, simplification,
refinement and shading run in it, as printed and improved.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# GDAL and cairo are opened by name: dpkg-shlibdeps does not see them.
find_program(dpkg_query dpkg-query)
if(dpkg_query)
  get_target_property(gdal_library GDAL::GDAL IMPORTED_LOCATION)
  set(late_packages)
  foreach(library ${gdal_library} ${pkgcfg_lib_CAIRO_cairo})
    get_filename_component(library ${library} REALPATH)
    execute_process(COMMAND ${dpkg_query} -S ${library} OUTPUT_VARIABLE owner ERROR_QUIET)
    string(REGEX MATCH "^[^:, \n]+" owner "${owner}")
    list(APPEND late_packages ${owner})
  endforeach()
  list(JOIN late_packages ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
endif()
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "slurm-client, parallel")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
