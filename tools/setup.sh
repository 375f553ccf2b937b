#!/bin/bash
# Usage: tools/setup.sh [--layers LAYERS] [--baselines] [--browser] [--docs] [--package]
# Installs the packages that Poise needs on Debian 12, if they are missing.
#   --layers LAYERS  of the default packages, only those to install these layers for
#     CMake projects: of math, dynamics, hqp, robot, control, gait, sim, separated by
#     commas, as for bazel run //tools:install; or python, for its wheel
#   --baselines  also packages that some tests and benchmarks compare with
#   --browser  also packages to rebuild the viewer and to run its browser test
#   --docs  also Doxygen, for bazel build //docs:api
#   --package  also packages to use Poise from CMake, to make Debian packages, to
#     compare binary interfaces, and to test these
# Runs as root, or as a user with sudo. If an installation fails, prints one line
# that names the missing packages, and exits with code 1.
set -euo pipefail

# To build layers.
build=(
  bazel-bootstrap bazel-rules-java bazel-rules-proto g++ git pkg-config python3
  # To use them from CMake.
  cmake make
)
kernels=(libeigen3-dev)
robot=(libtinyxml2-dev liburdfdom-dev libyaml-cpp-dev)
sim=(libbullet-dev libmujoco-dev libssl-dev nlohmann-json3-dev)
# The Python package.
python=(
  libcli11-dev pybind11-dev python3-dev python3-matplotlib python3-numpy python3-venv
)
# Everything else by default.
others=(
  # Sanitizers, fuzzers and the format of the sources.
  clang clang-format libclang-rt-14-dev
  # Pictures.
  libcairo2-dev
  # The command that converts meshes of other formats than STL and OBJ.
  assimp-utils
  # Packages that only tests use.
  libbenchmark-dev libceres-dev libfcl-dev libgmock-dev libgmp-dev libgtest-dev
  libmpfrc++-dev liborocos-kdl-dev librapidcheck-dev mypy python3-ipykernel
  python3-nbclient python3-nbformat python3-pandas python3-pytest python3-scipy
)
packages=(
  "${build[@]}" "${kernels[@]}" "${robot[@]}" "${sim[@]}" "${python[@]}" "${others[@]}"
)
additional=()

fail() {
  echo "tools/setup.sh: $*" >&2
  exit 1
}

# Usage: choose_layers LAYERS: replaces the packages by those of the layers.
choose_layers() {
  local layers layer
  packages=("${build[@]}" "${kernels[@]}")
  IFS=, read -ra layers <<< "${1:-,}"
  for layer in "${layers[@]}"; do
    case $layer in
      math | dynamics | hqp) ;;
      robot | control | gait) packages+=("${robot[@]}") ;;
      sim) packages+=("${robot[@]}" "${sim[@]}") ;;
      python) packages+=("${robot[@]}" "${sim[@]}" "${python[@]}") ;;
      *)
        echo "tools/setup.sh: --layers has '$layer', must be of math, dynamics, hqp, robot, control, gait, sim, python, separated by commas" >&2
        exit 2
        ;;
    esac
  done
}

while [ $# -gt 0 ]; do
  case $1 in
    --layers)
      choose_layers "${2:-}"
      [ $# -lt 2 ] || shift
      ;;
    --baselines)
      additional+=(libbullet-extras-dev)
      ;;
    --browser)
      additional+=(chromium)
      # Debian's npm conflicts with a Node.js from elsewhere, so keep such a one
      # if it is installed.
      command -v node > /dev/null || additional+=(nodejs)
      command -v npm > /dev/null || additional+=(npm)
      ;;
    --docs)
      additional+=(doxygen)
      ;;
    --package)
      additional+=(abigail-tools binutils chrpath dpkg-dev lintian mmdebstrap)
      ;;
    -h | --help)
      sed -n '2,13s/^# \?//p' "$0"
      exit 0
      ;;
    *)
      echo "tools/setup.sh: unknown option '$1', must be --layers, --baselines, --browser, --docs or --package" >&2
      exit 2
      ;;
  esac
  shift
done
mapfile -t packages < <(printf '%s\n' "${packages[@]}" "${additional[@]}" | awk '!seen[$0]++')

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
