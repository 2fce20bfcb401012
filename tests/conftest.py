"""Every run of the tests is the same run: hypothesis draws the same examples, and no clock decides."""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("project", deadline=None, derandomize=True)
settings.load_profile("project")
