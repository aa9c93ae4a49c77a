"""Conformance suites: what everyone who implements a protocol promises, as tests to inherit.

Subclass one in your own tests, give it the fixture that its module asks for, and pytest runs every
promise against your implementation. This needs pytest, which the executive itself does not.
"""
