"""Will a ball balancer work on this rotor? How reliably, how fast, and how hard will the machine vibrate on the way up to speed?

    import equipoise as eq
    study = eq.paper_study("table-2-omega-2.4")
    answer = eq.basin(study, starts=20000)
    answer.shares["balanced"], answer.errors["balanced"]

Quantities are dimensionless (length R, time 1/omega_c, mass M) unless they are given, or said to be, in units.

In the examples, ``study`` is this one with 400 starts, ``oiled`` has ``balancer.drag`` 0.25, so that every start balances, and
``machine`` is ``eq.new("washing-machine")``.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from . import _core
from .attractor import Attractor
from .branches import Branch, FollowedBranch
from .capacities import CapacityResult, capacity
from .charts import ChartResult, Curve, SpecialPoint, chart
from .comparisons import Comparison, Difference, compare
from .designs import DesignResult, design
from .ensembles import BasinResult, ShareBy, basin
from .errors import Interrupted, RunError, StudyError, UndecidedWarning
from .explanations import Explanation, StudyCheck, check, explain, machines, new
from .files import CertificateCheck, Inspection, check_certificates, inspect, merge
from .maps import MapResult, map as map
from .matching import Matching, match, match_along
from .model import Mapper, Model
from .motions import AttractorsResult, BranchesResult, CertifyResult, attractors, certify, follow
from .pages import Replay, Report, replay, report
from .paper import Reproduction, reproduce, reproducible
from .stability_planes import StabilityResult, stability
from .state import State
from .study import Study, paper_studies, paper_study
from .sweeps import SweepResult, sweep
from .trajectory import Trajectories, Trajectory, simulate
from .uncertainty import UncertaintyExponent, uncertainty_exponent

if TYPE_CHECKING:
    from . import plot as plot

__version__: str = _core.version

__all__ = [
    "Attractor", "AttractorsResult", "BasinResult", "Branch", "BranchesResult", "CapacityResult",
    "CertificateCheck", "CertifyResult", "ChartResult", "Comparison", "Curve", "DesignResult", "Difference", "Explanation", "FollowedBranch", "Inspection",
    "Interrupted", "MapResult", "Mapper", "Matching", "Model", "Replay", "Report", "Reproduction", "RunError", "ShareBy", "SpecialPoint", "StabilityResult",
    "State", "Study", "StudyCheck", "StudyError", "SweepResult", "Trajectories", "Trajectory", "UncertaintyExponent", "UndecidedWarning", "attractors", "basin",
    "capacity", "certify", "chart", "check", "check_certificates", "compare", "cpu_targets", "design", "explain", "follow", "inspect",
    "machines", "match", "match_along", "merge", "new", "paper_studies", "paper_study", "plot", "replay", "report", "reproduce",
    "reproducible", "simulate", "stability", "sweep", "uncertainty_exponent",
]


def cpu_targets() -> list[str]:
    """Instruction sets that this machine and this build have, best first.

    Returns
    -------
    list[str]
        Values of `cpu` in other calls, such as "AVX2" or "scalar".

    Examples
    --------
    >>> eq.cpu_targets()[-1]
    'scalar'
    """
    return list(_core.cpu_targets())


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def __getattr__(name: str) -> Any:
    if name == "plot":  # matplotlib is loaded when it is first wanted
        return importlib.import_module(".plot", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
