# Bash completion for holomorph: commands, their options as listed by `--help`, and the values of some options.
_holomorph() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words=
  case $before in
    --format) words="obj svg npy png stmap unwarp-map unwarp textured glb godot godot3 spine mdd pc2 psd ora drawing webp gif apng mp4 webm" ;;
    --view) words="image angle area stretch checker" ;;
    --flattening) words="lscm circle" ;;
    --frames) words="all" ;;
    --engine) words="slurm" ;;
    --depth) words="8 16 32" ;;
    --time | --scale | --overscan | --rate | --order | --detail | --vertices | --margin | --filter | --rect | --chunk | --rounds | --max-*) return ;;
  esac
  if [ -n "$words" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  elif [ "$COMP_CWORD" -eq 1 ] && [[ $word != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "map inverse coordinates render farm info new update export formats bench" -- "$word"; compgen -f -- "$word")
  elif [[ $word == -* ]]; then
    [ "$COMP_CWORD" -gt 1 ] || command=
    # shellcheck disable=SC2086
    mapfile -t COMPREPLY < <(compgen -W "$(holomorph $command --help 2>/dev/null | grep -oE -- '--[a-z-]+' | sort -u)" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -o filenames -F _holomorph holomorph
