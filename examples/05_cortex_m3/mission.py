#!/usr/bin/env python3
"""Turns a recording of facts (`t,Fact,...`, seconds, certainties; empty: no data) into a table of constants.

    mission.py RECORDING.csv HEADER.h

A microcontroller has no files. The header holds, tick by tick, only those facts that differ from the tick before.
"""
import csv
import re
import sys

HEAD = """// Made by mission.py from {name}: do not edit.
#pragma once

#include <cstdint>

#include "paper.kb.h"

namespace mission {{

/// One fact that changes, and its certainty from then on.
struct Sample {{
  paper::Fact fact;
  float certainty;
}};

inline constexpr std::uint32_t kTicks = {ticks};
inline constexpr std::uint32_t kPeriodMs = {period};
"""


def main():
    source, target = sys.argv[1:]
    with open(source, newline="", encoding="utf-8") as file:
        names, *ticks = list(csv.reader(file))
    facts = [re.sub(r"\W", "_", name) for name in names[1:]]
    period = round(1000 * (float(ticks[1][0]) - float(ticks[0][0])))
    before = [0.0] * len(facts)
    begins, samples = [], []
    for number, row in enumerate(ticks, 1):
        begins.append(len(samples))
        for i, text in enumerate(row[1:]):
            value = float(text or 0)
            if value != before[i]:
                samples.append(f"    {{paper::Fact::{facts[i]}, {value!r}f}},  // tick {number}")
                before[i] = value
    begins.append(len(samples))
    lines = [HEAD.format(name=source.replace("\\", "/").split("/")[-1], ticks=len(ticks), period=period)]
    lines += ["/// The samples of tick i, counted from 0, are those from kBegin[i] to before kBegin[i + 1].",
              "inline constexpr std::uint16_t kBegin[kTicks + 1] = {"]
    lines += ["    " + " ".join(f"{b}," for b in begins[i:i + 16]) for i in range(0, len(begins), 16)]
    lines += ["};", "", "inline constexpr Sample kSamples[] = {", *samples, "};", "", "}  // namespace mission", ""]
    with open(target, "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


if __name__ == "__main__":
    main()
