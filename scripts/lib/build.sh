# Configures and builds. Sourced, never run.
# shellcheck shell=bash

# Unity files name their sources by absolute path, so the compiler cache serves another checkout only in the same
# folder.
export CCACHE_BASEDIR=$project_root CCACHE_NOHASHDIR=yes
# ccache takes the list of included files from the compiler, so that nothing is preprocessed twice.
export CCACHE_DEPEND=yes

# Compilers at once: one for each core, as far as 2 GiB for each goes. OMNIMAPPER_JOBS overrides.
build_jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable/ { print int($2 / 2097152) }' /proc/meminfo)
  [ "$memory" -ge 1 ] || memory=1
  echo "${OMNIMAPPER_JOBS:-$((cores < memory ? cores : memory))}"
}

# What build/release holds beside mapping: nothing, the simulator, or the simulator and the tests.
readonly without_simulator=(-DOMNIMAPPER_BUILD_SIMULATOR=OFF -DOMNIMAPPER_BUILD_TESTS=OFF -DOMNIMAPPER_BUILD_BENCH=OFF)
readonly with_simulator=(-DOMNIMAPPER_BUILD_SIMULATOR=ON -DOMNIMAPPER_BUILD_TESTS=OFF)
readonly with_tests=(-DOMNIMAPPER_BUILD_SIMULATOR=ON -DOMNIMAPPER_BUILD_TESTS=ON)

is_configured() { [ -e "$project_root/build/$1/build.ninja" ]; }

# configure FOLDER [CMAKE-ARGUMENT...]: configures build/FOLDER. A new folder is set up for the fastest complete build;
# an existing one keeps its settings, so that a developer can choose them.
configure() {
  local folder=$1 unity=()
  shift
  is_configured "$folder" || unity=(-DOMNIMAPPER_UNITY=ON)
  say "Configuring build/$folder"
  cmake -S "$project_root" -B "$project_root/build/$folder" -G Ninja --log-level=NOTICE "${unity[@]}" "$@"
}

# build FOLDER [TARGET...]: all of it, or the targets named.
build() {
  local folder=$1 jobs
  shift
  jobs=$(build_jobs)
  say "Building build/$folder with $jobs jobs"
  ninja -C "$project_root/build/$folder" -j "$jobs" "$@"
}

# has_option FOLDER NAME: whether build/FOLDER is set up with OMNIMAPPER_NAME.
has_option() { grep -qs "^OMNIMAPPER_$2:BOOL=ON" "$project_root/build/$1/CMakeCache.txt"; }

# choose_release none|simulator: sets release_options and release_packages for a build/release that holds at least that.
# An existing folder keeps its settings, and the packages include those that they need.
choose_release() {
  release_options=("${without_simulator[@]}")
  release_packages=(scripts/packages.txt)
  if has_option release BUILD_TESTS; then
    release_options=("${with_tests[@]}")
    release_packages+=(scripts/packages-simulator.txt scripts/packages-test.txt)
  elif [ "$1" = simulator ] || has_option release BUILD_SIMULATOR; then
    release_options=("${with_simulator[@]}")
    release_packages+=(scripts/packages-simulator.txt)
  fi
}
