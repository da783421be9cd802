"""/openapi.json as a test uses it: requests drawn from its schemas, answers held against them."""

import copy
import json
import random
import string

import jsonschema

REFERENCE = "#/components/"
# Headers of transfer, caches and browsers; OpenAPI leaves Content-Type to the media types.
OF_EVERY_SERVER = {"date", "content-type", "content-length", "transfer-encoding", "content-encoding", "connection", "vary",
                   "cache-control", "x-content-type-options", "cross-origin-resource-policy", "content-security-policy",
                   "referrer-policy", "service-worker-allowed", "x-accel-buffering"}


class Contract:
    """One service's description. `strict` validators refuse members that no schema names."""

    def __init__(self, document):
        self.document = document
        self.strict = refuse_others(copy.deepcopy(document))
        self.seen = {}  # by schema: the members that answers had

    def operations(self):
        for path, methods in self.document["paths"].items():
            for method, operation in methods.items():
                yield path, method, operation

    def operation(self, name):
        return next(found for found in self.operations() if found[2]["operationId"] == name)

    def resolve(self, node):
        while "$ref" in node:
            kind, name = node["$ref"].removeprefix(REFERENCE).split("/")
            node = self.document["components"][kind][name]
        return node

    def validate(self, value, schema):
        """Raises jsonschema.ValidationError; counts the members it saw."""
        for document in (self.document, self.strict):  # as written, one of a union must fit alone
            jsonschema.Draft202012Validator({**schema, "components": document["components"]}).validate(value)
        self.note(value, schema)

    def note(self, value, schema, name=None):
        if "$ref" in schema:
            return self.note(value, self.resolve(schema), schema["$ref"].rsplit("/", 1)[1])
        for choice in choices_of(schema):
            if jsonschema.Draft202012Validator({**choice, "components": self.strict["components"]}).is_valid(value):
                return self.note(value, choice, name)
        if isinstance(value, dict):
            if name:
                self.seen.setdefault(name, set()).update(value)
            for key, member in value.items():
                self.note(member, schema.get("properties", {}).get(key, {}))
        elif isinstance(value, list):
            for item in value:
                self.note(item, schema.get("items", {}))
        return None

    def check(self, operation, answer):
        """What is wrong with an answer, or None: its status, its media type, its body."""
        responses = operation["responses"]
        if str(answer.status) not in responses:
            return f"{answer.status} is not documented"
        response = self.resolve(responses[str(answer.status)])
        described = {name.lower() for name in response.get("headers", {})}
        others = set(answer.headers) - OF_EVERY_SERVER - described
        if others:
            return f"{sorted(others)} of {answer.status} not documented"
        content = response.get("content", {})
        media_type = answer.headers.get("content-type", "").split(";")[0]
        if not answer.body:
            return None
        if media_type not in content:
            return f"{media_type!r} is not documented for {answer.status}"
        schema = content[media_type]["schema"]
        values = [answer.json] if media_type.endswith("json") else []
        if media_type == "text/event-stream":
            values = [json.loads(line.removeprefix("data: ")) for line in answer.text.split("\n") if line.startswith("data: ")]
        if "type" not in schema:
            try:
                for value in values:
                    self.validate(value, schema)
            except jsonschema.ValidationError as error:
                return f"{list(error.absolute_path)}: {error.message}"
        return None


def choices_of(schema):
    return schema.get("oneOf", schema.get("anyOf", []))


def refuse_others(node):
    """Every object of the document refuses members it does not name."""
    if isinstance(node, dict):
        if node.get("type") == "object" and "properties" in node:
            node.setdefault("additionalProperties", False)
        for value in node.values():
            refuse_others(value)
    elif isinstance(node, list):
        for value in node:
            refuse_others(value)
    return node


class Drawing:
    """Values drawn from schemas. `hints` are values for members and parameters of a name, used half the time."""

    def __init__(self, contract, seed, hints):
        self.contract = contract
        self.random = random.Random(seed)
        self.hints = hints

    def value(self, schema, name=None, depth=0):
        schema = self.contract.resolve(schema)
        if name in self.hints and schema.get("type") != "object" and self.random.random() < 0.7:
            return self.random.choice(self.hints[name])
        if "const" in schema:
            return schema["const"]
        if "enum" in schema:
            return self.random.choice(schema["enum"])
        if choices_of(schema):
            return self.value(self.random.choice(choices_of(schema)), None, depth)
        kind = schema.get("type", "string")
        kind = self.random.choice(kind) if isinstance(kind, list) else kind
        return getattr(self, kind)(schema, depth)

    def object(self, schema, depth):
        drawn = {}
        for name, member in schema.get("properties", {}).items():
            if name in schema.get("required", []) or self.random.random() < 0.35 / (1 + depth / 3):
                drawn[name] = self.value(member, name, depth + 1)
        if isinstance(schema.get("additionalProperties"), dict):
            for name in self.random.sample(["Q1", "Q25", "QS3", "QL2", "QR100"], 2):
                drawn[name] = "text" if name.startswith("QS") else self.number({}, depth)
        return drawn

    def array(self, schema, depth):
        least, most = schema.get("minItems", 0), schema.get("maxItems", 3)
        return [self.value(schema["items"], None, depth + 1) for _ in range(self.random.randint(least, most))]

    def number(self, schema, _):
        least, most = max(schema.get("minimum", 0), -1000), min(schema.get("maximum", 100), 1000)
        return round(self.random.uniform(least, most), self.random.randint(0, 6))

    def integer(self, schema, _):
        least, most = max(schema.get("minimum", 0), -1000), min(schema.get("maximum", 100), 1000)
        return self.random.randint(least, most)

    def boolean(self, *_):
        return self.random.random() < 0.5

    def null(self, *_):
        return None

    def string(self, schema, _):
        if schema.get("format") == "date-time":
            return f"2026-{self.random.randint(1, 12):02}-{self.random.randint(1, 28):02}T08:00:00+01:00"
        if "pattern" in schema:  # an exact decimal fits each one there is
            return f"{self.random.randint(0, 90)}.{self.random.randint(0, 999999):06}"
        most = min(schema.get("maxLength", 12), 12)
        return "".join(self.random.choices(string.ascii_letters + string.digits + " -Øµ/%", k=self.random.randint(1, most // 2 or 1)))


# What a drawn value becomes to be wrong.
SPOILED = [None, True, "", "x", "\u0000", -1, 1e308, 10**30, [], {}, [[]], {"x": 1}, "NaN", "25,5", "1e3"]


def spoil(value, chance):
    """A copy with one place changed, a member added or one left out."""
    value = json.loads(json.dumps(value))
    places = [(None, None)]

    def walk(node):
        keys = node.keys() if isinstance(node, dict) else range(len(node)) if isinstance(node, list) else ()
        for key in keys:
            places.append((node, key))
            walk(node[key])

    walk(value)
    node, key = chance.choice(places)
    if node is None:
        return chance.choice(SPOILED)
    what = chance.randrange(3)
    if what == 0 and isinstance(node, dict):
        node["no such member"] = 1
    elif what == 1 and isinstance(node, dict):
        del node[key]
    else:
        node[key] = chance.choice(SPOILED)
    return value
