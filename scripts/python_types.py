"""The types of the Python client, from the schemas of /openapi.json: clients/python/fitgauge/_types.py.

Each schema that a module of the client imports from there becomes a type, with all that it refers to. A body
that is sent takes sizes and times in every form the client writes. An answer has them as the client reads
them: a number of a member with a unit is a Decimal, another one an int or a Decimal.
"""

import keyword
import pathlib
import re
import runpy

CLIENT = pathlib.Path(__file__).resolve().parent.parent / "clients/python/fitgauge"
# The rule by which the client reads numbers, from its file: the package needs the types that are made here.
is_exact = runpy.run_path(str(CLIENT / "_json.py"))["is_exact"]

HEAD = '''"""Bodies and answers of the service. Written by scripts/docs."""

from __future__ import annotations

from datetime import datetime
from decimal import Decimal
from typing import Dict, List, Literal, TypedDict, Union

from ._json import Size

Number = Union[Decimal, int]
Time = Union[str, datetime]
'''
# Names for the words of a member, and for an object inside another one.
WORDS = {"VerdictWord": ("Verdict", "verdict"), "RuleWord": ("NewMeasurement", "rule"),
         "FeatureWord": ("Limits", "feature"), "RunStatus": ("Run", "status")}
INNER = {"RunLimits": ("RunOrder", "limits"), "FieldError": ("Problem", "errors")}


class Types:
    """The types of one /openapi.json, in the order in which they refer to each other."""

    def __init__(self, openapi):
        self.schemas = openapi["components"]["schemas"]
        self.sent = set()  # components that a request may have
        for path in openapi["paths"].values():
            self.reach([operation.get("requestBody", {}) for operation in path.values()])
        self.words = {literal(self.schemas[schema]["properties"][member]["enum"]): name
                      for name, (schema, member) in WORDS.items()}
        self.types = {}

    def reach(self, node):
        for value in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
            self.reach(value)
        name = component_of(node) if isinstance(node, dict) else None
        if name and name not in self.sent:
            self.sent.add(name)
            self.reach(self.schemas[name])

    def module(self):
        for name in imported():
            self.named(name)
        words = "".join(f"{name} = {text}\n" for text, name in self.words.items())
        return HEAD + words + "".join(self.types.values())

    def named(self, name):
        """Adds the type of a schema and gives its name."""
        if name in WORDS or name in self.types:
            return name
        component, member = INNER.get(name, (name, None))
        schema = self.schemas[component]
        if member:
            schema = schema["properties"][member]
            schema = schema.get("items", schema)
        if "properties" in schema:
            return self.object(name, schema, component in self.sent, False)
        text = self.text(name, schema, component in self.sent, False)
        self.types[name] = f"\n{name} = {text}\n"
        return name

    def object(self, name, schema, sent, exact):
        """Adds the class of an object and gives its name."""
        members = {member: self.text(name + camel(member), inner, sent, exact or is_exact(member))
                   for member, inner in schema["properties"].items()}
        always = {member: text for member, text in members.items() if member in schema.get("required", [])}
        if any(not member.isidentifier() or keyword.iskeyword(member) for member in members):
            inner = ", ".join(f'"{member}": "{text}"' for member, text in members.items())
            self.types[name] = f'\n{name} = TypedDict("{name}", {{{inner}}}, total={len(always) == len(members)})\n'
        elif always and len(always) < len(members):
            rest = {member: text for member, text in members.items() if member not in always}
            self.types[name] = class_of(f"_{name}", "TypedDict", always) + class_of(name, f"_{name}, total=False", rest)
        else:
            self.types[name] = class_of(name, "TypedDict" if always else "TypedDict, total=False", members)
        return name

    def text(self, name, schema, sent, exact):
        """The annotation of a value; an object inside becomes the class `name`."""
        if component_of(schema):
            return self.named(component_of(schema))
        if choices := schema.get("oneOf", schema.get("anyOf")):
            return union(self.text(f"{name}{number}", choice, sent, exact) for number, choice in enumerate(choices))
        if "enum" in schema or "const" in schema:
            text = literal(schema.get("enum") or [schema["const"]])
            return self.words.get(text, text)
        kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
        if sent and "number" in kinds:
            kinds = [kind for kind in kinds if kind != "string"]
        return union(self.kind(kind, name, schema, sent, exact) for kind in kinds)

    def kind(self, kind, name, schema, sent, exact):
        if kind == "array":
            return f"List[{self.text(name, schema['items'], sent, exact)}]"
        if kind == "object" and "properties" in schema:
            return self.object(name, schema, sent, exact)
        if kind == "object":
            return f"Dict[str, {self.text(name, schema['additionalProperties'], sent, exact)}]"
        number = "Size" if sent else "Decimal" if exact else "Number"
        time = sent and schema.get("format") == "date-time"
        return {"number": number, "integer": "Decimal" if exact and not sent else "int", "boolean": "bool",
                "null": "None", "string": "Time" if time else "str"}[kind]


def imported():
    """The names that the client's modules import from their types."""
    names = set()
    for module in sorted(CLIENT.glob("*.py")):
        found = re.findall(r"from \._types import (?:\(([^)]+)\)|(.+))", module.read_text(encoding="utf-8"))
        names.update(name for texts in found for text in texts for name in re.findall(r"\w+", text))
    return sorted(names)


def component_of(schema):
    return schema["$ref"].rsplit("/", 1)[1] if "/schemas/" in schema.get("$ref", "") else None


def camel(name):
    return "".join(part.capitalize() for part in name.split("_"))


def literal(words):
    return "Literal[" + ", ".join(f'"{word}"' for word in words) + "]"


def union(texts):
    texts = list(dict.fromkeys(texts))
    return texts[0] if len(texts) == 1 else f"Union[{', '.join(texts)}]"


def class_of(name, bases, members):
    return f"\n\nclass {name}({bases}):\n" + "".join(f"    {member}: {text}\n" for member, text in members.items())


def module(openapi):
    return Types(openapi).module()
