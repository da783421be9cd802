# bash completion for fitgauge(1): source it, or install it as
# /usr/share/bash-completion/completions/fitgauge.

_fitgauge() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local common='--server --key-file --ca --cert --cert-key --json --retry --help'
  local commands='limits fit fits limit-gauge standards gauge import list export summary capability chart statistics
    correct note plan nc setups budgets gauges studies runs control replay tables watch version completion'
  COMPREPLY=()

  # What the option before takes.
  case $previous in
    --server | --retry | --chunk | --count | --after | --set | --classes | --revision) return ;;
    --part-id | --characteristic | --order | --operation | --machine | --operator | --gauge) return ;;
    --unit | --measured-at | --temperature-c | --comment | --pattern | --uncertainty-um | --coverage-factor) return ;;
    --probability | --part-material | --part-expansion | --scale-temperature-c) return ;;
    --scale-material | --scale-expansion | --temperature-uncertainty-c) return ;;
    --part-expansion-uncertainty | --scale-temperature-uncertainty-c | --scale-expansion-uncertainty) return ;;
    --degrees-of-freedom | --size-operator) return ;;
    --quantity) _fitgauge_words 'diameter width pitch_diameter position distance radius chamfer deviation'; return ;;
    --envelope) _fitgauge_words 'required'; return ;;
    --go-gauge) _fitgauge_words 'passes fails'; return ;;
    --inside-corner) _fitgauge_words 'true'; return ;;
    --from | --to | --limit | --reason | --program | --upper-um | --lower-um | --offset-um | --group-by) return ;;
    --min-um | --max-um | --size-mm | --lower | --upper | --reference | --tolerance) return ;;
    --designation | --tolerance-class | --caller | --subgroup | --tool | --confirmed | --target-mm | --confidence | --rules) return ;;
    --kind) _fitgauge_words 'i_mr xbar_r xbar_s ewma cusum'; return ;;
    --subgroups) _fitgauge_words 'use ignore'; return ;;
    --map | --time-zone) return ;;
    --encoding) _fitgauge_words 'auto utf-8 utf-16 windows-1252'; return ;;
    --verdict) _fitgauge_words 'good rework reject indeterminate'; return ;;
    --history) _fitgauge_words 'current all'; return ;;
    --feature) _fitgauge_words 'hole shaft'; return ;;
    --status) _fitgauge_words 'queued running completed stopped failed limit_exceeded cancelled'; return ;;
    --rule) _fitgauge_words 'simple guard_band conformance'; return ;;
    --format)
      case " ${COMP_WORDS[*]} " in
        *' tables '*) _fitgauge_words 'csv json tab' ;;
        *) _fitgauge_words 'csv ndjson dfq qif xlsx' ;;
      esac
      return ;;
    --source) _fitgauge_words 'gauge simulation all'; return ;;
    --on-stop) _fitgauge_words 'continue end'; return ;;
    --language) _fitgauge_words 'english german dutch italian polish'; return ;;
    --baud) _fitgauge_words '1200 2400 4800 9600 19200 38400 57600 115200'; return ;;
    --setup) [[ " ${COMP_WORDS[*]} " == *' replay '* ]] || _fitgauge_files; return ;;
    --serial | --key-file | --ca | --cert | --cert-key | --state | --setup-file | --files-to | --contacts | --output | -o) _fitgauge_files; return ;;
  esac

  # The command and what follows it: the words that are neither options nor their values.
  local -a words=()
  local i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${COMP_WORDS[i]} in
      --json | --record | --again | --exit-verdict | --leave-out-others | --block-skip | --force | --from-control | --in-place) ;;
      -*) ((++i)) ;;
      *) words+=("${COMP_WORDS[i]}") ;;
    esac
  done

  local options=
  local filters='--part-id --characteristic --order --operation --machine --operator --gauge --unit --subgroup --tool
                 --tolerance-class --caller --designation --verdict --source --from --to --history'
  case ${words[0]-} in
    '') _fitgauge_words "$commands $common --version"; return ;;
    gauge)
      options='--rule --uncertainty-um --coverage-factor --probability --part-material --part-expansion
               --scale-temperature-c --scale-material --scale-expansion --temperature-uncertainty-c
               --part-expansion-uncertainty --scale-temperature-uncertainty-c --scale-expansion-uncertainty --record
               --part-id --characteristic --order --operation --machine --operator --gauge --unit --subgroup --tool --offset-um --confirmed --measured-at --temperature-c --comment --feature --upper-um --lower-um
               --degrees-of-freedom --quantity --size-operator --envelope --go-gauge --inside-corner
               --serial --baud --pattern' ;;
    import | measure) options='--state --chunk --map --set --time-zone --length-unit --encoding --leave-out-others --again --exit-verdict' ;;
    list) options="$filters --limit --after" ;;
    export) options="$filters --format --time-zone --output" ;;
    summary) options="$filters --group-by" ;;
    fit) options='--hole --shaft --subgroups' ;;
    capability) options="$filters --target-mm --confidence --subgroups" ;;
    chart) options="$filters --kind --rules --subgroups" ;;
    correct) options='--reason' ;;
    note) options='--cause --action --measure --text --operator' ;;
    fits) options='--min-um --max-um --limit' ;;
    standards)
      options=--size-mm
      ((${#words[@]} > 1)) || options+=' iso2768-1 iso965-1 din6885-1 iso492' ;;
    statistics)
      options='--lower --upper --reference --tolerance'
      ((${#words[@]} > 1)) || options+=' summary anova capability chart type1 grr pairing uncertainty' ;;
    plan)
      options='--part'
      ((${#words[@]} > 1)) || options+=' from' ;;
    setups | budgets | gauges | studies) ((${#words[@]} > 1)) || options='ls put get rm' ;;
    runs)
      case ${words[1]-} in
        '') options='ls show get cancel' ;;
        ls) options='--status --program --limit --after' ;;
      esac ;;
    control)
      case ${words[1]-} in
        '') options='ls get put run state' ;;
        get | put) options=--force ;;
      esac ;;
    replay) options='--contacts --setup --setup-file' ;;
    watch) options='--source --after --count' ;;
    completion) ((${#words[@]} > 1)) || options='bash fish zsh' ;;
    tables)
      case ${words[1]-} in
        '') options='export set reset' ;;
        set | reset) ((${#words[@]} > 2)) || options='hole shaft' ;;
        export)
          options='--classes --revision --output --format'
          ((${#words[@]} > 2)) || options+=' hole shaft' ;;
      esac ;;
    nc)
      case ${words[1]-} in
        '') options='check format convert lsp run put get ls' ;;
        check) options='--from-control --format --level --setup --set' ;;
        format) options='--in-place --from-control' ;;
        lsp) options=--level ;;
        convert) options='--from-control --force' ;;
        get) options=--force ;;
        run) options='--from-control --files-to --force --setup --setup-file --set --on-stop --language --part-id --order --block-skip' ;;
      esac ;;
  esac
  case ${words[*]} in
    import | measure | tables\ set\ *\ * | plan\ from\ * | nc\ check\ * | nc\ format\ * | nc\ check | nc\ format | nc\ convert | nc\ convert\ * | nc\ run | nc\ run\ * | nc\ put | nc\ put\ * | nc\ get\ * | setups\ put\ * | setups\ get\ * | budgets\ put\ * | budgets\ get\ * | gauges\ put\ * | gauges\ get\ * | studies\ put\ * | studies\ get\ * | statistics\ * | control\ put\ * | control\ get\ *\ * | replay\ *) [[ $word == -* ]] || { _fitgauge_files; return; } ;;
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
