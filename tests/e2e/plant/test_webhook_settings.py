"""Webhooks: their body, headers, secrets and addresses."""

import pathlib
import ssl
import tempfile
import unittest

from support.certificates import certificate
from support.webhooks import SECRETS, Receivers, part, signature


class WebhookSettings(Receivers):
    def test_own_headers_are_sent_and_never_shown(self):
        receiver, daemon = self.receiver(), self.daemon()
        headers = {"Authorization": "Bearer s3cret", "X-Plant": "press-3"}
        made = self.connect(daemon, receiver, headers=headers)
        self.assertEqual(made["headers"], {"Authorization": None, "X-Plant": None})

        def sent(number):
            daemon.measure(part(number))
            receiver.wait(lambda: len(receiver.events) == number)
            receiver.wait(lambda: self.state(daemon)["position"] == number)  # its answer is read: none comes again
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


if __name__ == "__main__":
    unittest.main()
