#!/bin/sh
# gui.sh RUN FOLDER: the ParaView GUI on a screen of its own, with the toolbar's pictures of a run and then with each filter as it is shown by default; its
# window as window_NAME.png in FOLDER. Environment: BRECCIA_PARAVIEW_PLUGIN.
set -eu
here=$(dirname "$0") scratch=$(mktemp -d)
export BRECCIA_PICTURE_RUN="$1" BRECCIA_PICTURE_WINDOW="$scratch/done" HOME="$scratch" DISPLAY=:${BRECCIA_DISPLAY:-87}
mkdir -p "$scratch/.config/ParaView"
printf '[General]\nGeneralSettings.ShowWelcomeDialog=false\n' >"$scratch/.config/ParaView/ParaView$(pvpython --version | sed 's/.* //').ini"
# As large as the window that ParaView opens without a window manager; on a smaller screen it is cut off.
Xvfb "$DISPLAY" -screen 0 1152x762x24 -noreset -fbdir "$scratch" >/dev/null 2>&1 &
screen=$!
gui=
trap 'kill $gui $screen 2>/dev/null || true; rm -rf "$scratch"' EXIT
sleep 2
for name in ${BRECCIA_WINDOWS:-toolbar BrecciaReader Fragments FractureSurface CrackEvents ContactNetwork EnergyBalance RankView}; do
  rm -f "$scratch/done"
  BRECCIA_WINDOW=$name paraview --script="$here/window_pictures.py" >"$scratch/log" 2>&1 &
  gui=$!
  waited=0
  until [ -e "$scratch/done" ] || [ $waited -ge 120 ] || ! kill -0 $gui 2>/dev/null; do sleep 1; waited=$((waited + 1)); done
  sleep 4
  cat "$scratch/log"
  [ -e "$scratch/done" ]
  pvpython "$here/window.py" "$scratch/Xvfb_screen0" "$2/window_$name.png"
  kill -KILL $gui 2>/dev/null || true
  wait $gui 2>/dev/null || true
done
