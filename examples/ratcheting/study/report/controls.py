# SPDX-License-Identifier: MIT
"""The runs of the plan `controls`: causes that the other plans change together, changed one at a time. Its samples are those from 31
on, which no other plan has. With 1200 grains in space the runs of the other plans with the same parameters count, too.

A selection is SHAPE CONTACTS START and options: `rigid` or `compliant` contacts, from the `filling` on or from a `jammed` state, which
compliant contacts made. Options: L, the length of the box over d (10.7 unless it is said); nu [Hz]; force, over 5 N for each grain; W, the
width of the box over its length; walls, those beside the grains; k, the stiffness over 1e8 N/m. `thousand`: 1200 grains in the box of
the other plans, all samples; `ten`: those of the controls alone, of which all runs of a sample start from one jammed state; `five`: the others."""
import math
import random
from collections import Counter

from interval import Estimate, interval, means_differ, ratio, ratio_of_means, ratio_of_pairs, ratio_of_sums, student
from compaction import Law, jammed_runs, load_over_length, points, strain_both_have, strain_over_load
from runs import TITLE, constant, exponent_of_samples, judged, line, over_samples, scaled_load, strain

FIRST_SAMPLE = 31
LENGTHS = (8.0, 10.7, 16.0, 24.0)  # of boxes, over d; the third one of round grains is 15.1
# Grains in a box as long as it is high, W/L = 1.
GRAINS = {"polygon": (49, 91, 209, 480), "disk": (29, 54, 112, 291), "polyhedron": (493, 1200, 4063, 13850), "sphere": (174, 424, 1200, 4876)}
# What both contacts have.
SOLVED = {"compliant": {"method": "compliant", "tolerance": 1e-5}, "rigid": {"method": "contact-dynamics", "tolerance": 1e-4, "max_sweeps": 5000, "overlap_correction": True}}
USUAL = {"gravity": 9.81, "wall_mass_ratio": 0.5, "size_scale": 1.0, "friction": 0.4, "fmin": 0.0, "step": 2e-4, "lid_force_weights": 10.0,
         "size_reading": "circumdiameter"}
PAIRS = (("polygon", "polyhedron"), ("disk", "sphere"))
CONTACTS_AND_STARTS = (("rigid", "filling"), ("rigid", "jammed"), ("compliant", "filling"), ("compliant", "jammed"))
FORCE = 5.0  # largest force for each grain [N]
STATE_FREQUENCIES = (2.0, 5.0, 10.0)  # of the ten jammed states [Hz]


def aimed(shape, length):
    """Length of a box over d, as text."""
    return "15.1" if length == 16 and shape in ("disk", "sphere") else f"{length:g}"


def split(runs):
    """The runs of the other plans, and those of the controls."""
    def is_control(run):
        return run["parameters"]["seed"] >= FIRST_SAMPLE
    return [r for r in runs if not is_control(r)], [r for r in runs if is_control(r)]


def strain_of(run):
    return strain(run, 0, 4)


def select(controls, shape, contacts, start, length=10.7, nu=5.0, force=1.0, width=1.0, walls="frictionless", stiffness=1.0, grains=None):
    """One run of each sample. Those that only make a jammed state are left out."""
    count = grains or round(width * GRAINS[shape][LENGTHS.index(length)])

    def fits(run):
        p = run["parameters"]
        return (p["shape"] == shape and p["grains"] == count and p["frequency"] == nu and ("from" in p) == (start == "jammed") and
                all(p[key] == value for key, value in (SOLVED[contacts] | USUAL).items()) and "wall_speed" not in p and
                not any(key in p for key in ("flatness", "fewest_vertices", "most_vertices")) and
                math.isclose(p["fmax"], force * FORCE * count) and p.get("width_ratio", 1.0) == width and
                p.get("side_walls", "frictionless") == walls and (count != 1200 or p["box_ratio"] == 1.0) and
                (4 <= len(run["periods"]["x_j"]) <= 5 if start == "jammed" else p["duration"] == 1) and
                (contacts == "rigid" or math.isclose(p["stiffness"], stiffness * 1e8)))
    return [r for r in controls if fits(r)]


OPTIONS = {"L": "length", "nu": "nu", "force": "force", "W": "width", "walls": "walls", "k": "stiffness"}


def selection(controls, words):
    """The runs of a selection in words."""
    shape, contacts, start, *more = words
    if contacts not in ("rigid", "compliant") or start not in ("filling", "jammed") or shape not in GRAINS:
        raise KeyError(f"no selection: {' '.join(words)}")
    wanted = {}
    for option in more:
        if option in ("thousand", "ten", "five"):
            wanted["grains"] = 1200
            continue
        key, value = option.split("=")
        wanted[OPTIONS[key]] = value if key == "walls" else float(value)
    found = select(controls, shape, contacts, start, **wanted)
    return split(found)["ten" in more] if "ten" in more or "five" in more else found


# Function of a run, factor, whether it may be negative.
QUANTITIES = {"C": (constant, 1, False), "C_drift": (lambda r: constant(r, "dx_max"), 1, False), "strain": (strain_of, 1e4, True), "strain_root": (strain_over_load, 1e3, True),
              # Of the periods that runs from the filling on and from jammed states both have.
              "strain_both": (strain_both_have, 1e4, True), "strain_root_both": (lambda r: strain_both_have(r) / math.sqrt(load_over_length(r)), 1e3, True),
              # C of a box as high as long, by the power of C over H/L that polyhedra have.
              "C_box": (lambda r: constant(r) / (r["height"] / r["length"]) ** 1.2, 1, False),
              "C_drift_box": (lambda r: constant(r, "dx_max") / (r["height"] / r["length"]) ** 1.2, 1, False),
              "root": (lambda r: math.sqrt(load_over_length(r)), 1, False),
              "dx": (lambda r: r["dx_active"], 1e3, False), "drift_share": (lambda r: r["drift"] / r["dx_max"], 100, True),
              "length": (lambda r: r["length"] / 0.025, 1, False), "height": (lambda r: r["height"] / r["length"], 1, False)}


def mean(found, quantity):
    return over_samples(found, QUANTITIES[quantity][0])


def compare(above, below, quantity):
    """Ratio of two selections: value, low and high end of its interval, and the numbers of samples. Quantities that may be negative:
    of the means."""
    a, b = mean(above, quantity), mean(below, quantity)
    if not a.n or not b.n:
        return (math.nan,) * 3 + (a.n, b.n)
    return (*(ratio_of_means if QUANTITIES[quantity][2] else ratio)(a.values, b.values), a.n, b.n)


def settled(run):
    """Whether the preparation of the sample was at rest when its time was over."""
    return run["facts"]["settled"]


def pooled(controls, plane, space, contacts, start, quantity, shortest=0.0, plane_settled=False):
    """Plane over space at all lengths L/d from `shortest` on that both have, each with the same weight: value, low and high end of its
    interval by Welch's degrees of freedom, and the number of lengths. It is the geometric mean of the ratios, of quantities that may be
    negative the ratio of the sums of the means. `plane_settled`: without the runs of the plane that are not settled()."""
    found = []
    for length in (length for length in LENGTHS if length >= shortest):
        both = [select(controls, shape, contacts, start, length) for shape in (plane, space)]
        both = [mean([r for r in of_side if not plane_settled or k == 1 or settled(r)], quantity) for k, of_side in enumerate(both)]
        if min(e.n for e in both) > 1:
            found.append(both)
    count = len(found)
    if not count:
        return math.nan, math.nan, math.nan, 0
    if QUANTITIES[quantity][2]:
        return (*ratio_of_sums([a.values for a, _ in found], [b.values for _, b in found]), count)
    found = [[Estimate([math.log(v) for v in e.values]) for e in both] for both in found]
    parts = [(e.error ** 2, e.freedom) for both in found for e in both]
    variance = sum(v for v, _ in parts)
    half = student(variance ** 2 / sum(v ** 2 / n for v, n in parts)) * math.sqrt(variance) / count
    value = sum(a.mean - b.mean for a, b in found) / count
    return math.exp(value), math.exp(value - half), math.exp(value + half), count


def heterogeneity(controls, plane, space, contacts, start, quantity):
    """Chi-square of the means of the plane about R times those of space at the lengths L/d, with the R that makes it smallest, and its
    degrees of freedom."""
    found = []
    for length in LENGTHS:
        a, b = (mean(select(controls, shape, contacts, start, length), quantity) for shape in (plane, space))
        if min(a.n, b.n) > 1:
            found.append((a, b))

    def chi(r):
        return sum((a.mean - r * b.mean) ** 2 / (a.error ** 2 + (r * b.error) ** 2) for a, b in found)
    ratios = [a.mean / b.mean for a, b in found]
    low, high = min(ratios), max(ratios)
    for _ in range(4):  # ever finer nets about the smallest
        net = [low + (high - low) * k / 200 for k in range(201)]
        best = min(range(201), key=lambda k: chi(net[k]))
        low, high = net[max(best - 1, 0)], net[min(best + 1, 200)]
    return chi((low + high) / 2), len(found) - 1


def of_equal_length(controls):
    """The runs that comparisons of the plane with space at equal length and of the contacts use."""
    return {run["name"] for shape in GRAINS for length in LENGTHS for contacts, start in CONTACTS_AND_STARTS
            for run in select(controls, shape, contacts, start, length)}


def plane_and_space(controls):
    """(plane, space) of each set of contacts and start that has two samples or more of both at one length."""
    for shapes in PAIRS:
        for length in LENGTHS:
            for contacts, start in CONTACTS_AND_STARTS:
                both = [select(controls, shape, contacts, start, length) for shape in shapes]
                if min(map(len, both)) > 1:
                    yield both


def how_equal(controls, quantity):
    """By which share the means of a quantity differ at most between the plane and space in boxes of equal length."""
    values = [[over_samples(found, quantity).mean for found in both] for both in plane_and_space(controls)]
    return max(max(pair) / min(pair) for pair in values) - 1


def that_exclude_one(controls, quantity, corrected=False, at_rest=False):
    """How many comparisons of the plane with space at equal length have less in the plane by Welch's test, how many more, and how many there
    are. The test is of the means of quantities that may be negative, else of those of the logarithms. `corrected`: as Bonferroni asks for;
    `at_rest`: of the plane the runs that are settled()."""
    found = [[mean([r for r in f if not at_rest or k == 1 or settled(r)], quantity) for k, f in enumerate(both)] for both in plane_and_space(controls)]
    if not QUANTITIES[quantity][2]:
        found = [[Estimate([math.log(v) for v in e.values]) for e in both] for both in found]
    share = 1 - 0.05 / (len(found) if corrected else 1)
    signs = [(a.mean > b.mean) - (a.mean < b.mean) for a, b in found if means_differ(a.values, b.values, share)]
    return signs.count(-1), signs.count(1), len(found)


def correlation(above, below, quantity):
    """Pearson's correlation of a quantity over the samples that two selections have; nan with fewer than three."""
    value = QUANTITIES[quantity][0]
    first, second = ({r["parameters"]["seed"]: value(r) for r in found} for found in (above, below))
    seeds = sorted(first.keys() & second.keys())
    if len(seeds) < 3:
        return math.nan
    x, y = ([found[s] - sum(found[t] for t in seeds) / len(seeds) for s in seeds] for found in (first, second))
    return sum(a * b for a, b in zip(x, y)) / math.sqrt(sum(a * a for a in x) * sum(b * b for b in y))


def contacts_that_exclude_one(controls):
    """How many comparisons of rigid with compliant contacts from the same jammed states, of C and of the strain, differ by Student's test of
    the differences, and how many there are."""
    found = []
    for shape in GRAINS:
        for length in LENGTHS:
            both = [select(controls, shape, contacts, "jammed", length) for contacts in ("rigid", "compliant")]
            found += [Estimate([a - b for a, b in pairs_of(*both, quantity)]) for quantity in ("C", "strain")]
    found = [abs(e.mean) > e.half for e in found if e.n > 1]
    return found.count(True), len(found)


def pairs_of(above, below, quantity):
    """A quantity in the samples that both selections have."""
    value = QUANTITIES[quantity][0]
    seeds = {r["parameters"]["seed"]: value(r) for r in below}
    return [(value(r), seeds[r["parameters"]["seed"]]) for r in above if r["parameters"]["seed"] in seeds]


def compare_samples(above, below, quantity):
    """Ratio of the means of the samples that both selections have: value, low and high end of its interval, number of samples. Without an
    interval, if the mean below is not distinguished from zero."""
    pairs = pairs_of(above, below, quantity)
    return (*(ratio_of_pairs(pairs) if len(pairs) > 1 else (math.nan,) * 3), len(pairs))


def exponent(controls, shape, stiffness, low, high, displacement="dx_active"):
    """Power of the excursion over the frequency, from jammed states of 1200 grains, no run left out."""
    found = [r for nu in (10.0, 15.0, 20.0, 35.0, 60.0) if low <= nu <= high
             for r in select(controls, shape, "compliant", "jammed", nu=nu, stiffness=stiffness, grains=1200)]
    return exponent_of_samples(found, lambda r: r["parameters"]["frequency"], lambda r: r[displacement])


def power_over_length(controls, shape, contacts, start, quantity, draws=2000):
    """Power of the mean of a quantity over L/d at one load ℓ, weighted equally for each length of box: value, low and high end of its
    95 % interval by the bootstrap over the samples of each box, and the numbers of samples."""
    value = QUANTITIES[quantity][0]
    boxes = [[(r["length"], value(r)) for r in select(controls, shape, contacts, start, length)] for length in LENGTHS]
    boxes = [box for box in boxes if len(box) > 2]

    def slope(of_boxes):
        points = [(math.log(sum(p[0] for p in box) / len(box)), sum(p[1] for p in box) / len(box)) for box in of_boxes]
        if min(p[1] for p in points) <= 0:
            return math.inf if points[0][1] <= 0 else math.nan  # in the shortest box: steeper than any power
        return line([p[0] for p in points], [math.log(p[1]) for p in points])[1]
    if len(boxes) < 3:
        return math.nan, math.nan, math.nan, [len(box) for box in boxes]
    random_of = random.Random(1)
    slopes = sorted(s for s in (slope([random_of.choices(box, k=len(box)) for box in boxes]) for _ in range(draws)) if not math.isnan(s))
    return slope(boxes), slopes[len(slopes) // 40], slopes[-1 - len(slopes) // 40], [len(box) for box in boxes]


def power_over_force(controls, shape, contacts, start, quantity, length=10.7):
    """Power of a quantity over the load ℓ at one length of the box, over the forces and frequencies that are run, in the same samples."""
    found = [r for force in (1.0, 1 / 3, 5 / 3) for nu in (5.0, 2.0)
             for r in select(controls, shape, contacts, start, length, nu=nu, force=force)]
    return exponent_of_samples(found, lambda r: round(scaled_load(r) / r["length"], 9), QUANTITIES[quantity][0])


# Rows of the tables of the supplement.

def rows_of_equal_length(controls):
    """Plane over space in boxes of equal length."""
    rows = []
    for plane, space in PAIRS:
        for length in LENGTHS:
            for contacts, start in CONTACTS_AND_STARTS:
                both = [select(controls, shape, contacts, start, length) for shape in (plane, space)]
                if min(map(len, both)) < 2:
                    continue
                cells = [interval(*compare(*both, quantity)[:3]) for quantity in ("C", "C_drift", "strain")]
                means = [mean(found, quantity).text(factor=QUANTITIES[quantity][1]) for quantity in ("C", "strain") for found in both]
                rows.append([f"{TITLE[plane].split(', ')[1]} / {TITLE[space].split(', ')[1]}", aimed(plane, length), f"{contacts}, {start}",
                             *(f"{len(found)}; {sum(judged(r) for r in found)}" for found in both), *means, *cells])
    return rows


def rows_of_settled(controls):
    """Disks over spheres at equal length, of the disks those of which the preparation was at rest; beside it all."""
    rows = []
    for contacts, start in CONTACTS_AND_STARTS:
        at = [[select(controls, shape, contacts, start, length) for shape in ("disk", "sphere")] for length in LENGTHS]
        for length, both in zip(LENGTHS, at):
            rest = [[r for r in found if settled(r)] for found in both]
            if min(map(len, both)) > 1 and len(rest[0]) > 1:
                rows.append([f"{contacts}, {start}", aimed("disk", length), *(f"{len(still)} of {len(found)}" for still, found in zip(rest, both)),
                             *(interval(*compare(found, both[1], quantity)[:3]) for quantity in ("C", "strain") for found in (rest[0], both[0]))])
        for title, shortest in (("all", 0.0), ("10.7, 15.1", 10.7)):
            if sum(min(map(len, both)) > 1 for length, both in zip(LENGTHS, at) if length >= shortest) > 1:
                rows.append([f"{contacts}, {start}", title, "", "", *(
                    interval(*pooled(controls, "disk", "sphere", contacts, start, quantity, shortest, rest)[:3])
                    for quantity in ("C", "strain") for rest in (True, False))])
    return rows


def rows_of_boxes(controls):
    """The boxes: what was aimed at and what came out, compliant contacts from jammed states."""
    rows = []
    for shape in GRAINS:
        for length, grains in zip(LENGTHS, GRAINS[shape]):
            found = select(controls, shape, "compliant", "jammed", length)
            if found:
                rows.append([TITLE[shape], aimed(shape, length), grains, len({r["parameters"]["seed"] for r in found}), mean(found, "length").text(),
                             mean(found, "height").text(), over_samples(found, lambda r: scaled_load(r) / r["length"]).text()])
    return rows


def rows_of_starts(controls):
    """Contacts and start, in the same samples: ratios to compliant contacts from jammed states."""
    rows = []
    for shape in GRAINS:
        for length in LENGTHS:
            usual = select(controls, shape, "compliant", "jammed", length)
            cells = []
            for quantity, sets in (("C", CONTACTS_AND_STARTS[:3]), ("strain", CONTACTS_AND_STARTS[:3]), ("strain_both", CONTACTS_AND_STARTS[2:3])):
                for contacts, start in sets:
                    *value, both = compare_samples(select(controls, shape, contacts, start, length), usual, quantity)
                    cells.append(f"{interval(*value)} ({both})" if math.isfinite(value[1]) else "–")
            if any(cell != "–" for cell in cells):
                rows.append([TITLE[shape], aimed(shape, length), *cells])
    return rows


def rows_of_depth(controls):
    """Width and side walls: ratios to the box with W/L = 1 and walls without friction."""
    rows = []
    for shape in ("sphere", "polyhedron"):
        usual = select(controls, shape, "compliant", "jammed")
        for name, width, walls in (("W/L = 0.5", 0.5, "frictionless"), ("W/L = 2", 2.0, "frictionless"), ("periodic", 1.0, "periodic"),
                                   ("walls with friction 0.4", 1.0, "frictional")):
            found = select(controls, shape, "compliant", "jammed", width=width, walls=walls)
            if len(found) > 1 and len(usual) > 1:
                rows.append([TITLE[shape], name, len(found), *(interval(*compare(found, usual, quantity)[:3]) for quantity in ("C", "strain"))])
    return rows


def ten_states(controls, shape, nu):
    """One run of each of the ten samples, 1200 grains."""
    return split(select(controls, shape, "compliant", "jammed", nu=nu, grains=1200))[1]


def of_ten_states(controls, shape):
    """Their runs at all frequencies, of the samples that have all."""
    at = [ten_states(controls, shape, nu) for nu in STATE_FREQUENCIES]
    both = set.intersection(*({r["parameters"]["seed"] for r in found} for found in at))
    return [r for found in at for r in found if r["parameters"]["seed"] in both]


def _spreads(logs):
    """Standard deviations between the rows of a table, and of what is left when each row and each column has its mean: analysis of
    variance."""
    count, width = len(logs), len(logs[0])
    of_row, of_column = [sum(row) / width for row in logs], [sum(column) / count for column in zip(*logs)]
    centre = sum(of_row) / count
    left = sum((v - of_row[i] - of_column[k] + centre) ** 2 for i, row in enumerate(logs) for k, v in enumerate(row)) / ((count - 1) * (width - 1))
    between = sum((m - centre) ** 2 for m in of_row) / (count - 1) - left / width
    return math.sqrt(max(between, 0)), math.sqrt(left)


def spreads(found, value, draws=2000):
    """Standard deviations of the logarithm of a quantity: of the states, and what is left in the runs of one state when each frequency has
    its mean. Each with the ends of its 95 % interval, by the bootstrap over the samples, of which the variances are n / (n - 1) times too
    small; nan with fewer than three samples."""
    seeds, at = (sorted({r["parameters"][key] for r in found}) for key in ("seed", "frequency"))
    if len(seeds) < 3 or min(value(r) for r in found) <= 0:
        return [(math.nan,) * 3] * 2
    logs = {(r["parameters"]["seed"], r["parameters"]["frequency"]): math.log(value(r)) for r in found}
    rows = [[logs[s, nu] for nu in at] for s in seeds]
    random_of, factor = random.Random(1), math.sqrt(len(rows) / (len(rows) - 1))
    drawn = zip(*(_spreads(random_of.choices(rows, k=len(rows))) for _ in range(draws)))
    return [(v, factor * ends[draws // 40], factor * ends[-1 - draws // 40]) for v, ends in zip(_spreads(rows), map(sorted, drawn))]


def percent_interval(value, low, high):
    """value [low, high] in whole percent."""
    return f"{100 * value:.0f} [{100 * low:.0f}, {100 * high:.0f}]" if math.isfinite(value) else "–"


def rows_of_states(controls):
    """One jammed state of each sample: means at three frequencies, over those of the samples of the other plans."""
    rows = []
    for shape in GRAINS:
        for nu in STATE_FREQUENCIES:
            others, found = split(select(controls, shape, "compliant", "jammed", nu=nu, grains=1200))
            if len(found) > 2:
                cells = []
                for quantity in ("C", "strain"):
                    cells += [mean(found, quantity).text(factor=QUANTITIES[quantity][1]), interval(*compare(found, others, quantity)[:3])]
                rows.append([TITLE[shape], f"{nu:g}", f"{len(found)}; {sum(judged(r) for r in found)}", *cells])
    return rows


def rows_of_spreads(controls):
    """Spread between states and in the runs of one state, and the powers over the frequency."""
    rows = []
    for shape in GRAINS:
        found = of_ten_states(controls, shape)
        if len(found) > 6:
            cells = [percent_interval(*v) for quantity in ("C", "strain") for v in spreads(found, QUANTITIES[quantity][0])]
            rows.append([TITLE[shape], len(found) // 3, *cells, *(power_of_states(controls, shape, q).text() for q in ("dx", "strain"))])
    return rows


def power_of_states(controls, shape, quantity):
    """Power of a quantity over the frequency, 2 to 10 Hz, fitted in each of the ten states."""
    return exponent_of_samples(of_ten_states(controls, shape), lambda r: r["parameters"]["frequency"], QUANTITIES[quantity][0])


def law_for_states(controls, shape):
    """The strains of the ten states over those of the law (A) that is fitted to the samples of the other plans: the mean of ln(measured /
    predicted) over all points of each sample, and the rms of all points."""
    law = Law(jammed_runs(split(controls)[0], shape), ("load",))
    samples = {}
    for r in (r for nu in STATE_FREQUENCIES for r in ten_states(controls, shape, nu)):
        samples.setdefault(r["parameters"]["seed"], []).extend(law.residuals(points([r], ("load",))))
    every = [v for values in samples.values() for v in values]
    return Estimate([sum(v) / len(v) for v in samples.values() if v]), math.sqrt(sum(v * v for v in every) / max(len(every), 1))


def law_for_states_and_samples(controls, shape):
    """The same ratio with the spread of both: the mean of the ten samples over that of the samples to which the law is fitted, by Welch:
    value, low and high end, numbers of samples."""
    fitted = jammed_runs(split(controls)[0], shape)
    law, old = Law(fitted, ("load",)), {}
    for r in fitted:
        old.setdefault(r["parameters"]["seed"], []).extend(law.residuals(points([r], ("load",))))
    states = law_for_states(controls, shape)[0].values
    base = [sum(v) / len(v) for v in old.values() if v]
    return (*ratio([math.exp(v) for v in states], [math.exp(v) for v in base]), len(states), len(base))


def rows_of_plane_states(controls):
    """Plane over space with 1200 grains, in the samples of the other plans and in the ten."""
    rows = []
    for plane, space in (("disk", "sphere"), ("polygon", "polyhedron")):
        for nu in STATE_FREQUENCIES:
            for name, which in (("1 to 5", 0), ("31 to 40", 1), ("all", None)):
                both = [select(controls, shape, "compliant", "jammed", nu=nu, grains=1200) for shape in (plane, space)]
                both = both if which is None else [split(found)[which] for found in both]
                if min(map(len, both)) > 1:
                    rows.append([f"{TITLE[plane].split(', ')[1]} / {TITLE[space].split(', ')[1]}", f"{nu:g}", name, " and ".join(str(len(f)) for f in both),
                                 *(interval(*compare(*both, quantity)[:3]) for quantity in ("C", "strain", "strain_root"))])
    return rows


def rows_of_stiffness(controls):
    """Power of the excursion over the frequency, 10 to 60 Hz, no run left out."""
    rows = []
    for shape in GRAINS:
        for stiffness in (0.1, 1.0, 10.0):
            found = [r for nu in (10.0, 15.0, 20.0, 35.0, 60.0)
                     for r in select(controls, shape, "compliant", "jammed", nu=nu, stiffness=stiffness, grains=1200)]
            e = exponent(controls, shape, stiffness, 10, 60)
            of_sample = Counter(r["parameters"]["seed"] for r in found)
            found = [r for r in found if of_sample[r["parameters"]["seed"]] >= 3]  # those that the power is fitted to
            if e.n and len(found) >= 5:
                rows.append([TITLE[shape], f"1e{8 + round(math.log10(stiffness))}", e.n, f"{len(found)}; {sum(judged(r) for r in found)}", e.text(),
                             exponent(controls, shape, stiffness, 10, 60, "dx_max").text()])
    return rows
