"""Seals of rows as whoever may write the database's file would make them: what is not found by its seal must be found
otherwise."""

import contextlib
import hashlib
import re
import sqlite3

from support.daemon import ROOT


def encoded(value):
    """As db/store/canonical_digest.hpp says."""
    if value is None:
        return b"\0"
    if isinstance(value, int):
        count = (max(value, ~value).bit_length() + 8) // 8 if value else 0
        return bytes([0x10 + count]) + value.to_bytes(count, "big", signed=True)
    content = value.encode() if isinstance(value, str) else value
    return b"\1" + encoded(len(content)) + content


def row_digest(*values):
    return hashlib.sha256(b"".join(map(encoded, values))).digest()


def sealed_anew(table):
    """The statement that seals each row of a table as it is."""
    text = (ROOT / "db" / "sql" / "sealed_table.hpp").read_text()
    literals, = re.findall(rf'"{table}",\s*"\w+",\s*((?:"[^"]*"\s*)+)', text)
    columns = "".join(re.findall('"([^"]*)"', literals))
    return f"UPDATE {table} SET seal = row_digest({columns})"


def alter(database, *statements):
    """Writes past the service, triggers or not."""
    with contextlib.closing(sqlite3.connect(database)) as connection:
        connection.create_function("row_digest", -1, row_digest, deterministic=True)
        for statement in statements:
            connection.execute(statement)
        connection.commit()
