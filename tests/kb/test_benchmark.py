"""The benchmark of common sense: `python -m kb.benchmark`."""

import importlib.util
import itertools
import json
import math
from contextlib import closing
from dataclasses import replace
from math import log

import pytest

import kb.benchmark.__main__ as benchmark
from executive.errors import InputError
from executive.events import Inbox
from executive.types.home import Place
from executive.types.llm import RankRequest
from kb.advice.prompts import Prompts
from kb.advice.ranking import Known
from kb.benchmark.calibration import Calibration, calibration
from kb.benchmark.measures import Measures, expected_of_chance, mean, measure
from kb.benchmark.placements import Placements, preposition
from kb.benchmark.questions import DataSet, Item, placements, survey
from kb.benchmark.running import CHANCE, HINDSIGHT, POPULARITY, WORDS, _model, table
from kb.benchmark.trials import (
    ALIKE,
    COUNTS,
    NEUTRAL,
    PLAIN,
    RANKED,
    WRITTEN,
    Journal,
    ranking,
    writing,
)
from kb.llm.scripted import Scripted

FOLDS = {
    "train": {
        "red apple": {"category": "food", "locations": ["fridge"]},
        "green apple": {"category": "food", "locations": ["fridge", "shelf"]},
        "cap": {"category": "clothing", "locations": ["hat rack"]},
    },
    "valid": {"pear": {"category": "food", "locations": ["fridge"]}},
    "test": {
        "old apple": {"category": "food", "locations": ["fridge"]},
        "top hat": {"category": "clothing", "locations": ["hat rack"]},
    },
}


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "folds.json"
    path.write_text(json.dumps(FOLDS))
    return path


@pytest.fixture
def data(file) -> DataSet:
    return placements(Placements(file), "test")


def scripted(replies) -> tuple[Scripted, Inbox]:
    inbox = Inbox()
    return Scripted(replies, inbox), inbox


def ways(rows) -> dict:
    return {row.way: row.measures for row in rows}


# --- measures ---


def test_a_perfect_order_has_every_measure_at_one():
    assert measure(["a", "b", "c"], {"a", "b"}) == Measures(1, 1, 1, 1, 1)


def test_right_places_at_ranks_two_and_four():
    found = measure(["x", "a", "y", "b"], {"a", "b"})
    assert (found.first, found.in_three, found.in_five) == (0, 1, 1)
    assert found.reciprocal_rank == 1 / 2
    assert found.average_precision == (1 / 2 + 2 / 4) / 2


def test_a_right_place_that_is_left_out_is_never_found():
    assert measure([], {"a"}).average_precision == measure([], {"a"}).reciprocal_rank == 0
    assert measure(["a"], {"a", "b"}).average_precision == 1 / 2


@pytest.mark.parametrize(("places", "right"), [(1, 1), (4, 1), (5, 2), (6, 6), (7, 3)])
def test_chance_is_the_mean_over_all_orders(places, right):
    orders = itertools.permutations(map(str, range(places)))
    counted = mean(measure(order, set(map(str, range(right)))) for order in orders)
    exact = expected_of_chance(places, right)
    for name in ("first", "in_three", "in_five", "reciprocal_rank", "average_precision"):
        assert getattr(exact, name) == pytest.approx(getattr(counted, name)), name


# --- what is asked ---


def test_the_survey_asks_for_each_row_that_has_places_among_all_surveyed_furniture():
    data = survey()
    assert len(data.questions) == 16
    assert {place for question in data.questions for place in question.thing.places} == {
        place.name for place in data.places
    }
    assert not any(question.others for question in data.questions)
    assert ("in the cabinet in the kitchen") in [answer for _, answer in data.answers]


def test_what_is_asked_for_is_not_among_what_is_known():
    for question in survey(rest=True).questions:
        assert len(question.others) == 15
        assert question.thing not in question.others


def test_placements_are_asked_for_with_only_the_train_fold_known(data):
    assert [question.thing.name for question in data.questions] == ["old apple", "top hat"]
    for question in data.questions:
        assert {known.name for known in question.others} == set(FOLDS["train"])
    assert dict((place.name, answer) for place, answer in data.answers) == {
        "fridge": "in the fridge",
        "hat rack": "on the hat rack",
        "shelf": "on the shelf",
    }


def test_new_placements_are_of_nouns_that_nothing_known_has(file):
    (question,) = placements(Placements(file), "test", new=True).questions
    assert question.thing.name == "top hat"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[]", "should be"),
        ('{"train": {}}', "valid: Field required"),
        ('{"train": {"mug": {"category": "x", "locations": []}}}', "train.mug.locations"),
        ("\x00", "Invalid JSON"),
    ],
)
def test_a_file_of_something_else_is_named_with_its_fault(tmp_path, text, said):
    path = tmp_path / "folds.json"
    path.write_text(text)
    with pytest.raises(InputError, match=r"folds\.json.*" + said.split(":")[0]):
        Placements(path)


def test_without_the_package_it_is_said_how_to_get_it(monkeypatch, capsys):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    assert benchmark.main(["--data", "placements", "--llm", "none"]) == 2
    assert "pip install --no-deps textworld-express" in capsys.readouterr().err


@pytest.mark.skipif(
    importlib.util.find_spec("textworld_express") is None, reason="textworld-express is not there"
)
def test_the_installed_placements_are_those_that_the_paper_counts():
    data = Placements()
    assert [len(fold) for fold in data.folds.values()] == [251, 125, 125]
    assert len(data.places()) == 39
    names = [known.name for fold in data.folds.values() for known in fold]
    assert len(set(names)) == len(names) == 501
    assert {preposition(place) for place in data.places()} == {"in", "on"}


# --- the tables ---


def test_without_a_model_there_are_chance_counts_and_like_names(data):
    found = ways(table(data, None, Journal(None, {})))
    assert list(found) == [CHANCE, POPULARITY, WORDS]
    assert found[CHANCE].first == pytest.approx(1 / 3)
    assert found[POPULARITY].first == 1 / 2
    assert found[WORDS].first == 1


def test_where_nothing_is_known_popularity_is_that_of_the_answers():
    assert list(ways(table(survey(), None, Journal(None, {})))) == [CHANCE, HINDSIGHT]


def test_a_model_that_scores_is_asked_with_all_means_first_and_then_with_less(data):
    right, wrong = [0.0, -1.0, -2.0], [-2.0, -1.0, 0.0]
    model, inbox = scripted([right, wrong, wrong, wrong, right, wrong, wrong, wrong])
    ask = ranking(data, model, inbox, Prompts.load())
    *others, plain, neutral, counts, alike, ranked = table(data, ask, Journal(None, {}))
    assert [row.way for row in (plain, neutral, counts, alike, ranked)] == [
        PLAIN, NEUTRAL, COUNTS, ALIKE, RANKED,
    ]  # fmt: skip
    assert (ranked.measures.first, plain.measures.first) == (1 / 2, 0)
    assert ranked.tokens is not None
    assert plain.tokens is None
    full, less, bare, classless = model.requests[:4]
    assert isinstance(full, RankRequest)
    assert [p.places for p in full.precedents] == [("fridge",), ("fridge", "shelf"), ("hat rack",)]
    assert (less.precedents, bare.precedents, bare.neutral) == ((), (), ())
    assert {precedent.kind for precedent in classless.precedents} == {""}


def test_a_list_that_is_written_counts_with_what_is_left_of_it(data):
    model, inbox = scripted(['{"places": ["pantry", "fridge"]}', "no idea"])
    *_, row = table(data, writing(data, model, inbox, Prompts.load()), Journal(None, {}))
    assert row.way == WRITTEN
    assert row.measures.average_precision == 1 / 2


def test_a_run_that_was_stopped_goes_on_where_it_was(data, tmp_path):
    file, run = tmp_path / "journal", {"llm": "scripted"}
    first = replace(data, questions=data.questions[:1])
    model, inbox = scripted(['{"places": ["fridge"]}'])
    table(first, writing(first, model, inbox, Prompts.load()), Journal(file, run))
    model, inbox = scripted(['{"places": ["hat rack"]}'])
    *_, row = table(data, writing(data, model, inbox, Prompts.load()), Journal(file, run))
    assert row.measures.first == 1
    assert len(model.requests) == 1


def test_an_answer_that_was_broken_off_is_asked_for_again(data, tmp_path):
    file, run = tmp_path / "journal", {"llm": "scripted"}
    for reply in ('{"places": ["fridge"]}', '{"places": ["hat rack"]}'):
        model, inbox = scripted([reply] * len(data.questions))
        table(data, writing(data, model, inbox, Prompts.load()), Journal(file, run))
        file.write_text(file.read_text()[:-5])
    assert len(model.requests) == 1
    assert [line["orders"] for line in map(json.loads, file.read_text().splitlines()[1:2])] == [
        {WRITTEN: ["fridge"]}
    ]


@pytest.mark.parametrize("text", ['{"llm": "another"}', "no journal", "[]\n[]"])
def test_the_journal_of_another_run_is_refused(tmp_path, text):
    file = tmp_path / "journal"
    file.write_text(text)
    with pytest.raises(InputError, match="name another"):
        Journal(file, {"llm": "scripted"})
    assert file.read_text() == text


# --- the command ---


def test_the_command_prints_a_table_or_json_and_draws_it(file, tmp_path, capsys):
    pytest.importorskip("matplotlib")
    plot = tmp_path / "benchmark.svg"
    asked = ["--llm", "none", "--placements", str(file)]
    assert benchmark.main([*asked, "--plot", str(plot)]) == 0
    printed = capsys.readouterr().out
    assert "3 places, 2 objects" in printed
    assert POPULARITY in plot.read_text()
    assert benchmark.main([*asked, "--json", "--data", "placements"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["data"]["placements-test"]["ways"][0]["way"] == CHANCE


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--plot", "table.doc"], "name a file in a folder that exists, with .svg"),
        (["--plot", "nowhere/table.svg"], "name a file in a folder that exists"),
        (["--llm", "http://127.0.0.1:9/v1", "--elicit", "rank"], "use --elicit generate"),
        (["--llm", "nothing.gguf"], "cannot be read"),
        (["--llm", "none", "--journal", "nowhere/journal"], "name another file"),
        (["--llm", "http://127.0.0.1:9/v1", "--objects", "1"], "cannot be reached"),
    ],
)
def test_what_cannot_be_is_said_in_one_line(arguments, said, capsys):
    if "--plot" in arguments:
        pytest.importorskip("matplotlib")
    assert benchmark.main(["--data", "survey", *arguments]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.llm
def test_the_embedded_model_learns_from_what_is_known(file, capsys):
    home = Place("fridge", "Refrigerator", "kitchen", "Kitchen")
    shelf = Place("shelf", "Shelf", "garage", "Garage")
    known = [("saw", "shelf"), ("milk", "fridge"), ("butter", "fridge"), ("nails", "shelf")]
    others = tuple(Known(name, "", (place,)) for name, place in known)
    data = DataSet(
        "two",
        "",
        ((home, "in the fridge in the kitchen"), (shelf, "on the shelf in the garage")),
        (Item(Known("cheese", "", ("fridge",)), others),
         Item(Known("pliers", "", ("shelf",)), others)),
    )  # fmt: skip
    inbox = Inbox()
    with closing(_model(benchmark.parser().parse_args([]), inbox)) as model:
        rows = table(data, ranking(data, model, inbox, Prompts.load()), Journal(None, {}))
    assert rows[-1].way == RANKED
    assert rows[-1].measures.first == 1
    assert math.isfinite(rows[-1].seconds)


def test_who_is_as_often_right_as_they_say_is_calibrated() -> None:
    told = [({"desk": 0.75, "sofa": 0.25}, [place]) for place in ("desk", "desk", "desk", "sofa")]
    found = calibration(told)
    assert found.error == pytest.approx(0)
    assert found.bins == ((0.75, 0.75, 4),)
    assert found.log_score == pytest.approx((3 * log(0.75) + log(0.25)) / 4)


def test_a_belief_that_is_far_too_sure_shows() -> None:
    told = [({"desk": 1.0, "sofa": 0.0}, [place]) for place in ("desk", "sofa")]
    found = calibration(told)
    assert found.error == pytest.approx(0.5)
    assert found.log_score < log(0.01)


def test_of_two_right_places_each_is_half_right() -> None:
    assert calibration([({"desk": 0.5, "sofa": 0.5}, ["desk", "sofa"])]).error == pytest.approx(0)


def test_the_reliability_is_drawn(tmp_path) -> None:
    pytest.importorskip("matplotlib")
    from kb.benchmark import plot

    told = [({"desk": 0.75, "sofa": 0.25}, ["desk"]), ({"desk": 0.2, "sofa": 0.8}, ["desk"])]
    plot.draw_reliability(tmp_path / "it.svg", {"a data set": calibration(told)})
    assert "calibration error 0.53" in (tmp_path / "it.svg").read_text()


def test_numbers_of_like_probabilities_are_drawn_beside_each_other() -> None:
    pytest.importorskip("matplotlib")
    from matplotlib.text import Text

    from kb.benchmark import plot

    found = Calibration(0.1, -1.0, ((0.19, 0.25, 120), (0.21, 0.25, 104), (0.99, 1.0, 3)))
    figure = plot.reliability({"a data set": found})
    figure.draw_without_rendering()
    boxes = {
        text.get_text(): text.get_window_extent()
        for text in figure.findobj(Text)
        if text.get_text() in {"120", "104", "3"}
    }
    assert len(boxes) == 3
    assert not any(a.overlaps(b) for a, b in itertools.combinations(boxes.values(), 2))


def test_what_the_robot_does_tells_probabilities(data) -> None:
    answers = iter([[[2.0, 1.0, 0.0]] * 5] * 2)
    inbox = Inbox()
    model = Scripted([row for rows in answers for row in rows], inbox)
    rows = table(data, ranking(data, model, inbox, Prompts.load()), Journal(None, {}))
    assert rows[-1].calibration is not None
    assert 0 <= rows[-1].calibration.error <= 1
