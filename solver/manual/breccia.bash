# Completion of breccia(1) for bash 4.4 or newer; needs no other package. Commands, options, their values and the keys of a case
# are read from the program's own help, by one call for each completion.

# words: the command line up to the cursor, with what bash cut at "=" and ":" put together again.
# cur: the word, or the value after "--option=", that is to be completed; head: what stands before cur in its word;
# option: the option whose value cur may be.
_breccia_read_line() {
  local word glued=
  words=()
  for word in "${COMP_WORDS[@]:0:COMP_CWORD+1}"; do
    if ((${#words[@]} > 1)) && [[ -n $word && ($glued || $word =~ ^[=:]+$) ]]; then
      words[-1]+=$word
    else
      words+=("$word")
    fi
    [[ $word =~ ^[=:]+$ ]] && glued=yes || glued=
  done
  cur=${words[-1]}
  head=
  case $cur in
    --*=*) option=${cur%%=*} head=${cur%%=*}= cur=${cur#*=} ;;
    -*) option= ;;
    *) option=${words[-2]} ;;
  esac
  if [[ $cur == [\"\']* ]]; then cur=${cur:1}; else cur=${cur//\\/}; fi
}

# Calls the program that is being completed, never with the user's input.
_breccia_ask() {
  "$program" "$@" 2>/dev/null </dev/null
}

# The first column below a heading of the help: names of (sub-)commands.
_breccia_listed() {
  local line name inside=
  while IFS= read -r line; do
    if [[ ${line,,} == "$1" ]]; then inside=yes; continue; fi
    [[ $inside && $line != ' '* ]] && return
    [[ $inside && $line =~ ^\ {2}([a-z]+.*)$ ]] || continue
    line=${BASH_REMATCH[1]%%  *}
    for name in ${line//,/ }; do [[ $name == [a-z]* ]] && echo "$name"; done
  done <<<"$help"
}

# names: the options of the help; types: what each takes, "" where it takes no value.
_breccia_read_options() {
  local line name type
  names=()
  while IFS= read -r line; do
    [[ $line =~ ^\ {1,12}(-[^ ]+(, *--[^ ]+)?)(\ (.*))?$ ]] || continue
    name=${BASH_REMATCH[1]// /} type=${BASH_REMATCH[4]}
    [[ $type =~ ^([A-Z]{2,}|\[[A-Z]) ]] || type=
    for name in ${name//,/ }; do
      names+=("$name")
      types[$name]=${type%%  *}
    done
  done <<<"$help"
}

# position: how many arguments that are no options stand between the command and the cursor; $1: options with a value, in spaces.
_breccia_position() {
  local word skip=
  position=0
  for word in "${words[@]:1+${#command[@]}:${#words[@]}-2-${#command[@]}}"; do
    if [[ $skip ]]; then skip=; continue; fi
    case $word in
      -*) [[ $1 == *" $word "* ]] && skip=yes ;;
      *) position=$((position + 1)) ;;
    esac
  done
}

# Every key and section of a case file as a path. Sections of which a case may have several are added to lists, if the caller has it.
_breccia_keys() {
  local line section=''
  while IFS= read -r line; do
    if [[ $line =~ ^\[+([a-z_.0-9]+)(\]+)$ ]]; then
      section=${BASH_REMATCH[1]}
      [[ ${BASH_REMATCH[2]} == ']]' ]] && lists+=("$section")
      echo "$section"
    elif [[ $line =~ ^[a-z_.]+$ ]]; then
      section=$line
      echo "$section"
    elif [[ $line =~ ^\ {2}([a-z][a-z_0-9]*)\ {2,}[^\ ] ]]; then
      echo "${section:+$section.}${BASH_REMATCH[1]}"
    fi
  done < <(_breccia_ask explain --all)
}

# Keys as --set takes them, each with its "=": an entry of a list is the one that was typed (material.glass, material[2]), else [0].
_breccia_keys_to_set() {
  local lists=() key part path typed rest keys
  mapfile -t keys < <(_breccia_keys; printf '[]%s\n' "${lists[@]}")  # a subshell: its lists come with its output
  for key in "${keys[@]}"; do [[ $key == '[]'* ]] && lists+=("${key:2}"); done
  for key in "${keys[@]}"; do
    [[ $key == '[]'* || $key == function || $key == function.* || " ${keys[*]} " == *" $key."* ]] && continue
    path='' typed='' rest=$cur
    for part in ${key//./ }; do
      path+=${path:+.}$part typed+=${typed:+.}$part
      [[ " ${lists[*]} " == *" $path "* ]] || continue
      if [[ $rest == "$typed"* && ${rest#"$typed"} =~ ^(\[[0-9]+\]|\.[^].=[]+)\. ]]; then
        typed+=${BASH_REMATCH[1]}
      else
        typed+='[0]'
      fi
    done
    echo "$typed="
  done
}

# What `breccia explain KEY` lists as choices.
_breccia_choices() {
  local line
  while IFS= read -r line; do
    [[ $line =~ ^\ +(choices|allowed)\ +(.*)$ ]] || continue
    line=${BASH_REMATCH[2]}
    case ${BASH_REMATCH[1]} in
      choices) printf '%s\n' "${line//, /$'\n'}" ;;
      allowed) [[ $line == 'true or false' ]] && printf 'true\nfalse\n' ;;
    esac
  done < <(_breccia_ask explain "$1")
}

# Of the lines of the input those that begin with cur become candidates.
_breccia_offer() {
  local word
  while IFS= read -r word; do
    [[ $word && $word == "$cur"* ]] || continue
    [[ $word == *[\ \'\"\$\&\;\(\)]* ]] && printf -v word %q "$word"
    COMPREPLY+=("$word")
  done
}

# The same for the last entry of a list with commas; entries that stand in it already are not offered again.
_breccia_offer_list() {
  local before='' word
  [[ $cur == *,* ]] && before=${cur%,*},
  _breccia_offer < <(while IFS= read -r word; do [[ ,$before == *,"$word",* ]] || echo "$before$word"; done)
  compopt -o nospace 2>/dev/null
}

# Files by an ending, and folders on the way to them; $1: "" for folders alone.
_breccia_offer_files() {
  mapfile -t COMPREPLY < <([[ $1 ]] && compgen -f -X "!*$1" -- "$cur" | while IFS= read -r file; do [[ -d $file ]] || echo "$file"; done
    compgen -d -- "$cur")
  compopt -o filenames 2>/dev/null
}

# Folders that hold a run, here or one level below; other folders where there is none.
_breccia_offer_runs() {
  local folder
  while IFS= read -r folder; do
    for folder in "${folder%/}" "${folder%/}"/*; do
      [[ -f $folder/status.jsonl ]] && COMPREPLY+=("$folder")
    done
  done < <(compgen -d -- "$cur"; [[ $cur == */ ]] && echo "$cur")
  if ((${#COMPREPLY[@]})); then
    mapfile -t COMPREPLY < <(printf '%q\n' "${COMPREPLY[@]}" | sort -u)
  else
    _breccia_offer_files ''
  fi
}

# Pipelines by name, and scripts.
_breccia_pipelines() {
  _breccia_choices insitu.pipeline.name
  compgen -f -X '!*.py' -- "${cur##*,}"
  compgen -d -S / -- "${cur##*,}"
}

# The value of an option of which the help says $1, such as "TEXT:{auto,bar,log,json,none}" or "TEXT:{a,b} ...", a list.
_breccia_offer_value() {
  [[ $1 =~ \{([^}]*)\} ]] || return
  local choices=${BASH_REMATCH[1]//,/$'\n'}
  if [[ $1 == *...* ]]; then _breccia_offer_list <<<"$choices"; else _breccia_offer <<<"$choices"; fi
}

_breccia_candidates() {
  local help names valued=' ' name position positionals
  local -A types=()
  case $option in
    --set)
      if [[ $cur == *=* ]]; then
        head+=${cur%%=*}=
        name=${cur%%=*} cur=${cur#*=}
        _breccia_offer < <(_breccia_choices "$name")
      else
        _breccia_offer < <(_breccia_keys_to_set)
        compopt -o nospace 2>/dev/null
      fi
      return ;;
    --insitu) _breccia_offer_list < <(_breccia_pipelines); return ;;
    -o | --output) _breccia_offer_files ''; return ;;
  esac
  if [[ $cur != -* && ${command[*]} == explain ]]; then _breccia_offer < <(_breccia_keys); return; fi
  if [[ $cur != -* && ${command[*]} == 'insitu replay' ]]; then
    _breccia_position ' -o --output -p --parameter '
    if ((position > 0)); then _breccia_offer < <(_breccia_pipelines); return; fi
  fi

  help=$(_breccia_ask "${command[@]}" --help)
  _breccia_read_options
  if [[ $option && ${types[$option]-} ]]; then _breccia_offer_value "${types[$option]}"; return; fi
  if [[ $cur == -* ]]; then _breccia_offer < <(printf '%s\n' "${names[@]}"); return; fi
  mapfile -t names < <(_breccia_listed subcommands:)
  if ((${#command[@]} == 0)) || [[ ${command[*]} == insitu ]]; then _breccia_offer < <(printf '%s\n' "${names[@]}"); return; fi

  for name in "${!types[@]}"; do [[ ${types[$name]} ]] && valued+="$name "; done
  _breccia_position "$valued"
  [[ $help =~ \[OPTIONS\]\ ([^$'\n']*) ]] && read -ra positionals <<<"${BASH_REMATCH[1]}"
  case ${positionals[position]-} in
    case) _breccia_offer_files .toml ;;
    run | first | second) _breccia_offer_runs ;;
    command...) _breccia_offer < <(_breccia_listed commands:) ;;
  esac
}

_breccia() {
  local program=${COMP_WORDS[0]/#\~\//$HOME/} words cur head option command=() i cut=
  COMPREPLY=()
  _breccia_read_line
  if ((${#words[@]} > 2)); then command=("${words[1]}"); fi
  if ((${#words[@]} > 3)) && [[ ${words[1]} == insitu ]]; then command+=("${words[2]}"); fi
  [[ ${command[*]} == *-* ]] && return
  _breccia_candidates
  # Bash replaces only its own last word, not what was put together from several.
  cut=${words[-1]}
  [[ ${COMP_WORDS[COMP_CWORD]} =~ ^[=:]+$ ]] || cut=${cut%"${COMP_WORDS[COMP_CWORD]}"}
  for i in "${!COMPREPLY[@]}"; do
    COMPREPLY[i]=$head${COMPREPLY[i]}
    COMPREPLY[i]=${COMPREPLY[i]#"$cut"}
  done
}

complete -F _breccia breccia
