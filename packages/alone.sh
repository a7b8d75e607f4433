#!/usr/bin/env bash
# The .deb in a root of its own that has nothing but a C library: the first commands of the README and ten others.
#   packages/alone.sh stickslip_0.2.0_amd64.deb
# Needs root (chroot, or unshare, which does without), dpkg-deb, and the C library of the package's machine; one for another
# machine runs by qemu-user (Debian: qemu-user-static, libc6-arm64-cross).
set -euo pipefail
deb=$(realpath "$1")
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT

dpkg-deb --extract "$deb" "$root"
architecture=$(dpkg-deb --field "$deb" Architecture)
# What `Depends: libc6` brings, and nothing else.
case $architecture in
"$(dpkg --print-architecture)")
  run=()
  for library in $(ldd "$root/usr/bin/stickslip" | grep -o '/[^ ]*'); do
    install -D "$library" "$root$library"
  done
  ;;
arm64)
  qemu=$(command -v qemu-aarch64-static)
  install -D "$qemu" "$root/qemu"
  run=(/qemu)
  mkdir -p "$root/lib"
  cp -a /usr/aarch64-linux-gnu/lib/{ld-linux-aarch64,libc,libm,libdl,libpthread,librt,libutil}.so.* "$root/lib"
  ;;
*)
  echo "no C library for $architecture" >&2
  exit 1
  ;;
esac
mkdir -p "$root/home" "$root/tmp" "$root/dev"
find "$root" -type f -name '*.so*' -printf '%P\n' -o -type f -perm -1 -printf '%P\n' | sort

stickslip() {
  echo "\$ stickslip $*"
  env --ignore-environment HOME=/home "$(command -v chroot)" "$root" "${run[@]}" /usr/bin/stickslip "$@" </dev/null
}

# Paths are from the root, which is where a chroot begins.
stickslip --version
stickslip --help | head -n 3
stickslip stability --r 1 --print critical.alpha
stickslip run --alpha 1.2 --r 1 --kick 0.05 --until 100 -o /home/run.json --plot /home/run.svg
stickslip surface /home/run.json --at 100 --range 0:110 --spacing 0.1 -o /home/surface.csv
stickslip cycle --alpha 1.2 --r 1 --print period
stickslip sweep --r 1 --alpha 0.5:3:11 -o /home/map.json
stickslip verify /home/run.json
stickslip boundary --r-range 0.05:3:200 -o /home/boundary.npz --plot /home/boundary.png
stickslip response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60 -o /home/response.csv
stickslip continue --r 1 --over alpha --to 1.5 -o /home/branches.json --plot /home/branches.pdf
stickslip raster --tip gaussian --alpha 0.45 --r 1 --pitch 0.5 --lines 16 --length 20 -o /home/raster.json --plot /home/raster.png
stickslip units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm --slope-force 5nN --indentation-rate 200nm/s --velocity 1um/s --format text
stickslip completions bash | grep -c -- --alpha-above
stickslip schema run | grep -c "\"description\""
test "$(stickslip stability --r 1 --print critical.alpha | tail -n 1 | cut -c 1-12)" = 1.0690361749
for file in run.json run.svg surface.csv map.json boundary.npz boundary.png response.csv branches.json branches.pdf raster.json raster.png; do
  test -s "$root/home/$file" || { echo "no $file" >&2; exit 1; }
done
# No file but those that were named, in the whole root.
left=$(cd "$root" && find tmp dev home -type f | sort | tr '\n' ' ')
echo "written: $left"
test "$(wc -w <<<"$left")" -eq 11
test -s "$root/usr/share/doc/stickslip/THIRD-PARTY-NOTICES.txt.gz"
test -s "$root/usr/share/man/man1/stickslip-run.1.gz"
echo "all well, of $(basename "$deb")"
