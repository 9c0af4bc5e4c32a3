# SPDX-License-Identifier: MIT
# How the project's own targets are made: one warning set, one sanitizer switch, one include root.

add_library(relucent_options INTERFACE)
target_compile_options(relucent_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align
  $<$<BOOL:${RELUCENT_WARNINGS_ARE_ERRORS}>:-Werror>)
if(RELUCENT_SANITIZERS)
  target_compile_options(relucent_options INTERFACE
    -fsanitize=${RELUCENT_SANITIZERS} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(relucent_options INTERFACE -fsanitize=${RELUCENT_SANITIZERS})
endif()

# relucent_core_library(image SOURCES color.cpp ... USES base PUBLIC lib ... PRIVATE lib ...)
#   USES    the core folders above this one that it may include: the layers, as link lines
#   PUBLIC  libraries whose headers appear in this folder's headers
#   PRIVATE libraries met only inside its sources
function(relucent_core_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES;PUBLIC;PRIVATE" ${ARGN})
  set(target relucent_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC ${CMAKE_SOURCE_DIR}/core)
  list(TRANSFORM ARG_USES PREPEND relucent_)
  target_link_libraries(${target} PUBLIC ${ARG_USES} ${ARG_PUBLIC} PRIVATE relucent_options ${ARG_PRIVATE})
endfunction()

# relucent_test(core/image/test_color.cpp USES image ...): one Qt Test program, one ctest entry.
#   ON_TWO_SCREENS  on an X server with an operator's and a projector's screen; skipped where none starts
function(relucent_test source)
  cmake_parse_arguments(ARG "ON_TWO_SCREENS" "TIMEOUT" "USES;LIBRARIES" ${ARGN})
  get_filename_component(name ${source} NAME_WE)
  add_executable(${name} ${source})
  set_target_properties(${name} PROPERTIES AUTOMOC ON)
  list(TRANSFORM ARG_USES PREPEND relucent_)
  target_link_libraries(${name} PRIVATE relucent_options Qt6::Test ${ARG_USES} ${ARG_LIBRARIES})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  set(command ${name})
  if(ARG_ON_TWO_SCREENS)
    set(command ${CMAKE_SOURCE_DIR}/tests/support/with-two-screens $<TARGET_FILE:${name}>)
  endif()
  add_test(NAME ${name} COMMAND ${command})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  # Qt Test has a limit of its own, 300 s for each function, whatever ctest allows.
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} SKIP_RETURN_CODE 77
    ENVIRONMENT "QTEST_FUNCTION_TIMEOUT=${ARG_TIMEOUT}000;RELUCENT_CLI=$<TARGET_FILE_DIR:${name}>/relucent-cli;RELUCENT_SHARED_DATA=${CMAKE_SOURCE_DIR}/../shared/data")
endfunction()
