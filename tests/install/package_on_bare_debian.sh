#!/bin/bash
# Makes the Debian package of a build, has lintian look at it, installs it in a bare Debian 12, flies
# and opens the window there, repeats and reports a recording that was packed here, and removes it.
#   package_on_bare_debian.sh BUILD [ROOT]
# ROOT: a bare Debian 12 (debootstrap --variant=minbase bookworm ROOT), which is copied and left as
# it is; without it one is made. Needs to be root. Takes minutes and some 2 GB in TMPDIR.
set -u
build=$(realpath "$1")
given=${2:-}
scratch=$(mktemp -d "${TMPDIR:-/tmp}/octant-install-XXXXXX")
root=$scratch/root
display=
fail() { echo "FAILED: $*" >&2; exit 1; }
skip() { echo "SKIPPED: $*"; exit 0; }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
tidy() {
  [[ -z $display ]] || kill "$display"
  local place
  for place in mnt proc dev; do mountpoint -q "$root/$place" && umount -l "$root/$place"; done
  rm -rf --one-file-system "$scratch"
}
trap tidy EXIT

[[ $(id -u) -eq 0 ]] || skip "chroot needs root"
for program in cpack lintian Xvfb xdpyinfo; do
  command -v "$program" >/dev/null || skip "$program is not installed"
done
[[ -n $given ]] || command -v debootstrap >/dev/null || skip "debootstrap is not installed"

# The package.
(cd "$build" && cpack -B "$scratch/package") >"$scratch/cpack.log" 2>&1 || fail "cpack: $(tail -n 5 "$scratch/cpack.log")"
package=$(echo "$scratch"/package/octant_*.deb)
python_package=$(echo "$scratch"/package/python3-octant_*.deb)
library_package=$(echo "$scratch"/package/liboctant-dev_*.deb)
for each in "$package" "$python_package" "$library_package"; do
  bytes=$(stat -c %s "$each")
  echo "$(basename "$each"): $bytes bytes"
  [[ $bytes -le 15000000 ]] || fail "the package takes more than 15 MB"
  lintian --fail-on error --tag-display-limit 0 "$each" || fail "lintian finds errors"
done

# A bare system.
if [[ -n $given ]]; then
  cp -a "$given" "$root"
else
  debootstrap --variant=minbase bookworm "$root" >"$scratch/debootstrap.log" 2>&1 ||
    skip "no bare Debian can be made here: $(tail -n 1 "$scratch/debootstrap.log")"
fi
mount -t proc proc "$root/proc" && mount --bind /dev "$root/dev" || skip "proc and dev cannot be mounted"
cp /etc/resolv.conf "$root/etc/resolv.conf"
inside apt-get update -qq >"$scratch/apt.log" 2>&1 || skip "no package lists: $(tail -n 1 "$scratch/apt.log")"
cp "$package" "$root/root/octant.deb"
inside apt-get install -y -qq --no-install-recommends /root/octant.deb >>"$scratch/apt.log" 2>&1 ||
  fail "the package is not installed: $(tail -n 5 "$scratch/apt.log")"
for program in octant octant-study octant-verify; do inside $program --version || fail "$program --version"; done
inside octant draw-order concave --certificate /root/proof.txt --quiet && inside octant verify /root/proof.txt || fail "octant verify"
inside octant study refinement --frames 20 --out /root/tables --quiet || fail "octant study"

# A flight there, and one that was flown and packed here.
inside octant fly straight --seconds 2 --record /root/flight --quiet || fail "octant fly straight"
[[ -s $root/root/flight/report.html ]] || fail "there is no report"
"$build/octant" fly turn --aircraft 500md --terrain canyon --size 320x180 --seconds 2 --record "$scratch/here" --quiet >"$scratch/here.txt" ||
  fail "the flight here"
"$build/octant" pack "$scratch/here" --out "$root/root/packed.zip" --quiet || fail "octant pack"
"$build/octant" report "$root/root/packed.zip" --out "$scratch/here.html" --quiet || fail "the report here"
inside octant report /root/packed.zip --out /root/there.html --quiet || fail "the report there"
cmp "$scratch/here.html" "$root/root/there.html" || fail "the reports differ"
inside octant fly --settings /root/packed.zip --quiet --record /root/again >"$scratch/there.txt" || fail "the flight there"
for hash in state_hash picture_hash; do
  one=$(grep -o "\"$hash\": \"[0-9a-f]*\"" "$scratch/here/run.json")
  two=$(grep -o "\"$hash\": \"[0-9a-f]*\"" "$root/root/again/run.json")
  [[ -n $one && $one == "$two" ]] || fail "$hash here $one, there $two"
done
inside octant fly --replay /root/packed.zip --quiet || fail "the replay there"
echo "a packed recording: same report, same hashes"

# A recording that cannot be written to, and a disk that is full.
mount --bind "$root/root/flight" "$root/mnt" && mount -o remount,bind,ro "$root/mnt" || fail "a read-only place"
inside octant report /mnt --out /root/elsewhere.html --quiet || fail "the report of a read-only recording"
inside octant report /mnt --quiet 2>"$scratch/said.txt"
[[ $? -eq 2 && $(wc -l <"$scratch/said.txt") -eq 1 ]] || fail "a report into a read-only recording: $(cat "$scratch/said.txt")"
umount "$root/mnt"
mount -t tmpfs -o size=256k tmpfs "$root/mnt" || fail "a small disk"
inside octant report /root/flight --out /mnt/page.html --quiet 2>"$scratch/said.txt"
[[ $? -eq 2 && $(wc -l <"$scratch/said.txt") -eq 1 ]] || fail "a report onto a full disk: $(cat "$scratch/said.txt")"
[[ -z $(ls -A "$root/mnt") ]] || fail "half a report is left on a full disk: $(ls -A "$root/mnt")"
inside octant fly straight --size 64x48 --pictures 0 --record /mnt/flight --quiet 2>"$scratch/said.txt"
[[ $? -eq 2 && $(wc -l <"$scratch/said.txt") -eq 1 ]] || fail "a flight onto a full disk: $(cat "$scratch/said.txt")"
umount "$root/mnt"
echo "read-only recordings and full disks: one line each"

# The Python package: the scripts by which it was designed, and the notebooks.
cp "$python_package" "$root/root/python3-octant.deb"
inside apt-get install -y -qq --no-install-recommends /root/python3-octant.deb >>"$scratch/apt.log" 2>&1 ||
  fail "the Python package is not installed: $(tail -n 5 "$scratch/apt.log")"
mkdir -p "$root/root/tests/ui" "$root/root/ui"
cp -r "$(dirname "$0")/../ui/python" "$root/root/tests/ui/python" && cp -r "$(dirname "$0")/../../ui/examples" "$root/root/ui/examples"
for name in scripts notebooks; do
  inside python3 /root/tests/ui/python/${name}_test.py 2>"$scratch/python.log" || fail "python: $name: $(tail -n 20 "$scratch/python.log")"
done
inside apt-get purge -y -qq python3-octant >>"$scratch/apt.log" 2>&1 || fail "the Python package is not removed"
rm -r "$root/root/tests" "$root/root/ui"
echo "python3-octant: scripts and notebooks run"

# A data set over a map of one's own, and one of its samples again.
inside octant terrain make --kind hills --size 257 --seed 7 --out /root/map.tif --quiet || fail "octant terrain make"
cp "$(dirname "$0")/../../ui/examples/ring.toml" "$root/root/ring.toml"
data_set=(octant dataset --path pop-up --path turn --aircraft f15-detailed --terrain map.tif --cameras ring.toml
  --outputs rgb,depth,class,boxes --vary 'sun-elevation=5:60,clouds=0:0.7,visibility=3000:40000' --seed 3 --format coco --quiet)
inside env -C /root "${data_set[@]}" --count 20 --out data/ || fail "octant dataset"
inside env -C /root "${data_set[@]}" --count 24 --out data/ || fail "octant dataset goes on"
inside env -C /root "${data_set[@]}" --count 24 --only 17 --out alone/ || fail "octant dataset --only"
[[ -s $root/root/data/README.md && $(find "$root/root/data/samples" -name '*.json' | wc -l) -eq 24 ]] || fail "the data set is not whole"
while read -r file; do
  cmp "$root/root/data/$file" "$root/root/alone/$file" || fail "sample 17 made alone is another one"
done < <(cd "$root/root/alone" && find . -type f -not -name dataset.json)
rm -r "$root/root/data" "$root/root/alone" "$root/root/map.tif" "$root/root/ring.toml"
echo "octant dataset: made, gone on with, sample 17 again"

# What C++ programs need of the library.
cp "$library_package" "$root/root/liboctant-dev.deb"
inside apt-get install -y -qq --no-install-recommends /root/liboctant-dev.deb >>"$scratch/apt.log" 2>&1 ||
  fail "liboctant-dev is not installed: $(tail -n 5 "$scratch/apt.log")"
inside apt-get install -y -qq --no-install-recommends g++ cmake make pkg-config >>"$scratch/apt.log" 2>&1 ||
  fail "g++, cmake and pkg-config are not installed: $(tail -n 5 "$scratch/apt.log")"
cp -r "$(dirname "$0")/../ui/library/consumer" "$root/root/consumer"
inside sh -c 'cd /root/consumer && cmake -S . -B built && cmake --build built &&
  g++ -std=c++20 main.cpp $(pkg-config --cflags --libs octant) -o by-pkg-config' >"$scratch/cpp.log" 2>&1 ||
  fail "a program with the library is not built: $(tail -n 5 "$scratch/cpp.log")"
for program in built/app by-pkg-config; do
  inside /root/consumer/$program | grep -q "no-such-map.tif: expected a file" || fail "the program $program with the library"
done
rm -r "$root/root/consumer"
echo "liboctant-dev: programs by find_package and by pkg-config run"
inside apt-get purge -y -qq liboctant-dev >>"$scratch/apt.log" 2>&1 || fail "liboctant-dev is not removed"

# The window, on a display of ours.
mkdir -p "$root/tmp/.X11-unix"
Xvfb -displayfd 3 -screen 0 1280x800x24 -listen tcp 3>"$scratch/display" >/dev/null 2>&1 &
display=$!
for tenth in {1..100}; do [[ -s $scratch/display ]] && break; sleep 0.1; done
number=$(cat "$scratch/display")
inside env DISPLAY="127.0.0.1:$number" timeout 900 octant view straight --window bench=20 --size 320x180 --json >"$scratch/bench.json" ||
  fail "octant view"
grep -q '"panels_hidden"' "$scratch/bench.json" || fail "octant view --window bench=20 --json: $(cat "$scratch/bench.json")"
echo "octant view: a window on a display"

# Nothing is left.
inside dpkg -L octant | while read -r file; do [[ -f $root$file ]] && echo "$file"; done >"$scratch/files"
[[ $(wc -l <"$scratch/files") -gt 20 ]] || fail "expected more than 20 files in the package"
inside apt-get purge -y -qq octant >>"$scratch/apt.log" 2>&1 || fail "the package is not removed"
while read -r file; do [[ -e $root$file ]] && fail "$file is left"; done <"$scratch/files"
left=$(inside find /usr /etc /var/lib -xdev -path '*octant*' -not -path '/var/lib/apt/*')
[[ -z $left ]] || fail "apt remove leaves $left"
echo "installed, flown, shown and removed: nothing is left"
