"""Conformance suites: tests to inherit for every implementation of a protocol.

Subclass one in your own tests and provide the fixture that its module describes; pytest then runs
all its tests on your implementation. This needs pytest, which the executive itself does not.
"""
