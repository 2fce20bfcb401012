"""What every package uses: errors, files written whole, locks, progress, linear algebra on one thread."""
