# fusee_embed(<target> <name> FILES <files>): compiles text files into <target>.
#
# Writes <name>.h and <name>.cpp into the build folder; `embedded::<file_name_with_underscores>` is a std::string_view of the bytes.
# The text is cut into pieces because compilers limit a single literal.
function(fusee_embed target name)
  cmake_parse_arguments(EMBED "" "" "FILES" ${ARGN})
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  set(declarations "")
  set(definitions "")
  foreach(file IN LISTS EMBED_FILES)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    file(READ ${file} hex HEX)
    string(LENGTH "${hex}" digits)
    math(EXPR size "${digits} / 2")
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
    string(MAKE_C_IDENTIFIER "${file}" identifier)
    string(APPEND declarations "extern const std::string_view ${identifier};\n")
    string(APPEND definitions "static constexpr char k_${identifier}[] = {${bytes}0};\n"
                              "const std::string_view ${identifier}{k_${identifier}, ${size}};\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/${name}.h CONTENT
       "#pragma once\n#include <string_view>\nnamespace fusee::embedded {\n${declarations}}  // namespace fusee::embedded\n" @ONLY)
  file(CONFIGURE OUTPUT ${folder}/${name}.cpp CONTENT
       "#include \"${name}.h\"\nnamespace fusee::embedded {\n${definitions}}  // namespace fusee::embedded\n" @ONLY)
  target_sources(${target} PRIVATE ${folder}/${name}.cpp)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
