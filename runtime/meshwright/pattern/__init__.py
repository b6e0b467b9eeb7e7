"""Contact patterns: the gap between two flanks about a contact, and its level lines."""
