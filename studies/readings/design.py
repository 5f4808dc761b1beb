"""Covering arrays: few combinations of levels in which every pair of levels of every two factors occurs. Deterministic."""
import itertools
import random


def pairs_of(row):
    """Pairs ((factor, level), (factor, level)) of a row of levels."""
    return set(itertools.combinations(enumerate(row), 2))


def all_pairs(counts):
    """Every pair that the factors, of `counts` levels each, have."""
    return {((a, i), (b, j)) for (a, n), (b, m) in itertools.combinations(enumerate(counts), 2) for i in range(n) for j in range(m)}


def _next_row(counts, missing, used, tries, generator):
    """Of some rows made greedily, factor by factor in random order, the one that covers most; among equals the one whose levels were used least."""
    best = None
    for _ in range(tries):
        order = generator.sample(range(len(counts)), len(counts))
        row = {}
        for factor in order:
            def gain(level):
                new = sum(tuple(sorted([(factor, level), other])) in missing for other in row.items())
                return new, -used[factor][level], generator.random()
            row[factor] = max(range(counts[factor]), key=gain)
        levels = tuple(row[factor] for factor in range(len(counts)))
        score = (len(pairs_of(levels) & missing), -sum(used[f][v] for f, v in enumerate(levels)))
        if best is None or score > best[0]:
            best = (score, levels)
    return best[1]


def covering_array(counts, size, seed=1, tries=40):
    """`size` rows of levels, at least as many as the pairs need, level 0 of every factor first; what is left over balances the levels.

    >>> rows = covering_array([2, 2, 2], 4)
    >>> set().union(*map(pairs_of, rows)) == all_pairs([2, 2, 2])
    True
    """
    generator = random.Random(seed)
    missing, used = all_pairs(counts), [[0] * count for count in counts]
    rows = []
    while missing or len(rows) < size:
        row = tuple([0] * len(counts)) if not rows else _next_row(counts, missing, used, tries, generator)
        rows.append(row)
        missing -= pairs_of(row)
        for factor, level in enumerate(row):
            used[factor][level] += 1
    return rows
