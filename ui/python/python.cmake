# The Python package octant in build/<preset>/python: the extension module _octant on liboctant, and the files of the folder octant.
# Debian's own Python is taken where there is one, because its modules are Debian packages, too.
if(EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the module octant is for")
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
set(PYBIND11_NOPYTHON ON)
find_package(pybind11 2.10 REQUIRED)

set(octant_python ${PROJECT_BINARY_DIR}/python)
file(GLOB octant_python_files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/python/octant/*.py
  ${CMAKE_CURRENT_SOURCE_DIR}/python/octant/*.pyi ${CMAKE_CURRENT_SOURCE_DIR}/python/octant/py.typed)
foreach(file ${octant_python_files})
  get_filename_component(name ${file} NAME)
  configure_file(${file} ${octant_python}/octant/${name} COPYONLY)
endforeach()

file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/python/*.cpp)
Python3_add_library(octant_python MODULE WITH_SOABI ${sources})
target_link_libraries(octant_python PRIVATE octant::octant octant_flags pybind11::headers)
target_include_directories(octant_python PRIVATE ${PROJECT_SOURCE_DIR})
set_target_properties(octant_python PROPERTIES OUTPUT_NAME _octant LIBRARY_OUTPUT_DIRECTORY ${octant_python}/octant
  CXX_VISIBILITY_PRESET hidden UNITY_BUILD OFF)

# Debian's packages of Python modules for all versions of Python 3.
set(octant_python_folder lib/python3/dist-packages/octant)
install(TARGETS octant_python LIBRARY DESTINATION ${octant_python_folder} COMPONENT python)
install(FILES ${octant_python_files} DESTINATION ${octant_python_folder} COMPONENT python)
