"""Cyclone DDS, reliable, the newest only, on loopback; nothing is between them."""

import contextlib
import os
from dataclasses import dataclass

from cyclonedds.core import Listener, Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import sequence, uint8
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

KEPT = 8
QOS = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(KEPT))
HERE = """
<CycloneDDS><Domain Id="any">
<General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces></General>
<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer address="localhost"/></Peers></Discovery>
</Domain></CycloneDDS>
"""


@dataclass
class Bytes(IdlStruct, typename="Bytes"):
    """What any message is made of."""

    data: sequence[uint8]


@contextlib.contextmanager
def sending(settings, kind):
    """Sends messages of a kind."""
    participant = _participant(settings)
    writer = DataWriter(participant, Topic(participant, kind, Bytes, qos=QOS), qos=QOS)
    yield lambda payload: writer.write(Bytes(payload))


@contextlib.contextmanager
def receiving(settings, notes):
    """Hands what comes to the notes."""
    participant = _participant(settings)
    readers = [
        DataReader(participant, Topic(participant, kind, Bytes, qos=QOS), qos=QOS, listener=_hearing(hear))
        for kind, hear in (("command", notes.hear), ("picture", notes.see))
    ]
    yield readers


def _participant(settings):
    os.environ["CYCLONEDDS_URI"] = HERE
    return DomainParticipant(settings["ports"][0] % 200)


def _hearing(hear):
    class Hearing(Listener):
        def on_data_available(self, reader):
            for sample in reader.take(N=KEPT):
                hear(bytes(sample.data))

    return Hearing()
