"""A campaign on a Dask cluster: workers run missions, this process keeps the journal.

A worker gets one mission of its block after the other, with the dialogue of those before, and keeps
the block's model loaded in between. Only this process writes results to the journal, so that no
mission counts twice. If a worker is lost, the scheduler gives its mission to another one, which
takes over the block.
"""

import threading
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import suppress
from dataclasses import dataclass

from distributed import Client, Future, KilledWorker, wait

from executive.campaign import blocks
from executive.campaign.blocks import Block, entries_of
from executive.campaign.journal import Entry, Journal
from executive.campaign.runners import POLL_S
from executive.errors import ExecutiveError, InputError

CONNECTING_S = 20


@dataclass(slots=True)
class _Turns:
    """The progress of a block, and the address of the worker that has its model loaded."""

    block: Block
    before: list[Entry]
    worker: str = ""

    @property
    def next(self) -> int | None:
        """Index of the block's next mission; None if all have ended."""
        ended = {entry.row.key for entry in self.before}
        left = (turn for turn, key in enumerate(self.block.keys) if key not in ended)
        return next(left, None)


class Cluster:
    """Implements `Runner`: each worker process of a cluster runs one mission at a time."""

    def __init__(self, address: str) -> None:
        """Use the workers of the scheduler at this address, `tcp://host:8786`."""
        self._address = address
        self._waiting: list[_Turns] = []
        self._under_way: dict[Future[Entry], _Turns] = {}

    def run(
        self, campaign: Sequence[Block], journal: Journal, progress: Callable[[], None]
    ) -> None:
        """Run the remaining missions on all workers; workers may join and leave meanwhile.

        Raises:
            ExecutiveError: if there is no scheduler at the address, or the connection is lost.
        """
        before = journal.entries()
        turns = (_Turns(block, entries_of(block, before)) for block in campaign)
        self._waiting = [one for one in turns if one.next is not None]
        with self._connect() as client:
            try:
                while self._waiting or self._under_way:
                    self._hand_out(client)
                    for entry in self._take_in():
                        journal.append(entry)
                        progress()
            finally:
                client.cancel(list(self._under_way))

    def _connect(self) -> Client:
        try:
            return Client(self._address, timeout=CONNECTING_S)
        except (OSError, ValueError) as error:
            right = "start one with `dask scheduler`, and workers with `dask worker ADDRESS`"
            raise InputError(f"--cluster {self._address}", str(error), right) from None

    def _hand_out(self, client: Client) -> None:
        """Give each idle worker a mission, of its own block if it has one."""
        workers = set(client.nthreads())
        for worker in workers - {turns.worker for turns in self._under_way.values()}:
            if not self._waiting:
                return
            turns = min(self._waiting, key=lambda t: (t.worker != worker, t.worker in workers))
            self._waiting.remove(turns)
            turns.worker = worker
            future = client.submit(
                next_mission,
                turns.block,
                turns.before,
                workers=[worker],
                allow_other_workers=True,
                pure=False,
            )
            self._under_way[future] = turns

    def _take_in(self) -> Iterator[Entry]:
        """Wait briefly, and collect the missions that have ended."""
        if not self._under_way:
            time.sleep(POLL_S)
            return
        with suppress(TimeoutError):
            wait(list(self._under_way), timeout=POLL_S, return_when="FIRST_COMPLETED")
        for future in [future for future in self._under_way if future.done()]:
            turns = self._under_way.pop(future)
            entry = _result(future, turns)
            turns.before = [*turns.before, entry]
            if turns.next is not None:
                self._waiting.append(turns)
            yield entry


def _result(future: Future[Entry], turns: _Turns) -> Entry:
    """The entry of a mission; it has crashed if it killed every worker that tried it."""
    try:
        return future.result()
    except KilledWorker:
        assert turns.next is not None
        error = ExecutiveError("its worker process died, and so did those of other attempts")
        return Entry(blocks.crash(turns.next, turns.block.keys[turns.next], error))
    except CancelledError:
        raise ExecutiveError("the scheduler is lost; the same command goes on from here") from None


# --- in a worker process of the cluster ---

_turn = threading.Lock()
_block: Block | None = None
_so_far = 0
_missions: Generator[Entry, None, None] | None = None


def next_mission(block: Block, before: Sequence[Entry]) -> Entry:
    """Run the first mission of the block that is not in `before`; one at a time."""
    global _block, _so_far, _missions
    with _turn:
        if _missions is None or (block, len(before)) != (_block, _so_far):
            if _missions:
                _missions.close()
            _missions = blocks.run(block, before)
        _block, _so_far = block, len(before) + 1
        return next(_missions)
