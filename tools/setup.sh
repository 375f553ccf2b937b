#!/bin/bash
# Usage: tools/setup.sh [--baselines] [--browser] [--docs] [--package]
# Installs the packages that Poise needs on Debian 12, if they are missing.
#   --baselines  also packages that some tests and benchmarks compare with
#   --browser  also packages to rebuild the viewer and to run its browser test
#   --docs  also Doxygen, for bazel build //docs:api
#   --package  also packages to use Poise from CMake, to make Debian packages, to
#     compare binary interfaces, and to test these
# Runs as root, or as a user with sudo. If an installation fails, prints one line
# that names the missing packages, and exits with code 1.
set -euo pipefail

packages=(
  # The build.
  bazel-bootstrap bazel-rules-java bazel-rules-proto
  clang clang-format g++ git libclang-rt-14-dev pkg-config python3
  # The libraries: linear algebra, robot files, plants, formats, digests.
  libbullet-dev libcairo2-dev libcli11-dev libeigen3-dev libmujoco-dev
  libssl-dev libtinyxml2-dev liburdfdom-dev libyaml-cpp-dev nlohmann-json3-dev
  # The Python package: its binding, and NumPy.
  pybind11-dev python3-dev python3-numpy
  # The command that converts meshes of other formats than STL and OBJ.
  assimp-utils
  # Packages that only tests use.
  libbenchmark-dev libceres-dev libfcl-dev libgmock-dev libgmp-dev libgtest-dev
  libmpfrc++-dev liborocos-kdl-dev librapidcheck-dev mypy python3-ipykernel
  python3-matplotlib python3-nbclient python3-nbformat python3-pandas
  python3-pytest python3-scipy python3-venv
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
      # Debian's npm conflicts with a Node.js from elsewhere, so keep such a one
      # if it is installed.
      command -v node > /dev/null || packages+=(nodejs)
      command -v npm > /dev/null || packages+=(npm)
      ;;
    --docs)
      packages+=(doxygen)
      ;;
    --package)
      packages+=(abigail-tools binutils chrpath cmake dpkg-dev lintian make)
      packages+=(mmdebstrap)
      ;;
    -h | --help)
      sed -n '2,10s/^# \?//p' "$0"
      exit 0
      ;;
    *)
      echo "tools/setup.sh: unknown option '$argument', must be --baselines, --browser, --docs or --package" >&2
      exit 2
      ;;
  esac
done

is_installed() {
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2> /dev/null)" = installed ]
}

command -v dpkg-query > /dev/null ||
  fail "this is not Debian; install these packages by hand: ${packages[*]}"

missing=()
for package in "${packages[@]}"; do
  # A Bazel release from elsewhere, such as by bazelisk, replaces Debian's.
  if [[ $package == bazel-* ]] && command -v bazel > /dev/null; then
    [[ $(readlink -f "$(command -v bazel)") == /usr/bin/bazel* ]] || continue
  fi
  is_installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" != 0 ]; then
  command -v sudo > /dev/null ||
    fail "needs root or sudo to install: ${missing[*]}"
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
