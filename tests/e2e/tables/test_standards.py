"""Limits and verdicts by the designations of other standards: threads and general tolerances; the tables of all."""

import sqlite3
from urllib.parse import quote

from support.daemon import DaemonTest


class Standards(DaemonTest):
    def limits(self, path):
        answer = self.daemon.get(path)
        self.assertEqual(answer.status, 200, answer)
        return answer.json

    def test_a_thread_has_the_limits_of_its_pitch_diameter(self):
        # ISO 965-2 prints 9.026 to 9.206 for M10-6H.
        nut = self.limits("/v1/limits/M10-6H")
        self.assertEqual((nut["nominal_mm"], nut["lower_limit_mm"], nut["upper_limit_mm"]), (9.026, 9.026, 9.206))
        self.assertEqual((nut["designation"], nut["feature"], nut["basis"]), ("M10-6H", "hole", "standard"))
        self.assertRegex(nut["table_revision"], r"^ISO 965-1:2013-[0-9a-f]{8}$")
        bolt = self.limits("/v1/limits/M10%C3%971,25-6g")
        self.assertEqual((bolt["designation"], bolt["lower_limit_mm"], bolt["upper_limit_mm"]),
                         ("M10x1.25-6g", 9.042, 9.16))
        for path, status, code in (("M10-6X", 404, "class.unknown"), ("M10-6", 400, "designation.malformed"),
                                   ("M15-6H", 422, "class.undefined_for_size")):
            answer = self.daemon.get(f"/v1/limits/{path}")
            self.assertEqual((answer.status, answer.json["code"]), (status, code), path)

    def test_a_general_tolerance_is_of_a_distance_unless_said(self):
        by_designation = self.limits("/v1/limits/25%20ISO%202768-m")
        self.assertEqual(by_designation, self.limits("/v1/limits?nominal_mm=25&tolerance_class=ISO%202768-m"))
        self.assertEqual((by_designation["lower_limit_mm"], by_designation["upper_limit_mm"]), (24.8, 25.2))
        self.assertEqual(by_designation["size_range_mm"], {"over": 6, "up_to": 30})
        path = "/v1/verdicts/25%20ISO%202768-m?measured_mm=25.3"
        self.assertEqual(self.limits(path)["verdict"], "reject")
        self.assertEqual(self.limits(path + "&feature=shaft")["verdict"], "rework")
        self.assertEqual(self.limits(path + "&feature=hole")["verdict"], "reject")
        self.assertEqual(self.daemon.get("/v1/verdicts/25H7?measured_mm=25&feature=shaft").status, 400)

    def test_stored_verdicts_name_their_edition_and_are_verified(self):
        rows = [{"designation": "M10-6H", "measured_mm": 9.1}, {"designation": "M10x1.5-6H", "measured_mm": 9.3},
                {"designation": "25 ISO 2768-m", "measured_mm": 25.3, "feature": "hole"},
                {"nominal_mm": 25, "tolerance_class": "ISO 2768-m", "measured_mm": 25.1},
                {"designation": "R5 ISO 2768-m", "measured_mm": 5.2}, {"designation": "25 H7", "measured_mm": 25.01}]
        answer = self.daemon.post("/v1/measurements", rows, {"Prefer": "return=representation"})
        self.assertEqual(answer.status, 201, answer)
        records = answer.json["measurements"]
        self.assertEqual([r["verdict"] for r in records], ["good", "reject", "reject", "good", "good", "good"])
        self.assertEqual([r["designation"] for r in records],
                         ["M10-6H", "M10-6H", "25 ISO 2768-m", "25 ISO 2768-m", "R5 ISO 2768-m", "25 H7"])
        for record in records:
            self.assertEqual(self.daemon.get(f"/v1/measurements/{record['id']}").json, record)
        self.assertEqual({r["table_revision"].rsplit("-", 1)[0] for r in records[:5]},
                         {"ISO 965-1:2013", "ISO 2768-1:1989"})
        listed = self.limits("/v1/measurements?designation=M10x1.5-6H")["measurements"]
        self.assertEqual([r["id"] for r in listed], [r["id"] for r in records[:2]])
        listed = self.limits("/v1/measurements?designation=25%20ISO%202768-m")["measurements"]
        self.assertEqual(len(listed), 2)
        correction = self.daemon.post(f"/v1/measurements/{records[0]['id']}/corrections",
                                      {"measured_mm": 9.21, "reason": "read wrong"})
        self.assertEqual((correction.status, correction.json["designation"], correction.json["verdict"]),
                         (201, "M10-6H", "reject"))
        self.daemon.stop()
        self.daemon.start()  # the editions keep their numbers
        self.assertEqual(self.daemon.get(f"/v1/measurements/{records[4]['id']}").json, records[4])
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_bad_rows_say_which_field(self):
        for row, pointer, code in (
                ({"designation": "M10-6k", "measured_mm": 9}, "/designation", "class.unknown"),
                ({"designation": "M10-6H", "measured_mm": 9, "feature": "hole"}, "/feature", "field.conflict"),
                ({"designation": "25 ISO 2768-mK", "measured_mm": 25}, "/designation", "class.unknown"),
                ({"nominal_mm": 5000, "tolerance_class": "ISO 2768-m", "measured_mm": 25}, "/tolerance_class",
                 "class.undefined_for_size"),
                ({"designation": "25 H7", "measured_mm": 25, "probability": 0.9}, "/probability", "rule.invalid"),
                ({"designation": "25 H7", "measured_mm": 25, "rule": "guard_band", "uncertainty_um": 1,
                  "probability": 0.9}, "/probability", "rule.invalid")):
            with self.subTest(row):
                answer = self.daemon.measure(row)
                self.assertEqual(answer.status, 422, answer)
                self.assertEqual([(e["pointer"], e["code"]) for e in answer.json["errors"]], [(pointer, code)])

    def test_words_of_other_standards_may_be_in_small_letters(self):
        for text, written in (("25 iso 2768-M", "25 ISO 2768-m"), ("r2 Iso 2768-m", "R2 ISO 2768-m"), ("m10X1.25-6g", "M10x1.25-6g")):
            self.assertEqual(self.limits(f"/v1/limits/{quote(text)}"), self.limits(f"/v1/limits/{quote(written)}"))
            self.assertEqual(self.daemon.measure({"designation": text, "measured_mm": 2}).json["designation"], written)

    def test_a_bearing_fits_a_shaft_or_a_housing(self):
        # Bore 25 in P6: 0 to -8 um; k6: +2 to +15 um. Outer ring 52 in normal: 0 to -13 um; H7: 0 to +30 um.
        bore = self.limits("/v1/fits/25%20ISO%20492-P6/k6")
        self.assertEqual((bore["designation"], bore["type"], bore["max_clearance_um"], bore["min_clearance_um"]),
                         ("25 ISO 492-P6/k6", "interference", -2, -23))
        hole = bore["hole"]
        self.assertEqual((hole["designation"], hole["feature"], hole["basis"], hole["size_range_mm"]),
                         ("25 ISO 492-P6", "hole", "standard", {"over": 18, "up_to": 30}))
        self.assertRegex(hole["table_revision"], r"^ISO 492:2014-[0-9a-f]{8}$")
        self.assertEqual((hole["upper_limit_mm"], hole["lower_limit_mm"]), (25, 24.992))
        ring = self.limits("/v1/fits/52H7/ISO%20492-normal")
        self.assertEqual((ring["designation"], ring["type"], ring["max_clearance_um"], ring["min_clearance_um"]),
                         ("52 H7/ISO 492-normal", "clearance", 43, 0))
        self.assertEqual(ring["shaft"]["feature"], "shaft")
        # Bore 25 in P4: 0 to -5 um; k5: +2 to +11 um. Outer ring 400 in P4: 0 to -15 um; H6: 0 to +36 um.
        spindle = self.limits("/v1/fits/25%20ISO%20492-P4/k5")
        self.assertEqual((spindle["max_clearance_um"], spindle["min_clearance_um"]), (-2, -16))
        self.assertEqual(self.limits("/v1/fits/400H6/ISO%20492-P4")["max_clearance_um"], 51)
        self.assertEqual(ring, self.limits("/v1/fits/52%20H7%20%2F%20ISO%20492-normal"))
        self.assertEqual(ring, self.limits("/v1/fits/52%20H7%20/%20ISO%20492-normal"))
        self.assertEqual(bore["designation"], self.limits("/v1/fits/25%20ISO%20492-P6%20/%20k6")["designation"])
        self.assertEqual(bore["designation"], self.limits("/v1/fits/25%20ISO%20492-P6%2Fk6")["designation"])
        self.assertEqual(bore, self.limits("/v1/fits/25%20iso%20492-p6/k6"))
        self.assertEqual(ring, self.limits("/v1/fits/52H7/iso%20492-Normal"))
        for path, status, code in (("25%20ISO%20492-P6/ISO%20492-P6", 400, "fit.malformed"),
                                   ("25%20ISO%20492-P6/K6", 400, "fit.malformed"),
                                   ("25x%20ISO%20492-P6/k6", 400, "designation.malformed"),
                                   ("25%20ISO%20492-P3/k6", 404, "class.unknown"),
                                   ("251%20ISO%20492-P4/k6", 422, "class.undefined_for_size"),
                                   ("401H7/ISO%20492-P4", 422, "class.undefined_for_size"),
                                   ("700%20ISO%20492-P6/k6", 422, "class.undefined_for_size"),
                                   ("2H7/ISO%20492-P6", 422, "class.undefined_for_size"),
                                   ("25%20ISO%20492-P6/k99", 404, "class.unknown")):
            self.assert_problem(self.daemon.get(f"/v1/fits/{path}"), status, code)
        for path, written in (("25%20ISO%20492-P6/K6", "'25 ISO 492-P6/K6'"), ("52%20g6/ISO%20492-P6", "'52 g6/ISO 492-P6'")):
            detail = self.daemon.get(f"/v1/fits/{path}").json["detail"]
            self.assertIn(f"unknown fit of a bearing {written}", detail)

    def test_tables_answer_by_size(self):
        names = {s["name"]: s for s in self.limits("/v1/standards")["standards"]}
        self.assertEqual(set(names), {"iso2768-1", "iso965-1", "din6885-1", "iso492"})
        self.assertTrue(all(len(s["sources"]) >= 2 for s in names.values()))
        keyway, = self.limits("/v1/standards/din6885-1?size_mm=25")["rows"]
        self.assertEqual(keyway["limits"]["hub_depth"], {"nominal_mm": 3.3, "upper_um": 200, "lower_um": 0})
        # 8 P9 is -15/-51 by ISO 286-2.
        self.assertEqual(keyway["limits"]["width_P9"],
                         {"designation": "8 P9", "nominal_mm": 8, "upper_um": -15, "lower_um": -51})
        bearing, = self.limits("/v1/standards/iso492?size_mm=25&table=bores")["rows"]
        self.assertEqual(bearing["limits"]["P6"], {"upper_um": 0, "lower_um": -8})
        linear, edges, angles = self.limits("/v1/standards/iso2768-1?size_mm=25")["rows"]
        self.assertEqual(linear["limits"]["m"], {"upper_um": 200, "lower_um": -200})
        self.assertEqual(edges["limits"]["c"], {"upper_um": 2000, "lower_um": -2000})
        self.assertEqual(angles["limits"]["v"], {"upper_arcmin": 120, "lower_arcmin": -120})
        self.assertNotIn("up_to_mm", edges)
        threads = self.limits("/v1/standards/iso965-1?size_mm=10&table=pitch_diameters")["rows"]
        coarse = next(r for r in threads if r["pitch_mm"] == 1.5)
        self.assertEqual(coarse["limits"]["internal_6"], {"tolerance_um": 180})
        answer = self.daemon.get("/v1/standards/iso1")
        self.assertEqual((answer.status, answer.json["code"]), (404, "resource.not_found"))
        self.assertEqual(self.daemon.get("/v1/standards/iso492?table=x").status, 400)
        # What is left out is said where one would look for it.
        large = self.limits("/v1/standards/iso492?size_mm=700")
        self.assertEqual((large["rows"], large["left_out"][:21]), ([], "diameters over 630 mm"))
        self.assertIn("positions a to d", self.limits("/v1/standards/iso965-1?size_mm=10")["left_out"])
        refused = self.daemon.get("/v1/limits/M10-6a")
        self.assert_problem(refused, 404, "class.unknown")
        self.assertIn("is not available", refused.json["detail"])
        first = self.daemon.get("/v1/standards/iso492")
        again = self.daemon.get("/v1/standards/iso492", If_None_Match=first.headers["etag"])
        self.assertEqual(again.status, 304)


class AlteredLimits(DaemonTest):
    def test_verify_judges_by_the_edition(self):
        self.daemon.measure({"designation": "M10-6H", "measured_mm": 9.1})
        self.daemon.stop()
        database = sqlite3.connect(self.daemon.database)
        database.execute("DROP TRIGGER measurements_are_not_updated")
        database.execute("UPDATE measurements SET upper_deviation_nm = 190000")
        database.commit()
        database.close()
        found = self.daemon.command("verify")
        self.assertEqual(found.returncode, 1)
        self.assertIn("has limits that M10-6H does not give by ISO 965-1:2013", found.stdout + found.stderr)
