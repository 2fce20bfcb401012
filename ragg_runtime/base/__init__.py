"""What everything else stands on: errors, files, folders, locks."""
