# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of hsr in bash: commands, options, algorithms, scenes, files. All
# words come from hsr itself.
_hsr() {
  local hsr=${COMP_WORDS[0]} command=${COMP_WORDS[1]} words first=
  local before=${COMP_WORDS[COMP_CWORD - 1]}
  # COMP_WORDS is divided at colons, which names have: mesh:elephant
  local line=${COMP_LINE:0:COMP_POINT} word
  word=${line##*[[:space:]]}
  COMPREPLY=()
  if [ "$COMP_CWORD" = 1 ] || { [ "$COMP_CWORD" = 2 ] && [ "$command" = help ]; }; then
    words="$("$hsr" --help 2>/dev/null |
      awk '$1 == "hsr" && NF > 3 { print $2 }' | sort -u) help"
    [[ $word == -* ]] && words="--help --version --cite"
  elif [[ $word == -* ]]; then
    words=$("$hsr" help "$command" 2>/dev/null |
      grep -oE -- '--[a-z][a-z-]*' | sort -u)
  elif [[ $before == -a || $before == --algorithm || $before == --algorithms ]]; then
    words=$("$hsr" list 2>/dev/null |
      awk 'NR > 1 && !NF { exit } NR > 1 { print $1 }')
    # the last of several names, divided by commas
    [[ $word == *,* ]] && first=${word%,*},
  elif [[ $command == suite && $before == --scenes ]]; then
    words=$("$hsr" suite --list 2>/dev/null | awk '{ print $1; print $2 }' | sort -u)
    [[ $word == *,* ]] && first=${word%,*},
  elif [[ $before == --palette ]]; then
    words=$("$hsr" list 2>/dev/null |
      awk 'palettes { print $1 } /^Palettes/ { palettes = 1 }')
    COMPREPLY=($(compgen -f -X '!*.json' -- "$word"))
  else
    case $command in
    render | view | scenes | export | check | bench | stats | trace | lesson | lab | voxels | areas | errors | judge)
      words=$("$hsr" scenes 2>/dev/null | awk 'NR == 1 { next }
        !NF { meshes = 1 }
        !meshes { sub(/[:\[].*/, "", $1); print $1 }
        meshes && /^  / { for (k = 1; k <= NF; k++) if ($k ~ /:/) print $k }') ;;
    esac
    COMPREPLY=($(compgen -f -- "$word"))
  fi
  COMPREPLY+=($(compgen -P "$first" -W "$words" -- "${word##*,}"))
  # bash keeps what stands before the last colon
  COMPREPLY=("${COMPREPLY[@]#"${word%"${word##*:}"}"}")
}
complete -o filenames -o bashdefault -F _hsr hsr
