#!/bin/bash
# Usage: tools/setup.sh [--baselines] [--browser]
# Installs what Poise needs on Debian 12; a quick no-op where it is all there.
#   --baselines  also what tests and benchmarks compare with where it is there
#   --browser  also what rebuilding the viewer and its browser test need
# Runs as root, or as a user with sudo. Exit code 1, and one line that says what
# is missing, if it cannot.
set -euo pipefail

packages=(
  # The build.
  bazel-bootstrap bazel-rules-java bazel-rules-proto
  clang clang-format g++ git libclang-rt-14-dev pkg-config python3
  # The libraries: linear algebra, robot files, plants, formats, digests.
  libbullet-dev libcairo2-dev libcli11-dev libeigen3-dev libmujoco-dev
  libssl-dev libtinyxml2-dev liburdfdom-dev libyaml-cpp-dev nlohmann-json3-dev
  # Packages that only tests use.
  libbenchmark-dev libceres-dev libgmock-dev libgtest-dev libmpfrc++-dev
  liborocos-kdl-dev librapidcheck-dev
)

fail() {
  echo "tools/setup.sh: $*" >&2
  exit 1
}

for argument in "$@"; do
  case $argument in
    --baselines)
      packages+=(libbullet-extras-dev)
      ;;
    --browser)
      packages+=(chromium)
      # Debian's npm conflicts with a Node.js from elsewhere: leave that alone.
      command -v node > /dev/null || packages+=(nodejs)
      command -v npm > /dev/null || packages+=(npm)
      ;;
    -h | --help)
      sed -n '2,7s/^# \?//p' "$0"
      exit 0
      ;;
    *)
      echo "tools/setup.sh: unknown option '$argument', want --baselines or --browser" >&2
      exit 2
      ;;
  esac
done

is_installed() {
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2> /dev/null)" = installed ]
}

command -v dpkg-query > /dev/null ||
  fail "this is not Debian; install by hand: ${packages[*]}"

missing=()
for package in "${packages[@]}"; do
  # A release of Bazel, as bazelisk brings it, serves as well as Debian's.
  if [[ $package == bazel-* ]] && command -v bazel > /dev/null; then
    [[ $(readlink -f "$(command -v bazel)") == /usr/bin/bazel* ]] || continue
  fi
  is_installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" != 0 ]; then
  command -v sudo > /dev/null ||
    fail "not root and no sudo; missing: ${missing[*]}"
  as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "tools/setup.sh: installing ${#missing[@]} packages: ${missing[*]}" >&2
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq "$@" \
    > "$log" 2>&1
}
apt update || fail "apt-get update failed: $(tail -n 1 "$log")"
apt install --yes --no-install-recommends "${missing[@]}" ||
  fail "could not install ${missing[*]}: $(grep -m 1 '^E:' "$log" || tail -n 1 "$log")"
for package in "${missing[@]}"; do
  is_installed "$package" || fail "still missing after installation: $package"
done
