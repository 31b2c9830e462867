# How programs run that are built with a sanitizer. Sourced, never run.
# shellcheck shell=bash

set_sanitizer_options() {
  local folder=$project_root/scripts/lib/suppressions
  export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1:malloc_context_size=12
  # Quoted for the sanitizers, too: the name of the folder may hold a space or a colon.
  export LSAN_OPTIONS="suppressions='$folder/leak.txt':print_suppressions=0"
  export UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1:suppressions='$folder/undefined.txt'"
  export TSAN_OPTIONS="halt_on_error=1:suppressions='$folder/thread.txt':print_suppressions=0"
}

# Runs a command with a fixed memory layout where the kernel lets us: the sanitizers of gcc 12 and clang 14 cannot start
# under the wide random layouts of newer kernels.
with_fixed_layout() {
  if setarch -R true 2>/dev/null; then setarch -R "$@"; else "$@"; fi
}
