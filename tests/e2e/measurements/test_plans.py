"""Plans: what is measured at a part number, in order."""

import json

from support.daemon import DaemonTest

BORE = {"name": "bore-A", "designation": "25 H7", "gauge": "G-07", "subgroup_size": 5, "frequency": "each hour",
        "picture": "plans/bore.png", "reaction": "Stop and tell the setter"}
SLOT = {"name": "slot", "nominal_mm": 8, "feature": "hole", "upper_um": 36, "lower_um": 0}
JOURNAL = {"name": "journal", "nominal_mm": "30", "tolerance_class": "k6", "rule": "guard_band", "uncertainty_um": 0.5}


class Plans(DaemonTest):
    def put(self, number, *characteristics, **others):
        return self.daemon.request("PUT", f"/v1/plans/{number}", {"characteristics": list(characteristics), **others})

    def test_a_plan_is_stored_replaced_listed_and_deleted(self):
        self.assertEqual(self.put("4711-A", BORE, SLOT, JOURNAL, name="Housing", part_pattern="SN-####", part="4711-A").status, 201)
        plan = self.daemon.request("GET", "/v1/plans/4711-A").json
        self.assertEqual(plan, {"part": "4711-A", "name": "Housing", "part_pattern": "SN-####", "characteristics": [BORE, SLOT, JOURNAL]})
        self.assertEqual(self.put("4711-A", SLOT).status, 200)
        self.assertEqual(self.daemon.request("GET", "/v1/plans/4711-A").json, {"part": "4711-A", "characteristics": [SLOT]})
        self.assertEqual(self.put("A%2F1", BORE).status, 201)
        self.assertEqual(self.daemon.request("GET", "/v1/plans/A/1").json["part"], "A/1")
        listed = self.daemon.request("GET", "/v1/plans").json["plans"]
        self.assertEqual([(each["part"], each["characteristics"]) for each in listed], [("4711-A", 1), ("A/1", 1)])
        self.assertEqual(self.daemon.request("DELETE", "/v1/plans/A%2F1").status, 204)
        for method in ("GET", "DELETE"):
            self.assert_problem(self.daemon.request(method, "/v1/plans/A%2F1"), 404, "plan.unknown")
        self.daemon.request("DELETE", "/v1/plans/4711-A")

    def test_the_tag_of_the_packed_form_guards_a_change_too(self):
        many = [{**BORE, "name": f"bore-{i}"} for i in range(40)]
        plain = self.put("big", *many).headers["etag"]
        packed = self.daemon.get("/v1/plans/big", Accept_Encoding="gzip").headers["etag"]
        self.assertNotEqual(packed, plain)
        change = lambda tag: self.daemon.request("PUT", "/v1/plans/big", {"characteristics": many[:1]}, {"If-Match": tag})
        self.assertEqual(change(packed.replace(packed[1:9], "0" * 8)).status, 412)
        self.assertEqual(change(packed).status, 200)
        self.daemon.request("DELETE", "/v1/plans/big")

    def test_a_part_has_the_worst_verdict_of_its_plan(self):
        self.put("9-B", BORE, SLOT)
        measure = lambda **fields: self.daemon.measure({"part_id": "P/1", **fields}).json["id"]
        part = lambda query="": self.daemon.get("/v1/parts/P%2F1" + query).json
        self.assert_problem(self.daemon.get("/v1/parts/P/1"), 404, "measurement.unknown")
        bad = measure(characteristic="bore-A", designation="25 H7", measured_mm="24.99")
        seen = part("?plan=9-B")
        self.assertEqual((seen["part_id"], seen["plan"], seen["verdict"], seen["missing"]), ("P/1", "9-B", "rework", ["slot"]))
        self.assertEqual(seen["open_reactions"], [
            {"characteristic": "bore-A", "measurement_id": bad, "reaction": BORE["reaction"]}])
        self.daemon.post(f"/v1/measurements/{bad}/notes", {"cause": "Insert worn"})
        self.assertEqual(part()["open_reactions"], [], "the only plan with that characteristic is meant")
        good = measure(characteristic="bore-A", designation="25 H7", measured_mm="25.01")
        self.assertEqual((part()["verdict"], part()["missing"]), (None, ["slot"]))
        slot = measure(characteristic="slot", nominal_mm=8, feature="hole", upper_um=36, lower_um=0, measured_mm="8.01")
        self.assertEqual((part()["verdict"], part()["missing"]), ("good", []))
        self.assertEqual([(c["characteristic"], c["measurement_id"], c["verdict"], c["measured_mm"])
                          for c in part()["characteristics"]], [("bore-A", good, "good", 25.01), ("slot", slot, "good", 8.01)])
        measure(characteristic="bore-A", designation="25 H7", measured_mm="25.05", measured_at="2000-01-01T10:00:00Z")
        self.assertEqual((part()["verdict"], part()["characteristics"][0]["measurement_id"]), ("good", good), "what was measured before comes late")
        self.daemon.post(f"/v1/measurements/{slot}/corrections", {"measured_mm": "8.05", "reason": "misread"})
        self.assertEqual(part()["verdict"], "reject")
        self.put("9-B", BORE, SLOT, {**BORE, "name": "pin", "frequency": "every 5th part"}, {**BORE, "name": "seat", "frequency": ""})
        self.assertEqual(part("?plan=9-B")["missing"], ["seat"])  # nobody knows whether the pin is due at this part
        self.put("9-C", BORE, SLOT)
        self.assertNotIn("plan", part(), "two plans fit")
        self.assert_problem(self.daemon.get("/v1/parts/P/1?plan=none"), 400, "query.invalid")
        for name in ("9-B", "9-C"):
            self.daemon.request("DELETE", f"/v1/plans/{name}")

    def test_a_value_of_a_part_says_what_its_go_gauge_found(self):
        for name, said in (("seat", {}), ("pin", {"go_gauge": "passes"})):
            self.daemon.measure({"part_id": "P-3", "characteristic": name, "designation": "25 H7(E)", "measured_mm": "25.01", **said})
        self.daemon.measure({"part_id": "P-3", "characteristic": "free", "designation": "25 H7", "measured_mm": "25.01"})
        self.assertEqual([(one["characteristic"], one.get("envelope_result")) for one in self.daemon.get("/v1/parts/P-3").json["characteristics"]],
                         [("seat", "not_verified"), ("pin", "verified"), ("free", None)])

    def test_an_inside_corner_is_one_in_plans_verdicts_and_files(self):
        corner = {"name": "groove", "designation": "R5 ISO 2768-m", "inside_corner": True}
        self.assertEqual(self.put("9-E", corner).status, 201)
        self.assertIs(self.daemon.get("/v1/plans/9-E").json["characteristics"][0]["inside_corner"], True)
        self.assert_problem(self.put("9-F", {**corner, "designation": "25 H7"}), 422, "request.invalid")
        self.daemon.request("DELETE", "/v1/plans/9-E")
        verdict = lambda query: self.daemon.get(f"/v1/verdicts/{query}")
        for size, outside, inside in (("9", "reject", "rework"), ("1", "rework", "reject")):
            given = f"R5%20ISO%202768-m?measured_mm={size}"
            self.assertEqual([verdict(f"{given}&inside_corner={said}").json["verdict"] for said in ("false", "true")], [outside, inside])
            self.assertEqual(verdict(given).json["verdict"], outside)
        self.assert_problem(verdict("25H7?measured_mm=25&inside_corner=true"), 400, "query.invalid")
        record = self.daemon.measure({"designation": "R5 ISO 2768-m", "measured_mm": 9, "inside_corner": True, "part_id": "P-4", "order": "WO-R"}).json
        for form in ("dfq", "qif"):
            self.assertIn("inside_corner", self.daemon.get(f"/v1/measurements?order=WO-R&format={form}").body.decode(), form)
        self.assertEqual(record["verdict"], "rework")

    def test_a_value_waits_for_a_cause_of_its_catalogue(self):
        self.daemon.request("PUT", "/v1/catalogues/bores", {"causes": ["Insert worn"], "measures": []})
        self.put("9-D", {"name": "seat", "designation": "25 H7", "catalogue": "bores"})
        bad = self.daemon.measure({"part_id": "P-2", "characteristic": "seat", "designation": "25 H7", "measured_mm": "25.05"}).json["id"]
        open_reactions = lambda: self.daemon.get("/v1/parts/P-2?plan=9-D").json["open_reactions"]
        self.assertEqual(open_reactions(), [{"characteristic": "seat", "measurement_id": bad}])
        self.daemon.post(f"/v1/measurements/{bad}/notes", {"text": "looked at"})
        self.assertEqual(len(open_reactions()), 1, "a text is no cause")
        self.daemon.post(f"/v1/measurements/{bad}/notes", {"cause": "Insert worn"})
        self.assertEqual(open_reactions(), [])
        for path in ("plans/9-D", "catalogues/bores"):
            self.daemon.request("DELETE", f"/v1/{path}")

    def test_every_bad_field_is_named(self):
        cases = [
            ([{**BORE, "designation": "25 H19"}], "/characteristics/0/designation", "class.unknown"),
            ([BORE, {**SLOT, "name": "bore-A"}], "/characteristics/1/name", "field.conflict"),
            ([{"name": "x"}], "/characteristics/0/nominal_mm", "field.missing"),
            ([{"designation": "25 H7"}], "/characteristics/0/name", "field.missing"),
            ([{**BORE, "nominal_mm": 25}], "/characteristics/0/nominal_mm", "field.conflict"),
            ([{**BORE, "rule": "guard_band"}], "/characteristics/0/uncertainty_um", "field.missing"),
            ([{**SLOT, "lower_um": 50}], "/characteristics/0/upper_um", "limits.invalid"),
            ([{**BORE, "measured_mm": 25}], "/characteristics/0/measured_mm", "field.unknown"),
            ([{**BORE, "subgroup_size": 0}], "/characteristics/0/subgroup_size", "field.invalid"),
            ([{**BORE, "name": "x" * 201}], "/characteristics/0/name", "field.too_long"),
            ([{**BORE, "name": "a\0b"}], "/characteristics/0/name", "field.invalid"),
            ([{**BORE, "gauge": 7}], "/characteristics/0/gauge", "field.type"),
            ([7], "/characteristics/0", "field.type"),
            ([], "/characteristics", "field.invalid"),
        ]
        for characteristics, pointer, code in cases:
            answer = self.put("bad", *characteristics)
            self.assert_problem(answer, 422, "request.invalid")
            self.assertIn((pointer, code), [(each["pointer"], each["code"]) for each in answer.json["errors"]], json.dumps(answer.json))
        self.assert_problem(self.put("bad", BORE, part="another"), 422, "request.invalid")
        answer = self.put("bad", BORE, part_pattern="#" * 201)
        self.assertEqual([(each["pointer"], each["code"]) for each in answer.json["errors"]], [("/part_pattern", "field.too_long")])
        self.assert_problem(self.put("x" * 201, BORE), 400, "path.malformed")
        self.assert_problem(self.daemon.request("GET", "/v1/plans/bad"), 404, "plan.unknown")
