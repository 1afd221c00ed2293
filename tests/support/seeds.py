"""Seeds for random tests: fixed, so that a test has the same answer each time. In soak tests, HOLOMORPH_FRESH makes them
new, and HOLOMORPH_SEED repeats one."""
import os
import random
import unittest

SOAKS = "HOLOMORPH_FRESH" in os.environ


def seed_of(test, fixed=1):
    given = os.environ.get("HOLOMORPH_SEED")
    seed = int(given) if given else random.SystemRandom().randrange(1 << 30) if SOAKS else fixed
    print(f"{test}: HOLOMORPH_SEED={seed}", flush=True)
    return seed


def few_or_many(few, many):
    """Cases of scripts/test, and those of scripts/soak."""
    return many if SOAKS else few


def soak(test):
    """Marks a test that takes too long for scripts/test."""
    return unittest.skipUnless(SOAKS, "runs in scripts/soak")(test)
