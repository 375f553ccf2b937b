#!/bin/bash
# Usage: browser_test.sh REPORT PUSH
# Builds the pages again and compares them with dist/. Then tests them in a real
# browser with new runs. Needs Node and Chromium (tools/setup.sh --browser), and
# npm's registry unless tools/viewer/node_modules exists.
set -euo pipefail

for program in node npm chromium; do
  PATH=$PATH:/usr/local/bin
  command -v "$program" > /dev/null || {
    echo "SKIPPED, nothing was tested: $program is not installed;" \
      "run tools/setup.sh --browser"
    exit 0
  }
done

report=$PWD/$1
push=$PWD/$2
# The folder of the sources: npm's folder, if there is one, is inside it.
viewer=$(dirname "$(readlink -f tools/viewer/package.json)")
work=$TEST_TMPDIR/viewer
out=${TEST_UNDECLARED_OUTPUTS_DIR:-$TEST_TMPDIR/out}
export HOME=$TEST_TMPDIR npm_config_cache=$TEST_TMPDIR/npm

mkdir -p "$work" "$out"
cp -rL tools/viewer/{build.mjs,package.json,package-lock.json,src,test,dist} "$work"
if [ -d "$viewer/node_modules" ]; then
  ln -s "$viewer/node_modules" "$work/node_modules"
else
  (cd "$work" && npm ci --ignore-scripts --no-audit --no-fund)
fi

cd "$work"
node build.mjs --out "$TEST_TMPDIR/built"
for page in report map; do
  cmp "dist/$page.html" "$TEST_TMPDIR/built/$page.html" || {
    echo "dist/$page.html was not built from these sources: npm run build" >&2
    exit 1
  }
done
node --test test/feed.test.mjs

cd "$OLDPWD"
"$push" --scenario strong_push --time 10 --no-report --out "$TEST_TMPDIR/stands"
"$push" --scenario strong_push_without_zmp --time 4 --no-report \
  --out "$TEST_TMPDIR/falls" || [ $? = 1 ]
cd "$work"
POISE_REPORT=$report POISE_STANDS=$TEST_TMPDIR/stands \
  POISE_FALLS=$TEST_TMPDIR/falls POISE_OUT=$out \
  node --test test/browser.test.mjs
