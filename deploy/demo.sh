#!/usr/bin/env bash
# The main job from nothing: installs packages, builds, serves a scene, connects a client that replays a gaze
# recording, saves frames and a video, and prints a summary.
set -euo pipefail

usage() {
    cat <<USAGE
usage: deploy/demo.sh [options]
  --scene NAME|FILE      bunny-box, air-shed, or any .gltf / .glb              (default bunny-box)
  --gaze FILE|SOURCE     a recording (Macula CSV or Salient360), or a source such as sim:7
                         (default: a simulated viewer, recorded first and then replayed)
  --seconds N            how long the client stays connected         (default 10)
  --headset NAME|FILE    desktop, vive, or a display file            (default desktop)
  --sampling METHOD      18, 27, 41, 54 (percent), full, or any of server/METHODS.md  (default 18)
  --out DIR              where pictures, video and tables go         (default out/demo)
USAGE
}

scene=bunny-box gaze= seconds=10 headset=desktop sampling=18 out=out/demo
called_from=$PWD
while [ $# -gt 0 ]; do
    case $1 in
        --scene | --gaze | --seconds | --headset | --sampling | --out)
            [ $# -ge 2 ] || { echo "demo: $1 needs a value" >&2; exit 2; }
            declare "${1#--}=$2"
            shift 2
            ;;
        -h | --help) usage; exit 0 ;;
        *) echo "demo: unknown option '$1'" >&2; usage >&2; exit 2 ;;
    esac
done
[[ $seconds =~ ^[1-9][0-9]*$ ]] || { echo "demo: --seconds needs a whole number above 0, not '$seconds'" >&2; exit 2; }

# Paths are the caller's; everything else happens in the repository.
absolute() { case $1 in /*) echo "$1" ;; *) echo "$called_from/$1" ;; esac; }
[ -e "$(absolute "$scene")" ] && scene=$(absolute "$scene")
[ -e "$(absolute "$headset")" ] && headset=$(absolute "$headset")
if [ -n "$gaze" ] && [[ $gaze != *:* ]]; then
    gaze=$(absolute "$gaze")
    [ -r "$gaze" ] || { echo "demo: no recording at $gaze" >&2; exit 3; }
    gaze="replay:$gaze?loop"
fi
cd "$(dirname "$0")/.."
case $out in /*) ;; out/demo) out=$PWD/$out ;; *) out=$called_from/$out ;; esac

step() { printf '\n== %s\n' "$*"; }

step "Packages"
deploy/install-packages.sh

step "Build (the first one takes a few minutes)"
cmake --preset release >/dev/null
cmake --build --preset release --target macula-server macula-client
server=build/release/server/macula-server
client=build/release/client/macula-client

rm -rf "$out"
mkdir -p "$out/frames"
if [ -z "$gaze" ]; then
    step "Record a simulated viewer for $seconds s of replay"
    "$client" --connect none --gaze sim:7 --seconds "$seconds" --record "$out/gaze.csv"
    gaze="replay:$out/gaze.csv?loop"
fi

step "Server: $scene"
"$server" --scene "$scene" --listen 127.0.0.1:0 --state "$out/state" >"$out/server.log" 2>&1 &
server_pid=$!
trap 'kill "$server_pid" 2>/dev/null || true; wait "$server_pid" 2>/dev/null || true' EXIT
port=
for _ in $(seq 600); do
    port=$(sed -n 's/.*listening on .*:\([0-9][0-9]*\).*/\1/p' "$out/server.log" | head -n 1)
    [ -n "$port" ] && break
    kill -0 "$server_pid" 2>/dev/null || {
        status=0
        wait "$server_pid" || status=$?
        echo "demo: the server ended with code $status:" >&2
        cat "$out/server.log" >&2
        exit "$status"
    }
    sleep .1
done
[ -n "$port" ] || { echo "demo: the server did not start within 60 s, see $out/server.log" >&2; exit 4; }
cat "$out/server.log"

step "Client: $headset, sampling $sampling, $gaze, $seconds s"
status=0
"$client" --connect "127.0.0.1:$port" --state "$out/state" --gaze "$gaze" --seconds "$seconds" \
    --headset "$headset" --sampling "$sampling" \
    --display "png:$out/frames?every=30" --display "mp4:$out/video.mp4" \
    --stats "$out/frames.csv" --summary "$out/summary.txt" || status=$?
if [ "$status" -ne 0 ]; then
    echo "demo: the client ended with code $status; the server's log is $out/server.log" >&2
    exit "$status"
fi

step "Result"
echo "pictures   $out/frames ($(find "$out/frames" -name '*.png' | wc -l) files)"
echo "video      $out/video.mp4"
echo "per frame  $out/frames.csv"
echo "server log $out/server.log"
