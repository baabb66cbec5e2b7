# cmake --install: the program, the library for find_package(fusee), and the profiles.
include(CMakePackageConfigHelpers)
set(FUSEE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/fusee)
set(FUSEE_ROOMS base mechanism transmission profile joint analysis optimize paper measurement plan calibration correction solid kit export pipeline)

foreach(room IN LISTS FUSEE_ROOMS)
  set_target_properties(fusee_${room} PROPERTIES EXPORT_NAME ${room})
  install(TARGETS fusee_${room} EXPORT fuseeTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endforeach()
install(TARGETS fusee EXPORT fuseeTargets)
install(TARGETS fusee_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/fusee DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY profiles DESTINATION ${CMAKE_INSTALL_DATADIR}/fusee)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT fuseeTargets NAMESPACE fusee:: DESTINATION ${FUSEE_PACKAGE_DIR})
configure_package_config_file(src/fuseeConfig.cmake.in ${PROJECT_BINARY_DIR}/fuseeConfig.cmake INSTALL_DESTINATION ${FUSEE_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/fuseeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/fuseeConfig.cmake ${PROJECT_BINARY_DIR}/fuseeConfigVersion.cmake DESTINATION ${FUSEE_PACKAGE_DIR})
