# Which tests run under which sanitizer, and how. Sourced, never run.
# shellcheck shell=bash

# Address and undefined behaviour: the libraries from the bottom up to the engine.
readonly address_tests=(base geometry obs source perception matching graph map mapper sim fuzz)
# Programs of others cannot load a library of ours that is built with a sanitizer. Walks over every place take minutes
# with one: left are those over one seed.
readonly address_filter='-StockTools.*:Generators.aRobotComesToEveryRoomAtAllLevelsOfClutter:Generators.planesAreExactInEveryPlace:PlacesAndSeeds/*_2'
# Threads: what shares data between them.
readonly thread_tests=(source mapper)
readonly thread_filter='*Queue*:*Pool*:*Engine*:ReadAhead*:MappingRun*'

# Those of the named tests that exist.
existing_tests() {
  local name
  for name in "$@"; do
    [ ! -e "$project_root/tests/$name/CMakeLists.txt" ] || echo "$name"
  done
}

set_sanitizer_options() {
  local suppressions=$project_root/scripts/lib/suppressions
  export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1
  export LSAN_OPTIONS=suppressions=$suppressions/leak.txt:print_suppressions=0
  export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1:suppressions=$suppressions/undefined.txt
  export TSAN_OPTIONS=halt_on_error=1:suppressions=$suppressions/thread.txt:print_suppressions=0
}

# Runs a command with a fixed memory layout where the kernel lets us: the sanitizers of gcc 12 cannot start under the
# wide random layouts of newer kernels.
with_fixed_layout() {
  if setarch -R true 2>/dev/null; then setarch -R "$@"; else "$@"; fi
}
