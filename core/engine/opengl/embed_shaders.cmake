# SPDX-License-Identifier: MIT
# cmake -D OUTPUT=FILE.cpp -D "SHADERS=a.comp;b.comp" -P embed_shaders.cmake: each text as a constant.
set(code "// Made by embed_shaders.cmake.\n#include \"engine/opengl/shaders.h\"\n\nnamespace relucent::shaders {\n")
foreach(shader ${SHADERS})
  get_filename_component(name ${shader} NAME_WE)
  file(READ ${shader} text)
  string(APPEND code "const std::string_view ${name} = R\"shader(${text})shader\";\n")
endforeach()
file(WRITE ${OUTPUT} "${code}}\n")
