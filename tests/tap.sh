# SPDX-License-Identifier: GPL-3.0-or-later
# Test Anything Protocol, for the tests that are scripts. A script reads this file
# first, has a line printed for each assertion, and ends with `echo "1..$n"`.
#
# It finds the command as $hsr, and an empty folder as $dir, which is removed when
# it ends.
hsr=${HSR:?}
dir=$(mktemp -d "${TMPDIR:-/tmp}/hsr-test-XXXXXX") || exit 99
trap 'rm -rf "$dir"' EXIT
trap 'exit 99' HUP INT TERM
n=0

# ok STATUS DESCRIPTION: an assertion, which holds if the status is 0. If it does
# not, what a command left in the files out and err is shown.
ok() {
  n=$((n + 1))
  [ "$1" = 0 ] && echo "ok $n - $2" && return
  echo "not ok $n - $2"
  cat "$dir/out" "$dir/err" 2>/dev/null | sed 's/^/# /' | head -n 40
}

# skip DESCRIPTION WHY: one that cannot be made here
skip() {
  n=$((n + 1))
  echo "ok $n - $1 # SKIP $2"
}

# skip_all WHY: ends a script that can make none
skip_all() {
  echo "1..0 # SKIP $1"
  exit 0
}

# find_numpy: puts a python3 that has numpy first in PATH. False: there is none.
find_numpy() {
  for tap_path in "$PATH" "/usr/bin:$PATH"; do
    PATH=$tap_path python3 -c 'import numpy' 2>/dev/null || continue
    PATH=$tap_path
    return 0
  done
  return 1
}

# running PATTERN: whether a process has it among its words. A bare machine has no
# pgrep. A bracket in the pattern keeps it from matching itself.
running() {
  grep -qsa -e "$1" /proc/[0-9]*/cmdline
}

# none NUMBER DESCRIPTION: holds if there is no input, each line of which is a fault
none() {
  wrong=$(cat)
  [ -z "$wrong" ] && echo "ok $1 - $2" && return
  echo "$wrong" | sed 's/^/# /'
  echo "not ok $1 - $2"
}

# ends STATUS COMMAND...: whether the command ends so, with nothing on stderr if it
# is 0 or 1, else with one line "hsr: ..."; it leaves the files out and err.
ends() {
  tap_wanted=$1
  shift
  "$@" >"$dir/out" 2>"$dir/err" </dev/null
  tap_status=$?
  # The leak sanitizer prints this about threads that a fork leaves behind.
  sed -i '/was not suspended. False leaks/d' "$dir/err"
  [ $tap_status = "$tap_wanted" ] || {
    echo "# status $tap_status"
    return 1
  }
  [ "$tap_wanted" -gt 1 ] || {
    [ ! -s "$dir/err" ]
    return
  }
  [ "$(wc -l <"$dir/err")" = 1 ] && grep -q '^hsr: ' "$dir/err"
}

# run STATUS DESCRIPTION ARGUMENT...: that hsr ends so
run() {
  tap_wanted=$1 tap_what=$2
  shift 2
  ends "$tap_wanted" "$hsr" "$@"
  ok $? "$tap_what: exit $tap_wanted"
}

# refuses STATUS DESCRIPTION COMMAND...: that it ends so, and prints nothing else
refuses() {
  tap_wanted=$1 tap_what=$2
  shift 2
  ends "$tap_wanted" "$@" && [ ! -s "$dir/out" ]
  ok $? "$tap_what: exit $tap_wanted"
}

# has PATTERN DESCRIPTION: that the last command printed the pattern
has() {
  grep -q -e "$1" "$dir/out"
  ok $? "$2"
}

# needs_browser PAGE: skips all without node, chromium, or this page in $built
needs_browser() {
  command -v node >/dev/null || skip_all "node is not here"
  browser=$(command -v chromium || command -v chromium-browser) ||
    skip_all "chromium is not here"
  [ -f "$built/page/$1" ] || skip_all "built without the report"
}
