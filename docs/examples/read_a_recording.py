"""What a recording says, in Python: what was asked, said, thought and decided.

    python docs/examples/read_a_recording.py runs/20261125T211315Z-bring-a-sugar-box

`Run` gives back the very records that were made (`executive.records`), each with its time. Only
what is asked for is decoded, so a long mission with pictures is read quickly.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

from logs.recording.reader import Run


def story(folder: Path) -> Iterator[str]:
    """The mission in a few lines."""
    run = Run(folder)
    settings = run.config()
    yield f"run {run.name}, knowledge {settings['knowledge']}, seed {settings['seed']}"
    for said in run.dialog():
        yield f"{said.time_s:8.3f} s  {said.value.speaker}: {said.value.text}"
    for tick in run.ticks():
        yield f"{tick.time_s:8.3f} s  tick {tick.value.number} by {tick.value.cause}"
    for call in run.llm_calls():
        usage = call.value.result.usage
        yield f"{call.time_s:8.3f} s  {usage.model} took {usage.total_s:.2f} s"
    if outcome := run.outcome():  # None: the run was killed before its end
        yield f"{outcome.status}: {outcome.reason}"


if __name__ == "__main__":
    for line in story(Path(sys.argv[1])):
        print(line)
