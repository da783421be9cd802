"""Decisions with uncertainty and temperature: worked out by hand, and what is refused."""

from statistics import NormalDist

from support.daemon import DaemonTest

HOLE = "/v1/verdicts/25H7?measured_mm="


class Decisions(DaemonTest):
    def verdict(self, query):
        answer = self.daemon.get(HOLE + query)
        self.assertEqual(answer.status, 200, answer)
        return answer.json

    def test_conformance(self):
        # One limit counts: g is the 95 % quantile times u (JCGM 106, table 1), here 3.2897 um.
        guard = NormalDist().inv_cdf(0.95) * 2
        for measured, verdict in (("25.00329", "good"), ("25.003289", "indeterminate"), ("25.01771", "good"),
                                  ("25.017711", "indeterminate"), ("24.996711", "indeterminate"),
                                  ("24.99671", "rework"), ("25.02429", "reject")):
            with self.subTest(measured):
                found = self.verdict(f"{measured}&rule=conformance&uncertainty_um=2")
                self.assertEqual(found["verdict"], verdict)
                self.assertAlmostEqual(found["guard_band_um"], guard, places=8)
                true = NormalDist(float(measured), 0.002)
                self.assertAlmostEqual(found["conformance_probability"], true.cdf(25.021) - true.cdf(25), places=8)
                self.assertEqual(found["probability"], 0.95)
        self.assertEqual(self.verdict("25.0033&rule=conformance&uncertainty_um=2&probability=0.99")["verdict"],
                         "indeterminate")

    def test_a_stored_value_decides_as_the_question_did(self):
        for query in ("25.00329&rule=conformance&uncertainty_um=2", "25.03&rule=conformance&uncertainty_um=2",
                      "25.0032&rule=conformance&uncertainty_um=2&probability=0.9",
                      "25.0215&temperature_c=25&part_material=steel",
                      "25.0215&rule=conformance&uncertainty_um=1&temperature_c=25&part_expansion_um_per_m_k=11.5"
                      "&scale_temperature_c=19.5&scale_material=glass_scale"):
            with self.subTest(query):
                asked = self.verdict(query)
                given = dict(pair.split("=") for pair in f"measured_mm={query}".split("&"))
                answer = self.daemon.measure({"designation": "25 H7", **given})
                self.assertEqual(answer.status, 201, answer)
                record = answer.json
                for name, value in asked.items():
                    self.assertEqual(record[name], value, name)
                for name, value in given.items():
                    self.assertEqual(str(record[name]), value, name)
                self.assertEqual(self.daemon.get(f"/v1/measurements/{record['id']}").json, record)
                listed = self.daemon.get("/v1/measurements?last=1", Accept="text/csv").text.splitlines()
                row = dict(zip(listed[0].split(","), listed[1].split(",")))
                for name in ("conformance_probability", "guard_band_um", "corrected_mm", "probability"):
                    self.assertEqual(float(row[name]) if row[name] else None, record.get(name), name)
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_a_drawing_may_have_one_limit(self):
        def record(measured, **fields):
            answer = self.daemon.measure({"nominal_mm": 10, "feature": "shaft", "measured_mm": measured, **fields})
            self.assertEqual(answer.status, 201, answer)
            return answer.json

        above = record("10.01", upper_um=10)
        self.assertEqual((above["verdict"], above["excess_um"], above["upper_limit_mm"]), ("good", 0, 10.01))
        for absent in ("lower_limit_mm", "lower_deviation_um", "tolerance_um"):
            self.assertNotIn(absent, above)
        self.assertEqual(record("10.010001", upper_um=10)["verdict"], "rework")
        self.assertEqual(record("0.000001", upper_um=10)["verdict"], "good")
        below = record("9.98999", lower_um=-10, rule="guard_band", uncertainty_um="0.002")
        self.assertEqual((below["verdict"], below["lower_limit_mm"], below["excess_um"]), ("reject", 9.99, -0.01))
        self.assertNotIn("upper_limit_mm", below)
        self.assertEqual(record(90_000_000, lower_um=-10)["verdict"], "good")
        # One limit counts: the distance of 1.645 u conforms with 95 %.
        guard = NormalDist().inv_cdf(0.95)
        found = record("9.99165", lower_um=-10, rule="conformance", uncertainty_um=1)
        self.assertEqual(found["verdict"], "good")
        self.assertAlmostEqual(found["guard_band_um"], guard, places=8)
        self.assertEqual(record("9.99164", lower_um=-10, rule="conformance", uncertainty_um=1)["verdict"],
                         "indeterminate")
        answer = self.daemon.measure({"nominal_mm": 10, "feature": "shaft", "measured_mm": 10})
        self.assertEqual(self.assert_problem(answer, 422, "request.invalid")["errors"][0]["pointer"], "/upper_um")
        path = f"/v1/measurements/{above['id']}/corrections"
        corrected = self.daemon.post(path, {"measured_mm": "10.02", "reason": "misread"}).json
        self.assertEqual((corrected["verdict"], "lower_limit_mm" in corrected), ("rework", False))
        for value in ("10.001", "10.002", "10.004"):
            record(value, upper_um=10, characteristic="one-sided")
        figures = self.daemon.get("/v1/measurements/capability?characteristic=one-sided").json
        self.assertIsNone(figures["cp"]["value"] if figures["cp"] else None)
        self.assertNotIn("lower_limit_mm", figures["selection"])
        self.assertGreater(figures["cpu"]["value"], 0)

    def test_a_correction_keeps_what_decided(self):
        given = {"designation": "25 H7", "measured_mm": "25.0215", "temperature_c": 25, "part_material": "steel",
                 "rule": "conformance", "uncertainty_um": "0.5", "probability": "0.9"}
        record = self.daemon.measure(given).json
        self.assertEqual((record["verdict"], record["corrected_mm"]), ("good", 25.020061))
        path = f"/v1/measurements/{record['id']}/corrections"
        corrected = self.daemon.post(path, {"measured_mm": "25.0225", "reason": "misread"}).json
        self.assertEqual((corrected["verdict"], corrected["corrected_mm"], corrected["probability"],
                          corrected["part_material"]), ("indeterminate", 25.021061, 0.9, "steel"))

    def test_what_a_stored_value_refuses(self):
        for fields, pointer, code in (
                ({"rule": "conformance"}, "/uncertainty_um", "field.missing"),
                ({"rule": "conformance", "uncertainty_um": 0}, "/uncertainty_um", "rule.invalid"),
                ({"rule": "conformance", "uncertainty_um": 5.4}, "/uncertainty_um", "rule.no_acceptance"),
                ({"rule": "conformance", "uncertainty_um": 1, "probability": 1}, "/probability", "number.out_of_range"),
                ({"part_material": "steel"}, "/temperature_c", "field.missing"),
                ({"temperature_c": 25, "part_material": "wood"}, "/part_material", "field.invalid"),
                ({"temperature_c": 25, "part_material": "steel", "part_expansion_um_per_m_k": 11},
                 "/part_material", "field.conflict")):
            with self.subTest(fields):
                answer = self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01, **fields})
                problem = self.assert_problem(answer, 422, "request.invalid")
                self.assertEqual([(each["pointer"], each["code"]) for each in problem["errors"]], [(pointer, code)])

    def test_both_limits_count_where_the_uncertainty_is_large(self):
        # At the middle of 21 um with u = 5.3 um lie 95.24 %; with 5.4 um 94.8 %, and no value is good.
        self.assertEqual(self.verdict("25.0105&rule=conformance&uncertainty_um=5.3")["verdict"], "good")
        for measured in ("25.0105", "25.1", "24"):
            self.assert_problem(self.daemon.get(f"{HOLE}{measured}&rule=conformance&uncertainty_um=5.4"), 422,
                                "rule.no_acceptance")

    def test_what_conformance_refuses(self):
        for query, status, code in (("", 422, "rule.invalid"), ("&uncertainty_um=0", 422, "rule.invalid"),
                                    ("&uncertainty_um=1&probability=1", 400, "query.invalid"),
                                    ("&uncertainty_um=1&probability=0.4", 400, "query.invalid")):
            with self.subTest(query):
                self.assert_problem(self.daemon.get(f"{HOLE}25.01&rule=conformance{query}"), status, code)

    def test_the_size_at_20_degrees_decides(self):
        # 25.0215 / (1 + 11.5e-6 * 5) = 25.020061...: too large as read, good at 20 degrees.
        found = self.verdict("25.0215&temperature_c=25&part_material=steel")
        self.assertEqual((found["measured_mm"], found["corrected_mm"], found["verdict"], found["deviation_um"],
                          found["excess_um"]), (25.0215, 25.020061, "good", 20.061, 0))
        # A scale at the part's temperature with the same expansion takes the correction back.
        found = self.verdict("25.0215&temperature_c=25&part_material=steel&scale_temperature_c=25"
                             "&scale_expansion_um_per_m_k=11.5")
        self.assertEqual((found["corrected_mm"], found["verdict"], found["excess_um"]), (25.0215, "reject", 0.5))
        self.assertNotIn("corrected_mm", self.verdict("25.0215&temperature_c=25"))

    def test_what_temperature_refuses(self):
        for query in ("part_material=steel", "temperature_c=25&part_material=wood",
                      "temperature_c=25&part_material=steel&part_expansion_um_per_m_k=11", "temperature_c=-300",
                      "temperature_c=25&part_expansion_um_per_m_k=-1"):
            with self.subTest(query):
                self.assert_problem(self.daemon.get(f"{HOLE}25.01&{query}"), 400, "query.invalid")


class Kept(DaemonTest):
    BUDGET = {"contributions": [{"name": "ring", "standard_uncertainty": 0.3},
                                {"name": "repeatability", "standard_uncertainty": 0.4}]}

    def put(self, path, body, **headers):
        return self.daemon.request("PUT", path, body, {k.replace("_", "-"): v for k, v in headers.items()})

    def test_a_budget_is_kept_under_a_name(self):
        path = "/v1/uncertainties/bore%20gauge%20%2F%20ring"
        first = self.put(path, self.BUDGET)
        self.assertEqual(first.status, 201, first)
        self.assertAlmostEqual(first.json["combined_standard_uncertainty"], 0.5, places=15)
        self.assertEqual(self.put(path, self.BUDGET).status, 200)
        found = self.daemon.get(path)
        self.assertEqual((found.json, found.headers["etag"]), (self.BUDGET, first.headers["etag"]))
        self.assertEqual([u["name"] for u in self.daemon.get("/v1/uncertainties").json["uncertainties"]],
                         ["bore gauge / ring"])
        self.assert_problem(self.put(path, self.BUDGET, If_None_Match="*"), 412, "precondition.failed")
        self.assert_problem(self.put(path, {"contributions": []}), 422, "request.invalid")
        self.assertEqual(self.daemon.request("DELETE", path).status, 204)
        self.assert_problem(self.daemon.request("DELETE", path), 404, "uncertainty.unknown")
        self.assert_problem(self.daemon.get(path), 404, "uncertainty.unknown")

    def test_a_gauge_in_use_names_its_budget_and_when_it_is_due(self):
        self.put("/v1/uncertainties/plug", self.BUDGET)
        path = "/v1/gauges-in-use/G-07"
        body = {"uncertainty": "plug", "calibration_due": "2027-03-31"}
        self.assertEqual([self.put(path, body).status for _ in range(2)], [201, 200])
        self.assertEqual(self.daemon.get(path).json, body)
        self.assertEqual(self.put(path, {"calibration_due": "2027-03-31T12:00:00+01:00"}).status, 200)
        for wrong, pointer, code in (({**body, "uncertainty": "none"}, "/uncertainty", "uncertainty.unknown"),
                                     ({**body, "calibration_due": "2027-02-30"}, "/calibration_due", "time.malformed"),
                                     ({}, "/calibration_due", "field.missing"),
                                     ({**body, "what": 1}, "/what", "field.unknown")):
            with self.subTest(wrong):
                problem = self.assert_problem(self.put(path, wrong), 422, "request.invalid")
                self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]], [(pointer, code)])
        self.assertEqual(self.daemon.request("DELETE", path).status, 204)
        self.assert_problem(self.daemon.get(path), 404, "gauge.unknown")

    def test_a_measurement_is_judged_as_its_gauge_says(self):
        """The budget of the gauge has u = 0.5 um, so the guard band of k = 2 is 1 um."""
        self.put("/v1/uncertainties/plug", self.BUDGET)
        self.put("/v1/gauges-in-use/G-11", {"uncertainty": "plug", "calibration_due": "2026-03-31"})

        def measure(**fields):
            answer = self.daemon.measure({"designation": "25 H7", "measured_mm": "25.0009", "gauge": "G-11", **fields})
            self.assertEqual(answer.status, 201, answer)
            record = self.daemon.get(f"/v1/measurements/{answer.json['id']}").json
            self.assertEqual({**record, "warnings": answer.json.get("warnings")}, {"warnings": None, **answer.json})
            return record

        in_time = {"measured_at": "2026-03-31T23:59:59Z"}
        record = measure(rule="guard_band", **in_time)
        self.assertEqual((record["verdict"], record["uncertainty_um"], record["uncertainty"]),
                         ("indeterminate", 0.5, "plug"))
        self.assertNotIn("calibration_overdue", record)
        self.assertEqual(measure(rule="guard_band", measured_mm="25.001", **in_time)["verdict"], "good")
        self.assertNotIn("uncertainty_um", measure())
        own = measure(rule="guard_band", uncertainty_um=0.1, **in_time)
        self.assertEqual((own["verdict"], "uncertainty" in own), ("good", False))
        late = measure(rule="conformance")
        self.assertEqual((late["calibration_overdue"], late["calibration_due"], late["uncertainty"]),
                         (True, "2026-03-31", "plug"))
        rows = self.daemon.get("/v1/measurements?last=1", Accept="text/csv").text.splitlines()
        row = dict(zip(rows[0].split(","), rows[1].split(",")))
        self.assertEqual((row["uncertainty"], row["calibration_due"], row["calibration_overdue"]),
                         ("plug", "2026-03-31", "true"))

        # A correction keeps what the gauge said then; another gauge says its own.
        self.put("/v1/uncertainties/plug", {"contributions": [{"name": "all", "standard_uncertainty": 2}]})
        self.put("/v1/gauges-in-use/G-12", {"uncertainty": "plug", "calibration_due": "2199-12-31"})

        def correct(body):
            path = f"/v1/measurements/{late['id']}/corrections"
            return self.daemon.post(path, {"measured_mm": "25.0011", "reason": "misread", **body})

        self.assert_problem(correct({"gauge": "G-13"}), 422, "request.invalid")
        kept = correct({}).json
        self.assertEqual((kept["uncertainty_um"], kept["uncertainty"], kept["calibration_overdue"]), (0.5, "plug", True))
        late = measure(rule="conformance")
        self.assertEqual(late["uncertainty_um"], 2)
        other = correct({"gauge": "G-12", "measured_mm": "25.01"}).json
        self.assertEqual((other["uncertainty_um"], other["gauge"]), (2, "G-12"))
        self.assertNotIn("calibration_overdue", other)
        self.daemon.request("DELETE", "/v1/gauges-in-use/G-12")
        answer = self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01, "gauge": "G-12",
                                      "rule": "guard_band"})
        self.assertEqual(self.assert_problem(answer, 422, "request.invalid")["errors"][0]["pointer"], "/uncertainty_um")
        # It stands after a restart, and the log is whole.
        self.daemon.stop()
        self.daemon.start()
        self.assertEqual(measure(rule="guard_band")["uncertainty_um"], 2)
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_what_counts_is_the_calibration_of_the_time_of_measuring(self):
        for name, u in (("first", 0.5), ("second", 2)):
            self.put(f"/v1/uncertainties/{name}", {"contributions": [{"name": "all", "standard_uncertainty": u}]})
        self.put("/v1/gauges-in-use/G-30", {"uncertainty": "first", "calibration_due": "2026-01-01"})
        path = "/v1/gauges-in-use/G-30/calibrations"
        calibration = {"from": "2026-07-01", "due": "2027-07-01", "certificate": "K-1", "laboratory": "DKD",
                       "uncertainty": "second", "as_found_um": -0.5, "as_left_um": 0.1}
        answer = self.daemon.post(path, calibration)
        self.assertEqual(answer.status, 201, answer)
        self.assertEqual({**answer.json, **calibration, "status": "in_use"}, answer.json)
        self.assertEqual(self.daemon.post(path, {"from": "2026-10-01", "status": "blocked", "comment": "fell"}).status, 201)
        listed = self.daemon.get(path).json["calibrations"]
        self.assertEqual([(each["from"], each["status"]) for each in listed],
                         [("2026-07-01", "in_use"), ("2026-10-01", "blocked")])

        def measure(at):
            answer = self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "gauge": "G-30",
                                          "rule": "guard_band", "measured_at": at}).json
            stored = self.daemon.get(f"/v1/measurements/{answer['id']}").json
            codes = [each["code"] for each in answer.pop("warnings", [])]
            self.assertEqual(stored, answer)
            of_calibration = answer.get("calibration_certificate"), answer.get("calibration_laboratory")
            self.assertEqual(of_calibration, ("K-1", "DKD") if answer["uncertainty"] == "second" else (None, None))
            return answer["uncertainty"], answer["uncertainty_um"], answer.get("calibration_due"), codes

        self.assertEqual(measure("2025-12-31T00:00:00Z"), ("first", 0.5, None, []))
        self.assertEqual(measure("2026-06-30T23:59:59Z"), ("first", 0.5, "2026-01-01", ["gauge.overdue"]))
        self.assertEqual(measure("2026-07-01T00:00:00Z"), ("second", 2, None, []))
        self.assertEqual(measure("2026-10-01T00:00:00Z"), ("first", 0.5, None, ["gauge.blocked"]))
        # One with the same beginning takes the place of the other.
        self.assertEqual(self.daemon.post(path, {"from": "2026-10-01T00:00:00Z", "due": "2026-11-01"}).status, 200)
        self.assertEqual(len(self.daemon.get(path).json["calibrations"]), 2)
        self.assertEqual(measure("2026-10-05T00:00:00Z"), ("first", 0.5, None, []))
        # What a gauge is said to be later leaves its calibrations as they are.
        self.put("/v1/gauges-in-use/G-30", {"calibration_due": "2099-01-01"})
        self.assertEqual(measure("2026-08-01T00:00:00Z")[:3], ("second", 2, None))
        self.assertEqual(self.daemon.command("verify").returncode, 0)
        for wrong, pointer, code in (({"from": "2026-07-01"}, "/due", "field.missing"),
                                     ({"due": "2026-07-01"}, "/from", "field.missing"),
                                     ({"from": "2026-07-02", "due": "2026-07-01"}, "/due", "field.invalid"),
                                     ({"from": "soon", "due": "2026-07-01"}, "/from", "time.malformed"),
                                     ({**calibration, "uncertainty": "none"}, "/uncertainty", "uncertainty.unknown"),
                                     ({**calibration, "status": "lost"}, "/status", "field.invalid")):
            with self.subTest(wrong):
                problem = self.assert_problem(self.daemon.post(path, wrong), 422, "request.invalid")
                self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]], [(pointer, code)])
        self.assert_problem(self.daemon.post("/v1/gauges-in-use/none/calibrations", calibration), 404, "gauge.unknown")
        self.assert_problem(self.daemon.get("/v1/gauges-in-use/none/calibrations"), 404, "gauge.unknown")

    def test_a_changed_due_date_counts_from_its_change_on(self):
        """What is measured before the change is judged as the gauge was then, whenever it arrives."""
        for name, u in (("plain", 0.5), ("wide", 2)):
            self.put(f"/v1/uncertainties/{name}", {"contributions": [{"name": "all", "standard_uncertainty": u}]})

        def put(due, budget):
            self.assertIn(self.put("/v1/gauges-in-use/G-40", {"calibration_due": due, **budget}).status, (200, 201))

        def measure(**at):
            answer = self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "gauge": "G-40", "rule": "guard_band", **at})
            self.assertEqual(answer.status, 201, answer)
            self.assertEqual("calibration_due" in answer.json, "calibration_overdue" in answer.json)
            return answer.json["uncertainty_um"], answer.json.get("calibration_due")

        june = {"measured_at": "2026-06-01T08:00:00Z"}
        put("2026-01-01", {"uncertainty": "plain"})
        self.assertEqual((measure(**june), measure()), ((0.5, "2026-01-01"),) * 2)
        put("2199-07-01", {"uncertainty": "wide"})
        self.assertEqual((measure(**june), measure()), ((0.5, "2026-01-01"), (2, None)))
        put("2020-03-01", {})
        self.assertEqual(self.daemon.get("/v1/gauges-in-use/G-40").json, {"calibration_due": "2020-03-01"})
        self.assertEqual(measure(uncertainty_um=1), (1, "2020-03-01"))
        self.daemon.request("DELETE", "/v1/gauges-in-use/G-40")
        put("2199-08-01", {"uncertainty": "wide"})
        self.assertEqual((measure(**june), measure()), ((0.5, "2026-01-01"), (2, None)))
        self.daemon.stop()
        self.daemon.start()
        self.assertEqual((measure(**june), measure()), ((0.5, "2026-01-01"), (2, None)))
        # A calibration counts from its own beginning on, and is how a wrong date is mended.
        answer = self.daemon.post("/v1/gauges-in-use/G-40/calibrations", {"from": "2026-05-01", "due": "2199-12-31"})
        self.assertEqual(answer.status, 201, answer)
        april = {"measured_at": "2026-04-30T08:00:00Z"}
        self.assertEqual((measure(**june), measure(**april), measure()), ((2, None), (0.5, "2026-01-01"), (2, None)))
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_a_deleted_gauge_counts_for_what_it_measured(self):
        self.put("/v1/uncertainties/own", {"contributions": [{"name": "all", "standard_uncertainty": 0.5}]})
        self.put("/v1/gauges-in-use/G-60", {"calibration_due": "2199-01-01"})  # one that stays
        self.put("/v1/gauges-in-use/G-61", {"calibration_due": "2026-01-01", "uncertainty": "own"})
        self.daemon.post("/v1/gauges-in-use/G-61/calibrations", {"from": "2026-05-01", "due": "2026-06-01"})

        def measure(**at):
            answer = self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "gauge": "G-61", **at}).json
            return answer.get("calibration_due"), [each["code"] for each in answer.get("warnings", [])]

        april, may, july = ({"measured_at": f"2026-0{month}-09T08:00:00Z", "rule": "guard_band"} for month in (4, 5, 7))
        at = [measure(**april), measure(**may), measure(**july)]
        self.assertEqual(at, [("2026-01-01", ["gauge.overdue"]), (None, []), ("2026-06-01", ["gauge.overdue"])])
        self.daemon.request("DELETE", "/v1/gauges-in-use/G-61")
        for _ in range(2):
            self.assertEqual([measure(**april), measure(**may), measure(**july)], at)
            self.assertEqual(measure(), (None, ["gauge.unknown"]))
            self.daemon.stop()
            self.daemon.start()

    def test_a_record_says_that_its_gauge_was_blocked(self):
        self.put("/v1/gauges-in-use/G-50", {"calibration_due": "2026-12-31"})
        path = "/v1/gauges-in-use/G-50/calibrations"
        self.daemon.post(path, {"from": "2026-03-01", "status": "blocked"})
        given = {"designation": "25 H7", "measured_mm": "25.01", "gauge": "G-50", "measured_at": "2026-04-01T08:00:00Z"}
        record = self.daemon.measure(given).json
        self.assertEqual([each["code"] for each in record.pop("warnings")], ["gauge.blocked"])
        self.assertTrue(record["gauge_blocked"])
        # Neither its calibration later nor a correction changes that; another time of measuring does.
        self.daemon.post(path, {"from": "2026-03-01", "due": "2027-03-01"})
        self.assertEqual(self.daemon.get(f"/v1/measurements/{record['id']}").json, record)
        self.assertEqual(self.daemon.get("/v1/measurements?gauge=G-50").json["measurements"], [record])
        lines = self.daemon.get("/v1/measurements?gauge=G-50", Accept="text/csv").text.splitlines()
        self.assertEqual(dict(zip(lines[0].split(","), lines[1].split(",")))["gauge_blocked"], "true")
        for more, blocked, codes in (({}, True, ["gauge.blocked"]), ({"measured_at": "2026-02-01T08:00:00Z"}, None, [])):
            record = self.daemon.post(f"/v1/measurements/{record['id']}/corrections",
                                      {"measured_mm": "25.011", "reason": "misread", **more}).json
            self.assertEqual((record.get("gauge_blocked"), [each["code"] for each in record.get("warnings", [])]), (blocked, codes))
        self.assertNotIn("gauge_blocked", self.daemon.measure(given).json)
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_a_plan_may_leave_the_uncertainty_to_the_gauge(self):
        self.put("/v1/uncertainties/plan", self.BUDGET)
        plan = {"characteristics": [{"name": "bore", "designation": "25 H7", "gauge": "G-20", "rule": "guard_band"}]}
        problem = self.assert_problem(self.put("/v1/plans/P-1", plan), 422, "request.invalid")
        self.assertEqual(problem["errors"][0]["pointer"], "/characteristics/0/uncertainty_um")
        self.put("/v1/gauges-in-use/G-20", {"uncertainty": "plan", "calibration_due": "2027-03-31"})
        self.assertEqual(self.put("/v1/plans/P-1", plan).status, 201)
