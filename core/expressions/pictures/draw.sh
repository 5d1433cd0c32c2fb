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

motions() { # motions NAME MODEL POINTS: chin, blinks from the front and from the side, and turns of the head, on one sheet each
  local sheet="$build/bin/semblante-contact-sheet"
  "$sheet" "$2" -f "$3" -o "$work/$1/lids" --weights smooth --only-frames --size 300x200 --jpeg 72 \
    -s front:eyes -s left:eyes --frame 3=0 --frame 19=512,20=512 --frame 19=1024,20=1024
  "$sheet" "$2" -f "$3" -o "$work/$1/chin" --weights smooth --only-frames --size 240x240 --jpeg 72 \
    -s front:face --frame 3=0 --frame 3=300 --frame 3=600
  for shot in front-eyes left-eyes; do mv "$work/$1/lids/faps-$shot.jpg" "$here/$1-blink-${shot%-eyes}.jpg"; done
  mv "$work/$1/chin/faps-front-face.jpg" "$here/$1-chin.jpg"
}

turns() { # turns NAME MODEL POINTS: 0.3 rad about two axes and 0.6 about each, whole and close
  "$build/bin/semblante-contact-sheet" "$2" -f "$3" -o "$work/$1/turns" --weights smooth --only-frames --size 200x260 --jpeg 72 \
    -s front -s left -s three-quarter:face --frame 48=30000,49=30000 --frame 48=60000 --frame 48=-60000 --frame 49=60000 --frame 50=60000
  for shot in front left three-quarter-face; do mv "$work/$1/turns/faps-$shot.jpg" "$here/$1-turns-$shot.jpg"; done
}

"$build/bin/semblante-sample-head" "$work" >/dev/null
"$build/bin/semblante-sample-head" "$work" body >/dev/null
motions sample-head "$work/sample-head.glb" "$work/sample-head.fps.json"
turns sample-head "$work/sample-head.glb" "$work/sample-head.fps.json"
turns sample-body "$work/sample-body.glb" "$work/sample-body.fps.json"
draw sample-head "$work/sample-head.glb" "$work/sample-head.fps.json"
"$build/bin/semblante-contact-sheet" "$work/sample-head.glb" -f "$work/sample-head.fps.json" -o "$work/close" \
  --weights smooth -s front:face -s three-quarter:mouth --size 240x240 --jpeg 80
mv "$work/close/expressions-front-face.jpg" "$here/expressions.jpg"
mv "$work/close/visemes-three-quarter-mouth.jpg" "$here/visemes.jpg"
if [ -d "$faces" ]; then
  motions makehuman "$faces/makehuman/head.glb" "$faces/makehuman/makehuman.fps.json"
  turns makehuman "$faces/makehuman/head.glb" "$faces/makehuman/makehuman.fps.json"
  motions ict-facekit "$faces/ict-facekit/neutral.obj" "$faces/ict-facekit/ict-facekit.fps.json"
  turns ict-facekit "$faces/ict-facekit/neutral.obj" "$faces/ict-facekit/ict-facekit.fps.json"
  draw makehuman "$faces/makehuman/head.glb" "$faces/makehuman/makehuman.fps.json"
  draw ict-facekit "$faces/ict-facekit/neutral.obj" "$faces/ict-facekit/ict-facekit.fps.json"
fi
