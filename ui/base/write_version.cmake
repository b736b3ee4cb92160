# Writes OUT, a header with the program's version and commit, anew when they changed. Sources without a .git folder are named by a
# checksum of their contents, after the commit that `git archive` wrote into archive_commit.txt, where it did.
if(EXISTS ${ROOT}/.git)
  execute_process(
    COMMAND git describe --always --dirty=+ --abbrev=12 --exclude=*
    WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT commit)
  file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/sim/* ${ROOT}/flightpaths/* ${ROOT}/models/* ${ROOT}/visuals/* ${ROOT}/ui/*)
  list(FILTER sources EXCLUDE REGEX "README\\.md$|archive_commit\\.txt$")
  foreach(source CMakeLists.txt ${sources})
    file(SHA256 ${ROOT}/${source} checksum)
    string(APPEND checksums "${source} ${checksum}\n")
  endforeach()
  string(SHA256 checksum "${checksums}")
  string(SUBSTRING ${checksum} 0 12 checksum)
  file(STRINGS ${ROOT}/ui/base/archive_commit.txt archived REGEX "^[0-9a-f]+$")
  if(archived)
    string(SUBSTRING ${archived} 0 12 commit)
    string(APPEND commit "-${checksum}")
  else()
    set(commit sources-${checksum})
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT
  "#define OCTANT_VERSION \"${VERSION}\"\n#define OCTANT_COMMIT \"${commit}\"\n" @ONLY)
