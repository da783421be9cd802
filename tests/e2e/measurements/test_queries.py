"""Lists, streams and summaries of stored measurements."""

import csv
import decimal
import fractions
import io
import json
import random
import re
import socket
import urllib.parse

from support.daemon import DaemonTest
from support.waiting import PATIENCE

NDJSON = "application/x-ndjson"


class Lists(DaemonTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rows = []
        for i in range(250):
            rows.append({"designation": "25 H7", "measured_mm": 25.03 if i % 10 == 0 else 25.01,
                         "part_id": f"SN-{i % 50}", "characteristic": f"bore-{i % 5}",
                         "order": f"WO-{i % 2}", "machine": f"M{i % 4}",
                         "measured_at": f"2026-11-20T08:{i // 60:02}:{i % 60:02}Z"})
        cls.rows = [m["id"] for m in cls.daemon.measure(
            rows, {"Prefer": "return=representation"}).json["measurements"]]

    def ids(self, query):
        page = self.daemon.get(f"/v1/measurements?{query}")
        self.assertEqual(page.status, 200, page)
        return [m["id"] for m in page.json["measurements"]]

    def test_a_page_has_a_hundred_rows(self):
        page = self.daemon.get("/v1/measurements")
        self.assertEqual([m["id"] for m in page.json["measurements"]], self.rows[:100])
        self.assertIsNotNone(page.json["next"])

    def test_the_cursor_and_the_link_lead_through_all_pages(self):
        for limit in (1, 7, 100, 250, 1000):
            if limit == 1:
                path = "/v1/measurements?limit=1&part_id=SN-7"
                expected = self.rows[7::50]
            else:
                path, expected = f"/v1/measurements?limit={limit}", self.rows
            seen = []
            while path:
                page = self.daemon.get(path)
                seen += [m["id"] for m in page.json["measurements"]]
                link = re.fullmatch(r'<(.*)>; rel="next"', page.headers.get("link", ""))
                self.assertEqual(link is None, page.json["next"] is None)
                if link:
                    self.assertIn(f"after={page.json['next']}", link[1])
                path = link and link[1]
            self.assertEqual(seen, expected)

    def test_filters(self):
        rows = self.rows
        self.assertEqual(self.ids("part_id=SN-7"), rows[7::50])
        self.assertEqual(self.ids("characteristic=bore-3&limit=1000"), rows[3::5])
        self.assertEqual(self.ids("order=WO-1&machine=M3&limit=1000"), rows[3::4])
        self.assertEqual(self.ids("verdict=reject&limit=1000"), rows[::10])
        self.assertEqual(self.ids("verdict=rework"), [])
        self.assertEqual(self.ids("part_id=SN"), [])
        self.assertEqual(self.ids("source=simulation"), [])
        self.assertEqual(self.ids("source=all&part_id=SN-0"), rows[::50])

    def test_a_cursor_with_an_encoded_name_leads_on(self):
        page = self.daemon.get("/v1/measurements?%61fter=" + self.rows[9] + "&%6cimit=5&")
        link = re.fullmatch(r'<(.*)>; rel="next"', page.headers["link"])
        self.assertEqual([m["id"] for m in self.daemon.get(link[1]).json["measurements"]], self.rows[15:20])

    def test_newest_first_leads_through_all_pages_the_other_way(self):
        path, seen = "/v1/measurements?sort=newest&limit=60", []
        while path:
            page = self.daemon.get(path)
            seen += [m["id"] for m in page.json["measurements"]]
            link = re.fullmatch(r'<(.*)>; rel="next"', page.headers.get("link", ""))
            self.assertEqual(link is None, page.json["next"] is None)
            path = link and link[1]
        self.assertEqual(seen, self.rows[::-1])
        self.assertEqual(self.ids("sort=newest&characteristic=bore-3&limit=2"), self.rows[3::5][:-3:-1])
        lines = self.daemon.get("/v1/measurements?sort=newest&format=ndjson").text.splitlines()
        self.assertEqual([json.loads(line)["id"] for line in lines], self.rows[::-1])

    def test_the_greatest_cursor_has_nothing_after_it_and_all_before(self):
        greatest = f"m{2**63 - 1}"
        self.assertEqual(self.ids(f"after={greatest}"), [])
        self.assertEqual(self.ids(f"after={greatest}&sort=newest&limit=2"), self.rows[:-3:-1])

    def test_the_last_rows(self):
        self.assertEqual(self.ids("last=3"), self.rows[-3:])
        self.assertEqual(self.ids("last=3&sort=newest"), self.rows[:-4:-1])
        self.assertEqual(self.ids("last=2&part_id=SN-7"), self.rows[7::50][-2:])
        self.assertEqual(self.ids("last=1000"), self.rows)
        self.assertEqual(self.ids("last=5&part_id=none"), [])
        page = self.daemon.get("/v1/measurements?last=3")
        self.assertIsNone(page.json["next"])
        self.assertNotIn("link", page.headers)
        text = self.daemon.get("/v1/measurements?last=3&format=csv").text
        self.assertEqual([row["id"] for row in csv.DictReader(io.StringIO(text))], self.rows[-3:])
        for query in ("last=3&limit=2", "last=3&after=m1", "last=0", "last=1001", "sort=up", "format=xml"):
            self.assert_problem(self.daemon.get(f"/v1/measurements?{query}"), 400, "query.invalid")

    def test_the_time_range_takes_its_beginning_and_not_its_end(self):
        self.assertEqual(self.ids("from=2026-11-20T08:01:00Z&to=2026-11-20T08:01:10Z"),
                         self.rows[60:70])
        self.assertEqual(self.ids("from=2026-11-20T09:01:00%2B01:00&limit=3"), self.rows[60:63])
        self.assertEqual(self.ids("to=2026-11-20T08:00:00Z"), [])
        self.assertEqual(self.ids("from=0001-01-01T00:00:00Z&to=9999-12-31T23:59:59Z&limit=3"), self.rows[:3])
        self.assertEqual(self.ids("from=9999-12-31T23:59:59-01:00"), [])
        for time in ("9999-13-01T00:00:00Z", "0000-01-01", "99990101T000000Z"):
            self.assertEqual(self.daemon.get(f"/v1/measurements?to={time}").status, 400, time)

    def test_streams_have_every_row(self):
        text = self.daemon.get("/v1/measurements", Accept=NDJSON).text
        self.assertEqual([json.loads(line)["id"] for line in text.splitlines()], self.rows)
        answer = self.daemon.get("/v1/measurements?verdict=reject", Accept="text/csv")
        self.assertEqual(answer.headers["content-type"],
                         "text/csv; charset=utf-8; header=present")
        table = list(csv.DictReader(io.StringIO(answer.text)))
        self.assertEqual([row["id"] for row in table], self.rows[::10])
        self.assertEqual({row["excess_um"] for row in table}, {"9"})
        self.assertEqual(answer.headers["vary"], "Accept, Accept-Encoding")

    def test_a_limited_csv_has_the_link(self):
        answer = self.daemon.get("/v1/measurements?limit=10", Accept="text/csv")
        self.assertEqual(len(answer.text.splitlines()), 11)
        self.assertIn('rel="next"', answer.headers["link"])

    def test_an_unacceptable_form(self):
        refused = self.daemon.get("/v1/measurements", Accept="image/png")
        self.assertEqual(refused.status, 406)
        self.assertIn("Accept allows no type of this response: ask for one of: application/json, ", refused.json["detail"])

    def test_groups(self):
        groups = self.daemon.get("/v1/measurements/summary?group_by=machine").json["groups"]
        self.assertEqual([(g["machine"], g["count"]) for g in groups],
                         [("M0", 63), ("M1", 63), ("M2", 62), ("M3", 62)])
        group, = self.daemon.get(
            "/v1/measurements/summary?group_by=order&order=WO-0&verdict=reject").json["groups"]
        self.assertEqual(group["verdicts"],
                         {"good": 0, "rework": 0, "reject": 25, "indeterminate": 0})
        self.assertEqual((group["min_mm"], group["max_mm"], group["standard_deviation_mm"]),
                         (25.03, 25.03, 0))


class OneState(DaemonTest):
    """A list is of one piece, whatever is recorded and corrected while it is read."""

    ROWS = 20_000

    def ids(self, query):
        return [m["id"] for m in self.daemon.get(f"/v1/measurements?{query}").json["measurements"]]

    def test_all_pages_show_the_state_at_the_first(self):
        rows = [{"designation": "25 H7", "measured_mm": 25.01, "part_id": "one-piece"}] * 6
        ids = [m["id"] for m in self.daemon.measure(
            rows, {"Prefer": "return=representation"}).json["measurements"]]
        path = "/v1/measurements?part_id=one-piece&limit=2"
        page = self.daemon.get(path).json
        seen = page["measurements"]
        corrections = [self.correct(ids[0]), self.correct(ids[4])]
        self.daemon.measure(rows[0])
        while page["next"]:
            page = self.daemon.get(f"{path}&after={page['next']}").json
            seen += page["measurements"]
        self.assertEqual([m["id"] for m in seen], ids)
        # A list that begins now shows what holds now, and an id is a cursor too.
        current = self.ids("part_id=one-piece")
        self.assertEqual(current[:6], ids[1:4] + ids[5:] + corrections)
        self.assertEqual(self.ids(f"part_id=one-piece&after={corrections[0]}"), current[5:])

    def correct(self, name):
        answer = self.daemon.post(f"/v1/measurements/{name}/corrections",
                                  {"measured_mm": 25.02, "reason": "typing error"})
        self.assertEqual(answer.status, 201, answer)
        return answer.json["id"]

    def test_a_stream_shows_the_state_at_its_beginning(self):
        body = "designation,measured_mm,comment\n" + f"25H7,25.01,{'x' * 400}\n" * self.ROWS
        answer = self.daemon.measure(body, {"Content-Type": "text/csv"})
        self.assertEqual(answer.status, 201, answer)
        with socket.socket() as client:
            # A reader that takes little at a time: the end is not read before the list has changed.
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 65536)
            client.connect(("127.0.0.1", self.daemon.port))
            client.settimeout(PATIENCE)
            client.sendall(b"GET /v1/measurements HTTP/1.1\r\nHost: localhost\r\n"
                           b"Accept: application/x-ndjson\r\nConnection: close\r\n\r\n")
            text = client.recv(100, socket.MSG_WAITALL)
            last = answer.json["last_id"]
            self.correct(last)
            self.daemon.measure({"designation": "25H7", "measured_mm": 25, "comment": "late"})
            text += b"".join(iter(lambda: client.recv(65536), b""))
        self.assertEqual(text.count(b'"comment":"' + b"x" * 400), self.ROWS)
        self.assertTrue(f'"id":"{last}"'.encode() in text, "the end as it was at the beginning")
        self.assertFalse(b"late" in text, "nothing newer than the beginning")


def exact(text):
    return json.loads(text, parse_float=decimal.Decimal, parse_int=decimal.Decimal)


class Statistics(DaemonTest):
    def test_values_near_a_kilometre_keep_every_digit(self):
        generator = random.Random(286)
        nanometres = [1_000_000_200_000 + generator.randrange(100) for _ in range(5_000)]
        body = "nominal_mm,feature,upper_um,lower_um,measured_mm,characteristic\n" + "".join(
            f"1000000,hole,1000,0,{n // 10**6}.{n % 10**6:06},far\n" for n in nanometres)
        self.assertEqual(self.daemon.measure(body, {"Content-Type": "text/csv"}).status, 201)
        group, = exact(
            self.daemon.get("/v1/measurements/summary?characteristic=far").body)["groups"]

        mean = fractions.Fraction(sum(nanometres), len(nanometres))
        variance = sum((n - mean) ** 2 for n in nanometres) / (len(nanometres) - 1)
        with decimal.localcontext() as context:
            context.prec = 60
            millimetre = decimal.Decimal(10) ** 6
            mean_mm = decimal.Decimal(mean.numerator) / mean.denominator / millimetre
            deviation_mm = (decimal.Decimal(variance.numerator) / variance.denominator).sqrt() \
                / millimetre
            half = decimal.Decimal("5e-13")
            self.assertLessEqual(abs(group["mean_mm"] - mean_mm), half)
            self.assertLessEqual(abs(group["standard_deviation_mm"] - deviation_mm), half)
        self.assertEqual(group["min_mm"], decimal.Decimal(min(nanometres)) / 10**6)
        self.assertEqual(group["max_mm"], decimal.Decimal(max(nanometres)) / 10**6)

    def test_a_summary_is_of_the_size_at_20_degrees(self):
        for measured, temperature in ((25.022, 25), (25.012, 30), (25.005, 20), (25.003, 15)):
            self.daemon.measure({"designation": "25H7", "part_material": "steel", "measured_mm": measured,
                                 "temperature_c": temperature, "characteristic": "warm"})
        group, = self.daemon.get("/v1/measurements/summary?characteristic=warm").json["groups"]
        self.assertEqual((group["mean_mm"], group["min_mm"], group["max_mm"]), (25.00978075, 25.004438, 25.020561))
        self.assertAlmostEqual(group["standard_deviation_mm"], 0.0074843, 7)

    def test_one_value_has_no_deviation(self):
        self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01,
                             "characteristic": "single"})
        group, = [g for g in self.daemon.get("/v1/measurements/summary").json["groups"]
                  if g["characteristic"] == "single"]
        self.assertIsNone(group["standard_deviation_mm"])
        self.assertEqual(group["mean_mm"], 25.01)


class Confirmed(DaemonTest):
    """Values that a person confirmed although they were called far outside."""

    def test_is_kept_filtered_and_left_out_of_figures(self):
        def measure(**fields):
            return self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "characteristic": "c", **fields})
        plain = [measure().json["id"] for _ in range(5)]
        far = measure(measured_mm="2009", confirmed=True).json
        self.assertIs(far["confirmed"], True)
        self.assertNotIn("confirmed", measure(characteristic="d", confirmed=False).json)
        for wrong in (1, "yes", None):
            answer = measure(confirmed=wrong)
            self.assertEqual([(e["pointer"], e["code"]) for e in answer.json["errors"]], [("/confirmed", "field.type")])
        listed = lambda query: [m["id"] for m in self.daemon.get(f"/v1/measurements?characteristic=c&{query}").json["measurements"]]
        self.assertEqual((listed("confirmed=true"), listed("confirmed=false"), listed("")), ([far["id"]], plain, [*plain, far["id"]]))
        groups = lambda query: [g["count"] for g in self.daemon.get(f"/v1/measurements/summary?characteristic=c&{query}").json["groups"]]
        self.assertEqual((groups("confirmed=false"), groups("confirmed=true"), groups("")), ([5], [1], [6]))
        charted = lambda query: len(self.daemon.get(f"/v1/measurements/chart?characteristic=c&{query}").json["charts"][0]["points"])
        self.assertEqual((charted("confirmed=false"), charted("")), (5, 6))
        csv_row = "designation,measured_mm,characteristic,confirmed\n25H7,25.5,e,TRUE\n"
        self.assertEqual(self.daemon.measure(csv_row, {"Content-Type": "text/csv"}).status, 201)
        stored, = self.daemon.get("/v1/measurements?characteristic=e").json["measurements"]
        self.assertIs(stored["confirmed"], True)
        again = {"measured_mm": "25.4", "reason": "misread", "confirmed": True}
        kept = self.daemon.post(f"/v1/measurements/{stored['id']}/corrections", again).json
        self.assertIs(kept["confirmed"], True)
        other = self.daemon.post(f"/v1/measurements/{kept['id']}/corrections", {"measured_mm": "25.01", "reason": "misread"}).json
        self.assertNotIn("confirmed", other)


class SetAside(DaemonTest):
    """Values that a note sets aside with a reason, until another counts them again."""

    def test_figures_leave_out_what_the_newest_note_sets_aside(self):
        ids = [self.daemon.measure({"designation": "25 H7", "measured_mm": f"25.0{10 + i % 3}", "characteristic": "a",
                                    "machine": "M1"}).json["id"] for i in range(6)]
        note = lambda measure: self.daemon.post(f"/v1/measurements/{ids[3]}/notes",
                                                {"cause": "Burr", "measure": measure}).json
        listed = lambda query: [m["id"] for m in self.daemon.get(
            f"/v1/measurements?characteristic=a&{query}").json["measurements"]]
        count = lambda what, query, of: of(self.daemon.get(f"/v1/measurements/{what}?characteristic=a&{query}").json)
        figures = lambda query: [
            count("summary", query, lambda answer: sum(group["count"] for group in answer["groups"])),
            count("chart", query, lambda answer: len(answer["charts"][0]["points"])),
            count("capability", query, lambda answer: answer["count"]),
            count("compensation", query, lambda answer: answer["values"])]
        rest = [each for each in ids if each != ids[3]]
        for measure in ("Coolant filled", "set aside", "Coolant filled"):
            note(measure)
        self.assertEqual((listed("set_aside=false"), listed("set_aside=true"), listed("")), (rest, ids[3:4], ids))
        self.assertEqual((figures("set_aside=false"), figures("")), ([5] * 4, [6] * 4))
        self.assertEqual(listed("set_aside=false&last=4"), rest[-4:])
        marks = lambda: [m.get("set_aside") for m in self.daemon.get(
            "/v1/measurements?characteristic=a&notes=shown").json["measurements"]]
        notes = lambda: self.daemon.get(f"/v1/measurements/{ids[3]}/notes").json["set_aside"]
        self.assertEqual((marks(), notes()), ([None, None, None, True, None, None], True))
        note("counted again")
        self.assertEqual((listed("set_aside=false"), listed("set_aside=true"), figures("set_aside=false")), (ids, [], [6] * 4))
        self.assertEqual((marks(), notes()), ([None] * 6, False))
        # A correction is another value: it counts.
        note("set aside")
        corrected = self.daemon.post(f"/v1/measurements/{ids[3]}/corrections", {"measured_mm": "25.011", "reason": "misread"}).json
        self.assertEqual((listed("set_aside=false"), listed("set_aside=true")), ([*rest, corrected["id"]], []))


class EveryFilter(DaemonTest):
    """Each field that filters, alone, and what summaries make of it."""

    FIELDS = ("part_id", "characteristic", "order", "operation", "machine", "operator", "gauge", "unit", "subgroup",
              "tool")

    def ids(self, **query):
        page = self.daemon.get("/v1/measurements?" + urllib.parse.urlencode({"limit": 1000, **query}))
        self.assertEqual(page.status, 200, page)
        return [m["id"] for m in page.json["measurements"]]

    def test_every_field(self):
        rows = [{"designation": "25 H7" if i % 2 else "40 g6", "measured_mm": 25.01 if i % 2 else 39.98,
                 **{field: f"{field} {i % (k + 2)}" for k, field in enumerate(self.FIELDS)}} for i in range(60)]
        stored = self.daemon.measure(rows, {"Prefer": "return=representation"}).json["measurements"]
        ids = [m["id"] for m in stored]
        self.assertEqual(stored[7]["subgroup"], "subgroup 7")
        for k, field in enumerate(self.FIELDS):
            with self.subTest(field):
                self.assertEqual(self.ids(**{field: f"{field} 1"}), ids[1::k + 2])
                self.assertEqual(self.ids(**{field: "none"}), [])
                groups = self.daemon.get(f"/v1/measurements/summary?group_by={field}").json["groups"]
                self.assertEqual({group[field]: group["count"] for group in groups},
                                 {f"{field} {i}": len(ids[i::k + 2]) for i in range(k + 2)})
                one = self.daemon.get("/v1/measurements/summary?" + urllib.parse.urlencode(
                    {"group_by": "tolerance_class", field: f"{field} 0"})).json["groups"]
                self.assertEqual(sum(group["count"] for group in one), len(ids[::k + 2]))
        self.assertEqual(self.ids(designation="25H7"), ids[1::2])
        self.assertEqual(self.ids(designation="Ø40 g6"), ids[::2])
        self.assertEqual(self.ids(designation="25 g6"), [])
        self.assertEqual(self.ids(tolerance_class="H7"), ids[1::2])
        self.assertEqual(self.ids(tolerance_class="H7", designation="40 g6"), [])
        self.assertEqual(self.ids(caller="none"), [])
        self.assertEqual(self.ids(run_id="r1", source="all"), [])
        received = stored[0]["received_at"]
        self.assertEqual(self.ids(received_from=received), ids)
        self.assertEqual(self.ids(received_to=received), [])
        for query, code in (("designation=H7", "designation.malformed"), ("designation=0H7", "query.invalid"),
                            ("designation=4000H7", "query.invalid"), ("run_id=1", "query.invalid"),
                            ("received_from=now", "query.invalid")):
            answer = self.daemon.get(f"/v1/measurements?{query}")
            self.assertEqual((answer.status, answer.json["code"]), (400, code), answer)
            answer = self.daemon.get(f"/v1/measurements/summary?{query}")
            self.assertEqual((answer.status, answer.json["code"]), (400, code), answer)
        csv_rows = list(csv.DictReader(io.StringIO(self.daemon.get("/v1/measurements?format=csv").text)))
        self.assertEqual([row["subgroup"] for row in csv_rows], [row["subgroup"] for row in rows])
        self.assert_problem(self.daemon.measure({**rows[0], "subgroup": "x" * 201}), 422, "request.invalid")
