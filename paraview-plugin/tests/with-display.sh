#!/usr/bin/env bash
# with-display.sh PROGRAM ARGUMENT…: runs it on an X server of its own, as ParaView's programs ask for one even off screen.
set -euo pipefail
log=$(mktemp)
Xvfb -displayfd 3 -screen 0 1400x900x24 -nolisten tcp -noreset 3>"$log.display" 2>"$log" &
server=$!
trap 'kill $server; rm -f "$log" "$log.display"' EXIT
for _ in $(seq 300); do
  [ ! -s "$log.display" ] || break
  kill -0 $server 2>/dev/null || { cat "$log" >&2; exit 1; }
  sleep 0.1
done
DISPLAY=:$(cat "$log.display") "$@"
