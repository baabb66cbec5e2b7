# cpack: Debian packages of the program and of the library's development files, from what cmake --install copies.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME fusee)
set(CPACK_PACKAGE_CONTACT "the authors of fusee <fusee@packages.debian.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME fusee)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "librsvg2-2")  # loaded by `analyze -o FILE.png`
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "pulleys for tendon-driven joints, from mechanism to checked part
One motor drives a joint through two tendons wound on a compound pulley, one
groove of which is not round. fusee computes that pulley, checks the solid
that it writes, and corrects it by what was measured at the joint.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfusee-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, libcgal-dev, libopenmesh-dev, libdraco-dev, libfmt-dev, libtomlplusplus-dev, libzip-dev, libpugixml-dev, libssl-dev, libsqlite3-dev, libzstd-dev, liblz4-dev, libpagmo-dev, nlohmann-json3-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "pulleys for tendon-driven joints: library
Headers and static libraries of fusee, for find_package(fusee) of CMake and
for pkg-config.")

# If the Python module is built: for the system's Python only.
if(TARGET fusee_python)
  math(EXPR next_minor "${FUSEE_PYTHON_MINOR} + 1")
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-fusee)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${FUSEE_PYTHON_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "fusee (= ${PROJECT_VERSION})")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "pulleys for tendon-driven joints: Python module
The verbs of fusee as functions, with frozen values and read-only arrays of
NumPy. STEP files are made where the package fusee is installed too.")
endif()

include(CPack)
