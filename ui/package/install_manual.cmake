# Runs while installing: manual pages and completions, which the programs print themselves, and the changes.
set(root "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
function(printed program form file)
  get_filename_component(folder "${file}" DIRECTORY)
  file(MAKE_DIRECTORY "${folder}")
  execute_process(COMMAND "${program}" manual ${form} OUTPUT_FILE "${file}" COMMAND_ERROR_IS_FATAL ANY)
  message(STATUS "Installing: ${file}")
endfunction()
function(compressed file)
  execute_process(COMMAND gzip -9nf "${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()
# A manual page of a program that prints none.
function(written name text)
  file(WRITE "${root}/share/man/man1/${name}.1" ".TH ${name} 1\n.SH NAME\n${name} \\- ${text}.SH SEE ALSO\n.BR octant (1)\n")
  compressed("${root}/share/man/man1/${name}.1")
endfunction()
foreach(name octant octant-study)
  printed(${octant_programs}/${name} man "${root}/share/man/man1/${name}.1")
  compressed("${root}/share/man/man1/${name}.1")
  printed(${octant_programs}/${name} bash "${root}/share/bash-completion/completions/${name}")
  printed(${octant_programs}/${name} zsh "${root}/share/zsh/vendor-completions/_${name}")
endforeach()
written(octant-verify [[
checks a certificate of a painting order with exact arithmetic
.SH SYNOPSIS
.B octant-verify
[\-\-json] [\-\-quiet]
.I FILE
.SH DESCRIPTION
Checks a certificate that
.B octant draw\-order \-\-certificate
wrote.
.SH EXIT STATUS
0: every pair of polygons is proved. 1: a statement is false, missing or not proved. 2: not a certificate.
]])
written(octant-read-mesh [[
reads mesh formats through other libraries for octant
.SH DESCRIPTION
.BR octant (1)
starts this program to read a mesh format through Assimp or OpenSceneGraph. If such a library crashes, only this
program ends.
]])
configure_file("${octant_changes}" "${root}/share/doc/octant/NEWS.md" COPYONLY)
compressed("${root}/share/doc/octant/NEWS.md")
configure_file("${octant_debian_changes}" "${root}/share/doc/octant/changelog" COPYONLY)
compressed("${root}/share/doc/octant/changelog")
