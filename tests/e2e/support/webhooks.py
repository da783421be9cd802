"""What tests of webhooks share: receivers, a daemon that reaches them, and the signature."""

import base64
import contextlib
import hashlib
import hmac
import json
import sqlite3
import unittest

from support.daemon import Daemon
from support.receiver import Receiver
from support.waiting import wait_for

SECRETS = ["whsec_" + base64.b64encode(bytes(range(first, first + 32))).decode() for first in (0, 100)]
PRIVATE = ("--allow-private-addresses",)


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
