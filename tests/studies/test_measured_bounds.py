#!/usr/bin/env python3
"""What an assertion used up of its bound, read from what Catch2 prints."""
import unittest

from support import source  # noqa: F401  (finds the studies)
from verification.assertions import comparison


class Bounds(unittest.TestCase):
    def assert_share(self, original, expanded, share):
        self.assertAlmostEqual(comparison(original, expanded).share, share, places=12)

    def test_upper_and_lower_bounds(self):
        self.assert_share("error < 1e-3", "0.00025 < 0.001", 0.25)
        self.assert_share("error <= bound", "1e-14 <= 4e-14", 0.25)
        self.assert_share("order > 1.8", "2.0 > 1.8", 0.9)
        self.assert_share("force >= 3.0f", "4.0f >= 3.0f", 0.75)

    def test_distance_from_a_value(self):
        self.assert_share("x == Approx(2.0).epsilon(0.05)", "2.02 == Approx( 2.0 )", 0.2)
        self.assert_share("x == Approx(-2.0).epsilon(0.05)", "-2.02 == Approx( -2.0 )", 0.2)
        self.assert_share("x == Approx(0.0).margin(1e-9)", "-0.0000000005 == Approx( 0.0 )", 0.5)
        self.assertEqual(comparison("x == Approx(2.0).epsilon(0.05)", "2.02 == Approx( 2.0 )").bound, "2.0 ± 0.1")

    def test_lines_that_catch2_breaks(self):
        self.assert_share("\n  error\n  < 1e-3\n", "\n  0.00025\n  <\n  0.001\n", 0.25)

    def test_no_share_without_a_scale(self):
        for original, expanded in (("found", "true"), ("n > 100", "140 > 100"), ("loss < 0.0", "-1.0 < 0.0"), ("a < b", "-1.0 < 2.0"),
                                   ("x == y", "1.0 == 1.0"), ("x == Approx(y)", "1.0 == Approx( 1.0 )"), ("x == Approx(y).epsilon(e)", "1.0 == Approx( 1.0 )"),
                                   ("name == \"a < b\"", "\"a < b\" == \"a < b\"")):
            self.assertIsNone(comparison(original, expanded), original)


if __name__ == "__main__":
    unittest.main()
