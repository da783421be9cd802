"""Uncertainty budgets and models over HTTP."""

from support.daemon import DaemonTest


class Uncertainty(DaemonTest):
    def test_the_end_gauge_of_the_gum(self):
        body = {"contributions": [
            {"name": "standard", "standard_uncertainty": 25, "degrees_of_freedom": 18},
            {"name": "comparator", "standard_uncertainty": 9.7, "degrees_of_freedom": 25.6},
            {"name": "expansion", "standard_uncertainty": 2.9, "degrees_of_freedom": 50},
            {"name": "temperature", "standard_uncertainty": 16.6, "degrees_of_freedom": 2}],
            "probability": 0.99, "monte_carlo": {"trials": 20000, "seed": 3}}
        answer = self.daemon.post("/v1/uncertainty", body).json
        self.assertAlmostEqual(answer["combined_standard_uncertainty"], 31.7, delta=0.05)
        self.assertEqual(answer["effective_degrees_of_freedom"], 16)
        self.assertAlmostEqual(answer["expanded_uncertainty"], 93, delta=0.6)
        self.assertLess(answer["monte_carlo"]["interval"]["lower"], 0)
        self.assertEqual(answer, self.daemon.post("/v1/uncertainty", body).json)

    MASS = {"model": "(m + dm)*(1 + (ra - 1.2)*(1/rw - 1/rr)) - 100000", "contributions": [
        {"name": "m", "value": 100000, "standard_uncertainty": 0.05},
        {"name": "dm", "value": 1.234, "standard_uncertainty": 0.02}, {"name": "ra", "value": 1.2, "half_width": 0.1},
        {"name": "rw", "value": 8000, "half_width": 1000}, {"name": "rr", "value": 8000, "half_width": 50}]}

    def test_a_model_is_differentiated_and_drawn(self):
        # JCGM 101, 9.3: 1.2340 mg with 0.0539 mg, in the second order 0.0750 mg; drawn 0.0754 mg.
        answer = self.daemon.post("/v1/uncertainty", {**self.MASS, "monte_carlo": {"digits": 1}}).json
        self.assertAlmostEqual(answer["value"], 1.234, places=9)
        self.assertAlmostEqual(answer["combined_standard_uncertainty"], 0.0538516, places=6)
        self.assertAlmostEqual(answer["second_order_standard_uncertainty"], 0.0749635, places=6)
        self.assertEqual([each["name"] for each in answer["sensitivities"]], ["m", "dm", "ra", "rw", "rr"])
        self.assertAlmostEqual(answer["sensitivities"][1]["contribution"], 0.02, places=9)
        self.assertAlmostEqual(answer["monte_carlo"]["mean"], 1.234, delta=0.005)
        self.assertAlmostEqual(answer["monte_carlo"]["standard_deviation"], 0.0754, delta=0.003)
        self.assertGreaterEqual(answer["monte_carlo"]["trials"], 20000)

    def test_the_interval_of_the_gum_is_validated_by_monte_carlo(self):
        """JCGM 101, 8, with the tables of 9.2 and 9.3."""
        def validation(last, distribution, digits=2):
            contributions = [{"name": f"x{i}", "standard_uncertainty": u, "distribution": distribution}
                             for i, u in enumerate([1, 1, 1, last])]
            answer = self.daemon.post("/v1/uncertainty", {"contributions": contributions,
                                                          "monte_carlo": {"digits": digits}}).json
            return answer["monte_carlo"]["validation"]
        # Table 2: four normal quantities, u 2.0, so that 1 digit leaves 0.5 open and 2 digits 0.05.
        one, two = validation(1, "normal")
        self.assertEqual([one["digits"], one["tolerance"], one["validated"]], [1, 0.5, True])
        self.assertEqual([two["digits"], two["tolerance"], two["validated"]], [2, 0.05, True])
        # Table 5: one of four rectangular ones is ten times as wide; 19.9 and 17.0 are half the intervals.
        one, two = validation(10, "rectangular", 1)
        self.assertAlmostEqual(one["lower_difference"], 2.9, delta=0.15)
        self.assertAlmostEqual(one["upper_difference"], 2.9, delta=0.15)
        self.assertEqual([one["tolerance"], one["validated"]], [5, True])
        self.assertEqual([two["tolerance"], two["validated"]], [0.5, False])
        # Table 7: 0.0451 and 0.0430 mg of the first order, more than 0.005 mg.
        one = self.daemon.post("/v1/uncertainty", {**self.MASS, "monte_carlo": {"trials": 500000}}).json["monte_carlo"]["validation"][0]
        self.assertAlmostEqual(one["lower_difference"], 0.0451, delta=0.002)
        self.assertAlmostEqual(one["upper_difference"], 0.0430, delta=0.002)
        self.assertEqual([one["tolerance"], one["validated"]], [0.005, False])

    def test_a_gauge_is_judged_by_a_model(self):
        body = {"model": "a*b", "contributions": [{"name": "a", "value": 2, "standard_uncertainty": 0.5},
                                                  {"name": "b", "value": 1, "standard_uncertainty": 0}]}
        self.assertEqual(self.daemon.request("PUT", "/v1/uncertainties/model", body).status, 201)
        self.assertEqual(self.daemon.get("/v1/uncertainties/model").json, body)
        self.assertEqual(self.daemon.request("PUT", "/v1/gauges-in-use/G-M", {
            "uncertainty": "model", "calibration_due": "2099-12-31"}).status, 201)
        record = self.daemon.measure({"designation": "25 H7", "measured_mm": "25.0202", "gauge": "G-M",
                                      "rule": "guard_band"}).json
        self.assertEqual((record["uncertainty_um"], record["verdict"]), (0.5, "indeterminate"))

    def test_the_times_of_a_gauge_are_in_utc(self):
        path, noon = "/v1/gauges-in-use/G-U", "2026-07-01T12:00:00+02:00"
        self.assertEqual(self.daemon.request("PUT", path, {"calibration_due": noon, "comment": "ü"}).status, 201)
        self.assertEqual(self.daemon.get(path).json, {"calibration_due": "2026-07-01T10:00:00Z", "comment": "ü"})
        late = self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01, "gauge": "G-U",
                                    "measured_at": "2026-07-01T12:30:00+02:00"}).json
        self.assertEqual(late["calibration_due"], "2026-07-01T10:00:00Z")
        made = [self.daemon.post(f"{path}/calibrations", {"from": start, "due": end}) for start, end in (
            ("2026-07-02T00:00:00.5+02:00", "2026-08-01T00:00:00+02:00"), ("2026-07-02T00:00:00+02:00", "2026-08-01"),
            ("2026-07-03", "2026-08-01"), ("2026-07-01T22:00:00Z", "2026-09-01"))]
        self.assertEqual([answer.status for answer in made], [201, 201, 201, 200])
        self.assertEqual([(each["from"], each["due"]) for each in self.daemon.get(f"{path}/calibrations").json["calibrations"]],
                         [("2026-07-01T22:00:00Z", "2026-09-01"), ("2026-07-01T22:00:00.5Z", "2026-07-31T22:00:00Z"),
                          ("2026-07-03", "2026-08-01")])
        study = {"gauge": "G-U", "at": noon, "kind": "type1", "input": {"values": [1, 2, 4], "reference": 2, "tolerance": 1}}
        self.assertEqual(self.daemon.request("PUT", "/v1/studies/S-U", study).json["at"], "2026-07-01T10:00:00Z")
        self.assertEqual([each["at"] for each in self.daemon.get("/v1/studies").json["studies"]], ["2026-07-01T10:00:00Z"])

    def test_a_model_is_refused_with_its_place(self):
        a, b = ({"name": name, "value": 2, "standard_uncertainty": 1} for name in "ab")
        inexact = {**a, "half_width": 1, "limits_half_width": 0.1}
        del inexact["standard_uncertainty"]
        for model, contributions, pointer, code, words in [
                ("a*c", [a], "/model", "field.invalid", "'c' at character 3"),
                ("a*b", [a], "/model", "field.invalid", "'b' at character 3"),
                ("a", [a, b], "/model", "field.invalid", "does not use 'b'"),
                ("a = b", [a, b], "/model", "field.invalid", "character 3"),
                ("ln(0 - a) + b", [a, b], "/model", "field.invalid", "no value at the estimates"),
                ("a", [{**a, "sensitivity": 2}], "/contributions/0/sensitivity", "field.conflict", "remove it"),
                ("a", [{**a, "name": "sin"}], "/contributions/0/name", "field.invalid", "not be a function or pi"),
                ("a" * 101, [{**a, "name": "a" * 101}], "/contributions/0/name", "field.invalid", "1 to 100"),
                ("a", [{"name": "a", "standard_uncertainty": 1}], "/contributions/0/value", "field.missing", "value"),
                (None, [a], "/contributions/0/value", "field.conflict", "model"),
                ("a", [{**inexact, "distribution": "triangular"}], "/contributions/0/limits_half_width",
                 "field.invalid", "rectangular"),
                ("a", [{**inexact, "limits_half_width": 2}], "/contributions/0/limits_half_width", "field.invalid",
                 "less than half_width")]:
            with self.subTest(model=model, pointer=pointer):
                body = {"contributions": contributions, **({"model": model} if model else {})}
                answer = self.daemon.post("/v1/uncertainty", body)
                self.assert_problem(answer, 422, "request.invalid")
                first = answer.json["errors"][0]
                self.assertEqual((first["pointer"], first["code"]), (pointer, code), first)
                self.assertIn(words, first["detail"])
        both = self.daemon.post("/v1/uncertainty", {"contributions": [{"name": "a", "standard_uncertainty": 1}],
                                                    "monte_carlo": {"digits": 2, "trials": 1000}})
        self.assertEqual(both.json["errors"][0]["pointer"], "/monte_carlo/digits")
        drawn = self.daemon.post("/v1/uncertainty", {"model": "ln(a)", "contributions": [a],
                                                     "monte_carlo": {"trials": 1000}})
        self.assertEqual((drawn.json["errors"][0]["pointer"], drawn.json["errors"][0]["code"]),
                         ("/model", "number.out_of_range"))
        never = self.daemon.post("/v1/uncertainty", {"contributions": [{"name": "a", "standard_uncertainty": 1}],
                                                     "probability": 0.9999999, "monte_carlo": {"digits": 2}})
        self.assert_problem(never, 422, "figures.limit")

    def test_what_is_refused(self):
        one = {"name": "a", "standard_uncertainty": 1}
        for body, code in [
                ({"contributions": []}, "field.invalid"),
                ({"contributions": [{"name": "a"}]}, "field.missing"),
                ({"contributions": [{"name": "a", "standard_uncertainty": -1}]}, "field.invalid"),
                ({"contributions": [{"name": "a", "half_width": 1, "distribution": "normal"}]}, "field.invalid"),
                ({"contributions": [{**one, "half_width": 1}]}, "field.conflict"),
                ({"contributions": [{**one, "distribution": "odd"}]}, "field.invalid"),
                ({"contributions": [{**one, "degrees_of_freedom": 0}]}, "field.invalid"),
                ({"contributions": [one, one]}, "field.conflict"),
                ({"contributions": [one], "probability": 1}, "field.invalid"),
                ({"contributions": [{**one, "standard_uncertainty": 1e300}]}, "field.invalid"),
                ({"contributions": [{**one, "standard_uncertainty": 1e-300}]}, "field.invalid"),
                ({"contributions": [{**one, "sensitivity": -1e300}]}, "field.invalid"),
                ({"contributions": [one], "correlations": [{"between": ["a", "b"], "coefficient": 1}]},
                 "field.invalid"),
                ({"contributions": [{**one, "distribution": "t"}]}, "field.missing"),
                ({"contributions": [one, {**one, "name": "b"}],
                  "correlations": [{"between": ["a", "b"], "coefficient": 0.9},
                                   {"between": ["b", "a"], "coefficient": 0.9}]}, "field.conflict"),
                ({"contributions": [one], "monte_carlo": {"trials": 10 ** 12}}, "field.invalid")]:
            with self.subTest(body=body):
                answer = self.daemon.post("/v1/uncertainty", body)
                self.assert_problem(answer, 422, "request.invalid")
                self.assertEqual(answer.json["errors"][0]["code"], code, answer)
