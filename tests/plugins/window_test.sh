#!/bin/sh
# window_test.sh SCRIPT TOOLBAR RUN FOLDER: SCRIPT in the ParaView GUI on the screen that there is; its words are in FOLDER.
set -u
export BRECCIA_TOOLBAR="$2" BRECCIA_TEST_RUN="$3" BRECCIA_TEST_OUTPUT="$4"
rm -rf "$4"
mkdir -p "$4/home/.config/ParaView"
printf '[General]\nGeneralSettings.ShowWelcomeDialog=false\n' >"$4/home/.config/ParaView/ParaView$(pvpython --version | sed 's/.* //').ini"
printf '{"settings":{"GeneralSettings":{"ShowWelcomeDialog":0}}}' >"$4/home/.config/ParaView/ParaView-UserSettings.json"
HOME="$4/home" timeout 200 paraview --script="$1" >"$4/said" 2>&1
cat "$4/said" "$4/words"
grep -q "^window: done" "$4/words"
