# SPDX-License-Identifier: MIT
# How the project's own targets are made: one warning set, one sanitizer switch, one include root.

include(GNUInstallDirs)

# Core's headers are included as they are when installed: "relucent/transport/files.h".
set(RELUCENT_INCLUDE_DIR ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${RELUCENT_INCLUDE_DIR})
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/core ${RELUCENT_INCLUDE_DIR}/relucent SYMBOLIC)

add_library(relucent_options INTERFACE)
target_compile_options(relucent_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align
  $<$<BOOL:${RELUCENT_WARNINGS_ARE_ERRORS}>:-Werror>)
# A large source is compiled a tenth sooner where GCC does not tidy up before 600 MB, by up to 250 MB more; small ones
# never reach that.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(relucent_options INTERFACE --param=ggc-min-heapsize=600000)
endif()
if(RELUCENT_SANITIZERS)
  target_compile_options(relucent_options INTERFACE
    -fsanitize=${RELUCENT_SANITIZERS} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  # GCC's manual: sanitizers' checks make it take more for uninitialized than is.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(relucent_options INTERFACE -Wno-maybe-uninitialized)
  endif()
  # Half of the code that "undefined" adds, for what the address sanitizer tells as well: pointers to nothing crash,
  # objects have their ends, and pointers that overflow are far from both. Alignment shares their check, and is only
  # gone with it: a quarter of the build, and with the overflow another fifth.
  if(RELUCENT_SANITIZERS MATCHES "address.*undefined")
    target_compile_options(relucent_options INTERFACE -fno-sanitize=null,object-size,alignment,pointer-overflow)
  endif()
  # Eigen keeps books of its own where the address sanitizer's allocations may be aligned less than the system's, which
  # they are not. What it allocates here may be freed by a test of another build, and the other way round.
  if(RELUCENT_SANITIZERS MATCHES "address")
    target_compile_definitions(relucent_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
  endif()
  # What keeps the tasks of the packaged TBB apart is not seen by this one, which takes all of them for races.
  if(RELUCENT_SANITIZERS MATCHES "thread")
    target_include_directories(relucent_options INTERFACE ${PROJECT_SOURCE_DIR}/tests/support/seen_threads)
  endif()
  target_link_options(relucent_options INTERFACE -fsanitize=${RELUCENT_SANITIZERS})
endif()

# The tests' own objects of another build of these sources, for a build that changes only what is tested: half of a
# build's time is their compiling.
set(RELUCENT_TEST_OBJECTS "" CACHE PATH "A build whose tests' objects are linked here instead of compiled")

# Sources are named as they lie in the project: the same sources give the same programs in any folder.
if(RELUCENT_PACKAGE AND NOT MSVC)
  target_compile_options(relucent_options INTERFACE -ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
endif()

# What users get reads files of strangers: overruns end the program, and where functions are found cannot be changed.
if(RELUCENT_PACKAGE AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
  target_compile_options(relucent_options INTERFACE -fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
  target_link_options(relucent_options INTERFACE -Wl,-z,relro,-z,now)
endif()

# Half of a build is reading the same headers again, so they are read once for all targets of a kind. Tried with
# GCC. The preset `dev` does without, so that a source that lacks an include is told so.
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# relucent_prelude(core HEADERS <algorithm> ... LIBRARIES lib ...): headers for relucent_reads_prelude.
#   LIBRARIES  what they belong to, and what defines every macro that the libraries of its readers define
function(relucent_prelude name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES" ${ARGN})
  set(target relucent_${name}_prelude)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}_prelude.cpp CONTENT "")
  add_library(${target} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}_prelude.cpp)
  target_link_libraries(${target} PRIVATE relucent_options ${ARG_LIBRARIES})
  target_precompile_headers(${target} PRIVATE ${ARG_HEADERS})
endfunction()

# Reads a prelude before every source of a target. Its macros too, without which it would be refused, and its
# directories: where a compiler refuses what was read before, it reads the headers themselves.
function(relucent_reads_prelude target name)
  target_precompile_headers(${target} REUSE_FROM relucent_${name}_prelude)
  # Read so, the standard library's own inlined code is taken for ours by these, as a plain build shows.
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overread
      -Wno-stringop-overflow -Wno-maybe-uninitialized)
  endif()
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:relucent_${name}_prelude,COMPILE_DEFINITIONS>)
  target_include_directories(${target} SYSTEM PRIVATE
    $<TARGET_PROPERTY:relucent_${name}_prelude,INCLUDE_DIRECTORIES>)
endfunction()

# relucent_embed_texts(out HEADER relucent/engine/opengl/shaders.h NAMESPACE relucent::engine::shaders TEXTS a.comp b.comp):
# a source that defines each text as a constant of its name, which the header declares; its path in `out`.
set(RELUCENT_EMBED_TEXTS ${CMAKE_CURRENT_LIST_DIR}/embed_texts.cmake)
function(relucent_embed_texts out)
  cmake_parse_arguments(ARG "" "HEADER;NAMESPACE" "TEXTS" ${ARGN})
  get_filename_component(name ${ARG_HEADER} NAME_WE)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  list(TRANSFORM ARG_TEXTS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${source} -D HEADER=${ARG_HEADER} -D NAMESPACE=${ARG_NAMESPACE}
            -D "TEXTS=${ARG_TEXTS}" -P ${RELUCENT_EMBED_TEXTS}
    DEPENDS ${ARG_TEXTS} ${RELUCENT_EMBED_TEXTS} VERBATIM)
  set(${out} ${source} PARENT_SCOPE)
endfunction()

# relucent_core_library(image SOURCES colour.cpp ... USES base PUBLIC lib ... PRIVATE lib ...)
#   USES    the core folders above this one that it may include: the layers, as link lines
#   PUBLIC  libraries whose headers appear in this folder's headers
#   PRIVATE libraries met only inside its sources
#   OWN_FLAGS  its libraries define macros that the others' do not: it reads no prelude
function(relucent_core_library name)
  cmake_parse_arguments(ARG "OWN_FLAGS" "" "SOURCES;USES;PUBLIC;PRIVATE" ${ARGN})
  set(target relucent_${name})
  add_library(${target} ${ARG_SOURCES})
  add_library(relucent::${name} ALIAS ${target})
  # Shared or static it is compiled alike, and reads the same prelude.
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} DEFINE_SYMBOL "")
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${RELUCENT_INCLUDE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS ${target} EXPORT relucentTargets
    ARCHIVE COMPONENT Development EXCLUDE_FROM_ALL
    LIBRARY COMPONENT Development EXCLUDE_FROM_ALL)
  # Else functions that a test instantiates, too, are taken from there, where no sanitizer looks.
  if(RELUCENT_SANITIZERS AND BUILD_SHARED_LIBS)
    target_link_options(${target} PRIVATE -Wl,-Bsymbolic-functions)
  endif()
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/relucent/${folder}
    COMPONENT Development EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.h")
  list(TRANSFORM ARG_USES PREPEND relucent_)
  target_link_libraries(${target} PUBLIC ${ARG_USES} ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:relucent_options> ${ARG_PRIVATE})
  if(NOT ARG_OWN_FLAGS)
    relucent_reads_prelude(${target} core)
  endif()
endfunction()

# relucent_test(core/image/test_colour.cpp USES image ...): one Qt Test program, one ctest entry.
#   WITHIN two-screens  what tests/support/with-two-screens sets up around it, which says why it skips where it cannot:
#                       two-screens of X, two-outputs of sway, two-monitors of GNOME, desktop-portal
#   ROWS 6              so many rows of each of its tables, see tests/support/some-rows: where all take more than half a
#                       minute, on one path; tests/long has all
#   SANITIZED_ROWS 3    the same under sanitizers
#   THREADS             it does several things at a time: of those that the thread sanitizer looks at, see tests/long
# RELUCENT_TEST_PRELUDE, if set, names the prelude of a folder's tests.
function(relucent_test source)
  cmake_parse_arguments(ARG "THREADS" "TIMEOUT;WITHIN;ROWS;SANITIZED_ROWS" "USES;LIBRARIES" ${ARGN})
  get_filename_component(name ${source} NAME_WE)
  # Not AUTOMOC, which takes longer over each of many small targets than their moc.
  set(moc ${CMAKE_CURRENT_BINARY_DIR}/${name}.moc)
  qt_generate_moc(${source} ${moc})
  if(RELUCENT_TEST_OBJECTS)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    set(object ${RELUCENT_TEST_OBJECTS}/${folder}/CMakeFiles/${name}.dir/${source}.o)
    set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT ON)
    add_executable(${name} ${object})
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  else()
    add_executable(${name} ${source} ${moc})
  endif()
  list(TRANSFORM ARG_USES PREPEND relucent_)
  target_link_libraries(${name} PRIVATE relucent_options Qt6::Test ${ARG_USES} ${ARG_LIBRARIES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${CMAKE_CURRENT_BINARY_DIR})
  if(RELUCENT_TEST_PRELUDE)
    relucent_reads_prelude(${name} ${RELUCENT_TEST_PRELUDE})
  endif()
  set(rows ${ARG_ROWS})
  if(ARG_SANITIZED_ROWS AND RELUCENT_SANITIZERS)
    set(rows ${ARG_SANITIZED_ROWS})
  endif()
  set(command $<TARGET_FILE:${name}>)
  if(ARG_WITHIN)
    list(PREPEND command ${PROJECT_SOURCE_DIR}/tests/support/with-${ARG_WITHIN})
  elseif(rows)
    list(PREPEND command ${PROJECT_SOURCE_DIR}/tests/support/some-rows ${rows})
  endif()
  if(RELUCENT_SANITIZERS MATCHES "thread")
    list(PREPEND command ${PROJECT_SOURCE_DIR}/tests/support/seen-threads)
  endif()
  add_test(NAME ${name} COMMAND ${command})
  # By which tests/long finds them.
  set(labels "")
  if(rows)
    list(APPEND labels some-rows)
  endif()
  if(ARG_THREADS)
    list(APPEND labels threads)
    add_dependencies(relucent_tests_of_threads ${name})
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${labels}")
  if(ARG_TIMEOUT)
    set_tests_properties(${name} PROPERTIES COST ${ARG_TIMEOUT})  # long ones first: none runs alone at the end
  else()
    set(ARG_TIMEOUT 300)
  endif()
  if(RELUCENT_SANITIZERS MATCHES "thread")  # which takes ten times as long
    math(EXPR ARG_TIMEOUT "4 * ${ARG_TIMEOUT}")
  endif()
  # Qt Test has a limit of its own, 300 s for each function, whatever ctest allows.
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} SKIP_RETURN_CODE 77
    ENVIRONMENT "QTEST_FUNCTION_TIMEOUT=${ARG_TIMEOUT}000;RELUCENT_CLI=$<TARGET_FILE_DIR:${name}>/relucent-cli;RELUCENT_SHARED_DATA=${PROJECT_SOURCE_DIR}/../shared/data;RELUCENT_TEST_DATA=${PROJECT_SOURCE_DIR}/tests/data")
endfunction()
