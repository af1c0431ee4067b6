"""A recording, read back."""

import warnings
from collections import defaultdict

SCALARS, STATE = "Scalars:scalars", "StateChange:state"


class Read:
    """What lies in a file, by entity.

    Args:
        path: of the file.
    """

    def __init__(self, path):
        from rerun.chunk import RrdReader

        self._chunks = defaultdict(list)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a file that broke off has no footer, and the SDK says so
            for chunk in RrdReader(str(path)).stream():
                self._chunks[chunk.entity_path].append(chunk)

    @property
    def entities(self):
        return set(self._chunks)

    def moving(self, entity):
        """The rows of each of an entity's chunks that has a time."""
        return [chunk.num_rows for chunk in self._chunks[entity] if not chunk.is_static]

    def rows(self, entity, component):
        """(time [s], value) of a component, in order."""
        found = []
        for chunk in self._chunks[entity]:
            batch = chunk.to_record_batch().to_pydict()
            if "time" in batch and component in batch:
                found += zip((time.total_seconds() for time in batch["time"]), batch[component], strict=True)
        return sorted(found)

    def values(self, entity, component=SCALARS):
        return [value for _, value in self.rows(entity, component)]

    def states(self, lane):
        """What a lane tells, in order, each once."""
        told = [value[0] for value in self.values(lane, STATE)]
        return [text for before, text in zip([None, *told], told, strict=False) if text != before]

    def journal(self):
        return [text[0] for text in self.values("/journal", "TextLog:text")]
