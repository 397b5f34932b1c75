#!/usr/bin/env bash
# usage: install_test.sh CMAKE BUILD_FOLDER
# Installs a build into a folder that is then moved, whose name holds a blank and where its user may not write, and uses it from there.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$1" --install "$2" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/moved here"
mkdir "$scratch/home"
cp "$here/use_installed.sh" "$scratch/"
chmod -R a+rX "$scratch"
user=()
if ((EUID == 0)); then
  chown 65534:65534 "$scratch/home"
  user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
fi
cd "$scratch/home"
"${user[@]}" env -i HOME="$scratch/home" PATH="$scratch/moved here/bin:/usr/bin:/bin" "$scratch/use_installed.sh"
[[ -z "$(find "$scratch/moved here" -newer "$scratch/use_installed.sh" -type f)" ]] || {
  echo "files appeared among the installed ones" >&2
  exit 1
}
