# Writes OUT, a header with the program's version and commit, anew when they changed.
execute_process(
  COMMAND git describe --always --dirty=+ --abbrev=12 --exclude=*
  WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT
  "#define OCTANT_VERSION \"${VERSION}\"\n#define OCTANT_COMMIT \"${commit}\"\n" @ONLY)
