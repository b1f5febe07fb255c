#!/bin/sh
# install_packages.sh NODE_FOLDER NPM: installs what package-lock.json names, once; later calls need no network.
# Exit code 77: the packages cannot be had here.
set -eu
cd "$1"
if cmp -s package-lock.json installed-lock.json; then
  echo "installed already"
  exit 0
fi
rm -f installed-lock.json
if ! "$2" ci --ignore-scripts --no-audit --no-fund; then
  echo "skipped: npm cannot install the packages (no network?)"
  exit 77
fi
cp package-lock.json installed-lock.json
