#!/bin/sh
# Opens a model in the viewer, extrudes a lattice twice, binds, poses, saves and quits, crashes and
# recovers, with real keys and buttons: session_test.sh ESPALIER-VIEWER, on a display of its own.
set -eu
viewer=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_STATE_HOME="$folder/state"

cat >"$folder/model.obj" <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
END

"$viewer" --size 1280x800 &
process=$!
xdotool search --sync --onlyvisible --name '^Espalier$' windowfocus >/dev/null

# Types a path into the file panel; on a busy machine the first keys may come before the window
# listens.
journal="$XDG_STATE_HOME/espalier/journal"
for attempt in 1 2 3 4 5; do
  xdotool key F2
  sleep 1
  xdotool type --delay 60 "$folder/model.obj"
  xdotool key --delay 100 Return
  for i in $(seq 30); do
    [ ! -e "$journal" ] || break 2
    sleep 0.1
  done
  xdotool key Escape
done

keys() {
  sleep 0.3
  xdotool key --delay 120 "$@"
}
quit() {
  keys ctrl+q
  for i in $(seq 100); do
    kill -0 "$process" 2>/dev/null || break
    sleep 0.1
  done
  wait "$process"
}
keys n KP_1 Home 3
xdotool mousemove 640 400 click 1
keys e 1 Return
keys e 1 Return
keys b ctrl+3 1 a
keys g x 1 period 5 Return
keys ctrl+s
for i in $(seq 50); do
  [ ! -e "$folder/lattice_bent.json" ] || break
  sleep 0.1
done
quit

fail() {
  echo "session_test.sh: $1" >&2
  exit 1
}
sed -e 's/^v 0 /v 1.5 /' -e 's/^v 1 /v 2.5 /' "$folder/model.obj" >"$folder/expected.obj"
cmp "$folder/expected.obj" "$folder/model_bent.obj" || fail "the model is not moved by 1.5 along x"
python3 - "$folder/lattice_bent.json" <<'END' || fail "the lattice is not what was built"
import json, sys
lattice = json.load(open(sys.argv[1]))
assert len(lattice["cells"]) == 3, lattice["cells"]
assert len(lattice["vertices"]) == 16
assert all(abs(p[0] - v[0] - 1.5) < 1e-12 and p[1:] == v[1:]
           for v, p in zip(lattice["vertices"], lattice["pose"]))
depths = sorted({round(v[2], 9) for v in lattice["vertices"]})
assert len(depths) == 4 and abs(depths[3] - depths[1] - 2) < 1e-9, depths
END
[ ! -e "$journal" ] || fail "the recovery file is still there"

# What a crash leaves is there again with --recover.
rm -f "$folder"/*_bent.*
cd "$folder"
"$viewer" model.obj &
process=$!
xdotool search --sync --onlyvisible --name '^Espalier$' windowfocus >/dev/null
for attempt in $(seq 10); do
  keys n
  ! grep -q 'new box' "$journal" 2>/dev/null || break
  sleep 1
done
kill -9 "$process"
wait "$process" 2>/dev/null || true
[ -e "$journal" ] || fail "a crash leaves no journal"
cd /
"$viewer" --recover &
process=$!
xdotool search --sync --onlyvisible --name '^Espalier$' windowfocus >/dev/null
for attempt in $(seq 10); do
  keys ctrl+s
  [ ! -e "$folder/lattice_bent.json" ] || break
  sleep 1
done
[ -e "$folder/lattice_bent.json" ] || fail "the session that crashed is not recovered"
quit
for left in "$journal" "$journal.2"; do
  [ ! -e "$left" ] || fail "$left is still there"
done
