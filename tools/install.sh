#!/bin/sh
# Installs the Debian packages that Espalier needs, those of the tests included.
# Does nothing when they are all there.
set -eu

packages="g++ cmake ninja-build pkg-config ccache
  libosd-dev libeigen3-dev libglm-dev libfmt-dev nlohmann-json3-dev libcli11-dev libstb-dev
  libepoxy-dev libglfw3-dev libimgui-dev libegl-dev libgl1 libegl1 libegl-mesa0 libgl1-mesa-dri
  libgtest-dev libgmock-dev xvfb xauth xdotool"

missing=""
for package in $packages "$@"; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
    missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "install.sh: needs root or sudo to install:$missing" >&2
    exit 1
  }
  as_root="sudo"
fi
echo "Installing:$missing"
$as_root apt-get update -qq
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
