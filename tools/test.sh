#!/bin/sh
# Builds Espalier on a Debian 12 and runs its tests.
set -eu
cd "$(dirname "$0")/.."
sh tools/install.sh python3-vtk9
sh tools/build.sh build -DESPALIER_TESTS=ON
ctest --test-dir build --output-on-failure -j "$(nproc)"
