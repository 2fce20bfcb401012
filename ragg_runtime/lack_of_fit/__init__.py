"""What no known effect explains: a dictionary of generic terms, searched in the whitened remainder."""
