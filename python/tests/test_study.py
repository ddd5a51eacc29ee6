"""Studies: read, made, changed, refused."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import equipoise as eq
from conftest import studies

PLAIN = dict(
    rotor=dict(eccentricity=0.01, damping=0.5),
    balancer=dict(balls=2, mass=0.05, drag=0.05),
    speed=dict(profile="constant", speed=2.4),
)


def test_a_file_its_text_and_its_tables_are_the_same_study():
    path = studies / "examples" / "washing-machine.toml"
    from_file = eq.Study.from_file(path)
    assert eq.Study.from_toml(path.read_text()) == from_file
    assert eq.Study.from_toml(from_file.to_toml()) == from_file
    assert eq.Study(from_file.to_dict()) == from_file
    assert eq.Study(PLAIN) == eq.Study(**PLAIN)


def test_a_machine_may_be_stated_as_its_data_sheet_states_it():
    sheet = eq.Study(
        rotor=dict(mass="10 kg", natural_frequency="8 Hz", damping_ratio="5 %", unbalance="1500 g mm"),
        place=[
            dict(mass="5 g", radius="80 mm", angle="90 degree"),
            dict(mass={"uniform": ["1 g", "9 g"]}, radius="3 1/4 in", angle={"uniform": ["0 degree", "360 degree"]}),
        ],
        balancer=dict(
            balls=2,
            race_radius="80 mm",
            ball_diameter="18 mm",
            ball_material="steel",
            oil=dict(grade="ISO VG 320", at="40 degC"),
        ),
        speed=dict(profile="constant", speed="1500 1/min"),
    )
    assert eq.Study.from_toml(sheet.to_toml()) == sheet
    assert eq.Study(sheet.to_dict()) == sheet
    one = sheet.replace({"place.2.mass": "4 g", "place.2.angle": "180 degree"})
    unbalance = 1500 - 4 * 3.25 * 25.4 + 400j  # g mm
    assert one["rotor.eccentricity"] == pytest.approx(abs(unbalance) * 1e-6 / 10 / 0.08, rel=1e-12)
    with pytest.raises(eq.StudyError, match="entries place.1 to place.2"):
        sheet.replace({"place.3.mass": "4 g"})


def test_values_that_others_follow_from_are_as_they_are_stated():
    machine = eq.new("washing-machine")
    assert machine["rotor.mass"] == "40 kg" and "rotor.mass" in machine and machine["rotor.eccentricity"] > 0.0
    assert machine.replace({"rotor.mass": "50 kg"})["rotor.mass"] == "50 kg"
    for wrong in ("rotor.weight", "rotor.mass.unit", 3):
        with pytest.raises(KeyError):
            machine[wrong]


def test_values_are_replaced_by_dotted_key_without_touching_the_original():
    study = eq.Study(**PLAIN)
    other = study.replace(**{"speed.final": 2.6, "initial.phi": np.array([1.0, 4.0])})
    assert (study["speed.speed"], other["speed.speed"]) == (2.4, 2.6)
    assert other["initial.phi"] == [1.0, 4.0]
    ramp = study.replace(speed={"profile": "ramp", "initial": 0, "final": 3, "duration": np.float64(25)})
    assert ramp["speed.final"] == 3.0
    with pytest.raises(KeyError):
        study["speed.nothing"]


def test_quantities_are_text_with_units_or_of_pint():
    machine = eq.Study.from_file(studies / "examples" / "washing-machine.toml")
    as_text = machine.replace({"speed.final": "900 rpm", "rotor.unbalance": "150 g mm"})
    pint = pytest.importorskip("pint")
    units = pint.UnitRegistry()
    as_pint = machine.replace(
        {"speed.final": 900 * units.rpm, "rotor.unbalance": 150 * units.gram * units.millimeter}
    )
    # Units are converted by pint in one and by the library in the other: alike to rounding.
    for key in ("speed.final", "rotor.eccentricity"):
        assert as_pint[key] == pytest.approx(as_text[key], rel=1e-12)
    assert as_text["speed.final"] != machine["speed.final"]


@pytest.mark.parametrize(
    ("key", "value", "allowed"),
    [("rotor.damping", -0.5, "at least 0"), ("balancer.balls", 2.5, "whole number"), ("speed.final", "fast", "")],
)
def test_what_is_no_study_is_refused_by_key_value_and_what_is_allowed(key, value, allowed):
    with pytest.raises(eq.StudyError) as error:
        eq.Study(**PLAIN).replace({key: value})
    assert error.value.key in (key, "speed.speed")
    assert allowed in error.value.allowed
    assert error.value.value.strip('"') in str(value)
    again = pickle.loads(pickle.dumps(error.value))
    assert (str(again), again.key, again.allowed) == (str(error.value), error.value.key, error.value.allowed)


def test_the_message_is_the_programs(program, tmp_path):
    text = (studies / "paper" / "table-2-omega-2.4.toml").read_text().replace("damping = 0.5", "damping = -0.5")
    path = tmp_path / "wrong.toml"
    path.write_text(text)
    with pytest.raises(eq.StudyError) as error:
        eq.Study.from_file(path)
    told = program("basin", path)
    assert told.returncode == 2
    assert str(error.value) in told.stderr


def test_tables_with_unusable_values_are_refused():
    with pytest.raises(eq.StudyError, match="mass"):
        eq.Study(**{**PLAIN, "balancer": dict(balls=2, mass=object(), drag=0.05)})
    with pytest.raises(eq.StudyError, match="whels"):
        eq.Study(**PLAIN, whels={"number": 3})


def test_studies_pickle_print_and_hash(tmp_path):
    study = eq.Study(**PLAIN).replace({"speed.final": 2.5})
    again = pickle.loads(pickle.dumps(study))
    assert again == study and hash(again) == hash(study)
    assert "2 balls" in repr(study) and "2.5" in repr(study)
    assert "<table>" in study._repr_html_()
    study.save(tmp_path / "study.toml")
    assert eq.Study.from_file(tmp_path / "study.toml") == study


def test_the_papers_studies_are_the_files():
    names = eq.paper_studies()
    assert "table-2-omega-2.4" in names and len(names) == len(set(names)) > 90
    for name in ("table-2-omega-2.4", "table-3-t0-25"):
        law = eq.Study.from_file(studies / "paper" / f"{name}.toml").to_dict()["speed"].get("law", "kinematic")
        assert eq.paper_study(name, law).to_toml() == eq.Study.from_file(studies / "paper" / f"{name}.toml").to_toml()
    with pytest.raises(eq.StudyError, match="paper_studies"):
        eq.paper_study("table-9")


@pytest.mark.parametrize("key", [
    "rotor.eccentricity=0.5 # ", "rotor.eccentricity\n", "a b", "", ".", "rotor.", "rotor..mass", "rotor.'mass'", 3, "#",
])
def test_what_is_replaced_is_named_by_a_key_alone(key):
    study = eq.Study.from_file(studies / "paper/table-2-omega-2.4.toml")
    with pytest.raises(eq.StudyError):
        study.replace({key: 1})
    with pytest.raises(eq.StudyError):
        study.replace(rotor={"eccentricity = 0.01, damping": 0.5})


def test_a_study_has_a_final_speed_under_the_name_that_replace_takes(study):
    assert study.replace({"speed.final": 2.6})["speed.final"] == 2.6
    points = study.replace({"speed": {"profile": "points", "times": [0, 50, 100], "speeds": [0, 3, 2.5]}})
    assert points["speed.final"] == 2.5 and "speed.final" in points
    motor = studies / "paper-rotor-with-motor.toml"
    assert "speed.final" not in eq.Study.from_file(motor)
