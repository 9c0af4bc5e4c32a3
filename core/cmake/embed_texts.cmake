# SPDX-License-Identifier: MIT
# cmake -D OUTPUT=FILE.cpp -D HEADER=... -D NAMESPACE=... -D "TEXTS=a.comp;b.comp" -P embed_texts.cmake: each text as a
# constant, which HEADER declares.
set(code "// Made by embed_texts.cmake.\n#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n")
foreach(file ${TEXTS})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND code "const std::string_view ${name} = R\"text(${text})text\";\n")
endforeach()
file(WRITE ${OUTPUT} "${code}}\n")
