"""The uncertainty exponent: how much better outcomes are predicted from starts that are known better."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, LARGEST_SEED, MOST_STARTS, checked_study, numbers, refuse, whole
from ._call import ProgressArgument
from ._power_law import Interval, fitted, neighbouring, one_power
from .errors import Interrupted, UndecidedWarning
from .matching import match
from .model import Mapper
from .results import optional
from .study import Study

if TYPE_CHECKING:
    import pandas
    import xarray

_DEFAULT_TOLERANCE = 1e-6  # numerics.tolerance of a Mapper
_FINER = 1e-3  # as for a map's tolerance_flips
_LEAST_TOLERANCE = 1e-14  # of a study
_MOST_DRAWS = 1000  # of starts of touching balls, until they and their neighbours do not overlap
_MOST_UNDECIDED = 0.01


@dataclass(frozen=True, repr=False, eq=False)
class UncertaintyExponent:
    """How the share of pairs of starts with different outcomes grows with their distance.

    All intervals are at 95 %.

    Attributes
    ----------
    study : Study
    balls : tuple[int, ...]
        Balls whose angles differ within a pair, from 1.
    scale : ndarray (n,)
        Distances of the two starts of a pair, rising: root of the sum of squares over these angles, in rad.
    pairs, different : ndarray (n,) of int
        Pairs with two known outcomes at each scale, and those of them whose outcomes differ.
    undecided : int
        Pairs of all scales left out because a start was undecided or failed.
    share, low, high : ndarray (n,)
        ``different / pairs``, with its Wilson interval.
    exponent : float
        alpha of ``share = coefficient * scale ** alpha``; nan if no pairs differ. The boundary in the space of the angles
        `balls` has the dimension ``len(balls) - alpha``.
    interval : tuple[float, float]
        Of `exponent`, by profile likelihood; wider by the root of ``deviance / (n - 2)`` if that is above 1. An end is infinite if
        the pairs do not bound it.
    coefficient : float
    deviance : float
        How far the shares are from one power, on average ``n - 2`` if it holds.
    one_power : bool
        Whether the deviance is below what it exceeds with a probability of 1 % if one power holds at all scales. If not, read
        `local`: the exponent depends on the scale.
    local, local_low, local_high : ndarray (n - 1,)
        The exponent between each scale and the next; nan if no pairs differ at one of them.
    flips, flips_low, flips_high : float
        Share of starts that end elsewhere if followed with 1/1000 of the tolerance, with its Wilson interval.
    smallest_scale : float
        Scale at which the power gives `flips_high`, in rad. Below it, the tolerance may decide as many outcomes as the
        distance does; nan if no pairs differ.

    Examples
    --------
    >>> eq.uncertainty_exponent(oiled, [1e-2, 1e-1], pairs=100).share.shape
    (2,)
    """

    study: Study
    balls: tuple[int, ...]
    scale: Array
    pairs: npt.NDArray[np.int64]
    different: npt.NDArray[np.int64]
    undecided: int
    share: Array
    low: Array
    high: Array
    exponent: float
    interval: Interval
    coefficient: float
    deviance: float
    local: Array
    local_low: Array
    local_high: Array
    flips: float
    flips_low: float
    flips_high: float
    smallest_scale: float

    @property
    def one_power(self) -> bool:
        return one_power(self.deviance, self.scale.size)

    def _columns(self) -> dict[str, tuple[npt.NDArray[Any], str]]:
        """What a table has per scale, with its meaning. A local exponent is in the row of the smaller scale."""
        local = {
            name: np.append(values, np.nan)
            for name, values in (("local", self.local), ("local_low", self.local_low), ("local_high", self.local_high))
        }
        return {
            "pairs": (self.pairs, "pairs with two known outcomes"),
            "different": (self.different, "pairs with different outcomes"),
            "share": (self.share, "share of pairs with different outcomes"),
            "low": (self.low, "lower end of the share's 95 % interval"),
            "high": (self.high, "upper end of the share's 95 % interval"),
            "local": (local["local"], "uncertainty exponent from this scale to the next"),
            "local_low": (local["local_low"], "lower end of its 95 % interval"),
            "local_high": (local["local_high"], "upper end of its 95 % interval"),
        }

    def to_xarray(self) -> xarray.Dataset:
        """A dataset with dimension scale; all that belongs to no scale is an attribute.

        Returns
        -------
        xarray.Dataset

        Raises
        ------
        ModuleNotFoundError
            If xarray is not installed.
        """
        data = {name: ("scale", values, {"units": "1", "long_name": meaning}) for name, (values, meaning) in self._columns().items()}
        scale = ("scale", self.scale, {"units": "rad", "long_name": "distance of the two starts of a pair"})
        whole_of_it = {
            "study": self.study.to_toml(), "balls": list(self.balls), "undecided": self.undecided, "exponent": self.exponent,
            "exponent_interval": list(self.interval), "coefficient": self.coefficient, "deviance": self.deviance,
            "tolerance_flips": self.flips, "tolerance_flips_interval": [self.flips_low, self.flips_high],
            "smallest_scale": self.smallest_scale,
        }
        return optional("xarray").Dataset(data, {"scale": scale}, whole_of_it)

    def to_pandas(self) -> pandas.DataFrame:
        """A table with one row per scale.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ModuleNotFoundError
            If pandas is not installed.
        """
        pandas = optional("pandas")
        columns = {name: values for name, (values, _) in self._columns().items()}
        return pandas.DataFrame(columns, index=pandas.Index(self.scale, name="scale"))

    def __repr__(self) -> str:
        known = f"{self.exponent:.3g} ({self.interval[0]:.3g} to {self.interval[1]:.3g})"
        if np.isnan(self.exponent):
            known = "not known, since no pairs differ"
        if not self.one_power:
            known += f", no single power (local {np.nanmin(self.local):.3g} to {np.nanmax(self.local):.3g})"
        below = f"; scales below {self.smallest_scale:.2g} depend on the tolerance" * bool(self.smallest_scale > self.scale[0])
        return f"<UncertaintyExponent of {self.study.name}: {known}, {self.scale[0]:g} to {self.scale[-1]:g} rad{below}>"


def _overlap(phi: Array, contact: float) -> npt.NDArray[np.bool_]:
    if contact == 0.0 or phi.shape[1] == 1:
        return np.zeros(len(phi), dtype=bool)
    around = np.sort(np.mod(phi, 2.0 * np.pi), axis=1)
    gaps = np.diff(around, axis=1, append=around[:, :1] + 2.0 * np.pi)
    return gaps.min(axis=1) <= contact


def _drawn(random: np.random.Generator, count: int, balls: int, contact: float) -> Array:
    """Ball angles, uniform; of touching balls uniform on what does not overlap."""
    free = random.uniform(0.0, 2.0 * np.pi - balls * contact, (count, balls))
    if contact == 0.0:
        return free
    spaced = np.sort(free, axis=1) + contact * np.arange(balls) + random.uniform(0.0, 2.0 * np.pi, (count, 1))
    return np.mod(random.permuted(spaced, axis=1), 2.0 * np.pi)


def _pairs(
    random: np.random.Generator, scale: float, count: int, study: Study, balls: Sequence[int]
) -> tuple[Array, Array]:
    """Starts and their neighbours, in random directions of the angles of `balls`."""
    contact = float(study.parameters["contact_angle"])
    first, second = np.empty((count, study.balls)), np.empty((count, study.balls))
    open_rows = np.arange(count)
    for _ in range(_MOST_DRAWS):
        step = np.zeros((open_rows.size, study.balls))
        step[:, balls] = random.normal(size=(open_rows.size, len(balls)))
        first[open_rows] = _drawn(random, open_rows.size, study.balls, contact)
        second[open_rows] = first[open_rows] + scale * step / np.linalg.norm(step, axis=1, keepdims=True)
        open_rows = open_rows[_overlap(first[open_rows], contact) | _overlap(second[open_rows], contact)]
        if not open_rows.size:
            return first, second
    refuse("scales", scale, "smaller: displaced balls overlap")


def _checked_scales(scales: Optional[npt.ArrayLike]) -> Array:
    given = np.geomspace(1e-4, 1e-1, 7) if scales is None else numbers("scales", scales)
    if given.ndim != 1 or given.size < 2 or given.dtype.kind not in "fiu":
        refuse("scales", scales, "two distances or more, in rad")
    given = given.astype(float)
    if not (given[0] > 0.0 and given[-1] <= np.pi and np.all(np.diff(given) > 0.0)):
        refuse("scales", scales, "rising distances above 0, at most pi, in rad")
    return given


def _checked_balls(balls: int | Sequence[int] | None, study: Study) -> list[int]:
    """Places of the balls whose angles are displaced, from 0."""
    if not study.balls:
        refuse("study", study, "one with balls")
    if balls is None:
        return list(range(study.balls))
    given = [balls] if np.ndim(balls) == 0 else list(balls)  # type: ignore[arg-type]
    places = [whole("balls", ball, 1, study.balls, ", or several") - 1 for ball in given]
    if not places or len(set(places)) < len(places):
        refuse("balls", balls, f"one or more of the balls 1 to {study.balls}, each once")
    return sorted(places)


def _finer(study: Study) -> Study:
    tolerance = study["numerics.tolerance"] if "numerics.tolerance" in study else _DEFAULT_TOLERANCE
    if _FINER * tolerance < _LEAST_TOLERANCE:
        refuse("study", study, "one with a numerics.tolerance of 1e-11 or more, so that a thousandth of it can be tried")
    return study.replace({"numerics.tolerance": _FINER * tolerance})


def _renamed(labels: npt.NDArray[np.int16], finer: Mapper, mapper: Mapper) -> npt.NDArray[np.int64]:
    """Labels of the finer mapper by the identifiers of the other. Attractors whose names differ are matched."""
    found, known = finer.attractors, mapper.attractors
    agree = {number for number, a in found.items() if number in known and known[number].name == a.name}
    left = [[a for number, a in listed.items() if number not in agree] for listed in (found, known)]
    same = match(left[0], left[1]).same if all(left) else {}
    renamed = labels.astype(np.int64)
    for attractor in left[0]:
        renamed[labels == attractor.id] = same.get(attractor.id, -1000 - attractor.id)  # one that the other lacks
    return renamed


def _known(labels: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    return (labels != 0) & (labels != -2)  # neither undecided nor failed


def uncertainty_exponent(
    study: Study, scales: Optional[npt.ArrayLike] = None, *, pairs: int = 4000, balls: int | Sequence[int] | None = None,
    seed: Optional[int] = None, threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None,
) -> UncertaintyExponent:
    """The uncertainty exponent: by which power of a start's uncertainty does the share of unpredictable outcomes fall?

    At each scale, pairs of starts that far apart are followed. The share of pairs with different outcomes is proportional to
    the scale to the power of the exponent. With an exponent of 1 (smooth boundaries), starts known ten times better
    leave a tenth of the outcomes in doubt; with 0.4, the share only falls to 40 %.

    Every pair starts at ball angles drawn uniformly, even if the study states them; all else is as [initial] says. Pairs of
    different scales are independent, and so are their counts. The fit is the most likely power of binomial counts.

    Parameters
    ----------
    study : Study
        Without uncertain values.
    scales : array_like (n,), optional
        Distances of the two starts of a pair, rising, above 0 and at most pi, in rad; two or more. Default: seven from 1e-4 to
        1e-1, evenly spaced in the logarithm. Check ``local``: at large scales no single power holds.
    pairs : int
        Pairs per scale, 1 or more. Shares below about ``10 / pairs`` have wide intervals.
    balls : int or sequence of int, optional
        Balls whose angles differ within a pair, from 1; default: all. The direction is random.
    seed : int, optional
        Of the starts, 0 or more; default: the study's.
    threads, progress, cpu
        As for :func:`basin`.

    Returns
    -------
    UncertaintyExponent

    Raises
    ------
    StudyError
        For unusable arguments, studies with uncertain values, and a ``numerics.tolerance`` below 1e-11.
    ModuleNotFoundError
        If SciPy is not installed and the searches at the two tolerances list different attractors, which have to be matched.
    Interrupted
        After Ctrl-C; its ``.result`` is None.

    Warns
    -----
    UndecidedWarning
        If more than 1 % of the pairs have a start that is undecided or failed.
    UserWarning
        If a scale is below ``smallest_scale``: its share may be the tolerance's.

    Notes
    -----
    The method is that of Grebogi, McDonald, Ott and Yorke [GMOY]. Intervals of local exponents follow Katz et al. [Katz].

    Examples
    --------
    >>> found = eq.uncertainty_exponent(study, [1e-3, 1e-2, 1e-1], pairs=1000)
    >>> 0.3 < found.exponent < 0.6
    True
    """
    places = _checked_balls(balls, checked_study(study))
    scale = _checked_scales(scales)
    count = whole("pairs", pairs, 1, MOST_STARTS)
    given_seed = study["sampling.seed"] if seed is None else whole("seed", seed, 0, LARGEST_SEED)
    finer_study = _finer(study)
    random = np.random.default_rng(given_seed)
    starts = [_pairs(random, distance, count, study, places) for distance in scale]
    tried = starts[0][0]
    try:
        mapper = Mapper(study, threads=threads, progress=progress, cpu=cpu)
        labels = mapper.labels(np.concatenate([side for pair in starts for side in pair]), threads=threads, progress=progress)
        finer = Mapper(finer_study, threads=threads, progress=progress, cpu=cpu)
        again = _renamed(finer.labels(tried, threads=threads, progress=progress), finer, mapper)
    except Interrupted:
        raise Interrupted(None) from None  # a part of the pairs gives no exponent
    ends = labels.reshape(scale.size, 2, count)
    decided = _known(ends).all(axis=1)
    known = decided.sum(axis=1)
    different = (decided & (ends[:, 0] != ends[:, 1])).sum(axis=1)
    share, low, high = np.array([_core.wilson(int(k), int(n)) for k, n in zip(different, known)]).T
    exponent, interval, coefficient, deviance = fitted(scale, known, different)
    both = _known(ends[0, 0]) & _known(again)
    flips, flips_low, flips_high = _core.wilson(int((both & (ends[0, 0] != again)).sum()), int(both.sum()))
    result = UncertaintyExponent(
        study, tuple(place + 1 for place in places), scale, known, different, int((~decided).sum()), share, low, high,
        exponent, interval, coefficient, deviance, *neighbouring(scale, known, different), flips, flips_low, flips_high,
        (flips_high / coefficient) ** (1.0 / exponent) if exponent > 0.0 else float("nan"),
    )
    _warn(result)
    return result


def _warn(result: UncertaintyExponent) -> None:
    """About what the exponent should not be read from; at the line that called uncertainty_exponent()."""
    left_out = result.undecided / (result.undecided + result.pairs.sum())
    if left_out > _MOST_UNDECIDED:
        warnings.warn(
            f"{100 * left_out:.1f} % of the pairs have an undecided or failed start and are left out "
            "(a longer numerics.horizon may decide them)",
            UndecidedWarning, stacklevel=3,
        )
    if result.smallest_scale > result.scale[0]:
        warnings.warn(
            f"scales below {result.smallest_scale:.2g} rad: the tolerance alone flips up to {100 * result.flips_high:.2g} % of starts; "
            "use larger scales, more pairs or a smaller numerics.tolerance",
            UserWarning, stacklevel=3,
        )
