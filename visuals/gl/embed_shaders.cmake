# Writes OUTPUT, a C++ file that holds the text of each shader in FILES (a list) as a string. The
# names are declared in visuals/gl/shader_sources.h: ground.vert becomes ground_vert.
cmake_minimum_required(VERSION 3.25)
set(code "#include \"visuals/gl/shader_sources.h\"\n\nnamespace octant::visuals::gl {\n")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  string(REPLACE "." "_" name ${name})
  file(READ ${file} text)
  string(APPEND code "\nconst char* const ${name} = R\"glsl(${text})glsl\";\n")
endforeach()
string(APPEND code "\n} // namespace octant::visuals::gl\n")
file(WRITE ${OUTPUT} "${code}")
