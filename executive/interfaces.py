"""Every seam of the system. An adapter for a real robot, camera or model implements one of these.

All slow work has one shape: a method that starts it returns a request number at once, its end
comes as an `Ended` event with that number, and `cancel` calls it off. Only `Clock.wait` blocks.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from executive.belief import Statement
from executive.language.meaning import Said
from executive.language.spoken import NOTHING, Spoken
from executive.records import NodeState, Record, TreeShape
from executive.types import (
    Called,
    Candidate,
    ChatRequest,
    Command,
    CommandKind,
    Commands,
    Detection,
    Frame,
    Goal,
    OtherColor,
    Place,
    Question,
    RankRequest,
    Scored,
    Verdict,
)


class Robot(Protocol):
    """A mobile manipulator that pursues one goal at a time.

    Starting a goal while another is under way replaces it: the earlier request ends as Failed.
    """

    def start(self, goal: Goal) -> int:
        """Pursue a goal; ends Succeeded, or Failed with a reason that a person understands."""
        ...

    def cancel(self, request: int) -> None:
        """Give up the goal and brake to rest; its end is not delivered."""
        ...

    def views(self, place: str) -> int:
        """How many head poses it takes to see all of a place or of the `floor` (at least 1)."""
        ...

    def seconds(self, start: str, place: str) -> float:
        """How long it takes to drive from one place to another one, `person` and `delivery` too.

        As far as is known before it is tried, within 15 % (and half a second) of what the drive
        then takes; infinite if there is no way, or no such place. It is asked on the ticking
        thread, for all pairs of places: an answer takes microseconds, once it is known.
        """
        ...

    @property
    def holding(self) -> bool | None:
        """Whether both fingers touch a thing; None if the robot cannot tell.

        It is asked when the robot has nothing to do, and is what the robot believes of its hand.
        """
        ...


class Camera(Protocol):
    """A colour and depth camera."""

    def capture(self) -> Frame:
        """The picture of this moment; takes some milliseconds."""
        ...


class Detector(Protocol):
    """Recognises things in a picture."""

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """All known things in the picture, surest first."""
        ...


class Perception(Protocol):
    """A camera and a detector together: takes a picture and says what is in it, and where."""

    def see(self) -> int:
        """Take a picture and recognise; ends Saw, or Failed."""
        ...

    def cancel(self, request: int) -> None:
        """Forget the picture."""
        ...


class LanguageModel(Protocol):
    """A model that writes, and may be able to score."""

    @property
    def name(self) -> str:
        """What to call it in logs."""
        ...

    @property
    def context_tokens(self) -> int:
        """Size of its context window (tokens)."""
        ...

    @property
    def can_rank(self) -> bool:
        """Whether `rank` is available (it needs the model's token probabilities)."""
        ...

    def chat(self, request: ChatRequest) -> int:
        """Write a reply; ends Replied, or Failed."""
        ...

    def rank(self, request: RankRequest) -> int:
        """Score the options; ends Scored, or Failed."""
        ...

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Work out, while nothing is asked, what others share with this request.

        It is no request itself: nothing ends, and the next one takes over what is ready.
        """
        ...

    def cancel(self, request: int) -> None:
        """Stop generating within one token; the reply is not delivered."""
        ...

    def count_tokens(self, text: str) -> int:
        """How many tokens the text takes, by the model's own tokenizer."""
        ...

    def close(self) -> None:
        """Free the model and end its thread."""
        ...


class User(Protocol):
    """The person, or who stands in for them."""

    def ask(self, question: Question) -> int:
        """Put a question; ends Answered, or Failed if no answer can come.

        An answer that says stop stops the mission: `Inbox.end` sees to that.
        """
        ...

    def cancel(self, request: int) -> None:
        """Withdraw the question."""
        ...

    def tell(self, text: str) -> None:
        """Say something that needs no answer."""
        ...


class Knowledge(Protocol):
    """The ontology: which things there are, what they are called, where they usually are."""

    def places(self) -> tuple[Place, ...]:
        """Every piece of furniture of the home, in the home file's order."""
        ...

    def has_place(self, name: str) -> bool:
        """Whether a piece of furniture of this name is in the home."""
        ...

    def called(self, name: str) -> Called | None:
        """How one speaks of an object, a class or a piece of furniture; None if it is unknown."""
        ...

    def objects_named(self, words: str) -> tuple[str, ...]:
        """The objects that the words may mean: none, one, or several ("fruit", "the red one")."""
        ...

    def other_color(self, words: str) -> OtherColor | None:
        """What the words would mean if they did not say the colour: "blue mug", and it is red."""
        ...

    def objects_for(self, purpose: str) -> tuple[str, ...]:
        """The objects that are for this: "to drink from", "clean the bathroom with", "nails"."""
        ...

    def colors(self, name: str) -> tuple[str, ...]:
        """The colours of an object, the chief one first, as they are said."""
        ...

    def uses(self, name: str) -> tuple[str, ...]:
        """What an object is for: "to drink from", "for tea"."""
        ...

    def nearest_names(self, words: str) -> tuple[str, ...]:
        """Known names that look most like the words, best first (at most 3)."""
        ...

    def near_name(self, words: str) -> str | None:
        """The one known name that the words are most likely a slip of, if it is clear."""
        ...

    def names_in(self, words: str) -> tuple[str, ...]:
        """The names of objects and classes that a text has in it, in their order."""
        ...

    def preferred(self, names: Sequence[str]) -> tuple[str, ...]:
        """Those of the objects that the person at home prefers; none if nobody knows who it is."""
        ...

    def usual_places(self, name: str) -> tuple[str, ...]:
        """Default locations of the object or its nearest class, as far as this home has them."""
        ...

    def likely_places(self, name: str) -> Mapping[str, float]:
        """The share of its default locations that each place of this home stands for.

        By its name, as far as what recorded them means this home, and else by its kind. In all at
        most 1: less, if this home has nothing of the kind of some of them.
        """
        ...

    def places_named(self, words: str) -> tuple[str, ...]:
        """Furniture that the words name, in their order; a room stands for its furniture."""
        ...

    def is_place(self, words: str) -> bool:
        """Whether they name furniture or rooms, and nothing else: not "Anna in the kitchen"."""
        ...


class Facts(Protocol):
    """What was seen, said and done so far, in this mission and before it. Never raises."""

    def saw(self, names: Iterable[str], place: str) -> None:
        """These objects were seen there."""
        ...

    def missed(self, name: str, place: str) -> None:
        """It was looked for there, and is not there."""
        ...

    def heard(self, name: str, places: Iterable[str]) -> None:
        """The person said that it is at one of these places, the likeliest first."""
        ...

    def took(self, name: str, place: str) -> None:
        """The robot has it, from there."""
        ...

    def put(self, name: str, place: str) -> None:
        """The robot has put it down there."""
        ...

    def looked(self, place: str) -> None:
        """All of the place was looked at: what was not seen there is not there."""
        ...

    def places_of(self, name: str) -> tuple[str, ...]:
        """Where it was seen or said to be, freshest first, as far as no later look contradicts."""
        ...

    def beliefs(self) -> Mapping[str, Sequence[str]]:
        """Each object that is believed to be anywhere, and where: what a recording keeps."""
        ...

    def origins(self) -> Mapping[str, Sequence[str]]:
        """Each object that the robot took, and from where, the last time first."""
        ...


class Experience(Protocol):
    """What the robot has learned of where things are: how long a sighting is worth, and habits."""

    def learn(self) -> None:
        """Learn from what was seen since the last time; called before a mission, not in it."""
        ...

    def recalled(self, name: str) -> Sequence[Statement]:
        """What memory and habits say of where a thing is now; answers within milliseconds.

        Nothing if it was never seen. The most trusted first; the part of each is of what those
        before it have left.
        """
        ...


class PlaceSource(Protocol):
    """Something that knows where things are: a memory, a calendar, a list on the refrigerator.

    It is asked at the start of a search, before the ontology and the language model, and on the
    ticking thread, where nothing is heard meanwhile, not even a stop: `places_of` has to answer
    within milliseconds. What is slow (a network, a large file) is fetched beforehand.
    """

    @property
    def name(self) -> str:
        """Who says so, in a word: `calendar`. It stands in logs, outcomes and the tree.

        No two sources have the same, and none is called like a `Source`, `person` or `eyes`.
        """
        ...

    @property
    def says(self) -> str:
        """How the person is told who says so, as a clause: "your calendar says so"."""
        ...

    def places_of(self, name: str) -> tuple[str, ...]:
        """Where the object may be, the likeliest first; only places of the home are visited."""
        ...


class PlaceLister(Protocol):
    """Has a language model list places, and lets only real places through.

    The paper's prompting, output parser, memory and consistency verification. `among` holds the
    default locations if the ontology has several, else it is empty: every place is allowed.
    """

    def inquiry(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """`general_pos`, or `multiple_pos` when `among` is given."""
        ...

    def furniture(self, name: str, room: str, among: tuple[str, ...]) -> ChatRequest:
        """`furniture`: which furniture of this room?"""
        ...

    def again(self, name: str, among: tuple[str, ...]) -> ChatRequest:
        """`again`: the reply named no real place; choose from the list."""
        ...

    def summarize(self, name: str, reply: str) -> ChatRequest:
        """`summarize`: the reply was not in the output format."""
        ...

    def remember(self, request: ChatRequest, reply: str) -> None:
        """Keep the exchange for the next prompts (if this system has a memory)."""
        ...

    def read(self, reply: str) -> tuple[str, ...] | None:
        """The names in a reply, or None if it is not in the output format."""
        ...

    def verify(self, names: tuple[str, ...], among: tuple[str, ...]) -> Verdict:
        """Hold names against the ontology (the existence check)."""
        ...


class PlaceRanker(Protocol):
    """Has a language model score the known places: it cannot invent any."""

    def ranking(self, name: str, among: tuple[str, ...]) -> RankRequest:
        """Score every place that is allowed; all are, if `among` is empty."""
        ...

    def ranked(self, scored: Scored) -> tuple[Candidate, ...]:
        """Places with probabilities (they sum to 1), likeliest first."""
        ...


class CommandReader(Protocol):
    """Has a language model read what the grammar of commands cannot."""

    def ranking(self, words: str) -> RankRequest:
        """Score what the words may ask the robot to do."""
        ...

    def ranked(self, scored: Scored) -> CommandKind:
        """The likeliest of these kinds of command."""
        ...

    def inquiry(self, words: str) -> ChatRequest:
        """`command`: what do the words ask for?"""
        ...

    def read(self, reply: str) -> str:
        """What the reply asks for, as a plain sentence for the grammar.

        It is empty if the reply has not the format, or names a thing or a place that is not there.
        """
        ...


@dataclass(frozen=True, slots=True)
class Advice:
    """Who puts questions to the language model, and takes from its answers only what exists."""

    lister: PlaceLister
    ranker: PlaceRanker
    reader: CommandReader


class Interpreter(Protocol):
    """Reads what a person says."""

    def read(self, words: str) -> Said:
        """What the words mean, as far as they can be read."""
        ...

    def commands(self, words: str, spoken: Spoken = NOTHING, *, holds: bool = False) -> Commands:
        """The tasks in the words; none if there are none that can be done.

        Args:
            words: what was said.
            spoken: of what was spoken before: "it", "there" and "another" stand for that.
            holds: whether the hand holds something.
        """
        ...

    def command(self, words: str) -> Command | None:
        """The first of the tasks in the words, or None if there are none."""
        ...

    def remark(self, words: str, spoken: Spoken = NOTHING) -> str:
        """What to say of words that were read and are no command to carry out; empty otherwise.

        Nobody else may make a command of them then: they may say what is not to be done.
        """
        ...

    def denial(self, words: str) -> str:
        """A word among them that denies, if it is not known what; empty if there is none."""
        ...

    def not_understood(self, words: str) -> str:
        """Why nobody could read the words, as a clause: they are of another language, for one."""
        ...

    def passed_over(self, words: str, commands: Sequence[Command]) -> tuple[str, ...]:
        """Numbers and conditions in words that somebody else has read, and none of the commands."""
        ...

    def without_slips(self, words: str) -> Commands:
        """The tasks that the words are with the word for the deed spelled right; none if none."""
        ...

    def talk(self, words: str, things: Sequence[str] = ()) -> str:
        """The answer to small talk, or to who asks for help; empty if it is neither.

        Args:
            words: what was said.
            things: names of things of this home, for examples.
        """
        ...

    def after_yes(self, answer: str) -> Said:
        """What is said behind a yes: "yes, and the pear"; `Unread` if it does not begin so."""
        ...

    def only(self, words: str) -> bool:
        """Whether it says that nothing else is meant: "only the mug", "no, just the pear"."""
        ...

    def declines(self, answer: str) -> bool:
        """Whether an answer says that the person does not know or will not say."""
        ...

    def agrees(self, answer: str) -> bool | None:
        """Whether an answer says yes or no; None if it says neither."""
        ...


class Tree(Protocol):
    """The behaviour tree of one mission."""

    def shape(self) -> TreeShape:
        """All behaviours, parents before children."""
        ...

    def tick(self) -> None:
        """Let the tree decide once. It raises what a behaviour raises."""
        ...

    @property
    def status(self) -> str:
        """INVALID before the first tick, then RUNNING, SUCCESS or FAILURE."""
        ...

    @property
    def tip(self) -> str:
        """Path of the behaviour that decided the last tick."""
        ...

    def states(self) -> tuple[NodeState, ...]:
        """Every behaviour after the last tick."""
        ...

    def stop(self) -> None:
        """Interrupt whatever is running, so that it cancels what it started."""
        ...


class World(Protocol):
    """A simulated world whose time the clock drives."""

    @property
    def busy(self) -> bool:
        """Whether anything moves or is due; if not, time may pass without computing it."""
        ...

    def advance(self, at_most: float) -> float:
        """Let at most so many seconds pass, less if something ends earlier; return how many."""
        ...

    def close(self) -> None:
        """Free the simulator."""
        ...


class SimulatedHome(World, Protocol):
    """A simulated world that can be drawn, and that knows the truth about its things."""

    def describe(self) -> None:
        """Record the whole scene and where everything is; called once a mission."""
        ...

    def resting_place(self, name: str) -> str | None:
        """The furniture that an object rests on, by the simulator's truth; None if on none.

        For the simulated person and for tests: the robot has no access to it.
        """
        ...

    @property
    def held(self) -> str | None:
        """The object that is in the robot's hand, by the simulator's truth; None for none."""
        ...


class Clock(Protocol):
    """Mission time (seconds since the mission began)."""

    def now(self) -> float:
        """The time; it passes within `wait` only, so that a tick is replayed at its own time."""
        ...

    def restart(self) -> None:
        """Call this moment 0."""
        ...

    def wait(self, deadline: float | None) -> None:
        """Let time pass until an event is in the inbox or the deadline is reached."""
        ...


class Recorder(Protocol):
    """Keeps what happened. Never raises: a sink that fails is dropped and the mission goes on."""

    def record(self, record: Record) -> None:
        """Stamp the record with the time and pass it on; called from the ticking thread only."""
        ...
