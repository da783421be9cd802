"""/openapi.json describes every operation as a generated client, a validating gateway and a reader need it."""

import unittest

import jsonschema

from support.contract import Contract, refuse_others
from support.daemon import DaemonTest


class Description(DaemonTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.contract = Contract(cls.daemon.get("/openapi.json").json)

    def test_every_operation_has_a_name_a_tag_and_its_successes(self):
        names = set()
        tags = {tag["name"] for tag in self.contract.document["tags"]}
        for path, method, operation in self.contract.operations():
            with self.subTest(f"{method} {path}"):
                self.assertRegex(operation["operationId"], r"^[a-z][A-Za-z]+$")
                self.assertNotIn(operation["operationId"], names)
                names.add(operation["operationId"])
                self.assertLessEqual(set(operation["tags"]), tags)
                self.assertTrue(operation["tags"])
                self.assertTrue([status for status in operation["responses"] if status.startswith("2")])

    def test_every_operation_asks_for_a_role_that_keys_have(self):
        for path, methods in self.contract.document["paths"].items():
            for method, operation in methods.items():
                roles = {role for way in operation.get("security", []) for role in way.get("key", [])}
                self.assertLessEqual(roles, {"viewer", "operator", "admin", "station"}, f"{method} {path}")

    def test_every_json_body_has_a_schema(self):
        for path, method, operation in self.contract.operations():
            contents = [operation.get("requestBody", {}).get("content", {})]
            contents += [response.get("content", {}) for response in operation["responses"].values()]
            for content in contents:
                if "application/json" in content:
                    with self.subTest(f"{method} {path}"):
                        self.assertIn("$ref", content["application/json"]["schema"])
            # What answers JSON says so: only an answer without a body may leave its content out.
            if method == "get":
                self.assertTrue(operation["responses"]["200"].get("content"), path)

    def test_every_schema_is_one_and_its_example_is_valid(self):
        for name, schema in self.contract.document["components"]["schemas"].items():
            with self.subTest(name):
                jsonschema.Draft202012Validator.check_schema(schema)
                self.assertTrue(schema.get("examples"), "no example")
                for example in schema.get("examples", []):
                    self.contract.validate(example, {"$ref": "#/components/schemas/" + name})

    def test_a_union_names_its_choices(self):
        schemas = self.contract.document["components"]["schemas"]
        for name, schema in schemas.items():
            self.assertNotIn("anyOf", schema, name)
            for member, mapping in [(found["propertyName"], found["mapping"]) for found in (schema.get("discriminator"),) if found]:
                self.assertEqual({each["$ref"] for each in schema["oneOf"]}, set(mapping.values()))
                for word, reference in mapping.items():
                    choice = self.contract.resolve({"$ref": reference})
                    said = choice["properties"][member]
                    self.assertIn(member, choice["required"])
                    self.assertIn(word, said.get("enum", [said.get("const")]))
        told = {name for name, schema in schemas.items() if "discriminator" in schema}
        self.assertEqual(told, {"ConnectionOrder", "Feature", "GaugeStudy"})
        titles = ", ".join(choice["title"] for choice in schemas["Event"]["oneOf"])
        self.assertEqual(titles, "measurement.recorded, verdict.reject, run.finished, note.added, table.changed, resync")

    def test_a_default_is_one_and_is_of_its_schema(self):
        defaults = []

        def walk(node, name=None):
            if isinstance(node, dict):
                self.assertNotIn("x-default", node, name)
                if "default" in node and name not in ("properties", "responses"):
                    defaults.append(name)
                    self.contract.validate(node["default"], {key: value for key, value in node.items() if key != "default"})
            for key, value in node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ():
                walk(value, key)

        walk(self.contract.document)
        self.assertIn("dist_mm", defaults)

    def test_every_body_has_an_example_that_is_taken(self):
        for path, method, operation in self.contract.operations():
            for kind, body in operation.get("requestBody", {}).get("content", {}).items():
                if kind != "model/step" and operation["operationId"] != "putLogBatch":
                    with self.subTest(f"{method} {path} {kind}"):
                        self.contract.validate(body["example"], body["schema"])
        content = self.contract.operation("postMeasurements")[2]["requestBody"]["content"]
        for kind in ("text/csv", "application/x-ndjson"):
            answer = self.daemon.post("/v1/measurements", content[kind]["example"].encode(), {"Content-Type": kind})
            self.assertEqual(answer.status, 201, answer)

    def test_headers_are_described_as_they_are_taken(self):
        _, _, operation = self.contract.operation("postMeasurements")
        parameters = {each["name"]: each["schema"] for each in operation["parameters"]}
        for number, key in enumerate(("x" * 255, "x" * 256, '"' + "y" * 255 + '"', '"' + "y" * 256 + '"', "a\tb", '""')):
            headers = {"Idempotency-Key": key}
            answer = self.daemon.post("/v1/measurements", {"designation": "25 H7", "measured_mm": 25}, headers)
            is_taken = jsonschema.Draft202012Validator(parameters["Idempotency-Key"]).is_valid(key)
            self.assertEqual(answer.status, 201 if is_taken else 400, key)
            self.assertEqual(is_taken, number in (0, 2))
        self.assertEqual(parameters["Prefer"]["enum"], ["return=representation", "return=minimal"])
        run = self.contract.operation("postRun")[2]["parameters"]
        self.assertEqual(next(each for each in run if each["name"] == "Prefer")["schema"]["enum"], ["respond-async"])

    def test_what_every_path_may_answer_is_described(self):
        for path, method, operation in self.contract.operations():
            self.assertLessEqual({"405", "417"}, set(operation["responses"]), f"{method} {path}")
        for name, method, path in (("getLimits", "PATCH", "/v1/limits/25H7"), ("live", "POST", "/livez"),
                                   ("probeMtconnect", "PUT", "/mtconnect/probe")):
            operation = self.contract.operation(name)[2]
            for status, answer in ((405, self.daemon.request(method, path)), (417, self.daemon.get(path, Expect="more"))):
                self.assertEqual(answer.status, status)
                self.assertIsNone(self.contract.check(operation, answer), answer)
        self.assertIn("Allow", self.contract.resolve(operation["responses"]["405"])["headers"])

    def test_a_schema_refuses_what_it_does_not_name(self):
        with self.assertRaises(jsonschema.ValidationError):
            self.contract.validate({"status": "live", "more": 1}, {"$ref": "#/components/schemas/Live"})
        self.assertEqual(refuse_others({"type": "object", "properties": {}})["additionalProperties"], False)


if __name__ == "__main__":
    unittest.main()
