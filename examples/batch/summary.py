# SPDX-License-Identifier: MIT
"""A table of all cases: summary.py CASES OUT. Exit code 1 if a case is missing or its answer is no."""
import json
import os
import sys

cases, out = sys.argv[1:]
with open(cases, encoding="utf-8") as file:
    names = [line.split("\t")[0] for line in file if "\t" in line and not line.startswith("#")]
print("case", "answer", "vertices", "components", "genus", "filled", "seconds", "peak_bytes", sep="\t")
bad = 0
for name in names:
    path = os.path.join(out, name + ".json")
    if not os.path.exists(path):
        print(name, "missing", *[""] * 6, sep="\t")
        bad += 1
        continue
    with open(path, encoding="utf-8") as file:
        report = json.load(file)
    parts = report["components"]
    bad += bool(report["objections"])
    print(name, "; ".join(report["objections"]) or "yes", report["vertices"], len(parts),
          sum(part["genus"] for part in parts), f"{report['fill']['share']:.4f}",
          f"{report['seconds']['total']:.2f}", report["peak_bytes"], sep="\t")
sys.exit(1 if bad else 0)
