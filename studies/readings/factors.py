"""What the paper leaves open: factors, their levels as settings of its scene, and what it would have had to print. Level 0 is the reference reading."""
from dataclasses import dataclass

glass = "material.glass."
# Twice K_IC^2/E over u0: U0/2 is then the fracture energy that K_IC gives, 9.6 J/m^2.
griffith = 2.0 * 0.83e6**2 / (72e9 * 5e-6)


@dataclass(frozen=True)
class Level:
    label: str
    settings: tuple  # of (key, value)


@dataclass(frozen=True)
class Factor:
    key: str
    label: str
    levels: tuple
    decides: str  # what the paper would have had to print


def _factor(key, label, decides, **levels):
    return Factor(key, label, tuple(Level(text.replace("_", " "), tuple(settings.items())) for text, settings in levels.items()), decides)


factors = [
    _factor("strain", "ε_v of eq. 7", "whether ε_v is the trace or a third of it", mean={}, trace={glass + "damage.strain": "volumetric"}),
    _factor("rate", "rate of eq. 7", "the rate that enters eq. 7: when and how it is taken", maximum={}, current={glass + "damage.rate": "current"},
            averaged={glass + "damage.rate": {"averaged": 1e-6}}, fixed={glass + "damage.rate": {"fixed": 1e3}}),
    _factor("wave", "c of eq. 7", "the number c", bar={}, pressure={glass + "damage.wave_speed": "pressure-wave"}),
    _factor("k", "k of eq. 7", "k with the unit that it was used in (5.0e26 per m³, or converted from cm³ by 1e6)", printed={}, millionth={glass + "damage.k": 5e20}),
    _factor("moduli", "E of eq. 10", "whether E of eq. 10 is damaged", damaged={}, undamaged={glass + "decohesion.moduli": "undamaged"}),
    _factor("flow", "flow behind the plane", "whether a localised point flows", yes={}, no={glass + "decohesion.flow_behind_plane": False}),
    _factor("separated", "separated point", "what a point with λ = 1 bears", faces={}, friction={glass + "decohesion.friction": 0.3},
            pressure={glass + "decohesion.separated": "pressure"}, drucker_prager={glass + "decohesion.separated": "drucker-prager"},
            nothing={glass + "decohesion.separated": "nothing"}, removed={glass + "decohesion.separated": "removed"}),
    _factor("compression", "localises under compression", "where localisation is looked for", yes={}, no={glass + "decohesion.partial_compression": False}),
    _factor("eq18", "pressure in eq. 18", "the sign rule of τ_n in eqs. 15 to 18", no={}, yes={glass + "decohesion.pressure_counts": True}),
    _factor("tau", "τ̄_0", "U_0 in J/m²", onset={}, given={glass + "decohesion.tau_bar_0": griffith}),
    _factor("dilation", "Drucker-Prager flow", "the flow rule", isochoric={}, associated={glass + "drucker_prager.flow": "associated"}),
    _factor("planes", "planes searched", "whether the hoop plane is searched", plane={}, all={glass + "decohesion.plane": "all"}),
    _factor("transfer", "transfer", "how particles take the nodes' velocities", flip={}, a_tenth_of_pic={"space.transfer": {"flip": 0.9}}, pic={"space.transfer": "pic"}),
    _factor("contact", "contact", "what separates plate and cylinder", single={}, bodies={"contact.method": "bodies"},
            friction={"contact.method": "bodies", "contact.friction": 0.3}),
]
by_key = {factor.key: factor for factor in factors}
counts = [len(factor.levels) for factor in factors]
# Those that the first scan found to matter, in full.
full = ["strain", "rate", "dilation", "k"]


def settings_of(row):
    """Settings of a row of levels."""
    return {key: value for factor, level in zip(factors, row) for key, value in factor.levels[level].settings}


def departures(row):
    """Factors in which a row departs from the reference reading."""
    return [factor for factor, level in zip(factors, row) if level]


def words(row):
    """A reading, by what it departs in."""
    parts = [f"{factor.label}: {factor.levels[level].label}" for factor, level in zip(factors, row) if level]
    return "; ".join(parts) or "the reference reading"
