#!/bin/sh
# Builds Espalier on a Debian 12 and bends an arm, a disk and a block with lattices.
# Leaves models, lattices and pictures in build/demo/. With --pictures it also makes the small
# pictures of the README, in tools/pictures/, anew.
set -eu
cd "$(dirname "$0")/.."
sh tools/build.sh build -DESPALIER_TESTS=OFF
espalier="$PWD/build/bin/espalier"
data="$PWD/tests/data"
top=$PWD
pictures=no
[ "${1:-}" != --pictures ] || pictures=yes
mkdir -p build/demo
cd build/demo

run() {
  echo "\$ espalier $*"
  "$espalier" "$@"
}

picture() {
  name=$1
  shift
  run render "$@" --size 900x700 -o "$name.png"
  if [ "$pictures" = yes ]; then
    "$espalier" render "$@" --size 400x320 --quiet -o "$top/tools/pictures/$name.png"
  fi
}

echo
echo "== The arm: a lattice as thick as it needs; the hand turns, the elbow bends, the arm rises"
run refine "$data/figure.obj" --levels 3 -o figure.obj
run new ogrid --from 0.2 1.41 0.004 --to 0.93 1.41 0.004 --fit figure.obj --layers 10 -o arm.json
run info arm.json
run pose twist arm.json --from 0.52 1.41 0.004 --to 0.74 1.41 0.004 --angle 85 -o arm-posed.json
run pose rotate arm-posed.json --about 0.53 1.41 0.004 --along 1 0 0 --axis 0 -1 0 --angle 28 \
  -o arm-posed.json
run pose rotate arm-posed.json --about 0.37 1.41 0.004 --along 1 0 0 --axis 0 0 1 --angle 76 \
  --falloff 0.28 -o arm-posed.json
run check arm-posed.json --model figure.obj
run deform figure.obj --lattice arm-posed.json -o waving.obj
picture arm-before figure.obj arm.json --view 20,10
picture arm-after waving.obj arm-posed.json --view 20,10
picture waving waving.obj --view 20,10

echo
echo "== The disk: wedges round a line of valence five make it a star"
run deform "$data/disk.obj" --lattice "$data/star_posed.json" -o star.obj
picture disk-before "$data/disk.obj" "$data/star_posed.json" --rest --view 25,20
picture disk-after star.obj "$data/star_posed.json" --view 25,20

echo
echo "== The block: a barbell bends and twists it"
run convert "$data/barbell_section.obj" --extrude 0 0 1.2 --layers 3 -o barbell.ovm
run deform "$data/block.obj" --lattice barbell.ovm --pose "$data/barbell_posed.json" -o bent.obj
picture block-before "$data/block.obj" barbell.ovm --view 20,35
picture block-after bent.obj "$data/barbell_posed.json" --view 20,35

echo
echo "== The leg: a session of the viewer extrudes cells down it and bends the knee"
viewer() {
  echo "\$ espalier-viewer $*"
  "$top/build/bin/espalier-viewer" "$@"
}
viewer figure.obj --script "$data/leg_session.txt" --size 1000x640 --screenshot 'viewer-{}.png'
[ "$pictures" = no ] || cp viewer-*.png "$top/tools/pictures/"

echo
echo "Models, lattices and pictures are in build/demo/:"
ls -- *.png
