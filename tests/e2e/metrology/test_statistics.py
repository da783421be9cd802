"""The statistics over HTTP: published figures, and what is refused."""

import random

from support.daemon import ROOT, DaemonTest

RINGS = [line.split() for line in (ROOT / "tests/reference/piston_rings.txt").read_text().splitlines()]
STUDY = [{"part": part, "operator": who, "trial": trial, "value": value}
         for who, trials in enumerate([[[0, 2], [4, 6]], [[2, 4], [2, 4]]])
         for part, values in enumerate(trials) for trial, value in enumerate(values)]


class Statistics(DaemonTest):
    def send(self, name, body):
        return self.daemon.post(f"/v1/statistics/{name}", body, {"Content-Type": "application/json"})

    def compute(self, name, body):
        answer = self.send(name, body)
        self.assertEqual(answer.status, 200, answer)
        return answer.json

    def test_figures_have_seventeen_digits_of_the_exact_value(self):
        answer = self.send("summary", b'{"values":[0.1,"0.2",0.7]}')
        self.assertIn('"mean":0.33333333333333333,"standard_deviation":0.32145502536643183', answer.text)
        summary = answer.json
        self.assertEqual((summary["count"], summary["min"], summary["max"]), (3, 0.1, 0.7))
        self.assertEqual(summary["quantiles"]["type"], 7)
        one = self.compute("summary", {"values": ["25.003"]})
        self.assertIsNone(one["standard_deviation"])
        self.assertIsNone(one["autocorrelation_lag_1"])

    def test_a_string_holds_a_plain_decimal(self):
        self.assertEqual(self.compute("summary", b'{"values":[1e3,"1000"]}')["standard_deviation"], 0)
        answer = self.send("summary", {"values": [1, "1e3"]})
        self.assertEqual(answer.status, 422, answer)
        self.assertEqual([(e["pointer"], e["code"]) for e in answer.json["errors"]], [("/values/1", "number.malformed")])
        self.assertIn("JSON number", answer.json["errors"][0]["detail"])

    def test_the_analysis_of_variance(self):
        anova = self.compute("anova", {"groups": [[1, 2, 3], [2, 3, 4], [6, 7, 8]]})
        self.assertEqual(anova["between"], {"degrees_of_freedom": 2, "sum_of_squares": 42, "mean_square": 21})
        self.assertEqual(anova["within"], {"degrees_of_freedom": 6, "sum_of_squares": 6, "mean_square": 1})
        self.assertEqual(anova["f"], 21)
        self.assertEqual(anova["r_squared"], 0.875)
        # The p of F(2, m) has a closed form: (1 + 2 F / m) ^ (-m / 2).
        self.assertAlmostEqual(anova["p"], (1 + 2 * 21 / 6) ** -3, delta=1e-17)

    def test_the_piston_rings(self):
        body = {"subgroups": RINGS[:25], "lower": 73.95, "upper": "74.05"}
        capability = self.compute("capability", body)
        self.assertAlmostEqual(capability["cp"]["value"], 1.703, places=3)
        self.assertAlmostEqual(capability["cpk"]["value"], 1.663, places=3)
        self.assertTrue(capability["stable"])
        chart = self.compute("chart", {"kind": "xbar_r", "subgroups": RINGS, "rules": [1, 2, 3, 4],
                                       "phase1": {"from": 0, "to": 25}})
        self.assertAlmostEqual(chart["average_run_length"], 91.75, places=2)
        self.assertEqual([c["name"] for c in chart["charts"]], ["xbar", "r"])
        self.assertIn({"chart": "xbar", "rule": 1, "index": 36}, chart["violations"])
        self.assertIsNone(self.compute("chart", {"kind": "xbar_s", "subgroups": RINGS})["average_run_length"])
        known = {"centre": "25.12373", "standard_deviation": 0.000342}
        on_line = self.compute("chart", {"kind": "i_mr", "values": ["25.124414"] * 4, "rules": [1, 2], **known})
        self.assertEqual([on_line["violations"], on_line["charts"][0]["upper_limit"]], [[], 25.124756])
        for kind in ("ewma", "cusum"):
            flat = {"kind": kind, "values": [25.013] * 4, "rules": [1]}
            self.assertEqual(self.compute("chart", flat)["violations"], [])

    def test_a_capability_with_one_limit(self):
        capability = self.compute("capability", {"values": [1, 2, 3, 2, 1], "upper": 5})
        self.assertIsNone(capability["cp"])
        self.assertIsNone(capability["cpl"])
        self.assertEqual(capability["cpk"], capability["cpu"])

    def test_gauge_studies(self):
        study = self.compute("grr", {"method": "anova", "model": "interaction", "tolerance": 60,
                                     "measurements": STUDY})
        self.assertAlmostEqual(study["ev"] ** 2, 2, places=15)
        self.assertAlmostEqual(study["interaction"] ** 2, 3, places=15)
        self.assertAlmostEqual(study["contribution_percent"]["ev"], 40, places=12)
        self.assertAlmostEqual(study["tolerance_percent"]["grr"], 10 * 5 ** 0.5, places=12)
        self.assertEqual(list(study["anova"]), ["part", "operator", "interaction", "repeatability", "total"])
        for method in ("average_range", "nested"):
            self.assertGreater(self.compute("grr", {"method": method, "measurements": STUDY})["ev"], 0)
        rows = [{"part": row["part"], "value": row["value"]} for row in STUDY]
        self.assertIsNone(self.compute("grr", {"method": "type3", "measurements": rows})["av"])
        linear = self.compute("grr", {"method": "linearity", "measurements": [
            {"reference": x, "value": f"{1.1 * x + 0.05:.3f}"} for x in (1, 1, 2, 3)],
            "model": "auto", "tolerance": 60})
        self.assertAlmostEqual(linear["slope"]["value"], 0.1, places=15)
        stable = self.compute("grr", {"method": "stability", "measurements": [
            {"at": f"2026-11-{day:02}", "value": value} for day in range(1, 6) for value in (1, 2)],
            "model": "auto", "tolerance": 60})
        self.assertTrue(stable["stable"])
        type1 = self.compute("type1", {"values": [9.9, 10.1, 10.1, 9.9], "reference": 10, "tolerance": 6})
        self.assertAlmostEqual(type1["cg"], 1.2 / (6 * (0.04 / 3) ** 0.5), places=14)

    def test_the_capability_of_a_measuring_system_and_process(self):
        values = {"values": [9.9, 10.1, 10.1, 9.9], "reference": "9.97", "tolerance": 6}
        self.assertNotIn("measuring_system", self.compute("type1", values))
        known = {"resolution": 0.3, "u_cal": 0.02}
        system = self.compute("type1", {**values, "measuring_system": {**known, "u_lin": 0.03}})["measuring_system"]
        u_re, u_evr, u_bi = 0.3 / 12 ** 0.5, (0.04 / 3) ** 0.5, 0.03 / 3 ** 0.5
        self.assertAlmostEqual(system["re_percent"], 5, places=12)
        for name, u in (("u_re", u_re), ("u_evr", u_evr), ("u_bi", u_bi), ("u_cal", 0.02), ("u_lin", 0.03)):
            self.assertAlmostEqual(system[name], u, places=14)
        u_ms = (0.02 ** 2 + max(u_re, u_evr) ** 2 + u_bi ** 2 + 0.03 ** 2) ** 0.5
        self.assertAlmostEqual(system["u_ms"], u_ms, places=14)
        self.assertAlmostEqual(system["q_ms_percent"], 400 * u_ms / 6, places=12)
        self.assertAlmostEqual(system["c_ms"], 0.3 * 6 / (6 * u_ms), places=12)
        self.assertAlmostEqual(system["least_tolerance_ms"], 4 * u_ms / 0.15, places=12)
        self.assertFalse({"u_ms_rest", "u_mp", "u_evo"} & set(system))
        # The answer of the master study goes into the study of parts.
        study = {"tolerance": 60, "measurements": STUDY,
                 "measuring_process": {**known, "u_evr": system["u_evr"], "u_bi": system["u_bi"], "u_t": 0.5}}
        answer = self.compute("grr", {**study, "model": "interaction"})
        process = answer["measuring_process"]
        for of, sigma in (("u_evo", "ev"), ("u_av", "av"), ("u_ia", "interaction")):
            self.assertAlmostEqual(process[of], answer[sigma], places=14)
        self.assertAlmostEqual(process["u_mp"] ** 2, 0.02 ** 2 + 2 + 3 + u_bi ** 2 + 0.5 ** 2, places=12)
        self.assertAlmostEqual(process["q_mp_percent"], 400 * process["u_mp"] / 60, places=12)
        del study["tolerance"]
        self.assertIsNone(self.compute("grr", study)["measuring_process"]["q_mp_percent"])
        for missing in ("resolution", "u_cal", "u_evr", "u_bi"):
            less = {name: of for name, of in study["measuring_process"].items() if name != missing}
            errors = self.send("grr", {**study, "measuring_process": less}).json["errors"]
            self.assertEqual([(e["pointer"], e["code"]) for e in errors], [(f"/measuring_process/{missing}", "field.missing")])
        answer = self.send("type1", {**values, "measuring_system": {**known, "u_t": 1, "u_lin": -1}})
        self.assertEqual({(e["pointer"], e["code"]) for e in answer.json["errors"]},
                         {("/measuring_system/u_t", "field.unknown"), ("/measuring_system/u_lin", "field.invalid")})
        other = self.compute("type1", {**values, "tolerance_percent": 15, "spread": 4})
        self.assertAlmostEqual(other["cg"], 0.9 / (4 * u_evr), places=12)
        self.assertAlmostEqual(other["cgk"], (0.45 - 0.03) / (2 * u_evr), places=12)

    def test_a_study_with_a_missing_trial_and_its_intervals(self):
        study = self.compute("grr", {"model": "interaction", "measurements": STUDY[:-1], "confidence": 0.9})
        # Cell means 1, 5, 3 and 2; the harmonic mean of 2, 2, 2 and 1 is 1.6.
        self.assertAlmostEqual(study["anova"]["part"]["sum_of_squares"], 1.6 * 2.25, places=12)
        self.assertAlmostEqual(study["anova"]["interaction"]["sum_of_squares"], 1.6 * 6.25, places=12)
        self.assertEqual(study["anova"]["repeatability"]["sum_of_squares"], 6)
        self.assertAlmostEqual(study["ev"], 2 ** 0.5, places=14)
        intervals = study["intervals"]
        self.assertEqual(intervals["confidence"], 0.9)
        for name in ("ev", "grr"):
            self.assertLess(intervals[name]["lower"], study[name])
            self.assertGreater(intervals[name]["upper"], study[name])
        self.assertEqual(intervals["av"]["lower"], 0)
        self.assertNotIn("intervals", self.compute("grr", {"method": "average_range", "measurements": STUDY}))
        self.assertNotIn("grr", self.compute("grr", {"method": "nested", "measurements": STUDY})["intervals"])

    def test_the_agreement_of_ratings(self):
        """Worked out by hand: A rates all four parts right twice, B calls the second bad part good once."""
        rated = {"A": "11 11 00 00", "B": "11 11 00 01"}
        rows = [{"part": part, "operator": who, "trial": trial, "value": int(value), "reference": int(part < 2)}
                for who, words in rated.items() for part, word in enumerate(words.split()) for trial, value in enumerate(word)]
        study = self.compute("grr", {"method": "attribute", "good": 1, "measurements": rows})
        self.assertEqual((study["method"], study["clause"][:4]), ("attribute", "AIAG"))
        a, b = study["operators"]
        self.assertEqual((a["operator"], a["kappa_reference"], a["kappa_within"], a["misses"]["count"]), ("A", 1, 1, 0))
        self.assertEqual([b[of]["count"] for of in ("consistent", "effectiveness", "misses", "false_alarms")], [3, 3, 1, 0])
        self.assertEqual([b[of]["of"] for of in ("consistent", "effectiveness", "misses", "false_alarms")], [4, 4, 4, 4])
        self.assertEqual(b["misses"]["percent"], 25)
        # Of 8 pairs 7 agree, by chance 4 * 5 and 4 * 3 of 64; of 8 ratings of B 5 are good, and 3 of 4 parts agree.
        self.assertEqual([pair["operators"] for pair in study["pairs"]], [["A", "B"]])
        self.assertAlmostEqual(study["pairs"][0]["kappa"], (7 / 8 - 1 / 2) / (1 / 2), places=15)
        self.assertAlmostEqual(b["kappa_reference"], 0.75, places=15)
        chance = (25 + 9) / 64
        self.assertAlmostEqual(b["kappa_within"], (3 / 4 - chance) / (1 - chance), places=15)
        # All four ratings of a part: 6, 6, 6 and 3 of 6 pairs agree; 9 of 16 are good.
        chance = (81 + 49) / 256
        self.assertAlmostEqual(study["kappa_between"], (21 / 24 - chance) / (1 - chance), places=15)
        self.assertEqual([study["alike"]["count"], study["effectiveness"]["count"]], [3, 3])
        # The upper end of 0 of n: 1 - 0.025 ^ (1 / n).
        self.assertAlmostEqual(b["false_alarms"]["upper_percent"], 100 * (1 - 0.025 ** 0.25), places=10)
        # Trials are compared by their names, and numbers by their value.
        mixed = [{**row, "value": float(row["value"])} for row in rows if row["operator"] == "A"] + [
            row for row in reversed(rows) if row["operator"] == "B"]
        self.assertEqual(self.compute("grr", {"method": "attribute", "good": 1, "measurements": mixed}), study)
        bare = [{name: of for name, of in row.items() if name != "reference"} for row in rows]
        blind = self.compute("grr", {"method": "attribute", "measurements": bare})
        self.assertIsNone(blind["operators"][0]["kappa_reference"])
        self.assertFalse({"effectiveness", "misses", "false_alarms"} & set(blind["operators"][0]))
        for body, pointer, code in (
                ({"good": 1, "measurements": bare}, "/good", "field.conflict"),
                ({"good": "OK", "measurements": rows}, "/good", "field.invalid"),
                ({"measurements": rows[:1] + bare[1:]}, "/measurements", "field.missing"),
                ({"measurements": rows + rows[:1]}, f"/measurements/{len(rows)}/trial", "field.conflict"),
                ({"measurements": [*rows, {**rows[0], "trial": 2, "reference": 0}]},
                 f"/measurements/{len(rows)}/reference", "field.conflict"),
                ({"measurements": rows[:-1]}, "/measurements", "statistics.unbalanced"),
                ({"measurements": rows[:8]}, "/measurements", "statistics.too_few")):
            answer = self.send("grr", {"method": "attribute", **body})
            self.assertEqual((answer.json["errors"][0]["pointer"], answer.json["errors"][0]["code"]), (pointer, code))

    def test_one_trial_needs_a_model(self):
        """Its residue is repeatability and interaction together: nobody is told that it is the first alone."""
        single = {"measurements": [row for row in STUDY if row["trial"] == 0]}
        for model in ({}, {"model": "auto"}, {"model": "interaction"}):
            answer = self.send("grr", {**single, **model})
            self.assert_problem(answer, 422, "request.invalid")
            self.assertEqual(answer.json["errors"][0]["code"], "statistics.too_few")
            self.assertIn('"pooled"', answer.json["errors"][0]["detail"])
        self.assertEqual(self.compute("grr", {**single, "model": "pooled"})["model"], "pooled")

    def test_charts_with_a_memory_take_all_rules_and_look_at_the_first(self):
        values = [1, 2] * 10 + [9] * 12
        for kind in "ewma", "cusum":
            chart = {"kind": kind, "values": values, "phase1": {"from": 0, "to": 19}}
            found = self.compute("chart", {**chart, "rules": [1, 2, 3, 4]})["violations"]
            self.assertEqual({each["rule"] for each in found}, {1})
            self.assertEqual(found, self.compute("chart", {**chart, "rules": [1]})["violations"])

    def test_a_target_counts_with_one_limit_too(self):
        """Chan, Cheng and Spiring 1988: |limit - T| / 3 tau. Minitab's formula for one limit is the same."""
        values = ["9.98", "10.01", "10.03", "9.99", "10.02", "10"]
        data = [float(value) for value in values]
        mean = sum(data) / 6
        tau = (sum((x - mean) ** 2 for x in data) / 5 + (mean - 9.99) ** 2) ** 0.5
        for limits, distance in (({"upper": "10.1"}, 0.11), ({"lower": "9.9"}, 0.09)):
            found = self.compute("capability", {"values": values, "target": "9.99", **limits})["cpm"]
            self.assertAlmostEqual(found["value"], distance / (3 * tau), places=12)
            self.assertTrue(found["lower"] < found["value"] < found["upper"])
            self.assertIsNone(self.compute("capability", {"values": values, **limits})["cpm"])
        # The two agree where the target is the middle of both.
        both = self.compute("capability", {"values": values, "lower": "9.9", "upper": "10.1"})["cpm"]
        self.assertEqual(self.compute("capability", {"values": values, "upper": "10.1", "target": 10})["cpm"], both)
        # One of both limits may be the target, as 0 of a deviation of form.
        self.assertGreater(self.compute("capability", {"values": values, "lower": "9.9", "upper": "10.1", "target": "9.9"})["cpm"]["value"], 0)
        for wrong in ({"upper": "10.1", "target": "10.1"}, {"lower": "9.9", "target": 9}, {"lower": "9.9", "upper": "10.1", "target": "10.11"},
                      {"lower": "9.9", "upper": "10.1", "target": 1}):
            answer = self.send("capability", {"values": values, **wrong})
            problem = self.assert_problem(answer, 422, "request.invalid")
            self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]], [("/target", "limits.invalid")])

    def test_a_phase_is_refused_where_nothing_is_estimated(self):
        chart = {"kind": "i_mr", "values": [1, 2, 3, 9], "phase1": {"from": 0, "to": 3}}
        for known in ({}, {"centre": 2}, {"standard_deviation": 1}):
            self.compute("chart", {**chart, **known})
        answer = self.send("chart", {**chart, "centre": 2, "standard_deviation": 1})
        problem = self.assert_problem(answer, 422, "request.invalid")
        self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]], [("/phase1", "field.conflict")])
        self.assertIn("limits known", problem["errors"][0]["detail"])

    def test_a_member_that_would_change_nothing_is_refused_by_name(self):
        answer = self.send("chart", {"kind": "i_mr", "values": [1, 2, 3], "lambda": 0.3})
        self.assertEqual([(e["pointer"], e["detail"]) for e in answer.json["errors"]],
                         [("/lambda", "lambda has no effect with kind i_mr: it belongs to kind ewma")])
        answer = self.daemon.get("/v1/measurements/chart?kind=cusum&lambda=0.3")
        self.assert_problem(answer, 400, "query.invalid")
        self.assertIn("kind ewma", answer.json["detail"])

    def test_what_is_wrong_with_a_phase_points_to_it(self):
        for phase in ({"from": 0, "to": 9}, {"from": 1, "to": 2}):
            answer = self.send("chart", {"kind": "i_mr", "values": [1, 2, 3], "phase1": phase})
            self.assertEqual([e["pointer"] for e in answer.json["errors"]], ["/phase1"])

    def test_every_answer_names_formula_and_clause(self):
        """And the reference has the source: an edition or an author is written there."""
        reference = (ROOT / "docs/reference/statistics.md").read_text()
        rows = [{"part": row["part"], "value": row["value"]} for row in STUDY]
        linear = [{"reference": x, "value": x} for x in (1, 2, 2)]
        stable = [{"at": at, "value": at % 2} for at in range(4)]
        answers = [
            self.compute("summary", {"values": [1, 2]}), self.compute("anova", {"groups": [[1, 2], [2, 4]]}),
            self.compute("capability", {"values": [1, 2, 3], "upper": 4}),
            *(self.compute("chart", {"kind": kind, "subgroups": [[1, 2], [2, 4]]}) for kind in ("xbar_r", "xbar_s", "ewma", "cusum")),
            self.compute("chart", {"kind": "i_mr", "values": [1, 2]}),
            self.compute("type1", {"values": [1, 2], "reference": 1, "tolerance": 1}),
            *(self.compute("grr", {"method": method, "measurements": STUDY}) for method in ("anova", "average_range", "nested")),
            self.compute("grr", {"method": "type3", "measurements": rows}),
            self.compute("grr", {"method": "linearity", "measurements": linear}),
            self.compute("grr", {"method": "stability", "measurements": stable}),
            self.compute("pairing", {"holes": [1], "shafts": [1], "target_clearance_um": 0}),
            self.daemon.post("/v1/uncertainty", {"contributions": [{"name": "a", "standard_uncertainty": 1}]}).json,
            *(self.daemon.get(path).json for path in ("/v1/fits/25H7/g6", "/v1/gauges/25H7", "/v1/gauges/25g6",
                                                      "/v1/measurements/summary?group_by=characteristic")),
            self.daemon.post("/v1/press-fits", {"joint_diameter_mm": 50, "length_mm": 40, "max_interference_um": 40,
                                                "hub": {"outer_diameter_mm": 100}, "shaft": {}}).json]
        self.assertEqual(len({answer["formula"] for answer in answers}), len(answers))
        for answer in answers:
            source = answer["clause"].split(";")[0].split(",")[0]
            self.assertTrue("no standard" in source or source in reference, source)

    def test_two_thousand_pairs(self):
        source = random.Random(3)
        holes = [f"{25 + source.random() / 100:.6f}" for _ in range(2000)]
        shafts = [f"{25 - source.random() / 100:.6f}" for _ in range(2000)]
        pairs = self.compute("pairing", {"holes": holes, "shafts": shafts, "target_clearance_um": 10})["pairs"]
        self.assertEqual(sorted(p["hole"] for p in pairs), list(range(2000)))
        self.assertEqual(sorted(p["shaft"] for p in pairs), list(range(2000)))
        few = self.compute("pairing", {"holes_mm": [25.01], "shafts_mm": [24.99, 25.001], "target_clearance_um": 8})
        self.assertEqual(few["pairs"], [{"hole": 0, "shaft": 1, "clearance_um": 9}])

    def test_a_list_to_pair_is_refused_by_the_name_it_came_with(self):
        for ending in ("", "_mm"):
            for empty, other in (("holes", "shafts"), ("shafts", "holes")):
                body = {empty + ending: [], other + ending: [25], "target_clearance_um": 8}
                problem = self.assert_problem(self.daemon.post("/v1/statistics/pairing", body), 422, "request.invalid")
                self.assertEqual([each["pointer"] for each in problem["errors"]], [f"/{empty}{ending}"])
        both = {"holes": [25], "holes_mm": [25], "shafts": [25], "target_clearance_um": 8}
        problem = self.assert_problem(self.daemon.post("/v1/statistics/pairing", both), 422, "request.invalid")
        self.assertEqual([(each["code"], each["pointer"]) for each in problem["errors"]], [("field.conflict", "/holes_mm")])

    def test_what_is_refused(self):
        capability = {"values": [1, 2, 3], "lower": 0, "upper": 4}
        for name, body, code in [
                ("summary", {"values": []}, "statistics.too_few"),
                ("summary", {}, "field.missing"),
                ("summary", {"values": 3}, "field.type"),
                ("summary", {"values": [1, None]}, "field.type"),
                ("summary", {"values": ["NaN"]}, "number.malformed"),
                ("summary", {"values": ["1,5"]}, "number.malformed"),
                ("summary", b'{"values":[1e999]}', "number.out_of_range"),
                ("summary", {"values": [1e20, 1e-20]}, "number.out_of_range"),
                ("summary", {"values": [1], "what": 1}, "field.unknown"),
                ("anova", {"groups": [[1, 2]]}, "statistics.too_few"),
                ("anova", {"groups": [[1], [2]]}, "statistics.too_few"),
                ("anova", {"groups": [[1], []]}, "statistics.too_few"),
                ("anova", {"groups": [1, 2]}, "field.type"),
                ("capability", {**capability, "values": [1]}, "statistics.too_few"),
                ("capability", {**capability, "values": [1, 1, 1]}, "statistics.zero_spread"),
                ("capability", {**capability, "lower": 5}, "limits.invalid"),
                ("capability", {"values": [1, 2, 3]}, "field.missing"),
                ("capability", {**capability, "confidence": 1}, "field.invalid"),
                ("capability", {**capability, "subgroups": [[1, 2], [1, 2]]}, "field.conflict"),
                ("capability", {"subgroups": [[1, 2], [1]], "upper": 4}, "statistics.unbalanced"),
                ("capability", {"subgroups": [[1], [2]], "upper": 4}, "statistics.too_few"),
                ("chart", {"values": [1, 2]}, "field.missing"),
                ("chart", {"kind": "p", "values": [1, 2]}, "field.invalid"),
                ("chart", {"kind": "i_mr", "values": [1, 2], "rules": [5]}, "field.invalid"),
                ("chart", {"kind": "i_mr", "values": [1]}, "statistics.too_few"),
                ("chart", {"kind": "xbar_r", "values": [1, 2]}, "statistics.too_few"),
                ("chart", {"kind": "i_mr", "values": [1, 2], "phase1": {"from": 0, "to": 9}}, "field.invalid"),
                ("chart", {"kind": "ewma", "values": [1, 2], "lambda": 0}, "field.invalid"),
                ("chart", {"kind": "i_mr", "values": [1, 2], "lambda": 0.2}, "field.conflict"),
                ("chart", {"kind": "xbar_r", "subgroups": [[1, 2], [2, 4]], "decision_interval": 4}, "field.conflict"),
                ("chart", {"kind": "ewma", "values": [1, 2], "reference_value": 1}, "field.conflict"),
                ("grr", {"method": "average_range", "model": "pooled", "measurements": STUDY}, "field.conflict"),
                ("type1", {"values": [1, 1], "reference": 1, "tolerance": 1}, "statistics.zero_spread"),
                ("type1", {"values": [1, 2], "reference": 1, "tolerance": -1}, "limits.invalid"),
                ("type1", {"values": [1, 2], "tolerance": 1}, "field.missing"),
                ("grr", {"method": "average_range", "measurements": STUDY[:-1]}, "statistics.unbalanced"),
                ("grr", {"measurements": STUDY[:-2]}, "statistics.unbalanced"),
                ("grr", {"method": "average_range", "confidence": 0.9, "measurements": STUDY}, "field.conflict"),
                ("grr", {"measurements": [{"part": 1, "value": 1}]}, "field.missing"),
                ("grr", {"measurements": [{**row, "value": 1} for row in STUDY]}, "statistics.zero_spread"),
                ("grr", {"measurements": [{**row, "operator": 1, "trial": i} for i, row in enumerate(STUDY)]},
                 "statistics.too_few"),
                ("grr", {"measurements": STUDY + STUDY[:1]}, "field.conflict"),
                ("grr", {"method": "guess", "measurements": STUDY}, "field.invalid"),
                ("pairing", {"holes": [], "shafts": [1], "target_clearance_um": 0}, "statistics.too_few"),
                ("pairing", {"holes": [1], "shafts": [1]}, "field.missing")]:
            with self.subTest(name=name, body=body):
                answer = self.send(name, body)
                self.assert_problem(answer, 422, "request.invalid")
                self.assertEqual(answer.json["errors"][0]["code"], code, answer)
        self.assert_problem(self.send("summary", b'{"values":[NaN]}'), 400, "json.malformed")
        # Ten million: too many values, or too many bytes before they are counted; both say what to do.
        for value, limit in ((b"1,", "more than 500000 values"), (b"25.0105,", "must have at most 33554432 bytes")):
            ten_million = b'{"values":[' + value * 9_999_999 + b"1]}"
            answer = self.send("summary", ten_million)
            self.assert_problem(answer, 413, "request.body_too_large")
            self.assertIn(limit, answer.json["detail"])
            self.assertIn("GET /v1/measurements/summary", answer.json["detail"])


class Fits(DaemonTest):
    def test_gauges(self):
        gauge = self.daemon.get("/v1/gauges/25H7").json
        self.assertEqual(gauge["scheme"], "ISO/R 1938:1971")
        self.assertEqual(gauge["go"], {"upper_mm": 25.005, "lower_mm": 25.001, "wear_limit_mm": 24.997})
        self.assertEqual(gauge["no_go"], {"upper_mm": 25.023, "lower_mm": 25.019})
        for designation, status, code in [("501H7", 422, "size.out_of_range"),
                                          ("25H17", 422, "class.undefined_for_size"),
                                          ("25H19", 404, "class.unknown")]:
            self.assert_problem(self.daemon.get(f"/v1/gauges/{designation}"), status, code)

    def test_the_search(self):
        path = "/v1/fits?nominal_mm=25&min_clearance_um=5&max_clearance_um=45"
        found = self.daemon.get(path).json
        self.assertTrue(found["fits"][0]["preferred"])
        self.assertIn("25 H7/g6", [fit["designation"] for fit in found["fits"]])
        self.assertEqual(len(self.daemon.get(path + "&limit=3").json["fits"]), 3)
        for fit in found["fits"]:
            names = ("hole_class", "shaft_class", "preferred")
            self.assertEqual({name: value for name, value in fit.items() if name not in names},
                             self.daemon.get("/v1/fits/" + fit["designation"].replace(" ", "")).json)
        fit = self.daemon.get("/v1/fits/25H7/k6").json
        self.assertAlmostEqual(fit["statistical"]["uniform"]["probability_of_interference"], 8.5 / 21)
        self.assert_problem(self.daemon.get("/v1/fits?nominal_mm=25"), 400, "query.missing")
        self.assert_problem(self.daemon.get("/v1/fits?nominal_mm=25&min_clearance_um=9&max_clearance_um=5"), 400,
                            "query.invalid")

    def test_a_press_fit(self):
        body = {"joint_diameter_mm": 50, "length_mm": 40, "max_interference_um": 40,
                "hub": {"outer_diameter_mm": 100}, "shaft": {}}
        pressed = self.daemon.post("/v1/press-fits", body).json
        self.assertAlmostEqual(pressed["at_max_interference"]["pressure_mpa"], 63, places=9)
        for change in ({"joint_diameter_mm": 0}, {"length_mm": "x"}, {"hub": {}}, {"shaft": {"inner_diameter_mm": 60}}):
            with self.subTest(change):
                self.assert_problem(self.daemon.post("/v1/press-fits", {**body, **change}), 422, "request.invalid")
