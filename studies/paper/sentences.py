"""The paper's checkable sentences, each with a measure and what would count as the same."""
from collections.abc import Callable
from dataclasses import dataclass

us, mm = 1e-6, 1e-3
# Speed of longitudinal waves in a thin plate of the paper's glass, m/s; pressure waves take 5,879.
plate_wave = (72e9 / (2500.0 * (1.0 - 0.25**2))) ** 0.5


@dataclass(frozen=True)
class Sentence:
    """`measure(histories)` takes the runs of one treatment by (radius, speed) and returns (what was found, whether it is
    as the text says); None for the latter: the run did not come so far."""
    key: str
    case: str
    text: str
    criterion: str
    needs: tuple
    until: float  # s
    measure: Callable


def _time(value):
    return "never" if value is None else f"{value / us:.3g} µs".replace("-", "\u2212")


def _first_severe(case, low, high, earliest, latest):
    def measure(runs):
        found = runs[case].first_severe(low * mm, high * mm)
        return _time(found), found is not None and earliest * us <= found <= latest * us
    return measure


def _unbroken(case, time):
    def measure(runs):
        count = runs[case].count(time * us)
        return f"{count} separated", count == 0
    return measure


def _first_decohesion(case, earliest, latest):
    def measure(runs):
        found = runs[case].first_decohesion
        return _time(found), found is not None and earliest * us <= found <= latest * us
    return measure


# Two readings of "damage front": D > 0.1, which says what is about to break, up to 100 us; and any damage (D > 0.001), up to 30 us, when waves have
# not yet come to the rim of the smallest plate.
fronts = {"damage_front": ("D > 0.1", 100 * us), "first_damage_front": ("D > 0.001", 30 * us)}


def _speed(run, front):
    return run.front_speed(getattr(run, front), fronts[front][1])


def _slower_than_wave(front):
    def measure(runs):
        speed = runs[200, 200].front_speed(getattr(runs[200, 200], front), 30 * us)
        return f"{speed:.0f} m/s", 0.0 < speed < plate_wave
    return measure


def _damage_leads(runs):
    run = runs[200, 200]
    behind = float((run.separation_front - run.damage_front).max())
    return f"separation ahead by {max(behind, 0.0) / mm:.0f} mm at most", behind <= 0.0


def _largest_opening(runs):
    found = runs[200, 200].largest_opening_radius
    return "none" if found is None else f"{found / mm:.3g} mm", found is not None and 20 * mm <= found <= 30 * mm


def _perforation(runs):
    found = runs[200, 800].outcome.summary["failure"]["perforated"]
    return {True: "perforated", False: "not perforated", None: "undecided"}[found], found is True


def _separates_slower(runs):
    one, other = (runs[case].front_speed(runs[case].separation_front, 100 * us) for case in ((200, 800), (200, 200)))
    return f"{one:.0f} against {other:.0f} m/s", one < other


def _faster(front, one, other, least):
    """Whether the front of `one` is faster than that of `other` by more than a factor of `least`."""
    def measure(runs):
        a, b = _speed(runs[one], front), _speed(runs[other], front)
        return f"{a:.0f} against {b:.0f} m/s", a > least * b
    return measure


def _rising(front, groups):
    """Whether fronts get faster along every group of cases."""
    def measure(runs):
        rows = [[_speed(runs[case], front) for case in group] for group in groups]
        found = "; ".join("/".join(f"{speed:.0f}" for speed in row) for row in rows) + " m/s"
        return found, all(a <= b <= c and a < c for a, b, c in rows)
    return measure


def _of_both_fronts(key, case, text, criterion, needs, measure):
    """A sentence on the damage front in both readings."""
    return [Sentence(f"{key}{letter}", case, text, criterion.format(what=what, until=f"{until / us:.0f} µs"), needs, until, measure(front))
            for letter, (front, (what, until)) in zip("ab", fronts.items())]


by_speed = tuple(tuple((r, v) for v in (200, 400, 800)) for r in (200, 400, 800))
by_size = tuple(tuple((r, v) for r in (200, 400, 800)) for v in (200, 400, 800))
nine = tuple((r, v) for r in (200, 400, 800) for v in (200, 400, 800))
sentences = [
    Sentence("S1", "R 200, v 200", "no fragmentation occurs at time t = 50 µs", "no plate particle beyond the cylinder's radius has separated at 50 µs",
             ((200, 200),), 50 * us, _unbroken((200, 200), 50)),
    Sentence("S2", "R 200, v 200", "The first decohesion occurs around time t = 70 µs", "first localisation of the plate between 50 and 90 µs",
             ((200, 200),), 90 * us, _first_decohesion((200, 200), 50, 90)),
    Sentence("S3", "R 200, v 200", "Severe fragmentations first appear at the position about 30 mm … around time t = 100 µs",
             "a ring between 20 and 40 mm becomes severe between 75 and 125 µs", ((200, 200),), 125 * us, _first_severe((200, 200), 20, 40, 75, 125)),
    Sentence("S4", "R 200, v 200", "severe glass fragmentation near the end at time t = 150 µs", "a ring in the outer 20 mm becomes severe up to 160 µs",
             ((200, 200),), 160 * us, _first_severe((200, 200), 180, 200, 0, 160)),
    Sentence("S5", "R 200, v 200", "the glass breaks at the distance 100 mm", "a ring between 90 and 110 mm becomes severe up to 250 µs",
             ((200, 200),), 250 * us, _first_severe((200, 200), 90, 110, 0, 250)),
    *_of_both_fronts("S6", "R 200, v 200", "the damage front travels at a velocity which is lower than that of stress wave",
                     f"mean speed of the front of {{what}} up to 30 µs is below {plate_wave:.0f} m/s, but not zero", ((200, 200),), _slower_than_wave),
    Sentence("S7", "R 200, v 200", "the damage front is ahead of the fragmentation front", "at no output is separation farther out than D > 0.1",
             ((200, 200),), 150 * us, _damage_leads),
    Sentence("S8", "R 200, v 200", "the largest decohesion is located about 25 mm away", "the ring with the largest median opening lies at 20 to 30 mm",
             ((200, 200),), 150 * us, _largest_opening),
    Sentence("S9", "R 200, v 800", "the steel cylinder easily penetrates the glass plate", "perforated at the end", ((200, 800),), 50 * us, _perforation),
    Sentence("S10", "R 200, v 800", "The glass decohesion occurs right after impact", "first localisation of the plate before 5 µs",
             ((200, 800),), 5 * us, _first_decohesion((200, 800), -10, 5)),
    Sentence("S11", "R 200, v 800", "severe fragmentations occur at the position 50 mm", "a ring between 40 and 60 mm becomes severe up to 250 µs",
             ((200, 800),), 250 * us, _first_severe((200, 800), 40, 60, -10, 250)),
    Sentence("S12", "R 200, v 800", "the glass breaks near the end due to the reflected stress wave", "a ring in the outer 20 mm becomes severe up to 250 µs",
             ((200, 800),), 250 * us, _first_severe((200, 800), 180, 200, 0, 250)),
    *_of_both_fronts("S13", "R 200, v 800", "at a higher impact velocity, the damage propagates much faster",
                     "mean speed of the front of {what} up to {until} is higher than at 200 m/s by more than a fifth", ((200, 200), (200, 800)),
                     lambda front: _faster(front, (200, 800), (200, 200), 1.2)),
    Sentence("S14", "R 200, v 800", "the propagation of the decohesion is slower", "by 100 µs the separation front has come less far than at 200 m/s",
             ((200, 200), (200, 800)), 50 * us, _separates_slower),
    Sentence("S15", "R 400, v 200", "no fragmentation occurs at time t = 50 µs", "as S1", ((400, 200),), 50 * us, _unbroken((400, 200), 50)),
    Sentence("S16", "R 400, v 200", "Severe fragmentations first appear at the place 50 mm … at time t = 100 µs",
             "a ring between 40 and 60 mm becomes severe between 75 and 125 µs", ((400, 200),), 125 * us, _first_severe((400, 200), 40, 60, 75, 125)),
    Sentence("S17", "R 400, v 200", "At time t = 250 µs, the reflected stress wave cause the break of glass near the fixed end",
             "a ring in the outer 20 mm becomes severe up to 260 µs", ((400, 200),), 260 * us, _first_severe((400, 200), 380, 400, 0, 260)),
    *_of_both_fronts("S18", "R 400, v 200", "with a larger size glass plate, the damage propagates at a little bit higher velocity",
                     "mean speed of the front of {what} up to {until} is higher than with R = 200 mm", ((200, 200), (400, 200)),
                     lambda front: _faster(front, (400, 200), (200, 200), 1.0)),
    *_of_both_fronts("S19", "all nine", "the damage propagates faster when the impact velocity is higher",
                     "mean speed of the front of {what} up to {until} rises with v for each R (200; 400; 800 mm)", nine, lambda front: _rising(front, by_speed)),
    *_of_both_fronts("S20", "all nine", "… or the glass size is larger",
                     "mean speed of the front of {what} up to {until} rises with R for each v (200; 400; 800 m/s)", nine, lambda front: _rising(front, by_size)),
]


def judge(sentence, runs):
    """(found, verdict) of one treatment. Verdict: "yes"; "no"; "blown up" where it is as the text says, but by then the
    numerics have made more energy than the impact brought; "–" where a run is missing or ended too early."""
    if any(case not in runs for case in sentence.needs):
        return None, "–"
    ended = min(runs[case].time[-1] for case in sentence.needs)
    if ended < sentence.until - 1e-9:
        return f"ended at {ended / us:.3g} µs", "–"
    found, same = sentence.measure(runs)
    if not same:
        return found, "no"
    return found, "blown up" if abs(made_energy(sentence, runs)) > 1.0 else "yes"


def made_energy(sentence, runs):
    """Energy that the numerics had made (positive) or lost by the time that the sentence speaks of, over the impact's; of
    the worst run."""
    return max((runs[case].made_energy(sentence.until) for case in sentence.needs), key=abs)


def turns_with(verdicts):
    """What a statement's verdict turns with, of `verdicts` by (alternative reading, method): the reading, the step (or the method that chooses it), the cell, and
    chance, the ring that particles moved by 0.02 cells make. A blow-up counts as the text says: what the step makes of the statement is the question. What turns with
    chance is not said to turn with more. None: all four have been tried.

    >>> turns_with({(False, "b"): "no", (True, "b"): "yes", (False, "moved-1"): "no", (True, "moved-1"): "yes"})
    ['reading']
    >>> turns_with({(False, "b"): "no", (True, "b"): "yes", (False, "moved-1"): "no", (True, "moved-1"): "no"})
    ['chance']
    >>> turns_with({(False, "b"): "no", (False, "moved-1"): "no", (False, "a-usf"): "blown up", (False, "fine"): "yes"})
    ['step', 'cell']
    >>> turns_with({(False, "b"): "no", (False, "moved-1"): "no"}), turns_with({(False, "b"): "–"})
    (['undecided'], [])
    >>> turns_with({(False, "b"): "no", (True, "b"): "no", (False, "moved-1"): "no", (True, "moved-1"): "no", (False, "c"): "no", (False, "fine"): "no"})
    ['none']
    """
    held = {key: verdict != "no" for key, verdict in verdicts.items() if verdict != "–"}
    base = {reading: held[reading, "b"] for reading in (False, True) if (reading, "b") in held}
    if not base:
        return []
    compared = [(reading, {"moved": "chance", "fine": "cell"}.get(method.partition("-")[0], "step"), verdict == base[reading])
                for (reading, method), verdict in held.items() if method != "b" and reading in base]
    turned = {reading for reading, what, same in compared if what == "chance" and not same}
    causes = {"chance"} if turned else set()
    if len(set(base.values())) == 2 and not turned:
        causes.add("reading")
    causes |= {what for reading, what, same in compared if not same and reading not in turned}
    tried = {what for _, what, _ in compared} | ({"reading"} if len(base) == 2 else set())
    return [cause for cause in ("reading", "step", "cell", "chance") if cause in causes] or ["none" if len(tried) == 4 else "undecided"]


def overall(verdicts):
    """Of (resolved, verdict) pairs, one for each treatment."""
    def of(kind):
        return {verdict for is_resolved, verdict in verdicts if is_resolved is kind and verdict != "–"}

    if not of(True):
        return "undecided"
    if of(True) == {"yes"}:
        return "reproduced"
    if "yes" in of(True):
        return "depends on the integration"
    if "yes" in of(False):
        return "only with an unresolved step"
    return "only after a blow-up" if "blown up" in of(False) else "not reproduced"
