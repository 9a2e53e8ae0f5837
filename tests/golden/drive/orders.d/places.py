"""Where a vehicle has said that it is, beside where it was: places.py MESSAGES CSV."""
import csv
import json
import sys

truth = {round(float(row["t"]), 1): row for row in csv.DictReader(open(sys.argv[2], encoding="utf-8"))}
for line in open(sys.argv[1], encoding="utf-8"):
    said = json.loads(line)
    row = truth.get(round(said["t"], 1))
    if said["topic"] != "visualization" or row is None:
        continue
    at = said["message"].get("agvPosition")
    is_at = " ".join(f'{float(row[key]):5.2f}' for key in ("x_m", "y_m", "heading_rad"))
    print(f'{said["t"]:6.2f}  {is_at}  ' + (" ".join(f'{at[key]:5.2f}' for key in ("x", "y", "theta")) if at else "unknown"))
