# Writes OUTPUT, a C++ file that holds the text of each shader in FILES (a list) as a string. The
# names are declared in visuals/gl/shader_sources.h: ground.vert becomes ground_vert. A line
# '#include "NAME"' is replaced by the file of that name beside the shader, whose own guards
# (#ifndef) keep it from standing there twice. The resolved texts are also written into FOLDER under
# the shaders' own names, to be checked as the driver gets them.
cmake_minimum_required(VERSION 3.25)

function(read_resolved file result)
  get_filename_component(folder ${file} DIRECTORY)
  file(READ ${file} text)
  while(text MATCHES "#include \"([a-z_.]+)\"\n")
    file(READ ${folder}/${CMAKE_MATCH_1} included)
    string(REPLACE "#include \"${CMAKE_MATCH_1}\"\n" "${included}" text "${text}")
  endwhile()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(code "#include \"visuals/gl/shader_sources.h\"\n\nnamespace octant::visuals::gl {\n")
foreach(file ${FILES})
  get_filename_component(shader ${file} NAME)
  read_resolved(${file} text)
  file(WRITE ${FOLDER}/${shader} "${text}")
  string(REPLACE "." "_" name ${shader})
  string(APPEND code "\nconst char* const ${name} = R\"glsl(${text})glsl\";\n")
endforeach()
string(APPEND code "\n} // namespace octant::visuals::gl\n")
file(WRITE ${OUTPUT} "${code}")
