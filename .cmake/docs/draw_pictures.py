#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws examples/guide/figures/rooms.svg and step.svg.

  draw_pictures.py           writes both
  draw_pictures.py --check   fails if one of them is not what it would write

The rooms, their order and the arrows between them come from .ci/check_headers and from the includes of the headers, and
what each holds from the table of rooms in examples/guide/where.md;
the stages of a step are the list below, in the order of world/detail/impulse_dynamics.hpp.
"""
import os
import re
import sys
from html import escape

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
OUT = os.path.join(TOP, "examples", "guide", "figures")

# (stage, what it does, what it reads, what it writes)
STEP = [
    ("Predict", "bodies move by (1 - θ) h v", "q, v", "q_m"),
    ("Find pairs", "boxes with margin and skin", "q_m", "pairs"),
    ("Detect contacts", "points, normals, gaps, keys", "pairs, pair cache", "contacts"),
    ("Free velocities", "forces, gyroscopic terms", "v, f", "v_free"),
    ("Assemble", "tangents, levers and block of each contact", "contacts, M", "W"),
    ("Warm start", "impulses of the last step, by key", "contacts, last r", "p"),
    ("Correct overlaps", "a fifth of what is beyond the slop", "gaps, W", "q_m, gaps"),
    ("Variants", "static or kinetic friction", "last slip", "laws"),
    ("Offset", "restitution or gap of the law", "v, gaps", "b"),
    ("Solve", "u = W r + b and the law at each contact", "W, b, p", "p, r, report"),
    ("Velocities", "v = v_free + M⁻¹ Jᵀ r", "v_free, r", "v"),
    ("Measure losses", "impacts, friction, rolling", "r, v", "energies"),
    ("Advance", "bodies move by θ h v", "q_m, v", "q"),
]

STYLE = """<style>
  text { font-family: Helvetica, Arial, sans-serif; font-size: 12px; fill: #222 }
  .name { font-weight: bold; font-size: 13px }
  .small { font-size: 11px; fill: #555 }
  .box { fill: #eef3f8; stroke: #5b7fa3 }
  .state { fill: #fbf3e4; stroke: #b98b3e }
  .arrow { stroke: #7d8b99; fill: none; marker-end: url(#head) }
</style>
<defs><marker id="head" markerWidth="8" markerHeight="8" refX="7" refY="3" orient="auto">
<path d="M0,0 L7,3 L0,6 z" fill="#7d8b99"/></marker></defs>
"""


def page(width, height, body):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
            f'height="{height}">\n{STYLE}<rect width="{width}" height="{height}" fill="white"/>\n{body}</svg>\n')


def text(x, y, words, kind="", anchor="middle"):
    return f'<text x="{x:g}" y="{y:g}" class="{kind}" text-anchor="{anchor}">{escape(words)}</text>\n'


def box(x, y, width, height, kind="box"):
    return f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="5" class="{kind}"/>\n'


def rooms():
    """The rooms in their order, the number of headers of each, and which rooms each includes."""
    with open(os.path.join(TOP, ".ci", "check_headers")) as file:
        order = re.search(r'(?m)^folders="(.*)"', file.read())[1].split()
    count, uses = {}, {room: set() for room in order}
    root = os.path.join(TOP, "include", "moreau")
    for room in order:
        for folder, _, names in sorted(os.walk(os.path.join(root, room))):
            for name in names:
                count[room] = count.get(room, 0) + 1
                with open(os.path.join(folder, name)) as file:
                    uses[room].update(re.findall(r'#include "moreau/(\w+)/', file.read()))
        uses[room].discard(room)
    return order, count, uses


def holdings():
    """What each room holds, in a few words."""
    with open(os.path.join(TOP, "examples", "guide", "where.md")) as file:
        return dict(re.findall(r"(?m)^\| `(\w+)` \| ([^|]+) \|", file.read().split("\n## Two questions")[0]))


def route(start, end, between):
    """The points of an arrow between two rooms on different floors, which passes the floors between them through the gaps
    between their boxes.

    between: for each of these floors from the top, its upper and lower side and the places of its gaps."""
    points = [start]
    for upper, lower, gaps in between:
        x, y = points[-1]
        straight = x + (end[0] - x) * ((upper + lower) / 2 - y) / (end[1] - y)
        gap = min(gaps, key=lambda at: abs(at - straight))
        points += [(gap, upper), (gap, lower)]
    return points + [end]


def draw_rooms():
    order, count, uses = rooms()
    holds = holdings()
    reach, floor = {}, {}
    for room in order:
        reach[room] = set().union(uses[room], *(reach[used] for used in uses[room]))
        floor[room] = 1 + max((floor[used] for used in uses[room]), default=-1)
    # An arrow that others imply is left out.
    arrows = [(room, used) for room in order for used in order if used in uses[room]
              and not any(used in reach[other] for other in uses[room])]
    floors = max(floor.values()) + 1
    rows = [[room for room in order if floor[room] == level] for level in range(floors)]
    w, h, dx, dy = 168, 44, 24, 40
    width = max(len(row) for row in rows) * (w + dx) + dx
    height = floors * (h + dy) + 16
    place = {}
    for level, row in enumerate(rows):
        left = (width - len(row) * (w + dx) + dx) / 2
        # Rooms above those that they use, as far as the order of a row allows it.
        if level:
            row.sort(key=lambda room: sum(place[used][0] for used in uses[room]) / max(1, len(uses[room])))
        for k, room in enumerate(row):
            place[room] = (left + k * (w + dx), height - 16 - h - level * (h + dy))
    body = ""
    for room, used in arrows:
        x, y = place[room][0] + w / 2, place[room][1] + h
        to_x, to_y = place[used][0] + w / 2, place[used][1]
        between = []
        for level in range(floor[room] - 1, floor[used], -1):
            upper = place[rows[level][0]][1]
            lefts = sorted(place[other][0] for other in rows[level])
            gaps = [left - dx / 2 for left in lefts] + [lefts[-1] + w + dx / 2]
            between.append((upper - 6, upper + h + 6, gaps))
        points = route((x, y), (to_x, to_y), between)
        points[0] = x + max(-w / 3, min(w / 3, (points[1][0] - x) / 4)), y
        points[-1] = to_x + max(-w / 3, min(w / 3, (points[-2][0] - to_x) / 4)), to_y
        body += '<path class="arrow" d="M' + " L".join(f"{at:g},{down:g}" for at, down in points) + '"/>\n'
    for room in order:
        x, y = place[room]
        body += box(x, y, w, h)
        body += text(x + w / 2, y + 18, f"{room} ({count[room]})", "name") + text(x + w / 2, y + 34, holds[room], "small")
    return page(width, height, body)


def draw_step():
    w, h, gap = 340, 40, 12
    width, left = 700, 180
    body = text(left - 20, 20, "reads", "small", "end") + text(left + w + 20, 20, "writes", "small", "start")
    for k, (stage, does, reads, writes) in enumerate(STEP):
        y = 32 + k * (h + gap)
        if k:
            body += f'<path class="arrow" d="M{left + w / 2:g},{y - gap:g} L{left + w / 2:g},{y:g}"/>\n'
        body += box(left, y, w, h)
        body += text(left + 12, y + 17, f"{max(1, k - 1)}. {stage}", "name", "start") + text(left + 12, y + 33, does, "small", "start")
        body += text(left - 20, y + 25, reads, "", "end") + text(left + w + 20, y + 25, writes, "", "start")
    return page(width, 32 + len(STEP) * (h + gap) + 8, body)


def main():
    stale = False
    for name, draw in (("rooms.svg", draw_rooms), ("step.svg", draw_step)):
        path = os.path.join(OUT, name)
        wanted = draw()
        if sys.argv[1:] == ["--check"]:
            found = open(path).read() if os.path.exists(path) else ""
            if found != wanted:
                stale = True
                print(f"{os.path.relpath(path, TOP)}: is out of date; .cmake/docs/draw_pictures.py draws it")
        else:
            with open(path, "w") as file:
                file.write(wanted)
    sys.exit(stale)


main()
