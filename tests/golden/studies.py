"""The studies whose fates, and whose answers in every form, are on record."""
ROW = "paper/table-2-omega-2.4.toml"
RAMP = "paper/table-3-t0-100.toml"
MOTOR = "paper-rotor-with-motor.toml"
GRINDER = "examples/angle-grinder.toml"
CENTRIFUGE = "examples/laboratory-centrifuge.toml"
DRIVE = "examples/optical-drive.toml"
WASHER = "examples/washing-machine.toml"
TILTING_WASHER = "tilting-washer.toml"
SPIN_UP = "designs/gentle-spin-up.toml"

TOUCH = ["balancer.contact_angle=0.3", "balancer.restitution=0.4"]
STICK = ["balancer.rolling=1e-3", "balancer.stiction=2e-3"]
UNCERTAIN = ["rotor.eccentricity={uniform=[0.008, 0.012]}"]

# name: (file, overrides, starts whose fates are on record). One for every kind of system that the engine distinguishes.
FATES = {
    "row": (ROW, [], 1000),
    "row-slow": ("paper/table-1-beta-0.01-omega-1.5.toml", [], 500),
    "row-sobol": (ROW, ["sampling.method=sobol"], 500),
    "row-released": ("paper/table-4-omega-3.0.toml", [], 500),
    "ramp": (RAMP, [], 200),
    "spin-up": (SPIN_UP, [], 200),
    "motor": (MOTOR, [], 200),
    "captured": ("captured-at-resonance.toml", [], 100),
    "stiffness-differs": (ROW, ["rotor.stiffness=[1.0, 1.2]"], 300),
    "gravity": (ROW, ["rotor.gravity=0.001"], 300),
    "three-balls": (ROW, ["balancer.balls=3"], 300),
    "six-balls": (ROW, ["balancer.balls=6", "balancer.mass=0.02"], 200),
    "unlike-balls": (ROW, ["balancer.mass=[0.05, 0.04]"], 300),
    "race-off-centre": (ROW, ["balancer.race_offset=[0.002, 0.001]"], 300),
    "touching": (ROW, TOUCH, 200),
    "sticking": (ROW, STICK, 100),
    "uncertain": (ROW, UNCERTAIN, 200),
    "grinder": (GRINDER, [], 60),
    "centrifuge": (CENTRIFUGE, [], 60),
    "optical-drive": (DRIVE, [], 30),
    "washer": (WASHER, [], 60),
    "tilting-rotor": ("long-rotor.toml", [], 100),
    "tilting-washer": (TILTING_WASHER, [], 60),
}

# The same for the results of every command.
ANSWERS = {
    "row": (ROW, []),
    "ramp": (RAMP, []),
    "motor": (MOTOR, []),
    "gravity": (ROW, ["rotor.gravity=0.001"]),
    "three-balls": (ROW, ["balancer.balls=3"]),
    "touching": (ROW, TOUCH),
    "sticking": (ROW, STICK),
    "uncertain": (ROW, UNCERTAIN),
    "unlike-balls": (ROW, ["balancer.mass=[0.05, 0.04]"]),
    "race-off-centre": (ROW, ["balancer.race_offset=[0.002, 0.001]"]),
    "centrifuge": (CENTRIFUGE, []),
    "washer": (WASHER, []),
    "tilting-washer": (TILTING_WASHER, []),
}

# The two drags between which sweeps, comparisons and branches run.
PLAIN_DRAG = ("0.04", "0.08")
PHYSICAL_DRAG = {"centrifuge": ("2 N s/m", "4 N s/m"), "washer": ("1.3 N s/m", "2 N s/m"),
                 "tilting-washer": ("1.3 N s/m", "2 N s/m")}
