"""The words in which a drive's page is written: symbols, motions, surfaces, envelopes, contact, description."""
