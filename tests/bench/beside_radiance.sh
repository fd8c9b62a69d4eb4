#!/bin/bash
# The sample office beside Radiance: illuminance on 36 points and the mean luminance of one view, by electric light and
# under two skies. Both programs read the same scene text. Prints a table; needs oconv, rtrace, rpict, rcalc, pvalue,
# gensky and Radiance's skybright.cal (RAYPATH). Usage: tests/bench/beside_radiance.sh [FOLDER]
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
lightwell=${LIGHTWELL:-$root/build/release/lightwell}
out=${1:-$(mktemp -d)}
for program in oconv rtrace rpict rcalc pvalue gensky; do
    command -v $program > /dev/null || { echo "$program is not on the PATH: Radiance is needed" >&2; exit 2; }
done
mkdir -p "$out"
cd "$out"
export RAYPATH=${RAYPATH:-.:$(dirname "$(dirname "$(command -v oconv)")")/lib}

samples=${SAMPLES:-16384}  # of Lightwell, per point
divisions=${DIVISIONS:-512} # of Radiance, per point and run
runs=${RUNS:-4}
view="-vtv -vp 0.8 1.45 5.1 -vd 1 0.16 -0.14 -vu 0 0 1 -vh 75 -vv 46.6921"
# No ambient cache, no thresholds, paths ended by chance: the errors that remain are noise and -dj, -ds (see README).
brute="-ab 12 -as 0 -aa 0 -lr -14 -lw 1e-5 -dt 0 -dc 1 -dj 0.7 -ds 0.1 -dr 2 -st 0 -ss 1"
lux='$1=179*(0.265*$1+0.670*$2+0.065*$3)'

for y in 1.23 2.40 3.89 5.22; do
    for x in 1.37 3.92 6.47 9.02 11.57 14.12; do echo "$x $y 4.25 0 0 1"; done
done > grid.pts
for y in 1.1 2.05 3; do
    for x in 8.9 10.73 12.56 14.39; do echo "$x $y 0.75 0 0 1"; done
done >> grid.pts

cat > dome.rad <<'SCENE'
skyfunc glow skyglow
0
0
4 1 1 1 0
skyglow source sky
0
0
4 0 0 1 180
skyglow source ground
0
0
4 0 0 -1 180
SCENE
gensky -ang 37.7 -4.3 -c > overcast.sky
gensky -ang 37.7 -4.3 +s > clear.sky
office=$root/samples/office
"$lightwell" import "$office/office.dxf" --map "$office/map.toml" -o electric.rad --flat 2> /dev/null > /dev/null
"$lightwell" import "$office/office.dxf" --map "$office/map_daylight.toml" -o unlit.rad --flat 2> /dev/null > /dev/null
for sky in overcast clear; do cat $sky.sky dome.rad unlit.rad > $sky.rad; done

mean_luminance() { pvalue -h -H -b -d "$1" | awk '{ sum += $1 } END { printf "%.2f", 179 * sum / NR }'; }

echo "scene      Lightwell lx        Radiance lx         ratio             view: cd/m2, cd/m2, ratio"
for scene in electric overcast clear; do
    oconv $scene.rad > $scene.oct
    "$lightwell" illuminance $scene.rad --grid file:grid.pts --samples "$samples" -o $scene.csv 2> /dev/null > /dev/null
    for run in $(seq "$runs"); do
        rtrace -h -w -I $brute -ad "$divisions" $scene.oct < grid.pts | rcalc -e "$lux" > $scene.$run.txt
    done
    paste -d' ' $scene.[0-9]*.txt > $scene.all
    paste -d, <(tail -n +2 $scene.csv) $scene.all | awk -F, -v scene=$scene '
        { n = split($9, r, " "); m = q = 0
          for (i = 1; i <= n; i++) { m += r[i] / n; q += r[i]^2 / n }
          a += $7; b += m; ea += $8^2; if (n > 1 && q > m * m) eb += (q - m * m) / (n - 1) }
        END { printf "%-10s %.1f +- %.1f      %.1f +- %.1f      %.4f +- %.4f   ", scene, a / NR, sqrt(ea) / NR,
                     b / NR, sqrt(eb) / NR, a / b, a / b * sqrt(ea / a^2 + eb / b^2) }'
    "$lightwell" render $scene.rad --view "$view" --size 240x135 --samples 64 -o $scene.exr --hdr 2> /dev/null > /dev/null
    rpict -w $view -x 240 -y 135 -ps 1 -pj 1 $brute -ad 30 $scene.oct > $scene.radiance.hdr
    a=$(mean_luminance $scene.hdr) b=$(mean_luminance $scene.radiance.hdr)
    awk -v a="$a" -v b="$b" 'BEGIN { printf "%s %s %.4f\n", a, b, a / b }'
done
echo "files: $out"
