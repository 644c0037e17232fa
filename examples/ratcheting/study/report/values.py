# SPDX-License-Identifier: MIT
"""The numbers of the pages, by name (template.py). The first word of a name is a function of this module, the others are its
arguments:

    {C polyhedron rigid}                        mean over samples [95 % interval] (samples)
    {C polygon jammed small / polyhedron jammed}    ratio [interval] (samples above, below)
    {strain polyhedron jammed box=1.5 nu=2}     with other parameters than the paper's
    {power nu dx polyhedron rigid judged 2-10}  exponent of the excursion over the frequency

A selection of runs is SHAPE SET and parameters. Sets: `rigid` and `filling`, from the filling on, with rigid and with compliant
contacts; `jammed`, compliant contacts from jammed states, four or five periods. `small`: the boxes of the plane that are as
long as those of space."""
import math

import claims as ten
import compaction
import controls
import excursion
import figures
import tables
import template
from interval import Estimate, interval, number, ratio, ratio_of_means
from runs import (ANY, COMPLIANT, SHAPES, SMALLEST, constant, exponent_of_samples, judged, of_one_length, over_samples,
                  power, scaled_load, select, series, strain)

JAMMED = COMPLIANT | {"jammed": True}
OPTIONS = {"box": "box_ratio", "nu": "frequency", "wall": "wall_mass_ratio", "mu": "friction", "size": "size_scale", "fmax": "fmax",
           "lid": "lid_force_weights", "flat": "flatness", "fewest": "fewest_vertices"}


def behaviour(name):
    return lambda run: run["behaviour"][name]


def strain_of(run):
    return strain(run, 0, 4)


# Name, function of a run, factor. Ratios are of geometric means, but of these, which may be negative, of means.
OBSERVABLES = {
    "C": (constant, 1), "C_drift": (lambda r: constant(r, "dx_max"), 1),
    "dx": (lambda r: r["dx_active"], 1e3), "drift": (lambda r: r["drift"], 1e3),
    "drift_share": (lambda r: r["drift"] / r["dx_max"], 100),
    "strain": (strain_of, 1e4), "strain_root": (compaction.strain_over_load, 1e3), "load": (compaction.load_over_length, 1),
    "length": (lambda r: r["length"] / SMALLEST, 1), "height": (lambda r: r["height"] / r["length"], 1),
    "weight": (lambda r: r["weight"], 1), "height_jammed": (ten.jammed_ratio, 1),
    "rate": (lambda r: r["rate"], 1e3), "rate_box": (figures.first_second, 1e3),
    "rho_box": (lambda r: r["rho_box_initial"], 1), "rho_start": (lambda r: r["rho_initial"], 1), "rho_02": (lambda r: r["rho_0"], 1),
    "stress": (ten.ratio("jammed"), 1), "stress_active": (ten.ratio("active"), 1),
    "rise": (lambda r: r["behaviour"]["active_slope"] * r["dx_active"] / r["parameters"]["fmax"], 100), "rise_mean": (figures.rise, 1),
    "delay": (lambda r: r["delay"], 1e3), "roll": (behaviour("roll"), 1e3), "turn": (ten.turning, 1),
    "extension": (behaviour("rho_extension"), 1e4), "contraction": (behaviour("rho_contraction"), 1e4),
    "explained": (lambda r: r["explained"], 100), "steady": (lambda r: r["steady_thrust"], 1),
    "thrust": (lambda r: r["thrust"] / r["weight"], 1)}
MAY_BE_NEGATIVE = {"strain", "strain_root", "rate", "rate_box"}
# Parameter of a series, and what is fixed in it.
PARAMETERS = {"nu": ("frequency", lambda r: r["parameters"]["frequency"]), "fmax": ("fmax", lambda r: r["parameters"]["fmax"]),
              "g": ("gravity", lambda r: r["parameters"]["gravity"]), "m": ("wall_mass_ratio", lambda r: r["mass"] + r["wall_mass"])}
QUANTITIES = {"dx": lambda r: r["dx_active"], "drift": lambda r: r["dx_max"], "v": lambda r: r["v_max"],
              "rate": figures.density_rate, "rate_box": figures.first_second, "rate_four": ten.four_periods}
# Plan, series of its remaining runs, its title, and which runs are left.
NOT_RUN = (("controls", "equal-length", "equal length; contacts × start",
            "L/d = 24; polygons 16; polyhedra 8, 16; polyhedra 10.7, spheres 15.1 rigid, jammed; 2 Hz, other forces"),
           ("controls", "depth", "depth", "polyhedra"), ("controls", "ten-states", "ten states", "polyhedra but five at 5 Hz, five spheres at 2 Hz"),
           ("controls", "stiffness", "stiffness", "polyhedra; others at 1e8"), ("controls", "jammed", "jammed states for these", ""),
           ("settled", "all", "`settled`", ""), ("paper", "all", "`paper`", ""))
RATE_OF_PAPER = 0.025  # [1/s]
MEAN_POWER = (lambda r: round(compaction.load_over_length(r), 9), strain_of)


def with_samples(estimate, factor=1.0):
    return f"{estimate.text(factor=factor)} ({estimate.n})" if estimate.n else "–"


def percent(value):
    return f"{100 * value:.0f} %".replace("-", "−") if math.isfinite(value) else "–"


class Values:
    """Called with a name, gives its text."""

    def __init__(self, runs, folder):
        self.runs, self.folder, self.known = controls.split(runs)[0], folder, {}
        self.every = runs
        self.predictions = {}

    def __call__(self, name):
        if name not in self.known:
            word, *rest = name.split()
            if word in OBSERVABLES:
                text = self.observable(word, rest)
            else:
                function = getattr(self, "of_" + word, None)
                if function is None:
                    raise KeyError(f"there is no {word}")
                text = function(*rest)
            self.known[name] = text
        return self.known[name]

    def selection(self, words):
        """The runs of SHAPE SET and parameters."""
        shape, kind, *more = words
        if shape not in SHAPES or kind not in ("rigid", "filling", "jammed"):
            raise KeyError(f"no selection: {' '.join(words)}")
        wanted = {"frequency": 5.0, "jammed": kind == "jammed"}
        wanted |= {} if kind == "rigid" else COMPLIANT
        for option in more:
            if option == "small":
                return figures.five_hertz(self.runs, shape, True, **{k: v for k, v in wanted.items() if k != "frequency"})
            else:
                key, value = option.split("=")
                wanted[OPTIONS[key]] = float(value)
        found = select(self.runs, shape, **wanted)
        return [r for r in found if compaction.is_short(r)] if kind == "jammed" else of_one_length(found)

    def means(self, words, value):
        """The mean of each sample."""
        return over_samples(self.selection(words), value)

    def observable(self, word, rest):
        value, factor = OBSERVABLES[word]
        if "/" not in rest:
            return with_samples(self.means(rest, value), factor)
        cut = rest.index("/")
        above, below = self.means(rest[:cut], value), self.means(rest[cut + 1:], value)
        compare = ratio_of_means if word in MAY_BE_NEGATIVE else ratio
        return f"{interval(*compare(above.values, below.values))} ({above.n} and {below.n})"

    def of_judged(self, *words):
        """How many runs of a selection are judged."""
        found = self.selection(words)
        return f"{sum(judged(r) for r in found)} of {len(found)}"

    def of_about(self, word, *rest):
        """A mean alone."""
        value, factor = OBSERVABLES[word]
        return f"{factor * self.means(rest, value).mean:.3g}"

    def of_over_paper(self, *words):
        """The compaction rate over the paper's."""
        return with_samples(self.means(words, lambda r: r["rate"]), 1 / RATE_OF_PAPER)

    def of_flat(self, what):
        """Flat boxes, H/L = 0.42, from the filling on, all grains and contacts: least and most `rate` over the paper's, `ends` of the intervals of
        the rate, or `C` over the paper's."""
        rates, constants = zip(*tables.flat_boxes(self.runs))
        ends = [(e.mean + sign * e.half) / RATE_OF_PAPER for e in rates for sign in (-1, 1)]
        found = {"rate": [e.mean / RATE_OF_PAPER for e in rates], "ends": ends, "C": [e.mean / 0.01 for e in constants]}[what]
        return f"{min(found):.2f} to {max(found):.2f}".replace("-", "−")

    def of_half_intervals(self, kind):
        """Half the interval of C over C, the least and the most of the four shapes: `rigid`, or `jammed`, samples 1 to 5."""
        found = [self.means((shape, kind), constant) for shape in SHAPES]
        shares = [100 * e.half / e.mean for e in found]
        return f"{min(shares):.0f} to {max(shares):.0f} %"

    def of_box_error(self, column):
        """By how much C of polyhedra in boxes of other shapes is missed at most: by `F`, the thrust in each box, or by a `power` of H/L."""
        return f"{100 * max(abs(p / m - 1) for p, m in tables.box_pairs(self.runs)[column]):.0f} %"

    def of_converged(self, shape):
        """What half the step and a tenth of the tolerance change in the excursion at most, and from where to where the intervals go."""
        shifts = tables.converged_shifts(self.runs, shape)
        most = max(abs(math.expm1(e.mean)) for e in shifts)
        ends = [math.exp(e.mean + sign * e.half) for e in shifts for sign in (-1, 1)]
        return f"{100 * most:.0f} % ({shifts[0].n} samples; intervals from {min(ends):.2f} to {max(ends):.2f})"

    def of_constant_of_2008(self):
        return tables.method_of_2008(self.runs)[0][4]

    # Controls.

    def of_control(self, quantity, *words):
        """A mean of controls.QUANTITIES, or of two selections with / between them their ratio."""
        if "/" not in words:
            return with_samples(controls.mean(controls.selection(self.every, words), quantity), controls.QUANTITIES[quantity][1])
        cut = words.index("/")
        above, below = (controls.selection(self.every, part) for part in (words[:cut], words[cut + 1:]))
        *value, over, under = controls.compare(above, below, quantity)
        return f"{interval(*value)} ({over} and {under})" if over and under else "–"

    def of_same_samples(self, quantity, *words):
        """The ratio of two selections in the samples that both have; none, if the mean below is not distinguished from zero."""
        cut = words.index("/")
        *value, both = controls.compare_samples(*(controls.selection(self.every, part) for part in (words[:cut], words[cut + 1:])), quantity)
        return f"{interval(*value)} ({both})" if math.isfinite(value[1]) else "–"

    def of_same_samples_of_all(self, quantity, *words):
        """The same over the samples of all shapes together, by the logarithms: two sets of contacts, start and options with / between them."""
        cut, logs = words.index("/"), []
        for shape in SHAPES:
            above, below = ({r["parameters"]["seed"]: controls.QUANTITIES[quantity][0](r) for r in controls.selection(self.every, (shape, *part))}
                            for part in (words[:cut], words[cut + 1:]))
            logs += [math.log(above[seed] / below[seed]) for seed in sorted(above.keys() & below.keys())]
        return self.of_logs(Estimate(logs))

    @staticmethod
    def of_logs(e):
        """The geometric mean of numbers of which the logarithms are estimated."""
        return f"{interval(*(math.exp(v) for v in (e.mean, e.mean - e.half, e.mean + e.half)))} ({e.n})"

    def of_how_equal(self, quantity):
        """By how much plane and space differ at most in boxes of equal length: the mean `load` over the length, or `height` over length."""
        return f"{100 * controls.how_equal(self.every, {'load': compaction.load_over_length, 'height': controls.QUANTITIES['height'][0]}[quantity]):.0f} %"

    def of_excluding(self, quantity, *options):
        """How many comparisons of the plane with space at equal length differ, of how many. Options: `corrected` for their number; `at_rest`, of the
        plane the runs of which the preparation was at rest; `below` 1, or `above`, alone; `count`, without how many there are."""
        below, above, every = controls.that_exclude_one(self.every, quantity, "corrected" in options, "at_rest" in options)
        count = (0 if "above" in options else below) + (0 if "below" in options else above)
        return f"{count}" if "count" in options else f"{count} of {every}"

    def of_correlations(self, quantity, shape, which):
        """The least and the most correlation over the samples of a shape at all lengths L/d: of compliant contacts from jammed states with the
        runs of the `same` packings, compliant, filling and rigid, jammed; with those from the filling on, `rigid`."""
        others = (("rigid", "filling"),) if which == "rigid" else (("compliant", "filling"), ("rigid", "jammed"))
        found = [controls.correlation(controls.select(self.every, shape, *other, length), controls.select(self.every, shape, "compliant", "jammed", length), quantity)
                 for other in others for length in controls.LENGTHS]
        found = [v for v in found if math.isfinite(v)]
        return f"{min(found):.2f} to {max(found):.2f}"

    def of_at_rest(self, quantity, *words):
        """The ratio of two selections, of the first one the runs of which the preparation was at rest."""
        cut = words.index("/")
        above, below = (controls.selection(self.every, part) for part in (words[:cut], words[cut + 1:]))
        *value, over, under = controls.compare([r for r in above if controls.settled(r)], below, quantity)
        return f"{interval(*value)} ({over} and {under})"

    def of_contacts_excluding(self):
        """How many comparisons of rigid with compliant contacts from the same states differ, of how many."""
        return "{} of {}".format(*controls.contacts_that_exclude_one(self.every))

    def of_root(self, *words):
        """By which factor √(ℓ/L) of two selections differs: what the strain would do if it went as this."""
        cut = words.index("/")
        return "{:.2f}".format(controls.compare(*(controls.selection(self.every, part) for part in (words[:cut], words[cut + 1:])), "root")[0])

    def of_pooled(self, quantity, plane, space, contacts, start, shortest="0", which="all"):
        """Plane over space over all lengths L/d from `shortest` on that both have; `settled`: of the plane the runs of which the preparation
        was at rest."""
        *value, lengths = controls.pooled(self.every, plane, space, contacts, start, quantity, float(shortest), which == "settled")
        return interval(*value) if lengths else "–"

    def of_pooled_span(self, quantity, plane, space, shortest="0"):
        """The least and the most of pooled() of all sets of contacts and start."""
        found = [controls.pooled(self.every, plane, space, *which, quantity, float(shortest))[0] for which in controls.CONTACTS_AND_STARTS]
        return f"{min(found):.2f} to {max(found):.2f}"

    def of_more(self, end):
        """By how much C of disks is larger than that of spheres over all lengths, in percent: the `value`s of the sets of contacts and start, or
        the `ends` of their intervals."""
        sets = [[100 * (v - 1) for v in controls.pooled(self.every, "disk", "sphere", *which, "C")[:3]] for which in controls.CONTACTS_AND_STARTS]
        found = [s[0] for s in sets] if end == "value" else [v for s in sets for v in s[1:]]
        return f"{min(found):.0f} to {max(found):.0f} %".replace("-", "−")

    def of_heterogeneity(self, quantity, plane, space, contacts, start):
        """Chi-square of the ratios of plane over space at the lengths."""
        return f"{controls.heterogeneity(self.every, plane, space, contacts, start, quantity)[0]:.1f}"

    def of_unsettled(self, which="all"):
        """How many runs have a preparation that was not at rest: of all, or of those of `equal` length."""
        names = controls.of_equal_length(self.every)
        return str(sum(not controls.settled(r) for r in self.every if which == "all" or r["name"] in names))

    def of_negative(self, quantity, *words):
        """In how many runs of a selection of the controls a quantity is negative."""
        found = controls.selection(self.every, words)
        return f"{sum(controls.QUANTITIES[quantity][0](r) < 0 for r in found)} of {len(found)}"

    def of_control_power(self, shape, stiffness, low, high, displacement="dx_active"):
        """Power of the excursion over the frequency for a stiffness over 1e8 N/m, no run left out."""
        return with_samples(controls.exponent(self.every, shape, float(stiffness), float(low), float(high), displacement))

    def of_state_power(self, quantity, shape):
        """Power of a quantity over the frequency, 2 to 10 Hz, in each of the ten jammed states."""
        return with_samples(controls.power_of_states(self.every, shape, quantity))

    def of_state_law(self, what, shape):
        """Strains of the ten states over those of equation (A), fitted to the other samples: `mean` of the ratio, `rms` of its logarithm,
        or `both`: the mean with the spread of the other samples, too."""
        if what == "both":
            *value, new, old = controls.law_for_states_and_samples(self.every, shape)
            return f"{interval(*value)} ({new} and {old})"
        e, rms = controls.law_for_states(self.every, shape)
        if what == "rms":
            return percent(rms)
        return self.of_logs(e) if e.n > 1 else "–"

    def of_length_power(self, quantity, *words):
        """Power of the mean of a quantity over L/d at one load."""
        value, low, high, counts = controls.power_over_length(self.every, *words, quantity)
        return f"{interval(value, low, high)} ({', '.join(map(str, counts))})"

    def of_load_power(self, quantity, shape, contacts, start, length="10.7"):
        return with_samples(controls.power_over_force(self.every, shape, contacts, start, quantity, float(length)))

    def of_control_table(self, name):
        rows = getattr(controls, "rows_of_" + name)(self.every)
        return "\n".join(template.row(cells) for cells in rows)

    def of_control_runs(self, which="all"):
        """Number of the runs of the controls: `all`, those of `equal` length, or those and the runs of samples 1 to 5 that are `compared`
        with them."""
        found = self.every if which == "compared" else controls.split(self.every)[1]
        return f"{len(found if which == 'all' else controls.of_equal_length(found)):,}"

    # Exponents.

    def series(self, parameter, shape, kind, which, limits=None):
        fixed = {} if parameter == "frequency" else {"frequency": 5.0}
        low, high = (float(v) for v in limits.split("-")) if limits else (1.5, math.inf)
        return [r for r in series(self.runs, shape, parameter, **(fixed | (JAMMED if kind == "jammed" else {})))
                if r["parameters"]["fmax"] >= 1000 and low <= r["parameters"]["frequency"] <= high and (which == "all" or judged(r))]

    def of_power(self, parameter, quantity, shape, kind, which, limits=None):
        name, argument = PARAMETERS[parameter]
        found = self.series(name, shape, kind, which, limits)
        few = 2 if len({argument(r) for r in found if name == "frequency"}) == 2 else 3
        return with_samples(exponent_of_samples(found, argument, QUANTITIES[quantity], few))

    def of_counted(self, parameter, shape, kind, limits=None):
        """How many runs of a series are judged, and up to which value."""
        name, _ = PARAMETERS[parameter]
        every = self.series(name, shape, kind, "all", limits)
        return f"{sum(judged(r) for r in every)} of {len(every)}"

    def of_highest(self, shape, kind):
        """The highest frequency at which a run is judged."""
        return f"{ten.highest(self.series('frequency', shape, kind, 'judged')):g}"

    def of_limit(self, share):
        """The exponent of the excursion of polyhedra with another limit of the motion of the jammed wall."""
        found = [r for r in ten.above_1_hz(self.runs, "polyhedron") if judged(r, float(share))]
        return with_samples(exponent_of_samples(found, PARAMETERS["nu"][1], QUANTITIES["dx"]))

    def of_boxes(self, height, kind, nu, shape="polyhedron"):
        """The exponent of C over H/L: prepared, at t = 0, or jammed."""
        measure = {"prepared": lambda r: r["parameters"]["box_ratio"], "start": lambda r: r["height"] / r["length"],
                   "jammed": ten.jammed_ratio}[height]
        found = {}
        for r in select(self.runs, shape, frequency=float(nu), box_ratio=ANY, jammed=kind == "jammed", **COMPLIANT):
            p = r["parameters"]
            key = (p["seed"], p["box_ratio"])
            if compaction.is_short(r) and (kind == "jammed" or p["duration"] > 0.5) and (
                    key not in found or p["duration"] > found[key]["parameters"]["duration"]):
                found[key] = r
        return with_samples(exponent_of_samples([r for r in found.values() if judged(r)], measure, constant))

    # One line.

    def line_runs(self, shape, kind, every=False):
        """The judged runs over all loads, or `every` run."""
        found = {r["name"]: r for parameter, fixed in ten.LOADS for r in series(
            self.runs, shape, parameter, **(fixed | (JAMMED if kind == "jammed" else {}))) if r["parameters"]["fmax"] >= 1000}
        return [r for r in found.values() if every or judged(r)]

    def of_line(self, what, shape, kind, quantity="dx"):
        """C over all loads: `power` of the load, `scatter` about power 1 and `left`, about the fitted power; `C`; `least` and `most` C of a
        run; `runs`; `decades`; `power_all`, `runs_all`: with the runs that are not judged."""
        found, value = self.line_runs(shape, kind), QUANTITIES[quantity]
        logs = [math.log(value(r) / scaled_load(r)) for r in found]
        if what == "power":
            return with_samples(exponent_of_samples(found, scaled_load, value))
        if what in ("power_all", "runs_all"):
            every = self.line_runs(shape, kind, True)
            return str(len(every)) if what == "runs_all" else with_samples(exponent_of_samples(every, scaled_load, value))
        if what == "scatter":
            return percent(math.sqrt(sum((v - sum(logs) / len(logs)) ** 2 for v in logs) / (len(logs) - 1)))
        if what == "left":
            return percent(power([(scaled_load(r), value(r)) for r in found])[3])
        if what == "C":
            return f"{math.exp(sum(logs) / len(logs)):.3f}"
        if what in ("least", "most"):
            return f"{math.exp(min(logs) if what == 'least' else max(logs)):.3f}"
        if what == "runs":
            return str(len(found))
        if what == "decades":
            loads = [scaled_load(r) for r in found]
            return f"{math.log10(max(loads) / min(loads)):.1f}"
        raise KeyError(what)

    def of_line_span(self, what, kind, *shapes):
        """The least and the most of the shapes: `scatter` about Δx = Cℓ, or `power` of the load."""
        texts = [self(f"line {what} {shape} {kind}") for shape in shapes or SHAPES]
        values = sorted(float(text.split()[0]) for text in texts)
        return f"{values[0]:.0f} to {values[-1]:.0f} %" if what == "scatter" else f"{values[0]:.2f} to {values[-1]:.2f}"

    # Predictions and null models.

    def prediction(self, shape, kind, by):
        """excursion.Prediction: kind `jammed` or `rigid`, by `F`, the slow test, or `constant` thrust."""
        key = (shape, kind, by)
        if key not in self.predictions:
            curves = excursion.thrust_curves(self.runs, shape) if by == "F" else None
            self.predictions[key] = excursion.Prediction(self.runs, shape, curves, **(JAMMED if kind == "jammed" else {}))
        return self.predictions[key]

    def of_predict(self, model, shape, kind="jammed", by="F", *names):
        """Mean and scatter of measured over predicted excursion: model `thrust`, `line` (Δx ∝ ℓ from the same run of the sample), or
        `power` (the power of ℓ fitted to the same runs)."""
        found = self.prediction(shape, kind, by)
        mean, scatter = excursion.mean_and_scatter(found.ratios(*names) if model == "thrust" else
                                                   found.null_ratios(model == "power", *names))
        return f"{mean:.2f}, {percent(scatter)}" if math.isfinite(mean) else "–"

    def of_predicted_runs(self, shape):
        found = self.prediction(shape, "jammed", "F")
        return f"{len(found.ratios())} of {len(found.every_ratio())}"

    def of_all_predicted_runs(self):
        found = [self.prediction(s, "jammed", "F") for s in SHAPES]
        return f"{sum(len(f.ratios()) for f in found)} of {sum(len(f.every_ratio()) for f in found)}"

    def of_scatter(self, model, shape, kind, by):
        """The scatter alone of of_predict()."""
        return self.of_predict(model, shape, kind, by).split(", ")[1]

    def of_predict_aside(self, model, shape):
        """Mean and scatter of measured over predicted excursion of the judged runs that were set aside, by F(x) (`thrust`) or by the `power`
        of ℓ that is fitted to the others; `runs`: their number."""
        found = self.prediction(shape, "jammed", "F")
        if model == "runs":
            return str(len(found.set_aside_ratios))
        mean, scatter = excursion.mean_and_scatter(found.set_aside_ratios if model == "thrust" else found.set_aside_null())
        return f"{mean:.2f}, {percent(scatter)}"

    def of_null_of_others(self, shape):
        """The scatter of the excursion about a power of ℓ that is fitted to the other samples."""
        return percent(excursion.mean_and_scatter(self.prediction(shape, "jammed", "F").null_of_others())[1])

    def of_every_scatter(self, shape):
        """The scatter of the prediction by F(x) with the runs that are not judged."""
        return percent(excursion.mean_and_scatter(self.prediction(shape, "jammed", "F").every_ratio())[1])

    def of_predicted_power(self, what, parameter, shape):
        """The exponent of the excursion over a parameter, `measured` and `predicted` by F(x), of the same runs."""
        return self.prediction(shape, "jammed", "F").exponents(PARAMETERS[parameter][0])[what == "predicted"]

    def of_box_law(self, shape, measure):
        """The scatter of the law of compaction over all boxes of 1200 grains."""
        return percent(compaction.Law(compaction.jammed_runs(self.runs, shape, True), (measure,)).scatter)

    def of_farthest(self, shape):
        """By how much the fit of the others is off, on average, for the sample for which it is farthest off."""
        found = compaction.Prediction(compaction.jammed_runs(self.runs, shape), ("load",))
        return f"{100 * max(abs(b) for b in found.bias.values()):.0f} %"

    def of_trend(self, shape):
        """Power of measured over predicted excursion over the excursion, and the scatter about it."""
        return self.prediction(shape, "jammed", "F").trend()

    def of_law(self, what, shape, measure="load", low="0", high="1"):
        """The law of compaction from jammed states: `a`, `q`, `b`, `scatter`, `rms` of each sample predicted by the others, `runs`, `samples`."""
        found = [r for r in compaction.jammed_runs(self.runs, shape, every_load=True)
                 if float(low) <= compaction.load_over_length(r) < float(high)]
        measures = tuple(measure.split("+"))
        law = compaction.Law(found, measures)
        samples = len({r["parameters"]["seed"] for r in found})
        if what in ("a", "q", "b"):
            value, half = {"a": (1e3 * law.share, 1e3 * law.share_half), "q": (law.p, law.p_half), "b": (law.b, law.b_half)}[what]
            return f"{number(value, half)} ({samples})"
        if what == "rms":
            return percent(compaction.Prediction(found, measures).rms)
        return {"scatter": percent(law.scatter), "runs": str(law.run_count), "samples": str(samples)}[what]

    def mean_power(self, shape, low, high):
        """The power of the mean strain of four periods over ℓ/L in a range of loads, by sample, and the samples."""
        found = [r for r in select(self.runs, shape, frequency=ANY, fmax=ANY, gravity=ANY, wall_mass_ratio=ANY, **JAMMED)
                 if judged(r) and float(low) <= compaction.load_over_length(r) < float(high) and strain_of(r) > 0]
        return {seed: exponent_of_samples([r for r in found if r["parameters"]["seed"] == seed], *MEAN_POWER)
                for seed in sorted({r["parameters"]["seed"] for r in found})}, exponent_of_samples(found, *MEAN_POWER)

    def of_mean_power(self, shape, low, high):
        return with_samples(self.mean_power(shape, low, high)[1])

    def of_power_loss(self, shape, limit, high):
        """By how much the power of the mean strain over ℓ/L is smaller above a load than below it, sample by sample."""
        (below, _), (above, _) = self.mean_power(shape, 0, limit), self.mean_power(shape, limit, high)
        return with_samples(Estimate([below[seed].mean - above[seed].mean for seed in below if seed in above]))

    def of_law_of_packing(self, what, shape):
        """`a`, `q` or `b` of the law of compaction from jammed states, with n counted from the filling on."""
        found = compaction.jammed_runs(self.runs, shape)
        law = compaction.Law(found, ("load",), 1)
        value, half = {"a": (1e3 * law.share, 1e3 * law.share_half), "q": (law.p, law.p_half), "b": (law.b, law.b_half)}[what]
        return f"{number(value, half)} ({len({r['parameters']['seed'] for r in found})})"

    def of_aside(self, what, shape, *measures):
        """The runs that were set aside: `made`, `used` and their `samples`, `rms`, `scatter` of the fit to the others."""
        found = compaction.jammed_runs(self.runs, shape)
        if what == "samples":
            return str(len({r["parameters"]["seed"] for r in found if r.get("set_aside")}))
        if what == "made":
            return str(sum(1 for r in self.runs if r.get("set_aside") and r["parameters"]["shape"] == shape))
        test = compaction.SetAside(found, measures or ("load",))
        return {"used": str(test.run_count), "rms": percent(test.rms), "mean": percent(test.mean), "scatter": percent(test.law.scatter)}[what]

    def of_aside_total(self, what):
        """Runs that were set aside: `named`, `made`, `used`."""
        if what == "named":
            return str(len((self.folder / "set_aside.txt").read_text(encoding="utf8").split()))
        if what == "made":
            return str(sum(bool(r.get("set_aside")) for r in self.runs))
        return str(sum(compaction.SetAside(compaction.jammed_runs(self.runs, s), ("load",)).run_count for s in SHAPES))

    # Tables.

    def of_table(self, name, *more):
        """The rows of a table of tables.py."""
        function = getattr(tables, name, None) if not name.startswith("_") else None
        if function is None:
            raise KeyError(f"there is no table {name}")
        rows = function(self.folder, *more) if more else function(self.runs)
        return "\n".join(template.row(cells) for cells in rows)

    def of_not_run(self):
        """Rows of the runs that are not done: what was done of how many, the core-hours of the others, and which they are (NOT_RUN)."""
        rows = []
        for plan, series, title, left in NOT_RUN:
            cells = next(c for c in tables.remaining(self.folder, plan) if c[0].startswith(series))
            missing, every = map(int, cells[1].split(" of "))
            rows.append(template.row([title, f"{every - missing} of {every}", cells[3], left]))
        return "\n".join(rows)

    # Others.

    def of_runs(self, kind="all"):
        found = {"all": self.every, "compliant": [r for r in self.every if r["parameters"]["method"] == "compliant"]}[kind]
        return f"{len(found):,}"

    def of_steps(self, what, kind):
        """Steps, and steps that are not solved, of the rigid or the compliant runs."""
        found = {"compliant": [r for r in self.every if r["parameters"]["method"] == "compliant"],
                 "friction": [r for r in self.every if r["parameters"]["method"] == "compliant" and r["parameters"]["friction"] > 0.5],
                 "rigid": [r for r in self.every if r["parameters"]["method"] != "compliant" and r["parameters"]["tolerance"] == 1e-4],
                 "tight": [r for r in self.every if r["parameters"]["method"] != "compliant" and r["parameters"]["tolerance"] == 1e-5],
                 "2008": [r for r in self.every if r["parameters"]["tolerance"] == 1e-3]}[kind]
        return f"{sum(r['facts']['steps' if what == 'all' else 'capped_steps'] for r in found):,}"

    def of_contracting(self):
        found = [r for s in SHAPES for r in ten.base(self.runs, s)]
        return f"{sum(r['contracting'] for r in found)} of {sum(len(r['periods']['x_j']) for r in found)}"

    def tenfold(self, quantity, shape, kind):
        """Speed times ν, or excursion times ν², at 10 Hz over that at 5 Hz, of the same sample."""
        value, exponent = {"v": (lambda r: r["v_max"], 1), "dx": (lambda r: r["dx_active"], 2), "drift": (lambda r: r["dx_max"], 2)}[quantity]
        found = {}
        for r in self.series("frequency", shape, kind, "all"):
            found.setdefault(r["parameters"]["seed"], {})[r["parameters"]["frequency"]] = value(r)
        return Estimate([math.log(f[10.0] / f[5.0] * 2 ** exponent) for f in found.values() if 5.0 in f and 10.0 in f])

    def of_tenfold(self, quantity, shape, kind):
        return self.of_logs(self.tenfold(quantity, shape, kind))

    def of_apart(self, quantity, shape, kind):
        """How far the two are apart: the ends of the interval in percent, or 0 and the farther one."""
        e = self.tenfold(quantity, shape, kind)
        ends = [100 * abs(math.expm1(v)) for v in (e.mean - e.half, e.mean + e.half)]
        return f"{0 if abs(e.mean) < e.half else min(ends):.0f} to {max(ends):.0f} %"

    def of_fastest(self, quantity, shape):
        """The frequency of the largest rate over one second in each sample, rigid contacts."""
        best = {}
        for r in ten.every_frequency(self.runs, shape):
            if r["jams"]["t"][1] > 1 + 1e-9:  # no period within the second
                continue
            seed, value = r["parameters"]["seed"], QUANTITIES[quantity](r)
            if seed not in best or value > best[seed][0]:
                best[seed] = (value, r["parameters"]["frequency"])
        return ", ".join(f"{nu:g}" for _, (_, nu) in sorted(best.items()))

    def of_ageing(self, *shapes):
        """The strain of periods 9 to 20, relative to the first four, at 5 Hz over that at 20 Hz, of the same sample."""
        return self.of_logs(Estimate([math.log(a / b) for shape in shapes or SHAPES for a, b in ten.aged(self.runs, shape)]))

    def clock(self):
        return [line.split(",") for line in (self.folder / "wall_clock.csv").read_text(encoding="utf8").splitlines()[1:]]

    def of_hours(self, plan="all"):
        """Hours of preparation and shaking of one process each, of all runs or of the `controls`."""
        rows = [row for row in self.clock() if plan == "all" or int(row[1].split("-s")[1].split("-")[0]) >= controls.FIRST_SAMPLE]
        return f"{sum(float(v) for row in rows for v in row[2:4] if v) / 3600:.{0 if plan == 'all' else 1}f}"

    def of_timed(self):
        return f"{len(self.clock()):,}"

    def of_phase(self, what, nu):
        row = next(r for r in figures.return_phases(self.runs, "polyhedron") if r.frequency == float(nu))
        return f"{getattr(row, what):.3f}" if what in ("turn", "fastest") else f"{getattr(row, what):.2f}"

    def of_states(self):
        return ten.states(self.runs)
