#!/usr/bin/env python3
"""A small master of VDA 5050: sends robots round the yard, and releases a node to one of them only if no other holds it.

    master.py [--host 127.0.0.1] [--port 1883] [--laps 1]

Needs paho-mqtt (Debian: python3-paho-mqtt). Ends when each robot has driven its laps.
"""
import argparse
import json
import sys
import threading
import time

try:
    import paho.mqtt.client as mqtt
except ImportError:
    sys.exit("master.py: there is no paho-mqtt; install python3-paho-mqtt, and run it with Debian's /usr/bin/python3")

RING = ["Bay", "Dock", "Shelf", "Press", "Store", "Hall"]
STARTS = {"1": "Bay", "2": "Press"}          # by serial number: the node that each comes to first
PICK = {"actionType": "pick", "blockingType": "HARD", "actionParameters": [{"key": "station", "value": "S1"}]}


class Robot:
    def __init__(self, serial, laps):
        start = RING.index(STARTS[serial])
        self.serial = serial
        self.way = [RING[(start + i) % len(RING)] for i in range(laps * len(RING) + 1)]
        self.base = 1                           # so many nodes are released
        self.passed = 0                         # the node of the way where it is
        self.update = -1
        self.state = None

    def held(self):
        return set(self.way[self.passed:self.base])

    def order(self, first):
        """From node `first` of the way on: what is released, and three nodes more that it may expect."""
        self.update += 1
        last = min(self.base + 3, len(self.way))
        nodes = [{"nodeId": self.way[i], "sequenceId": 2 * i, "released": i < self.base,
                  "actions": [dict(PICK, actionId=f"pick{i}")] if self.way[i] == "Press" and i > 0 else []} for i in range(first, last)]
        edges = [{"edgeId": f"{self.way[i]}-{self.way[i + 1]}", "sequenceId": 2 * i + 1, "released": i + 1 < self.base,
                  "startNodeId": self.way[i], "endNodeId": self.way[i + 1], "actions": []} for i in range(first, last - 1)]
        return {"orderId": f"lap-{self.serial}", "orderUpdateId": self.update, "nodes": nodes, "edges": edges}

    def done(self):
        state = self.state
        over = all(action["actionStatus"] in ("FINISHED", "FAILED") for action in state["actionStates"]) if state else False
        return self.passed == len(self.way) - 1 and over and not state["driving"]


class Master:
    def __init__(self, client, laps):
        self.client = client
        self.robots = {serial: Robot(serial, laps) for serial in STARTS}
        self.headers = 0
        self.began = time.monotonic()
        self.lock = threading.Lock()
        self.failed = None

    def told(self, message):
        _, _, _, serial, topic = message.topic.split("/")
        if topic != "state" or serial not in self.robots:
            return
        with self.lock:
            robot = self.robots[serial]
            first = robot.state is None
            robot.state = json.loads(message.payload)
            for error in robot.state["errors"]:
                self.say(f'{serial}: {error["errorLevel"]} {error["errorType"]}: {error.get("errorDescription", "")}')
                self.failed = self.failed or error["errorLevel"] == "FATAL"
            if not first and robot.state["orderId"]:
                passed = robot.state["lastNodeSequenceId"] // 2
                if passed != robot.passed:
                    robot.passed = passed
                    self.say(f"{serial}: at {robot.way[passed]}")
            self.release()

    def release(self):
        """Each robot gets the nodes before it that nobody else holds, two at the most."""
        for robot in self.robots.values():
            if robot.state is None:
                continue
            stitch = robot.base - 1
            others = set().union(*(other.held() for other in self.robots.values() if other is not robot))
            while robot.base < min(len(robot.way), robot.passed + 3) and robot.way[robot.base] not in others:
                robot.base += 1
            if robot.base - 1 > stitch or robot.update < 0:
                self.say(f"{robot.serial}: go on to {robot.way[robot.base - 1]}")
                self.send(robot, robot.order(stitch))

    def begin(self):
        self.client.subscribe("uagv/v2/Waymark/+/+")
        for robot in self.robots.values():      # one that is there already has said its state to nobody
            request = {"actionType": "stateRequest", "actionId": f"state-{robot.serial}", "blockingType": "NONE"}
            self.send(robot, {"actions": [request]}, "instantActions")

    def send(self, robot, said, topic="order"):
        self.headers += 1
        head = {"headerId": self.headers, "timestamp": time.strftime("%Y-%m-%dT%H:%M:%S.00Z", time.gmtime()), "version": "2.1.0",
                "manufacturer": "Waymark", "serialNumber": robot.serial}
        self.client.publish(f"uagv/v2/Waymark/{robot.serial}/{topic}", json.dumps({**head, **said}))

    def say(self, text):
        print(f"{time.monotonic() - self.began:6.1f} {text}", flush=True)

    def done(self):
        with self.lock:
            return all(robot.done() for robot in self.robots.values())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=1883)
    parser.add_argument("--laps", type=int, default=1)
    parser.add_argument("--within", type=float, default=600, help="seconds after which it gives up (600)")
    asked = parser.parse_args()
    version = getattr(mqtt, "CallbackAPIVersion", None)
    client = mqtt.Client(version.VERSION1) if version else mqtt.Client()
    master = Master(client, asked.laps)
    client.on_connect = lambda *_: master.begin()
    client.on_message = lambda _client, _userdata, message: master.told(message)
    client.connect(asked.host, asked.port)
    client.loop_start()
    while not master.done() and not master.failed and time.monotonic() - master.began < asked.within:
        time.sleep(0.05)
    good = master.done() and not master.failed
    print("all laps are driven" if good else "not all laps were driven", flush=True)
    client.loop_stop()
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
