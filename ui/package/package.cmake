# Desktop file, pages, examples and the Debian packages (cpack in the build folder): octant (programs, data and the shared library),
# liboctant-dev, python3-octant. The programs print their manual pages and completions themselves.
include(GNUInstallDirs)
set(package ${CMAKE_CURRENT_LIST_DIR})
install(FILES ${package}/octant.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${package}/octant.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${package}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/octant)
execute_process(COMMAND gzip -9nc ${package}/changelog OUTPUT_FILE ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
foreach(part development:liboctant-dev python:python3-octant)
  string(REGEX MATCH "^(.*):(.*)$" part ${part})
  install(FILES ${package}/copyright ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CMAKE_MATCH_2} COMPONENT ${CMAKE_MATCH_1})
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/ui/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/octant)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/ui/schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/octant FILES_MATCHING PATTERN "*.json")
install(CODE "set(octant_programs \"$<TARGET_FILE_DIR:octant>\")
  set(octant_changes \"${PROJECT_SOURCE_DIR}/CHANGES.md\")
  set(octant_debian_changes \"${package}/changelog\")")
install(SCRIPT ${package}/install_manual.cmake)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME octant)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGE_VENDOR "Octant")
set(CPACK_PACKAGE_CONTACT "Octant's authors <octant@example.org>")
# The first line of a description is the summary.
set(CPACK_DEBIAN_OCTANT_DESCRIPTION "flight simulation over level-of-detail terrain, drawn and timed
Octant flies polygon aircraft along scripted paths, recorded tracks or by hand
over level-of-detail terrain, draws what a chase camera, the pilot or a control
tower sees, with or without a window and without a GPU, and records frame
timings with reports. Five papers on hidden surfaces, terrain, simplification,
refinement and shading run in it, as printed and improved.")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "pictures of flight with their ground truth - development files
Headers, CMake and pkg-config files of liboctant, for C++ programs that draw
pictures of flight over terrain with their ground truth, without a GPU.")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "pictures of flight with their ground truth - Python 3 package
Pictures of flight over terrain with depth, classes, objects, normals and
motion as NumPy arrays, flights frame by frame, recordings as tables, and
environments to learn in, without a GPU.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_OCTANT_PACKAGE_NAME octant)
set(CPACK_DEBIAN_OCTANT_PACKAGE_CONTROL_EXTRA ${package}/triggers)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liboctant-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "octant (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-octant)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "octant (= ${PROJECT_VERSION}), python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${package}/python/postinst;${package}/python/prerm")
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
  list(JOIN late_packages ", " CPACK_DEBIAN_OCTANT_PACKAGE_DEPENDS)
endif()
set(CPACK_DEBIAN_OCTANT_PACKAGE_RECOMMENDS "ffmpeg, libosmesa6")
set(CPACK_DEBIAN_OCTANT_PACKAGE_SUGGESTS "slurm-client, parallel")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
cpack_add_component_group(octant)
cpack_add_component_group(development)
cpack_add_component_group(python)
foreach(component programs data library)
  cpack_add_component(${component} GROUP octant)
endforeach()
cpack_add_component(development GROUP development)
cpack_add_component(python GROUP python)
