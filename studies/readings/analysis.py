"""What verdicts (0 or 1) owe to readings, integration and chance, and what a hit among many tries is worth."""
import itertools

import numpy as np

permutations = 20_000  # so that a probability corrected for some 300 effects can be small
draws = 2000


def explained(values, labels):
    """Share of the variance of `values` between groups of equal `labels`, of each row of `values` where it has rows; 0 where nothing varies.

    >>> explained(np.array([0.0, 0.0, 1.0, 1.0]), np.array([0, 0, 1, 1]))
    1.0
    """
    member = (labels[:, None] == np.unique(labels)).astype(float)
    means = values @ member / member.sum(axis=0)
    between = (means - values.mean(axis=-1, keepdims=True)) ** 2 @ member.mean(axis=0)
    total = values.var(axis=-1)
    return np.where(total > 0.0, between / np.where(total > 0.0, total, 1.0), 0.0)[()]


def permuted(values, labels, shuffled):
    """(share, probability that values in random order, the rows of `shuffled`, are explained as well)."""
    share = float(explained(values, labels))
    as_much = np.sum(explained(shuffled, labels) >= share - 1e-12)
    return share, float((1 + as_much) / (1 + len(shuffled)))


def holm(probabilities):
    """Probabilities corrected for their number (Holm).

    >>> holm([0.01, 0.04, 0.03])
    [0.03, 0.06, 0.06]
    """
    order = np.argsort(probabilities)
    corrected, so_far = [0.0] * len(probabilities), 0.0
    for rank, n in enumerate(order):
        so_far = max(so_far, min(1.0, (len(probabilities) - rank) * probabilities[n]))
        corrected[n] = float(round(so_far, 12))
    return corrected


def main_effects(verdicts, rows):
    """Of each statement and factor: share of the variance between readings, its probability corrected over all of them, and the mean verdict at each level.
    `verdicts`: statements x rows (means over the integrations); `rows`: rows x factors, of levels."""
    generator, found = np.random.default_rng(7), []
    for s, values in enumerate(verdicts):
        shuffled = generator.permuted(np.tile(values, (permutations, 1)), axis=1)
        found += [(s, f, *permuted(values, rows[:, f], shuffled)) for f in range(rows.shape[1])]
    corrected = holm([p for *_, p in found])
    return {(s, f): {"share": share, "p": p, "levels": [float(np.mean(verdicts[s][rows[:, f] == level])) for level in np.unique(rows[:, f])]}
            for (s, f, share, _), p in zip(found, corrected)}


def factorial_effects(values, rows):
    """Share of the variance of a full factorial by set of factors (tuples of their columns), which add up to 1: the analysis of variance of its cells.

    >>> rows = np.array([[0, 0], [0, 1], [1, 0], [1, 1]])
    >>> {key: round(value, 6) for key, value in factorial_effects(np.array([0.0, 0.0, 0.0, 1.0]), rows).items()}
    {(0,): 0.333333, (1,): 0.333333, (0, 1): 0.333333}
    """
    total, sums = np.var(values), {}
    for size in range(1, rows.shape[1] + 1):
        for columns in itertools.combinations(range(rows.shape[1]), size):
            cells = np.unique(rows[:, list(columns)], axis=0, return_inverse=True)[1].ravel()
            below = sum(share for of, share in sums.items() if set(of) < set(columns))
            sums[columns] = explained(values, cells) - below if total > 0.0 else 0.0
    return sums


def shares(table, again, column):
    """Of the variance of verdicts over readings x integrations (`table`): what is the reading's alone, the integration's alone, of both together, and, of the
    last, what two members of one reading (`again`: a second member under the integration number `column`) differ by anyway."""
    total = float(np.var(table))
    if total == 0.0:
        return None
    reading, way = np.var(table.mean(axis=1)) / total, np.var(table.mean(axis=0)) / total
    chance = min(1.0, 0.5 * float(np.mean((table[:, column] - again) ** 2)) / total)
    together = max(0.0, 1.0 - reading - way)
    return {"reading": float(reading), "integration": float(way), "together": max(0.0, together - chance), "chance": min(chance, together) if reading + way < 1.0 else 0.0}


def best_by_chance(hits):
    """(most statements that one combination reaches, the expected most where each statement's hits fall on combinations at random, and how often that is as
    many). `hits`: statements x combinations."""
    generator, best = np.random.default_rng(11), int(hits.sum(axis=0).max())
    most = np.array([generator.permuted(hits, axis=1).sum(axis=0).max() for _ in range(draws)])
    return best, float(most.mean()), float((1 + np.sum(most >= best)) / (1 + draws))


def frontier(readings):
    """Of (departures, hits, reading): for each number of departures that buys more hits than fewer do, the best."""
    best, kept = -1, []
    for departures, hits, reading in sorted(readings, key=lambda each: (each[0], -each[1])):
        if hits > best:
            best = hits
            kept.append((departures, hits, reading))
    return kept


def cover(hits):
    """Combinations that together reach what any does, chosen greedily: [(combination, statements that it adds)]."""
    left, chosen = hits.any(axis=1), []
    while left.any():
        n = int(np.argmax(hits[left].sum(axis=0)))
        chosen.append((n, np.nonzero(left & hits[:, n])[0].tolist()))
        left &= ~hits[:, n]
    return chosen
