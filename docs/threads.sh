#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# How long two threads take against one: a row of Markdown for each module, with
# the least of several times of drawing, in ms, and their ratio.
#
#   threads.sh SCENE SIZE RUNS MODULE...       as: threads.sh harbor 1024x1024 5 watkins
set -u
scene=$1 size=$2 runs=$3
shift 3

# least MODULE THREADS: of the times that hsr render prints.
least() {
  for _ in $(seq "$runs"); do
    hsr render "$scene" -s "$size" -a "$1" -J "$2" | tr '\n' ' ' |
      sed -n 's/.* render  *\([0-9.]*\),.*/\1/p'
  done | sort -n | head -n 1
}

echo '| module | one | two | ratio |'
echo '|---|---|---|---|'
for module; do
  one=$(least "$module" 1) two=$(least "$module" 2)
  awk -v m="$module" -v a="$one" -v b="$two" \
    'BEGIN { printf "| `%s` | %.1f | %.1f | %.2f |\n", m, a, b, b / a }'
done
