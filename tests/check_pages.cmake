# Fails when the page of a room does not name one of its files: a file that no page knows is one that
# a reader cannot place. X.h and X.cpp are named together, as the word X; `*_x` and `x_*` in the
# page's code stand for all that end or begin so. A README.md speaks of the files beside it.
cmake_minimum_required(VERSION 3.25)

file(GLOB_RECURSE pages RELATIVE ${ROOT} ${ROOT}/sim/README.md ${ROOT}/flightpaths/README.md ${ROOT}/models/README.md
  ${ROOT}/visuals/README.md ${ROOT}/ui/README.md)
foreach(page ${pages})
  get_filename_component(room ${page} DIRECTORY)
  file(READ ${ROOT}/${page} text)
  string(REGEX MATCHALL "[a-z0-9_*-]+" words "${text}")
  list(REMOVE_DUPLICATES words)
  set(patterns ${words})
  list(FILTER patterns INCLUDE REGEX "^([*]_[a-z_]+|[a-z_]+_[*])$")
  list(TRANSFORM patterns REPLACE "[*]" ".*")
  list(JOIN patterns "|" patterns)
  file(GLOB files RELATIVE ${ROOT}/${room} ${ROOT}/${room}/*.h ${ROOT}/${room}/*.cpp)
  list(TRANSFORM files REPLACE "[.](h|cpp)$" "")
  list(REMOVE_DUPLICATES files)
  foreach(name ${files})
    if(NOT name IN_LIST words AND NOT (patterns AND name MATCHES "^(${patterns})$"))
      message(SEND_ERROR "${page}: expected a word on ${name}, found none")
    endif()
  endforeach()
endforeach()
