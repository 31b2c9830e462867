# Libraries for which Debian ships no CMake package.

# find_plain_library(NAME HEADER LIBRARY [OPTIONAL] [FOLDER...]): defines the target NAME::NAME, or ends with what is
# missing; without an OPTIONAL one there is no target. The header may be in one of the folders of those names among the
# include folders.
function(find_plain_library name header library)
  cmake_parse_arguments(ARG "OPTIONAL" "" "" ${ARGN})
  if(TARGET ${name}::${name})
    return()
  endif()
  set(required REQUIRED)
  if(ARG_OPTIONAL)
    set(required "")
  endif()
  find_path(${name}_INCLUDE_DIR ${header} PATH_SUFFIXES ${ARG_UNPARSED_ARGUMENTS} ${required})
  find_library(${name}_LIBRARY ${library} ${required})
  if(NOT ${name}_INCLUDE_DIR OR NOT ${name}_LIBRARY)
    return()
  endif()
  add_library(${name}::${name} UNKNOWN IMPORTED)
  set_target_properties(${name}::${name} PROPERTIES
    IMPORTED_LOCATION "${${name}_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${${name}_INCLUDE_DIR}")
endfunction()
