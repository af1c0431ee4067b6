"""A disk as a power cut may leave it: what was synchronised is there, of all else any part.

A file's content and its name are two things: the one is on the disk when the file was synchronised, the other when its
folder was.
"""

import itertools
from dataclasses import dataclass, field
from pathlib import Path

SECTOR = 512
"""What a disk writes whole."""


@dataclass(eq=False)
class File:
    """Content that is on the disk, and what was written since: (offset, bytes), or (length, None) for a new length."""

    settled: bytes = b""
    pending: list = field(default_factory=list)

    def written(self, choose):
        """The content, with what `choose` leaves of what is pending."""
        content = bytearray(self.settled)
        for at, data in choose(self.pending):
            if data is None:
                del content[at:]
                content.extend(bytes(at - len(content)))
                continue
            content.extend(bytes(max(0, at - len(content))))
            content[at : at + len(data)] = data
        return bytes(content)

    def settle(self):
        """All of it comes to the disk."""
        self.settled, self.pending = self.written(everything), []

    @property
    def length(self):
        """As the program sees it."""
        length = len(self.settled)
        for at, data in self.pending:
            length = at if data is None else max(length, at + len(data))
        return length


@dataclass(eq=False)
class Folder:
    """Names that are on the disk, and what became of names since: sets of (name, what it names or None)."""

    settled: dict = field(default_factory=dict)
    pending: list = field(default_factory=list)

    def named(self, choose):
        """The names, with what `choose` leaves of what is pending."""
        names = dict(self.settled)
        for changes in choose(self.pending):
            names.update(changes)
        return {name: node for name, node in names.items() if node is not None}

    def settle(self):
        """All of them come to the disk."""
        self.settled, self.pending = self.named(everything), []


@dataclass
class _Opened:
    """An open file or folder."""

    node: File | Folder
    appends: bool
    place: int = 0


def everything(pending):
    """All that is pending has come to the disk."""
    return pending


def nothing(pending):
    """None of it has."""
    del pending
    return []


class Chance:
    """Any of it has come to the disk: of names those up to some moment, of contents any sectors.

    Args:
        rng: by whose chance.
    """

    def __init__(self, rng):
        self._rng = rng

    def names(self, pending):
        """As many as chance says, the oldest first."""
        return pending[: self._rng.randint(0, len(pending))]

    def contents(self, pending):
        """Each for itself: whole, but for one sector, every other sector as it happens, or not at all."""
        for at, data in pending:
            kept = self._rng.randrange(4)
            if kept == 0:
                yield at, data
            elif kept < 3 and data is not None:
                pieces = list(_sectors(at, data))
                gone = self._rng.sample(pieces, 1 if kept == 1 else len(pieces) // 2)
                yield from (piece for piece in pieces if piece not in gone)


def _sectors(at, data):
    cuts = [0, *range(SECTOR - at % SECTOR, len(data), SECTOR), len(data)]
    for begin, end in itertools.pairwise(cuts):
        yield at + begin, data[begin:end]


class Disk:
    """Follows a program's calls.

    Args:
        root: the folder that is looked at, empty; it is on the disk.
    """

    def __init__(self, root: Path) -> None:
        self._root = root
        self._top = Folder()
        self._open: dict[str, _Opened] = {}

    def follow(self, call) -> bool:
        """Do what was called; whether that changed anything that is looked at."""
        match call.name, call.arguments:
            case "openat", (_, path, flags, *_):
                return self._opened(str(call.result), path, flags)
            case "rename", (before, after):
                return self._renamed(before, after)
            case "unlink", (path,):
                return self._named(path, None)
            case "mkdir", (path, _):
                return self._named(path, Folder())
            case (("close" | "lseek" | "write" | "pwrite64" | "ftruncate" | "fsync" | "fdatasync"), (number, *rest)):
                return number in self._open and self._used(number, call.name, rest, call.result)
        raise AssertionError(f"what becomes of files by {call.name}{call.arguments} is not known here")

    def left(self, names, contents):
        """What is left of it: the content of each file, and None for a folder.

        Args:
            names: chooses, of the changes of names that are pending, those that came to the disk.
            contents: the same for the changes of contents.
        """
        return dict(_left(self._top, Path(), names, contents))

    def _used(self, number, name, rest, result):
        opened = self._open[number]
        node = opened.node
        match name, rest:
            case "close", []:
                del self._open[number]
                return False
            case "lseek", _:
                opened.place = result
                return False
            case "write", [data, _]:
                at = node.length if opened.appends else opened.place
                node.pending.append((at, data[:result]))
                opened.place = at + result
            case "pwrite64", [data, _, at]:
                node.pending.append((int(at), data[:result]))
            case "ftruncate", [length]:
                node.pending.append((int(length), None))
            case (("fsync" | "fdatasync"), []):
                node.settle()
        return True

    def _opened(self, number, path, flags):
        found = self._at(path)
        if found is None:
            return False
        folder, name = found
        node = folder.named(everything).get(name) if name else folder
        changes = node is None or "O_TRUNC" in flags
        if node is None:
            node = File()
            folder.pending.append({name: node})
        elif "O_TRUNC" in flags:
            node.pending.append((0, None))
        self._open[number] = _Opened(node, "O_APPEND" in flags)
        return changes

    def _renamed(self, before, after):
        source, target = self._at(before), self._at(after)
        if source is None or target is None:
            assert source is target, "nothing is moved into the folder that is looked at, or out of it"
            return False
        (folder, name), (other, new) = source, target
        assert folder is other, "names change within a folder"
        folder.pending.append({name: None, new: folder.named(everything)[name]})
        return True

    def _named(self, path, node):
        found = self._at(path)
        if found is None:
            return False
        folder, name = found
        folder.pending.append({name: node})
        return True

    def _at(self, path):
        """The folder that a path leads to, and the name in it, empty for the root; None for a path elsewhere."""
        whole = Path(path.decode())
        if not whole.is_relative_to(self._root):
            return None
        folder = self._top
        for part in whole.relative_to(self._root).parent.parts:
            folder = folder.named(everything)[part]
        return folder, "" if whole == self._root else whole.name


def _left(folder, at, names, contents):
    for name, node in folder.named(names).items():
        if isinstance(node, Folder):
            yield at / name, None
            yield from _left(node, at / name, names, contents)
        else:
            yield at / name, node.written(contents)
