"""Idempotency keys: a request that is sent again is stored once and answered the same."""

import collections
import json
import threading

from support.daemon import DaemonTest

PART = {"designation": "25 H7", "measured_mm": 25.013, "part_id": "SN-1"}


def key(text):
    return {"Idempotency-Key": text}


class Repeats(DaemonTest):
    def count(self):
        return len(self.daemon.stored())

    def test_a_repeat_replays_the_answer(self):
        for headers in ({}, {"Prefer": "return=representation"}, {"Prefer": "return=minimal"}):
            for body in (PART, [PART, PART]):
                with self.subTest(headers=headers, body=body):
                    name = f"replay-{self.count()}"
                    first = self.daemon.measure(body, {**headers, **key(name)})
                    count = self.count()
                    again = self.daemon.measure(body, {**headers, **key(name)})
                    self.assertEqual(first.status, 201, first)
                    self.assertEqual((first.status, first.body), (again.status, again.body))
                    for field in ("location", "content-type"):
                        self.assertEqual(first.headers.get(field), again.headers.get(field))
                    self.assertEqual(self.count(), count)

    def test_quoted_and_bare_are_one_key(self):
        first = self.daemon.measure(PART, key('"one"'))
        self.assertEqual(self.daemon.measure(PART, key("one")).body, first.body)

    def test_another_body_is_refused(self):
        self.daemon.measure(PART, key("reuse"))
        count = self.count()
        self.assert_problem(self.daemon.measure({**PART, "part_id": "SN-2"}, key("reuse")), 422,
                            "idempotency.key_reused")
        # The digest is of the raw body.
        self.assert_problem(self.daemon.measure(json.dumps(PART) + " ", {
            "Content-Type": "application/json", **key("reuse")}), 422, "idempotency.key_reused")
        self.assertEqual(self.count(), count)

    def test_only_success_is_kept(self):
        bad = {**PART, "measured_mm": None}
        self.assertEqual(self.daemon.measure(bad, key("failed")).status, 422)
        self.assertEqual(self.daemon.measure(PART, key("failed")).status, 201)

    def test_keys_that_are_none(self):
        for text in ("", '""', "x" * 256, "tab\tin"):
            with self.subTest(text):
                self.assert_problem(self.daemon.measure(PART, key(text)), 400,
                                    "idempotency.key_invalid")
        self.assertEqual(self.daemon.measure(PART, key("x" * 255)).status, 201)

    def test_two_keys_are_none(self):
        connection = self.daemon.connect()
        for keys in (("one", "two"), ("same", "same")):
            with self.subTest(keys):
                connection.putrequest("POST", "/v1/measurements")
                body = json.dumps(PART).encode()
                for text in keys:
                    connection.putheader("Idempotency-Key", text)
                connection.putheader("Content-Type", "application/json")
                connection.putheader("Content-Length", str(len(body)))
                connection.endheaders(body)
                answer = connection.getresponse()
                self.assertEqual(answer.status, 400)
                self.assertEqual(json.load(answer)["code"], "idempotency.key_invalid")

    def test_the_scope_has_the_path(self):
        record = self.daemon.measure(PART, key("scope")).json
        answer = self.daemon.post(f"/v1/measurements/{record['id']}/corrections",
                                  {"measured_mm": 25.02, "reason": "wrong gauge"}, key("scope"))
        self.assertEqual(answer.status, 201, answer)

    def test_a_hundred_at_once_store_one_row(self):
        count = self.count()
        answers = []
        start = threading.Barrier(100)

        def post():
            connection = self.daemon.connect()
            connection.connect()
            start.wait()
            answers.append(self.daemon.measure(PART, key("storm"), connection))
            connection.close()

        threads = [threading.Thread(target=post) for _ in range(100)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        statuses = collections.Counter(answer.status for answer in answers)
        self.assertEqual(len(answers), 100)
        self.assertEqual(set(statuses) | {201, 409}, {201, 409}, statuses)
        self.assertEqual(len({a.body for a in answers if a.status == 201}), 1)
        for answer in answers:
            if answer.status == 409:
                self.assertEqual(answer.json["code"], "idempotency.in_progress")
        self.assertEqual(self.count(), count + 1)
        replay = self.daemon.measure(PART, key("storm"))
        self.assertIn(replay.body, {a.body for a in answers if a.status == 201})


class Callers(DaemonTest):
    flags = ("--auth", "keys")

    def test_each_caller_has_keys_of_its_own(self):
        tokens = [self.daemon.command("key", "create", "--name", name, "--role", "operator")
                  .stdout.strip() for name in ("press-3", "press-4")]
        self.daemon.kill()  # the keys are read again at the start
        self.daemon.start()
        records = [self.daemon.measure(PART, {**key("same"), "Authorization": f"Bearer {token}"}).json
                   for token in tokens]
        self.assertEqual([r["caller"] for r in records], ["press-3", "press-4"])
        self.assertNotEqual(records[0]["id"], records[1]["id"])


class AfterARestart(DaemonTest):
    def test_the_answer_is_kept(self):
        first = self.daemon.measure(PART, key("kept"))
        self.daemon.kill()
        self.daemon.start()
        again = self.daemon.measure(PART, key("kept"))
        self.assertEqual((again.status, again.body), (201, first.body))
        self.assertEqual(len(self.daemon.stored()), 1)
