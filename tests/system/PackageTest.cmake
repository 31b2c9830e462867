# cmake -D BUILD_FOLDER=... -D FOREIGN_PROJECT=... -D EXAMPLES=... -D BEACON_LOG=... -D INI=... -D WALLS_INI=... -D SCRATCH=...
#   -D GENERATOR=... -P PackageTest.cmake
# Installs the build, moves the installed tree, and uses it as a stranger would: links against it, starts its programs,
# has it miss a feature, and has one of them load plugins built outside: outputs of a foreign project, and those of
# doc/examples.
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

# Configures and builds a project of somebody else's against the installed package, all files of a target at once, which
# takes a third of the time; more arguments are for CMake.
function(build project folder)
  run("${CMAKE_COMMAND}" -S "${project}" -B "${folder}" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_CXX_COMPILER_LAUNCHER=" -DCMAKE_UNITY_BUILD=ON ${ARGN})
  run("${CMAKE_COMMAND}" --build "${folder}")
endfunction()

build("${FOREIGN_PROJECT}" "${SCRATCH}/build")
run("${SCRATCH}/build/foreign")
build("${EXAMPLES}/beacons" "${SCRATCH}/beacons")

# Every program starts from where the tree was moved to.
file(GLOB programs "${prefix}/bin/*")
foreach(program ${programs})
  run("${program}" --help)
  execute_process(COMMAND "${program}" --version RESULT_VARIABLE result OUTPUT_VARIABLE version)
  if(NOT result EQUAL 0 OR NOT version MATCHES "^omnimapper-[a-z-]+ [0-9]+[.][0-9]+[.][0-9]+\n$")
    message(FATAL_ERROR "${program} --version ended with ${result} and printed '${version}'")
  endif()
endforeach()
# What the README and the programs speak of is there, and INIs are found by their names.
set(pages "${prefix}/share/doc/omnimapper")
foreach(file README.md LICENSE CHANGELOG.md doc/exit_codes.md doc/architecture.md ini/README.md rawlogs/README.md)
  if(NOT EXISTS "${pages}/${file}")
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()
# No link of the pages for users leads nowhere.
foreach(page README.md CHANGELOG.md ini/README.md rawlogs/README.md doc/exit_codes.md doc/simulator.md doc/security.md)
  file(READ "${pages}/${page}" text)
  cmake_path(GET page PARENT_PATH folder)
  # Without the bracket before: CMake takes a list with a single one for one item.
  string(REGEX MATCHALL "\\([A-Za-z0-9_./-]+[.](md|png|jpg|svg)" links "${text}")
  foreach(link ${links})
    string(SUBSTRING "${link}" 1 -1 link)
    if(NOT EXISTS "${pages}/${folder}/${link}")
      message(FATAL_ERROR "installed, ${page} links to ${link}, which is not there")
    endif()
  endforeach()
endforeach()
file(GLOB log "/usr/share/mrpt/datasets/*Telecom*one_loop_only.rawlog")
file(MAKE_DIRECTORY "${SCRATCH}/nowhere")
execute_process(COMMAND "${prefix}/bin/omnimapper-graphslam" -q -i laser2d.ini -r "${log}" -o map
  WORKING_DIRECTORY "${SCRATCH}/nowhere" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${prefix}/bin/omnimapper-simulate" -q -i box.ini -o box --set simulation.duration_s=1
  WORKING_DIRECTORY "${SCRATCH}/nowhere" COMMAND_ERROR_IS_FATAL ANY)

# The live window is loaded when it is opened. Without a display it says so; without its library, too.
function(expect_gui_error text)
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env --unset=DISPLAY --unset=WAYLAND_DISPLAY
    "${prefix}/bin/omnimapper-graphslam" -q --gui
    -i "${INI}" -r "${log}" -o "${SCRATCH}/gui" RESULT_VARIABLE result ERROR_VARIABLE error)
  if(result EQUAL 0 OR NOT error MATCHES "${text}")
    message(FATAL_ERROR "--gui ended with ${result} and no word of '${text}':\n${error}")
  endif()
endfunction()
expect_gui_error("no display")
file(GLOB_RECURSE window "${prefix}/libomnimapper-live_scene.so")
file(RENAME "${window}" "${SCRATCH}/taken_away.so")
expect_gui_error("feature .live_scene., whose library libomnimapper-live_scene.so is not in")
file(RENAME "${SCRATCH}/taken_away.so" "${window}")

# The drivers of sensors are loaded for live runs alone. A run of a log does without their library; a live one says so.
file(GLOB_RECURSE drivers "${prefix}/libomnimapper-mrpt_drivers.so")
file(MAKE_DIRECTORY "${SCRATCH}/drivers")
list(GET drivers 0 first_driver)
get_filename_component(library_folder "${first_driver}" DIRECTORY)
file(COPY ${drivers} DESTINATION "${SCRATCH}/drivers")
file(REMOVE ${drivers})
run("${prefix}/bin/omnimapper-graphslam" -i "${INI}" -r "${log}" -o "${SCRATCH}/without_drivers" -q)
file(WRITE "${SCRATCH}/live.ini" "
[live]
sensors = laser
[laser]
driver      = CHokuyoURG
COM_port_LIN = /dev/ttyACM0
")
function(expect_live_error text)
  execute_process(COMMAND "${prefix}/bin/omnimapper-graphslam" -q --record-only -i "${SCRATCH}/live.ini"
    -o "${SCRATCH}/live" RESULT_VARIABLE result ERROR_VARIABLE error)
  if(result EQUAL 0 OR NOT error MATCHES "${text}")
    message(FATAL_ERROR "--record-only ended with ${result} and no word of '${text}':\n${error}")
  endif()
endfunction()
expect_live_error("feature .mrpt_drivers., whose library libomnimapper-mrpt_drivers.so is not in")
file(GLOB drivers "${SCRATCH}/drivers/*")
file(COPY ${drivers} DESTINATION "${library_folder}")
expect_live_error("sensor .laser. .CHokuyoURG. cannot be opened")

# Features are found beside the program alone. One that is taken away is missed by whoever names its plugin, and by nobody
# else; a library of that name in the current folder, or where the environment has the loader look, is no feature.
file(GLOB_RECURSE planes "${prefix}/libomnimapper-planes.so")
file(MAKE_DIRECTORY "${SCRATCH}/elsewhere/omnimapper")
file(RENAME "${planes}" "${SCRATCH}/elsewhere/omnimapper/libomnimapper-planes.so")
execute_process(COMMAND "${CMAKE_COMMAND}" -E env "LD_LIBRARY_PATH=${SCRATCH}/elsewhere/omnimapper:${SCRATCH}/elsewhere"
  "${prefix}/bin/omnimapper-graphslam" -i "${WALLS_INI}" -r "${log}" -o "${SCRATCH}/walls"
  WORKING_DIRECTORY "${SCRATCH}/elsewhere" RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result EQUAL 6 OR NOT error MATCHES "LaserLineExtractor.*feature 'planes'.*libomnimapper-planes.so is not in.*build or install it")
  message(FATAL_ERROR "without the feature planes the INI of walls ended with ${result}:\n${error}")
endif()
run("${prefix}/bin/omnimapper-graphslam" -i "${INI}" -r "${log}" -o "${SCRATCH}/without_planes" -q)
file(WRITE "${planes}" "no library")
execute_process(COMMAND "${prefix}/bin/omnimapper-graphslam" -i "${WALLS_INI}" -r "${log}" -o "${SCRATCH}/walls"
  RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result EQUAL 6 OR NOT error MATCHES "feature 'planes', whose library cannot be loaded")
  message(FATAL_ERROR "with a feature that is no library the INI of walls ended with ${result}:\n${error}")
endif()
file(RENAME "${SCRATCH}/elsewhere/omnimapper/libomnimapper-planes.so" "${planes}")
run("${prefix}/bin/omnimapper-graphslam" --print-ini PlaneLandmarksPlugin)

# A map of a real log, with the foreign plugin as its only output.
file(WRITE "${SCRATCH}/foreign.ini" "
[mapper]
pose_plugins     = odometry
measurement_plugins = loop_closure
output_plugins   = pose_count
plugin_libraries = ${SCRATCH}/build/libforeign-plugins.so
[perception]
extractors = laser_points
[odometry]
class = OdometryPlugin
[laser_points]
class = LaserPointsExtractor
[loop_closure]
class = LoopClosurePlugin
[pose_count]
class = PoseCountOutput
file  = count.txt
")
run("${prefix}/bin/omnimapper-graphslam" -i "${SCRATCH}/foreign.ini" -r "${log}" -o "${SCRATCH}/out" -q)
file(READ "${SCRATCH}/out/count.txt" count)
if(NOT count GREATER 10)
  message(FATAL_ERROR "the foreign plugin counted '${count}' key frames")
endif()

# A landmark type from outside: the example's own INI, with the full path of its library and an output that checks.
set(ini "${SCRATCH}/beacons.ini")
file(READ "${EXAMPLES}/beacons/beacons.ini" text)
string(REPLACE "build/libbeacons.so" "${SCRATCH}/beacons/libbeacons.so, ${SCRATCH}/build/libforeign-plugins.so" text "${text}")
string(REPLACE "map, trajectory, report" "map, trajectory, report, check" text "${text}")
file(WRITE "${ini}" "${text}
[check]
class = LandmarkCheckOutput
truth = ${SCRATCH}/beacons.txt
")
# The program knows its classes and keys.
execute_process(COMMAND "${prefix}/bin/omnimapper-graphslam" -i "${ini}" --list-plugins OUTPUT_VARIABLE listed)
if(NOT listed MATCHES "BeaconPlugin +Beacons with numbers")
  message(FATAL_ERROR "--list-plugins does not know BeaconPlugin:\n${listed}")
endif()
execute_process(COMMAND "${prefix}/bin/omnimapper-graphslam" -i "${ini}" --print-ini BeaconPlugin OUTPUT_VARIABLE printed)
if(NOT printed MATCHES "height_m = 1" OR NOT printed MATCHES "estimate_sensor_pose = no")
  message(FATAL_ERROR "--print-ini BeaconPlugin:\n${printed}")
endif()
# What the check wrote: as many landmarks as there are things, each within 10 cm.
function(expect_landmarks_in folder)
  file(READ "${folder}/landmarks.txt" check)
  if(NOT check MATCHES "^([0-9]+) ([0-9]+) ([0-9]+)\n$")
    message(FATAL_ERROR "${folder}: the check wrote '${check}'")
  endif()
  set(found "${CMAKE_MATCH_1} landmarks for ${CMAKE_MATCH_2} things, the worst ${CMAKE_MATCH_3} mm off")
  if(NOT CMAKE_MATCH_1 EQUAL CMAKE_MATCH_2 OR NOT CMAKE_MATCH_3 LESS 100)
    message(FATAL_ERROR "${folder}: ${found}")
  endif()
  message(STATUS "${folder}: ${found}")
endfunction()

run("${BEACON_LOG}" "${SCRATCH}/drive.rawlog" "${SCRATCH}/beacons.txt" 1)
foreach(estimate no once each_key_frame)
  run("${prefix}/bin/omnimapper-graphslam" -i "${ini}" -r "${SCRATCH}/drive.rawlog" -o "${SCRATCH}/${estimate}" -q
    --set "beacons.estimate_sensor_pose=${estimate}")
  expect_landmarks_in("${SCRATCH}/${estimate}")
endforeach()

# The map goes on: a second drive sees the beacons of the first again, which come from the file.
run("${BEACON_LOG}" "${SCRATCH}/second.rawlog" "${SCRATCH}/beacons.txt" 2)
run("${prefix}/bin/omnimapper-graphslam" -i "${ini}" -r "${SCRATCH}/second.rawlog" -o "${SCRATCH}/both" -q
  --continue "${SCRATCH}/once/map.omnimap")
expect_landmarks_in("${SCRATCH}/both")

# Boxes with a class, whose middles are found and whose classes the floor plan shows.
build("${EXAMPLES}/boxes" "${SCRATCH}/boxes")
file(READ "${EXAMPLES}/boxes/boxes.ini" text)
string(REPLACE "build/libboxes.so" "${SCRATCH}/boxes/libboxes.so, ${SCRATCH}/build/libforeign-plugins.so" text "${text}")
string(REPLACE "floor_plan, report" "floor_plan, report, check" text "${text}")
file(WRITE "${SCRATCH}/boxes.ini" "${text}
[check]
class = LandmarkCheckOutput
truth = ${SCRATCH}/boxes.txt
")
function(expect_classes_in folder)
  file(READ "${folder}/floorplan.geojson" plan)
  file(STRINGS "${SCRATCH}/boxes.txt" things)
  foreach(class chair table plant shelf)
    set(true_ones "${things}")
    list(FILTER true_ones INCLUDE REGEX " ${class}$")
    list(LENGTH true_ones there)
    string(REGEX MATCHALL "\"label\": ?\"${class}\"" found "${plan}")
    list(LENGTH found mapped)
    if(NOT mapped EQUAL there)
      message(FATAL_ERROR "${folder}: ${mapped} of the class ${class} are in the map, and ${there} are there")
    endif()
  endforeach()
endfunction()
set(continued "")
foreach(seed 1 2)
  run("${SCRATCH}/boxes/box-log" "${SCRATCH}/boxes_${seed}.rawlog" "${SCRATCH}/boxes.txt" ${seed})
  run("${prefix}/bin/omnimapper-graphslam" -q -i "${SCRATCH}/boxes.ini" -r "${SCRATCH}/boxes_${seed}.rawlog"
    -o "${SCRATCH}/boxes_map" ${continued})
  expect_landmarks_in("${SCRATCH}/boxes_map")
  expect_classes_in("${SCRATCH}/boxes_map")
  set(continued --continue "${SCRATCH}/boxes_map" --set session.start=origin)  # the second drive goes on with this map
endforeach()

# An output from outside with an optional dependency. Without zlib the landmarks are written as they are.
function(expect_mesh file)
  if(NOT EXISTS "${SCRATCH}/mesh/${file}")
    file(GLOB files RELATIVE "${SCRATCH}/mesh" "${SCRATCH}/mesh/*")
    message(FATAL_ERROR "MeshOutput did not write ${file}, but the folder has: ${files}")
  endif()
endfunction()
function(run_mesh)
  run("${prefix}/bin/omnimapper-graphslam" -i home_planes.ini -r "${prefix}/share/omnimapper/rawlogs/home_30s/home_30s.rawlog"
    -o "${SCRATCH}/mesh" -q --set "mapper.plugin_libraries=${SCRATCH}/mesh_output/libmesh_output.so"
    --set mapper.output_plugins=trajectory,mesh --set mesh.class=MeshOutput)
endfunction()
build("${EXAMPLES}/mesh_output" "${SCRATCH}/mesh_output" -DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=ON)
run_mesh()
expect_mesh(landmarks.obj)
file(READ "${SCRATCH}/mesh/landmarks.obj" plain)
if(NOT plain MATCHES "\no wall_0:[0-9]+\nv [-0-9. ]+\nv [-0-9. ]+\nv [-0-9. ]+\nf [0-9]+ [0-9]+ [0-9]+\n")
  message(FATAL_ERROR "landmarks.obj has no wall")
endif()
build("${EXAMPLES}/mesh_output" "${SCRATCH}/mesh_output" -DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=OFF)
run_mesh()
expect_mesh(landmarks.obj.gz)
execute_process(COMMAND gzip -dc "${SCRATCH}/mesh/landmarks.obj.gz" OUTPUT_VARIABLE unpacked COMMAND_ERROR_IS_FATAL ANY)
if(NOT unpacked STREQUAL plain)
  message(FATAL_ERROR "landmarks.obj.gz is not landmarks.obj")
endif()

# A format of logs from outside: the log of a robot as its text gives the same trajectory.
build("${EXAMPLES}/csv_log" "${SCRATCH}/csv_log")
set(box "${prefix}/share/omnimapper/rawlogs/box/box.rawlog")
run("${SCRATCH}/csv_log/to-csv" "${box}" "${SCRATCH}/box.csv")
file(READ "${EXAMPLES}/csv_log/csv_log.ini" text)
string(REPLACE "build/libcsv_log.so" "${SCRATCH}/csv_log/libcsv_log.so" text "${text}")
file(WRITE "${SCRATCH}/csv_log.ini" "${text}")
foreach(log "${box}" "${SCRATCH}/box.csv")
  get_filename_component(folder "${log}" EXT)
  run("${prefix}/bin/omnimapper-graphslam" -q -i "${SCRATCH}/csv_log.ini" -i laser2d.ini -r "${log}"
    -o "${SCRATCH}/as${folder}" --set mapper.output_plugins=trajectory)
endforeach()
file(READ "${SCRATCH}/as.rawlog/trajectory.tum" of_rawlog)
file(READ "${SCRATCH}/as.csv/trajectory.tum" of_text)
if(NOT of_text STREQUAL of_rawlog)
  message(FATAL_ERROR "the trajectory of box.csv is not that of box.rawlog")
endif()
# A line that cannot be read is named, and the rest is mapped.
file(APPEND "${SCRATCH}/box.csv" "odom,not,a,number,here\n")
execute_process(COMMAND "${prefix}/bin/omnimapper-graphslam" -q -i "${SCRATCH}/csv_log.ini" -i laser2d.ini
  -r "${SCRATCH}/box.csv" -o "${SCRATCH}/as.csv" --set mapper.output_plugins=trajectory
  RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result EQUAL 9 OR NOT error MATCHES "box.csv:[0-9]+: cannot be read, with 0 further lines")
  message(FATAL_ERROR "with a line that cannot be read, box.csv ended with ${result}:\n${error}")
endif()
# Without the library nothing recognizes it, and the message lists what is known.
execute_process(COMMAND "${prefix}/bin/omnimapper-graphslam" -q -i laser2d.ini -r "${SCRATCH}/box.csv" -o "${SCRATCH}/none"
  RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result EQUAL 8 OR NOT error MATCHES "text file of unknown kind.*rawlog, carmen_log")
  message(FATAL_ERROR "without its library box.csv ended with ${result}:\n${error}")
endif()

# A live page from outside, here for the time of a log; the rooms that it takes are those of the next example.
build("${EXAMPLES}/live_page" "${SCRATCH}/live_page")
file(READ "${EXAMPLES}/live_page/live_page.ini" text)
string(REPLACE "build/liblive_page" "${SCRATCH}/live_page/liblive_page" text "${text}")
file(WRITE "${SCRATCH}/live_page.ini" "${text}")

# A layer from outside: rooms that are named where their tags were read, and that a continued map still has.
build("${EXAMPLES}/rooms_layer" "${SCRATCH}/rooms_layer")
file(READ "${EXAMPLES}/rooms_layer/rooms.ini" text)
string(REPLACE "build/librooms_layer.so" "${SCRATCH}/rooms_layer/librooms_layer.so" text "${text}")
file(WRITE "${SCRATCH}/rooms.ini" "${text}")
set(box "${prefix}/share/omnimapper/rawlogs/box/box.rawlog")
run("${SCRATCH}/rooms_layer/tag-log" "${SCRATCH}/tags.rawlog" 1700000005.6 kitchen 1700000014.95 "living room, south")
run("${prefix}/bin/omnimapper-graphslam" -q -i "${SCRATCH}/rooms.ini" -r "${box}" -r "${SCRATCH}/tags.rawlog" -o "${SCRATCH}/named")
file(READ "${SCRATCH}/named/rooms.csv" rooms)
file(READ "${SCRATCH}/named/trajectory.tum" trajectory)
# Compared in whole centimetres.
string(REGEX MATCH "\n1700000005[.]60*,([-0-9]+)[.]([0-9][0-9])[0-9],.*,kitchen\n" room "${rooms}")
set(room_at "${CMAKE_MATCH_1}.${CMAKE_MATCH_2}")
string(REGEX MATCH "\n1700000005[.]60* ([-0-9]+)[.]([0-9][0-9])" pose "${trajectory}")
if(NOT room OR NOT room_at STREQUAL "${CMAKE_MATCH_1}.${CMAKE_MATCH_2}" OR NOT rooms MATCHES ",living room, south\n$")
  message(FATAL_ERROR "at 1700000005.6 the base was at '${pose}', and rooms.csv is:\n${rooms}")
endif()
run("${prefix}/bin/omnimapper-graphslam" -q -i "${SCRATCH}/live_page.ini" -r "${box}" -r "${SCRATCH}/tags.rawlog"
  -o "${SCRATCH}/paged" --set page.port=0 --set room_names.label=tags)
execute_process(COMMAND "${prefix}/bin/omnimapper-query" "${SCRATCH}/paged" layers OUTPUT_VARIABLE layers)
if(NOT layers MATCHES "room_tags")
  message(FATAL_ERROR "the map that was made with the live page has no layer of rooms:\n${layers}")
endif()
run("${SCRATCH}/rooms_layer/tag-log" "${SCRATCH}/more_tags.rawlog" 1700000008 office)
run("${prefix}/bin/omnimapper-graphslam" -q -i "${SCRATCH}/rooms.ini" -r "${box}" -r "${SCRATCH}/more_tags.rawlog"
  -o "${SCRATCH}/named" --continue "${SCRATCH}/named" --set session.start=origin)
file(READ "${SCRATCH}/named/rooms.csv" rooms)
if(NOT rooms MATCHES ",kitchen\n.*,living room, south\n.*,office\n$")
  message(FATAL_ERROR "after the map was continued, rooms.csv is:\n${rooms}")
endif()
file(REMOVE_RECURSE "${SCRATCH}")
