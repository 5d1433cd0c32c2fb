#!/usr/bin/env bash
# arm64_packages.sh FOLDER [--dependencies] PACKAGE...: Debian's packages for arm64, unpacked in FOLDER for cross builds; with
# --dependencies everything they depend on as well, so that FOLDER is a system whose programs run. The system's own package
# lists are not touched. Does nothing once FOLDER has them.
set -euo pipefail

folder=$(realpath -m "$1")
shift
ready=$folder/ready
[ "$(cat "$ready" 2> /dev/null || true)" = "$*" ] && exit 0
rm -rf "$folder"
mkdir -p "$folder"/{state/lists,cache/archives}/partial
touch "$folder/status"
apt=(apt-get -oAPT::Architecture=arm64 -oAPT::Architectures=arm64 -oAPT::Sandbox::User=root
  -oDir::State="$folder/state" -oDir::State::status="$folder/status" -oDir::Cache="$folder/cache" -qq)
"${apt[@]}" update
cd "$folder"
if [ "$1" = --dependencies ]; then
  "${apt[@]}" --no-install-recommends --download-only install "${@:2}"
  mv cache/archives/*.deb .
else
  "${apt[@]}" download "$@"
fi
for package in *.deb; do dpkg-deb -x "$package" .; done
rm ./*.deb
# Written for /usr.
find . -path '*/cmake/*' -name '*-targets*.cmake' -exec sed -i "s|\"/usr\([\"/]\)|\"$folder/usr\1|g" {} +
echo "$*" > "$ready"
