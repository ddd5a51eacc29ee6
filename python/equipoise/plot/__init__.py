"""Pictures of results, drawn with matplotlib.

Every function takes a result and, as `ax`, the axes to draw into (None: a new figure), and returns the axes. TypeError:
the result is of another call; ValueError: there is no such choice, or a number is out of its range. A colour belongs to
an attractor's identifier in every picture; colours are distinguished by any kind of colour vision. Lengths are in mm, forces
in N, times in s of a study in physical units; else in race radii R, M R omega_c^2 and 1/omega_c. matplotlib is imported
when the first picture is drawn.

`shares`, `transients`
    of an ensemble (`equipoise.basin`)
`sweep`, `branches`
    along parameters (`equipoise.sweep`, `equipoise.follow`)
`map`, `stability`, `chart`
    over a plane (`equipoise.map`, `equipoise.stability`, `equipoise.chart`)
`trajectory`, `disc`, `animate`
    of one motion (`equipoise.simulate`, `equipoise.attractors`)
"""

from .animation import animate
from .charts import chart
from .ensembles import shares, transients
from .machine import disc
from .parameters import branches, sweep
from .plane import map, stability
from .trajectories import trajectory

__all__ = ["animate", "branches", "chart", "disc", "map", "shares", "stability", "sweep", "trajectory", "transients"]
