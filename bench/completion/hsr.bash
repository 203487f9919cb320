# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of hsr in bash. All words come from hsr itself.
_hsr() {
  # COMP_WORDS is divided at colons and =, which names have: mesh:elephant
  local line=${COMP_LINE:0:COMP_POINT} offered word list
  read -r -a list <<<"$line"
  [[ $line == *[[:space:]] ]] && list+=("")
  word=${list[${#list[@]} - 1]}
  COMPREPLY=()
  while IFS= read -r offered; do
    case $offered in
    :files) COMPREPLY+=($(compgen -f -- "${word#--*=}")) ;;
    ":files "*) COMPREPLY+=($(compgen -f -X "!*${offered#:files }" -- "${word#--*=}")) ;;
    *) COMPREPLY+=("$offered") ;;
    esac
  done < <("${COMP_WORDS[0]}" complete "${list[@]:1}" 2>/dev/null)
  # bash keeps what stands before the last colon or =
  COMPREPLY=("${COMPREPLY[@]#"${word%"${word##*[:=]}"}"}")
  [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *[=:] ]] && compopt -o nospace
  return 0
}
complete -o filenames -o bashdefault -F _hsr hsr
