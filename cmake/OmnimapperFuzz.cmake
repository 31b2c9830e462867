# OMNIMAPPER_BUILD_FUZZ: whether this compiler can, and how everything is compiled then.
if(OMNIMAPPER_BUILD_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "OMNIMAPPER_BUILD_FUZZ needs clang, and this is ${CMAKE_CXX_COMPILER_ID}: install the Debian "
      "packages clang and libclang-rt-14-dev and configure an empty folder with -DCMAKE_CXX_COMPILER=clang++, as "
      "scripts/fuzz does.")
  endif()
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_FLAGS "-fsanitize=fuzzer,address,undefined")
  set(CMAKE_REQUIRED_LINK_OPTIONS -fsanitize=fuzzer,address,undefined)
  check_cxx_source_compiles("
    #include <cstddef>
    #include <cstdint>
    extern \"C\" int LLVMFuzzerTestOneInput(const std::uint8_t*, std::size_t) { return 0; }" OMNIMAPPER_HAS_LIBFUZZER)
  unset(CMAKE_REQUIRED_FLAGS)
  unset(CMAKE_REQUIRED_LINK_OPTIONS)
  if(NOT OMNIMAPPER_HAS_LIBFUZZER)
    message(FATAL_ERROR "OMNIMAPPER_BUILD_FUZZ: ${CMAKE_CXX_COMPILER} has no libFuzzer; install the Debian package "
      "libclang-rt-14-dev (libclang-rt-N-dev for clang N).")
  endif()
  set(OMNIMAPPER_SANITIZE "fuzzer-no-link,address,undefined,float-cast-overflow" CACHE STRING
      "Set by OMNIMAPPER_BUILD_FUZZ" FORCE)
endif()
