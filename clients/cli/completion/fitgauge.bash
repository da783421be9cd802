# bash completion for fitgauge(1): source it, or install it as
# /usr/share/bash-completion/completions/fitgauge.

_fitgauge() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local common='--server --key-file --ca --cert --cert-key --json --retry --help'
  local commands='limits fit gauge measure nc tables watch version completion'
  COMPREPLY=()

  # What the option before takes.
  case $previous in
    --server | --retry | --chunk | --count | --after | --set | --classes | --revision | --setup) return ;;
    --part-id | --characteristic | --order | --operation | --machine | --operator | --gauge) return ;;
    --unit | --measured-at | --temperature-c | --comment | --uncertainty-um | --coverage-factor) return ;;
    --rule) _fitgauge_words 'simple guard_band'; return ;;
    --format) _fitgauge_words 'csv json tab'; return ;;
    --source) _fitgauge_words 'gauge simulation all'; return ;;
    --on-stop) _fitgauge_words 'continue end'; return ;;
    --language) _fitgauge_words 'english german dutch italian'; return ;;
    --key-file | --ca | --cert | --cert-key | --state | --setup-file | --output | -o) _fitgauge_files; return ;;
  esac

  # The command and what follows it: the words that are neither options nor their values.
  local -a words=()
  local i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${COMP_WORDS[i]} in
      --json | --record | --again | --exit-verdict | --block-skip) ;;
      -*) ((++i)) ;;
      *) words+=("${COMP_WORDS[i]}") ;;
    esac
  done

  local options=
  case ${words[0]-} in
    '') _fitgauge_words "$commands $common --version"; return ;;
    gauge)
      options='--rule --uncertainty-um --coverage-factor --record --part-id --characteristic --order
               --operation --machine --operator --gauge --unit --measured-at --temperature-c --comment' ;;
    measure) options='--state --chunk --again --exit-verdict' ;;
    watch) options='--source --after --count' ;;
    completion) ((${#words[@]} > 1)) || options=bash ;;
    tables)
      case ${words[1]-} in
        '') options=export ;;
        export)
          options='--classes --revision --output --format'
          ((${#words[@]} > 2)) || options+=' hole shaft' ;;
      esac ;;
    nc)
      case ${words[1]-} in
        '') options='check run put get ls' ;;
        run) options='--setup --setup-file --set --on-stop --language --block-skip' ;;
      esac ;;
  esac
  case ${words[*]} in
    measure | nc\ put | nc\ put\ * | nc\ get\ *) [[ $word == -* ]] || { _fitgauge_files; return; } ;;
  esac
  _fitgauge_words "$options $common"
}

# Offers those of the words that begin with what is typed; options only behind a dash.
_fitgauge_words() {
  local candidate
  for candidate in $1; do
    [[ $candidate == -* && $word != -* ]] && continue
    [[ $candidate == "$word"* ]] && COMPREPLY+=("$candidate")
  done
}

_fitgauge_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$word")
}

complete -F _fitgauge fitgauge
