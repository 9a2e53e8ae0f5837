#!/usr/bin/env bash
# Runs example 10: example.sh FOLDER_OF_KBC FOLDER_OF_EXAMPLE. 77 where mosquitto or paho-mqtt is missing.
set -euo pipefail
export PATH=$1:$PATH:/usr/sbin PYTHON=/usr/bin/python3 SPEED=10
command -v mosquitto >/dev/null && $PYTHON -c 'import paho.mqtt.client' 2>/dev/null || exit 77
PORT=$($PYTHON -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
export PORT
cd "$2"
./run.sh | tee /dev/stderr | grep -q '^all laps are driven'
