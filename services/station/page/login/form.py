"""What a browser sends of a form: name and password, and not more than these can be."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from urllib.parse import parse_qs

from starlette.requests import ClientDisconnect, Request

LARGEST = 8192
"""Of a form [byte]; a password of a thousand bytes is thrice as long in it."""

LONGEST_NAME = 64

WITHIN_S = 10.0

FIELDS = ("name", "password")


class NoForm(Exception):
    """Something else came."""


@dataclass(frozen=True)
class Form:
    """Who somebody says to be.

    Attributes:
        name: of at most `LONGEST_NAME` characters.
        password: as it was typed.
    """

    name: str
    password: str


async def read(request: Request) -> Form:
    """The form that a request carries.

    Raises:
        NoForm: it carries something else, or does not come.
    """
    try:
        async with asyncio.timeout(WITHIN_S):
            body = await _body(request)
        fields = parse_qs(body.decode("ascii"), keep_blank_values=True, errors="strict", max_num_fields=len(FIELDS))
        (name,), (password,) = (fields[field] for field in FIELDS)
    except (TimeoutError, ClientDisconnect, ValueError, KeyError):  # no ASCII, no UTF-8, a field twice
        raise NoForm from None
    name = name.strip()
    if len(name) > LONGEST_NAME:
        raise NoForm
    return Form(name, password)


async def _body(request: Request) -> bytes:
    body = b""
    async for part in request.stream():
        body += part
        if len(body) > LARGEST:
            raise NoForm
    return body
