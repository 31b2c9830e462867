# cmake -D BUILD_FOLDER=... -D FOREIGN_PROJECT=... -D SCRATCH=... -D GENERATOR=... -P PackageTest.cmake
# Installs the build, moves the installed tree, and uses it as a stranger would: links against it, starts its programs,
# and has one of them load a plugin built outside.
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

# A map of a real log, with the foreign plugin as its only output.
file(WRITE "${SCRATCH}/foreign.ini" "
[mapper]
pose_plugins     = odometry
measurement_plugins = scan_matching
output_plugins   = pose_count
plugin_libraries = ${SCRATCH}/build/libforeign-plugins.so
[perception]
extractors = laser_points
[odometry]
class = OdometryPlugin
[laser_points]
class = LaserPointsExtractor
[scan_matching]
class = ScanMatchingPlugin
[pose_count]
class = PoseCountOutput
file  = count.txt
")
file(GLOB log "/usr/share/mrpt/datasets/*Telecom*one_loop_only.rawlog")
run("${prefix}/bin/omnimapper-graphslam" -i "${SCRATCH}/foreign.ini" -r "${log}" -o "${SCRATCH}/out" -q)
file(READ "${SCRATCH}/out/count.txt" count)
if(NOT count GREATER 10)
  message(FATAL_ERROR "the foreign plugin counted '${count}' key frames")
endif()
file(REMOVE_RECURSE "${SCRATCH}")
