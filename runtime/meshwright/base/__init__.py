"""What every other room stands on: the compiled library, errors, files, bracketed roots."""
