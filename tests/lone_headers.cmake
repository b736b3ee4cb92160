# Headers that no .cpp of the project includes first are compiled alone, each by a file that holds
# nothing else. The common headers are there already: that every header names those that it uses is
# what check_headers.cmake sees to.
file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/sim/*.cpp ${PROJECT_SOURCE_DIR}/flightpaths/*.cpp
  ${PROJECT_SOURCE_DIR}/models/*.cpp ${PROJECT_SOURCE_DIR}/visuals/*.cpp ${PROJECT_SOURCE_DIR}/ui/*.cpp
  ${PROJECT_SOURCE_DIR}/tests/*.cpp)
# The first header that a source includes stands alone there, and so does the first that this one
# includes, and so on.
set(included_first "")
foreach(source ${sources})
  set(header ${source})
  while(header)
    file(STRINGS ${header} line REGEX "^#include" LIMIT_COUNT 1)
    string(REGEX REPLACE "^#include [<\"]([^>\"]+)[>\"].*" "\\1" name "${line}")
    set(header "")
    if(name AND NOT name IN_LIST included_first AND EXISTS ${PROJECT_SOURCE_DIR}/${name})
      list(APPEND included_first ${name})
      set(header ${PROJECT_SOURCE_DIR}/${name})
    endif()
  endwhile()
endforeach()

get_property(modules GLOBAL PROPERTY octant_modules)
set(lone "")
foreach(module ${modules})
  file(GLOB headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${module}/*.h)
  list(FILTER headers EXCLUDE REGEX "-inl\\.h$") # parts of a source that is compiled several times
  foreach(header ${headers})
    if(NOT header IN_LIST included_first)
      string(REPLACE "/" "_" name ${header})
      file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/lone_headers/${name}.cpp CONTENT "#include \"${header}\"\n")
      list(APPEND lone ${PROJECT_BINARY_DIR}/lone_headers/${name}.cpp)
    endif()
  endforeach()
endforeach()
add_library(octant_lone_headers OBJECT EXCLUDE_FROM_ALL ${lone})
octant_targets(libraries ${modules})
target_link_libraries(octant_lone_headers PRIVATE octant_flags octant_late_gdal ${libraries})
target_precompile_headers(octant_lone_headers REUSE_FROM octant_common_headers)
set_target_properties(octant_lone_headers PROPERTIES UNITY_BUILD OFF)
