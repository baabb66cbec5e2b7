# The target "portable" makes packages/fusee-VERSION-linux-PROCESSOR.tar.xz in the build folder: a folder that runs where
# it is unpacked. It holds the program, its modules, and the libraries that they need. The C library is the system's,
# of the release on which the folder was made or a newer one.
set(portable fusee-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})
add_custom_target(portable
  COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DNAME=${portable} -DMODULES=${FUSEE_MODULES}
          -P ${CMAKE_CURRENT_LIST_DIR}/make_portable.cmake
  USES_TERMINAL VERBATIM)
add_dependencies(portable fusee_cli fusee_share)
foreach(module IN ITEMS fusee_step fusee_evolution_module)
  if(TARGET ${module})
    add_dependencies(portable ${module})
  endif()
endforeach()
