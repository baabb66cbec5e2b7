# fusee_embed(<target> HEADER <header> FILES <files>): compiles text files into <target>.
#
# <header>, as it is included, declares a `const std::string_view` in fusee::embedded for each file, named after it
# ("page.css" → page_css). Lines of a script that are only a comment are left out. The files become arrays of bytes,
# because compilers limit the length of string literals.
function(fusee_embed target)
  cmake_parse_arguments(EMBED "" "HEADER" "FILES" ${ARGN})
  set(definitions "")
  foreach(file IN LISTS EMBED_FILES)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    file(READ ${file} text)
    if(file MATCHES "\\.js$")
      string(REGEX REPLACE "(^|\n)( *// [^\n]*\n)+" "\\1" text "${text}")
    endif()
    string(HEX "${text}" hex)
    string(LENGTH "${hex}" digits)
    math(EXPR size "${digits} / 2")
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
    string(MAKE_C_IDENTIFIER "${file}" identifier)
    string(APPEND definitions "static constexpr char k_${identifier}[] = {${bytes}0};\n"
                              "const std::string_view ${identifier}{k_${identifier}, ${size}};\n")
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT
       "#include \"${EMBED_HEADER}\"\nnamespace fusee::embedded {\n${definitions}}  // namespace fusee::embedded\n" @ONLY)
  target_sources(${target} PRIVATE ${source})
endfunction()
