# What the benches share: recordings, logs and maps to measure on, numbers of JSON files. Sourced after common.sh, never
# run; what makes logs and maps needs build.sh, too.
# shellcheck shell=bash

bin=$project_root/build/release/bin
data=${OMNIMAPPER_DATA:-$project_root/../shared/data}
mrpt=/usr/share/mrpt/datasets
bench_out=$project_root/out/bench
# shellcheck disable=SC2034 # mrpt is for the scripts
readonly bin data mrpt bench_out

# field NAME FILE: a number of a JSON file, NAME as OBJECT.NAME.
field() { python3 -c 'import functools, json, sys
print(functools.reduce(lambda d, k: d[k], sys.argv[1].split("."), json.load(open(sys.argv[2]))))' "$1" "$2"; }

# list_benches: the programs of tests/bench.
list_benches() { sed -n 's/^ *omnimapper_bench(\([a-z0-9_]*\).*/\1/p' tests/bench/CMakeLists.txt | sort; }

# bench_comment NAME: the comment at the top of the program, or of the script scripts/bench-NAME.
bench_comment() {
  if [ -e "tests/bench/$1.cpp" ]; then
    sed -n '/^\/\//!q; s/^\/\/ \{0,1\}//p' "tests/bench/$1.cpp"
  else
    print_help "scripts/bench-$1"
  fi
}

# default_arguments NAME: how tests/bench/arguments.txt says that the program runs.
default_arguments() { sed -n "s/^$1\( \|\$\)//p" tests/bench/arguments.txt; }

# make_input PATH COMMAND...: prints PATH, which the command has made now or earlier, by a program of the project.
make_input() {
  local path=$1
  shift
  if [ ! -e "$path" ]; then
    mkdir -p "$(dirname "$path")"
    { build release libs/all "app-$1" && "$bin/$1" "${@:2}"; } >&2 || return 1
  fi
  echo "$path"
}

# recording PATH: the path of a recording. Fails where it is not on this machine.
recording() {
  [ -e "$data/$1" ] || { echo "the recording $1 is not there" >&2; return 1; }
  echo "$data/$1"
}

# bench_input WORD BENCH: what a word of tests/bench/arguments.txt stands for, made where it is missing.
bench_input() {
  local inputs=$bench_out/inputs folder
  case "$1" in
    @out) echo "$bench_out/$2" ;;
    @bin) echo "$bin" ;;
    @data/*) recording "${1#@data/}" ;;
    @aces | @intel)
      folder=$(recording "laser2d/${1#@}.clf.bz2") &&
        make_input "$inputs/${1#@}.rawlog" omnimapper-import carmen "$folder" "$inputs/${1#@}.rawlog" ;;
    @rpy)
      folder=$(recording rgbd/tum_fr1_rpy) &&
        make_input "$inputs/rpy.rawlog" omnimapper-import tum "$folder" "$inputs/rpy.rawlog" ;;
    @map_of_aces)
      folder=$(bench_input @aces "$2") &&
        make_input "$inputs/map_of_aces" omnimapper-graphslam -q -i ini/laser2d.ini -r "$folder" -o "$inputs/map_of_aces" ;;
    @home | @office | @laboratory)
      make_input "$inputs/${1#@}" omnimapper-simulate -q -i "rawlogs/${1#@}.ini" -o "$inputs/${1#@}" ;;
    @signs_30)
      make_input "$inputs/signs_30" omnimapper-simulate -q -i rawlogs/signs_30.ini --set simulation.sensors=camera \
        -o "$inputs/signs_30" ;;
    @read_signs_30)
      folder=$(bench_input @signs_30 "$2") &&
        make_input "$inputs/read_signs_30.rawlog" omnimapper-perceive -i ini/signs.ini -r "$folder/signs_30.rawlog" \
          -o "$inputs/read_signs_30.rawlog" ;;
    *) echo "tests/bench/arguments.txt names $1, which scripts/lib/bench.sh does not know" >&2; return 1 ;;
  esac
}
