# Which tests run in which build, and how. Sourced, never run.
# shellcheck shell=bash

# The system tests: programs, installed package and scripts, optimised, as users have them.
readonly system_tests=(system system-mapping system-input system-robust system-simulate system-perceive package scripts)
# The unit tests of all libraries, under the address and undefined-behaviour sanitizers.
readonly unit_tests=(perception sim plugins graph mapper source matching geometry base obs map check eval fuzz)
# Left out: stock tools, which cannot load a library built with a sanitizer, and walks over every place, which would take
# minutes; of those one seed is left.
readonly address_cases='-StockTools.*:Generators.aRobotComesToEveryRoomAtAllLevelsOfClutter:Generators.planesAreExactInEveryPlace:PlacesAndSeeds/*_1'
# The unit cases that a sanitizer forbids, or that say more without one: more seeds, bytes, logs and places.
readonly release_tests=(obs source mapper sim)
readonly release_cases='StockTools.*:DamageTest.*:RawlogSourceTest.aLogWithoutChecksum*:PcdCloudTest.aHeaderThatClaims*:EngineRandom.*:ShuffledArrival.*:Generators.aRobotComesToEveryRoomAtAllLevelsOfClutter:Generators.planesAreExactInEveryPlace:PlacesAndSeeds/*'
# The unit tests of threads, under the thread sanitizer.
readonly thread_tests=(source mapper)
readonly thread_cases='*Queue*:*Pool*:*Engine*:ReadAhead*:MappingRun*'

set_sanitizer_options() {
  local suppressions=$project_root/scripts/lib/suppressions
  export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1:malloc_context_size=12
  export LSAN_OPTIONS=suppressions=$suppressions/leak.txt:print_suppressions=0
  export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1:suppressions=$suppressions/undefined.txt
  export TSAN_OPTIONS=halt_on_error=1:suppressions=$suppressions/thread.txt:print_suppressions=0
}

# Runs a command with a fixed memory layout where the kernel lets us: the sanitizers of gcc 12 and clang 14 cannot start
# under the wide random layouts of newer kernels.
with_fixed_layout() {
  if setarch -R true 2>/dev/null; then setarch -R "$@"; else "$@"; fi
}
