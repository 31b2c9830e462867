# Configures and builds. Sourced, never run.
# shellcheck shell=bash

# What one checkout has compiled serves the next one too.
export CCACHE_BASEDIR=$project_root CCACHE_NOHASHDIR=yes

# Compilers at once: one for each core, as far as 1.5 GiB for each goes. OMNIMAPPER_JOBS overrides.
build_jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable/ { print int($2 / 1572864) }' /proc/meminfo)
  [ "$memory" -ge 1 ] || memory=1
  echo "${OMNIMAPPER_JOBS:-$((cores < memory ? cores : memory))}"
}

# configure FOLDER [CMAKE-ARGUMENT...]: build/FOLDER.
configure() {
  local folder=$1
  shift
  say "Configuring build/$folder"
  cmake -S "$project_root" -B "$project_root/build/$folder" -G Ninja --log-level=NOTICE "$@"
}

# build FOLDER [TARGET...]: all of it, or the targets named.
build() {
  local folder=$1 jobs
  shift
  jobs=$(build_jobs)
  say "Building build/$folder with $jobs jobs"
  ninja -C "$project_root/build/$folder" -j "$jobs" "$@"
}
