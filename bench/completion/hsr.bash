# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of hsr in bash: commands, options, algorithms, scenes, files. All
# words come from hsr itself.
_hsr() {
  local hsr=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} commands
  local before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  commands=$("$hsr" --help 2>/dev/null | awk '$1 == "hsr" && NF > 3 { print $2 }' | sort -u)
  if [ "$COMP_CWORD" = 1 ]; then
    COMPREPLY=($(compgen -W "$commands help --version" -- "$word"))
  elif [ "$command" = help ]; then
    COMPREPLY=($(compgen -W "$commands" -- "$word"))
  elif [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$("$hsr" help "$command" 2>/dev/null |
      grep -oE -- '--[a-z][a-z-]*' | sort -u)" -- "$word"))
  elif [[ $before == -a || $before == --algorithm || $before == --algorithms ]]; then
    # the last of several names, divided by commas
    local first=
    [[ $word == *,* ]] && first=${word%,*},
    COMPREPLY=($(compgen -P "$first" -W "$("$hsr" list 2>/dev/null |
      awk 'NR > 1 && !NF { exit } NR > 1 { print $1 }')" -- "${word##*,}"))
  else
    case $command in
    render | check | bench | stats | trace | voxels)
      COMPREPLY=($(compgen -W "$("$hsr" scenes 2>/dev/null |
        awk 'NR > 1 && !NF { exit } NR > 1 { sub(/[:\[].*/, "", $1); print $1 }')" \
        -- "$word")) ;;
    esac
    COMPREPLY+=($(compgen -f -- "$word"))
  fi
}
complete -o filenames -o bashdefault -F _hsr hsr
