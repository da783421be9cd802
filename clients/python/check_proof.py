#!/usr/bin/env python3
"""Checks, without the service, that a measurement stands in the log of a fitgauged.

    check_proof.py RECORD PROOF KEYS

RECORD is the record as it was answered (JSON), PROOF the answer of /v1/measurements/{id}/proof, KEYS the
lines of /v1/log/key as they were noted when the service was set up. Needs Python 3 and openssl alone.
"""

import base64
import decimal
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

SHOWN_LATER = ("conflict", "corrected_by", "notes")  # not there yet when the record was answered first


def canonical(value):
    """The RFC 8785 form of a record: members sorted, numbers without exponent."""
    if isinstance(value, dict):
        members = sorted(value.items(), key=lambda member: member[0].encode("utf-16-be"))
        return "{" + ",".join(canonical(name) + ":" + canonical(member) for name, member in members) + "}"
    if isinstance(value, decimal.Decimal):
        text = format(value, "f")
        return text.rstrip("0").rstrip(".") if "." in text else text
    return json.dumps(value, ensure_ascii=False)


def leaf_of(record):
    members = json.loads(record, parse_float=decimal.Decimal, parse_int=decimal.Decimal)
    kept = {name: member for name, member in members.items() if name not in SHOWN_LATER}
    return hashlib.sha256(b"\0" + canonical(kept).encode()).digest()


def root_of(leaf, index, size, hashes):
    """The root that the path leads to (RFC 9162, 2.1.3.2); none where it does not fit."""
    node, last, root = index, size - 1, leaf
    for beside in hashes:
        if last == 0:
            return None
        if node & 1 or node == last:
            root = hashlib.sha256(b"\1" + beside + root).digest()
            while node and not node & 1:
                node, last = node >> 1, last >> 1
        else:
            root = hashlib.sha256(b"\1" + root + beside).digest()
        node, last = node >> 1, last >> 1
    return root if last == 0 and index < size else None


def is_signed(checkpoint, keys):
    """Whether one of the keys has signed the note (C2SP signed-note, Ed25519)."""
    text, signatures = checkpoint.split("\n\n")
    text += "\n"
    for line in signatures.splitlines():
        _, name, signature = line.split(" ")
        signature = base64.b64decode(signature)
        for vkey in keys:
            key_name, key_hash, key = vkey.split("+", 2)
            if name != key_name or name != text.split("\n")[0] or signature[:4].hex() != key_hash:
                continue
            with tempfile.TemporaryDirectory() as folder:
                files = [pathlib.Path(folder, file) for file in ("key", "text", "signature")]
                files[0].write_bytes(bytes.fromhex("302a300506032b6570032100") + base64.b64decode(key)[1:])
                files[1].write_text(text)
                files[2].write_bytes(signature[4:])
                done = subprocess.run(["openssl", "pkeyutl", "-verify", "-pubin", "-keyform", "DER", "-rawin",
                                       "-inkey", files[0], "-in", files[1], "-sigfile", files[2]],
                                      capture_output=True, check=False)
                if done.returncode == 0:
                    return True
    return False


def check(record, proof, keys):
    """What is wrong, or nothing."""
    _, size, root = proof["checkpoint"].split("\n")[:3]
    leaf = leaf_of(record)
    if leaf != base64.b64decode(proof["leaf"]):
        return "the record is not the one of the proof: its leaf is another"
    hashes = [base64.b64decode(text) for text in proof["hashes"]]
    if root_of(leaf, proof["index"], int(size), hashes) != base64.b64decode(root):
        return "the path does not lead to the root of the checkpoint"
    if not is_signed(proof["checkpoint"], keys):
        return "none of the keys has signed the checkpoint"
    return None


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    texts = [pathlib.Path(name).read_text() for name in sys.argv[1:]]
    wrong = check(texts[0], json.loads(texts[1]), texts[2].split())
    if wrong:
        sys.exit(wrong)
    print("the measurement stands in the log")
