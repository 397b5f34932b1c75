#!/usr/bin/env bash
# analyse.sh BUILD [WORD...]: cppcheck over solver/, then clang-tidy over its files one by one, with the commands in
# BUILD/compile_commands.json; WORD...: clang-tidy only over files whose paths hold one of them. Prints findings, ends with 1 when
# there are any. Checks are chosen in .clang-tidy; what is no fault stands in cppcheck.supp, with the reason, or is marked NOLINT in
# the source, likewise. A file that clang-tidy has found clean is left out next time, until it or a header changes.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
build=$(readlink -f "$1")
shift
cd "$here/../.."
clean=$build/clang_tidy
mkdir -p "$clean"
found=0

if [[ $# == 0 ]]; then
  # With a relative path of the project cppcheck names files relative to this folder, as the filter and the suppressions do.
  cppcheck --project="$(realpath --relative-to=. "$build/compile_commands.json")" --file-filter='solver/*' --std=c++20 --quiet --inline-suppr \
    --enable=warning,performance,portability --suppressions-list="$here/cppcheck.supp" --suppress=missingIncludeSystem \
    -j "$(nproc)" --error-exitcode=1 --template='{file}:{line}: {message} [cppcheck {id}]' || found=1
fi

# tidy FILE: prints what there is to say of it.
tidy() {
  local file=$1 mark=$clean/${1//\//_} said
  [[ -e $mark && -z $(find "$file" .clang-tidy solver \( -path "$file" -o -name '*.hpp' -o -name .clang-tidy \) -newer "$mark" -print -quit) ]] && return 0
  # Words of g++ that clang does not know are none of the source's faults.
  if said=$(clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option "$file" 2>/dev/null) && [[ -z $said ]]; then
    touch "$mark"
    return 0
  fi
  echo "${said:-$file: clang-tidy failed on it}"
  return 1
}
export -f tidy
export build clean
python3 - "$build" "$@" <<'P' | xargs -P "$(nproc)" -I FILE bash -c 'tidy FILE' || found=1
import json, os, sys
files = {os.path.relpath(entry["file"]) for entry in json.load(open(sys.argv[1] + "/compile_commands.json"))}
words = sys.argv[2:]
print("\n".join(sorted(f for f in files if f.startswith("solver/") and (not words or any(w in f for w in words)))))
P
exit $found
