"""What comes after a model: calibrations that are kept, and the gravity gradient with all removed that it explains."""
