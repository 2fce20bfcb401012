"""What every room stands on: errors, files written whole, locks, progress, linear algebra on one thread."""
