"""Webhooks: each measurement once at least, in order, signed, whatever the receiver and the power do."""

import base64
import contextlib
import hashlib
import hmac
import itertools
import json
import os
import pathlib
import shutil
import sqlite3
import ssl
import subprocess
import tempfile
import threading
import time
import unittest

from support.certificates import certificate
from support.daemon import Daemon
from support.receiver import Receiver
from support.waiting import PATIENCE, wait_for

SECRETS = ["whsec_" + base64.b64encode(bytes(range(first, first + 32))).decode() for first in (0, 100)]
PRIVATE = ("--allow-private-addresses",)
SOURCES = pathlib.Path(__file__).parent / "webhooks"
OUTAGE_S = int(os.environ.get("TESTS_OUTAGE_S", "0"))


def part(number, measured="25.01", **more):
    return {"designation": "25 H7", "measured_mm": measured, "part_id": f"P{number}", **more}


def signature(secret, headers, body):
    """Worked out here after the specification, "Signature scheme"."""
    key = base64.b64decode(secret.removeprefix("whsec_"))
    content = b".".join([headers["webhook-id"].encode(), headers["webhook-timestamp"].encode(), body])
    return "v1," + base64.b64encode(hmac.new(key, content, hashlib.sha256).digest()).decode()


class Receivers(unittest.TestCase):
    def receiver(self, *arguments, **named):
        receiver = Receiver(*arguments, **named)
        self.addCleanup(receiver.close)
        return receiver

    def daemon(self, *flags):
        daemon = Daemon(*(flags or PRIVATE))
        self.addCleanup(daemon.cleanup)
        return daemon.start()

    def connect(self, daemon, receiver, status=201, name="mes", **more):
        answer = daemon.request("PUT", f"/v1/connections/{name}", {
            "kind": "webhook", "url": receiver.url, "secrets": SECRETS[:1], "longest_wait_s": 1, **more})
        self.assertEqual(answer.status, status, answer)
        return answer.json

    def state(self, daemon, name="mes"):
        return daemon.get(f"/v1/connections/{name}").json

    def wait_for_kept_position(self, daemon, position, name="mes"):
        """Until the database has how far a connection came: what it shows it keeps within a second."""
        def kept():
            with contextlib.closing(sqlite3.connect(f"file:{daemon.database}?mode=ro", uri=True)) as database:
                texts = database.execute("SELECT text FROM documents WHERE name = ?", (name,)).fetchall()
            return any(json.loads(text).get("position") == position for text, in texts)
        wait_for(kept, lambda: self.state(daemon, name))

    def store(self, daemon, numbers, **more):
        return [daemon.measure(part(number, **more)).json["id"] for number in numbers]


class Webhooks(Receivers):
    def test_what_is_stored_is_told_in_order_and_signed(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.store(daemon, range(3))  # before the connection: not told
        made = self.connect(daemon, receiver, secrets=SECRETS)
        self.assertEqual((made["direction"], made["secret_count"], made["position"]), ("out", 2, 3))
        self.assertNotIn("secrets", made)
        ids = self.store(daemon, range(3, 20))
        receiver.wait(lambda: len(receiver.events) == 17)
        self.assertEqual(receiver.ids(), ids)
        for request, number in zip(receiver.events, range(3, 20)):
            headers, event = request["headers"], request["event"]
            self.assertEqual(headers["webhook-signature"].split(),
                             [signature(secret, headers, request["body"]) for secret in SECRETS])
            self.assertEqual(headers["content-type"], "application/json")
            self.assertLess(abs(int(headers["webhook-timestamp"]) - time.time()), 600)
            self.assertEqual((event["type"], event["data"]["part_id"], event["timestamp"]),
                             ("measurement.recorded", f"P{number}", event["data"]["received_at"]))
        record = daemon.get(f"/v1/measurements/{ids[0]}").json
        self.assertEqual(receiver.events[0]["event"]["data"], record)
        receiver.wait(lambda: self.state(daemon)["position"] == 20)
        state = self.state(daemon)
        self.assertEqual((state["state"], state["position"], state["behind"], state["measurements"], state["last_error"]),
                         ("ok", 20, 0, 17, None))
        self.assertIn('fitgauge_connection_behind_measurements{connection="mes"} 0', daemon.get("/metrics").text)
        self.assertNotIn(SECRETS[0], daemon.get("/v1/connections").text + daemon.log)

    def happen(self, daemon, number):
        """A measurement, a run, a note and a changed table. Returns what is told of them, in order."""
        measured = self.store(daemon, [number])[0]
        program = f"0 BEGIN PGM p{number} MM\n1 Q1 = {number}\n2 END PGM p{number} MM\n"
        self.assertIn(daemon.request("PUT", f"/v1/files/p{number}.h", program.encode()).status, (200, 201))
        run = daemon.post("/v1/runs?wait=1", {"program": f"p{number}.h"}).json
        self.assertEqual(daemon.post(f"/v1/measurements/{measured}/notes", {"text": f"note {number}"}).status, 201)
        column = f"press{number}"
        rows = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": 3}]}
        self.assertEqual(daemon.request("PUT", f"/v1/tables/shaft/classes/{column}", rows).status, 201)
        return [("measurement.recorded", measured), ("run.finished", run["id"]), ("note.added", f"note {number}"), ("table.changed", column)]

    def told(self, receiver, requests=None):
        names = {"measurement.recorded": "id", "run.finished": "id", "note.added": "text", "table.changed": "tolerance_class"}
        events = [request["event"] for request in (receiver.events if requests is None else requests)]
        return [(event["type"], event["data"][names[event["type"]]]) for event in events]

    def test_runs_notes_and_tables_are_told_where_they_are_asked_for(self):
        names = ["measurement.recorded", "run.finished", "table.changed", "note.added"]
        receiver, plain, runs, daemon = self.receiver(), self.receiver(), self.receiver(), self.daemon()
        self.happen(daemon, 0)
        self.connect(daemon, receiver, events=names, filter={"verdict": ["good"]})
        self.connect(daemon, plain, name="plain")
        self.connect(daemon, runs, name="runs", events=["run.finished"])
        happened = [each for number in range(1, 4) for each in self.happen(daemon, number)]
        receiver.wait(lambda: len(receiver.events) >= 12)
        runs.wait(lambda: len(runs.events) >= 3)
        plain.wait(lambda: len(plain.events) >= 3)
        # Each kind in its order; an event comes behind the measurements before it.
        self.assertEqual(sorted(self.told(receiver)), sorted(happened))
        for kinds in (names[:1], names[1:]):
            self.assertEqual([each for each in self.told(receiver) if each[0] in kinds], [each for each in happened if each[0] in kinds])
        for at, each in enumerate(happened):
            before = [other for other in happened[:at] if other[0] == "measurement.recorded"]
            self.assertLessEqual(set(before), set(self.told(receiver)[:self.told(receiver).index(each)]))
        self.assertEqual(self.told(plain), [each for each in happened if each[0] == "measurement.recorded"])
        self.assertEqual(self.told(runs), [each for each in happened if each[0] == "run.finished"])
        for request in receiver.events:
            headers = request["headers"]
            self.assertEqual(headers["webhook-signature"], signature(SECRETS[0], headers, request["body"]))
        self.assertEqual(len(set(receiver.ids())), 12)
        receiver.wait(lambda: self.state(daemon)["measurements"] == 3)
        bad = daemon.request("PUT", "/v1/connections/bad", {"kind": "webhook", "url": receiver.url, "secrets": SECRETS, "events": ["run.began"]})
        self.assertEqual((bad.status, bad.json["errors"][0]["pointer"]), (422, "/events"))

    def make(self, daemon, level_um, count, characteristic="bore", machine="M1", **more):
        """Parts about a level from the middle of 25 H7. Returns the id of the last."""
        scatter = (0.9, -1.1, 0.4, -0.2, 1.2, -0.7, -0.9, 0.3, 0.6, -0.5)
        rows = [{"designation": "25 H7", "measured_mm": f"{25.0105 + (level_um + scatter[i % 10]) / 1000:.4f}", "part_id": f"P{i}",
                 "characteristic": characteristic, "machine": machine, "tool": "T1", **more} for i in range(count)]
        stored = daemon.measure(rows, {"Prefer": "return=representation"})
        self.assertEqual(stored.status, 201, stored)
        return stored.json["measurements"][-1]["id"]

    def test_offsets_are_told_for_each_machine_when_their_state_is_another(self):
        receiver, other, daemon = self.receiver(), self.receiver(), self.daemon()
        self.make(daemon, 0, 20)  # before the connection: their offset comes with the next value
        offsets = ["compensation.changed", "compensation.failed"]
        self.connect(daemon, receiver, events=offsets, filter={"verdict": ["reject"]})
        self.connect(daemon, other, name="other", events=["measurement.recorded", offsets[0]], filter={"machine": "M2"})

        def next_told(state, newest, machine="M1"):
            receiver.wait(lambda: len(receiver.events) == len(told) + 1)
            request = receiver.events[-1]
            event = request["event"]
            told.append((event["type"], request["headers"]["webhook-id"]))
            self.assertEqual(told[-1], (offsets[state == "limits.mixed"], "c" + newest[1:]))
            self.assertEqual([event["data"][name] for name in ("characteristic", "machine")], ["bore", machine])
            self.assertEqual(event["data"].get("state", event["data"].get("code")), state)
            self.assertEqual(request["headers"]["webhook-signature"], signature(SECRETS[0], request["headers"], request["body"]))
            return event["data"]

        told = []
        next_told("wait", self.make(daemon, 0, 1))
        moved = next_told("propose", self.make(daemon, 8, 6))
        self.assertEqual(moved, daemon.get("/v1/measurements/compensation?characteristic=bore&machine=M1").json)
        next_told("wait", self.make(daemon, 0, 1, machine="M2"), "M2")
        self.wait_for_kept_position(daemon, 28)
        daemon.kill()
        daemon.start()
        # What was told is not kept: the state comes again with the next value, and is that of M1 alone.
        next_told("propose", self.make(daemon, 8, 1))
        next_told("limits.mixed", self.make(daemon, 0, 1, designation="25 H8"))
        other.wait(lambda: len(other.events) == 2)
        self.assertEqual([request["event"]["type"] for request in other.events], ["measurement.recorded", "compensation.changed"])
        self.assertEqual(self.state(daemon)["behind"], 0)

    def test_an_offset_that_nobody_takes_comes_again_and_measurements_without_a_characteristic_have_none(self):
        answers = [503, 204]
        receiver, daemon = self.receiver(lambda event: answers.pop(0) if answers else 204), self.daemon()
        self.connect(daemon, receiver, events=["compensation.changed"])
        self.store(daemon, range(3))
        newest = self.make(daemon, 8, 10)
        receiver.wait(lambda: receiver.events)
        self.assertEqual([request["headers"]["webhook-id"] for request in receiver.attempts], ["c" + newest[1:]] * 2)
        self.assertEqual(receiver.attempts[0]["body"], receiver.attempts[1]["body"])

    def test_events_go_on_where_they_stood_after_a_kill_and_what_is_refused_is_a_dead_letter(self):
        refused = []

        def answer(event):
            if event["type"] == "table.changed" and event["data"]["tolerance_class"] == "press2":
                return 422
            if not refused:
                refused.append(event)
                return 500
            return 204

        receiver, daemon = self.receiver(answer), self.daemon()
        names = ["measurement.recorded", "run.finished", "table.changed", "note.added"]
        self.connect(daemon, receiver, events=names)
        happened = []
        for number in range(1, 6):
            happened += self.happen(daemon, number)
            if number % 2 == 0:
                daemon.kill()
                daemon.start()
        happened.remove(("table.changed", "press2"))
        receiver.wait(lambda: len(receiver.distinct()) >= len(happened))
        first = {request["headers"]["webhook-id"]: request for request in reversed(receiver.events)}
        told = self.told(receiver, [first[each] for each in receiver.distinct()])
        self.assertEqual(sorted(told), sorted(happened))
        self.assertEqual([each for each in told if each[0] != "measurement.recorded"],
                         [each for each in happened if each[0] != "measurement.recorded"])
        # A page's dead letters are kept when its last event is told.
        receiver.wait(lambda: self.state(daemon)["dead_letters"])
        letters = self.state(daemon)["dead_letters"]
        self.assertEqual([letter["reason"] for letter in letters], ["the receiver answers 422"])
        self.assertRegex(letters[0]["measurement"], "^e[0-9]+-[0-9a-f]{16}$")

    def test_a_receiver_that_fails_and_stalls_gets_all_in_order(self):
        script = [500, 503, "stall", 429, 404, 302, 401, 500]

        def answer(event):
            if event["data"]["part_id"] in ("P4", "P9") and script:
                said = script.pop(0)
                if said == "stall":
                    time.sleep(2)
                    said = 500
                return (said, {"Retry-After": "1", "Location": "/elsewhere"})
            return 200

        receiver, daemon = self.receiver(answer), self.daemon()
        self.connect(daemon, receiver, timeout_s=1)
        ids = self.store(daemon, range(12))
        receiver.wait(lambda: self.state(daemon)["state"] == "failing")
        self.assertRegex(self.state(daemon)["last_error"], "the receiver answers [345]|imed out|imeout")
        receiver.wait(lambda: len(receiver.distinct()) == 12)
        self.assertEqual(receiver.distinct(), ids)
        self.assertEqual(script, [])
        receiver.wait(lambda: "connection_failing" in daemon.log)
        receiver.wait(lambda: "connection_recovered" in daemon.log)
        self.assertEqual(self.state(daemon)["dead_letters"], [])

    def test_a_passing_refusal_is_repeated_at_once(self):
        """Finding 7b of the review: each 503 of a busy receiver cost a second and showed `failing`."""
        refused = set()

        def answer(event):
            part = event["data"]["part_id"]
            if int(part[1:]) % 10 == 0 and part not in refused:
                refused.add(part)
                return 503
            return 204

        receiver, daemon = self.receiver(answer), self.daemon()
        self.connect(daemon, receiver, longest_wait_s=300)
        ids = self.store(daemon, range(1, 61))
        receiver.wait(lambda: len(receiver.distinct()) == 60)
        self.assertEqual(receiver.ids(), ids)
        receiver.wait(lambda: self.state(daemon)["position"] == 60)
        state = self.state(daemon)
        self.assertEqual((state["state"], state["failures"], state["attempt_began_at"]), ("ok", 6, None))
        self.assertNotIn("connection_failing", daemon.log)

    def test_an_attempt_that_is_under_way_says_since_when(self):
        held, may_go = threading.Event(), threading.Event()

        def answer(_):
            held.set()
            may_go.wait(PATIENCE)
            return 204

        receiver, daemon = self.receiver(answer), self.daemon()
        self.addCleanup(may_go.set)
        made = self.connect(daemon, receiver, timeout_s=30)
        self.assertIsNone(made["attempt_began_at"])
        stored = daemon.measure(part(1)).json
        self.assertTrue(held.wait(PATIENCE))
        self.assertGreaterEqual(self.state(daemon)["attempt_began_at"], stored["received_at"][:19])
        may_go.set()
        receiver.wait(lambda: self.state(daemon)["attempt_began_at"] is None)

    def test_own_headers_are_sent_and_never_shown(self):
        receiver, daemon = self.receiver(), self.daemon()
        headers = {"Authorization": "Bearer s3cret", "X-Plant": "press-3"}
        made = self.connect(daemon, receiver, headers=headers)
        self.assertEqual(made["headers"], {"Authorization": None, "X-Plant": None})

        def sent(number):
            daemon.measure(part(number))
            receiver.wait(lambda: len(receiver.events) == number)
            return {name: receiver.events[-1]["headers"].get(name.lower()) for name in headers}

        self.assertEqual(sent(1), headers)
        self.connect(daemon, receiver, 200)  # they stay when they are not named
        self.assertEqual(sent(2), headers)
        self.connect(daemon, receiver, 200, headers={"Authorization": None, "X-Plant": "press-4"})
        self.assertEqual(sent(3), {**headers, "X-Plant": "press-4"})
        # Nobody who does not know them may send them elsewhere.
        elsewhere = {"kind": "webhook", "url": receiver.url + "&x=1", "secrets": SECRETS[:1]}
        answer = daemon.request("PUT", "/v1/connections/mes", {**elsewhere, "headers": {"Authorization": None}})
        self.assertEqual([e["pointer"] for e in answer.json["errors"]], ["/headers/Authorization"])
        self.assertEqual(daemon.request("PUT", "/v1/connections/mes", elsewhere).status, 200)
        self.assertEqual(sent(4), {"Authorization": None, "X-Plant": None})
        shown = daemon.get("/v1/connections").text + daemon.log
        self.assertNotIn("s3cret", shown)
        self.assertNotIn("press-4", shown)

    def test_a_body_of_its_own(self):
        receiver, daemon = self.receiver(), self.daemon()
        body = {"text": 'Part "{{part_id}}": {{measured_mm}} mm', "value": "{{measured_mm}}", "order": "{{order}}",
                "note": "{{order}}-", "of": ["{{id}}", "{{type}}", "{{data.verdict}}"], "all": "{{data}}"}
        self.connect(daemon, receiver, body=body)
        stored = daemon.measure(part(1, part_id='a"b\\')).json
        receiver.wait(lambda: receiver.events)
        request = receiver.events[0]
        self.assertEqual(request["event"], {
            "text": 'Part "a"b\\": 25.01 mm', "value": 25.01, "order": None, "note": "-",
            "of": [stored["id"], "measurement.recorded", "good"], "all": stored})
        self.assertEqual(request["headers"]["webhook-signature"],
                         signature(SECRETS[0], request["headers"], request["body"]))
        self.connect(daemon, receiver, 200, body='{"v": {{measured_mm}}, "s": "{{measured_mm}}.", "n": {{none}}}')
        daemon.measure(part(2))
        receiver.wait(lambda: len(receiver.events) == 2)
        self.assertEqual(receiver.events[1]["event"], {"v": 25.01, "s": "25.01.", "n": None})
        self.assertTrue(daemon.post("/v1/connections/mes/test", None).json["ok"])
        for wrong in ("{", '{"a": {{part id}}}', {"a": "{{part_id"}, '{"{{measured_mm}}": 1}', "", "x" * 20_000):
            answer = daemon.request("PUT", "/v1/connections/mes", {
                "kind": "webhook", "url": receiver.url, "secrets": SECRETS[:1], "body": wrong})
            self.assertEqual([e["pointer"] for e in answer.json["errors"]], ["/body"], wrong)

    def test_replay_sends_again_from_a_place(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver, events=["measurement.recorded", "note.added"])
        records = [daemon.measure(part(number)).json for number in range(6)]
        ids = [record["id"] for record in records]
        self.assertEqual(daemon.post(f"/v1/measurements/{ids[0]}/notes", {"text": "seen"}).status, 201)
        receiver.wait(lambda: len(receiver.events) == 7)
        note = receiver.ids()[-1]

        def replayed(place, expected):
            count = len(receiver.events)
            answer = daemon.post("/v1/connections/mes/replay", {"from": place})
            self.assertEqual((answer.status, answer.json.get("name")), (200, "mes"), answer)
            receiver.wait(lambda: len(receiver.events) >= count + len(expected))
            self.assertEqual(receiver.ids()[count:], expected)

        replayed(ids[3], ids[3:])
        replayed(note, [note])
        replayed(records[4]["received_at"], [*ids[4:], note])
        replayed("2000-01-01T00:00:00Z", [*ids, note])
        for wrong in ("yesterday", "m99-0000000000000000", ""):
            answer = daemon.post("/v1/connections/mes/replay", {"from": wrong})
            self.assertEqual((answer.status, [e["pointer"] for e in answer.json["errors"]]), (422, ["/from"]), wrong)
        self.assertEqual(daemon.post("/v1/connections/none/replay", {"from": ids[0]}).status, 404)
        daemon.measure(part(7))
        receiver.wait(lambda: len(receiver.distinct()) == 8)

    def test_killed_and_started_again_nothing_is_lost(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver)
        ids = []
        for round_of in range(4):
            ids += self.store(daemon, range(round_of * 20, round_of * 20 + 20))
            if round_of == 1:
                receiver.wait(lambda: len(receiver.events) > 25)
            daemon.kill()
            daemon.start()
        receiver.wait(lambda: len(receiver.distinct()) == 80)
        self.assertEqual(receiver.distinct(), ids)  # a repeat has the id it had
        self.wait_for_kept_position(daemon, 80)
        daemon.kill()
        told = len(receiver.events)
        daemon.start()
        ids += self.store(daemon, [80])
        receiver.wait(lambda: receiver.ids()[-1:] == ids[-1:])
        self.assertEqual(len(receiver.events), told + 1)  # it was kept how far it came

    def test_writers_do_not_wait_for_it(self):
        receiver, daemon = self.receiver(lambda event: time.sleep(600) or 500), self.daemon()
        self.connect(daemon, receiver, timeout_s=30)
        self.store(daemon, range(1))
        receiver.wait(lambda: receiver.attempts)
        self.store(daemon, range(1, 10))
        self.assertEqual(len(receiver.attempts), 1)  # of 30 s: none of them has waited for it
        receiver.wait(lambda: self.state(daemon)["behind"] >= 1)
        self.assertEqual(daemon.stop(), 0)  # nor does the end of the service

    def test_what_it_does_not_understand_becomes_a_dead_letter(self):
        receiver, daemon = self.receiver(lambda event: 422 if event["data"]["part_id"] == "P1" else 200), self.daemon()
        self.connect(daemon, receiver)
        ids = self.store(daemon, range(3))
        receiver.wait(lambda: len(receiver.events) == 2)
        self.assertEqual(receiver.ids(), [ids[0], ids[2]])
        self.assertEqual(sum(r["event"]["data"]["part_id"] == "P1" for r in receiver.attempts), 5)
        self.wait_for_kept_position(daemon, 3)
        daemon.kill()
        daemon.start()
        state = self.state(daemon)
        self.assertEqual([(e["measurement"], e["reason"]) for e in state["dead_letters"]],
                         [(ids[1], "the receiver answers 422")])
        self.assertEqual(state["refused"], 1)

    def test_gone_is_for_ever(self):
        receiver, daemon = self.receiver(lambda event: 410), self.daemon()
        self.connect(daemon, receiver)
        self.store(daemon, range(2))
        receiver.wait(lambda: self.state(daemon)["state"] == "stopped")
        self.assertEqual(len(receiver.attempts), 1)
        receiver.answer = lambda event: 200
        self.connect(daemon, receiver, 200)  # stored again it goes on where it stood
        receiver.wait(lambda: len(receiver.events) == 2)

    def test_the_filter_decides(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver, filter={"machine": "M3", "verdict": ["reject", "rework"]})
        self.store(daemon, [1], measured="25.03")
        self.store(daemon, [2], machine="M3")
        ids = self.store(daemon, [3], measured="25.03", machine="M3") + self.store(daemon, [4], measured="24.9", machine="M3")
        self.store(daemon, [5], machine="M3")
        receiver.wait(lambda: self.state(daemon)["position"] == 5)
        self.assertEqual(receiver.ids(), ids)
        late = self.receiver()
        self.connect(daemon, late, name="late", start="beginning", filter={"part_id": "P2"})
        late.wait(lambda: len(late.events) == 1)

    def test_a_correction_is_told_too(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver)
        first = self.store(daemon, [1])[0]
        second = daemon.post(f"/v1/measurements/{first}/corrections", {"measured_mm": "25.02", "reason": "misread"}).json["id"]
        receiver.wait(lambda: len(receiver.events) == 2)
        self.assertEqual(receiver.ids(), [first, second])
        self.assertEqual(receiver.events[1]["event"]["data"]["correction_of"], first)

    def test_secrets_change_while_it_works(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver)
        both = self.connect(daemon, receiver, 200, secrets=SECRETS)
        self.assertEqual(both["secret_count"], 2)
        body = {"kind": "webhook", "url": receiver.url, "timeout_s": 5}  # without secrets: those there are
        self.assertEqual(daemon.request("PUT", "/v1/connections/mes", body).json["secret_count"], 2)
        self.store(daemon, [1])
        receiver.wait(lambda: receiver.events)
        self.assertEqual(len(receiver.events[0]["headers"]["webhook-signature"].split()), 2)
        problem = daemon.request("PUT", "/v1/connections/new", body)
        self.assertEqual((problem.status, problem.json["errors"][0]["pointer"]), (422, "/secrets"))

    def test_the_test_button(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver)
        self.assertEqual(daemon.post("/v1/connections/mes/test", None).json, {"ok": True, "detail": "the receiver answers 204"})
        request = receiver.events[0]
        self.assertEqual(request["event"]["type"], "connection.test")
        self.assertEqual(request["headers"]["webhook-signature"], signature(SECRETS[0], request["headers"], request["body"]))
        receiver.answer = lambda event: 503
        self.assertEqual(daemon.post("/v1/connections/mes/test", None).json, {"ok": False, "detail": "the receiver answers 503"})

    def test_no_private_address_unless_allowed(self):
        receiver = self.receiver()
        daemon = self.daemon("--event-retention", "1000")
        for number, host in enumerate(("localhost", "127.0.0.1", "[::1]", "0.0.0.0", "[::ffff:127.0.0.1]", "2130706433", "0x7f.1")):
            body = {"kind": "webhook", "url": f"http://{host}:{receiver.server.server_address[1]}/", "secrets": SECRETS[:1]}
            answer = daemon.request("PUT", f"/v1/connections/n{number}", body)
            self.assertEqual(answer.status, 201, answer)
            said = daemon.post(f"/v1/connections/n{number}/test", None).json
            self.assertFalse(said["ok"], host)
            self.assertRegex(said["detail"], "private network|resolve host", host)
        self.assertEqual(receiver.attempts, [])

    def test_a_certificate_nobody_vouches_for_is_refused(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        files = certificate(pathlib.Path(folder.name), "shop", 1)
        tls = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        tls.load_cert_chain(*files)
        receiver, daemon = self.receiver(tls=tls), self.daemon()
        self.connect(daemon, receiver)
        said = daemon.post("/v1/connections/mes/test", None).json
        self.assertFalse(said["ok"])
        self.assertIn("certificate", said["detail"])
        self.assertEqual(receiver.attempts, [])

    def test_bad_settings_are_named(self):
        daemon = self.daemon()
        problem = daemon.request("PUT", "/v1/connections/x", {
            "kind": "webhook", "url": "ftp://h/", "secrets": ["whsec_x"], "filter": {"verdict": ["bad"], "colour": "red"},
            "start": "soon", "timeout_s": 31})
        self.assertEqual((problem.status, sorted(e["pointer"] for e in problem.json["errors"])),
                         (422, ["/filter/colour", "/filter/verdict", "/secrets/0", "/start", "/timeout_s", "/url"]))
        for url in ("http://name:word@host/", "no address at all", "file:///etc/passwd", "//host"):
            problem = daemon.request("PUT", "/v1/connections/x", {"kind": "webhook", "url": url, "secrets": SECRETS[:1]})
            self.assertEqual([e["pointer"] for e in problem.json["errors"]], ["/url"], url)


@unittest.skipUnless(os.environ.get("TESTS_DEEP") and shutil.which("npm"), "TESTS_DEEP=1 and npm run it")
class Verifiers(Receivers):
    """The packages standardwebhooks and svix accept what is sent, and nothing else."""

    def test_they_accept_what_is_sent(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-webhooks-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        shutil.copytree(SOURCES, folder, dirs_exist_ok=True)
        subprocess.run(["npm", "install", "--no-package-lock", "--no-audit", "--no-fund", "--ignore-scripts",
                        "--loglevel=error"], cwd=folder, check=True, timeout=240)
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver, secrets=SECRETS)
        self.store(daemon, range(20), comment="Ø 25 \U0001f527 \"quoted\" \\ \u0001")
        receiver.wait(lambda: len(receiver.events) == 20)
        lines = [json.dumps({"secret": secret, "body": request["body"].decode(), "headers": request["headers"]})
                 for request in receiver.events for secret in SECRETS]
        done = subprocess.run(["node", "verify.mjs"], cwd=folder, input="\n".join(lines), capture_output=True, text=True,
                              check=True, timeout=120)
        self.assertEqual(sorted(set(done.stdout.split("\n"))), ["", "standard ok", "svix ok"], done.stdout + done.stderr)
        self.assertEqual(done.stdout.count("ok"), 80)


@unittest.skipUnless(os.environ.get("TESTS_DEEP") or OUTAGE_S, "TESTS_DEEP=1 or TESTS_OUTAGE_S=3600 runs it")
class Outage(Receivers):
    def test_errors_and_stalls_for_an_hour_lose_nothing(self):
        """An hour, as TESTS_OUTAGE_S says, with waits of two minutes and stalls longer than the time-out. By itself it
        is a minute, with waits of two seconds."""
        lasting = OUTAGE_S or 60
        wait, timeout = max(1, lasting // 30), max(1, lasting // 240)
        answers = itertools.cycle([500, "stall", 503, 502])
        over = threading.Event()

        def answer(_):
            if over.is_set():
                return 200
            said = next(answers)
            if said == "stall":
                time.sleep(3 * timeout)
            return 500 if said == "stall" else said

        receiver, daemon = self.receiver(answer), self.daemon()
        self.connect(daemon, receiver, longest_wait_s=wait, timeout_s=timeout)
        ids = []
        end = time.monotonic() + lasting
        while time.monotonic() < end:
            ids += self.store(daemon, range(len(ids), len(ids) + 5))
            time.sleep(lasting / 120)
        told = len(receiver.attempts)
        self.assertEqual(receiver.events, [])
        over.set()
        receiver.wait(lambda: len(receiver.distinct()) == len(ids), seconds=PATIENCE + 2 * wait)
        self.assertEqual(receiver.distinct(), ids)
        self.assertEqual(self.state(daemon)["dead_letters"], [])
        print(f"{lasting} s: {len(ids)} measurements, {told} attempts meanwhile, all delivered in order afterwards", flush=True)
        # One in each wait, or in what a stall takes: neither given up nor a storm.
        self.assertTrue(15 < told < 60, told)


if __name__ == "__main__":
    unittest.main()
