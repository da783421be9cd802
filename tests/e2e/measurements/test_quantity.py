"""What was measured: quantities, values without limits, sizes and their envelope, and how a cycle took them."""

import unittest
import xml.etree.ElementTree as ElementTree

from support.daemon import DaemonTest
from support.releases import PROGRAM, SETUP

FREE = PROGRAM.replace("Q275=+25.021", "Q275=+0").replace("Q276=+25 ", "Q276=+0 ").replace(
    "Q279=+0.1", "Q279=+0").replace("Q280=+0.1", "Q280=+0")


class Quantity(DaemonTest):
    def record(self, **fields):
        answer = self.daemon.measure(fields)
        self.assertEqual(answer.status, 201, answer)
        self.assertEqual(self.daemon.get(answer.headers["location"]).json, answer.json)
        return answer.json

    def run_program(self, program, **machine):
        self.daemon.request("PUT", "/v1/files/nc_prog/hole.h", program, {"Content-Type": "application/octet-stream"})
        run = self.daemon.post("/v1/runs", {"program": "nc_prog/hole.h", "setup": {**SETUP, **machine}}).json
        self.assertEqual(run["status"], "completed", run)
        stored = self.daemon.get(f"/v1/measurements?run_id={run['id']}").json["measurements"]
        return run, stored

    def test_the_operator_of_a_size_is_counted_in_characters(self):
        longest = "ØØØØØØØ⌀"
        record = self.record(designation="25 H7", measured_mm=25.01, size_operator=longest)
        self.assertEqual(record["size_operator"], longest)
        text = f"designation,measured_mm,size_operator\n25 H7,25.01,{longest}\n25 H7,25.01,{longest}X\n"
        problem = self.assert_problem(self.daemon.measure(text.encode(), {"Content-Type": "text/csv"}), 422, "request.invalid")
        self.assertEqual([(each["pointer"], each["code"]) for each in problem["errors"]],
                         [("/1/size_operator", "field.too_long")])
        self.assertIn("8 characters", problem["detail"])

    def test_a_value_without_limits_is_unjudged_everywhere(self):
        record = self.record(measured_mm=-50.08, quantity="position", part_id="U", characteristic="free")
        self.assertEqual({name: record[name] for name in record if name not in ("id", "measured_at", "received_at")},
                         {"basis": "none", "measured_mm": -50.08, "quantity": "position", "source": "gauge",
                          "part_id": "U", "characteristic": "free"})
        sized = self.record(measured_mm=25.013, nominal_mm=25, quantity="diameter", part_id="U", characteristic="free")
        self.assertEqual((sized["basis"], sized["deviation_um"], sized["size_operator"]), ("none", 13, "LP"))
        judged = self.record(designation="25 H7", measured_mm=25.01, part_id="U", characteristic="bore")
        found = self.daemon.get("/v1/measurements?part_id=U&verdict=unjudged").json["measurements"]
        self.assertEqual(found, [record, sized])
        self.assertEqual(self.daemon.get("/v1/measurements?part_id=U&verdict=good").json["measurements"], [judged])
        groups = {group["characteristic"]: group
                  for group in self.daemon.get("/v1/measurements/summary?part_id=U").json["groups"]}
        self.assertEqual(groups["free"]["verdicts"],
                         {"good": 0, "rework": 0, "reject": 0, "indeterminate": 0, "unjudged": 2})
        self.assertNotIn("unjudged", groups["bore"]["verdicts"])
        accepted = self.daemon.measure([{"measured_mm": 1, "quantity": "chamfer"}] * 2).json
        self.assertEqual(accepted["verdicts"]["unjudged"], 2)
        for figure in ("capability", "chart?kind=i_mr&"):
            path = f"/v1/measurements/{figure}{'' if '?' in figure else '?'}characteristic=free"
            self.assert_problem(self.daemon.get(path), 422, "limits.none")
        for form in ("csv", "ndjson", "xlsx"):
            self.assertEqual(self.daemon.get(f"/v1/measurements?part_id=U&format={form}").status, 200)
        rows = self.daemon.get("/v1/measurements?part_id=U&format=csv").text.splitlines()
        row = dict(zip(rows[0].split(","), rows[1].split(",")))
        self.assertEqual({row[name] for name in ("verdict", "rule", "uncertainty_um", "upper_limit_mm", "nominal_mm",
                                                 "excess_um", "feature")}, {""})
        dfq = self.daemon.get("/v1/measurements?part_id=U&format=dfq").body.decode("cp1252")
        self.assertNotIn("K2110/1", dfq)
        self.assertIn("K2120/1 0", dfq)
        self.assertIn("quantity=position", dfq)
        paper = self.daemon.get("/v1/certificates?part_id=U", Accept="application/json").json
        self.assertEqual(paper["verdicts"]["unjudged"], 2)
        self.assertEqual(self.daemon.get("/v1/certificates?part_id=U", Accept="application/pdf").status, 200)
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_a_correction_may_give_limits_and_another_value(self):
        record = self.record(measured_mm=25.5, nominal_mm=25, quantity="diameter")
        path = f"/v1/measurements/{record['id']}/corrections"
        again = self.daemon.post(path, {"measured_mm": 25.01, "reason": "misread"}).json
        self.assertEqual((again["basis"], again["measured_mm"], "verdict" in again), ("none", 25.01, False))
        path = f"/v1/measurements/{again['id']}/corrections"
        judged = self.daemon.post(path, {"designation": "25 H7", "measured_mm": 25.01, "reason": "judged"}).json
        self.assertEqual((judged["basis"], judged["verdict"], judged["quantity"]), ("iso286", "good", "diameter"))

    def test_files_name_the_quantity(self):
        limits = {"upper_um": 50, "lower_um": -50, "part_id": "Q"}
        self.record(quantity="position", nominal_mm=-50, measured_mm=-50.08, **limits)
        self.record(quantity="distance", nominal_mm=30, measured_mm=30.01, **limits)
        self.record(designation="R5 ISO 2768-m", measured_mm=9, part_id="Q")
        self.record(designation="8 N9", quantity="width", measured_mm=7.99, part_id="Q")
        self.record(quantity="diameter", measured_mm=7.99, part_id="Q")
        space = "{http://qifstandards.org/xsd/qif3}"

        def document_of(query):
            return ElementTree.fromstring(self.daemon.get(f"/v1/measurements?{query}&format=qif").body)

        def standard(query):
            return document_of(query).find(f".//{space}StandardsDefinitions//{space}Designator").text

        # One standard holds for all definitions of a file: ISO 286-1 only if each has limits of it.
        self.record(designation="8 N9", measured_mm=7.99, part_id="ISO 286")
        self.assertEqual([standard(query) for query in ("part_id=ISO%20286", "part_id=Q", "part_id=Q&designation=8%20N9",
                                                        "part_id=Q&verdict=unjudged")], ["286-1", "8015", "286-1", "8015"])
        document = document_of("part_id=Q")
        measured = document.find(f".//{space}CharacteristicMeasurements")
        self.assertEqual([each.tag.removeprefix(space).removesuffix("CharacteristicMeasurement") for each in measured],
                         ["LinearCoordinate", "Length", "Radius", "Width", "Diameter"])
        self.assertEqual([each.find(f".//{space}CharacteristicStatusEnum").text for each in measured],
                         ["FAIL", "PASS", "FAIL", "PASS", "UNDEFINED"])
        definitions = document.find(f".//{space}CharacteristicDefinitions")
        said = {each.tag.removeprefix(space): {a.get("name"): a.get("value")
                                               for a in each.iter(f"{space}AttributeStr")} for each in definitions}
        self.assertNotIn("feature", said["LinearCoordinateCharacteristicDefinition"])
        self.assertEqual(len(definitions.findall(f".//{space}NonTolerance")), 1)

    def test_an_envelope_is_verified_by_its_gauge(self):
        for designation in ("25H7(E)", "25 H7 \u24ba"):
            record = self.record(designation=designation, measured_mm=25.01)
            self.assertEqual((record["designation"], record["envelope"], record["envelope_result"], record["verdict"]),
                             ("25 H7", "required", "not_verified", "good"))
        failed = self.record(designation="25H7(E)", measured_mm=25.01, go_gauge="fails")
        self.assertEqual((failed["envelope_result"], failed["verdict"]), ("failed", "rework"))
        self.assertEqual(self.daemon.get("/v1/limits/25H7(E)").json["upper_limit_mm"], 25.021)
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_an_envelope_is_asked_for_by_its_designation(self):
        for path, members in (("25H7(E)", ("required", "not_verified")), ("25%20H7%20%E2%92%BA", ("required", "not_verified")),
                              ("25H7", (None, None))):
            verdict = self.daemon.get(f"/v1/verdicts/{path}?measured_mm=25.01").json
            self.assertEqual((verdict.get("envelope"), verdict.get("envelope_result")), members)
            self.assertNotIn("warnings", verdict)
        kept = {"characteristic": "enveloped", "measured_mm": 25.01}
        ids = [self.record(designation=designation, **kept)["id"] for designation in ("25H7", "25H7(E)", "26H7(E)")]
        for designation, expected in (("25H7(E)", ids[1:2]), ("25H7", ids[:2])):
            query = f"characteristic=enveloped&designation={designation}"
            listed = self.daemon.get(f"/v1/measurements?{query}").json["measurements"]
            self.assertEqual([record["id"] for record in listed], expected)
            for by in ("characteristic", "tool"):
                groups = self.daemon.get(f"/v1/measurements/summary?group_by={by}&{query}").json["groups"]
                self.assertEqual([group["count"] for group in groups], [len(expected)])

    def test_a_cycle_tells_how_it_measured(self):
        run, stored = self.run_program(PROGRAM)
        self.assertEqual([(each["quantity"], each["verdict"]) for each in stored],
                         [("diameter", "good"), ("position", "good"), ("position", "good")])
        bore = stored[0]
        self.assertEqual((bore["points"], bore["start_angle_deg"], bore["diameter_factor"], bore["size_operator"]),
                         (4, 0, 1, "GG"))
        self.assertLess(bore["form_um"], 0.01)
        self.assertNotIn("points", stored[1])
        self.assertNotIn("feature", stored[1])
        three, stored = self.run_program(PROGRAM.replace("Q423=+4", "Q423=+3").replace("Q247=+90", "Q247=+120")
                                         .replace("Q325=+0", "Q325=+22.5"))
        self.assertEqual((stored[0]["points"], stored[0]["form_um"], stored[0]["start_angle_deg"]), (3, None, 22.5))

    def test_the_uncertainty_of_a_touch_decides_on_the_diameter(self):
        probe = {"machine": {"probes": [{"number": 1, "uncertainty_um": 2}]}}
        # 25.01 lies 11 um below the limit: twice 2 um is within it, twice 6 um is not.
        _, stored = self.run_program(PROGRAM, **probe)
        bore, centre = stored[:2]
        self.assertEqual((bore["rule"], bore["uncertainty_um"], bore["coverage_factor"], bore["verdict"]),
                         ("guard_band", 2, 2, "good"))
        self.assertEqual((centre["rule"], "uncertainty_um" in centre), ("simple", False))
        probe["machine"]["probes"][0]["uncertainty_um"] = 6
        run, stored = self.run_program(PROGRAM, **probe)
        self.assertEqual((stored[0]["uncertainty_um"], stored[0]["verdict"]), (6, "indeterminate"))
        # Of the run too, whose control compares with the limits alone.
        cycle = run["measurements"][0]
        self.assertEqual([run["verdict"], cycle["verdict"], *((size["verdict"], size.get("uncertainty_um")) for size in cycle["sizes"])],
                         ["indeterminate", "indeterminate", ("indeterminate", 6), ("good", None), ("good", None)])
        self.assertEqual([run["parameters"][name] for name in ("Q180", "Q181", "Q182")], [1, 0, 0])
        self.assertEqual(self.daemon.get("/v1/runs/" + run["id"]).json["verdict"], "indeterminate")
        # Three points on 120 degrees: 2 / sqrt 3 times 2 um, rounded up to the nanometre.
        probe["machine"]["probes"][0]["uncertainty_um"] = 2
        _, stored = self.run_program(PROGRAM.replace("Q423=+4", "Q423=+3").replace("Q247=+90", "Q247=+120"), **probe)
        self.assertEqual((stored[0]["diameter_factor"], stored[0]["uncertainty_um"]), (1.154701, 2.31))
        # On 10 degrees of the circle it is more than a metre.
        probe["machine"]["probes"][0]["uncertainty_um"] = 10000
        _, stored = self.run_program(PROGRAM.replace("Q423=+4", "Q423=+3").replace("Q247=+90", "Q247=+5"), **probe)
        self.assertGreater(stored[0]["uncertainty_um"], 1e6)
        self.assertAlmostEqual(stored[0]["uncertainty_um"] / stored[0]["diameter_factor"] / 1e4, 1, 6)
        _, free = self.run_program(FREE, **probe)
        self.assertNotIn("uncertainty_um", free[0])
        self.assertEqual(self.daemon.command("verify").returncode, 0)
        refused = self.daemon.post("/v1/runs", {"program": "nc_prog/hole.h", "setup": {
            **SETUP, "machine": {"probes": [{"number": 1, "uncertainty_um": 0}]}}})
        self.assertIn("/setup/machine/probes/0/uncertainty_um", [each["pointer"] for each in refused.json["errors"]])

    def test_a_minimum_of_0_is_told(self):
        said = lambda program: [message["text"] for message in self.run_program(program)[0]["messages"]]
        self.assertEqual(said(PROGRAM.replace("Q276=+25", "Q276=+0")), ['the minimum of "Diameter" is 0: no size is too small'])
        self.assertEqual([said(program) for program in (PROGRAM, FREE)], [[], []])

    def test_a_cycle_without_a_tolerance_has_no_verdict(self):
        run, stored = self.run_program(FREE)
        self.assertIsNone(run["verdict"])
        self.assertEqual([(each["basis"], each["measured_mm"], "verdict" in each, "uncertainty_um" in each)
                          for each in stored], [("none", 25.01, False, False)])
        self.assertEqual(stored[0]["feature"], "hole")
        problem = self.daemon.get(f"/v1/measurements/capability?run_id={run['id']}")
        self.assert_problem(problem, 422, "limits.none")

    def test_a_cycle_with_limits_of_the_centre_alone_keeps_its_diameter(self):
        program = FREE.replace("Q279=+0", "Q279=+0.05").replace("Q280=+0", "Q280=+0.05")
        run, stored = self.run_program(program)
        self.assertEqual(run["verdict"], "good")
        self.assertEqual([(each["quantity"], each["basis"], each.get("verdict"), "upper_limit_mm" in each) for each in stored],
                         [("diameter", "none", None, False), ("position", "explicit", "good", True),
                          ("position", "explicit", "good", True)])
        self.assertEqual((stored[0]["measured_mm"], stored[0]["feature"], stored[0]["points"]), (25.01, "hole", 4))
        of_run = f"run_id={run['id']}"
        groups = {each["characteristic"]: (each["count"], each["verdicts"].get("unjudged"), each["verdicts"]["good"])
                  for each in self.daemon.get(f"/v1/measurements/summary?{of_run}").json["groups"]}
        self.assertEqual(groups, {"Diameter": (1, 1, 0), "Centre, main axis": (1, None, 1),
                                  "Centre, secondary axis": (1, None, 1)})
        for name, code in (("Diameter", "limits.none"), ("Centre, main axis", "statistics.too_few")):
            path = f"/v1/measurements/capability?{of_run}&characteristic={name.replace(' ', '%20')}"
            self.assert_problem(self.daemon.get(path), 422, code)
        self.assertEqual(self.daemon.get(f"/v1/measurements?{of_run}&verdict=unjudged").json["measurements"], stored[:1])
        moved = {"workpiece": {"features": [SETUP["workpiece"]["features"][0],
                                            {**SETUP["workpiece"]["features"][1], "center_mm": [0.08, 0]}]}}
        run, stored = self.run_program(program, **moved)
        self.assertEqual((run["verdict"], [each.get("verdict") for each in stored]), ("reject", [None, "reject", "good"]))


if __name__ == "__main__":
    unittest.main()
