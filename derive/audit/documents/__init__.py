"""The four source documents, encoded as printed."""
