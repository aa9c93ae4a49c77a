"""What the experimenter's page is told while a run is being read."""

from executive.page.experiment.desk import Desk
from executive.page.experiment.reel import Reel
from executive.page.experiment.reels import LIVE
from executive.testing.bench import run_mission
from executive.types.outcome import Outcome


class ReadMeanwhile(Reel):
    """As if the thread that reads it came to its end just when somebody asks how far it is."""

    def __init__(self, end: Outcome) -> None:
        super().__init__(LIVE)
        self._end = end

    @property
    def last(self) -> int:
        self.outcome, self.whole = self._end, True
        return super().last


def test_a_run_is_not_called_whole_without_its_end() -> None:
    end = run_mission("Find a mug", llm=False).outcome
    desk = Desk()
    desk.live.reel = ReadMeanwhile(end)
    first, second = desk.run(LIVE), desk.run(LIVE)
    assert (first["whole"], first["status"]) == (False, "")
    assert (second["whole"], second["status"]) == (True, end.status)
