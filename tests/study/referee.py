# SPDX-License-Identifier: MIT
"""Numbers of the first pages and of the report of the study, computed again from the table of the runs by another way: own selection
of the runs, own statistics (Student's t by integration of its density, medians by the bootstrap beside Welch's intervals). Shares no code
with the scripts that write the pages. Argument: the top folder."""
import functools
import json
import math
import pathlib
import random
import re
import sys
import unittest

TOP = pathlib.Path(sys.argv.pop(1) if len(sys.argv) > 1 else ".").resolve()
RESULTS = TOP / "examples/ratcheting/results"
LINES = [json.loads(line) for line in (RESULTS / "runs.jsonl").read_text(encoding="utf8").splitlines()]


def pick(shape, rigid, jammed, control=False, **other):
    """One number of periods and one set of parameters; every parameter that is not named has the paper's value."""
    want = {"grains": 1200, "frequency": 5, "gravity": 9.81, "wall_mass_ratio": 0.5, "box_ratio": 1, "size_scale": 1, "friction": 0.4,
            "fmin": 0, "size_reading": "circumdiameter", "lid_force_weights": 10, "flatness": 1, "wall_speed": 0, "fewest_vertices": 0,
            "most_vertices": 0, "width_ratio": 1, "side_walls": "frictionless", "stiffness": None if rigid else 1e8, "step": 2e-4,
            "tolerance": 1e-4 if rigid else 1e-5, "fmax": None} | other
    if want["fmax"] is None:
        want["fmax"] = 5 * want["grains"]
    usual = {"flatness": 1, "wall_speed": 0, "fewest_vertices": 0, "most_vertices": 0, "width_ratio": 1, "side_walls": "frictionless"}
    found = []
    for line in LINES:
        p = line["parameters"]
        if p["shape"] != shape or ("from" in p) != jammed or (p["method"] == "contact-dynamics") != rigid:
            continue
        if (p["seed"] > 30) != control or p["max_sweeps"] == 200 or p["overlap_correction"] != rigid:
            continue
        if any(v is not None and not _same(p.get(k, usual.get(k)), v) for k, v in want.items()):
            continue
        count = len(line["periods"]["x_j"])
        if jammed and not 4 <= count <= 5 or not jammed and not 0.5 < p["duration"] <= 1:
            continue
        found.append(line)
    longest = max((line["parameters"]["duration"] for line in found), default=0)
    return [line for line in found if jammed or line["parameters"]["duration"] == longest]


def _same(a, b):
    return abs(a - b) <= 1e-9 * abs(b) if isinstance(b, (int, float)) and a is not None else a == b


def excursion_over_load(line, key="dx_active"):
    """C = Δx (m + m_w) fmax ν² / (m g)²."""
    p = line["parameters"]
    return line[key] * (1 + p["wall_mass_ratio"]) * line["mass"] * p["fmax"] * p["frequency"] ** 2 / (line["mass"] * p["gravity"]) ** 2


def period_strain(line):
    """Of the first four periods, from the positions of the wall at the maxima of f."""
    x = line["periods"]
    return sum(a - b for a, b in zip(x["x_j"][:4], x["x_j_after"][:4])) / (4 * line["length"])


def strain_both_have(line):
    """Of the periods that the two runs of a packing have: a run from a jammed state begins one period later."""
    x, first = line["periods"], 0 if "from" in line["parameters"] else 1
    return sum(a - b for a, b in zip(x["x_j"][first:first + 3], x["x_j_after"][first:first + 3])) / (3 * line["length"])


@functools.cache
def t_quantile(freedom, share=0.95):
    """t with this share of Student's density between -t and t, by Newton's method and Simpson's rule."""
    scale = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(freedom * math.pi)

    def density(x):
        return scale * (1 + x ** 2 / freedom) ** (-(freedom + 1) / 2)

    def half_mass(t, n=400):
        f = [density(k * t / n) for k in range(n + 1)]
        return t / n / 3 * (f[0] + f[-1] + 4 * sum(f[1:-1:2]) + 2 * sum(f[2:-1:2]))
    t = 1.0  # below the root, where the mass is concave: the steps only rise
    for _ in range(60):
        step = (share / 2 - half_mass(t)) / density(t)
        t += step
        if abs(step) < 1e-9:
            break
    return t


def mean_and_variance(values):
    m = sum(values) / len(values)
    return m, sum((v - m) ** 2 for v in values) / (len(values) - 1) / len(values)


def student(values):
    m, variance = mean_and_variance(values)
    half = t_quantile(len(values) - 1) * math.sqrt(variance)
    return m, m - half, m + half


def welch(above, below, share=0.95):
    """Ratio of geometric means."""
    (a, va), (b, vb) = (mean_and_variance([math.log(v) for v in x]) for x in (above, below))
    freedom = (va + vb) ** 2 / (va ** 2 / (len(above) - 1) + vb ** 2 / (len(below) - 1))
    half = t_quantile(freedom, share) * math.sqrt(va + vb)
    return math.exp(a - b), math.exp(a - b - half), math.exp(a - b + half)


def fieller(above, below, share=0.95):
    """Ratio of the sums of the means of several sets: the roots of Fieller's square equation, again and again with the t of Welch's degrees
    of freedom at the root that was found last. Infinite ends, if there is no root."""
    sides = [[(*mean_and_variance(v), len(v) - 1) for v in side] for side in (above, below)]
    (a, va), (b, vb) = ((sum(m for m, _, _ in side), sum(v for _, v, _ in side)) for side in sides)
    ends = []
    for sign in (-1, 1):
        r = a / b
        for _ in range(200):
            terms = [(v, n) for _, v, n in sides[0]] + [(r * r * v, n) for _, v, n in sides[1]]
            t = t_quantile(round(sum(v for v, _ in terms) ** 2 / sum(v * v / n for v, n in terms), 3), share)
            square, half, rest = b * b - t * t * vb, a * b, a * a - t * t * va
            if square <= 0 or half * half < square * rest:
                r = sign * math.inf
                break
            last, r = r, 0.5 * r + 0.5 * (half + sign * math.sqrt(half * half - square * rest)) / square
            if abs(r - last) < 1e-6 * abs(a / b):
                break
        ends.append(r)
    return (a / b, *ends)


def compared(above, below, of_means, share=0.95):
    return fieller([above], [below], share) if of_means else welch(above, below, share)


def p_value(above, below):
    """Of Welch's test of the means: by bisection, where the quantile is the distance of the means over its error."""
    (a, va), (b, vb) = (mean_and_variance(x) for x in (above, below))
    freedom = (va + vb) ** 2 / (va ** 2 / (len(above) - 1) + vb ** 2 / (len(below) - 1))
    low, high = 0.0, 1.0
    for _ in range(24):
        share = (low + high) / 2
        low, high = (share, high) if t_quantile(freedom, share) < abs(a - b) / math.sqrt(va + vb) else (low, share)
    return 1 - low


def bootstrap(above, below, count=4000):
    """95 % range of the ratio of geometric means of resampled samples."""
    draw = random.Random(5)
    logs = [[math.log(v) for v in x] for x in (above, below)]
    ratios = sorted(math.exp(sum(draw.choices(logs[0], k=len(above))) / len(above) - sum(draw.choices(logs[1], k=len(below))) / len(below))
                    for _ in range(count))
    return ratios[count // 40], ratios[-count // 40]


def load_over_length(line):
    p = line["parameters"]
    return line["mass"] * p["gravity"] ** 2 / ((1 + p["wall_mass_ratio"]) * p["fmax"] * p["frequency"] ** 2) / line["length"]


def strain_over_root(line):
    return period_strain(line) / math.sqrt(load_over_length(line))


def is_judged(line):
    return sum(map(abs, line["periods"]["drift"])) <= 0.3 * sum(map(abs, line["periods"]["dx_max"]))


# Name in the templates: function of a run, factor, whether ratios are of means.
MEASURED = {
    "C": (excursion_over_load, 1, False), "C_drift": (lambda r: excursion_over_load(r, "dx_max"), 1, False),
    "C_box": (lambda r: excursion_over_load(r) / (r["height"] / r["length"]) ** 1.2, 1, False),
    "C_drift_box": (lambda r: excursion_over_load(r, "dx_max") / (r["height"] / r["length"]) ** 1.2, 1, False),
    "strain_both": (strain_both_have, 1e4, True),
    "strain_root_both": (lambda r: strain_both_have(r) / math.sqrt(load_over_length(r)), 1e3, True),
    "strain": (period_strain, 1e4, True), "strain_root": (strain_over_root, 1e3, True), "dx": (lambda r: r["dx_active"], 1e3, False),
    "rate": (lambda r: r["rate"], 1e3, True), "rho_box": (lambda r: r["rho_box_initial"], 1, False),
    "rho_start": (lambda r: r["rho_initial"], 1, False), "rho_02": (lambda r: r["rho_0"], 1, False),
    "stress": (lambda r: r["behaviour"]["jammed_xx"] / r["behaviour"]["jammed_zz"], 1, False),
    "stress_active": (lambda r: r["behaviour"]["active_xx"] / r["behaviour"]["active_zz"], 1, False),
    "extension": (lambda r: r["behaviour"]["rho_extension"], 1e4, False), "contraction": (lambda r: r["behaviour"]["rho_contraction"], 1e4, False),
    "delay": (lambda r: r["delay"], 1e3, False),
    "rise": (lambda r: r["behaviour"]["active_slope"] * r["dx_active"] / r["parameters"]["fmax"], 100, False)}
NAMED = {"box": "box_ratio", "nu": "frequency", "wall": "wall_mass_ratio", "mu": "friction", "size": "size_scale", "lid": "lid_force_weights",
         "fmax": "fmax", "flat": "flatness"}
BOXES = {"polygon": {8: 49, 10.7: 91, 16: 209, 24: 480}, "disk": {8: 29, 10.7: 54, 16: 112, 24: 291},
         "polyhedron": {8: 493, 10.7: 1200, 16: 4063}, "sphere": {8: 174, 10.7: 424, 16: 1200, 24: 4876}}


def chosen(words):
    """The runs that a name of the templates means: SHAPE SET options, or SHAPE CONTACTS START options of the controls."""
    shape, kind, *more = words
    other = dict(word.split("=") for word in more if "=" in word)
    if kind in ("rigid", "compliant") and more and more[0] in ("filling", "jammed"):
        grains = 1200 if {"thousand", "ten", "five"} & set(more) else BOXES[shape][float(other.get("L", 10.7))]
        grains = round(grains * float(other.get("W", 1)))
        want = {"grains": grains, "frequency": float(other.get("nu", 5)), "fmax": 5 * grains * float(other.get("force", 1)),
                "width_ratio": float(other.get("W", 1)), "side_walls": other.get("walls", "frictionless"), "box_ratio": 1 if grains == 1200 else None}
        if kind == "compliant":
            want["stiffness"] = 1e8 * float(other.get("k", 1))
        which = (True,) if "ten" in more else (False,) if "five" in more else (False, True)
        return [r for control in which for r in pick(shape, kind == "rigid", more[0] == "jammed", control, **want)]
    want = {NAMED[key]: float(value) for key, value in other.items()}
    if "small" in more:
        want |= {"grains": {"polygon": 94, "disk": 111}[shape], "box_ratio": 0.9} | ({"tolerance": 1e-5} if kind == "rigid" else {})
    elif "fmax" not in want:
        want["fmax"] = 6000
    return pick(shape, kind == "rigid", kind == "jammed", **want)


def of_samples(found, value):
    """One number for each sample, without those that are not known."""
    samples = {}
    for line in found:
        samples.setdefault(line["parameters"]["seed"], []).append(value(line))
    return [sum(v) / len(v) for v in samples.values() if all(x is not None and math.isfinite(x) for x in v)]


def of_the_same_samples(word, *words):
    """Ratio of the means of the samples that both selections have; its ends by bisection: where Student's test of a - R b begins to reject.
    None, if it does not reject b = 0."""
    value, cut = MEASURED[word][0], words.index("/")
    first, second = ({line["parameters"]["seed"]: value(line) for line in chosen(part)} for part in (words[:cut], words[cut + 1:]))
    pairs = [(first[seed], second[seed]) for seed in sorted(first.keys() & second.keys())]
    if len(pairs) < 2:
        return None

    def rejects(r):
        _, low, high = student([x - r * y for x, y in pairs])
        return not low <= 0 <= high
    ratio = sum(x for x, _ in pairs) / sum(y for _, y in pairs)
    _, low, high = student([y for _, y in pairs])
    if low <= 0 <= high:
        return None
    ends = []
    for sign in (-1, 1):
        inside, step = ratio, 0.01
        while not rejects(ratio + sign * step):
            inside, step = ratio + sign * step, 1.2 * step
        outer = ratio + sign * step
        for _ in range(40):
            middle = (inside + outer) / 2
            inside, outer = (inside, middle) if rejects(middle) else (middle, outer)
        ends.append(inside)
    return (ratio, *ends, len(pairs))


def means_of_the_same_samples_differ(word, *words):
    value, cut = MEASURED[word][0], words.index("/")
    first, second = ({line["parameters"]["seed"]: value(line) for line in chosen(part)} for part in (words[:cut], words[cut + 1:]))
    _, low, high = student([first[seed] - second[seed] for seed in first.keys() & second.keys()])
    return not low <= 0 <= high


def of_samples_of_all(word, *words):
    """Geometric mean over the samples of all shapes that both selections have."""
    value, cut, logs = MEASURED[word][0], words.index("/"), []
    for shape in BOXES:
        first, second = ({line["parameters"]["seed"]: value(line) for line in chosen([shape, *part])} for part in (words[:cut], words[cut + 1:]))
        logs += [math.log(first[seed] / second[seed]) for seed in first.keys() & second.keys()]
    return (*map(math.exp, student(logs)), len(logs))


def of_all_lengths(word, plane, space, contacts, start, shortest=0, which="all"):
    """Of the ratios in boxes of equal length the geometric mean, or the ratio of the sums of the means; interval and number of lengths."""
    value, _, of_means = MEASURED[word]
    found = []
    for length in sorted(BOXES[plane].keys() & BOXES[space].keys()):
        both = [of_samples([r for r in chosen([shape, contacts, start, f"L={length}"])
                            if which == "all" or shape == space or r["facts"]["settled"]], value) for shape in (plane, space)]
        if length >= float(shortest) and min(map(len, both)) > 1:
            found.append(both)
    if of_means:
        return (*fieller(*zip(*found)), len(found))
    sides = [[mean_and_variance([math.log(x) for x in v]) for v in both] for both in found]
    terms = [(v, len(b) - 1) for pair, both in zip(sides, found) for (_, v), b in zip(pair, both)]
    variance = sum(v for v, _ in terms)
    half = t_quantile(variance ** 2 / sum(v * v / n for v, n in terms)) * math.sqrt(variance) / len(found)
    centre = sum(a - b for (a, _), (b, _) in sides) / len(found)
    return math.exp(centre), math.exp(centre - half), math.exp(centre + half), len(found)


def expected(name):
    """Value, low and high end of the interval, numbers of samples; None for a name that is not known here."""
    word, *rest = name.split()
    if word == "same_samples":
        return of_the_same_samples(*rest)
    if word == "same_samples_of_all":
        return of_samples_of_all(*rest)
    if word == "pooled":
        return of_all_lengths(*rest)
    if word == "at_rest":
        word, *rest = rest
        value, _, of_means = MEASURED[word]
        cut = rest.index("/")
        above, below = of_samples([r for r in chosen(rest[:cut]) if r["facts"]["settled"]], value), of_samples(chosen(rest[cut + 1:]), value)
        return (*compared(above, below, of_means), len(above), len(below))
    if word == "over_paper":
        rates = of_samples(chosen(rest), lambda r: r["rate"] / 0.025)
        return (*student(rates), len(rates))
    if word == "control":
        word, *rest = rest
    if word not in MEASURED or not rest:
        return None
    value, factor, of_means = MEASURED[word]
    if "/" in rest:
        cut = rest.index("/")
        above, below = (of_samples(chosen(part), value) for part in (rest[:cut], rest[cut + 1:]))
        if min(len(above), len(below)) < 2:
            return None
        return (*compared(above, below, of_means), len(above), len(below))
    values = of_samples(chosen(rest), value)
    return (*(factor * v for v in student(values)), len(values)) if len(values) > 1 else None


def at_equal_length(word, at_rest=False):
    """Values of the samples of the plane and of space in all boxes of equal length that have two samples or more of both."""
    value, sets = MEASURED[word][0], []
    for plane, space in (("polygon", "polyhedron"), ("disk", "sphere")):
        for length in BOXES[plane].keys() & BOXES[space].keys():
            for contacts in ("rigid", "compliant"):
                for start in ("filling", "jammed"):
                    both = [chosen([s, contacts, start, f"L={length}"]) for s in (plane, space)]
                    if min(len(of_samples(found, value)) for found in both) > 1:
                        sets.append([of_samples([r for r in found if k or not at_rest or r["facts"]["settled"]], value) for k, found in enumerate(both)])
    return sets


def outside(word, corrected=False, at_rest=False):
    """How many ratios of plane over space are below 1 and above it with their interval."""
    sets = at_equal_length(word, at_rest)
    ends = [compared(*values, MEASURED[word][2], 1 - 0.05 / len(sets) if corrected else 0.95)[1:] for values in sets]
    return sum(high < 1 for _, high in ends), sum(low > 1 for low, _ in ends)


def pearson(pairs):
    (a, va), (b, vb) = (mean_and_variance([p[k] for p in pairs]) for k in (0, 1))
    n = len(pairs)
    return sum(x * y for x, y in pairs) / n / (n - 1) / math.sqrt(va * vb) - a * b / (n - 1) / math.sqrt(va * vb)


def text_of(value):
    """As the pages have it: half the interval to two digits."""
    centre, low, high, *counts = value
    places = max(1 - math.floor(math.log10((high - low) / 2)), 0)
    text = f"{centre:.{places}f} [{low:.{places}f}, {high:.{places}f}]".replace("-", "−")
    return text + (f" ({' and '.join(map(str, counts))})" if counts else "")


NUMBERS = re.compile(r"(−?[\d.]+) \[(−?[\d.]+), (−?[\d.]+)\](?: \((\d+)(?: and (\d+))?\))?")


def told(template, page):
    """(name, text) of every place of a template, from the page that was made of it."""
    lines = iter(page.splitlines())
    for row in template.splitlines():
        if re.fullmatch(r"\{(?:table|control_table|not_run)[^}]*\}", row):
            continue
        places = re.findall(r"\{([^{}]+)\}", row)
        pattern = re.compile("(.*?)".join(re.escape(part) for part in re.split(r"\{[^{}]+\}", row)) + r"\Z")
        for line in lines:
            match = pattern.match(line)
            if match:
                yield from zip(places, match.groups())
                break


class Referee(unittest.TestCase):
    def test_numbers_of_the_pages(self):
        checked = 0
        for name in ("README", "report", "supplement"):
            places = list(told(*((RESULTS / (name + end)).read_text(encoding="utf8") for end in (".md.in", ".md"))))
            self.assertGreater(len(places), 30, name)
            for place, text in places:
                found, want = NUMBERS.fullmatch(text), expected(place)
                if not found or want is None:
                    continue
                checked += 1
                last = 0.51 * 10.0 ** -len(found[1].partition(".")[2])
                for k, number in enumerate(want[:3], 1):
                    self.assertLess(abs(float(found[k].replace("−", "-")) - number), last + 2e-4 * abs(number), f"{name}: {{{place}}}: {text}, {want}")
                if found[4]:  # those of all lengths have none
                    self.assertEqual([int(n) for n in found.groups()[3:] if n], list(want[3:]), f"{name}: {{{place}}}: {text}")
        self.assertGreater(checked, 150)

    def test_counts_of_runs_that_began_before_rest(self):
        pairs = [(s, kind == "rigid", jammed, BOXES[s][length], control) for s in BOXES for length in BOXES[s] for kind in ("rigid", "compliant")
                 for jammed in (False, True) for control in (False, True)]
        compared = [r for s, rigid, jammed, grains, control in pairs
                    for r in pick(s, rigid, jammed, control, grains=grains, box_ratio=1 if grains == 1200 else None)]
        at_work = [r for r in compared if not r["facts"]["settled"]]
        every = [r for r in LINES if not r["facts"]["settled"]]
        self.assertFalse([r["name"] for r in every if r["parameters"]["grains"] == 1200 or r["parameters"]["shape"] == "polygon"])
        named = (RESULTS / "set_aside.txt").read_text(encoding="utf8").split()
        made = [r for r in LINES if r["name"] in set(named)]
        told_of = (RESULTS / "README.md").read_text(encoding="utf8")
        self.assertIn(f"In {len(at_work)} of the {len(compared)} runs (disks, spheres)", told_of)
        self.assertIn(f"{len(named)} runs were named before they were made, {len(made)} were made", told_of)
        self.assertIn(f"{len(every)} runs, none with 1200 grains", (RESULTS / "report.md").read_text(encoding="utf8"))

    def test_ranges_that_are_typed(self):
        report = (RESULTS / "report.md").read_text(encoding="utf8")
        sets = (("compliant", "jammed"), ("compliant", "filling"), ("rigid", "filling"), ("rigid", "jammed"))
        ratios = [[100 * v - 100 for v in of_all_lengths("C", "disk", "sphere", c, s)[:3]] for c, s in sets]
        centres, ends = [v[0] for v in ratios], [end for v in ratios for end in v[1:]]
        self.assertIn("C {:.0f} to {:.0f} % more, intervals from {:.0f} to {:.0f} %".format(min(centres), max(centres), min(ends), max(ends)).replace("-", "−"), report)
        self.assertIn("{:.0f} to {:.0f} % above that of spheres,** intervals from {:.0f} to {:.0f} %".format(min(centres), max(centres), min(ends), max(ends)).replace("-", "−"), report)
        longer = [of_all_lengths("strain", "disk", "sphere", c, s, 10.7)[0] for c, s in sets]
        self.assertIn(f"{min(longer):.2f} to {max(longer):.2f} at 10.7 and 15.1", report)
        alone = [r for contacts, start in (("compliant", "filling"), ("compliant", "jammed"), ("rigid", "jammed"))
                 for r in (*(chosen(["polygon", contacts, start, "L=8"])), *(chosen(["polygon", contacts, start]) if contacts == "rigid" else ()),
                           *(chosen(["disk", contacts, start, "L=16"]) if contacts == "rigid" else ()))]
        self.assertIn(f"; {len(alone)} runs of the plane have no partner in space", report)
        soft = [r for s in ("polygon", "disk", "sphere") for nu in (10, 15, 20, 35, 60) for r in chosen([s, "compliant", "jammed", "thousand", f"nu={nu}", "k=0.1"])]
        kept = [r for r in soft if is_judged(r)]
        self.assertIn(f"at 1e7, {len(kept)} of {len(soft)} runs is judged", report)

    def test_numbers_of_comparisons(self):
        report = (RESULTS / "report.md").read_text(encoding="utf8")
        loads, heights = [], []
        for plane, space in (("polygon", "polyhedron"), ("disk", "sphere")):
            for length in BOXES[plane].keys() & BOXES[space].keys():
                for contacts in ("rigid", "compliant"):
                    for start in ("filling", "jammed"):
                        both = [chosen([s, contacts, start, f"L={length}"]) for s in (plane, space)]
                        if min(map(len, both)) > 1:
                            loads.append([sum(map(load_over_length, found)) / len(found) for found in both])
                            heights.append([sum(r["height"] / r["length"] for r in found) / len(found) for found in both])

        every = len(loads)
        (strain, none), (corrected, _) = outside("strain"), outside("strain", True)
        at_rest, of_c, of_c_at_rest = outside("strain", at_rest=True)[0], sum(outside("C")), sum(outside("C", at_rest=True))
        drift = outside("C_drift", True)
        self.assertEqual((none, sum(outside("C", True)), sum(outside("C", True, True)), *drift), (0, 0, 0, 0, 1))  # "none another C without drift, one with it"
        # Which they are.
        sets = [(s, c, b, length) for s, length in (("polygon", 10.7), ("disk", 8), ("disk", 10.7), ("disk", 16)) for c in ("rigid", "compliant") for b in ("filling", "jammed")]
        space = {"polygon": "polyhedron", "disk": "sphere"}
        least = {}
        for s, c, b, length in sets:
            plane, other = ([r for r in chosen([x, c, b, f"L={length}"])] for x in (s, space[s]))
            if min(len(plane), len(other)) > 1:
                for rest in (False, True):
                    values = of_samples([r for r in plane if not rest or r["facts"]["settled"]], period_strain), of_samples(other, period_strain)
                    if fieller([values[0]], [values[1]], 1 - 0.05 / every)[2] < 1:
                        least.setdefault(rest, set()).add((s, c, b, length))
        three = {("disk", "compliant", "jammed", 8), ("disk", "rigid", "jammed", 8), ("polygon", "rigid", "filling", 10.7)}
        self.assertEqual(least, {False: three, True: three | {("disk", "compliant", "filling", 8)}})
        self.assertGreater(expected("control C polygon rigid filling / polyhedron rigid filling")[1], 1)  # the one C that is not corrected
        with_drift = text_of(expected("control C_drift polygon rigid filling / polyhedron rigid filling"))
        at_rest_too = f"; {outside('strain', True, True)[0]} with the disks at rest alone"
        answers = [f"Of {every} comparisons in boxes of equal length, corrected for their number, {corrected} show a smaller strain of a period in the plane (two with the same "
                   f"disks, in boxes 8 grains long, one with polygons and rigid contacts, from the filling on{more}), by the logarithm of C none another C without drift, one "
                   f"with it (these polygons, {with_drift} times)." for more in ("", at_rest_too)]
        abstract, rest = report.split("## 1.", 1)
        results, first = ((folder / "README.md").read_text(encoding="utf8") for folder in (RESULTS, TOP))
        self.assertEqual([[text.count(answer) for answer in answers] for text in (abstract, first, rest, results)], [[1, 0], [1, 0], [0, 1], [0, 1]])
        # By means of C, not logarithms; and what lies at the limit.
        differ = [sum(p_value(*values) < 0.05 / every for values in at_equal_length(word)) for word in ("C", "C_drift")]
        self.assertEqual(differ, [1, 2])  # "one differs without drift and two with it"
        p = [p_value(*(of_samples(chosen([shape, *words]), value) for shape in shapes)) for shapes, value, words in (
            (("polygon", "polyhedron"), excursion_over_load, ("rigid", "filling")), (("disk", "sphere"), period_strain, ("compliant", "jammed", "L=8")),
            (("disk", "sphere"), period_strain, ("compliant", "filling", "L=8")))]
        self.assertIn(f"By means of C, not logarithms, one differs without drift (p = {p[0]:.4f}, limit {0.05 / every:.4f}) and two with it; disks, compliant, jammed "
                      f"(p = {p[1]:.4f}) and filling ({p[2]:.4f}), L/d = 8, lie at the limit, too.", report)
        self.assertIn(f"Not corrected, {strain} of {every} strains differ, all smaller in the plane, and {of_c} of {every} C, of polygons, rigid, filling (with the disks at rest "
                      f"alone {at_rest} and {of_c_at_rest}; with drift {sum(outside('C_drift'))}); over the periods that both starts have (section 5) "
                      f"{outside('strain_both')[0]} of {every} strains, corrected {outside('strain_both', True)[0]}.", report)
        self.assertIn(f"Not corrected, {strain} of {every} strains and {of_c} of {every} C (polygons, rigid, filling) differ, {sum(outside('C_drift'))} of {every} with drift.",
                      (RESULTS / "README.md").read_text(encoding="utf8"))
        apart = [100 * max(max(pair) / min(pair) - 1 for pair in kind) for kind in (loads, heights)]
        both = [h for pair in heights for h in pair]
        self.assertIn(f"ℓ/L (to {apart[0]:.0f} %), H/L ({min(both):.2f} to {max(both):.2f}, to {apart[1]:.0f} % between", report)
        names = [(q, s, "rigid", "jammed", f"L={length}", "/", s, "compliant", "jammed", f"L={length}") for s in BOXES for length in BOXES[s] for q in ("C", "strain")]
        same = [means_of_the_same_samples_differ(*name) for name in names if all(len(chosen(part)) > 1 for part in (name[1:5], name[6:]))]
        self.assertIn(f"({sum(same)} of {len(same)} differ)", report)

    def test_summaries_that_are_typed_or_made(self):
        report, first = ((RESULTS / name).read_text(encoding="utf8") for name in ("report.md", "README.md"))
        # What the strain would do if it went as the root of the load over the length.
        roots = [of_samples(chosen(["polygon", "compliant", "jammed", *more]), lambda r: math.sqrt(load_over_length(r))) for more in ([], ["thousand"])]
        root = welch(*roots)[0]
        self.assertIn(f"√(ℓ/L) asks for {root:.2f};", first)
        # Speed times ν at 10 over 5 Hz.
        rises = {}
        for shape in BOXES:
            at = [{r["parameters"]["seed"]: r["v_max"] for r in pick(shape, False, True, frequency=nu)} for nu in (5, 10)]
            rises[shape] = list(map(math.exp, student([math.log(2 * at[1][seed] / at[0][seed]) for seed in at[0].keys() & at[1].keys()])))
        self.assertGreater(min(low for _, low, _ in rises.values()), 1)
        order = sorted(rises, key=lambda s: rises[s][0])
        self.assertEqual((order[0], order[-1]), ("disk", "polyhedron"))
        for shape in ("disk", "polyhedron"):
            told_of = re.search(r"(\S+) \[(\S+), (\S+)\] \(5\) \(" + {"disk": "disks", "polyhedron": "polyhedra"}[shape], report[report.index("Claim 7: portraits"):])
            for text, value in zip(told_of.groups(), rises[shape]):
                self.assertAlmostEqual(float(text), value, delta=0.006)
        # Half the interval of C over C.
        for rigid, kind in ((True, "rigid, 3"), (False, "compliant, jammed, 5")):
            shares = []
            for shape in BOXES:
                mean, low, _ = student(of_samples(pick(shape, rigid, not rigid), excursion_over_load))
                shares.append(100 * (mean - low) / mean)
            self.assertIn(f"{min(shares):.0f} to {max(shares):.0f} % ({kind})", report)
        # Flat boxes.
        rates, times = [], []
        for rigid in (True, False):
            for other in ({}, {"size_scale": 1.3}, {"size_scale": 1.5}, {"flatness": 0.7}, {"fewest_vertices": 30}):
                found = pick("polyhedron", rigid, False, box_ratio=0.42, **other)
                if found:
                    rates.append([v / 0.025 for v in student(of_samples(found, lambda r: r["rate"]))])
                    times.append(student(of_samples(found, excursion_over_load))[0] / 0.01)
        self.assertIn("without it {:.2f} to {:.2f} times as large".format(min(times), max(times)), report)
        told_of = re.search(r"their rates are (\S+) to (\S+) of the paper's \(intervals from (\S+) to (\S+)\)", report).groups()
        for text, value in zip(told_of, (min(r[0] for r in rates), max(r[0] for r in rates), min(r[1] for r in rates), max(r[2] for r in rates))):
            self.assertAlmostEqual(float(text.replace("−", "-")), value, delta=0.0051)

    def test_settings_from_the_same_states(self):
        usual, *others = ({(r["parameters"]["seed"], nu): r for nu in (3.5, 7, 15) for r in pick("polyhedron", False, True, frequency=nu, step=step, tolerance=limit)}
                          for step, limit in ((2e-4, 1e-5), (1e-4, 1e-5), (2e-4, 1e-6)))
        keys = [k for k in usual if all(k in o and abs(o[k]["periods"]["x_j"][0] - usual[k]["periods"]["x_j"][0]) < 1e-4 * usual[k]["length"] for o in others)]
        seeds = sorted({seed for seed, _ in keys})
        changes = [student([sum(math.log(o[k]["dx_active"] / usual[k]["dx_active"]) for k in keys if k[0] == seed) / sum(k[0] == seed for k in keys)
                            for seed in seeds]) for o in others]
        most, low, high = max(abs(math.expm1(c[0])) for c in changes), min(c[1] for c in changes), max(c[2] for c in changes)
        self.assertIn(f"of polyhedra by {100 * most:.0f} % ({len(seeds)} samples; intervals from {math.exp(low):.2f} to {math.exp(high):.2f})",
                      (RESULTS / "report.md").read_text(encoding="utf8"))

    def test_scatter_of_the_states(self):
        # By the pairs of states and frequencies: half the mean of the squares of double differences is the variance within.
        found = {nu: {r["parameters"]["seed"]: math.log(period_strain(r)) for r in chosen(["disk", "compliant", "jammed", "ten", f"nu={nu}"])} for nu in (2, 5, 10)}
        seeds = sorted(set.intersection(*(set(at) for at in found.values())))
        pairs = [(a, b) for a in seeds for b in seeds if a < b]
        within = [((found[m][a] - found[m][b]) - (found[n][a] - found[n][b])) ** 2 / 4 for a, b in pairs for m, n in ((2, 5), (2, 10), (5, 10))]
        within = sum(within) / len(within)
        between = [(sum(found[nu][a] - found[nu][b] for nu in found) / 3) ** 2 / 2 for a, b in pairs]
        between = sum(between) / len(between) - within / 3
        table = (RESULTS / "supplement.md").read_text(encoding="utf8").split("| strain: between states |")[1]
        told_of = re.search(r"\| 2D, disks \| (\d+) \|(?: [^|]+\|){2} (\d+) \[(\d+), (\d+)\] \| (\d+) \[(\d+), (\d+)\]", table)
        values = list(map(int, told_of.groups()))
        self.assertEqual((values[0], values[1], values[4]), (len(seeds), round(100 * math.sqrt(between)), round(100 * math.sqrt(within))))
        self.assertTrue(values[2] < values[1] < values[3] and values[5] < values[4] < values[6])

    def test_powers_of_the_summary(self):
        def power(shape, rigid):
            usual = {"frequency": 5, "fmax": 6000, "gravity": 9.81, "wall_mass_ratio": 0.5}
            runs = {}
            for line in LINES:
                p = line["parameters"]
                if (p["shape"] != shape or p["seed"] > 30 or p["grains"] != 1200 or (p["method"] == "contact-dynamics") != rigid or ("from" in p) == rigid or
                        sum(not _same(p[k], v) for k, v in usual.items()) > 1 or p["fmax"] < 1000 or p["max_sweeps"] == 200 or p["step"] != 2e-4 or p.get("wall_speed") or
                        p["fmin"] or p["friction"] != 0.4 or p["box_ratio"] != 1 or p["size_scale"] != 1 or p["lid_force_weights"] != 10 or
                        p["size_reading"] != "circumdiameter" or p["overlap_correction"] != rigid or p["tolerance"] != (1e-4 if rigid else 1e-5) or
                        (not rigid and p["stiffness"] != 1e8) or any(k in p for k in ("flatness", "fewest_vertices", "most_vertices"))):
                    continue
                key = (p["seed"], *(p[k] for k in usual))
                if key not in runs or p["duration"] < runs[key]["parameters"]["duration"]:
                    runs[key] = line
            slopes = []
            for seed in {k[0] for k in runs}:
                points = [(math.log(load_over_length(r) * r["length"]), math.log(r["dx_active"])) for k, r in runs.items() if k[0] == seed and is_judged(r)]
                if len({x for x, _ in points}) < 3:
                    continue
                mx, my = (sum(v) / len(points) for v in zip(*points))
                slopes.append(sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points))
            return sum(slopes) / len(slopes)
        compliant, rigid = ({shape: power(shape, kind) for shape in BOXES} for kind in (False, True))
        self.assertEqual((min(compliant, key=compliant.get), max(compliant, key=compliant.get)), ("polyhedron", "disk"))
        report, first = ((folder / name).read_text(encoding="utf8") for folder, name in ((RESULTS, "report.md"), (TOP, "README.md")))
        abstract = report.split("## 1.")[0]
        self.assertRegex(abstract, rf"to a power of {compliant['polyhedron']:.3f} \[[^]]+\] \(5\) \(polyhedra\) to {compliant['disk']:.3f} \[[^]]+\] \(5\) \(disks\)")
        self.assertIn(f"to the power {compliant['polyhedron']:.3f} [", first)
        for shape, name in (("polyhedron", "polyhedra"), ("polygon", "polygons"), ("sphere", "spheres"), ("disk", "disks")):
            self.assertRegex(report, rf"\n\| {name} \| \d+ \| \S+ to \S+, \d+ % \| {rigid[shape]:.3f} \[")

    def test_strains_of_the_lengths_are_not_one_ratio(self):
        told_of = (RESULTS / "supplement.md").read_text(encoding="utf8")
        for contacts, start, value in (("compliant", "filling", period_strain), ("compliant", "jammed", period_strain), ("rigid", "filling", period_strain),
                                       ("compliant", "filling", strain_both_have)):
            sides = []
            for length in BOXES["disk"].keys() & BOXES["sphere"].keys():
                both = [of_samples(chosen([s, contacts, start, f"L={length}"]), value) for s in ("disk", "sphere")]
                if min(map(len, both)) > 1:
                    sides.append([mean_and_variance(v) for v in both])
            found = min(sum((a - r * b) ** 2 / (va + r * r * vb) for (a, va), (b, vb) in sides) for r in (k / 2000 for k in range(4000)))
            if value is period_strain:
                self.assertIn(f"{found:.1f} ({contacts}, {start})", told_of)
            elif start == "filling":
                self.assertGreater(found, 5.99)
                self.assertIn(f"without the first period {found:.1f}, 2 degrees", (RESULTS / "report.md").read_text(encoding="utf8"))

    def test_jammed_states(self):
        # Each is the end of the first period of a run from the filling on: compliant, 5 Hz, 5 N for each grain.
        by_name = {line["name"]: line for line in LINES}
        jammed = [line for line in LINES if "from" in line["parameters"]]
        for line in jammed:
            made = by_name[line["parameters"]["from"]]
            p = made["parameters"]
            self.assertEqual((len(made["periods"]["x_j"]), p["frequency"], p["fmax"] / p["grains"], p["gravity"], p["wall_mass_ratio"], p["method"], "from" in p),
                             (1, 5, 5, 9.81, 0.5, "compliant", False), line["name"])

    def test_only_the_first_period_differs_from_the_filling_on(self):
        report = (RESULTS / "report.md").read_text(encoding="utf8")
        for word, differs in (("strain_root", True), ("strain_root_both", False)):
            value = of_samples_of_all(word, "compliant", "filling", "thousand", "/", "compliant", "jammed", "thousand")
            self.assertEqual(not value[1] <= 1 <= value[2], differs)
            self.assertIn(text_of(value), report)
            for length in (8, 10.7, 16):
                words = ("disk", "compliant", "filling", f"L={length}", "/", "disk", "compliant", "jammed", f"L={length}")
                self.assertEqual(means_of_the_same_samples_differ(word.replace("_root", ""), *words), differs and length > 8)
                self.assertFalse(means_of_the_same_samples_differ("C", *words))
        # "allows no ratio"
        self.assertIsNone(of_the_same_samples("strain_both", *("disk", "compliant", "filling", "L=8", "/", "disk", "compliant", "jammed", "L=8")))

    def test_sets_share_packings(self):
        texts = []
        for value in (strain_both_have, excursion_over_load):
            found = {}
            for length in (8, 10.7, 16):
                of = {(c, s): {r["parameters"]["seed"]: value(r) for r in chosen(["disk", c, s, f"L={length}"])} for c in ("rigid", "compliant") for s in ("filling", "jammed")}
                usual = of["compliant", "jammed"]
                for key, other in of.items():
                    seeds = sorted(usual.keys() & other.keys())
                    if other is not usual and len(seeds) > 2:
                        found.setdefault(key == ("rigid", "filling"), []).append(pearson([(usual[s], other[s]) for s in seeds]))
            texts.append([f"{min(found[k]):.2f} to {max(found[k]):.2f}" for k in (False, True)])
        (strain, strain_other), (c, c_other) = texts
        for page in ("report.md", "README.md"):
            self.assertIn(f"(the strain of disks, over the periods that both have, correlates by {strain}, C by {c}) and do not confirm each other; rigid, filling is nearly "
                          f"another packing for the strain ({strain_other}), not for C ({c_other}).", (RESULTS / page).read_text(encoding="utf8"))

    def test_verdicts_on_the_strain_of_the_plane(self):
        sets = {(c, s): of_all_lengths("strain", "disk", "sphere", c, s, 10.7) for c in ("rigid", "compliant") for s in ("filling", "jammed")}
        self.assertEqual({key for key, (_, _, high, _) in sets.items() if high < 1}, {("compliant", "jammed"), ("rigid", "filling")})
        at_8 = {(c, s): expected(f"control strain disk {c} {s} L=8 / sphere {c} {s} L=8") for c, s in sets}
        self.assertEqual({key for key, value in at_8.items() if value[2] >= 1}, {("rigid", "filling")})
        at_rest = (expected("at_rest strain disk compliant jammed L=8 / sphere compliant jammed L=8"), of_all_lengths("strain", "disk", "sphere", "compliant", "jammed", 10.7, "settled"))
        self.assertTrue(at_rest[0][2] < 1 and at_rest[1][1] <= 1 <= at_rest[1][2])  # "1 is excluded", "does not exclude 1"
        self.assertFalse([r["name"] for c, s in sets for r in chosen(["sphere", c, s, "L=8"]) if r["facts"]["settled"]])  # "no sphere was at rest"
        # Claim 16: polygons over polyhedra.
        polygons = [expected(f"control strain polygon {c} {s} / polyhedron {c} {s}")[2] < 1 for c, s in (("rigid", "filling"), ("compliant", "filling"), ("compliant", "jammed"))]
        self.assertEqual(polygons, [True, True, True])
        corrected = [compared(*(of_samples(chosen([s, *words]), period_strain) for s in ("polygon", "polyhedron")), True, 1 - 0.05 / 3)[2] < 1
                     for words in (("rigid", "filling"), ("compliant", "filling"), ("compliant", "jammed"))]
        self.assertEqual(corrected, [True, False, False])  # "corrected for their number rigid, filling, only"
        self.assertGreater(expected("control strain_both polygon compliant filling / polyhedron compliant filling")[2], 1)
        # "a rest beyond the length is not shown"
        found = [expected(f"control strain_root {s} compliant jammed {which} / {o} compliant jammed {which}") for s, o in (("polygon", "polyhedron"), ("disk", "sphere"))
                 for which in ("thousand", "five", "ten")]
        self.assertEqual([v[1] <= 1 <= v[2] for v in found], [False, True, False, True, True, False])
        _, low, high, *_ = expected("control strain polygon compliant jammed / polygon compliant jammed thousand")
        self.assertTrue(low <= 1 and high >= 1.87)  # "neither is excluded"
        # C with drift at H/L = 0.3 beside the paper's 0.01.
        flat = [student(of_samples(pick("polyhedron", False, False, box_ratio=0.3, size_scale=size), lambda r: excursion_over_load(r, "dx_max")))[2] for size in (1, 1.3, 1.5)]
        self.assertEqual([high < 0.01 for high in flat], [False, True, True])

    def test_law_with_the_period_before(self):
        """b of (A) by normal equations, n counted from the jammed state and from the filling on."""
        def fit(runs, before):
            rows = []
            for line in runs:
                x, first, last = line["periods"], 0, 1
                while last <= min(len(x["x_j"]), 64):
                    strain = sum(a - b for a, b in zip(x["x_j"][first:last], x["x_j_after"][first:last])) / (last - first) / line["length"]
                    if strain > 0:
                        n = math.sqrt((first + 1 + before) * (last + before))
                        rows.append((math.log(100 * load_over_length(line)), math.log(n), math.log(strain)))
                    first, last = last, max(2 * last, 2)
            mean = [sum(column) / len(rows) for column in zip(*rows)]
            cov = [[sum((r[i] - mean[i]) * (r[j] - mean[j]) for r in rows) for j in range(3)] for i in range(3)]
            det = cov[0][0] * cov[1][1] - cov[0][1] ** 2
            q, minus_b = (cov[0][2] * cov[1][1] - cov[1][2] * cov[0][1]) / det, (cov[1][2] * cov[0][0] - cov[0][2] * cov[0][1]) / det
            left = cov[2][2] - q * cov[0][2] - minus_b * cov[1][2]
            return q, -minus_b, math.sqrt(left / (len(rows) - 3))
        runs = {}
        usual = {"box_ratio": 1, "size_scale": 1, "friction": 0.4, "fmin": 0, "grains": 1200, "step": 2e-4, "tolerance": 1e-5, "stiffness": 1e8, "method": "compliant"}
        for line in LINES:
            p = line["parameters"]
            if (p["shape"] != "polyhedron" or "from" not in p or p["seed"] > 30 or p.get("wall_speed") or p["duration"] > 5 or p["fmax"] < 1000 or
                    any(not _same(p[k], v) for k, v in usual.items()) or any(k in p for k in ("flatness", "fewest_vertices", "most_vertices"))):
                continue
            key = tuple(p[k] for k in ("seed", "frequency", "fmax", "gravity", "wall_mass_ratio", "lid_force_weights", "size_reading"))
            if is_judged(line) and load_over_length(line) < 1 and (key not in runs or p["duration"] > runs[key]["parameters"]["duration"]):
                runs[key] = line
        texts, found = [], []
        for before in (0, 1):
            found.append(fit(runs.values(), before))
            parts = [fit([line for key, line in runs.items() if key[0] != seed], before)[1] for seed in range(1, 6)]
            middle = sum(parts) / 5
            half = t_quantile(4) * math.sqrt(4 / 5 * sum((b - middle) ** 2 for b in parts))
            texts.append(text_of((found[-1][1], found[-1][1] - half, found[-1][1] + half, 5)))
        self.assertAlmostEqual(found[0][0], found[1][0], delta=0.005)  # the same q
        self.assertAlmostEqual(found[0][2], found[1][2], delta=0.005)  # and scatter
        report, results = ((RESULTS / name).read_text(encoding="utf8") for name in ("report.md", "README.md"))
        self.assertIn(f"polyhedra have b = {texts[1]}, the same scatter and q", report)
        self.assertIn(f"b = {texts[0]} for polyhedra", results)
        self.assertIn(f"b is {texts[1]}", results)

    def test_numbers_of_the_first_page(self):
        """In their order; those without a name are powers, which other tests compute."""
        section = (TOP / "README.md").read_text(encoding="utf8").split("## The study")[1].split("```")[0]
        disks = "disk compliant jammed L=8 / sphere compliant jammed L=8"
        polygons = [f"control strain_root polygon compliant jammed {which} / polyhedron compliant jammed {which}" for which in ("thousand", "five")]
        pooled, from_filling = (f"pooled strain disk sphere compliant {start} 10.7" for start in ("jammed", "filling"))
        names = (None, None, "control C polyhedron compliant jammed thousand", "C polyhedron jammed box=0.42",
                 "control C_drift polygon rigid filling / polyhedron rigid filling", "pooled C disk sphere compliant jammed", f"control strain {disks}", pooled, from_filling,
                 "control strain polygon compliant jammed thousand / polyhedron compliant jammed thousand", *polygons, None)
        told_of = [m[0] for m in NUMBERS.finditer(section)]
        self.assertEqual(len(told_of), len(names))
        counts = [[len(of_samples(chosen([s, "compliant", start, f"L={L}"]), period_strain)) for L in (8, 10.7, 16)]
                  for s, start in (("disk", "jammed"), ("sphere", "jammed"), ("disk", "filling"), ("sphere", "filling"))]
        self.assertEqual(counts, [[20, 20, 20], [5, 5, 15], [20, 20, 20], [5, 5, 3]])
        self.assertTrue(expected(pooled)[2] < 1 <= expected(from_filling)[2])  # "but from the filling on", "not shown"
        for name, text in zip(names, told_of):
            if name and name.startswith("pooled"):
                self.assertIn(text_of(expected(name)[:3]), text)
            elif name:
                self.assertEqual(text, text_of(expected(name)), name)
        for text in (f"{text_of(expected('pooled C disk sphere compliant jammed')[:3])} times the C of spheres (three lengths, 8 to 15 grains; 20 and 5 to 15 samples)",
                     f"{text_of(expected(pooled)[:3])} (20 and 5 to 15; not corrected)", f"{text_of(expected(from_filling)[:3])} (20 and 3 to 5): not shown"):
            self.assertIn(text, section)

    def test_intervals_hold_by_the_bootstrap(self):
        # Welch's interval is not narrower than four fifths of that of the bootstrap, which is too narrow for few samples.
        for plane, space in (("polygon", "polyhedron"), ("disk", "sphere")):
            above, below = (of_samples(chosen([s, "jammed"]), excursion_over_load) for s in (plane, space))
            _, low, high = welch(above, below)
            least, most = bootstrap(above, below)
            self.assertGreater(high / low, (most / least) ** 0.8)


if __name__ == "__main__":
    unittest.main()
