#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Usage: tests/install/package_checks.sh WORK CACHE STEP...
# The steps of tools/quality/package_test.sh, which calls this in a namespace of
# its own. WORK/built has the packages and the wheel, CACHE the bare Debian.
set -uo pipefail
source_tree=$(cd "$(dirname "$0")/../.." && pwd)
work=$1 cache=$2
shift 2
root=$work/root
built=$work/built

# Usage: inside COMMAND...: runs a command in the present root.
inside() {
  chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} \
    "$@"
}

# Makes a new bare Debian.
make_root() {
  remove_root
  mkdir "$root" && tar -C "$root" -xf "$cache/bookworm.tar" &&
    mount -t proc proc "$root/proc" &&
    mount --bind "$cache/archives" "$root/var/cache/apt/archives" &&
    cp /etc/resolv.conf "$root/etc/resolv.conf" &&
    mkdir "$root/trial" && inside apt-get -qq update
}

remove_root() {
  [ ! -d "$root" ] || {
    umount "$root/var/cache/apt/archives" "$root/proc"
    rm -rf --one-file-system "$root"
  }
}

apt_install() {
  inside apt-get -qq install --yes --no-install-recommends "$@"
}

# Usage: timed WHAT COMMAND...: prints how long a successful command took.
timed() {
  local what=$1 start=$SECONDS
  shift
  "$@" > "$work/log" 2>&1 || {
    tail -n 30 "$work/log"
    echo "  $what: failed after $((SECONDS - start)) s"
    return 1
  }
  echo "  $what: $((SECONDS - start)) s"
}

# Usage: expect TEXT: the last command printed it.
expect() {
  grep -q "$1" "$work/log" || {
    echo "  not printed: '$1', but:" && tail -n 5 "$work/log"
    return 1
  }
}

# Usage: without PROGRAM...: the root has none of them.
without() {
  local program
  for program in "$@"; do
    if inside which "$program"; then
      echo "  the root has $program"
      return 1
    fi
  done
}

# Usage: removed PACKAGE...: removes packages; nothing of Poise may be left.
removed() {
  local left
  timed "removed $*" inside apt-get -qq purge --yes "$@" || return 1
  left=$(find "$root" -xdev \( -path "$root/trial" -o -path "$root/debs" \) \
    -prune -o -iname '*poise*' -print)
  left+=$(inside ldconfig -p | grep -i poise)
  [ -z "$left" ] || {
    echo "  left behind: $left"
    return 1
  }
}

copy_debs() {
  mkdir "$root/debs" && cp "$built"/*.deb "$root/debs"
}

# Usage: deb PACKAGE: the path of the package's file in the root.
deb() {
  echo /debs/"$(basename "$built/$1"_*.deb)"
}

step_lintian() {
  timed lintian lintian --allow-root --fail-on error,warning "$built"/*.deb
}

step_deb_cmake() {
  copy_debs
  cp -r "$source_tree/tests/install/arm" \
    "$source_tree/docs/examples/cmake/arm.urdf" "$root/trial"
  timed "compiler and CMake" apt_install cmake g++ make || return 1
  timed "installed libpoise-dev" apt_install "$(deb libpoise0)" \
    "$(deb libpoise-dev)" || return 1
  timed "configured" inside cmake -S /trial/arm -B /trial/build \
    -DCMAKE_BUILD_TYPE=Release || return 1
  timed "built" inside cmake --build /trial/build || return 1
  timed "ran" inside /trial/build/arm /trial/arm.urdf || return 1
  # 13 kg times 9.81 m/s2.
  expect "the table holds 127.53 N" || return 1
  timed "ran with all layers" inside /trial/build/layers || return 1
  timed "pkg-config" inside sh -c 'g++ -std=c++17 /trial/arm/main.cc \
    $(pkg-config --cflags --libs poise_robot) -o /trial/by_pkg_config &&
    /trial/by_pkg_config /trial/arm.urdf' || return 1
  expect "the table holds 127.53 N" || return 1
  removed libpoise-dev libpoise0
}

# The push draws a plot, for which it needs matplotlib. That needs python3-scipy,
# which brings a compiler, or python3-munkres, which does not.
plotting=(python3-matplotlib python3-munkres)

push() {
  cp "$source_tree/docs/examples/python/push.py" "$root/trial" &&
    timed "a push in 15 lines" inside sh -c "cd /trial && $1 push.py" &&
    expect "recovered: True" && [ -s "$root/trial/push.png" ] &&
    [ -s "$root/trial/push.html" ]
}

step_deb_python() {
  copy_debs
  timed "installed python3-poise" apt_install "$(deb python3-poise)" || return 1
  timed "imported" inside python3 -c 'import poise; print(poise.__version__)' ||
    return 1
  expect "$(cat "$source_tree/VERSION")" || return 1
  timed "installed matplotlib" apt_install "${plotting[@]}" || return 1
  push python3 && without g++ cc clang && removed python3-poise
}

step_wheel() {
  local needs
  # The packages that the page names.
  needs=$(sed -n 's/^sudo apt install \([^.]*[0-9].*\)/\1/p' \
    "$source_tree/docs/quickstart/python.md")
  # shellcheck disable=SC2086
  timed "installed NumPy and libraries" apt_install \
    "${plotting[@]}" $needs || return 1
  cp "$built"/*.whl "$root/trial"
  timed "installed the wheel" inside sh -c \
    'python3 -m venv --system-site-packages /trial/environment &&
    /trial/environment/bin/pip install --no-index --no-deps /trial/*.whl' ||
    return 1
  push /trial/environment/bin/python && without g++ cc clang
}

# A clone of the last commit, as from a server, and the packages to build it.
clone() {
  git clone --quiet --bare "$source_tree" "$root/poise.git" &&
    git clone --quiet "$root/poise.git" "$root/trial/poise" &&
    timed "tools/setup.sh --layers dynamics" inside \
      /trial/poise/tools/setup.sh --layers dynamics
}

step_fetch_content() {
  clone || return 1
  mkdir "$root/trial/chain"
  cp "$root/trial/poise/docs/examples/dynamics/main.cc" "$root/trial/chain"
  rm -r "$root/trial/poise"
  {
    echo "cmake_minimum_required(VERSION 3.22)"
    echo "project(my_robot LANGUAGES CXX)"
    echo "add_executable(my_robot main.cc)"
    # The code block of the page that fetches Poise.
    sed -n '/^include(FetchContent)$/,/^```$/p' \
      "$source_tree/docs/quickstart/cmake.md" | grep -v '```'
  } > "$root/trial/chain/CMakeLists.txt"
  timed "fetched, built Poise's dynamics and configured" inside \
    cmake -S /trial/chain -B /trial/build -DCMAKE_BUILD_TYPE=Release \
    -DURL_OF_POISE=file:///poise.git \
    -DCOMMIT_OF_POISE="$(git -C "$root/poise.git" rev-parse HEAD)" || return 1
  timed "built the program" inside cmake --build /trial/build || return 1
  timed "ran" inside /trial/build/my_robot
}

step_colcon() {
  clone || return 1
  timed "installed colcon" apt_install colcon \
    python3-colcon-cmake python3-colcon-recursive-crawl || return 1
  mkdir -p "$root/trial/workspace/src"
  mv "$root/trial/poise" "$root/trial/workspace/src"
  local package=$root/trial/workspace/src/chain
  mkdir "$package"
  cp "$source_tree/docs/examples/dynamics/main.cc" "$package"
  cat > "$package/CMakeLists.txt" << 'EOT'
cmake_minimum_required(VERSION 3.22)
project(chain LANGUAGES CXX)
find_package(poise REQUIRED COMPONENTS dynamics)
add_executable(chain main.cc)
target_link_libraries(chain poise::dynamics)
install(TARGETS chain DESTINATION bin)
EOT
  sed 's/<name>poise</<name>chain</; s/<depend>eigen</<depend>poise</' \
    "$source_tree/package.xml" > "$package/package.xml"
  timed "colcon build" inside sh -c 'cd /trial/workspace &&
    colcon build --cmake-args -DPOISE_LAYERS=dynamics' || return 1
  timed "ran" inside sh -c 'cd /trial/workspace && . install/setup.sh &&
    install/chain/bin/chain'
}

passed=0 failed=0
for step in "$@"; do
  start=$SECONDS
  echo "$step"
  if { [ "$step" = lintian ] || timed "bare Debian 12" make_root; } &&
    "step_$step"; then
    passed=$((passed + 1))
    echo "  $step: passed in $((SECONDS - start)) s"
  else
    failed=$((failed + 1))
    echo "  $step: FAILED after $((SECONDS - start)) s"
  fi
done
remove_root
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
