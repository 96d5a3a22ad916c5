#!/bin/sh
# Installs what is missing and builds: build.sh FOLDER [CMAKE OPTION …]
set -eu
cd "$(dirname "$0")/.."
sh tools/install.sh
folder=$1
shift
cmake -S . -B "$folder" -G Ninja "$@" >"/tmp/espalier-cmake.$$" || {
  cat "/tmp/espalier-cmake.$$"
  exit 1
}
rm -f "/tmp/espalier-cmake.$$"
cmake --build "$folder"
