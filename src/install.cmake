# cmake --install: the program with its profiles, and the library for find_package(fusee) and pkg-config.
include(CMakePackageConfigHelpers)
set(FUSEE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/fusee)
set(FUSEE_LIBRARIES base mechanism transmission profile helix joint analysis optimize paper measurement plan calibration correction solid helical_solid kit model mesh_files drawings export pipeline)

set(program COMPONENT program)
install(TARGETS fusee_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} ${program})
# Loaded from there instead of linked: without them only `build --step` and the genetic searches are missing.
foreach(module IN ITEMS fusee_step fusee_evolution_module)
  if(TARGET ${module})
    install(TARGETS ${module} LIBRARY DESTINATION ${FUSEE_MODULES}
      PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ ${program})
  endif()
endforeach()
install(DIRECTORY profiles DESTINATION ${CMAKE_INSTALL_DATADIR}/fusee ${program})
install(DIRECTORY ${PROJECT_BINARY_DIR}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR} ${program})
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} ${program})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} ${program} PATTERN "update.py" EXCLUDE PATTERN "draw.py" EXCLUDE PATTERN "columns.toml" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)

set(development COMPONENT development)
foreach(module IN LISTS FUSEE_LIBRARIES)
  set_target_properties(fusee_${module} PROPERTIES EXPORT_NAME ${module})
  install(TARGETS fusee_${module} EXPORT fuseeTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} ${development})
  string(PREPEND FUSEE_PC_LIBRARIES "-lfusee_${module} ")  # a module uses those to its left
endforeach()
# Users of the library link the genetic search, so there is no module to find.
set_target_properties(fusee_evolution PROPERTIES EXPORT_NAME evolution)
install(TARGETS fusee_evolution EXPORT fuseeTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} ${development})
install(TARGETS fusee EXPORT fuseeTargets)
install(DIRECTORY include/fusee DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${development})
install(EXPORT fuseeTargets NAMESPACE fusee:: DESTINATION ${FUSEE_PACKAGE_DIR} ${development})
configure_package_config_file(src/fuseeConfig.cmake.in ${PROJECT_BINARY_DIR}/fuseeConfig.cmake INSTALL_DESTINATION ${FUSEE_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/fuseeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/fuseeConfig.cmake ${PROJECT_BINARY_DIR}/fuseeConfigVersion.cmake DESTINATION ${FUSEE_PACKAGE_DIR} ${development})
file(RELATIVE_PATH FUSEE_PC_UP ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(src/fusee.pc.in ${PROJECT_BINARY_DIR}/fusee.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/fusee.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig ${development})

# Files that Debian requires, only in packages: the licence by its name, the changelog, and lintian overrides with their
# reasons.
file(WRITE ${PROJECT_BINARY_DIR}/debian/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: fusee

Files: *
Copyright: 2026 the authors of fusee
License: GPL-3+
 On Debian systems the text of the GNU General Public License, version 3, is in
 /usr/share/common-licenses/GPL-3.
")
file(WRITE ${PROJECT_BINARY_DIR}/debian/changelog "fusee (${PROJECT_VERSION}) unstable; urgency=medium

  * See README.md.

 -- the authors of fusee <fusee@packages.debian.org>  Sun, 22 Nov 2026 12:00:00 +0000
")
execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/debian/changelog COMMAND_ERROR_IS_FATAL ANY)
foreach(package IN ITEMS program=fusee development=libfusee-dev python=python3-fusee)
  string(REPLACE "=" ";" package ${package})
  list(GET package 0 component)
  list(GET package 1 name)
  install(FILES ${PROJECT_BINARY_DIR}/debian/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
file(WRITE ${PROJECT_BINARY_DIR}/debian/libfusee-dev "# Static libraries, found from the place of fusee.pc itself: nothing to cross-compile with.
libfusee-dev: pkg-config-unavailable-for-cross-compilation
")
install(FILES ${PROJECT_BINARY_DIR}/debian/libfusee-dev DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides ${development} EXCLUDE_FROM_ALL)
