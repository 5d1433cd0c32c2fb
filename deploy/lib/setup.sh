# Set-up shared by deploy/run and tests/run. Sourced, not run; expects `set -euo pipefail` and the repository as $root.

say() { printf '\033[1m== %s\033[0m\n' "$*"; }
fail() {
  printf '\033[31mError: %s\033[0m\n' "$*" >&2
  exit 1
}

# What the server and the studio are built with and run on. Why each is needed: deploy/README.md.
product_packages=(build-essential cmake ninja-build pkg-config
  'libboost1.81-dev|libboost-dev|libboost1.74-dev|libboost1.83-dev|libboost1.88-dev' libssl-dev zlib1g-dev libzip-dev libsqlite3-dev
  libpng-dev libturbojpeg0-dev libwebp-dev libtinygltf-dev libdraco-dev libmeshoptimizer-dev libstb-dev nlohmann-json3-dev libglm-dev libeigen3-dev libcli11-dev libqrencode-dev
  libseccomp-dev
  libopus-dev libogg-dev libsndfile1-dev libsamplerate0-dev libespeak-ng-dev
  libpocketsphinx-dev pocketsphinx-en-us
  'clang|clang-14' 'lld|lld-14' wasi-libc 'libc++-14-dev-wasm32|libc++-dev-wasm32|libc++-18-dev-wasm32'
  'libc++abi-14-dev-wasm32|libc++abi-dev-wasm32|libc++abi-18-dev-wasm32'
  'libclang-rt-14-dev-wasm32|libclang-rt-dev-wasm32|libclang-rt-18-dev-wasm32' binaryen curl ca-certificates)
# What the native client and the tests need beyond that.
test_packages=(libegl-dev libgles-dev libegl1 libgles2 libgl1-mesa-dri libsdl2-dev
  g++-aarch64-linux-gnu 'qemu-user-static|qemu-user' clang 'libclang-rt-dev|libclang-rt-14-dev|libclang-rt-18-dev'
  libgtest-dev libgmock-dev 'clang-format-14|clang-format' 'clang-tidy-14|clang-tidy'
  'chromium|chromium-browser' fonts-dejavu-core python3 python3-yaml git)

# Unpacked beside the build where it is not installed: it depends on OpenSceneGraph, 162 packages of 414 MB, for headers that
# nothing here includes.
openmesh=libopenmesh-dev
# Unpacked likewise, for tests: installed, each would start a service on port 80.
proxies=(nginx caddy)

as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail "installing packages needs root: run this as root or install sudo"
  fi
}

# A name of a package may be several, `a|b`: whichever is installed serves, otherwise the first that the system offers.
is_installed() {
  local name
  for name in ${1//|/ }; do
    dpkg-query -W -f '${Status}' "$name" 2>/dev/null | grep -q 'ok installed' && return
  done
  return 1
}
first_available() {
  local name
  for name in ${1//|/ }; do
    if LC_ALL=C apt-cache policy "$name" 2>/dev/null | grep '^  Candidate:' | grep -qv '(none)'; then
      echo "$name"
      return
    fi
  done
  echo "${1%%|*}" # apt-get says that there is none
}

# Asks the mirrors what they have, once in a run.
refresh_package_lists() {
  [ -n "${lists_are_fresh:-}" ] && return
  as_root apt-get -qq update || fail "apt-get update failed: is a mirror of packages reachable?"
  lists_are_fresh=yes
}

# install_packages NAME...: installs what is missing, after saying what and how much. Silent when nothing is.
install_packages() {
  local wanted=("$@") missing=() package
  # Any Node with npm serves; a system that has one from elsewhere keeps it.
  command -v node >/dev/null || wanted+=(nodejs)
  command -v npm >/dev/null || wanted+=(npm)
  for package in "${wanted[@]}"; do
    is_installed "$package" || missing+=("$package")
  done
  [ ${#missing[@]} = 0 ] && return
  command -v apt-get >/dev/null || fail "this script installs Debian packages, and there is no apt-get here; missing: ${missing[*]}"
  grep -qE '^VERSION_ID="(12|13|24.04)"' /etc/os-release 2>/dev/null ||
    printf 'Note: made for Debian 12 and 13 and Ubuntu 24.04; this is %s\n' "$(. /etc/os-release && echo "${PRETTY_NAME:-unknown}")" >&2

  refresh_package_lists
  mapfile -t missing < <(for package in "${missing[@]}"; do first_available "$package"; done)
  say "Packages to install: ${missing[*]}"
  local plan
  # --download-only: apt-get asks nothing, and installs, where it is asked for one package that needs no other.
  plan=$(LC_ALL=C as_root apt-get install --no-install-recommends --assume-no --download-only "${missing[@]}" 2>&1) || true
  grep -q '^E: ' <<<"$plan" && fail "apt-get cannot install these: $(grep -vE '^(Reading|Building) ' <<<"$plan" | tail -n 12)"
  sed -nE '/newly installed|Need to get|After this operation/s/^/   /p' <<<"$plan"
  # Removing other people's software to make room for ours must be their decision, never a side effect.
  if grep -qE '[1-9][0-9]* to remove' <<<"$plan"; then
    sed -n '/will be REMOVED/,+3p' <<<"$plan" >&2
    fail "installing these would remove the packages above; resolve that by hand, then run this again"
  fi
  local log
  log=$(mktemp)
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "${missing[@]}" \
    >"$log" 2>&1 || {
    tail -n 15 "$log" >&2
    fail "apt-get install failed (the end of its output is above; the whole of it: $log)"
  }
  rm -f "$log"
}

# unpack TREE PACKAGE...: the files of these packages, as the mirror has them now. TREE is there when all are, otherwise
# TREE.log says why not.
unpack() {
  local tree=$1 work=$1.partial # renamed when it is complete: an interrupted run leaves nothing that looks like a result
  shift
  rm -rf "$work"
  mkdir -p "$work"
  # apt-get checks the signatures, as it does when it installs.
  (cd "$work" && apt-get -qq download "$@" && for archive in *.deb; do dpkg-deb -x "$archive" . && rm "$archive" || exit; done) \
    >"$tree.log" 2>&1 && mv -T "$work" "$tree" && rm -f "$tree.log"
}

# unpack_openmesh: its headers and libraries into build/packages, where CMakeLists.txt looks when the package is not
# installed. Silent when there is nothing to do.
unpack_openmesh() {
  local tree=$root/build/packages libraries
  if is_installed "$openmesh" || [ -d "$tree" ]; then return; fi
  refresh_package_lists
  # The libraries are named after their version: libopenmesh1 in Debian 12, libopenmesh11.0 in 13.
  libraries=$(LC_ALL=C apt-cache depends --important "$openmesh" | sed -n 's/^ *Depends: \(libopenmesh[^ ]*\)$/\1/p')
  say "Unpacking $openmesh and $libraries into build/packages"
  unpack "$tree" "$openmesh" $libraries || {
    tail -n 15 "$tree.log" >&2
    fail "$openmesh could not be fetched and unpacked (see above); installing it serves as well"
  }
}

# unpack_proxies: those that are not installed into build/proxies, where tests/deploy looks. Without them one test is skipped,
# so a failure is told and ends nothing. Silent when there is nothing to do.
unpack_proxies() {
  local tree=$root/build/proxies missing=() package
  for package in "${proxies[@]}"; do is_installed "$package" || missing+=("$package"); done
  if [ ${#missing[@]} = 0 ] || [ -d "$tree" ]; then return; fi
  say "Unpacking ${missing[*]} into build/proxies"
  unpack "$tree" "${missing[@]}" || { (refresh_package_lists) && unpack "$tree" "${missing[@]}"; } || {
    tail -n 15 "$tree.log" >&2
    printf 'Note: %s could not be fetched and unpacked (see above); their tests are skipped\n' "${missing[*]}" >&2
  }
}

# configure DIR PRESET [cmake options]: configures once; again only if an option changed. The presets: CMakePresets.json.
configure() {
  local dir=$1 log
  shift
  log=$dir/configure.log
  mkdir -p "$dir"
  if [ -f "$dir/build.ninja" ] && [ "$(cat "$dir/.options" 2>/dev/null)" = "$*" ]; then return; fi
  say "Configuring $(realpath --relative-to="$root" "$dir")"
  (cd "$root" && cmake --preset "$@" -B "$dir") >"$log" 2>&1 || {
    tail -n 20 "$log" >&2
    fail "cmake could not configure (whole log: $log)"
  }
  printf '%s' "$*" >"$dir/.options"
}

# compile DIR [targets]: builds with ninja's own progress; quiet when there is nothing to do.
compile() {
  local dir=$1
  shift
  [ "$(ninja -C "$dir" -n "$@" 2>/dev/null | tail -n 1)" = "ninja: no work to do." ] && return
  say "Building $(realpath --relative-to="$root" "$dir")"
  # One Beast translation unit takes up to 2 GB: fewer jobs on a small machine than it has cores.
  local jobs memory
  jobs=$(nproc)
  memory=$(awk '/MemAvailable/ {print int($2 / 2000000)}' /proc/meminfo)
  [ "$memory" -lt 1 ] && memory=1
  [ "$jobs" -gt "$memory" ] && jobs=$memory
  NINJA_STATUS='   [%f/%t] ' ninja -C "$dir" -j "$jobs" "$@" || fail "the build failed (see above)"
}

# stamp_of FILES...: a fingerprint of the contents of files and folders.
stamp_of() { find "$@" -type f -not -path '*/node_modules/*' -not -path '*/dist/*' -print0 | sort -z | xargs -0 sha256sum | sha256sum; }

# install_npm_packages FOLDER WHAT: the npm packages of a folder (from the repository's root), when their list changed.
install_npm_packages() {
  local folder=$root/$1 stamp
  stamp=$(stamp_of "$folder/package-lock.json")
  if [ "$(cat "$folder/node_modules/.stamp" 2>/dev/null)" != "$stamp" ]; then
    say "Installing the npm packages of $2"
    (cd "$folder" && npm ci --no-audit --no-fund --loglevel=error) || fail "npm ci failed: is the npm registry reachable?"
    printf '%s' "$stamp" >"$folder/node_modules/.stamp"
  fi
}

# build_web DIR: the studio's static files into web/dist, when their sources changed. DIR holds wasm/ and sample/.
build_web() {
  local build=$1 stamp
  install_npm_packages web "the studio"
  stamp=$(stamp_of "$root/web" "$root/protocol/ts" "$root/clients/js" "$build/wasm" "$build/sample")
  if [ "$(cat "$root/web/dist/.stamp" 2>/dev/null)" != "$stamp" ]; then
    say "Building the studio"
    (cd "$root/web" && SEMBLANTE_WASM="$build/wasm" SEMBLANTE_SAMPLE_FOLDER="$build/sample" npm run --silent build) || fail "the studio did not build"
    printf '%s' "$stamp" >"$root/web/dist/.stamp"
  fi
}
