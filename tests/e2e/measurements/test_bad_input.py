"""Bad requests: the right answer, nothing stored, and the connection or a new one goes on."""

import json
import math

from support.daemon import DaemonTest

GOOD = {"designation": "25 H7", "measured_mm": 25.0}
JSON = {"Content-Type": "application/json"}


class BadInput(DaemonTest):
    def tearDown(self):
        self.assertEqual(self.daemon.stored(), [], "nothing is stored")
        self.assertEqual(self.daemon.get("/v1/limits/25H7").status, 200)

    def refuse(self, body, status, code=None, headers=None):
        answer = self.daemon.measure(body, headers or JSON)
        self.assertEqual(answer.status, status, answer)
        self.assertEqual(answer.headers["content-type"], "application/problem+json")
        if code:
            problem = answer.json
            codes = [e["code"] for e in problem.get("errors", [])] or [problem["code"]]
            self.assertEqual(codes, [code], answer)

    def test_a_line_that_cannot_be_read_is_listed_with_its_row(self):
        good = '{"designation":"25H7","measured_mm":25}\n'
        for body, media_type, code, row in (
                (good + "{bad\n", "application/x-ndjson", "json.malformed", "/1"),
                ("designation,measured_mm\n25H7,25,9\n", "text/csv", "csv.malformed", "/0")):
            answer = self.daemon.measure(body, {"Content-Type": media_type})
            self.assertEqual((answer.status, answer.json["code"]), (400, code))
            self.assertEqual([(e["pointer"], e["line"], e["code"]) for e in answer.json["errors"]], [(row, 2, code)])

    def test_a_field_without_a_name_has_a_pointer(self):
        for body, pointer in (({**GOOD, "": 2}, "/"), ([GOOD, {**GOOD, "": 2}], "/1/"), ([GOOD, 3], "/1")):
            error, = self.daemon.measure(body, JSON).json["errors"]
            self.assertEqual(error["pointer"], pointer)

    def test_the_detail_is_the_first_error_and_counts_the_others(self):
        row = {"designation": "25 H7"}
        for rows, more in (({**GOOD, "measured_mm": None}, ""), ([row], ""), ([row, row, row], " (and 2 more)"),
                           ([row] * 150, " (and 149 more); the first 100 are listed")):
            problem = self.daemon.measure(rows, JSON).json
            self.assertEqual(problem["detail"], problem["errors"][0]["detail"] + more)
        self.assertEqual(len(problem["errors"]), 100)
        csv = "designation,measured_mm\n25 H7,25.01\n" + "25 H7,\n" * 3
        ndjson = json.dumps(GOOD) + "\n" + (json.dumps(row) + "\n") * 3
        for body, media_type, line in ((csv, "text/csv", 3), (ndjson, "application/x-ndjson", 2)):
            problem = self.daemon.measure(body, {"Content-Type": media_type}).json
            first, *others = problem["errors"]
            self.assertEqual((first["line"], problem["detail"]), (line, f"{first['detail']} (and {len(others)} more)"))
        column = {"rows": [{"over_mm": 18, "up_to_mm": 10, "upper_um": 5, "lower_um": 9}]}
        problem = self.daemon.request("PUT", "/v1/tables/hole/classes/Own", json.dumps(column), JSON).json
        first, *others = problem["errors"]
        self.assertEqual(problem["detail"], first["detail"] + (f" (and {len(others)} more)" if others else ""))

    def test_sizes(self):
        for nominal, code in ((0, "size.out_of_range"), (-1, "size.out_of_range"),
                              ("3150.000001", "size.out_of_range"), ("25.0000001", "length.too_fine")):
            with self.subTest(nominal):
                self.refuse({"nominal_mm": nominal, "tolerance_class": "H7", "measured_mm": 25}, 422,
                            code)
        self.refuse('{"nominal_mm":1e999,"tolerance_class":"H7","measured_mm":25}', 422)
        self.refuse('{"nominal_mm":NaN,"tolerance_class":"H7","measured_mm":25}', 400,
                    "json.malformed")

    def test_measured_values(self):
        for value, code in ((0, "length.out_of_range"), (-25, "length.out_of_range"),
                            ("100000000.000001", "length.out_of_range"), ("", "length.malformed"),
                            (None, "field.type"), (True, "field.type"), ([25], "field.type"),
                            ({"mm": 25}, "field.type"), ("25,0", "length.malformed"),
                            ("NaN", "length.malformed"), ("Infinity", "length.malformed"),
                            ("0x19", "length.malformed"), (" 25", "length.malformed")):
            with self.subTest(value):
                self.refuse({"designation": "25 H7", "measured_mm": value}, 422, code)
        for value in ("NaN", "Infinity", "-Infinity", "25,0", "+25", ".5", "25.", "01", "0x19", ""):
            with self.subTest(value):
                self.refuse('{"designation":"25 H7","measured_mm":%s}' % value, 400)

    def test_classes(self):
        for designation, code in (
                ("25 H", "designation.malformed"), ("7H", "designation.malformed"),
                ("25 H19", "class.unknown"), ("25 I7", "class.unknown"),
                ("25 NEU", "class.unknown"), ("25 h7x", "class.unknown"), ("10 t6", "class.undefined_for_size"),
                ("0.8 N9", "class.undefined_for_size"), ("25 K9", "class.undefined_for_size")):
            with self.subTest(designation):
                self.refuse({"designation": designation, "measured_mm": 25}, 422, code)
        for name in ("", " ", "H", "7H", "H19", "h7x"):
            with self.subTest(name):
                self.refuse({"nominal_mm": 25, "tolerance_class": name, "measured_mm": 25}, 422,
                            "class.unknown")

    def test_limits_given_twice_or_not_at_all(self):
        self.refuse({"measured_mm": 25}, 422)
        self.refuse({"designation": "25 H7", "nominal_mm": 25, "measured_mm": 25}, 422,
                    "field.conflict")

    def test_json_that_cannot_be_read(self):
        for body in (b"", b"{", b"{}x", b'{"measured_mm":', b"\xff\xfe", b'{"part_id":"\xff"}',
                     b"\xef\xbb\xbf{}", b'{"part_id":"\\ud800"}', b"[" * 500_000, b'{"a":' * 500_000,
                     b"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]",
                     b"{'measured_mm':25}", b"nul", b'{"measured_mm":25,}', json.dumps(GOOD).encode() + b"\0"):
            with self.subTest(body[:40]):
                self.refuse(body, 400)
        self.refuse('{"measured_mm":25,"measured_mm":25,"designation":"25 H7"}', 400,
                    "json.duplicate_key")

    def test_unknown_fields_are_named(self):
        self.refuse({**GOOD, "color": 1}, 422, "field.unknown")

    def test_a_single_object_of_10_mb(self):
        self.refuse({**GOOD, "comment": "x" * 10_000_000}, 422, "field.too_long")

    def test_media_types(self):
        for kind in ("text/plain", "application/xml", "multipart/form-data",
                     "application/json; charset=latin-1", ""):
            with self.subTest(kind):
                answer = self.daemon.measure(json.dumps(GOOD), {"Content-Type": kind} if kind else
                                             {"Content-Type": "application/octet-stream"})
                self.assert_problem(answer, 415, "media_type.unsupported")
        connection = self.daemon.connect()
        self.addCleanup(connection.close)
        connection.putrequest("POST", "/v1/measurements")
        connection.putheader("Content-Length", "2")
        connection.endheaders(b"{}")
        self.assertEqual(connection.getresponse().status, 415)

    def test_headers_of_100_kb(self):
        answer = self.daemon.measure(GOOD, {"X-Long": "x" * 100_000})
        self.assertEqual(answer.status, 431, answer)

    def test_more_than_32_mib(self):
        connection = self.daemon.connect()
        self.addCleanup(connection.close)
        connection.putrequest("POST", "/v1/measurements")
        connection.putheader("Content-Type", "application/json")
        connection.putheader("Content-Length", str((32 << 20) + 1))
        connection.endheaders()
        self.assertEqual(connection.getresponse().status, 413)

    def test_the_same_connection_goes_on(self):
        connection = self.daemon.connect()
        self.addCleanup(connection.close)
        for body in ("{", "[]", json.dumps({**GOOD, "measured_mm": None})):
            self.assertIn(self.daemon.measure(body, JSON, connection).status, (400, 422))
        self.assertEqual(
            self.daemon.request("GET", "/v1/limits/25H7", connection=connection).status, 200)

    def test_queries(self):
        for query, code in (("limit=0", "query.invalid"), ("limit=1001", "query.invalid"),
                            ("limit=x", "query.invalid"), ("after=m0", "cursor.invalid"),
                            ("from=yesterday", "query.invalid"), ("verdict=nice", "query.invalid"),
                            ("colour=red", "query.unknown"), ("part_id=a&part_id=b", "query.repeated"),
                            ("source=both", "query.invalid")):
            with self.subTest(query):
                self.assert_problem(self.daemon.get(f"/v1/measurements?{query}"), 400, code)
        self.assert_problem(self.daemon.get("/v1/measurements/summary?group_by=comment"), 400,
                            "query.invalid")


class ARoundedValue(DaemonTest):
    def test_a_measured_value_is_stored_to_the_nearest_nanometre(self):
        record = self.daemon.measure(
            '{"designation":"25 H7","measured_mm":25.005884000000002}', JSON).json
        self.assertEqual(record["measured_mm"], 25.005884)
        self.assertTrue(math.isclose(record["deviation_um"], 5.884))
        self.assertEqual(
            self.daemon.measure('{"designation":"25 H7","measured_mm":2.5e1}', JSON).status, 201)
