"""Many measurements a request: array, NDJSON and CSV; all rows or none, every bad one named."""

import gzip
import json
import unittest

from support.daemon import SANITIZED, DaemonTest

NDJSON = {"Content-Type": "application/x-ndjson"}
CSV = {"Content-Type": "text/csv"}


def part(number, measured="25.013", **fields):
    return {"designation": "25 H7", "measured_mm": measured, "part_id": f"SN-{number}", **fields}


class Bulk(DaemonTest):
    def count(self):
        return len(self.daemon.stored())

    def assert_stored(self, answer, rows):
        self.assertEqual(answer.status, 201, answer)
        self.assertEqual(answer.json["accepted"], rows)

    def assert_refused(self, body, headers, status, code):
        """Refused as a whole; gives the entries of the bad rows."""
        before = self.count()
        problem = self.assert_problem(self.daemon.measure(body, headers), status, code)
        self.assertEqual(self.count(), before, "a refused request stores nothing")
        return problem.get("errors", [])


class Forms(Bulk):
    def test_an_array_counts_its_verdicts(self):
        rows = [part(1, 25.013), part(2, 24.999), part(3, 25.022), part(4, "25.021")]
        answer = self.daemon.measure(rows)
        self.assert_stored(answer, 4)
        self.assertEqual(answer.json["verdicts"],
                         {"good": 2, "rework": 1, "reject": 1, "indeterminate": 0})
        first, last = answer.json["first_id"], answer.json["last_id"]
        self.assertEqual(self.daemon.get(f"/v1/measurements/{first}").json["part_id"], "SN-1")
        self.assertEqual(self.daemon.get(f"/v1/measurements/{last}").json["part_id"], "SN-4")

    def test_ndjson_with_blank_lines_and_crlf(self):
        lines = [json.dumps(part(5)), "", json.dumps(part(6)) + "\r", json.dumps(part(7))]
        self.assert_stored(self.daemon.measure("\n".join(lines), NDJSON), 3)

    def test_csv_with_comma(self):
        body = 'designation,measured_mm,part_id,comment\n25 H7,25.013,A-1,"a ""quoted"", one"\n'
        answer = self.daemon.measure(body, CSV)
        self.assert_stored(answer, 1)
        record = self.daemon.get(f"/v1/measurements/{answer.json['last_id']}").json
        self.assertEqual(record["comment"], 'a "quoted", one')

    def test_csv_with_semicolon_decimal_comma_bom_and_crlf(self):
        body = ("\ufeffnominal_mm;tolerance_class;measured_mm;temperature_c;part_id\r\n"
                "25;H7;25,0215;20,4;B-1\r\n25;H7;25,013;;B-2\r\n")
        answer = self.daemon.measure(body, CSV)
        self.assert_stored(answer, 2)
        self.assertEqual(answer.json["verdicts"]["reject"], 1)
        record = self.daemon.get(f"/v1/measurements/{answer.json['first_id']}").json
        self.assertEqual((record["measured_mm"], record["temperature_c"]), (25.0215, 20.4))
        self.assertNotIn("temperature_c",
                         self.daemon.get(f"/v1/measurements/{answer.json['last_id']}").json)

    def test_a_quoted_field_may_hold_a_decimal_comma_and_line_breaks(self):
        body = 'designation,measured_mm,comment\n25 H7,"25,013","first\nsecond"\n25 H7,25.0,\n'
        answer = self.daemon.measure(body, CSV)
        self.assert_stored(answer, 2)
        record = self.daemon.get(f"/v1/measurements/{answer.json['first_id']}").json
        self.assertEqual((record["measured_mm"], record["comment"]), (25.013, "first\nsecond"))

    def test_each_row_keeps_its_own_quoted_text(self):
        comments = [f'the "{word}" one' for word in ("first", "second", "third")]
        quoted = (comment.replace('"', '""') for comment in comments)
        body = "designation,measured_mm,comment\n" + "".join(f'25 H7,25.01,"{text}"\n' for text in quoted)
        answer = self.daemon.measure(body, {**CSV, "Prefer": "return=representation"})
        self.assertEqual([record["comment"] for record in answer.json["measurements"]], comments)

    def test_gzip_in_every_form(self):
        for body, kind in ((json.dumps([part(1), part(2)]), "application/json"),
                           (json.dumps(part(1)) + "\n" + json.dumps(part(2)),
                            "application/x-ndjson"),
                           ("designation,measured_mm\n25 H7,25.01\n25 H7,25.02\n", "text/csv")):
            with self.subTest(kind):
                answer = self.daemon.measure(
                    gzip.compress(body.encode()),
                    {"Content-Type": kind, "Content-Encoding": "gzip"})
                self.assert_stored(answer, 2)

    def test_damaged_gzip_is_the_clients_mistake(self):
        packed = gzip.compress(json.dumps([part(1), part(2)]).encode())
        for body in (packed[:-6], packed[:20], b"no gzip"):
            answer = self.daemon.measure(
                body, {"Content-Type": "application/json", "Content-Encoding": "gzip"})
            self.assertEqual(answer.status, 400, answer)

    def test_a_large_request_in_one_transaction(self):
        rows = "\n".join(json.dumps(part(i)) for i in range(20_000))
        self.assert_stored(self.daemon.measure(rows, NDJSON), 20_000)

    @unittest.skipIf(SANITIZED, "half a minute for 300,000 equal rows")
    def test_more_rows_than_a_request_takes(self):
        csv = "designation,measured_mm\n" + "25H7,25\n" * 100_001
        one = '{"designation":"25H7","measured_mm":25}'
        for body, media_type, line in ((csv, CSV, 100_002), ((one + "\n") * 100_001, NDJSON, 100_001),
                                       ("[" + ",".join([one] * 100_001) + "]", None, None)):
            error, = self.assert_refused(body, media_type or {"Content-Type": "application/json"}, 422, "request.invalid")
            self.assertEqual((error["pointer"], error.get("line")), ("/100000", line))
            self.assertIn("at most 100000 rows", error["detail"])

    def test_no_row_is_said_at_the_whole(self):
        for body, media_type in (("designation,measured_mm\n", CSV), ("\n", NDJSON), ("[]", {"Content-Type": "application/json"})):
            self.assertEqual([error["pointer"] for error in self.assert_refused(body, media_type, 422, "request.invalid")], [""])


class Preferences(Bulk):
    def test_minimal_has_no_body(self):
        for body in (part(1), [part(1), part(2)]):
            answer = self.daemon.measure(body, {"Prefer": "return=minimal"})
            self.assertEqual((answer.status, answer.body), (201, b""))
            self.assertEqual(answer.headers["preference-applied"], "return=minimal")
        self.assertIn("location", self.daemon.measure(part(3), {"Prefer": "return=minimal"}).headers)

    def test_representation_has_the_records(self):
        answer = self.daemon.measure([part(1), part(2, 25.05)], {"Prefer": "return=representation"})
        records = answer.json["measurements"]
        self.assertEqual([r["verdict"] for r in records], ["good", "reject"])
        for record in records:
            self.assertEqual(self.daemon.get(f"/v1/measurements/{record['id']}").json, record)


class BadRows(Bulk):
    def test_every_bad_row_of_an_array_has_its_pointer(self):
        rows = [part(i) for i in range(50)]
        rows[3]["measured_mm"] = None
        rows[17]["measured_mm"] = "25,0"
        del rows[30]["measured_mm"]
        rows[41]["colour"] = "blue"
        rows[42] = 7
        entries = self.assert_refused(rows, None, 422, "request.invalid")
        self.assertEqual(
            [(e["pointer"], e["code"]) for e in entries],
            [("/3/measured_mm", "field.type"), ("/17/measured_mm", "length.malformed"),
             ("/30/measured_mm", "field.missing"), ("/41/colour", "field.unknown"),
             ("/42", "field.type")])

    def test_csv_names_the_line(self):
        csv = 'designation,measured_mm,comment\n25 H7,25.0,"two\nlines"\n25 H7,zero,\n'
        entry, = self.assert_refused(csv, CSV, 422, "request.invalid")
        self.assertEqual((entry["pointer"], entry["line"]), ("/1/measured_mm", 4))

    def test_an_empty_value_is_never_good(self):
        for csv in ("designation,measured_mm\n25 H7,\n", "designation,measured_mm\n25 H7,\"\"\n",
                    "designation,measured_mm\n25 H7,nan\n", "designation\n25 H7\n"):
            self.assert_refused(csv, CSV, 422, "request.invalid")

    def test_empty_lists_are_refused(self):
        for body, headers in (("[]", None), ("", NDJSON), ("\n\n", NDJSON),
                              ("designation,measured_mm\n", CSV)):
            with self.subTest(body):
                self.assert_refused(body, headers or {"Content-Type": "application/json"}, 422,
                                    "request.invalid")

    def test_unreadable_files_are_400(self):
        for body in ('a,"b\n', "designation,designation\n1,2\n",
                     "designation,measured_mm\n25 H7,25,1\n", b"designation,measured_mm\n\xff,1\n"):
            with self.subTest(body):
                answer = self.daemon.measure(body, CSV)
                self.assertEqual(answer.status, 400, answer)
        self.assert_refused(json.dumps(part(1)) + "\n{", NDJSON, 400, "json.malformed")
