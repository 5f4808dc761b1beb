"""What an assertion of a test compared, read from its text and from its values as Catch2 prints them."""
import re

number = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?f?"
less = re.compile(rf"^({number}) <=? ({number})$")
greater = re.compile(rf"^({number}) >=? ({number})$")
approximate = re.compile(rf"^({number}) == Approx\( ({number}) \)$")
tolerance = re.compile(rf"\.(epsilon|margin)\(({number})\)")


class Comparison:
    """text: the assertion as written. measured, bound: as text. share: of the bound that was used up; 1 at the bound."""

    def __init__(self, text, measured, bound, share):
        self.text, self.measured, self.bound, self.share = text, measured, bound, share


def value(text):
    return float(text.removesuffix("f"))


def is_count(text):
    return re.fullmatch(r"\d+", text) is not None


def allowed(original, expected):
    """By how much a value may miss an Approx, from its literal epsilon and margin; None where neither is a literal."""
    given = {kind: float(size) for kind, size in tolerance.findall(original)}
    if not given:
        return None
    return max(given.get("epsilon", 0.0) * abs(expected), given.get("margin", 0.0))


def comparison(original, expanded):
    """The comparison of an assertion with a positive bound; None for truths, counts, texts and comparisons without a scale."""
    original, expanded = " ".join(original.split()), " ".join(expanded.split())
    if match := less.match(expanded):
        measured, bound = map(value, match.groups())
        if measured < 0.0 or bound <= 0.0 or is_count(match[1]):
            return None
        return Comparison(original, match[1], f"< {match[2]}", measured / bound)
    if match := greater.match(expanded):
        measured, bound = map(value, match.groups())
        if measured <= 0.0 or bound <= 0.0 or is_count(match[1]):
            return None
        return Comparison(original, match[1], f"> {match[2]}", bound / measured)
    if match := approximate.match(expanded):
        measured, expected = map(value, match.groups())
        room = allowed(original, expected)
        if not room:
            return None
        return Comparison(original, match[1], f"{match[2]} ± {room:.2g}", abs(measured - expected) / room)
    return None
