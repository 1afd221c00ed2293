# Completion of holomorph for bash: commands, and what `--help` says of their options.
_holomorph() {
  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]}
  if [ "$COMP_CWORD" -eq 1 ] && [[ $word != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "map inverse coordinates render info new export bench" -- "$word"; compgen -f -- "$word")
  elif [[ $word == -* ]]; then
    [ "$COMP_CWORD" -gt 1 ] || command=
    # shellcheck disable=SC2086
    mapfile -t COMPREPLY < <(compgen -W "$(holomorph $command --help 2>/dev/null | grep -oE -- '--[a-z-]+')" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -o filenames -F _holomorph holomorph
