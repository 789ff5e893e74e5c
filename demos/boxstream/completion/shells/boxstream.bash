# SPDX-License-Identifier: MIT
# Completion of boxstream in bash: the program that is typed says itself what fits.
_boxstream() {
  local word words=() lines value begun IFS=$'\n'
  # To bash "--json=FILE" is three words.
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
    if [[ ${#words[@]} -gt 0 && ($word == = || ${words[-1]} == --*=) ]]; then
      words[-1]+=$word
    else
      words+=("$word")
    fi
  done
  mapfile -t lines < <("${COMP_WORDS[0]}" complete -- "${words[@]}" 2>/dev/null)
  begun=${words[-1]}
  COMPREPLY=()
  for word in "${lines[@]:1}"; do
    value=${word%%$'\t'*}
    [[ $begun != *=* || $COMP_WORDBREAKS != *=* ]] || value=${value#"${begun%=*}="}
    COMPREPLY+=("$value")
  done
  [[ ${#COMPREPLY[@]} -ne 1 || ${COMPREPLY[0]} != *[=/] ]] || compopt -o nospace
  case ${lines[0]} in
    files) compopt -o filenames && mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "${2#=}") ;;
    directories) compopt -o filenames && mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "${2#=}") ;;
  esac
}
complete -F _boxstream boxstream
