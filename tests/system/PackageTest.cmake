# cmake -D BUILD_FOLDER=... -D FOREIGN_PROJECT=... -D SCRATCH=... -D GENERATOR=... -P PackageTest.cmake
# Installs the build, moves the installed tree, and uses it as a stranger would.
cmake_minimum_required(VERSION 3.22)
set(stage "${SCRATCH}/stage")
set(prefix "${SCRATCH}/moved")
file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")

# Runs a command; a failure ends the test with what it printed.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD_FOLDER}" --prefix "${stage}")
file(RENAME "${stage}" "${prefix}")

run("${CMAKE_COMMAND}" -S "${FOREIGN_PROJECT}" -B "${SCRATCH}/build" -G "${GENERATOR}"
  "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_CXX_COMPILER_LAUNCHER=")
run("${CMAKE_COMMAND}" --build "${SCRATCH}/build")
run("${SCRATCH}/build/foreign")

# Every program starts from where the tree was moved to.
file(GLOB programs "${prefix}/bin/*")
foreach(program ${programs})
  run("${program}" --help)
endforeach()
file(REMOVE_RECURSE "${SCRATCH}")
