"""Capability and charts of stored values: certified figures, which values they are of, and what is refused."""

import json
import math
import statistics

from support.daemon import ROOT, DaemonTest

RINGS = [line.split() for line in (ROOT / "tests/reference/piston_rings.txt").read_text().splitlines()]
REFERENCES = ROOT / "server/service/qualification/references"
DRAWING = {"nominal_mm": 74, "feature": "hole", "upper_um": 50, "lower_um": -50}


def nist(name):
    """The certified figures and the values of a data set of NIST."""
    words = [line.split() for line in (REFERENCES / "expected.txt").read_text().splitlines()]
    certified = {row[0].rsplit(".", 1)[1]: float(row[1]) for row in words if row[0].startswith(f"nist.{name}.")}
    return certified, (REFERENCES / f"nist/{name}.txt").read_text().split()


class Stored(DaemonTest):
    def store(self, characteristic, values, limits=None, **others):
        rows = [{**(limits or DRAWING), "measured_mm": value, "characteristic": characteristic, **others}
                for value in values]
        answer = self.daemon.measure(rows)
        self.assertEqual(answer.status, 201, answer)
        return answer.json

    def store_rings(self, characteristic, groups=RINGS):
        for i, values in enumerate(groups):
            self.store(characteristic, values, subgroup=str(i + 1))

    def find(self, name, query):
        answer = self.daemon.get(f"/v1/measurements/{name}?{query}")
        self.assertEqual(answer.status, 200, answer)
        return answer.json

    def test_the_certified_figures_of_nist(self):
        for name, nominal in (("Mavro", 2), ("Michelso", 300), ("NumAcc1", 10_000_002), ("NumAcc2", 1.2),
                              ("NumAcc3", 1_000_000.2), ("NumAcc4", 10_000_000.2)):
            with self.subTest(name):
                certified, values = nist(name)
                self.store(name, values, {"nominal_mm": nominal, "feature": "hole", "upper_um": 900,
                                          "lower_um": -900})
                found = self.find("capability", f"characteristic={name}")
                self.assertEqual(found["selection"]["count"], len(values))
                for figure, of in (("mean", "mean"), ("s", "standard_deviation_overall")):
                    error = abs(found[of] - certified[figure]) / certified[figure]
                    self.assertLess(error, 1e-14, (found[of], certified[figure]))

    def test_the_piston_rings(self):
        self.store_rings("ring")
        self.store("other", ["74.1"])
        found = self.find("chart", "characteristic=ring&kind=xbar_r&rules=1,2,3,4&phase1_to=25")
        self.assertEqual([chart["name"] for chart in found["charts"]], ["xbar", "r"])
        self.assertAlmostEqual(found["average_run_length"], 91.75, places=2)
        self.assertIn({"chart": "xbar", "rule": 1, "index": 36, "subgroup": "37"}, found["violations"])
        self.assertEqual(found["selection"]["subgroups"], len(RINGS))
        sent = self.daemon.post("/v1/statistics/chart", {"kind": "xbar_r", "subgroups": RINGS, "rules": [1, 2, 3, 4],
                                                         "phase1": {"from": 0, "to": 25}}).json
        self.assertEqual(found["charts"], sent["charts"])

        self.store_rings("first", RINGS[:25])
        found = self.find("capability", "characteristic=first")
        self.assertAlmostEqual(found["cp"]["value"], 1.703, places=3)
        self.assertAlmostEqual(found["cpk"]["value"], 1.663, places=3)
        self.assertEqual((found["selection"]["lower_limit_mm"], found["selection"]["upper_limit_mm"]), (73.95, 74.05))
        # Off the target by d: cpm = pp / sqrt(1 + (d / s)^2).
        off = self.find("capability", "characteristic=first&target_mm=74.01&confidence=0.9")
        away = (off["mean"] - 74.01) / off["standard_deviation_overall"]
        self.assertAlmostEqual(off["cpm"]["value"], off["pp"]["value"] / math.hypot(1, away), places=12)
        self.assertGreater(off["cp"]["lower"], found["cp"]["lower"])

    def test_points_are_the_decimals_that_were_measured(self):
        """Rounded once: through more digits than a double has, these would end in …40999999999998."""
        values = ["25.009741", "25.008521", "25.011398", "25.009741"]
        self.store("exact", values, {"nominal_mm": 25, "feature": "hole", "upper_um": 21, "lower_um": 0})
        text = self.daemon.get("/v1/measurements/chart?characteristic=exact").text
        self.assertIn('"points":[' + ",".join(values) + "]", text)
        self.assertIn('"points":[0.00122,0.002877,0.001657]', text)

    def test_values_one_by_one(self):
        values = ["74", "74.001", "74", "74.001", "74", "74.001", "74", "74.03", "74", "74.001"]
        answer = self.store("jump", values)
        found = self.find("chart", "characteristic=jump&rules=1")
        self.assertEqual(found["kind"], "i_mr")
        self.assertEqual(found["charts"][0]["points"], [float(value) for value in values])
        first, origin = answer["first_id"][1:].split("-")
        def named(index):
            return f"m{int(first) + index}-{origin}"
        # The jump is the eighth value; its moving ranges are those to it and from it.
        self.assertEqual([(v["chart"], v["index"], v["id"]) for v in found["violations"]],
                         [("i", 7, named(7)), ("mr", 6, named(7)), ("mr", 7, named(8))])

    def test_subgroups_may_be_interleaved(self):
        for value, subgroup in (("74.001", "a"), ("74.005", "b"), ("74.003", "a"), ("74.009", "b")):
            self.store("mixed", [value], subgroup=subgroup)
        found = self.find("chart", "characteristic=mixed")
        self.assertEqual(found["kind"], "xbar_r")
        self.assertEqual([chart["points"] for chart in found["charts"]], [[74.002, 74.007], [0.002, 0.004]])
        single = self.find("chart", "characteristic=mixed&kind=i_mr")
        self.assertEqual(single["charts"][0]["points"], [74.001, 74.005, 74.003, 74.009])
        self.assertEqual(self.find("capability", "characteristic=mixed&subgroups=ignore")["selection"]["subgroups"], 0)
        ewma = self.find("chart", "characteristic=mixed&kind=ewma&lambda=1")
        self.assertEqual(ewma["charts"][0]["points"], [74.002, 74.007])

    def test_the_newest_alone(self):
        self.store("worn", ["74.049", "74.001", "74.002", "74.004"])
        self.store("another", ["74.03"])
        found = self.find("capability", "characteristic=worn&last=3")
        sent = self.daemon.post("/v1/statistics/capability", {"values": ["74.001", "74.002", "74.004"], "lower": "73.95", "upper": "74.05"}).json
        self.assertEqual(found["selection"]["count"], 3)
        self.assertAlmostEqual(found["cpk"]["value"], sent["cpk"]["value"], places=12)
        self.assertEqual(self.find("chart", "characteristic=worn&last=100")["charts"],
                         self.find("chart", "characteristic=worn")["charts"])
        self.assert_problem(self.daemon.get("/v1/measurements/chart?characteristic=none&last=3"), 422, "statistics.too_few")
        self.assert_problem(self.daemon.get("/v1/measurements/chart?last=0"), 400, "query.invalid")

    def test_the_clearance_of_measured_parts(self):
        bores = ["25.011", "25.014", "25.012", "25.016", "25.013", "25.011", "25.015"]
        pins = ["24.992", "24.994", "24.991", "24.993", "24.995", "24.992"]
        self.store("fit bore", bores, {"designation": "25H7"})
        self.store("fit pin", pins, {"designation": "25g6"})
        path = "/v1/fits/25H7/g6?hole_characteristic=fit%20bore&shaft_characteristic=fit%20pin"
        fit = self.daemon.get(path).json
        stored = fit["statistical"]["stored"]
        hole, shaft = (statistics.NormalDist.from_samples([float(value) for value in values]) for values in (bores, pins))
        self.assertAlmostEqual(stored["probability_of_interference"], (hole - shaft).cdf(0), places=12)
        self.assertAlmostEqual(stored["mean_clearance_um"], (hole.mean - shaft.mean) * 1000, places=9)
        self.assertAlmostEqual(stored["standard_deviation_um"], (hole - shaft).stdev * 1000, places=9)
        self.assertEqual((stored["hole"]["selection"]["count"], stored["shaft"]["selection"]["count"]), (7, 6))
        self.assertTrue(stored["stable"])
        del fit["statistical"]["stored"]
        self.assertEqual(fit, self.daemon.get("/v1/fits/25H7/g6").json)
        self.assertEqual(self.daemon.get(path.replace("/g6", "%2Fg6")).json["statistical"]["stored"], stored)
        # What is measured from now on counts, and a process that ran away is said to have.
        self.store("fit pin", ["24.980"], {"designation": "25g6"})
        moved = self.daemon.get(path).json["statistical"]["stored"]
        self.assertEqual((moved["shaft"]["selection"]["count"], moved["stable"], moved["hole"]["stable"]), (7, False, True))
        for query, status, code, word in [
                ("?hole_characteristic=fit%20bore", 400, "query.invalid", "shaft_characteristic"),
                ("?%68ole_characteristic=fit%20bore", 400, "query.invalid", "shaft_characteristic"),
                ("?hole_characteristic=fit%20pin&shaft_characteristic=fit%20pin", 422, "limits.mixed", "hole"),
                ("?hole_characteristic=none&shaft_characteristic=fit%20pin", 422, "statistics.too_few", "hole"),
                ("?characteristic=bore", 400, "query.unknown", "characteristic")]:
            with self.subTest(query):
                answer = self.daemon.get("/v1/fits/25H7/g6" + query)
                self.assert_problem(answer, status, code)
                self.assertIn(word, answer.json["detail"])

    def test_a_correction_stands_where_the_value_stood(self):
        answer = self.store("placed", ["74.001", "75", "74.002", "76"])
        first, origin = answer["first_id"][1:].split("-")
        def correct(id, value):
            made = self.daemon.post(f"/v1/measurements/{id}/corrections", {"measured_mm": value, "reason": "misread"})
            self.assertEqual(made.status, 201, made)
            return made.json["id"]
        again = correct(f"m{int(first) + 3}-{origin}", "74.9")
        one = correct(f"m{int(first) + 1}-{origin}", "74.004")
        self.store("placed", ["74.006"])
        last = correct(again, "74.005")  # a correction's correction, stored behind all
        chart = self.find("chart", "characteristic=placed&rules=1")
        self.assertEqual(chart["charts"][0]["points"], [74.001, 74.004, 74.002, 74.005, 74.006])
        self.assertEqual(chart["selection"]["count"], 5)
        self.assertEqual(self.find("chart", "characteristic=placed&last=3")["charts"][0]["points"], [74.004, 74.005, 74.006])
        # All values with those they replace: each behind it.
        self.assertEqual(self.find("chart", "characteristic=placed&history=all")["charts"][0]["points"],
                         [74.001, 75, 74.004, 74.002, 76, 74.9, 74.005, 74.006])
        jumped = correct(one, "74.5")
        found = self.find("chart", "characteristic=placed&rules=1&phase1_from=2&phase1_to=5")
        self.assertEqual([v["id"] for v in found["violations"] if v["chart"] == "i"], [jumped])
        self.assertNotEqual(jumped, last)

    def test_a_corrected_subgroup_keeps_its_place(self):
        ids = []
        for subgroup, values in (("a", ["74.001", "74.003"]), ("b", ["74.005", "74.007"]), ("c", ["74.009", "74.011"])):
            ids.append(self.store("sub", values, subgroup=subgroup)["first_id"])
        number, origin = ids[0][1:].split("-")
        for i, value in enumerate(("74.021", "74.023")):
            self.daemon.post(f"/v1/measurements/m{int(number) + i}-{origin}/corrections",
                             {"measured_mm": value, "reason": "misread"})
        found = self.find("chart", "characteristic=sub&kind=xbar_r")
        self.assertEqual(found["charts"][0]["points"], [74.022, 74.006, 74.01])

    def test_a_correction_counts_in_place_of_what_it_corrects(self):
        answer = self.store("mended", ["74.001", "74.002", "75"])
        body = {"measured_mm": "74.003", "reason": "misread"}
        self.assertEqual(self.daemon.post(f"/v1/measurements/{answer['last_id']}/corrections", body).status, 201)
        self.assertAlmostEqual(self.find("capability", "characteristic=mended")["mean"], 74.002, places=12)

    def test_what_is_refused(self):
        self.store("two sizes", ["74.001", "74.002"])
        self.store("two sizes", ["74.001"], {**DRAWING, "upper_um": 51})
        self.store("one", ["74.001"])
        self.store("equal", ["74.001", "74.001"])
        for size, subgroup in ((2, "a"), (3, "b")):
            self.store("uneven", ["74.001"] * size, subgroup=subgroup)
        self.store("partly", ["74.001", "74.002"], subgroup="a")
        self.store("partly", ["74.001"])
        for subgroup in "ab":
            self.store("ones", ["74.001"], subgroup=subgroup)
        for query, code in [
                ("capability?characteristic=two%20sizes", "limits.mixed"),
                ("chart?characteristic=two%20sizes", "limits.mixed"),
                ("capability?characteristic=none", "statistics.too_few"),
                ("chart?characteristic=none", "statistics.too_few"),
                ("capability?characteristic=one", "statistics.too_few"),
                ("chart?characteristic=one", "statistics.too_few"),
                ("capability?characteristic=equal", "statistics.zero_spread"),
                ("chart?characteristic=uneven", "statistics.unbalanced"),
                ("capability?characteristic=partly", "statistics.unbalanced"),
                ("chart?characteristic=ones", "statistics.too_few"),
                ("chart?characteristic=equal&kind=xbar_r", "statistics.too_few")]:
            with self.subTest(query):
                self.assert_problem(self.daemon.get("/v1/measurements/" + query), 422, code)
        for query, code in [("chart?rules=5", "query.invalid"), ("chart?rules=1,", "query.invalid"),
                            ("chart?rules=12", "query.invalid"), ("chart?kind=p", "query.invalid"),
                            ("chart?lambda=0", "query.invalid"), ("chart?phase1_from=1", "query.invalid"),
                            ("capability?confidence=1", "query.invalid"), ("capability?limit=1", "query.unknown"),
                            ("capability?target_mm=x", "length.malformed")]:
            with self.subTest(query):
                self.assert_problem(self.daemon.get("/v1/measurements/" + query), 400, code)
        problem = self.daemon.get("/v1/measurements/capability?characteristic=equal&target_mm=80")
        self.assertEqual((problem.status, problem.json["code"], problem.json["where"]), (422, "limits.invalid", "target_mm"))
        problem = self.daemon.get("/v1/measurements/chart?characteristic=equal&phase1_to=9")
        self.assertEqual(problem.status, 422, problem)

    def test_the_next_offset_of_a_machine_that_wears(self):
        scatter = (0.9, -1.1, 0.4, -0.2, 1.2, -0.7, -0.9, 0.3, 0.6, -0.5)
        worn = [f"{74 + (5 + 0.2 * i + scatter[i % 10]) / 1000:.4f}" for i in range(40)]
        self.store("worn", worn, machine="M1")
        found = self.find("compensation", "characteristic=worn&machine=M1")
        self.assertEqual((found["state"], found["values"]), ("propose", 40), found)
        self.assertAlmostEqual(found["offset_um"], -13, delta=1)
        low, high = found["interval_um"]
        self.assertTrue(low < found["offset_um"] < high, found)
        self.assertAlmostEqual(found["wear_um"], 0.2, delta=0.05)
        # The correction that was made stands in the record; the level is where it was meant to be.
        level = 74 + (13 + found["offset_um"]) / 1000
        self.store("worn", [f"{level:.4f}"], machine="M1", offset_um=f"{found['offset_um']:.3f}")
        after = self.find("compensation", "characteristic=worn&machine=M1")
        self.assertEqual(after["state"], "wait", after)
        self.assertGreaterEqual(after["next_in_parts"], 1)
        self.assertEqual(self.find("compensation", "characteristic=none")["state"], "wait")
        self.assertIsNone(self.find("compensation", "characteristic=none")["offset_um"])

    def about(self, level_um, count=30):
        scatter = (0.9, -1.1, 0.4, -0.2, 1.2, -0.7, -0.9, 0.3, 0.6, -0.5)
        return [f"{74 + (level_um + scatter[i % 10]) / 1000:.4f}" for i in range(count)]

    def test_a_new_tool_moves_the_level_at_once(self):
        for name, tools in (("tools", ({"tool": "T1"}, {"tool": "T2"})), ("untold", ({}, {}))):
            self.store(name, self.about(0), **tools[0])
            self.store(name, self.about(20, 1), **tools[1])
        found = self.find("compensation", "characteristic=tools")
        self.assertEqual(found["state"], "propose", found)
        self.assertAlmostEqual(found["offset_um"], -20, delta=2)
        self.assertEqual(self.find("compensation", "characteristic=tools&tool=T1")["values"], 30)
        found = self.find("compensation", "characteristic=untold")
        self.assertEqual((found["state"], found["next_in_parts"]), ("wait", 1), found)

    def test_values_of_a_gauge_that_is_overdue_or_blocked_propose_nothing(self):
        at = {"measured_at": "2026-11-20T08:00:00Z"}
        path = "/v1/gauges-in-use/G-77"
        self.assertEqual(self.daemon.request("PUT", path, {"calibration_due": "2027-01-01"}).status, 201)
        self.store("drifted", self.about(20), gauge="G-77", **at)
        self.assertEqual(self.find("compensation", "characteristic=drifted")["state"], "propose")
        # What is said of the gauge later counts, for all that it has measured since.
        self.assertEqual(self.daemon.post(f"{path}/calibrations", {"from": "2026-11-01", "status": "blocked"}).status, 201)
        found = self.find("compensation", "characteristic=drifted")
        self.assertEqual((found["state"], found["values"], found["offset_um"]), ("wait", 0, None), found)
        self.assertRegex(found["reason"], "overdue for calibration or blocked")
        self.assertEqual(self.daemon.post(f"{path}/calibrations", {"from": "2026-11-01", "due": "2026-11-10"}).status, 200)
        self.assertEqual(self.find("compensation", "characteristic=drifted")["state"], "wait")
        # The value is of no use, but the correction before it was made.
        self.store("drifted", self.about(5, 1), gauge="G-77", offset_um="-15", **at)
        self.store("drifted", self.about(5, 1))
        self.assertEqual(self.find("compensation", "characteristic=drifted")["values"], 1)
        # What was stored while its gauge was blocked is of no use when the block is lifted.
        self.assertEqual(self.daemon.post(f"{path}/calibrations", {"from": "2026-11-01", "status": "blocked"}).status, 200)
        self.store("blocked", self.about(20), gauge="G-77", **at)
        self.assertEqual(self.daemon.post(f"{path}/calibrations", {"from": "2026-11-01", "due": "2027-11-10"}).status, 200)
        self.assertEqual(self.find("compensation", "characteristic=blocked")["values"], 0)

    def test_a_correction_before_a_value_that_is_left_out_counts(self):
        self.assertEqual(self.daemon.request("PUT", "/v1/gauges-in-use/G-78", {"calibration_due": "2026-01-01"}).status, 201)
        self.store("carried", self.about(20))
        self.store("carried", self.about(9, 1), gauge="G-78", offset_um="-20", measured_at="2026-11-20T08:00:00Z")
        self.store("carried", self.about(0, 2))
        found = self.find("compensation", "characteristic=carried")
        self.assertEqual((found["state"], found["values"]), ("wait", 32), found)
        self.assertLess(abs(found["offset_um"]), 1)

    def leave_out(self, characteristic, **others):
        """Stores a value that does not belong to the process. @returns the filter that leaves it out"""
        self.store(characteristic, ["74.049"], **others)
        if others.get("confirmed"):
            return f"characteristic={characteristic}&confirmed=false"
        burr = self.daemon.get(f"/v1/measurements?characteristic={characteristic}&last=1").json["measurements"][0]["id"]
        note = self.daemon.post(f"/v1/measurements/{burr}/notes", {"cause": "burr", "measure": "set aside"})
        self.assertEqual(note.status, 201, note)
        return f"characteristic={characteristic}&set_aside=false"

    def test_the_offset_before_a_value_that_a_filter_leaves_out_was_made(self):
        for name, others in (("burr", {}), ("far", {"confirmed": True})):
            self.store(name, self.about(20), tool="T1")
            self.assertEqual(self.find("compensation", f"characteristic={name}")["state"], "propose")
            query = self.leave_out(name, offset_um="-20", tool="T1", **others)
            for used in (30, 32):
                found = self.find("compensation", query)
                self.assertEqual((found["state"], found["values"]), ("wait", used), found)
                self.assertLess(abs(found["offset_um"]), 1, found)
                self.store(name, self.about(0, 2), tool="T1")
            # The level of a new tool is unknown until a value of the tool counts.
            self.leave_out(name, tool="T2", **others)
            found = self.find("compensation", query)
            self.assertEqual((found["state"], found["offset_um"]), ("wait", None), found)

    def test_a_corrected_value_keeps_its_place_among_the_parts(self):
        self.store("mistyped", self.about(20))
        self.store("mistyped", self.about(0, 1), offset_um="-20")
        self.store("mistyped", self.about(0, 8))
        rows = self.daemon.get("/v1/measurements?characteristic=mistyped").json["measurements"]
        before = self.find("compensation", "characteristic=mistyped")
        self.assertEqual((before["state"], before["values"]), ("wait", 39), before)
        for row, measured in ((rows[3], "74.0199"), (rows[30], "74.0008"), (rows[30], "74.0007")):
            newest = self.daemon.get(f"/v1/measurements/{row['id']}").json.get("corrected_by", row["id"])
            corrected = self.daemon.post(f"/v1/measurements/{newest}/corrections",
                                         {"measured_mm": measured, "reason": "mistyped"})
            self.assertEqual(corrected.status, 201, corrected)
            found = self.find("compensation", "characteristic=mistyped")
            self.assertEqual((found["state"], found["reason"], found["values"]),
                             ("wait", before["reason"], 39), found)
            self.assertAlmostEqual(found["offset_um"], before["offset_um"], delta=0.2)

    def follow(self, query):
        connection = self.daemon.connect()
        self.addCleanup(connection.close)
        connection.request("GET", f"/v1/measurements/compensation?{query}", headers={"Accept": "text/event-stream"})
        return connection.getresponse()

    def told(self, events, characteristic):
        """The next event, as (type, data)."""
        while not (line := events.readline().decode()).startswith("event: "):
            self.assertNotEqual(line, "")
        fields = dict(events.readline().decode().rstrip().split(": ", 1) for _ in range(2))
        newest = self.daemon.get(f"/v1/measurements?characteristic={characteristic}&last=1").json["measurements"][0]["id"]
        self.assertEqual(fields["id"], newest)
        return line.split()[1], json.loads(fields["data"])

    def test_a_stream_tells_each_change_of_state(self):
        self.store("told", self.about(0), tool="T1")
        events = self.follow("characteristic=told")
        self.assertEqual(events.status, 200)

        def changed(state):
            name, found = self.told(events, "told")
            self.assertEqual((name, found["state"]), ("compensation.changed", state), found)
            return found["offset_um"]

        changed("wait")
        self.store("told", self.about(20, 3), tool="T1")
        offset = changed("propose")
        self.store("told", self.about(20 + offset, 1), tool="T1", offset_um=f"{offset:.3f}")
        changed("wait")
        self.store("told", self.about(-30, 1), tool="T2")
        self.assertAlmostEqual(changed("propose"), 30, delta=3)

    def test_a_stream_outlives_values_that_propose_nothing(self):
        self.store("torn", self.about(0))
        events = self.follow("characteristic=torn")
        self.assertEqual(self.told(events, "torn")[0], "compensation.changed")
        for _ in range(2):
            self.store("torn", ["74.0004"], {**DRAWING, "upper_um": 60})
            odd = self.daemon.get("/v1/measurements?characteristic=torn&last=1").json["measurements"][0]["id"]
            refused = self.daemon.get("/v1/measurements/compensation?characteristic=torn").json
            self.assertEqual(self.told(events, "torn"), ("compensation.failed", {
                "characteristic": "torn", "code": "limits.mixed", "detail": refused["detail"]}))
            self.store("torn", self.about(0, 1))  # it fails as before, which is not told again
            corrected = self.daemon.post(f"/v1/measurements/{odd}/corrections",
                                         {**DRAWING, "measured_mm": 74.0004, "reason": "of another drawing"})
            self.assertEqual(corrected.status, 201, corrected)
            name, found = self.told(events, "torn")
            self.assertEqual((name, found["state"]), ("compensation.changed", "wait"), found)

    def test_what_an_offset_cannot_be_proposed_for(self):
        one_sided = {"nominal_mm": 74, "feature": "hole", "upper_um": 50}
        self.store("one-sided", ["74.01"], one_sided)
        self.store("mixed", ["74.01"])
        self.store("mixed", ["74.01"], {**DRAWING, "upper_um": 60})
        self.store("bare", ["74.01"], {"quantity": "distance"})
        for query, status, code in [("characteristic=one-sided", 400, "query.invalid"),
                                    ("characteristic=bare", 422, "limits.none"),
                                    ("characteristic=bare&target_mm=74", 422, "limits.none"),
                                    ("characteristic=mixed", 422, "limits.mixed"),
                                    ("characteristic=mixed&cost=0", 400, "query.invalid"),
                                    ("characteristic=one-sided&target_mm=74.05", 400, "query.invalid"),
                                    ("characteristic=one-sided&target_mm=74.06", 400, "query.invalid")]:
            with self.subTest(query):
                for kind in ("application/json", "text/event-stream"):
                    answer = self.daemon.get("/v1/measurements/compensation?" + query, Accept=kind)
                    self.assert_problem(answer, status, code)
