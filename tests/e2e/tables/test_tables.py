"""The tables in their forms, a shop's own columns, and what happens when a cell is changed."""

import csv
import io
import sqlite3

from support.daemon import Daemon, DaemonTest

ROWS = [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3},
        {"over_mm": 30, "up_to_mm": 50.5, "upper_um": 17.25, "lower_um": -3}]


class Forms(DaemonTest):
    def test_the_index_names_all_classes(self):
        index = self.daemon.get("/v1/tables").json
        holes, shafts = index["tables"]
        self.assertEqual((holes["feature"], holes["size_ranges"], shafts["feature"]), ("hole", 41, "shaft"))
        self.assertIn("JS7", holes["classes"])
        self.assertIn("zc18", shafts["classes"])

    def test_json_and_csv_say_the_same(self):
        rows = self.daemon.get("/v1/tables/hole?classes=H7,JS7,T7").json["rows"]
        self.assertEqual(len(rows), 41)
        self.assertNotIn("T7", rows[0]["limits"])
        answer = self.daemon.get("/v1/tables/hole?classes=H7,JS7,T7", Accept="text/csv")
        self.assertIn("accept", answer.headers["vary"].lower())
        self.assertEqual(answer.body, self.daemon.get("/v1/tables/hole?classes=H7,JS7,T7&format=csv", Accept="text/html").body,
                         "format replaces Accept")
        for row, line in zip(rows, csv.DictReader(io.StringIO(answer.text)), strict=True):
            self.assertEqual(float(line["over_mm"]), row["over_mm"])
            for name in ("H7", "JS7", "T7"):
                if name in row["limits"]:
                    self.assertEqual(float(line[f"{name}_upper_um"]), row["limits"][name]["upper_um"])
                    self.assertEqual(float(line[f"{name}_lower_um"]), row["limits"][name]["lower_um"])
                else:
                    self.assertEqual(line[f"{name}_upper_um"], "")

    def test_the_control_s_form_has_two_rows_a_range(self):
        lines = self.daemon.get("/v1/tables/shaft.tab").text.splitlines()
        head = next(line for line in lines if line.startswith("NR"))
        names = head.split()
        self.assertEqual(names[:3], ["NR", "BEREICH", "d9"])
        starts = [head.index(f" {name} ") + 1 if index else 0 for index, name in enumerate(names[:12])]
        data = lines[lines.index(head) + 1:-1]
        self.assertEqual((len(data), lines[-1]), (82, "[END]"))
        js5 = names.index("js5")
        upper, lower = (data[row][starts[js5 - 1]:].split() if js5 < 12 else data[row].split() for row in (2, 3))
        self.assertEqual(upper[0], "2")
        self.assertTrue(lower)

    def test_what_is_refused(self):
        self.assert_problem(self.daemon.get("/v1/tables/hole?classes=H19"), 404, "class.unknown")
        self.assert_problem(self.daemon.get("/v1/tables/hole?classes=h7"), 404, "class.unknown")
        self.assert_problem(self.daemon.get("/v1/tables/hole?revision=0-x"), 400, "revision.unknown")
        self.assert_problem(self.daemon.get("/v1/tables/bore"), 404, "resource.not_found")


class CustomColumns(DaemonTest):
    def put(self, name, rows, feature="hole", **headers):
        return self.daemon.request("PUT", f"/v1/tables/{feature}/classes/{name}", {"rows": rows}, headers)

    def test_a_column_answers_at_once_and_goes_again(self):
        before = self.daemon.get("/v1/tables").json["revision"]
        self.assertEqual(self.put("PRESS", ROWS).status, 201)
        self.assertEqual(self.put("PRESS", ROWS).status, 200)
        limits = self.daemon.get("/v1/limits/25PRESS").json
        self.assertEqual((limits["upper_deviation_um"], limits["basis"]), (15, "custom"))
        self.assertEqual(limits["size_range_mm"], {"over": 18, "up_to": 30})
        self.assertEqual(self.daemon.get("/v1/limits/50.5PRESS").json["upper_deviation_um"], 17.25)
        self.assert_problem(self.daemon.get("/v1/limits/50.6PRESS"), 422, "class.undefined_for_size")
        self.assertEqual(self.daemon.get("/v1/verdicts/25PRESS?measured_mm=25.015").json["verdict"], "good")
        self.assertEqual(self.daemon.get("/v1/tables").json["tables"][0]["own"], ["PRESS"])
        self.assertIn("PRESS", self.daemon.get("/v1/tables").json["tables"][0]["classes"])
        self.assertIn("PRESS", self.daemon.get("/v1/tables/hole.tab").text)
        self.assertEqual(self.daemon.get(f"/v1/tables/hole?classes=H7&revision={before}").json["revision"], before)
        self.assertEqual(self.daemon.request("DELETE", "/v1/tables/hole/classes/PRESS").status, 204)
        self.assert_problem(self.daemon.get("/v1/limits/25PRESS"), 404, "class.unknown")
        self.assert_problem(self.daemon.request("DELETE", "/v1/tables/hole/classes/PRESS"), 404, "class.unknown")

    def test_a_name_that_no_column_has_cannot_be_read(self):
        for name in ("1A", "A-1", "A" * 17):
            for answer in (self.put(name, ROWS), self.daemon.request("DELETE", f"/v1/tables/hole/classes/{name}")):
                self.assert_problem(answer, 400, "path.malformed")
        self.assert_problem(self.put("BEREICH", ROWS), 422, "request.invalid")

    def test_a_column_may_stand_before_the_standard_s_class(self):
        tag = self.daemon.get("/v1/limits/25H8").headers["etag"]
        self.assertEqual(self.put("H8", ROWS).status, 201)
        self.assertNotEqual(self.daemon.get("/v1/limits/25H8").headers["etag"], tag)
        self.assert_problem(self.daemon.get("/v1/limits/100H8"), 422, "class.undefined_for_size")
        self.daemon.request("DELETE", "/v1/tables/hole/classes/H8")
        self.assertEqual(self.daemon.get("/v1/limits/25H8").json["basis"], "iso286")

    def test_a_row_shows_what_is_so_for_all_its_sizes(self):
        """Rows of the column may cut those of the table: 18 to 24 mm has three answers here."""
        self.put("CUT", [{"over_mm": over, "up_to_mm": up_to, "upper_um": upper, "lower_um": 0}
                         for over, up_to, upper in ((20, 22, 5), (22, 30, 7), (30, 50, 9))])
        upper = lambda size: self.daemon.get(f"/v1/limits/{size}CUT").json.get("upper_deviation_um")
        self.assertEqual([upper(size) for size in (20, 22, 24, 50)], [None, 5, 7, 9])
        rows = self.daemon.get("/v1/tables/hole?classes=CUT").json["rows"]
        self.assertEqual({row["up_to_mm"]: row["limits"]["CUT"]["upper_um"] for row in rows if row["limits"]},
                         {30: 7, 40: 9, 50: 9})
        lines = self.daemon.get("/v1/tables/hole?classes=CUT&format=csv").text.split()
        self.assertEqual(lines[6:9], ["18,24,,", "24,30,7,0", "30,40,9,0"])

    def test_rows_of_the_same_deviations_are_one_for_the_table(self):
        """Whole steps from 18 mm on; 14 to 18 mm is not covered, and 30 to 40 mm has two answers."""
        for name in ("D10", "JOINED"):
            self.put(name, [{"over_mm": over, "up_to_mm": up_to, "upper_um": upper, "lower_um": 0}
                            for over, up_to, upper in ((16, 19, 5), (19, 20.5, 5), (20.5, 35, 5), (35, 36, 7), (36, 50, 7))])
            rows = self.daemon.get(f"/v1/tables/hole?classes={name}").json["rows"]
            self.assertEqual({row["up_to_mm"]: row["limits"][name]["upper_um"] for row in rows if row["limits"]},
                             {24: 5, 30: 5, 50: 7})
        lines = self.daemon.get("/v1/tables/hole.tab").text.splitlines()
        head = next(line for line in lines if line.startswith("NR"))
        cell = slice(head.index("D10 "), head.index("D10 ") + 4)
        upper = {line.split()[1]: line[cell].strip() for line in lines[lines.index(head) + 1:-1:2]}
        self.assertEqual([upper[size] for size in ("18", "24", "30", "40", "50")], ["", "5", "5", "", "7"])
        self.daemon.request("DELETE", "/v1/tables/hole/classes/D10")

    def test_if_match_guards_a_change(self):
        tag = self.daemon.get("/v1/tables").headers["etag"]
        self.assertEqual(self.put("A1x", ROWS, **{"If-Match": tag}).status, 201)
        self.assert_problem(self.put("A1x", ROWS, **{"If-Match": tag}), 412, "precondition.failed")

    def test_each_form_of_the_tables_is_a_tag_for_a_change(self):
        for n, (path, fields) in enumerate((
                ("hole", {}), ("hole", {"Accept-Encoding": "gzip"}), ("hole?format=csv", {"Accept-Encoding": "gzip"}),
                ("hole.tab", {}), ("hole?classes=H7", {}))):
            tag = self.daemon.get(f"/v1/tables/{path}", **fields).headers["etag"]
            self.assertEqual("-gzip" in tag, bool(fields))
            rows = [{**ROWS[0], "upper_um": n}]
            for other in ("W/" + tag, tag.replace("-", "9-", 1), tag[:4] + '"', '"x"'):
                self.assert_problem(self.put("FORM", rows, **{"If-Match": other}), 412, "precondition.failed")
            self.assertEqual(self.put("FORM", rows, **{"If-Match": '"x", ' + tag}).status, 200 if n else 201)
            self.assert_problem(self.put("FORM", rows, **{"If-Match": tag}), 412, "precondition.failed")

    def test_a_star_is_a_class_that_exists(self):
        refused = lambda answer: self.assert_problem(answer, 412, "precondition.failed")
        refused(self.put("STAR", ROWS, **{"If-Match": "*"}))
        refused(self.put("H9", ROWS, **{"If-Match": "*"}))
        self.assertEqual(self.put("STAR", ROWS, **{"If-None-Match": "*"}).status, 201)
        refused(self.put("STAR", ROWS[:1], **{"If-None-Match": "*"}))
        refused(self.put("STAR", ROWS[:1], **{"If-None-Match": "W/" + self.daemon.get("/v1/tables").headers["etag"]}))
        self.assertEqual(self.put("STAR", ROWS[:1], **{"If-Match": "*", "If-None-Match": '"x"'}).status, 200)
        refused(self.daemon.request("DELETE", "/v1/tables/hole/classes/STAR", None, {"If-None-Match": "*"}))
        self.assertEqual(self.daemon.request("DELETE", "/v1/tables/hole/classes/STAR", None, {"If-Match": "*"}).status, 204)

    def test_the_same_rows_change_nothing(self):
        revision = self.put("SAME", ROWS).json["revision"]
        changes = lambda: self.daemon.get("/v1/changes?kind=tables").json["changes"]
        before = changes()
        again = self.put("SAME", [{**ROWS[0], "upper_um": "15.000"}, ROWS[1]])
        self.assertEqual((again.status, again.json["revision"], again.headers["etag"]), (200, revision, f'"{revision}"'))
        self.assertEqual(self.daemon.get("/v1/tables").json["revision"], revision)
        self.assertEqual(changes(), before)
        self.assertNotEqual(self.put("SAME", ROWS[:1]).json["revision"], revision)
        self.assertEqual(len(changes()), len(before) + 1)

    def test_every_bad_field_is_named(self):
        problem = self.assert_problem(
            self.put("BAD", [{"over_mm": 18, "up_to_mm": 30, "upper_um": -4, "lower_um": -3},
                             {"over_mm": 31, "up_to_mm": 50, "upper_um": 1, "lower_um": 0}]), 422, "request.invalid")
        self.assertTrue(any(entry["pointer"].startswith("/rows/1/") for entry in problem["errors"]), problem)
        problem = self.assert_problem(self.put("BAD", [{"over_mm": 18, "up": 30}]), 422, "request.invalid")
        self.assertEqual({(e["pointer"], e["code"]) for e in problem["errors"]},
                         {("/rows/0/up_to_mm", "field.missing"), ("/rows/0/upper_um", "field.missing"),
                          ("/rows/0/lower_um", "field.missing"), ("/rows/0/up", "field.unknown")})
        self.assertEqual(self.put("press", ROWS).status, 422)


class AChangedCell(DaemonTest):
    @classmethod
    def setUpClass(cls):
        daemon = Daemon()
        cls.addClassCleanup(daemon.cleanup)
        daemon.start()
        daemon.stop()
        with sqlite3.connect(daemon.database) as database:
            name, = database.execute(
                "SELECT name FROM sqlite_master WHERE type = 'table' AND sql LIKE '%value_nm%'").fetchone()
            for trigger, in database.execute(
                    "SELECT name FROM sqlite_master WHERE type = 'trigger' AND tbl_name = ?", (name,)).fetchall():
                database.execute(f"DROP TRIGGER {trigger}")
            changed = database.execute(
                f"UPDATE {name} SET value_nm = 53000 WHERE value_nm = 52000 AND over_nm = 18000000").rowcount
            assert changed >= 1, changed
        database.close()
        cls.daemon = daemon.start()

    def test_the_cell_is_named_and_no_verdict_is_given(self):
        problem = self.assert_problem(self.daemon.get("/readyz"), 503, "tables.inconsistent")
        text = str(problem)
        for word in ("it_grades", "18", "30", "IT9"):
            self.assertIn(word, text)
        self.assert_problem(self.daemon.get("/v1/verdicts/25H7?measured_mm=25"), 503, "tables.inconsistent")
        self.assert_problem(self.daemon.get("/v1/limits/25H7"), 503, "tables.inconsistent")
        self.assert_problem(self.daemon.measure({"designation": "25 H7", "measured_mm": 25}), 503,
                            "tables.inconsistent")
        self.assertEqual(self.daemon.get("/livez").status, 200)
