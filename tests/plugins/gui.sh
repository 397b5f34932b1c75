#!/bin/sh
# gui.sh FOLDER: pictures.py in the ParaView GUI, on a screen of its own; its window as window.png. Environment as in pictures.py.
set -eu
here=$(dirname "$0") scratch=$(mktemp -d)
export BRECCIA_PICTURES="$1" BRECCIA_PICTURE_WINDOW="$scratch/done" HOME="$scratch" DISPLAY=:${BRECCIA_DISPLAY:-87}
mkdir -p "$scratch/.config/ParaView"
printf '[General]\nGeneralSettings.ShowWelcomeDialog=false\n' >"$scratch/.config/ParaView/ParaView5.11.0.ini"
Xvfb "$DISPLAY" -screen 0 1120x700x24 -noreset -fbdir "$scratch" >/dev/null 2>&1 &
screen=$!
sleep 2
paraview --script="$here/pictures.py" >"$scratch/log" 2>&1 &
gui=$!
trap 'kill $gui $screen 2>/dev/null; rm -rf "$scratch"' EXIT
waited=0
until [ -e "$scratch/done" ] || [ $waited -ge 400 ] || ! kill -0 $gui 2>/dev/null; do sleep 1; waited=$((waited + 1)); done
sleep 3
cat "$scratch/log"
[ -e "$scratch/done" ]
rm -f "$1/last.png"
pvpython "$here/window.py" "$scratch/Xvfb_screen0" "$1/window.png"
