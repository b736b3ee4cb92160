# Runs while installing: what the program prints of itself, and the changes, where Debian has them.
set(root "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
function(printed form file)
  get_filename_component(folder "${file}" DIRECTORY)
  file(MAKE_DIRECTORY "${folder}")
  execute_process(COMMAND "${octant_program}" manual ${form} OUTPUT_FILE "${file}" RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "octant manual ${form}: ${result}")
  endif()
  message(STATUS "Installing: ${file}")
endfunction()
function(compressed file)
  execute_process(COMMAND gzip -9nf "${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()
printed(man "${root}/share/man/man1/octant.1")
compressed("${root}/share/man/man1/octant.1")
file(WRITE "${root}/share/man/man1/octant-read-mesh.1" [[
.TH OCTANT-READ-MESH 1
.SH NAME
octant-read-mesh \- reads meshes of other formats for octant
.SH DESCRIPTION
Is started by
.BR octant (1)
where a mesh is in a format that only other libraries read, so that what crashes them ends no flight.
Nobody else has a use for it.
.SH SEE ALSO
.BR octant (1)
]])
compressed("${root}/share/man/man1/octant-read-mesh.1")
printed(bash "${root}/share/bash-completion/completions/octant")
printed(zsh "${root}/share/zsh/vendor-completions/_octant")
configure_file("${octant_changes}" "${root}/share/doc/octant/NEWS.md" COPYONLY)
compressed("${root}/share/doc/octant/NEWS.md")
configure_file("${octant_debian_changes}" "${root}/share/doc/octant/changelog" COPYONLY)
compressed("${root}/share/doc/octant/changelog")
