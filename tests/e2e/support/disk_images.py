"""What a power cut may leave of a folder, when the disk writes what it was given in another order.

strace records every call that changes the folder. An image is drawn from the record up to some moment: what a
flush had covered is there, and of what was only handed over any sectors are, as if the rest had still been in a
cache. The names of files follow their order, as journaling file systems keep it, but may lag behind.
"""

import re

SECTOR = 512
CALLS = "openat,mkdir,pwrite64,write,ftruncate,fdatasync,fsync,rename,renameat2,unlink,sendto,sendmsg"
_LINE = re.compile(r"^(\d+) +(.*)$")
_RESUMED = re.compile(r"^<\.\.\. (\w+) resumed>(.*)$")
_UNFINISHED = " <unfinished ...>"
_TEXT = re.compile(r'"((?:\\x[0-9a-f]{2})*)"')
_DESCRIPTOR = re.compile(r"<((?:\\x[0-9a-f]{2})+)>")


def strace(output):
    """The command before the daemon's own."""
    return ["strace", "-D", "-f", "-qq", "-y", "-xx", "-s", "100000000", "-e", f"trace={CALLS}", "-o", str(output)]


def _bytes(text):
    return bytes.fromhex(text.replace("\\x", ""))


class Call:
    """One call: its name and arguments, and where in the record it began and ended."""

    def __init__(self, name, text, begin):
        self.name, self.text, self.begin, self.end = name, text, begin, None

    def descriptor(self):
        found = _DESCRIPTOR.search(self.text)
        return _bytes(found.group(1)).decode(errors="replace") if found else ""

    def texts(self):
        return [_bytes(text) for text in _TEXT.findall(self.text)]

    def number(self, of_last):
        """The argument `of_last` places before the last."""
        arguments = self.text.rsplit(")", 1)[0].split(", ")
        return int(arguments[-1 - of_last])


def calls(path):
    """The calls of a record in the order in which they began."""
    found, open_calls = [], {}
    with open(path, encoding="ascii") as lines:
        for index, line in enumerate(lines):
            thread, text = _LINE.match(line.rstrip("\n")).groups()
            resumed = _RESUMED.match(text)
            if resumed:
                call = open_calls.pop(thread, None)
                if call is None:
                    continue
                call.text += resumed.group(2)
                call.end = index
                continue
            if "(" not in text or text.startswith(("---", "+++")):
                continue
            name, arguments = text.split("(", 1)
            call = Call(name, arguments.removesuffix(_UNFINISHED), index)
            found.append(call)
            if text.endswith(_UNFINISHED):
                open_calls[thread] = call
            else:
                call.end = index
    for call in found:
        if call.end is None or re.search(r"= -1 ", call.text):
            call.end = None  # it never returned, or failed: it has done nothing
    return [call for call in found if call.end is not None]


class Write:
    """Bytes handed over for a file; a truncation has none."""

    def __init__(self, offset, content, begin, end):
        self.offset, self.content, self.begin, self.end = offset, content, begin, end

    def apply(self, image, keeps):
        """Puts the sectors on `image` of which `keeps` says so."""
        if self.content is None:
            if keeps():
                del image[self.offset:]
                image.extend(bytes(self.offset - len(image)))
            return
        at = self.offset
        end = at + len(self.content)
        while at < end:
            stop = min(end, (at // SECTOR + 1) * SECTOR)
            if keeps():
                image.extend(bytes(max(0, stop - len(image))))
                image[at:stop] = self.content[at - self.offset:stop - self.offset]
            at = stop


class File:
    def __init__(self):
        self.writes = []
        self.flushes = []  # (begin, end)
        self.size = 0      # while the record is read


class Record:
    """What a daemon did with `folder`, and when it answered 201."""

    def __init__(self, path, folder):
        self.folder = str(folder).rstrip("/")
        self.files = []
        self.names = []      # (begin, end, what to do with a dict of names)
        self.syncs = []      # (begin, end) of the folder itself
        self.answers = []    # where an answer 201 began to leave
        self.last = 0
        open_names = {}
        for call in calls(path):
            self.last = max(self.last, call.end)
            self._take(call, open_names)

    def _name(self, path):
        text = path.decode(errors="replace") if isinstance(path, bytes) else path
        inside = text.removeprefix(self.folder + "/")
        return inside if inside != text and not inside.endswith("-shm") else None

    def _change_names(self, call, change):
        self.names.append((call.begin, call.end, change))

    def _file(self, call, name, names):
        if name not in names:
            file = names[name] = File()
            self.files.append(file)
            self._change_names(call, lambda now, name=name, file=file: now.update({name: file}))
        return names[name]

    def _take(self, call, names):
        if call.name in ("sendto", "sendmsg"):
            sent = b"".join(call.texts())
            self.answers += [call.begin] * sent.count(b"HTTP/1.1 201")
            return
        if call.name == "openat":
            name = self._name(call.texts()[0]) if call.texts() else None
            if name and "O_CREAT" in call.text and "O_DIRECTORY" not in call.text:
                file = self._file(call, name, names)
                if "O_TRUNC" in call.text:
                    file.writes.append(Write(0, None, call.begin, call.end))
                    file.size = 0
            return
        if call.name in ("unlink", "rename", "renameat2"):
            paths = [self._name(text) for text in call.texts()]
            if call.name == "unlink" and paths[0]:
                names.pop(paths[0], None)
                self._change_names(call, lambda now, name=paths[0]: now.pop(name, None))
            elif len(paths) == 2 and all(paths):
                names[paths[1]] = names.pop(paths[0])
                self._change_names(call, lambda now, old=paths[0], new=paths[1]: now.update({new: now.pop(old)}))
            return
        if call.name in ("fdatasync", "fsync"):
            if call.descriptor() == self.folder:
                self.syncs.append((call.begin, call.end))
            name = self._name(call.descriptor())
            if name in names:
                names[name].flushes.append((call.begin, call.end))
            return
        name = self._name(call.descriptor())
        if name is None or name not in names:
            return
        file = names[name]
        if call.name == "ftruncate":
            file.size = call.number(0)
            file.writes.append(Write(file.size, None, call.begin, call.end))
        elif call.name == "pwrite64":
            content = call.texts()[-1]
            offset = call.number(0)
            file.writes.append(Write(offset, content, call.begin, call.end))
            file.size = max(file.size, offset + len(content))
        elif call.name == "write":
            content = call.texts()[-1]
            file.writes.append(Write(file.size, content, call.begin, call.end))
            file.size += len(content)

    def answered(self, moment):
        """How many answers 201 had begun to leave."""
        return sum(begin < moment for begin in self.answers)

    def image(self, moment, random):
        """{name: bytes} as a cut at `moment` may leave it."""
        covered = max((begin for begin, end in self.syncs if end < moment), default=-1)
        sure = sum(end < covered for _, end, _ in self.names)
        issued = sum(begin < moment for begin, _, _ in self.names)
        names = {}
        for _, _, change in self.names[:random.randint(min(sure, issued), issued)]:
            change(names)
        share = random.choice((0.0, 0.1, 0.5, 0.9, 1.0))
        contents = {}
        for name, file in names.items():
            flushed = max((begin for begin, end in file.flushes if end < moment), default=-1)
            image = bytearray()
            for write in file.writes:
                if write.end < flushed:
                    write.apply(image, lambda: True)
                elif write.begin < moment:
                    write.apply(image, lambda: random.random() < share)
            contents[name] = bytes(image)
        return contents
