#!/usr/bin/env python3
# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the parts, shapes and paths of experiments/press-fit.json, in this folder: a pin (pin.off), a clip of two arms (clip.off),
how the arms stand while the pin passes (bent-01.xyz ...), the way that the hand means to take (pin.tum) and that of the belt
(belt.tum). Meshes are in millimetres, paths in metres.

The arms give way as springs do: in every instant each stands where its spring balances what the pin exerts on it. What the pin
does meanwhile is computed along the axis alone: the hand's mass on its spring and damper, pushed by both arms. The device of the
experiment moves in three directions and feels every contact, and comes out near that.

    python3 experiments/press-fit/make.py [FOLDER]

It prints the list of shapes for the experiment."""

import math
import pathlib
import sys


def arc(x, z, radius, first, last, steps):
    """Points of a circle, angles in degrees."""
    angles = [math.radians(first + (last - first) * i / steps) for i in range(steps + 1)]
    return [(x + radius * math.cos(angle), z + radius * math.sin(angle)) for angle in angles]


# Radius and height, from the tip up: head, groove, collar, grip.
PIN = [(1.3, 0.3), (2.2, 1.2), *arc(2.6, 4.8, 1.0, -20.0, 40.0, 8), *arc(3.5, 8.3, 1.6, 250.0, 110.0, 10), (4.3, 11.3), (5.0, 12.2),
       (4.4, 13.2), (2.6, 13.8), (2.2, 15.0), (2.2, 20.0), (1.4, 20.8)]
PIN_TOP, PIN_SIDES = 21.0, 24
# The right arm from tip to floor: inner and outer points (x, z). The pin's tip is at z = 0.
INNER = [(4.6, 10.9), *arc(3.65, 8.3, 1.2, 110.0, 250.0, 10), (4.8, 5.6), (4.8, 3.5), (4.8, 1.8), (4.6, 0.5), (4.0, 0.0), (2.0, 0.0), (0.0, 0.0)]
OUTER = [(6.1, 10.9), *((6.4, 9.5 - 0.24 * i) for i in range(11)), (6.4, 5.6), (6.4, 3.5), (6.4, 1.8), (6.5, -0.2), (6.2, -1.6),
         (3.0, -2.0), (0.0, -2.0)]
CLIP = list(zip(INNER, OUTER))
NOSE = slice(0, 13)  # inner points that the pin can meet
HALF_WIDTH, ROOT, ARM_MIDDLE = 4.0, 1.0, 5.6  # half width along y, bend's root, middle fibre [mm]
TOP, CROWN = 10.9, 8.3

ARM = 1.0  # stiffness of an arm at the crown of its nose [N/mm]
CUTOFF, SATURATION, LARGEST = 1.0, 0.1, 2.0  # of the experiment's force [mm, mm, N]
MASS, DAMPING, STIFFNESS = 0.5, 0.02, 1.0  # the experiment's hand [kg, N s/mm, N/mm]

DURATION, INTERVAL = 1.6, 0.04  # of the run, and between shapes [s]
LEAST_BEND = 0.05  # a smaller motion of the arms [mm] makes no new shape
BELT_SPEED, BELT_START = 40.0, -26.0  # along x [mm/s, mm]
MAGAZINE = (-5.4, 32.0)  # first place of the pin in the magazine's lattice [mm]


def smooth(time, begin, end):
    """From 0 at the begin to 1 at the end, at rest at both."""
    s = min(1.0, max(0.0, (time - begin) / (end - begin)))
    return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s)


def belt(time):
    return BELT_START + BELT_SPEED * time


def meant(time):
    """The way of the hand: up out of the magazine, over to the clip and along with it, down, and on with the belt."""
    over = smooth(time, 0.15, 0.65)
    x = (1.0 - over) * MAGAZINE[0] + over * (belt(time) + 0.2)
    y = (1.0 - over) * MAGAZINE[1]
    return x, y, 14.0 * smooth(time, 0.05, 0.4) - 15.2 * smooth(time, 0.6, 1.3)


def bent(x, z, opening):
    """Where a point of the right arm goes when its crown moves outward by `opening`: a beam held at its root, pushed at its end."""
    length = TOP - ROOT
    share = (z - ROOT) / length
    if share <= 0.0:
        return x, z
    crown = (CROWN - ROOT) / length
    tip = opening / (crown * crown * (3.0 - crown) / 2.0)
    way, angle = tip * share * share * (3.0 - share) / 2.0, tip / length * (3.0 * share - 1.5 * share * share)
    aside = x - ARM_MIDDLE
    return ARM_MIDDLE + way + aside * math.cos(angle), z - aside * math.sin(angle)


def gap(height, opening):
    """Distance of the pin, its tip at a height, from an arm, and the direction (x, z) from the pin to it; in the plane of both axes."""
    pin = [(r, z + height) for r, z in PIN[:23]]
    arm = [bent(*inner, opening) for inner, _ in CLIP[NOSE]]
    best = (math.inf, (1.0, 0.0))
    for line, other, sign in ((pin, arm, 1.0), (arm, pin, -1.0)):
        for a, b in zip(line, line[1:]):
            along = (b[0] - a[0], b[1] - a[1])
            for point in other:
                t = ((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / (along[0] ** 2 + along[1] ** 2)
                t = min(1.0, max(0.0, t))
                away = (sign * (point[0] - a[0] - t * along[0]), sign * (point[1] - a[1] - t * along[1]))
                distance = math.hypot(*away)
                if distance < best[0]:
                    best = (distance, away)
    return best


def push(height, opening):
    """Force of the pin on an arm, (x, z) [N]."""
    distance, away = gap(height, opening)
    size = LARGEST * min(1.0, max(0.0, (CUTOFF - distance) / (CUTOFF - SATURATION)))
    return size * away[0] / distance, size * away[1] / distance


def balanced(height):
    """Opening at which an arm's spring balances the pin."""
    low, high = 0.0, 2.0
    for _ in range(24):
        middle = 0.5 * (low + high)
        outside = gap(height, middle)[1][0] > 0.0  # the pin has not passed through the arm
        low, high = (low, middle) if outside and push(height, middle)[0] < ARM * middle else (middle, high)
    return high


def openings():
    """Of the arms, shape by shape."""
    step, found = 0.002, []
    height, speed = meant(0.6)[2], 0.0
    for frame in range(round(DURATION / step) + 1):
        time = frame * step
        ahead = meant(time)[2]
        opening = 0.0
        if time > 0.6:
            opening = balanced(height)
            ahead_speed = (ahead - meant(time - step)[2]) / step
            force = STIFFNESS * (ahead - height) + DAMPING * (ahead_speed - speed) - 2.0 * push(height, opening)[1]
            if height < CUTOFF:  # the tip on the floor
                force += LARGEST * min(1.0, (CUTOFF - height) / (CUTOFF - SATURATION))
            speed += step * 1000.0 * force / MASS
            height += step * speed
        if frame % round(INTERVAL / step) == 0:
            found.append(opening)
    return found


def clip(opening):
    """Vertices (x, y, z) of the clip: its outline from the tip of the left arm to that of the right one, in front and behind."""
    half = [tuple(bent(*point, opening) for point in pair) for pair in CLIP]
    left = [tuple((-x, z) for x, z in pair) for pair in half[:-1]]
    outline = left + half[::-1]
    return [(x, y, z) for y in (-HALF_WIDTH, HALF_WIDTH) for pair in outline for x, z in pair]


def clip_triangles():
    pairs = 2 * len(CLIP) - 1
    quads = []
    for i in range(pairs - 1):
        inner, outer, next_inner, next_outer = 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3
        back = 2 * pairs
        quads += [(inner, outer, next_outer, next_inner), (back + inner, back + next_inner, back + next_outer, back + outer),
                  (inner, next_inner, back + next_inner, back + inner), (outer, back + outer, back + next_outer, next_outer)]
    last = 2 * pairs - 2
    quads += [(0, 2 * pairs, 2 * pairs + 1, 1), (last, last + 1, 2 * pairs + last + 1, 2 * pairs + last)]
    return [triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))]


def pin():
    angles = [2.0 * math.pi * i / PIN_SIDES for i in range(PIN_SIDES)]
    vertices = [(r * math.cos(a), r * math.sin(a), z) for r, z in PIN for a in angles]
    tip, top, last = len(vertices), len(vertices) + 1, len(vertices) - PIN_SIDES
    triangles = []
    for i in range(PIN_SIDES):
        j = (i + 1) % PIN_SIDES
        triangles += [(tip, j, i), (top, last + i, last + j)]
        for ring in range(0, last, PIN_SIDES):
            a, b, c, d = ring + i, ring + j, ring + PIN_SIDES + j, ring + PIN_SIDES + i
            triangles += [(a, b, c), (a, c, d)]
    return vertices + [(0.0, 0.0, 0.0), (0.0, 0.0, PIN_TOP)], triangles


def numbers(values, digits):
    return " ".join(f"{round(value, digits) + 0.0:.{digits}f}".rstrip("0").rstrip(".") for value in values)


def points(vertices):
    return "".join(numbers(vertex, 9) + "\n" for vertex in vertices)


def off(vertices, triangles):
    return f"OFF\n{len(vertices)} {len(triangles)} 0\n" + points(vertices) + "".join("3 %d %d %d\n" % triangle for triangle in triangles)


def tum(step, position, turn_deg):
    half = math.radians(turn_deg) / 2.0
    turn = numbers((0.0, 0.0, math.sin(half), math.cos(half)), 9)
    times = [step * i for i in range(math.ceil(DURATION / step - 1e-9) + 1)]
    return "".join(f"{numbers([time], 3)} {numbers((0.001 * value for value in position(time)), 7)} {turn}\n" for time in times)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    folder = folder if folder.is_dir() else folder.parent
    shapes, before = [], 0.0
    for opening in openings():
        if abs(opening - before) > LEAST_BEND:
            shapes.append(f"bent-{len(set(shapes))}.xyz")
            (folder / shapes[-1]).write_text(points(clip(opening)))
            before = opening
        else:
            shapes.append(shapes[-1] if shapes else "clip.off")
    while shapes[-2:-1] == shapes[-1:]:  # the last one is held
        shapes.pop()
    (folder / "clip.off").write_text(off(clip(0.0), clip_triangles()))
    (folder / "pin.off").write_text(off(*pin()))
    # With this turn no edge of the pin is parallel to one of the clip or of another pin.
    (folder / "pin.tum").write_text(tum(0.02, meant, 7.0))
    (folder / "belt.tum").write_text(tum(DURATION, lambda time: (belt(time), 0.0, 0.0), 0.0))
    print(shapes)


if __name__ == "__main__":
    main()
