# How every target of fitgauge is built: the language, the warnings, the sanitizers, and one
# function per kind of target.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")

find_program(FITGAUGE_CCACHE ccache)
if(FITGAUGE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # The sloppiness is what a precompiled header asks of ccache (its manual, "Precompiled headers").
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros "${FITGAUGE_CCACHE}")
  set(CMAKE_C_COMPILER_LAUNCHER "${FITGAUGE_CCACHE}")
endif()

add_library(fitgauge_options INTERFACE)
target_include_directories(fitgauge_options INTERFACE "${CMAKE_BINARY_DIR}/include/base")  # of the prelude
# A room is one library: a program maps what the parts of it need that it uses.
target_link_options(fitgauge_options INTERFACE -Wl,--as-needed)
target_compile_options(fitgauge_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Werror
  # Objects and error texts carry no path of the machine that built them.
  "-ffile-prefix-map=${CMAKE_SOURCE_DIR}/=" "-ffile-prefix-map=${CMAKE_BINARY_DIR}/include/=")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # A tenth of the compiler's time is its search for memory to use again; a unit takes 2.2 GB at most without it.
  target_compile_options(fitgauge_options INTERFACE --param=ggc-min-heapsize=1048576)
endif()
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  target_compile_definitions(fitgauge_options INTERFACE _FORTIFY_SOURCE=2)
  target_compile_options(fitgauge_options INTERFACE -fstack-protector-strong -fstack-clash-protection)
  target_link_options(fitgauge_options INTERFACE -Wl,-z,relro,-z,now)
endif()
if(FITGAUGE_SANITIZE)
  target_compile_options(fitgauge_options INTERFACE
    "-fsanitize=${FITGAUGE_SANITIZE}" -fno-omit-frame-pointer -fno-sanitize-recover=all)
  # Checked programs hold millions of pointers to where each check stands: at a fixed address the linker sets them,
  # not the loader at every start.
  target_link_options(fitgauge_options INTERFACE "-fsanitize=${FITGAUGE_SANITIZE}" -no-pie)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_link_options(fitgauge_options INTERFACE -fuse-ld=gold)  # two thirds of the time
  endif()
endif()
if(FITGAUGE_SANITIZE AND CMAKE_BUILD_TYPE STREQUAL "Debug")
  # A null pointer ends a program under AddressSanitizer anyway, and x86 reads at any address: these two
  # checks stand at every access to a member, half of all code. The fuzz targets keep them.
  target_compile_options(fitgauge_options INTERFACE -fno-sanitize=null,alignment)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_UNITY_BUILD)
    # std::move and its like are no calls: a twenty-eighth of the compiler's time. Clang, which reads the commands
    # of the preset `edit`, does not know the option.
    target_compile_options(fitgauge_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-ffold-simple-inlines>)
  endif()
endif()
if(FITGAUGE_SANITIZE STREQUAL "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 takes instrumented variants for uninitialised.
  target_compile_options(fitgauge_options INTERFACE -Wno-maybe-uninitialized)
endif()
if(FITGAUGE_COVERAGE)
  target_compile_options(fitgauge_options INTERFACE --coverage)
  target_link_options(fitgauge_options INTERFACE --coverage)
endif()
if(FITGAUGE_FUZZ)
  target_compile_options(fitgauge_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# What every file may use: included before each C++ file, compiled once for the libraries and once, with doctest, for the
# tests.
set(prelude "${CMAKE_SOURCE_DIR}/server/base/prelude.hpp")
set(is_precompiled "$<OR:$<BOOL:$<TARGET_PROPERTY:PRECOMPILE_HEADERS>>,$<BOOL:$<TARGET_PROPERTY:PRECOMPILE_HEADERS_REUSE_FROM>>>")
set(needs_prelude "$<OR:$<BOOL:$<TARGET_PROPERTY:DISABLE_PRECOMPILE_HEADERS>>,$<NOT:${is_precompiled}>>")
target_compile_options(fitgauge_options INTERFACE
  "$<$<AND:$<COMPILE_LANGUAGE:CXX>,${needs_prelude}>:SHELL:-include \"${prelude}\">")
file(GENERATE OUTPUT "${CMAKE_BINARY_DIR}/precompiled.cpp" CONTENT "")

# fitgauge_precompile(<target> HEADERS <headers> LINKS <targets>)
function(fitgauge_precompile target)
  cmake_parse_arguments(arg "" "" "HEADERS;LINKS" ${ARGN})
  add_library(${target} STATIC "${CMAKE_BINARY_DIR}/precompiled.cpp")
  target_link_libraries(${target} PRIVATE ${arg_LINKS} fitgauge_options)
  target_precompile_headers(${target} PRIVATE ${arg_HEADERS})
endfunction()
fitgauge_precompile(precompiled HEADERS "${prelude}" LINKS Boost::headers fmt::fmt)

# fitgauge_unity(<target> <folder> [SEPARATE <regex>])
# Where CMAKE_UNITY_BUILD is on, the target's files compile in groups of about 5,000 lines: whole folders together, a
# larger folder in equal parts. Files that match <regex> stay alone.
set(unity_bytes 200000)
function(fitgauge_unity target folder)
  cmake_parse_arguments(arg "" "SEPARATE" "" ${ARGN})
  get_target_property(sources ${target} SOURCES)
  # The folders, at most two deep, with their files and sizes.
  set(rooms "")
  foreach(source IN LISTS sources)
    get_filename_component(name "${source}" NAME)
    if(arg_SEPARATE AND name MATCHES "${arg_SEPARATE}")
      set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      continue()
    endif()
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${folder}" OUTPUT_VARIABLE path)
    string(REGEX MATCH "^/[a-z0-9_]+/[a-z0-9_]+/|^/[a-z0-9_]+/|^/" room "/${path}")
    string(MAKE_C_IDENTIFIER "in_${room}" room)
    if(NOT room IN_LIST rooms)
      list(APPEND rooms ${room})
      set(${room}_bytes 0)
      set(${room}_files "")
    endif()
    file(SIZE "${source}" bytes)
    math(EXPR ${room}_bytes "${${room}_bytes} + ${bytes}")
    list(APPEND ${room}_files "${source}")
  endforeach()
  list(SORT rooms)
  set(group 0)
  set(filled 0)
  foreach(room IN LISTS rooms)
    math(EXPR parts "(${${room}_bytes} + ${unity_bytes} - 1) / ${unity_bytes}")
    math(EXPR most "${${room}_bytes} / ${parts} + 1")
    math(EXPR together "${filled} + ${${room}_bytes}")
    if(together GREATER unity_bytes)
      math(EXPR group "${group} + 1")
      set(filled 0)
    endif()
    foreach(source IN LISTS ${room}_files)
      if(parts GREATER 1 AND filled GREATER_EQUAL most)
        math(EXPR group "${group} + 1")
        set(filled 0)
      endif()
      file(SIZE "${source}" bytes)
      math(EXPR filled "${filled} + ${bytes}")
      set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}")
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# fitgauge_library(<name> [PUBLIC <targets>] [PRIVATE <targets>] [SEPARATE <regex>] [WITHOUT <regex>])
# The room <name> from every *.cpp of the current folder but main.cpp and what matches WITHOUT. Its include root holds
# this folder alone, so `#include "<room>/<file>.hpp"` compiles only where that room is linked.
function(fitgauge_library name)
  cmake_parse_arguments(arg "" "SEPARATE;WITHOUT" "PUBLIC;PRIVATE" ${ARGN})
  set(root "${CMAKE_BINARY_DIR}/include/${name}")
  file(MAKE_DIRECTORY "${root}")
  file(CREATE_LINK "${CMAKE_CURRENT_SOURCE_DIR}" "${root}/${name}" SYMBOLIC)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  list(REMOVE_ITEM sources "${CMAKE_CURRENT_SOURCE_DIR}/main.cpp")
  if(arg_WITHOUT)
    list(FILTER sources EXCLUDE REGEX "${arg_WITHOUT}")
  endif()
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} PUBLIC "${root}")
  target_link_libraries(${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} fitgauge_options)
  target_precompile_headers(${name} REUSE_FROM precompiled)
  fitgauge_unity(${name} "${CMAKE_CURRENT_SOURCE_DIR}" SEPARATE "${arg_SEPARATE}")
endfunction()

# fitgauge_precompiled(<target>)
# A program takes the precompiled header of the libraries, and is compiled as they are.
function(fitgauge_precompiled target)
  target_precompile_headers(${target} REUSE_FROM precompiled)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(${target} PRIVATE -fPIC)
endfunction()

# fitgauge_doctest(<kind> <name> [FOLDER <folder>] [LINKS <targets>])
# One doctest executable <kind>_<name> from every *.cpp below <folder> (default: <name>), and one ctest of the
# same name, which also fails when the number of cases that ran differs from --count.
function(fitgauge_doctest kind name)
  cmake_parse_arguments(arg "" "FOLDER" "LINKS" ${ARGN})
  if(NOT arg_FOLDER)
    set(arg_FOLDER "${name}")
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${arg_FOLDER}/*.cpp")
  set(target "${kind}_${name}")
  add_executable(${target} ${sources})
  target_link_libraries(${target} PRIVATE ${arg_LINKS} test_support fitgauge_options)
  target_precompile_headers(${target} REUSE_FROM precompiled_tests)
  fitgauge_unity(${target} "${CMAKE_CURRENT_SOURCE_DIR}/${arg_FOLDER}")
  # Compiled as the precompiled header is: not as a position-independent executable.
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  add_test(NAME "${kind}.${name}"
    COMMAND "${CMAKE_SOURCE_DIR}/tests/support/run_doctest" "$<TARGET_FILE:${target}>"
    WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}")
endfunction()
