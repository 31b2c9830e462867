# Libraries for which Debian ships no CMake package.

# find_plain_library(NAME HEADER LIBRARY [FOLDER...]): defines the target NAME::NAME, or ends with what is missing. The
# header may be in one of the folders of those names among the include folders.
function(find_plain_library name header library)
  if(TARGET ${name}::${name})
    return()
  endif()
  find_path(${name}_INCLUDE_DIR ${header} PATH_SUFFIXES ${ARGN} REQUIRED)
  find_library(${name}_LIBRARY ${library} REQUIRED)
  add_library(${name}::${name} UNKNOWN IMPORTED)
  set_target_properties(${name}::${name} PROPERTIES
    IMPORTED_LOCATION "${${name}_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${${name}_INCLUDE_DIR}")
endfunction()
