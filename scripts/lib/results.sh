# Counts what ran: test cases of GoogleTest binaries, and each other ctest test as one. Sourced, never run.
# shellcheck shell=bash

# Lines "state<TAB>case<TAB>message<TAB>seconds" of GoogleTest's XML files; state is passed, failed or skipped.
list_cases() {
  awk '
    function attribute(name,   rest) {
      if (!match($0, " " name "=\"[^\"]*\"")) return ""
      rest = substr($0, RSTART + length(name) + 3, RLENGTH - length(name) - 4)
      gsub(/&#x0A;/, " ", rest); gsub(/&quot;/, "\"", rest); gsub(/&apos;/, "\047", rest)
      gsub(/&lt;/, "<", rest); gsub(/&gt;/, ">", rest); gsub(/&amp;/, "\\&", rest)
      return rest
    }
    function flush_case() { if (state != "") print state "\t" test "\t" message "\t" seconds; state = "" }
    /<testcase / {
      flush_case()
      test = attribute("classname") "." attribute("name"); message = ""; seconds = attribute("time")
      result = attribute("result")
      state = result == "skipped" ? "skipped" : (result == "completed" ? "passed" : "")
    }
    /<failure / { state = "failed"; message = attribute("message") }
    /<skipped / { message = attribute("message"); sub(/^[^ ]*:[0-9]+ /, "", message) }
    /<\/testsuites>/ { flush_case() }
  ' "$@"
}

# The same lines from ctest's own JUnit file, one for each of its tests.
list_ctest_tests() {
  awk '
    /<testcase / {
      match($0, /name="[^"]*"/); name = substr($0, RSTART + 6, RLENGTH - 7)
      match($0, /status="[^"]*"/); status = substr($0, RSTART + 8, RLENGTH - 9)
      match($0, / time="[^"]*"/); seconds = substr($0, RSTART + 7, RLENGTH - 8)
      print (status == "run" ? "passed" : (status == "fail" ? "failed" : "skipped")) "\t" name "\t" status "\t" seconds
    }
  ' "$1"
}

# collect_results FOLDER: every case of the run whose files are in FOLDER (ctest.xml, test-NAME.xml).
# A program that ended badly without a failed case (crash, sanitizer report), or without any case, adds a failed case.
# Tests that are no GoogleTest programs (package, scripts) count as one case each.
collect_results() {
  local folder=$1 state name seconds cases
  list_ctest_tests "$folder/ctest.xml" | while IFS=$'\t' read -r state name _ seconds; do
    if [ ! -e "$folder/test-$name.xml" ]; then
      case "$state $name" in
        "passed package" | "passed scripts") printf 'passed\t%s\t\t%s\n' "$name" "$seconds" ;;
        *) printf 'failed\t%s\tended without a count of its cases\t%s\n' "$name" "$seconds" ;;
      esac
      continue
    fi
    cases=$(list_cases "$folder/test-$name.xml")
    if [ -n "$cases" ]; then
      printf '%s\n' "$cases"
    else
      printf 'failed\t%s\tran no case\t0\n' "$name"
    fi
    if [ "$state" = failed ] && ! grep -q '^failed' <<<"$cases"; then
      printf 'failed\t%s\tended badly after its last case\t0\n' "$name"
    fi
  done
}

count_state() { awk -F '\t' -v state="$1" '$1 == state { ++n } END { print n + 0 }' "$2"; }

# slowest COUNT FILE: the slowest cases among lines "build<TAB>state<TAB>case<TAB>message<TAB>seconds".
slowest() {
  sort -t $'\t' -k 5,5 -rg "$2" |
    awk -F '\t' -v count="$1" 'NR <= count { printf "%6.1f s  %s: %s\n", $5, $1, $3 }'
}
