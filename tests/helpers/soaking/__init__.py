"""Seeded random missions in which everything may go wrong, and what must hold all the same.

Used by test_soak.py and, at length, by benchmarks/bench_soak.py.
"""
