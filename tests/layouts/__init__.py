"""Layouts for the tests, as a user writes them."""
