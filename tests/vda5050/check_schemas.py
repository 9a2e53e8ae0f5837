#!/usr/bin/env python3
"""Checks that recorded messages of a vehicle are what VDA 5050 says they are.

Each line of FILE is {"t": 12.5, "topic": "state", "message": {...}}. What comes from the vehicle (connection, state, factsheet) is
checked against the schemas of VDA 5050 2.1.0 and, where openTCS demands more, against those as well; beside the schemas, header ids go up
by one for each topic, and the first message is ONLINE. What comes from the master is passed over: a test may say nonsense on purpose.

    tests/vda5050/check_schemas.py FILE...

Exit code 0: all is well; 1: what is wrong is printed; 77: the package python3-jsonschema is missing.
"""
import json
import os
import sys

try:
    import jsonschema
except ImportError:
    sys.exit(77)

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "data", "vda5050")
OF_VEHICLE = ("connection", "state", "factsheet", "visualization")


def read_schema(path):
    with open(os.path.join(DATA, path), encoding="utf-8") as file:
        return json.load(file)


def validators():
    """For each topic the schemas that its messages have to satisfy: {topic: [(name, validator)]}."""
    found = {topic: [("VDA 5050 2.1.0", read_schema(f"v2.1.0/{topic}.schema"))] for topic in OF_VEHICLE}
    # The text of 2.1 has PAUSED among the states of an action (6.11, table 2), its schema forgot it.
    status = found["state"][0][1]["properties"]["actionStates"]["items"]["properties"]["actionStatus"]["enum"]
    if "PAUSED" not in status:
        status.append("PAUSED")
    for topic in ("connection", "state"):
        found[topic].append(("openTCS", read_schema(f"openTCS-v2_0/{topic}.schema.json")))
    return {topic: [(name, jsonschema.validators.validator_for(schema)(schema)) for name, schema in schemas] for topic, schemas in found.items()}


def check_file(path, schemas):
    """The faults of a file, and how many messages it has."""
    faults, expected, checked = [], {}, 0
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            where = f"{path}:{number}"
            entry = json.loads(line)
            topic, message = entry["topic"], entry["message"]
            if topic not in OF_VEHICLE:
                continue
            checked += 1
            for name, validator in schemas[topic]:
                for error in validator.iter_errors(message):
                    faults.append(f"{where}: {name}: {topic}.{'.'.join(map(str, error.absolute_path))}: {error.message}")
            if checked == 1 and message.get("connectionState") != "ONLINE":
                faults.append(f"{where}: the first message is not ONLINE")
            if message.get("connectionState") == "CONNECTIONBROKEN":   # written before the others, said by the broker
                continue
            if message.get("headerId") != expected.get(topic, 0):
                faults.append(f"{where}: {topic}: headerId {message.get('headerId')}, not {expected.get(topic, 0)}")
            expected[topic] = message.get("headerId", 0) + 1
    if checked == 0:
        faults.append(f"{path}: no message of a vehicle")
    return faults, checked


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    schemas = validators()
    faults, checked = [], 0
    for path in sys.argv[1:]:
        more, count = check_file(path, schemas)
        faults += more
        checked += count
    print("\n".join(faults + [f"messages: {checked}, {len(faults)} faults"]))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
