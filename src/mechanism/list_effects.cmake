# cmake -DOUTPUT=… "-DEFFECTS=a.cpp|b.cpp" -P list_effects.cmake
# Writes a C++ source with effect_list(), which calls the function of every effect's file.
string(REPLACE "|" ";" files "${EFFECTS}")
set(declarations "")
set(calls "")
foreach(file IN LISTS files)
  cmake_path(GET file STEM name)
  string(APPEND declarations "Effect ${name}(JointKind kind);\n")
  string(APPEND calls "${name}(kind), ")
endforeach()
file(WRITE ${OUTPUT} "#include \"mechanism/effect_list.h\"\n\nnamespace fusee {\n\n${declarations}\n"
  "std::vector<Effect> effect_list(JointKind kind) { return {${calls}}; }\n\n}  // namespace fusee\n")
