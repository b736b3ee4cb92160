# Fails when a README.md of a module is not linked by a README.md above it or by CONTRIBUTING.md, and when a page names a source file
# (`x.h`, `folder/x.cpp`), a function (`name()`, `two_words`) or a type (`TwoWords`) that the sources do not have.
cmake_minimum_required(VERSION 3.25)

execute_process(
  COMMAND grep -rhoE "[A-Za-z_][A-Za-z0-9_]*" --include=*.h --include=*.cpp sim flightpaths models visuals ui tests
  COMMAND sort -u OUTPUT_VARIABLE sources WORKING_DIRECTORY ${ROOT} COMMAND_ERROR_IS_FATAL ANY)

execute_process(
  COMMAND find sim flightpaths models visuals ui tests -name "*.h" -o -name "*.cpp"
  OUTPUT_VARIABLE files WORKING_DIRECTORY ${ROOT} COMMAND_ERROR_IS_FATAL ANY)

file(GLOB_RECURSE pages RELATIVE ${ROOT} ${ROOT}/sim/README.md ${ROOT}/flightpaths/README.md ${ROOT}/models/README.md
  ${ROOT}/visuals/README.md ${ROOT}/ui/README.md ${ROOT}/tests/README.md ${ROOT}/CONTRIBUTING.md)
foreach(page ${pages})
  get_filename_component(module ${page} DIRECTORY)
  set(above ${module})
  set(linked FALSE)
  while(above AND NOT linked)
    get_filename_component(above "${above}" DIRECTORY)
    string(REGEX REPLACE "^${above}/" "" way ${page})
    foreach(leading README.md CONTRIBUTING.md)
      if(EXISTS ${ROOT}/${above}/${leading})
        file(READ ${ROOT}/${above}/${leading} text)
        string(FIND "${text}" "(${way})" place)
        if(place GREATER_EQUAL 0)
          set(linked TRUE)
        endif()
      endif()
    endforeach()
  endwhile()
  if(NOT linked AND module)
    message(SEND_ERROR "${page}: expected a link to it in a README.md above or in CONTRIBUTING.md, found none")
  endif()
  file(READ ${ROOT}/${page} text)
  string(REGEX MATCHALL "`[a-zA-Z_:]+[(][)]`|`[A-Z][a-z0-9]+[A-Z][A-Za-z0-9]*`|`[a-z0-9]+_[a-z0-9_]+`" names "${text}")
  list(REMOVE_DUPLICATES names)
  foreach(name ${names})
    string(REGEX REPLACE "`|[(][)]" "" word ${name})
    string(REGEX REPLACE "^.*::" "" word ${word})
    string(FIND "${sources}" "\n${word}\n" place)
    string(FIND "${files}" "/${word}." file)
    if(place LESS 0 AND file LESS 0)
      message(SEND_ERROR "${page}: expected a name of the sources, got ${name}")
    endif()
  endforeach()
  string(REGEX MATCHALL "`[a-z0-9_/-]+[.](h|cpp)`" names "${text}")
  foreach(name ${names})
    string(REPLACE "`" "" file ${name})
    string(FIND "${files}" "/${file}\n" place) # without its folder, or with all of its path
    if(place LESS 0 AND NOT EXISTS ${ROOT}/${file})
      message(SEND_ERROR "${page}: expected a file of the sources, got ${name}")
    endif()
  endforeach()
endforeach()
