"""The text of a file that some program or other wrote."""

from pathlib import Path

from lfd.exceptions import TableError

_MARKS = {b"\xef\xbb\xbf": "utf-8-sig", b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}


def text_of(path: Path, largest_bytes: int) -> str:
    """The text, in UTF-8, UTF-16 or, where it is neither, Latin-1, with or without a byte order mark.

    Args:
        path: The file.
        largest_bytes: That are read.

    Raises:
        TableError: It cannot be read, is larger, or is no text.
    """
    try:
        with path.open("rb") as file:
            content = file.read(largest_bytes + 1)
    except OSError as error:
        raise TableError(path, error.strerror or str(error)) from None
    if len(content) > largest_bytes:
        raise TableError(path, f"larger than {largest_bytes >> 20} MiB: that is no such table")
    encoding = next((name for mark, name in _MARKS.items() if content.startswith(mark)), "utf-8")
    if encoding == "utf-8" and b"\0" in content[:4]:  # UTF-16 without its mark
        encoding = "utf-16-be" if content.startswith(b"\0") else "utf-16-le"
    try:
        return content.decode(encoding)
    except UnicodeDecodeError:
        pass
    text = content.decode("latin-1")
    # A note in an old encoding is text all the same; what is no text has other control characters than these.
    if any(ord(letter) < 32 and letter not in "\t\r\n" for letter in text) or encoding != "utf-8":
        raise TableError(path, "not a table: it is no text")
    return text
