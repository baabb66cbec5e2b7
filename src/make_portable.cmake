# cmake -DBUILD=<build folder> -DNAME=<name> -DMODULES=<folder> -P make_portable.cmake: see portable.cmake.
cmake_minimum_required(VERSION 3.25)
set(packages ${BUILD}/packages)
set(folder ${packages}/${NAME})
file(REMOVE_RECURSE ${folder})
foreach(component IN ITEMS program licence)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${folder} --component ${component} --strip
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB modules ${folder}/${MODULES}/*.so)
set(program ${folder}/bin/fusee)
cmake_path(REPLACE_FILENAME MODULES bundled OUTPUT_VARIABLE libraries)
execute_process(COMMAND ${CMAKE_COMMAND} "-DFILES=${program};${modules}" -DLIBRARIES=${folder}/${libraries}
                -P ${CMAKE_CURRENT_LIST_DIR}/bundled_libraries.cmake COMMAND_ERROR_IS_FATAL ANY)
file(CREATE_LINK bin/fusee ${folder}/fusee SYMBOLIC)
# Equal input gives equal bytes: one order, one time, one owner.
execute_process(COMMAND tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -cf - ${NAME}
                COMMAND xz -6 -T2
                WORKING_DIRECTORY ${packages} OUTPUT_FILE ${packages}/${NAME}.tar.xz COMMAND_ERROR_IS_FATAL ANY)
file(SIZE ${packages}/${NAME}.tar.xz size)
math(EXPR megabytes "(${size} + 500000) / 1000000")
message(STATUS "${packages}/${NAME}.tar.xz, ${megabytes} MB")
