"""Webhooks: each measurement once at least, in order, signed, whatever the receiver and the power do."""

import itertools
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import threading
import time
import unittest

from support.waiting import PATIENCE, wait_for
from support.webhooks import PRIVATE, SECRETS, Receivers, part, signature

SOURCES = pathlib.Path(__file__).parent / "webhooks"
OUTAGE_S = int(os.environ.get("TESTS_OUTAGE_S", "0"))


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
        ids = self.store(daemon, range(5))
        self.assertRegex(daemon.connection_in("mes", "failing")["last_error"], "the receiver answers [345]|imed out|imeout")
        ids += self.store(daemon, range(5, 12))
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
            receiver.wait(lambda: receiver.ids()[count:][-len(expected):] == expected)
            # One whose answer was still under way comes once more.
            self.assertIn(receiver.ids()[count:-len(expected)], ([], receiver.ids()[count - 1:count]))

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

    def test_the_answer_to_a_replay_counts_what_is_sent_again(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver)
        first, *_ = self.store(daemon, range(3))
        self.wait_for_kept_position(daemon, 3)
        receiver.answer = lambda event: 503
        answer = daemon.post("/v1/connections/mes/replay", {"from": first}).json
        self.assertEqual((answer["position"], answer["behind"]), (0, 3))

    def test_a_replay_from_before_the_oldest_event_begins_with_that(self):
        receiver, daemon = self.receiver(), self.daemon(*PRIVATE, "--event-retention", "100")
        self.connect(daemon, receiver, events=["measurement.recorded", "note.added"])
        row, = self.store(daemon, [1])
        for number in range(1, 251):
            self.assertEqual(daemon.post(f"/v1/measurements/{row}/notes", {"text": "seen"}).status, 201)
            if number % 50 == 0:
                receiver.wait(lambda: len(receiver.distinct()) == number + 1)
        sent = receiver.distinct()

        def replayed(place):
            count = len(receiver.events)
            self.assertEqual(daemon.post("/v1/connections/mes/replay", {"from": place}).status, 200)
            receiver.wait(lambda: receiver.ids()[count:][-1:] == sent[-1:])
            return receiver.ids()[count:]

        kept = wait_for(lambda: len(again := replayed(sent[1])) <= 101 and again, "the purge")
        self.assertEqual(kept[-100:], sent[-100:])
        wait_for(lambda: "the next events were removed" in daemon.log, "the line of the log")
        self.assertEqual([name for name in replayed("2000-01-01T00:00:00Z") if name == row], [row])

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
