# cmake -DFILES=<program;modules> -DLIBRARIES=<folder> -P bundled_libraries.cmake
# Copies the shared libraries that FILES need into LIBRARIES, with their licences, and sets the search path of FILES and
# libraries to that folder. Parts of the C library are not copied, since they must be the system's. Needs patchelf.
cmake_minimum_required(VERSION 3.25)
find_program(PATCHELF patchelf REQUIRED)
find_program(DPKG dpkg-query)

# Debian's licences of the packages that libraries come from. One search for all: each takes a second.
function(copy_licences)
  if(NOT DPKG)
    return()
  endif()
  execute_process(COMMAND ${DPKG} --search ${ARGN} OUTPUT_VARIABLE owners ERROR_QUIET)
  string(REGEX MATCHALL "[^\n]+" owners "${owners}")
  foreach(owner IN LISTS owners)
    string(REGEX REPLACE "[:,].*" "" package ${owner})
    if(EXISTS /usr/share/doc/${package}/copyright)
      file(COPY_FILE /usr/share/doc/${package}/copyright ${LIBRARIES}/licences/${package} ONLY_IF_DIFFERENT)
    endif()
  endforeach()
endfunction()

function(let_find file folder)
  cmake_path(GET file PARENT_PATH place)
  file(RELATIVE_PATH way ${place} ${folder})
  # The loader also searches an RPATH for libraries that a library needs; a RUNPATH it would not.
  execute_process(COMMAND ${PATCHELF} --force-rpath --set-rpath "$ORIGIN/${way}" ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(MAKE_DIRECTORY ${LIBRARIES}/licences)
file(GET_RUNTIME_DEPENDENCIES MODULES ${FILES} RESOLVED_DEPENDENCIES_VAR needed
     PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|pthread|rt|resolv|util)\\.so")
foreach(library IN LISTS needed)
  cmake_path(GET library FILENAME name)
  file(REAL_PATH ${library} real)
  file(COPY_FILE ${real} ${LIBRARIES}/${name} ONLY_IF_DIFFERENT)
  file(CHMOD ${LIBRARIES}/${name} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  let_find(${LIBRARIES}/${name} ${LIBRARIES})
  list(APPEND originals ${real})
endforeach()
copy_licences(${originals})
foreach(file IN LISTS FILES)
  let_find(${file} ${LIBRARIES})
endforeach()
