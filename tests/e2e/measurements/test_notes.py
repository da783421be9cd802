"""Notes beside measurements, and the catalogues of causes and measures."""

import sqlite3
import threading
import unittest
import urllib.request

from support.daemon import Daemon, DaemonTest
from support.waiting import PATIENCE

VALUE = {"designation": "25 H7", "measured_mm": "25.05", "part_id": "SN-1", "characteristic": "bore-A"}
WORN = {"cause": "Insert worn", "measure": "Insert changed", "operator": "Kim"}
CATALOGUE = {"causes": ["Insert worn", "Clamped askew"], "measures": ["Insert changed"]}


class Notes(DaemonTest):
    def record(self, **fields):
        return self.daemon.request("POST", "/v1/measurements", {**VALUE, **fields}).json

    def note(self, record, note, **headers):
        return self.daemon.request("POST", f"/v1/measurements/{record['id']}/notes", note, headers=headers)

    def notes(self, record):
        return self.daemon.request("GET", f"/v1/measurements/{record['id']}/notes").json["notes"]

    def test_a_note_stands_beside_its_record_which_stays_as_it_is(self):
        record = self.record()
        proof = self.daemon.request("GET", f"/v1/measurements/{record['id']}/proof").json
        answer = self.note(record, WORN)
        self.assertEqual(answer.status, 201)
        note = answer.json
        self.assertEqual({name: note[name] for name in WORN}, WORN)
        self.assertEqual(note["measurement_id"], record["id"])
        self.assertRegex(note["received_at"], r"^20..-..-..T.*Z$")
        second = self.note(record, {"text": "again after the break"}).json
        self.assertEqual(self.notes(record), [note, second])
        self.assertEqual(self.daemon.request("GET", f"/v1/measurements/{record['id']}").json, record)
        self.assertEqual(self.daemon.request("GET", f"/v1/measurements/{record['id']}/proof").json["leaf"], proof["leaf"])
        self.assertEqual(self.notes(self.record(part_id="SN-2")), [])

    def test_a_repeat_adds_none_and_another_body_is_refused(self):
        record = self.record()
        first, again = (self.note(record, WORN, **{"Idempotency-Key": '"note-1"'}) for _ in range(2))
        self.assertEqual((first.json, again.headers.get("idempotency-replayed")), (again.json, "true"))
        self.assert_problem(self.note(record, {"cause": "other"}, **{"Idempotency-Key": '"note-1"'}), 422, "idempotency.key_reused")
        self.assertEqual(len(self.notes(record)), 1)

    def test_every_bad_field_is_named_and_nothing_is_kept(self):
        record = self.record()
        for note, pointer, code in [
                ({}, "/cause", "field.missing"), ({"operator": "Kim"}, "/cause", "field.missing"),
                ({"cause": " "}, "/cause", "field.invalid"), ({"cause": "x" * 201}, "/cause", "field.too_long"),
                ({"text": "x" * 2001}, "/text", "field.too_long"), ({"measure": 7}, "/measure", "field.type"),
                ({**WORN, "caller": "me"}, "/caller", "field.unknown"), ({"cause": None}, "/cause", "field.type")]:
            answer = self.note(record, note)
            self.assert_problem(answer, 422, "request.invalid")
            self.assertIn((pointer, code), [(each["pointer"], each["code"]) for each in answer.json["errors"]])
        for field in ("cause", "measure", "text", "operator"):
            for text, detail in ((" ", "must not be blank"), ("a\0b", "must not contain a NUL character"),
                                 ("x" * 2001, f"must have at most {2000 if field == 'text' else 200} bytes")):
                refused = self.note(record, {**WORN, field: text}).json
                self.assertEqual((refused["detail"], refused["errors"][0]["pointer"]), (f"{field} {detail}", f"/{field}"))
        self.assertEqual(self.notes(record), [])
        for method, body in (("POST", WORN), ("GET", None)):
            for unknown in ("m999999", "m1-0123456789abcdef", "x"):
                answer = self.daemon.request(method, f"/v1/measurements/{unknown}/notes", body)
                self.assert_problem(answer, 404, "measurement.unknown")

    def test_lists_show_notes_when_asked_and_find_records_by_them(self):
        noted, other, plain = (self.record(order="N-1", part_id=f"SN-{i}") for i in range(3))
        self.note(noted, WORN)
        self.note(other, {"text": "looked at twice"})

        def listed(query):
            return self.daemon.request("GET", f"/v1/measurements?order=N-1{query}").json["measurements"]
        self.assertEqual(listed(""), [noted, other, plain])
        shown = listed("&notes=shown")
        self.assertEqual([len(record.get("notes", [])) for record in shown], [1, 1, 0])
        self.assertEqual(shown[0].pop("notes"), self.notes(noted))
        self.assertEqual(shown[0], noted)
        self.assertEqual([record["id"] for record in listed("&notes=only&sort=newest")], [other["id"], noted["id"]])
        self.assertEqual(listed("&cause=Insert+worn"), [noted])
        self.assertEqual(listed("&cause=insert"), [])
        groups = self.daemon.request("GET", "/v1/measurements/summary?order=N-1&cause=Insert+worn").json["groups"]
        self.assertEqual([group["count"] for group in groups], [1])
        lines = self.daemon.request("GET", "/v1/measurements?order=N-1&notes=shown&format=ndjson").body.decode().splitlines()
        self.assertEqual([line.count('"notes"') for line in lines], [1, 1, 0])

    def test_are_listed_by_the_time_they_were_received(self):
        old, new, plain = (self.record(order="N-2", part_id=f"SN-{i}") for i in range(3))
        first = self.note(old, {"text": "first"}).json["received_at"]
        second = self.note(new, WORN).json["received_at"]
        self.assertLess(first, second)

        def listed(query):
            return [m["id"] for m in self.daemon.get(f"/v1/measurements?order=N-2&{query}").json["measurements"]]
        self.assertEqual(listed(f"notes_from={first}"), [old["id"], new["id"]])
        self.assertEqual(listed(f"notes_from={second}&notes=shown"), [new["id"]])
        self.assertEqual(listed(f"notes_to={second}"), [old["id"]])
        self.assertEqual(listed(f"notes_from={first}&notes_to={first}"), [])
        self.assertEqual(listed(f"notes_from={first}&cause=Insert+worn&sort=newest"), [new["id"]])
        self.note(old, WORN)
        self.assertEqual(listed(f"notes_to={second}&cause=Insert+worn"), [], "the note in time names another cause")
        self.assert_problem(self.daemon.get("/v1/measurements?notes_from=now"), 400, "query.invalid")

    def test_is_told_as_an_event(self):
        record = self.record()
        heard = []
        stream = urllib.request.urlopen(f"http://127.0.0.1:{self.daemon.port}/v1/events", timeout=PATIENCE)

        def listen():
            for line in stream:
                if line.startswith(b"event:"):
                    heard.append(line.split()[1].decode())
                    return
        listener = threading.Thread(target=listen)
        stream.readline()  # it says where it stands
        listener.start()
        self.note(record, WORN)
        listener.join(PATIENCE)
        stream.close()
        self.assertEqual(heard, ["note.added"])

    def test_catalogues_are_documents(self):
        def call(method, body=None, name="turning"):
            return self.daemon.request(method, f"/v1/catalogues/{name}", body)
        self.assertEqual(call("PUT", CATALOGUE).status, 201)
        self.assertEqual(call("GET").json, CATALOGUE)
        self.assertEqual([each["name"] for each in self.daemon.request("GET", "/v1/catalogues").json["catalogues"]], ["turning"])
        for body, pointer, code in [
                ({"causes": []}, "/measures", "field.missing"), ({**CATALOGUE, "causes": ["a", "a"]}, "/causes/1", "field.conflict"),
                ({**CATALOGUE, "causes": [""]}, "/causes/0", "field.invalid"), ({**CATALOGUE, "causes": [1]}, "/causes/0", "field.type"),
                ({**CATALOGUE, "causes": ["x" * 201]}, "/causes/0", "field.too_long"), ({**CATALOGUE, "more": 1}, "/more", "field.unknown"),
                ({**CATALOGUE, "measures": [str(i) for i in range(501)]}, "/measures", "field.too_long")]:
            answer = call("PUT", body)
            self.assert_problem(answer, 422, "request.invalid")
            self.assertIn((pointer, code), [(each["pointer"], each["code"]) for each in answer.json["errors"]])
        self.assertEqual(call("DELETE").status, 204)
        self.assert_problem(call("GET"), 404, "catalogue.unknown")
        plan = {"characteristics": [{"name": "bore-A", "designation": "25 H7", "catalogue": "turning"}]}
        self.assertEqual(self.daemon.request("PUT", "/v1/plans/4711", plan).status, 201)


class KeptNotes(unittest.TestCase):
    def setUp(self):
        self.daemon = Daemon().start()
        self.addCleanup(self.daemon.cleanup)

    def test_the_database_refuses_to_change_them_and_verify_finds_who_did_it_anyway(self):
        record = self.daemon.request("POST", "/v1/measurements", VALUE).json
        self.daemon.request("POST", f"/v1/measurements/{record['id']}/notes", WORN)
        self.daemon.stop()
        database = sqlite3.connect(self.daemon.database)
        for change in ("UPDATE notes SET cause = 'none'", "DELETE FROM notes"):
            with self.assertRaisesRegex(sqlite3.DatabaseError, "a note is never"):
                database.execute(change)
        database.rollback()
        self.assertEqual(self.daemon.command("verify").returncode, 0)
        database.executescript("DROP TRIGGER notes_are_not_updated; UPDATE notes SET cause = 'none'")
        database.close()
        found = self.daemon.command("verify")
        self.assertNotEqual(found.returncode, 0)
        self.assertIn("notes", found.stdout + found.stderr)
