# SPDX-License-Identifier: MIT
"""The statistics of the study's report, applied to data with known results, and the report of the
repository, which must be what its table of runs gives. Argument: the top folder."""
import math
import pathlib
import random
import re
import shutil
import sys
import tempfile
import unittest

TOP = pathlib.Path(sys.argv.pop(1) if len(sys.argv) > 1 else ".").resolve()
STUDY = TOP / "examples/ratcheting"
sys.path.insert(0, str(STUDY / "study/report"))

import compaction  # noqa: E402
import controls  # noqa: E402
import excursion  # noqa: E402
import interval  # noqa: E402
import runs  # noqa: E402
import template  # noqa: E402
import write  # noqa: E402


def made_up(seed, frequency, thrust=80.0, count=16):
    """A run of polyhedra whose strains follow 0.002 (t_u / 10 ms)^0.9 n^-0.5."""
    parameters = runs.CASE | runs.RIGID | {
        "shape": "polyhedron", "seed": seed, "frequency": frequency, "duration": 1.0}
    run = {"name": f"s{seed}-{frequency}", "parameters": parameters, "thrust": thrust, "length": 0.3,
           "drift": 0.0, "dx_max": 1e-3}
    t_u, x, before, after = runs.unjammed_time(run), 0.0, [], []
    for n in range(1, count + 1):
        before.append(x)
        x -= 0.3 * 0.002 * (t_u / 0.01) ** 0.9 * n ** -0.5
        after.append(x)
    run["periods"] = {"x_j": before, "x_j_after": after, "drift": [0.0] * count, "dx_max": [1e-3] * count}
    return run


class Statistics(unittest.TestCase):
    def test_power_law(self):
        c, b, error, scatter = runs.power([(x, 0.0115 * x ** -2) for x in (1, 2, 5, 10, 60)])
        self.assertAlmostEqual(c, 0.0115)
        self.assertAlmostEqual(b, -2)
        self.assertLess(error + scatter, 1e-12)
        rng = random.Random(7)
        noisy = runs.power([(x, x ** -2 * math.exp(rng.gauss(0, 0.1))) for x in range(1, 41)])
        self.assertLess(abs(noisy[1] + 2), 3 * noisy[2])
        self.assertTrue(math.isnan(runs.power([(1, 2), (2, 3)])[0]))
        self.assertTrue(math.isnan(runs.power([(1, 2), (2, -3), (3, None)])[0]))

    def test_error_of_a_slope_is_that_of_the_textbook(self):
        a, b, error, _ = runs.line([0, 1, 2, 3], [1, 3, 2, 5])
        self.assertAlmostEqual(a, 1.1)
        self.assertAlmostEqual(b, 1.1)
        self.assertAlmostEqual(error, math.sqrt(2.7 / 2 / 5))

    def test_quantiles_of_student(self):
        # Of the tables: 95 %, both sides.
        for freedom, t in ((1, 12.706), (2, 4.303), (3, 3.182), (4, 2.776), (10, 2.228), (19, 2.093), (200, 1.972)):
            self.assertAlmostEqual(interval.student(freedom), t, delta=6e-4)
        self.assertTrue(interval.student(2) > interval.student(2.5) > interval.student(3))
        self.assertTrue(math.isnan(interval.student(0)))

    def test_estimate_and_its_text(self):
        e = runs.Estimate([1, 2, 3, None, math.nan])
        self.assertEqual((e.n, e.mean), (3, 2))
        self.assertAlmostEqual(e.error, 1 / math.sqrt(3))
        self.assertAlmostEqual(e.half, 4.3027 / math.sqrt(3), places=4)
        self.assertEqual(e.text(), "2.0 [−0.5, 4.5]")
        self.assertEqual(e.text(factor=-1), "−2.0 [−4.5, 0.5]")
        self.assertEqual(runs.Estimate([2]).text(), "2")
        self.assertEqual(interval.number(-0.0123, 0.0004), "−0.01230 [−0.01270, −0.01190]")
        self.assertEqual(interval.number(1234.5, 27), "1234 [1208, 1262]")
        self.assertEqual(interval.number(-0.0004, 0.5), "0.00 [−0.50, 0.50]")
        self.assertEqual(interval.number(2.0, 1e-16), "2")
        self.assertEqual(interval.number(math.nan), "–")

    def test_ratios(self):
        # An interval holds the true ratio in 95 % of the cases.
        rng = random.Random(11)
        covered = covered_of_means = 0
        for _ in range(400):
            a = [3 * math.exp(rng.gauss(0, 0.3)) for _ in range(4)]
            b = [2 * math.exp(rng.gauss(0, 0.1)) for _ in range(15)]
            value, low, high = interval.ratio(a, b)
            self.assertAlmostEqual(value, math.exp(sum(map(math.log, a)) / 4 - sum(map(math.log, b)) / 15))
            covered += low <= 1.5 <= high
            _, low, high = interval.ratio_of_means([3 + rng.gauss(0, 0.6) for _ in range(4)], [2 + rng.gauss(0, 0.2) for _ in range(15)])
            covered_of_means += low <= 1.5 <= high
        self.assertTrue(370 <= covered <= 392, covered)
        self.assertTrue(366 <= covered_of_means <= 394, covered_of_means)
        self.assertTrue(math.isnan(interval.ratio([1], [2, 3])[1]))

    def test_ratios_of_means_near_zero(self):
        # Ten numbers of which the mean is as large as its error or zero: the interval holds the true ratio, and is as narrow as that of the difference.
        rng = random.Random(5)
        for mean in (0.3, 0.0):
            covered = covered_of_sums = rejected = 0
            for _ in range(150):
                a, b = [[[m + rng.gauss(0, s) for _ in range(n)] for m, s, n in sets] for sets in (((mean, 1, 10), (1, 0.5, 7)), ((2, 0.6, 5), (3, 0.5, 6)))]
                _, low, high = interval.ratio_of_means(a[0], b[0])
                covered += low <= mean / 2 <= high
                _, low_of_sums, high_of_sums = interval.ratio_of_sums(a, b)
                covered_of_sums += low_of_sums <= (mean + 1) / 5 <= high_of_sums
                differ = interval.means_differ(a[0], b[0])
                rejected += differ
                self.assertEqual(differ, not low <= 1 <= high)
            self.assertTrue(135 <= covered <= 149, covered)
            self.assertTrue(135 <= covered_of_sums <= 149, covered_of_sums)
            self.assertGreater(rejected, 100)  # 1 is excluded, where the data exclude it

    def test_fieller(self):
        # Equal variances and numbers that are known: the ends are roots of (a - R b)² = t² (va + R² vb).
        a, b = [0.0, 1.0, -0.5, 1.5, 0.5], [3.5, 4.5, 3.0, 5.0, 4.0]
        value, low, high = interval.ratio_of_means(a, b)
        self.assertEqual(value, 0.125)
        variance = interval.Estimate(a).error ** 2
        for end in (low, high):
            freedom = 4 * (1 + end ** 2) ** 2 / (1 + end ** 4)
            self.assertAlmostEqual((0.5 - 4 * end) ** 2 / (variance * (1 + end ** 2)), interval.student(freedom) ** 2, places=4)
        self.assertTrue(low < 0 < high < 1)
        self.assertTrue(math.isnan(interval.ratio_of_means(b, [v - 0.4 for v in a])[1]))  # the mean below is not distinguished from zero
        self.assertTrue(math.isnan(interval.ratio_of_means(a, [-1, 1])[1]))
        self.assertEqual(interval.ratio_of_means([0, 0], [1, 2])[0], 0)
        # Pairs: of a number and its half the ratio is known; with noise the interval is where Student's test of a - R b begins to reject.
        self.assertEqual(interval.ratio_of_pairs([(v / 2, v) for v in b]), (0.5, 0.5, 0.5))
        pairs = list(zip(a, b[1:] + b[:1]))
        value, low, high = interval.ratio_of_pairs(pairs)
        for end in (low, high):
            e = interval.Estimate([x - end * y for x, y in pairs])
            self.assertAlmostEqual(abs(e.mean), e.half, places=6)
        self.assertTrue(low < value < high)
        self.assertTrue(math.isnan(interval.ratio_of_pairs([(y, x - 0.4) for x, y in pairs])[1]))

    def test_ratios_of_many_comparisons(self):
        a, b = [1.0, 1.1, 1.2, 1.15], [0.9, 0.95, 0.92, 1.0]
        usual, wide = interval.ratio(a, b), interval.ratio(a, b, 1 - 0.05 / 14)
        self.assertEqual(usual[0], wide[0])
        self.assertTrue(wide[1] < usual[1] < usual[2] < wide[2])

    def test_spreads_of_states(self):
        # States and frequencies that only add have no spread within; noise of 10 % in each run is found, and the spread of the states.
        def made(states, noise):
            return [{"parameters": {"seed": s, "frequency": nu}, "y": math.exp(a + math.log(nu) + rng.gauss(0, noise))}
                    for s, a in enumerate(states) for nu in (2.0, 5.0, 10.0)]
        rng = random.Random(3)
        (between, *_), (within, *_) = controls.spreads(made([0.1, 0.3, 0.5], 0), lambda r: r["y"])
        self.assertAlmostEqual(between, 0.2)
        self.assertAlmostEqual(within, 0)
        covered = [0, 0]
        for _ in range(100):
            found = controls.spreads(made([rng.gauss(0, 0.2) for _ in range(10)], 0.1), lambda r: r["y"], 200)
            for k, true in enumerate((0.2, 0.1)):
                covered[k] += found[k][1] <= true <= found[k][2]
        self.assertTrue(all(80 <= c <= 97 for c in covered), covered)
        self.assertTrue(math.isnan(controls.spreads(made([0.1, 0.2], 0.1), lambda r: r["y"])[0][0]))

    def test_exponent_over_samples(self):
        # Samples that agree by chance keep the interval of the scatter about their fits.
        def sample(seed, noise):
            return [{"parameters": {"seed": seed}, "x": x, "y": x ** -2 * math.exp(d)}
                    for x, d in zip((1, 2, 4, 8), (noise, -noise, -noise, noise))]
        table = sample(1, 0.1) + sample(2, 0.1) + sample(3, -0.1)
        e = runs.exponent_of_samples(table, lambda r: r["x"], lambda r: r["y"])
        self.assertAlmostEqual(e.mean, -2)
        self.assertEqual((e.n, e.freedom), (3, 6))
        self.assertGreater(e.half, 0.1)

    def test_least_squares(self):
        rows = [(1, x, x * x) for x in range(5)]
        found = runs.least_squares(rows, [3 - x + 0.5 * x * x for x in range(5)])
        for value, expected in zip(found, (3, -1, 0.5)):
            self.assertAlmostEqual(value, expected)


class Physics(unittest.TestCase):
    def test_excursion_of_a_weak_thrust_is_that_of_the_parabola(self):
        x = excursion.displacement(lambda _: 6.0, 20.0, 6000.0, 5.0)
        self.assertAlmostEqual(x / (9 / (4 * math.pi ** 2) * 36 / (20 * 6000 * 25)), 1, places=2)
        # 12 percent more at a quarter of the largest force.
        x = excursion.displacement(lambda _: 1500.0, 20.0, 6000.0, 5.0)
        self.assertAlmostEqual(x / (9 / (4 * math.pi ** 2) * 1500 ** 2 / (20 * 6000 * 25)), 1.12,
                               delta=0.01)

    def test_thrust_over_the_displacement(self):
        # Falls from 0.4 mg to 0.2 mg over 1 mm, with noise.
        xs = [1e-5 * k for k in range(101)]
        noise = [0.02 * (-1) ** k for k in range(101)]
        run = {"weight": 100.0, "tables": {"wall": {
            "x": [-1e-5] + xs, "f_g": [90.0] + [100 * (0.4 - 200 * x + d) for x, d in zip(xs, noise)]}}}
        curve = excursion.ThrustCurve(run)
        self.assertEqual(sorted(curve.f, reverse=True), curve.f)
        for x in (2e-4, 5e-4, 8e-4):
            self.assertAlmostEqual(curve.at(x), 0.4 - 200 * x, delta=0.01)
        self.assertEqual(curve.at(1.0), curve.f[-1])
        # The share that gives an excursion is found again.
        run |= {"parameters": {"fmax": 6000.0, "frequency": 5.0}, "mass": 20.0, "wall_mass": 10.0}
        moved = excursion.displacement(lambda x: 100 * curve.at(x), 10 + 0.7 * 20, 6000.0, 5.0)
        share = excursion.share_that_gives(moved, run, lambda x: 100 * curve.at(x))
        self.assertAlmostEqual(share, 0.7, delta=0.01)

    def test_time_below_the_thrust(self):
        run = made_up(1, 5.0, 3000.0)
        self.assertAlmostEqual(runs.unjammed_time(run), 0.1)

    def test_motions_of_the_jammed_wall_do_not_cancel(self):
        run = made_up(1, 5.0, count=4)
        self.assertTrue(runs.judged(run))
        for share, expected in ((0.29, True), (0.31, False)):
            run["periods"]["drift"] = [share * 1e-3 * (-1) ** k for k in range(4)]
            self.assertEqual(runs.judged(run), expected)
        run["periods"] = {"drift": [], "dx_max": []}
        self.assertFalse(runs.judged(run))

    def test_law_of_compaction_is_found(self):
        table = [made_up(seed, nu) for seed in (1, 2, 3) for nu in (2.0, 5.0, 10.0, 20.0, 60.0)]
        law = compaction.Law(compaction.loading_runs(table, "polyhedron"))
        self.assertEqual(law.run_count, 15)
        self.assertAlmostEqual(law.p, 0.9, places=6)
        # The strain of a group of periods is that of its middle to some percent.
        self.assertAlmostEqual(law.b, 0.5, delta=0.02)
        self.assertAlmostEqual(law.share, 0.002, delta=1e-4)
        aside = compaction.Prediction(compaction.loading_runs(table, "polyhedron"))
        self.assertEqual(sorted(aside.bias), [1, 2, 3])
        self.assertLess(aside.rms, 0.05)


class Template(unittest.TestCase):
    def test_names_are_replaced(self):
        def values(name):
            if name == "none":
                raise KeyError("there is no none")
            return name.upper()
        self.assertEqual(template.fill("a {b c/d} e\n\n{f}", values), "a B C/D e\n\nF\n")
        with self.assertRaisesRegex(ValueError, "page:2: {none}: 'there is no none'"):
            template.fill("a\nb {none}", values, "page")
        self.assertEqual(template.row([1, "a"]), "| 1 | a |")


# value [low, high]
INTERVAL = re.compile(r"−?[\d.]+ \[−?[\d.]+, −?[\d.]+\]")


class Report(unittest.TestCase):
    def test_pages_of_the_repository(self):
        results = STUDY / "results"
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder)
            for path in [results / name for name in ("grains.csv", "wall_clock.csv", "remaining-paper.md", "remaining-settled.md", "remaining-controls.md", "set_aside.txt")]:
                shutil.copy(path, copy)
            for path in results.glob("*.md.in"):
                shutil.copy(path, copy)
            names = write.pages(runs.read(results / "runs.jsonl"), copy)
            self.assertEqual(names, ["README.md", "report.md", "supplement.md"])
            for name in names:
                text = (copy / name).read_text(encoding="utf8")
                self.assertEqual(text, (results / name).read_text(encoding="utf8"), "write it anew by report/write.py")
                for figure in re.findall(r"^!\[.*\]\((figures/.*)\)$", text, re.M):
                    self.assertTrue((results / figure).exists(), figure)

    def test_length_of_the_report(self):
        text = (STUDY / "results/report.md").read_text(encoding="utf8")
        self.assertLessEqual(len(text.split()), 5000)
        abstract = re.search(r"## Abstract\n(.*?)\n## ", text, re.S).group(1)
        self.assertLessEqual(len(abstract.split()), 150)

    def test_judged_runs_of_the_first_page(self):
        values = write.Values(runs.read(STUDY / "results/runs.jsonl"), STUDY / "results")
        judged, every = (values(f"line {what} polyhedron jammed") for what in ("runs", "runs_all"))
        first = (TOP / "README.md").read_text(encoding="utf8")
        self.assertIn(f"the {judged} of {every} runs whose wall moves little while the packing is jammed; all: {values('line power_all polyhedron jammed')})", first)
        self.assertIn(f"at most {100 * runs.JAMMED_MOTION:.0f} % of the largest displacements", (STUDY / "results/report.md").read_text(encoding="utf8"))
        self.assertIn(f"to the power {values('line power polyhedron jammed')} instead of 1", first)
        self.assertIn(f"as ν to {values('power nu rate_box polyhedron rigid all 9-61')} (polyhedra; paper: −1)", first)

    def test_counts_of_the_first_page(self):
        table = runs.read(STUDY / "results/runs.jsonl")
        first = (TOP / "README.md").read_text(encoding="utf8")
        self.assertIn(f"{len(table):,} runs, {sum(r['parameters']['grains'] == 1200 for r in table):,} of them with 1200 grains", first)

    def test_intervals_of_the_first_page_are_those_of_the_report(self):
        pages = "".join((STUDY / "results" / name).read_text(encoding="utf8") for name in ("README.md", "report.md", "supplement.md"))
        first = " ".join((TOP / "README.md").read_text(encoding="utf8").split())
        found = INTERVAL.findall(first)
        self.assertGreater(len(found), 5)
        for text in found:
            self.assertTrue(text in pages, f"{text} of README.md is not in the report")


if __name__ == "__main__":
    unittest.main()
