# How every target of the project is made: one function each for a library, an app, a test binary and a benchmark.
include(GNUInstallDirs)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Each library calls its own copies of inline functions (hidden) and of function templates (bound at link time), which
# have its compiler options. Otherwise it would use those of the unit tests, which are not optimized, among them Eigen's
# products.
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
add_link_options(-Wl,-Bsymbolic-functions)
# The linker reports missing symbols, except under a sanitizer, whose functions come from the program.
if(NOT OMNIMAPPER_SANITIZE)
  string(APPEND CMAKE_SHARED_LINKER_FLAGS " -Wl,--no-undefined")
  string(APPEND CMAKE_MODULE_LINKER_FLAGS " -Wl,--no-undefined")
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
# Programs search our libraries only relative to their own folder, so that a build or installation can be moved. CMake's
# default run path would have an empty entry, which means the current folder.
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_BUILD_WITH_INSTALL_RPATH ON)

find_program(OMNIMAPPER_CCACHE ccache)
if(OMNIMAPPER_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${OMNIMAPPER_CCACHE}")
endif()

# With lld, linking takes a tenth of the time (doc/results/build.md).
find_program(OMNIMAPPER_LLD ld.lld)
mark_as_advanced(OMNIMAPPER_LLD)
if(OMNIMAPPER_LLD)
  add_link_options(-fuse-ld=lld)
endif()
# Options of every target: warnings are errors; unity build and sanitizer as configured.
function(omnimapper_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Werror)
  omnimapper_unity(${target})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # gcc's garbage collector takes a tenth of the time. It starts at 512 MiB, so that a compiler needs at most 2.5 GiB;
    # if there are 6 GiB for each core, it never starts.
    target_compile_options(${target} PRIVATE --param=ggc-min-heapsize=${omnimapper_collector_starts})
  endif()
  if(OMNIMAPPER_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${OMNIMAPPER_SANITIZE} -fno-omit-frame-pointer -g1 -O1)
    target_link_options(${target} PRIVATE -fsanitize=${OMNIMAPPER_SANITIZE})
    # Under a sanitizer, Eigen would otherwise allocate differently from MRPT's libraries, which free our memory.
    target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1 _GLIBCXX_ASSERTIONS)
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND NOT OMNIMAPPER_BUILD_FUZZ)
      target_compile_options(${target} PRIVATE
        "-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/SanitizerIgnoreList.txt")
    endif()
  endif()
endfunction()

# Sets the number of files that OMNIMAPPER_UNITY compiles at once. Shared headers take most of the time, so batches are
# as large as the memory for each core allows, and those of a target are of equal size.
function(omnimapper_unity target)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources count)
  math(EXPR batches "(${count} + ${omnimapper_largest_batch} - 1) / ${omnimapper_largest_batch}")
  if(batches LESS 1)
    set(batches 1)
  endif()
  math(EXPR batch "(${count} + ${batches} - 1) / ${batches}")
  set_target_properties(${target} PROPERTIES UNITY_BUILD "${OMNIMAPPER_UNITY}" UNITY_BUILD_BATCH_SIZE "${batch}")
endfunction()
# Larger batches compile headers and templates fewer times but need more memory: gcc 2.5 GiB with 56 files, 1.6 GiB with
# 28; clang half of that.
cmake_host_system_information(RESULT omnimapper_memory QUERY TOTAL_PHYSICAL_MEMORY)  # MiB
cmake_host_system_information(RESULT omnimapper_cores QUERY NUMBER_OF_LOGICAL_CORES)
math(EXPR omnimapper_memory_of_core "${omnimapper_memory} / ${omnimapper_cores}")
set(omnimapper_collector_starts 524288)  # KiB
if(omnimapper_memory_of_core GREATER 6000)
  set(omnimapper_collector_starts 8388608)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  set(omnimapper_largest_batch 64)
elseif(omnimapper_memory_of_core GREATER 3500)
  set(omnimapper_largest_batch 56)
else()
  set(omnimapper_largest_batch 28)
endif()

# omnimapper_sources(VARIABLE <patterns...>): the files of these patterns, with register.cpp last, because the ids of
# the classes that it registers must be initialized first. If the files need more than one unity file, register.cpp is
# compiled separately: CMake links unity files from last to first, and before all other files.
function(omnimapper_sources variable)
  file(GLOB sources CONFIGURE_DEPENDS ${ARGN})
  set(last ${sources})
  list(FILTER last INCLUDE REGEX "/register\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "/register\\.cpp$")
  list(LENGTH sources count)
  if(count GREATER_EQUAL omnimapper_largest_batch)
    set_source_files_properties(${last} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  set(${variable} ${sources} ${last} PARENT_SCOPE)
endfunction()

# omnimapper_optimize(TARGET KERNELS | LIGHT | ON | OFF): -O3 for KERNELS, -O1 for LIGHT, else -O2. Under a sanitizer
# KERNELS and ON have -O1, the others -O0.
function(omnimapper_optimize target how)
  if(how STREQUAL "KERNELS")
    return()
  elseif(OMNIMAPPER_SANITIZE AND NOT OMNIMAPPER_BUILD_FUZZ AND (how STREQUAL "LIGHT" OR NOT how))
    target_compile_options(${target} PRIVATE -O0)
  elseif(how STREQUAL "LIGHT")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O2>)
  endif()
endfunction()

# omnimapper_needs(VARIABLE (<target> <text>)...): why a part that needs these targets is left out, with the remedy;
# empty if all of them are there.
function(omnimapper_needs variable)
  set(${variable} "" PARENT_SCOPE)
  set(needs ${ARGN})
  while(needs)
    list(POP_FRONT needs needed text)
    if(NOT TARGET ${needed})
      set(${variable} "it had no ${text}; install that, and configure and build again" PARENT_SCOPE)
      return()
    endif()
  endwhile()
endfunction()

# omnimapper_library(NAME [KERNELS | OPTIMIZED | LIGHT] [NEEDS (<target> <text>)...] PUBLIC <targets...>
#   PRIVATE <targets...>)
# Shared library omnimapper-NAME from libs/NAME/src, one folder deep, exported as omnimapper::NAME. KERNELS is for
# libraries in whose loops mapping spends its time (-O3), LIGHT for those that compute little (-O1); all others have
# -O2. Under a sanitizer only KERNELS and OPTIMIZED libraries are optimized; the rest compile in half the time, and
# their tests take hardly longer. OPTIMIZED is for libraries that render images, whose tests would run for minutes.
# If a target that it NEEDS is missing, the library is left out, and so are the features and programs that need it.
function(omnimapper_library name)
  cmake_parse_arguments(ARG "KERNELS;OPTIMIZED;LIGHT" "" "NEEDS;PUBLIC;PRIVATE" ${ARGN})
  omnimapper_needs(left_out ${ARG_NEEDS})
  if(left_out)
    message(STATUS "Left out: library ${name}, because ${left_out}")
    return()
  endif()
  omnimapper_sources(sources "${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp" "${CMAKE_CURRENT_SOURCE_DIR}/src/*/*.cpp")
  set(target omnimapper-${name})
  add_library(${target} SHARED ${sources})
  add_library(omnimapper::${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC
    "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>"
    PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/src")
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  omnimapper_compile_options(${target})
  if(ARG_KERNELS)
    omnimapper_optimize(${target} KERNELS)
  elseif(ARG_LIGHT)
    omnimapper_optimize(${target} LIGHT)
  else()
    omnimapper_optimize(${target} "${ARG_OPTIMIZED}")
  endif()
  install(TARGETS ${target} EXPORT omnimapperTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

# omnimapper_feature(NAME [KERNELS] [PLUGINS <classes...>] [FORMATS <names...>] [DRIVERS <classes...>]
#   [FUNCTIONS <names...>] [NEEDS (<target> <text>)...] LINKS <targets...>)
# A feature: the shared library omnimapper-NAME from the folder's sources, in the folder omnimapper/ beside the other
# libraries, where programs find it. PLUGINS are the classes that it registers, as an INI writes them, FORMATS the
# formats of logs, DRIVERS the classes of live sensors, and FUNCTIONS the functions that it exports; a feature of
# functions alone is loaded when one is called. KERNELS is as in omnimapper_library(). If a target that it NEEDS is
# missing, or with -DOMNIMAPPER_FEATURE_NAME=OFF, the feature is left out, and whoever names something of it gets an
# error with the reason.
function(omnimapper_feature name)
  cmake_parse_arguments(ARG "KERNELS" "" "PLUGINS;FORMATS;DRIVERS;FUNCTIONS;NEEDS;LINKS" ${ARGN})
  option(OMNIMAPPER_FEATURE_${name}
    "Build the feature ${name}: ${ARG_PLUGINS}${ARG_FORMATS}${ARG_DRIVERS}${ARG_FUNCTIONS}" ON)
  set_property(GLOBAL APPEND PROPERTY omnimapper_declared_features ${name})
  omnimapper_needs(left_out ${ARG_NEEDS})
  if(NOT OMNIMAPPER_FEATURE_${name})
    set(left_out "it was configured with -DOMNIMAPPER_FEATURE_${name}=OFF; configure it with ON")
    if(ARG_NEEDS)
      list(GET ARG_NEEDS 1 text)
      string(APPEND left_out ", which needs ${text}")
    endif()
  endif()
  foreach(kind PLUGIN FORMAT DRIVER FUNCTION)
    string(TOLOWER ${kind} registered)
    foreach(each ${ARG_${kind}S})
      set_property(GLOBAL APPEND_STRING PROPERTY omnimapper_feature_index
        "    {Registered::${registered}, \"${each}\", \"${name}\", \"${left_out}\"},\n")
    endforeach()
  endforeach()
  if(left_out)
    message(STATUS "Feature ${name} is left out: ${left_out}")
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY omnimapper_features ${name})
  set(target omnimapper-${name})
  omnimapper_sources(sources "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  add_library(${target} SHARED ${sources})
  target_include_directories(${target} INTERFACE "${PROJECT_SOURCE_DIR}/libs/plugins")
  target_link_libraries(${target} PUBLIC ${ARG_LINKS})
  set_target_properties(${target} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/omnimapper" INSTALL_RPATH "$ORIGIN/..")
  omnimapper_compile_options(${target})
  if(ARG_KERNELS)
    omnimapper_optimize(${target} KERNELS)
  else()
    omnimapper_optimize(${target} OFF)
  endif()
  install(TARGETS ${target} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/omnimapper")
endfunction()

# omnimapper_has_features(VARIABLE WHO <features...>): whether all of them are built; if not, says that WHO is left out.
function(omnimapper_has_features variable who)
  get_property(features GLOBAL PROPERTY omnimapper_features)
  set(missing ${ARGN})
  list(REMOVE_ITEM missing ${features} "")
  set(${variable} TRUE PARENT_SCOPE)
  if(missing)
    list(JOIN missing ", " missing)
    message(STATUS "Left out: ${who}, because these features are not built: ${missing}")
    set(${variable} FALSE PARENT_SCOPE)
  endif()
endfunction()

# omnimapper_app(NAME <targets...> [NEEDS (<target> <text>)...]): program NAME from the folder's sources, target app-NAME
# (a library may be called NAME too). If a target that it NEEDS is missing, the program is left out.
function(omnimapper_app name)
  cmake_parse_arguments(ARG "" "" "NEEDS" ${ARGN})
  omnimapper_needs(left_out ${ARG_NEEDS})
  if(left_out)
    message(STATUS "Left out: ${name}, because ${left_out}")
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  add_executable(app-${name} ${sources})
  set_target_properties(app-${name} PROPERTIES OUTPUT_NAME ${name})
  target_link_libraries(app-${name} PRIVATE ${ARG_UNPARSED_ARGUMENTS})
  omnimapper_compile_options(app-${name})
  # An app compiles only the reading of its command line.
  omnimapper_optimize(app-${name} LIGHT)
  install(TARGETS app-${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# omnimapper_test(NAME [HALVES] [COST SECONDS] <targets...> [FILES FILES...] [OPTIMIZED FILES...] [RELEASE FILES...]
# [THREADS FILES...]): one test binary for the folder's *Test.cpp files and those of FILES, named test-NAME. Tests are
# not optimized: they compile in 40 % of the time and assert the same.
# OPTIMIZED: files that render images or search texts themselves and would run for minutes.
# COST: approximate duration [s]; ctest starts the longest first.
# RELEASE: files that are also in test-NAME-release, which tries more without a sanitizer (release_cases in
# scripts/lib/suites.sh).
# THREADS: files that are also in test-NAME-threads in a build under the thread sanitizer (thread_cases there).
# HALVES: ctest runs the cases as two parallel tests, NAME and NAME-2; the program itself runs all of them.
function(omnimapper_test name)
  cmake_parse_arguments(ARG "HALVES" "COST" "FILES;OPTIMIZED;RELEASE;THREADS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" "*Test.cpp")
  list(APPEND sources ${ARG_FILES})
  set(names ${name})
  set(sources_of_${name} ${sources})
  if(ARG_RELEASE AND NOT OMNIMAPPER_SANITIZE)
    list(APPEND names ${name}-release)
    set(sources_of_${name}-release ${ARG_RELEASE})
  endif()
  if(ARG_THREADS AND OMNIMAPPER_SANITIZE STREQUAL "thread")
    list(APPEND names ${name}-threads)
    set(sources_of_${name}-threads ${ARG_THREADS})
  endif()
  foreach(each ${names})
    set(plain ${sources_of_${each}})
    set(optimized ${plain})
    list(REMOVE_ITEM plain ${ARG_OPTIMIZED} "")
    list(REMOVE_ITEM optimized ${plain} "")
    add_executable(test-${each} ${plain})
    target_link_libraries(test-${each} PRIVATE ${ARG_UNPARSED_ARGUMENTS} omnimapper-testing GTest::gtest_main)
    omnimapper_compile_options(test-${each})
    target_compile_options(test-${each} PRIVATE -O0)
    if(optimized)
      # Only whole targets are compiled in batches with options of their own, so these files are a target.
      add_library(test-${each}-optimized OBJECT ${optimized})
      target_link_libraries(test-${each}-optimized PRIVATE ${ARG_UNPARSED_ARGUMENTS} omnimapper-testing GTest::gtest_main)
      target_include_directories(test-${each}-optimized PRIVATE $<TARGET_PROPERTY:test-${each},INCLUDE_DIRECTORIES>)
      omnimapper_compile_options(test-${each}-optimized)
      target_compile_options(test-${each}-optimized PRIVATE $<$<CONFIG:Release>:-O1>)
      target_sources(test-${each} PRIVATE $<TARGET_OBJECTS:test-${each}-optimized>)
    endif()
    add_test(NAME ${each} COMMAND test-${each})
    set(tests ${each})
    if(ARG_HALVES)
      # GoogleTest names the list of what ran after the program.
      set(half "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/test-${each}-2")
      add_custom_command(TARGET test-${each} POST_BUILD
        COMMAND "${CMAKE_COMMAND}" -E create_symlink test-${each} "${half}")
      add_test(NAME ${each}-2 COMMAND "${half}")
      set_tests_properties(${each} PROPERTIES ENVIRONMENT "GTEST_TOTAL_SHARDS=2;GTEST_SHARD_INDEX=0")
      set_tests_properties(${each}-2 PROPERTIES ENVIRONMENT "GTEST_TOTAL_SHARDS=2;GTEST_SHARD_INDEX=1")
      list(APPEND tests ${each}-2)
    endif()
    if(ARG_COST)
      set_tests_properties(${tests} PROPERTIES COST "${ARG_COST}")
    endif()
  endforeach()
endfunction()

# omnimapper_bench(NAME <targets...>): benchmark program bench-NAME from NAME.cpp.
function(omnimapper_bench name)
  add_executable(bench-${name} ${name}.cpp)
  target_link_libraries(bench-${name} PRIVATE ${ARGN} omnimapper-testing)
  omnimapper_compile_options(bench-${name})
endfunction()
