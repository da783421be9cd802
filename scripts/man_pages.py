"""The manual pages: headings, descriptions and option lists are those of --help; other sentences in a page stay."""

import re
import subprocess
from collections.abc import Iterator
from typing import NamedTuple


class Entry(NamedTuple):
    head: str  # of a list, in mdoc
    text: str
    is_required: bool


class Command(NamedTuple):
    words: tuple[str, ...]
    description: str
    arguments: list[Entry]
    options: list[Entry]


def entries(text: str, section: str) -> Iterator[tuple[str, str]]:
    """Left and right column of a section of --help; a long left column has a line of its own."""
    lines = re.findall(r"^  (\S.*)((?:\n {30}.*)*)", text.partition(f"\n{section}:\n")[2].partition("\n\n")[0], re.MULTILINE)
    for left, right in lines:
        is_long = right or left[27:28].strip()
        yield (left, " ".join(right.split())) if is_long else (left[:27].rstrip(), left[27:].strip())


def entry(left: str, text: str) -> Entry:
    [(names, kind, choices, span, rest)] = re.findall(
        r"^(\S+)(?: ([A-Z]+(?::PORT)?))?(?::\{(.*?)\}|:INT in \[(.*?)\])?((?: .*)?)$", left)
    head = " , ".join("Fl " + name[1:] for name in names.split(",") if name[0] == "-") or f"Ar {names}"
    if head.startswith("Fl") and kind:
        head += " Cm " + " | ".join(choices.split(",")) if choices else f" Ar {kind.lower()}"
    if span:
        text = re.sub(r"(?= \(default|$)", ", " + span.replace(" - ", " to "), text, count=1)
    if " ..." in rest:
        is_option = head.startswith("Fl")
        head, text = (head, re.sub(r"(?= \(default: |$)", "; may be repeated", text, count=1)) if is_option else (head + " ...", text)
    return Entry(head, text, "REQUIRED" in rest)


def plain(text: str) -> str:
    return re.sub(r"(?<![\w-])--(?=[a-z])", r"\\-\\-", text)


def commands(program: str, *words: str) -> Iterator[Command]:
    """A program, or a command of it, and the commands of that; a command with commands of its own is not one."""
    text = subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout
    below = [left.split(",")[0] for left, _ in entries(text, "Subcommands")]
    if not words or not below:
        options = [entry(*each) for each in entries(text, "Options") if not words or not each[0].startswith("-h,")]
        yield Command(words, text.partition("\n")[0], [entry(*each) for each in entries(text, "Positionals")], options)
    for name in below:
        yield from commands(program, *words, name)


def items(some: list[Entry], more: str = "") -> str:
    listed = "".join(f".It {each.head}\n{plain(each.text)}.\n" for each in some if each.text) + more
    return f".Bl -tag -width Ds\n{listed}.El\n" if listed else ""


def block(command: Command, prose: str, written: dict[Entry, str]) -> str:
    """A command; options that many commands have are described once, in the first."""
    name = " ".join(command.words)
    heading = [each.head if each.is_required else f"Op {each.head}" for each in command.arguments]
    heading += [each.head for each in command.options if each.is_required]
    first: dict[str, list[Entry]] = {}
    for each in command.options:
        first.setdefault(written.setdefault(each, name), []).append(each)
    shared = {other: some for other, some in first.items() if other != name and len(some) > 3}
    again = "".join(f".It {' , '.join(each.head.split(' Ar ')[0] for each in some)}\nAs for\n.Cm {other} .\n"
                    for other, some in shared.items())
    own = [each for each in command.options if written[each] not in shared]
    return f".It {' '.join([f'Cm {name}', *heading])}\n{plain(command.description)}.\n{prose}" + items(command.arguments + own, again)


def page(program: str, text: str) -> str:
    """The page with the lists of OPTIONS and COMMANDS written again."""
    whole, *some = commands(program)
    prose = {tuple(re.split(r" (?:Ar|Fl|Op|Cm)\b", heading)[0].split()): kept
             for heading, kept in re.findall(r"^\.It Cm (.*)\n.*\n((?:(?!\.It Cm |\.Bl |\.El).*\n)*)", text, re.MULTILINE)}
    written: dict[Entry, str] = {}
    blocks = "".join(block(each, prose.get(each.words, ""), written) for each in some)
    for section, content in (("OPTIONS", items(whole.options)), ("COMMANDS", f".Bl -tag -width Ds\n{blocks}.El\n")):
        text = re.sub(rf"(^\.Sh {section}\n(?:(?!\.Bl ).*\n)*)(?:(?!\.Sh ).*\n)*", lambda found: found[1] + content, text,
                      flags=re.MULTILINE)
    return text
