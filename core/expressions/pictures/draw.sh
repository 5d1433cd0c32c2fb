#!/usr/bin/env bash
# Draws the sheets of this folder anew: after a change of the displacement sets. Needs tests/pictures (a build with
# SEMBLANTE_TESTS and SEMBLANTE_CLIENTS); takes some minutes on a software renderer. The heads of others are drawn where their folder is.
#   core/expressions/pictures/draw.sh [BUILD-FOLDER]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
build=${1:-$root/build}
faces=${SEMBLANTE_FACES_DIR:-$root/../shared/faces}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

draw() { # draw NAME MODEL POINTS: the sheet of all combinations
  "$build/bin/semblante-contact-sheet" "$2" -f "$3" -o "$work/$1" --weights smooth -s front:face --matrix --size 120x140 --jpeg 62
  mv "$work/$1/matrix-front-face.jpg" "$here/$1.jpg"
}

"$build/bin/semblante-sample-head" "$work" >/dev/null
draw sample-head "$work/sample-head.glb" "$work/sample-head.fps.json"
"$build/bin/semblante-contact-sheet" "$work/sample-head.glb" -f "$work/sample-head.fps.json" -o "$work/close" \
  --weights smooth -s front:face -s three-quarter:mouth --size 240x240 --jpeg 80
mv "$work/close/expressions-front-face.jpg" "$here/expressions.jpg"
mv "$work/close/visemes-three-quarter-mouth.jpg" "$here/visemes.jpg"
if [ -d "$faces" ]; then
  draw makehuman "$faces/makehuman/head.glb" "$faces/makehuman/makehuman.fps.json"
  draw ict-facekit "$faces/ict-facekit/neutral.obj" "$faces/ict-facekit/ict-facekit.fps.json"
fi
