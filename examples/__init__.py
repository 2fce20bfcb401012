"""Examples: ``python -m examples.demo`` runs the main job on a flight that ships with the project."""
