# cmake -DFILES=<program;modules> -DLIBRARIES=<folder> -P bundled_libraries.cmake
# Copies the shared libraries that FILES need into LIBRARIES, with their licences, and sets the search path of FILES and
# libraries to that folder. Parts of the C library are not copied, since they must be the system's. Needs patchelf.
cmake_minimum_required(VERSION 3.25)
find_program(PATCHELF patchelf REQUIRED)
find_program(DPKG dpkg-query)

# Debian's licence of the package that a library comes from.
function(copy_licence library)
  if(NOT DPKG)
    return()
  endif()
  execute_process(COMMAND ${DPKG} --search ${library} OUTPUT_VARIABLE owner ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT owner MATCHES "^([^:,]+)")
    return()
  endif()
  set(package ${CMAKE_MATCH_1})
  if(EXISTS /usr/share/doc/${package}/copyright)
    file(COPY_FILE /usr/share/doc/${package}/copyright ${LIBRARIES}/licences/${package} ONLY_IF_DIFFERENT)
  endif()
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
  copy_licence(${real})
endforeach()
foreach(file IN LISTS FILES)
  let_find(${file} ${LIBRARIES})
endforeach()
