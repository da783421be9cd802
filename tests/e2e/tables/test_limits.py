"""Limits, fits and verdicts over HTTP."""

import socket

from support.daemon import DaemonTest

# Deviations that tools often get wrong: upper and lower, in µm.
TRAPS = {
    "50K7": (7, -18), "50P7": (-17, -42), "25N9": (0, -52), "25K8": (10, -23), "300M6": (-9, -41),
    "6G7": (16, 4), "30js7": (10.5, -10.5), "200D10": (355, 170), "200E9": (215, 100), "2F8": (20, 6),
    "100G9": (99, 12), "400E7": (182, 125), "160f6": (-43, -68), "180n6": (52, 27), "3k6": (6, 0),
    "50H15": (1000, 0),
}


class Limits(DaemonTest):
    def limits(self, path):
        answer = self.daemon.get(path)
        self.assertEqual(answer.status, 200, answer)
        return answer.json

    def test_every_spelling_of_a_designation_is_the_same(self):
        plain = self.daemon.get("/v1/limits/25H7")
        for path in ("/v1/limits/25%20H7", "/v1/limits/%C3%9825H7", "/v1/limits/%E2%8C%8025H7",
                     "/v1/limits/25.0H7", "/v1/limits/25,000H7", "/v1/limits/25%20H7%20", "/v1/limits/%20%2025H7",
                     "/v1/limits?nominal_mm=25&tolerance_class=H7%20",
                     "/v1/limits?nominal_mm=25&tolerance_class=H7"):
            self.assertEqual(self.daemon.get(path).body, plain.body, path)

    def test_a_tag_names_the_release_that_computed(self):
        version = self.daemon.get("/readyz").json["version"]
        for path in ("limits/25H7", "limits/25%20ISO%202768-m", "verdicts/25H7?measured_mm=25", "fits/25H7/g6", "gauges/25H7",
                     "fits?nominal_mm=25&min_clearance_um=5&max_clearance_um=45", "tables", "tables/hole?classes=H7",
                     "tables/hole?format=csv", "tables/shaft.tab", "standards", "standards/iso492"):
            tag = self.daemon.get("/v1/" + path).headers["etag"]
            self.assertTrue(tag.endswith(f'.{version}"'), f"{path}: {tag}")
            self.assertEqual(self.daemon.get("/v1/" + path, If_None_Match=tag).status, 304)

    def test_answers_from_the_tables_leave_in_one_write(self):
        for path in ("limits/25H7", "limits?nominal_mm=25&tolerance_class=H7", "verdicts/25H7?measured_mm=25", "fits/25H7/g6",
                     "fits/25H7%2Fg6", "fits?nominal_mm=25&min_clearance_um=44&max_clearance_um=45", "gauges/25H7", "tables",
                     "tables/hole?classes=H7", "standards"):
            self.daemon.get("/v1/" + path)
            with socket.create_connection(("127.0.0.1", self.daemon.port)) as client:
                client.sendall(f"GET /v1/{path} HTTP/1.1\r\nHost: a\r\n\r\n".encode() * 8)
                self.assertEqual(client.recv(1 << 20).count(b"HTTP/1.1 200"), 8, path)

    def test_the_limits_object(self):
        limits = self.limits("/v1/limits/25H7")
        revision = limits.pop("table_revision")
        self.assertEqual(limits, {
            "designation": "25 H7", "nominal_mm": 25, "tolerance_class": "H7", "feature": "hole",
            "upper_deviation_um": 21, "lower_deviation_um": 0, "upper_limit_mm": 25.021, "lower_limit_mm": 25,
            "tolerance_um": 21, "size_range_mm": {"over": 18, "up_to": 30}, "basis": "iso286"})
        self.assertEqual(revision, self.daemon.get("/v1/tables").json["revision"])

    def test_the_classes_that_others_get_wrong(self):
        for designation, expected in TRAPS.items():
            limits = self.limits(f"/v1/limits/{designation}")
            self.assertEqual((limits["upper_deviation_um"], limits["lower_deviation_um"]), expected, designation)

    def test_odd_sizes_work(self):
        for size in ("3", "3.5", "10.5", "0.8", "0.003", "3150"):
            self.limits(f"/v1/limits/{size}js5")

    def test_what_is_refused(self):
        for path, status, code in [
                ("7H", 400, "designation.malformed"), ("25", 400, "designation.malformed"),
                ("25..5H7", 400, "designation.malformed"), ("25H", 400, "designation.malformed"),
                ("25H7%00", 400, "path.malformed"),
                ("25H19", 404, "class.unknown"), ("25I7", 404, "class.unknown"), ("25h7x", 404, "class.unknown"),
                ("25NEU", 404, "class.unknown"), ("25ZZZ", 404, "class.unknown"),
                ("25js", 400, "designation.malformed"),
                ("10t6", 422, "class.undefined_for_size"), ("0.8N9", 422, "class.undefined_for_size"),
                ("25K9", 422, "class.undefined_for_size"), ("0.001d9", 422, "class.undefined_for_size"),
                ("0H7", 422, "size.out_of_range"), ("-1H7", 422, "size.out_of_range"),
                ("3150.000001H7", 422, "size.out_of_range"),
                ("25.0000001H7", 422, "length.too_fine")]:
            with self.subTest(path):
                self.assert_problem(self.daemon.get(f"/v1/limits/{path}"), status, code)
        for path in ("limits?nominal_mm=25&tolerance_class=NEU", "gauges/25NEU", "fits/25NEU/g6",
                     "verdicts/25NEU?measured_mm=25"):
            self.assert_problem(self.daemon.get(f"/v1/{path}"), 404, "class.unknown")
        for size in ("-1", "3150.000001", "10000000000"):
            for query in ("limits?tolerance_class=H7", "fits?min_clearance_um=5&max_clearance_um=45"):
                self.assert_problem(self.daemon.get(f"/v1/{query}&nominal_mm={size}"), 422, "size.out_of_range")
        self.assert_problem(self.daemon.get("/v1/limits?nominal_mm=1e1&tolerance_class=H7"), 400, "length.malformed")
        self.assert_problem(self.daemon.get("/v1/limits?nominal_mm=25"), 400, "query.missing")
        self.assert_problem(self.daemon.get("/v1/limits?nominal_mm=25&tolerance_class=H7&x=1"), 400, "query.unknown")

    def test_an_undefined_class_names_the_nearest(self):
        self.assertIn("s6", self.daemon.get("/v1/limits/10t6").json["detail"])

    def test_an_exponent_in_a_path_is_a_class(self):
        self.assertEqual(self.limits("/v1/limits/25e8")["tolerance_class"], "e8")

    def test_fits(self):
        fit = self.limits("/v1/fits/25H7/g6")
        self.assertEqual((fit["designation"], fit["type"]), ("25 H7/g6", "clearance"))
        self.assertEqual((fit["max_clearance_um"], fit["min_clearance_um"]), (41, 7))
        self.assertEqual(fit["hole"], self.limits("/v1/limits/25H7"))
        self.assertEqual(fit["shaft"], self.limits("/v1/limits/25g6"))
        self.assertEqual(self.limits("/v1/fits/25H7/h6")["type"], "clearance")
        self.assertEqual(self.limits("/v1/fits/25H7/k6")["type"], "transition")
        self.assertEqual(self.limits("/v1/fits/25H7/s6")["type"], "interference")
        for path in ("25H7/H8", "25g6/H7", "25g6/h6"):
            self.assert_problem(self.daemon.get(f"/v1/fits/{path}"), 400, "fit.malformed")

    def test_verdicts_at_the_limits(self):
        for designation, measured, verdict, excess in [
                ("25H7", "25.021", "good", 0), ("25H7", "25", "good", 0), ("25H7", "25.021001", "reject", 0.001),
                ("25H7", "24.999999", "rework", -0.001), ("25g6", "24.993", "good", 0),
                ("25g6", "24.993001", "rework", 0.001), ("25g6", "24.979999", "reject", -0.001)]:
            answer = self.limits(f"/v1/verdicts/{designation}?measured_mm={measured}")
            self.assertEqual((answer["verdict"], answer["excess_um"]), (verdict, excess), measured)

    def test_the_guard_band(self):
        for measured, verdict in [("25.0194", "good"), ("25.019401", "indeterminate"), ("25.0226", "indeterminate"),
                                  ("25.022601", "reject"), ("25.001599", "indeterminate"), ("24.998399", "rework")]:
            answer = self.limits(f"/v1/verdicts/25H7?measured_mm={measured}&rule=guard_band&uncertainty_um=0.8")
            self.assertEqual(answer["verdict"], verdict, measured)
        self.assert_problem(self.daemon.get("/v1/verdicts/25H7?measured_mm=25&rule=guard_band"), 422, "rule.invalid")

    def test_an_older_revision_answers_as_it_did(self):
        before = self.daemon.get("/v1/tables").json["revision"]
        paths = ("/v1/limits/25H7?", "/v1/limits?nominal_mm=25&tolerance_class=H7&", "/v1/fits/25H7/g6?", "/v1/fits/25H7%2Fg6?",
                 "/v1/fits?nominal_mm=25&min_clearance_um=5&max_clearance_um=45&", "/v1/verdicts/25H7?measured_mm=25.013&")
        now = {path: self.daemon.get(path.rstrip("?&")) for path in paths}
        rows = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]}
        self.daemon.request("PUT", "/v1/tables/hole/classes/H7", rows)
        try:
            for path in paths:
                older = self.daemon.get(f"{path}revision={before}")
                self.assertEqual((older.status, older.body), (200, now[path].body), path)
                self.assertEqual(older.headers["etag"], now[path].headers["etag"])
                self.assertNotEqual(self.daemon.get(path.rstrip("?&")).body, older.body, path)
                self.assert_problem(self.daemon.get(f"{path}revision=none"), 400, "revision.unknown")
        finally:
            self.daemon.request("DELETE", "/v1/tables/hole/classes/H7")

    def test_a_parameter_that_changes_nothing_is_refused_or_warned_of(self):
        def warned(query, designation="25H7"):
            answer = self.limits(f"/v1/verdicts/{designation}?measured_mm=25.013{query}")
            return [(w["code"], w["detail"].split()[0]) for w in answer.get("warnings", [])]
        for query in ("&uncertainty_um=1", "&uncertainty_um=1&rule=simple"):
            self.assert_problem(self.daemon.get(f"/v1/verdicts/25H7?measured_mm=25{query}"), 400, "query.unused")
        self.assertEqual(warned(""), [])
        for name, query in (("temperature_c", "&temperature_c=30"), ("scale_temperature_c", "&scale_temperature_c=30"),
                            ("coverage_factor", "&coverage_factor=3"), ("degrees_of_freedom", "&degrees_of_freedom=9"),
                            ("temperature_uncertainty_c", "&temperature_uncertainty_c=1"),
                            ("scale_expansion_uncertainty_um_per_m_k", "&scale_expansion_uncertainty_um_per_m_k=1"),
                            ("probability", "&probability=0.9"), ("feature", "&feature=hole"),
                            ("probability", "&probability=0.9&rule=guard_band&uncertainty_um=1"),
                            ("coverage_factor", "&coverage_factor=3&rule=conformance&uncertainty_um=1")):
            self.assertEqual(warned(query), [("query.unused", name)])
        revision = self.daemon.get("/v1/tables").json["revision"]
        self.assertEqual(warned(f"&revision={revision}", "25%20ISO%202768-m"), [("query.unused", "revision")])
        self.assertEqual(warned(f"&revision={revision}&temperature_c=21&part_material=steel&rule=guard_band"
                                "&uncertainty_um=1&coverage_factor=3&degrees_of_freedom=9"), [])

    def test_a_rule_without_an_acceptance_zone_says_so(self):
        answer = self.limits("/v1/verdicts/25H7?measured_mm=25.01&rule=guard_band&uncertainty_um=6")
        self.assertEqual((answer["verdict"], [w["code"] for w in answer["warnings"]]), ("indeterminate", ["rule.no_acceptance"]))
        self.assert_problem(self.daemon.get("/v1/verdicts/25H7?measured_mm=25.01&rule=conformance&uncertainty_um=60"),
                            422, "rule.no_acceptance")

    def test_a_negative_uncertainty_is_refused_whatever_it_is_added_to(self):
        warm = "&temperature_c=25&part_material=steel&temperature_uncertainty_c=0.1"
        for rule in ("", "&rule=simple", "&rule=guard_band", "&rule=conformance"):
            for correction in ("", warm):
                query = f"measured_mm=25.01&uncertainty_um=-5{rule}{correction}"
                self.assert_problem(self.daemon.get(f"/v1/verdicts/25H7?{query}"), 422, "length.out_of_range")

    def test_answers_from_the_tables_are_revalidated(self):
        for path in ("/v1/limits/25H7", "/v1/fits/25H7/g6", "/v1/tables", "/v1/tables/hole", "/v1/tables/hole.tab"):
            tag = self.daemon.get(path).headers["etag"]
            again = self.daemon.get(path, If_None_Match=tag)
            self.assertEqual((again.status, again.body), (304, b""), path)
