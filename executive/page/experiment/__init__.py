"""The experimenter's page: the tree, tick by tick, of the mission that runs and of past ones.

It has an address and a token of its own: who has those of the person's page reaches none of it.
"""
