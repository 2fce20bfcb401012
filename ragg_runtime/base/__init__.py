"""What every room stands on: errors, files written whole, locks, progress, threads, memory."""
