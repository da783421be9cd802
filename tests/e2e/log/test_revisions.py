"""What a centre hands on to its stations: tables, setups, plans, keys and corrections; and what both have corrected."""

import json
import re
import shutil
import unittest

from log.test_forwarding import metric
from log.test_intake import records_of
from durability.test_storage import PART
from support.daemon import Daemon, command
from support.ports import lasting_address
from support.waiting import wait_for

COLUMN = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]}
OTHER_COLUMN = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 11, "lower_um": -2.5}]}
PLAN = {"characteristics": [{"name": "bore", "designation": "25 H7"}]}
SETUP = {"machine": {"rapid_mm_min": 9000}, "seed": 3}


class Centre(unittest.TestCase):
    def setUp(self):
        self.centre = self.made("--origin-name", "centre", listen=lasting_address()).start()

    def made(self, *flags, **options):
        daemon = Daemon(*flags, **options)
        self.addCleanup(daemon.cleanup)
        return daemon

    def station(self, *flags, centre=None, **options):
        port = (centre or self.centre).port
        return self.made("--origin-name", "press-7", "--forward-to", f"http://127.0.0.1:{port}", *flags, **options)

    def put(self, daemon, path, body, *statuses):
        answer = daemon.request("PUT", path, body)
        self.assertIn(answer.status, statuses or (200, 201), answer)
        return answer

    def revision(self, daemon):
        return daemon.get("/v1/tables").json["revision"]

    def wait_for(self, daemon, path, text):
        wait_for(lambda: daemon.get(path).text == text, f"{path} as the centre has it")

    def assert_clean(self, *daemons):
        for daemon in daemons:
            verified = command("verify", "--data", daemon.data)
            self.assertEqual(verified.returncode, 0, verified.stdout)


class Revisions(Centre):
    def test_tables_setups_and_plans_of_the_centre_are_those_of_its_stations(self):
        station = self.station().start()
        self.put(self.centre, "/v1/tables/hole/classes/Q7", COLUMN)
        self.put(self.centre, "/v1/setups/bench", SETUP)
        self.put(self.centre, "/v1/plans/A%2F1", {"characteristics": [{"name": "bore", "designation": "25 Q7"}]})
        self.put(self.centre, "/v1/catalogues/turning", {"causes": ["worn"], "measures": []})
        given = self.revision(self.centre)
        wait_for(lambda: self.revision(station) == given, "the centre's tables")
        for path in ("/v1/setups/bench", "/v1/plans/A%2F1", "/v1/catalogues/turning"):
            self.wait_for(station, path, self.centre.get(path).text)
        record = station.measure({"designation": "25 Q7", "measured_mm": 25.0151}).json
        self.assertEqual((record["verdict"], record["table_revision"]), ("reject", given), "it names the centre's")
        # A change and a removal follow; a row judged before names what it was judged by.
        self.put(self.centre, "/v1/tables/hole/classes/Q7", OTHER_COLUMN)
        self.assertEqual(self.centre.request("DELETE", "/v1/setups/bench").status, 204)
        wait_for(lambda: self.revision(station) == self.revision(self.centre), "the second tables")
        wait_for(lambda: station.get("/v1/setups/bench").status == 404, "the setup's end")
        self.assertNotEqual(self.revision(station), given)
        for daemon in (station, self.centre):
            table = daemon.get(f"/v1/tables/hole?classes=Q7&revision={given}")
            self.assertIn('"upper_um":15', table.text.replace(" ", ""), table)
        wait_for(lambda: records_of(self.centre) == records_of(station), "the record at the centre")
        self.assertEqual(station.stop(), 0)
        station.start()
        self.assertEqual(self.revision(station), self.revision(self.centre))
        self.assertEqual(station.measure({"designation": "25 Q7", "measured_mm": 25.011}).json["verdict"], "good")
        self.assert_clean(station, self.centre)
        self.assertEqual(station.stop(), 0)  # its log is written
        self.assertNotIn("revision_re", station.log, "nothing was replaced or refused")

    def test_a_station_works_by_the_last_it_has_while_the_centre_is_away(self):
        self.put(self.centre, "/v1/tables/hole/classes/Q7", COLUMN)
        station = self.station().start()
        wait_for(lambda: self.revision(station) == self.revision(self.centre), "the centre's tables")
        self.centre.kill()
        station.kill()
        station.start()
        self.assertEqual(station.measure({"designation": "25 Q7", "measured_mm": 25.015}).json["verdict"], "good")
        # An empty folder in the place of the centre takes nothing away.
        empty = self.made("--origin-name", "centre", listen=self.centre.listen).start()
        wait_for(lambda: metric(station, "fitgauge_outbox_rows") == 0, "an empty outbox")
        self.put(empty, "/v1/plans/4711", PLAN)
        self.wait_for(station, "/v1/plans/4711", empty.get("/v1/plans/4711").text)
        self.assertEqual(station.measure({"designation": "25 Q7", "measured_mm": 25.015}).status, 201)

    def test_what_came_from_the_centre_is_changed_there_and_nowhere_else(self):
        station = self.station().start()
        self.put(station, "/v1/plans/own", PLAN)
        self.put(station, "/v1/tables/hole/classes/Q8", COLUMN)
        self.put(self.centre, "/v1/tables/hole/classes/Q7", COLUMN)
        self.put(self.centre, "/v1/plans/4711", PLAN)
        self.put(self.centre, "/v1/setups/bench", SETUP)
        self.wait_for(station, "/v1/setups/bench", self.centre.get("/v1/setups/bench").text)
        for method, path, body in (("PUT", "/v1/tables/hole/classes/Q7", OTHER_COLUMN),
                                   ("DELETE", "/v1/tables/hole/classes/Q7", None), ("PUT", "/v1/plans/4711", PLAN),
                                   ("DELETE", "/v1/plans/4711", None), ("PUT", "/v1/setups/bench", {}),
                                   ("DELETE", "/v1/setups/bench", None)):
            answer = station.request(method, path, body)
            self.assertEqual(answer.status, 403, answer)
            self.assertIn("must be changed at the centre", answer.json["detail"])
        self.put(station, "/v1/plans/own", PLAN, 200)
        self.put(station, "/v1/plans/another", PLAN, 201)
        # The negative control: without a centre the folder is its own again.
        station.stop()
        station.flags = []
        station.start()
        self.put(station, "/v1/plans/4711", PLAN, 200)
        self.assertEqual(station.request("DELETE", "/v1/tables/hole/classes/Q7").status, 204)

    def test_what_a_station_had_of_its_own_is_kept(self):
        station = self.station()
        flags, station.flags = station.flags, []
        station.start()
        self.put(station, "/v1/tables/hole/classes/Q7", COLUMN)
        self.put(station, "/v1/plans/4711", PLAN)
        self.put(station, "/v1/plans/same", PLAN)
        own = station.get("/v1/plans/4711").text
        before = self.revision(station)
        first = station.measure({"designation": "25 Q7", "measured_mm": 25.015}).json
        station.stop()
        self.put(self.centre, "/v1/tables/hole/classes/Q7", OTHER_COLUMN)
        self.put(self.centre, "/v1/plans/4711", {"name": "of the centre", **PLAN})
        self.put(self.centre, "/v1/plans/same", PLAN)
        station.flags = flags
        station.start()
        self.wait_for(station, "/v1/plans/4711", self.centre.get("/v1/plans/4711").text)
        self.assertEqual(station.get("/v1/plans/4711%20(local)").text, own)
        self.assertEqual([plan["part"] for plan in station.get("/v1/plans").json["plans"]],
                         ["4711", "4711 (local)", "same"])
        self.assertEqual(self.revision(station), self.revision(self.centre))
        self.assertIn('"upper_um":15', station.get(f"/v1/tables/hole?classes=Q7&revision={before}").text)
        self.assertEqual(station.get(f"/v1/measurements/{first['id']}").json, first)
        self.assert_clean(station)
        self.assertEqual(station.stop(), 0)  # its log is written
        self.assertEqual(station.log.count('"event":"revision_replaced"'), 2)

    def test_an_older_copy_of_the_centre_is_followed_too(self):
        station = self.station().start()
        self.put(self.centre, "/v1/plans/4711", PLAN)
        self.wait_for(station, "/v1/plans/4711", self.centre.get("/v1/plans/4711").text)
        self.centre.stop()
        copy = self.centre.folder / "copy"
        shutil.copytree(self.centre.data, copy)
        self.centre.start()
        for name in ("one", "two"):
            self.put(self.centre, "/v1/plans/4711", {"name": name, **PLAN})
        self.wait_for(station, "/v1/plans/4711", self.centre.get("/v1/plans/4711").text)
        self.centre.stop()
        self.centre.data = copy
        self.centre.start()
        # The copy gives the same numbers again, for something else.
        for name in ("three", "four"):
            self.put(self.centre, "/v1/plans/4711", {"name": name, **PLAN})
        self.wait_for(station, "/v1/plans/4711", self.centre.get("/v1/plans/4711").text)


class Keys(Centre):
    def token(self, daemon, name, role):
        made = daemon.command("key", "create", "--name", name, "--role", role)
        self.assertEqual(made.returncode, 0, made.stderr)
        return re.search(r"fg_[0-9a-f]+", made.stdout).group()

    def status(self, daemon, token):
        return daemon.measure(PART, {"Authorization": f"Bearer {token}"}).status

    def test_keys_travel_by_their_hashes_and_administrators_stay_at_home(self):
        self.centre.stop()
        self.centre.flags += ["--auth", "keys"]
        self.centre.start()
        key_file = self.centre.folder / "key"
        key_file.write_text(self.token(self.centre, "press-7", "station"))
        station = self.station("--auth", "keys", "--forward-key-file", key_file).start()
        here = self.token(station, "both", "operator")
        line, viewer, admin, both = (self.token(self.centre, name, role) for name, role in (
            ("line-2", "operator"), ("office", "viewer"), ("boss", "admin"), ("both", "operator")))
        wait_for(lambda: self.status(station, line) == 201, "the operator's key")
        wait_for(lambda: self.status(station, viewer) == 403, "the viewer's key")
        self.assertEqual(self.status(station, admin), 401)
        wait_for(lambda: self.status(station, here) == 201, "its own")
        self.assertEqual(self.status(station, both), 401, "its own stays")
        station.wait_for_log('"event":"revision_refused"')
        self.assertEqual(self.centre.command("key", "revoke", "--name", "line-2").returncode, 0)
        wait_for(lambda: self.status(station, line) == 401, "the end of the key")
        again = self.token(self.centre, "line-2", "operator")
        wait_for(lambda: self.status(station, again) == 201, "the new key")
        answers = {}
        for token in (again, viewer, key_file.read_text()):
            # The centre reads its own keys every two seconds, and may have handed one on before.
            ask = lambda of=token: self.centre.get("/v1/log/revisions", Authorization=f"Bearer {of}")  # noqa: E731
            answers[token] = wait_for(lambda: (found := ask()).status != 401 and found, "the key at the centre")
        self.assertEqual([answer.status for answer in answers.values()], [403, 403, 200], "stations alone may ask")
        for token in (line, viewer, admin, both, again):
            self.assertNotIn(token, answers[key_file.read_text()].text)
        self.assert_clean(station)


class Corrections(Centre):
    def correct(self, daemon, record, value):
        answer = daemon.post(f"/v1/measurements/{record['id']}/corrections", {"measured_mm": value, "reason": "misread"})
        self.assertEqual(answer.status, 201, answer)
        return answer.json

    def current(self, daemon):
        return [record["id"] for record in daemon.get("/v1/measurements").json["measurements"]]

    def wait_until_same(self, station, count):
        wait_for(lambda: len(records_of(station)) == count == len(records_of(self.centre)), f"{count} rows at both")
        wait_for(lambda: metric(station, "fitgauge_outbox_rows") == 0, "an empty outbox")

    def test_a_correction_at_the_centre_reaches_the_station(self):
        station = self.station().start()
        other = self.station().start()
        first = station.measure({**PART, "part_id": "P-1"}).json
        foreign = other.measure(PART).json
        wait_for(lambda: len(records_of(self.centre)) == 2, "the records at the centre")
        own = self.centre.measure(PART).json
        self.correct(self.centre, own, 25.001)
        correction = self.correct(self.centre, first, 25.002)
        wait_for(lambda: station.get(f"/v1/measurements/{correction['id']}").status == 200, "the correction")
        self.assertEqual(station.get(f"/v1/measurements/{first['id']}").json["corrected_by"], correction["id"])
        self.assertEqual(station.get(f"/v1/measurements/{correction['id']}").json, correction)
        self.assertEqual(self.current(station), [correction["id"]])
        self.assertEqual(station.get(f"/v1/measurements/{correction['id']}/proof").status, 404)
        self.assertEqual(len(records_of(other)), 1, "it is none of the other's")
        # The station corrects it, the centre that one; what is of this folder goes on in its log.
        second = self.correct(station, correction, 25.003)
        wait_for(lambda: self.centre.get(f"/v1/measurements/{second['id']}").status == 200, "the second")
        third = self.correct(self.centre, second, 25.004)
        wait_for(lambda: self.current(station) == [third["id"]], "the third")
        station.measure([PART] * 3)
        wait_for(lambda: metric(station, "fitgauge_outbox_rows") == 0, "an empty outbox")
        self.assertEqual(station.get("/v1/measurements?order=none").json["measurements"], [])
        station.kill()
        station.start()
        station.measure(PART)
        wait_for(lambda: metric(station, "fitgauge_outbox_rows") == 0, "an empty outbox")
        self.assertNotIn(foreign["id"], self.current(station))
        self.assert_clean(station, other, self.centre)
        for daemon in (station, self.centre):
            self.assertNotIn('"conflict"', "".join(records_of(daemon)))

    def test_corrections_made_apart_are_both_kept_and_the_later_one_stands(self):
        for later_at_station in (True, False):
            with self.subTest(later_at_station=later_at_station):
                station = self.station().start()
                first = station.measure(PART).json
                wait_for(lambda: self.centre.get(f"/v1/measurements/{first['id']}").status == 200, "the record")
                station.stop()
                flags, station.flags = station.flags, []
                station.start()  # alone
                at_both = [self.centre, station] if later_at_station else [station, self.centre]
                lost, stands = (self.correct(daemon, first, 25.001 + i / 1000) for i, daemon in enumerate(at_both))
                station.stop()
                station.flags = flags
                station.start()
                for daemon in (station, self.centre):
                    for record in (lost, stands):
                        wait_for(lambda at=daemon, one=record: at.get(f"/v1/measurements/{one['id']}").json.get(
                            "conflict"), "the conflict")
                    self.assertEqual(daemon.get(f"/v1/measurements/{first['id']}").json["corrected_by"], stands["id"])
                    ids = {record["id"]: record for record in map(json.loads, records_of(daemon))}
                    self.assertTrue(ids[lost["id"]]["conflict"] and ids[stands["id"]]["conflict"])
                    self.assertNotIn("conflict", ids[first["id"]])
                    current = self.current(daemon)
                    self.assertIn(stands["id"], current)
                    self.assertFalse({lost["id"], first["id"]} & set(current))
                    self.assertEqual(len(current), daemon.get("/v1/measurements/summary?group_by=part_id").json[
                        "groups"][0]["count"])
                    for record in (lost, first):
                        answer = daemon.post(f"/v1/measurements/{record['id']}/corrections",
                                             {"measured_mm": 25, "reason": "late"})
                        self.assertEqual((answer.status, answer.json["code"]), (409, "measurement.corrected"))
                # Who corrects the one that stands ends it.
                last = self.correct(self.centre, stands, 25.005)
                wait_for(lambda: station.get(f"/v1/measurements/{last['id']}").status == 200, "the last")
                self.assertNotIn("conflict", station.get(f"/v1/measurements/{last['id']}").json)
                self.assertEqual(self.current(station), [last["id"]])
                self.assert_clean(station, self.centre)


if __name__ == "__main__":
    unittest.main()
