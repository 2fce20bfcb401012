"""Real accelerometers on a turning body: an array of eight MEMS sensors as a gradiometer that stands still."""
