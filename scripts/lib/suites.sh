# Which tests run in which build, and how. Sourced, never run.
# shellcheck shell=bash

# The system tests: programs, installed package and scripts, optimized, as users have them.
readonly system_tests=(system system-mapping system-mapping-2 system-input system-live system-robust system-simulate system-perceive system-query system-viewer fuzz-runs-share package scripts)
# Unit tests that run only in the optimized build, except with --thorough. The simulator reads only its user's files and
# would take an eighth of the sanitizers' build. Calibration reads logs by the library source, which is tested under
# sanitizers, and its bundle adjustments would take minutes there. signs_simulated renders pictures.
readonly trusted_tests=(sim_world sim calibration signs_simulated)
# The unit tests of all other libraries, under the address and undefined-behaviour sanitizers.
readonly unit_tests=(drivers live net perception signs building plugins plugins-2 derived graph plugin mapper mapper-2 source matching geometry base obs interaction map query check eval fuzz)
# Left out: stock tools, which cannot load a library with a sanitizer; walks over every place (one seed remains), which
# take minutes; and false closures in Manhattan, which take half a minute (those of Intel and of a simulated town
# remain), an empty hall that is searched from four sides, and shuffled logs with loop closures (those without remain).
readonly address_cases='-StockTools.*:FalseClosuresInManhattanTest.*:WrongPlaces.AnEmptyHall*:ShuffledArrival.WithLoopClosures*:Generators.aRobotComesToEveryRoomAtAllLevelsOfClutter:Generators.planesAreExactInEveryPlace:PlacesAndSeeds/*_2'
# --thorough runs these too, and the system tests of hostile and damaged input.
readonly thorough_tests=("${trusted_tests[@]}" system-input system-robust fuzz-runs-share)
# The unit cases that a sanitizer forbids, and those that try more seeds, bytes, logs and places without one.
readonly release_tests=(obs-release source-release plugins-release plugins-release-2 graph-release mapper-release mapper-release-2)
readonly release_cases='StockTools.*:DamageTest.*:RawlogSourceTest.aLogIsReadWhileTheChildReads*:PcdCloudTest.*:FalseClosuresInManhattanTest.*:EngineRandom.*:ShuffledArrival.*:ShuffledArrival.WithLoopClosures*:WrongPlaces.AnEmptyHall*'
# The unit tests of threads, under the thread sanitizer.
readonly thread_tests=(live-threads drivers-threads source-threads mapper-threads mapper-threads-2)
readonly thread_cases='Hokuyo*:LiveSource*:Recorder*:*Queue*:*Pool*:*Engine*:ReadAhead*:MappingRun*'
