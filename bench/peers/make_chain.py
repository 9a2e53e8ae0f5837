#!/usr/bin/env python3
"""Writes the chain of bench/peers/chain.h as a knowledge base: make_chain.py RULES OUTPUT.kb. Large ones are written in parts,
OUTPUT_0.kb and so on, since a file may have 16 MiB."""
import os
import sys

LEGS_A_PART = 100_000
HEAD = """# A chain of {legs} landmarks, written by bench/peers/make_chain.py.
levels follow > control
relation Leg(to, from, next)
    satellites of to exclusive

satellites Looking of Drive, Arrived of Wait exclusive
strategies Drive, Wait
priority Wait > Drive

rule go_home at follow
    when event Home
    then +Leg0, +Looking
rule arrive[l in Leg] at follow
    when seen l.to and l and Looking
    then +l.next, +Arrived
rule look_out[l in Leg] at follow
    when l and Arrived and not seen l.from
    then +Looking

"""


def main():
    legs, output = (int(sys.argv[1]) - 3) // 2, sys.argv[2]
    parts = []
    for first in range(0, legs, LEGS_A_PART):
        part = range(first, min(first + LEGS_A_PART, legs))
        facts = ''.join(f'fact L{i}\n' for i in part)
        rows = ''.join(f'row Leg{i} in Leg(to: L{i}, from: L{(i - 1) % legs}, next: Leg{(i + 1) % legs})\n' for i in part)
        parts.append(facts + rows)
    imports = ''
    for i, part in enumerate(parts if len(parts) > 1 else []):
        name = f'{output.removesuffix(".kb")}_{i}.kb'
        with open(name, 'w', encoding='utf-8') as out:
            out.write(part)
        imports += f'import "{os.path.basename(name)}"\n'
    with open(output, 'w', encoding='utf-8') as out:
        head = HEAD.format(legs=legs).replace('levels', imports + 'levels', 1)
        out.write(head + (parts[0] if len(parts) == 1 else '') + 'fact Home\n')


main()
