#!/usr/bin/env bash
# A broker, two simulated robots and their master, on this machine alone. Needs mosquitto, python3-paho-mqtt, and kbc on the path.
#
#   ./run.sh            two robots drive a lap by the clock, which takes some two minutes
#   SPEED=10 ./run.sh   ten times as fast
#   PYTHON=/usr/bin/python3 ./run.sh   if another Python than Debian's comes first on the path
set -euo pipefail
cd "$(dirname "$0")"
port=${PORT:-18830}
trap 'kill $(jobs -p) 2>/dev/null || true; wait' EXIT
mosquitto -p "$port" >/dev/null 2>&1 &
for serial in 1 2; do
  kbc sim yard.kb --scenario robot$serial.toml --speed "${SPEED:-1}" \
    --driver "kbc drive yard.kb --orders mqtt://127.0.0.1:$port --serial $serial --skill pick=2s" &
done
for _ in $(seq 50); do (echo >/dev/tcp/127.0.0.1/"$port") 2>/dev/null && break; sleep 0.1; done
${PYTHON:-python3} master.py --port "$port" --laps "${LAPS:-1}"
